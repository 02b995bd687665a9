"""Design spectra, and sets of motions checked by a code."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _jostle
from ._units import Quantity, in_si, option_text

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class DesignSpectrum:
    """A design spectrum of a code, or the points in a file.

    Args:
        code: ``"gb50011"``, ``"en1998"`` or ``"asce7"``.
        file: a file of periods and accelerations instead.
        intensity: GB 50011: 6, 7, 7.5 (0.15 g), 8, 8.5 (0.30 g) or 9.
        site: GB 50011: ``"I0"``, ``"I1"``, ``"II"``, ``"III"`` or ``"IV"``.
        group: GB 50011: 1, 2 or 3.
        level: GB 50011: ``"frequent"``, ``"fortification"`` or ``"rare"``.
        type: EN 1998-1: spectrum 1 or 2.
        ground: EN 1998-1: ``"A"`` to ``"E"``.
        ag: EN 1998-1: design ground acceleration.
        sds: ASCE 7: S_DS.
        sd1: ASCE 7: S_D1.
        tl: ASCE 7: T_L.
        factor: factor on the spectrum.

    Raises:
        ModelError: a key is missing or wrong.

    Examples:
        >>> import jostle
        >>> target = jostle.DesignSpectrum("en1998", type=1, ground="B", ag="0.2 g")
        >>> target.acceleration([0.3]).round(3)
        array([5.884])
    """

    name: str
    _words: dict[str, str]

    def __init__(
        self,
        code: str | None = None,
        *,
        file: str | os.PathLike[str] | None = None,
        intensity: float | str | None = None,
        site: str | None = None,
        group: int | str | None = None,
        level: str | None = None,
        type: int | str | None = None,
        ground: str | None = None,
        ag: Quantity | None = None,
        sds: Quantity | None = None,
        sd1: Quantity | None = None,
        tl: Quantity | None = None,
        factor: float | None = None,
    ) -> None:
        if (code is None) == (file is None):
            raise TypeError("DesignSpectrum: give either a code or a file")
        words: dict[str, Any] = {
            "code": code,
            "file": None if file is None else os.fspath(file),
            "intensity": intensity,
            "site": site,
            "group": group,
            "level": level,
            "type": type,
            "ground": ground,
            "ag": ag,
            "sds": sds,
            "sd1": sd1,
            "tl": tl,
            "factor": factor,
        }
        self._words = {name: option_text(name, value) for name, value in words.items() if value is not None}
        self.name, self._range, _ = _jostle.target(self._words, [], 0.05)

    @property
    def periods(self) -> tuple[float, float]:
        """First and last period for which the spectrum is defined [s]."""
        return (self._range[0], self._range[1])

    def acceleration(self, periods: Sequence[Quantity] | npt.NDArray[Any], damping: float = 0.05) -> npt.NDArray[np.float64]:
        """Pseudo-acceleration at periods [m/s²], shape ``(n,)``.

        Args:
            periods: natural periods [s].
            damping: fraction of critical.

        Raises:
            ModelError: a period is outside the range of the spectrum.
        """
        import numpy as np

        seconds = [in_si("periods", period, "time") for period in periods]
        return np.array(_jostle.target(self._words, seconds, float(damping))[2], dtype=np.float64)

    def __repr__(self) -> str:
        return f"<DesignSpectrum {self.name!r}>"

    def _repr_html_(self) -> str:
        import numpy as np

        from ._draw import history_svg

        periods = np.linspace(self.periods[0], min(self.periods[1], 6.0), 200)
        return history_svg(self.name, "m/s²", [(self.name, periods, self.acceleration(periods))])


class Selection:
    """A set of motions, checked by the rules of a code: the result of :meth:`Motion.select`.

    Examples:
        >>> import jostle
        >>> target = jostle.DesignSpectrum("gb50011", intensity=8, site="II", group=1)
        >>> jostle.Motion.select(target, periods=["0.8 s"], natural=["el-centro-1940-ns"]).passes
        False
    """

    tree: dict[str, Any]

    def __init__(self, tree: str, text: str, page: str) -> None:
        #: All results, as in ``jostle motion select --json``.
        self.tree = json.loads(tree)
        self._text, self._page = text, page

    @property
    def passes(self) -> bool:
        """Whether the set meets all rules."""
        return cast(bool, self.tree["passes"])

    @property
    def rules(self) -> list[dict[str, Any]]:
        """The rules: ``clause``, ``asked``, ``found`` and ``met``."""
        return cast("list[dict[str, Any]]", self.tree["rules"])

    @property
    def motions(self) -> list[dict[str, Any]]:
        """The motions: ``name``, ``pga_m_s2``, ``ratios`` to the code at every period, …"""
        return cast("list[dict[str, Any]]", self.tree["motions"])

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes a page with charts.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.write_text(os.fspath(path), self._page, "page", force)
        return Path(path)

    def __str__(self) -> str:
        return self._text.rstrip()

    def __repr__(self) -> str:
        met = sum(bool(rule["met"]) for rule in self.rules)
        return f"<Selection: {len(self.motions)} motions, {met} of {len(self.rules)} rules met>"

    def _repr_html_(self) -> str:
        from ._draw import selection_html

        return selection_html(self)
