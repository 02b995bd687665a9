"""From reinforcement to the moments at which a member cracks and yields."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _jostle
from ._model import Model
from ._units import Quantity, option_text

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class SectionAnswer:
    """Cracking and yield of reinforced sections, by formulas and by fibre analysis: the result of :func:`section`.

    Examples:
        >>> import jostle
        >>> answer = jostle.section(width="300 mm", depth="600 mm", bars="4 d25 top, 3 d25 bottom")
        >>> curvature, moment = answer.curve()
        >>> bool(moment.max() > 0)
        True
    """

    tree: list[dict[str, Any]]

    def __init__(self, tree: str, text: str, page: str) -> None:
        #: One dict per section, as in ``jostle section --json``.
        self.tree = json.loads(tree)["sections"]
        self._text, self._page = text, page

    def __len__(self) -> int:
        return len(self.tree)

    def __getitem__(self, index: int) -> dict[str, Any]:
        return self.tree[index]

    def curve(self, index: int = 0, side: str = "positive") -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Curvature [1/m] and moment [N·m] by fibre analysis.

        Args:
            index: number of the section, from 0.
            side: ``"positive"`` or ``"negative"``.

        Raises:
            ValueError: the fibre analysis failed, with the reason.
        """
        import numpy as np

        fibre = self.tree[index]["fibre"]
        if "error" in fibre:
            raise ValueError(fibre["error"])
        own = fibre[side]
        return np.array(own["curvature_1_m"], dtype=np.float64), np.array(own["moment_nm"], dtype=np.float64)

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes a page with the curves and the sections.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.write_text(os.fspath(path), self._page, "sections", force)
        return Path(path)

    def __str__(self) -> str:
        return self._text.rstrip()

    def __repr__(self) -> str:
        return f"<SectionAnswer: {', '.join(own['name'] for own in self.tree)}>"

    def _repr_html_(self) -> str:
        from ._draw import section_html

        return section_html(self)


def section(
    model: Model | str | os.PathLike[str] | Mapping[str, Any] | None = None,
    *,
    width: Quantity | None = None,
    depth: Quantity | None = None,
    bars: str | None = None,
    concrete: Quantity = "C30",
    steel: Quantity = "HRB400",
    strength: str = "characteristic",
    cover: Quantity = "35 mm",
    ties: str | None = None,
    axial_load: Quantity | None = None,
    length: Quantity = "3 m",
) -> SectionAnswer:
    """Moments and rotations at which reinforced members crack and yield.

    Args:
        model: model whose reinforced members are analysed, instead of width, depth and bars of a section.
        width: width, across the direction of bending.
        depth: depth, in the direction of bending.
        bars: bars, such as ``"12 d20"`` around, or ``"4 d25 top, 3 d25 bottom"``.
        concrete: grade, or prismatic strength.
        steel: grade, or yield strength.
        strength: strength level of a grade: ``"characteristic"``, ``"mean"`` or ``"design"``.
        cover: concrete cover of the bars.
        ties: ties that confine the core, such as ``"d10 @ 100 mm"``.
        axial_load: axial compression; if not given, the section is that of a beam.
        length: length of the member, which is assumed to bend in double curvature.

    Raises:
        ModelError: an argument is wrong, or the model has no reinforced member.

    Examples:
        >>> import jostle
        >>> answer = jostle.section(width="500 mm", depth="500 mm", bars="12 d20", axial_load="800 kN", length="3.2 m")
        >>> answer[0]["name"]
        'Column'
    """
    own = {"width": width, "depth": depth, "bars": bars}
    missing = [name for name, value in own.items() if value is None]
    if model is not None:
        if len(missing) < len(own):
            raise TypeError("section: give either a model, or width, depth and bars")
        return SectionAnswer(*Model.from_any(model)._core.sections())
    if missing:
        raise TypeError(f"section: {' and '.join(missing)} missing; give width, depth and bars, or a model")
    given: dict[str, Any] = {
        **own,
        "concrete": concrete,
        "steel": steel,
        "strength": strength,
        "cover": cover,
        "ties": ties,
        "axial_load": axial_load,
        "length": length,
    }
    options = {name: option_text(name, value) for name, value in given.items() if value is not None}
    return SectionAnswer(*_jostle.section(options))
