"""Tables that NumPy, pandas, polars and pyarrow accept directly."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from operator import index
from typing import TYPE_CHECKING, Any, cast, overload

from . import _jostle

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    from typing_extensions import CapsuleType


#: Columns of texts, also where there are no rows.
_TEXTS = frozenset({"gap", "member", "end", "rule", "shear_end", "bending_end"})


class Table:
    """Columns of equal length; their names contain units.

    ``table["time_s"]`` is a NumPy array, ``table[3]`` a row as a dict. ``polars.DataFrame(table)``,
    ``pyarrow.table(table)`` and ``pandas.DataFrame.from_arrow(table)`` accept it directly (Arrow PyCapsule interface).
    """

    _core: _jostle.Table

    @classmethod
    def _of(cls, core: _jostle.Table) -> Table:
        table = cls.__new__(cls)
        table._core = core
        return table

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return self._core.names

    def __len__(self) -> int:
        return len(self._core)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]: ...
    @overload
    def __getitem__(self, key: int) -> dict[str, Any]: ...
    def __getitem__(self, key: str | int) -> npt.NDArray[Any] | dict[str, Any]:
        if isinstance(key, str):
            return self._column(key)
        row = index(key)
        row += len(self) if row < 0 else 0
        if not 0 <= row < len(self):
            raise IndexError(f"row {key} of {len(self)}")
        return {name: _plain(self._column(name)[row]) for name in self.columns}

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Rows as dicts."""
        columns = {name: self._column(name) for name in self.columns}
        for row in range(len(self)):
            yield {name: _plain(values[row]) for name, values in columns.items()}

    def _column(self, name: str) -> npt.NDArray[Any]:
        import numpy as np

        try:
            at = self.columns.index(name)
        except ValueError:
            raise KeyError(f"{name!r}; the columns are {', '.join(self.columns)}") from None
        values = self._core.column(at)
        if isinstance(values, np.ndarray):
            return values
        kind = self._core.kind(at)
        if kind == "text":
            return np.array(values, dtype=object)
        dtype: Any = np.float64 if kind == "optional" else np.int32
        absent = [value is None for value in values]
        present = [0 if value is None else value for value in values]
        if any(absent):
            masked: Any = np.ma
            return cast("npt.NDArray[Any]", masked.array(present, mask=absent, dtype=dtype))
        return np.array(present, dtype=dtype)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``."""
        pandas: Any = import_module("pandas")
        return pandas.DataFrame({name: self._column(name) for name in self.columns})

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> CapsuleType:
        """The table through the Arrow C stream interface; the columns are copied once."""
        return self._core.__arrow_c_stream__(requested_schema)

    def __arrow_c_schema__(self) -> CapsuleType:
        """Names and types of the columns through the Arrow C interface."""
        return self._core.__arrow_c_schema__()

    def __repr__(self) -> str:
        return f"<Table, {len(self)} rows of {', '.join(self.columns)}>"

    def _repr_html_(self) -> str:
        from ._draw import table_html

        return table_html(self)


def _plain(value: Any) -> Any:
    """The Python number of a NumPy number; ``None`` if absent."""
    import numpy as np

    if value is np.ma.masked:
        return None
    return value.item() if isinstance(value, np.generic) else value
