"""Comparisons of a model with a shake-table test."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, cast

from . import _jostle
from ._model import Model
from ._table import Table
from ._tree import text_of


class Comparison:
    """A model under the recorded motion of a shake table, compared with the measurements.

    Examples:
        >>> import jostle
        >>> model = jostle.Model([jostle.Shear("A", mass=["40 t"], stiffness=["20 MN/m"], storey_height="3 m")])
        >>> rows = [f"{0.01 * k:.2f}\\t{0.1 * (-1) ** (k // 50)}\\t{0.5 * (-1) ** (k // 50)}" for k in range(200)]
        >>> with open("test.asc", "w") as file:
        ...     _ = file.write("Test\\n2\\n3\\nTime\\tA0\\tD1\\nsec\\tg\\tmm\\n6\\n" + "\\n".join(rows) + "\\n")
        >>> columns = [{"measured": "D1", "computed": "A.floor1.displacement_m"}]
        >>> found = jostle.compare(model, "test.asc", {"table_acceleration": "A0", "column": columns})
        >>> found.score("A.floor1.displacement_m")["peak_measured"]
        0.0005
    """

    _core: _jostle.Comparison
    _folder: Path | None

    @classmethod
    def _of(cls, core: _jostle.Comparison, folder: Path | None) -> Comparison:
        comparison = cls.__new__(cls)
        comparison._core, comparison._folder = core, folder
        return comparison

    @property
    def folder(self) -> Path | None:
        """Folder with the files; ``None`` if none were written."""
        return self._folder

    @cached_property
    def summary(self) -> dict[str, Any]:
        """All scores and the instants of all impacts: the tree of ``compare.json``."""
        return cast("dict[str, Any]", json.loads(self._core.json()))

    @cached_property
    def table(self) -> Table:
        """Measured and computed histories at the measured instants; columns as in ``compare.parquet``."""
        return Table._of(self._core.table())

    def score(self, computed: str) -> dict[str, float | None]:
        """Scores of one result, such as ``"A.floor1.displacement_m"``: peaks, ratio, correlation, difference.

        Raises:
            KeyError: this result was not compared.
        """
        for column in self.summary["columns"]:
            if column["computed"] == computed:
                return cast("dict[str, float | None]", column["score"])
        known = ", ".join(column["computed"] for column in self.summary["columns"])
        raise KeyError(f"{computed!r}; compared are {known}")

    def html(self) -> str:
        """The page ``compare.html``."""
        return self._core.page()

    def __str__(self) -> str:
        return self._core.text().rstrip()

    def __repr__(self) -> str:
        return f"<Comparison {self.summary['title']!r}: {len(self.summary['columns'])} histories>"

    def _repr_html_(self) -> str:
        from ._draw import comparison_html

        return comparison_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Comparison cannot be pickled; send comparison.summary")


def compare(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    data: str | os.PathLike[str],
    map: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str] | None = None,
    *,
    force: bool = False,
) -> Comparison:
    """Runs a model with the recorded motion of a shake table and compares it with the measurements.

    Args:
        model: a model, its file or its tree; the motion of the model is not used.
        data: measurements in the NEES ``.asc`` layout.
        map: which columns of the data belong to which results: a file, or its tree, such as
            ``{"table_acceleration": "A0", "column": [{"measured": "D1", "computed": "A.floor1.displacement_m"}]}``.
        out: folder for ``compare.json``, ``compare.parquet`` and ``compare.html``; ``None`` writes nothing.
        force: replaces files in the folder that jostle did not write.

    Raises:
        ModelError: the model, the data or the map is wrong.
        AnalysisError: the run failed.
        FileExistsError: the folder contains a file of such a name that jostle did not write.

    Examples:
        >>> import jostle
        >>> model = jostle.Model([jostle.Shear("A", mass=["40 t"], stiffness=["20 MN/m"], storey_height="3 m")])
        >>> rows = [f"{0.01 * k:.2f}\\t{0.1 * (-1) ** (k // 50)}\\t{0.5 * (-1) ** (k // 50)}" for k in range(200)]
        >>> with open("test.asc", "w") as file:
        ...     _ = file.write("Test\\n2\\n3\\nTime\\tA0\\tD1\\nsec\\tg\\tmm\\n6\\n" + "\\n".join(rows) + "\\n")
        >>> columns = [{"measured": "D1", "computed": "A.floor1.displacement_m"}]
        >>> found = jostle.compare(model, "test.asc", {"table_acceleration": "A0", "column": columns})
        >>> found.score("A.floor1.displacement_m")["peak_measured"]
        0.0005
    """
    folder = None if out is None else Path(out)
    if folder is not None:
        os.makedirs(folder, exist_ok=True)
    is_tree = isinstance(map, Mapping)
    core = _jostle.compare(
        Model.from_any(model)._core,
        os.fspath(data),
        None if is_tree else os.fspath(cast("str | os.PathLike[str]", map)),
        text_of(map, "map") if is_tree else None,
        None if folder is None else os.path.abspath(folder),
        bool(force),
    )
    return Comparison._of(core, folder)
