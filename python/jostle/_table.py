"""Tables that NumPy, pandas, polars and pyarrow accept directly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
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

    ``table["time_s"]`` is a NumPy array, ``table[3]`` a row as a dict, ``table[2:5]`` a table of rows, and
    ``table[table["time_s"] > 2]`` a table of the rows that a mask selects. ``polars.DataFrame(table)``,
    ``pyarrow.table(table)`` and ``pandas.DataFrame.from_arrow(table)`` accept it directly (Arrow PyCapsule interface).

    Examples:
        >>> import jostle
        >>> impacts = jostle.run("paper", gap="10 mm").impacts
        >>> strong = impacts[impacts["peak_force_n"] > 1e6]
        >>> len(strong) < len(impacts), len(impacts[:3])
        (True, 3)
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
    @overload
    def __getitem__(self, key: slice | Sequence[bool] | Sequence[int] | npt.NDArray[Any]) -> Table: ...
    def __getitem__(self, key: Any) -> npt.NDArray[Any] | dict[str, Any] | Table:
        import numpy as np

        if isinstance(key, str):
            return self._column(key)
        if isinstance(key, slice):
            return self._of(self._core.taken(list(range(len(self)))[key]))
        if isinstance(key, np.ndarray) and key.ndim == 1 or isinstance(key, (list, tuple)):
            chosen = np.ma.filled(np.ma.asarray(key), False) if len(key) else np.zeros(0, dtype=int)
            if chosen.dtype == bool and len(chosen) != len(self):
                raise IndexError(f"the mask has {len(chosen)} entries, the table {len(self)} rows")
            if chosen.dtype != bool and not np.issubdtype(chosen.dtype, np.integer):
                raise TypeError(f"rows are chosen by true and false or by numbers, found {chosen.dtype}")
            return self._of(self._core.taken(np.arange(len(self))[chosen].tolist()))
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

    def to_polars(self) -> Any:
        """A ``polars.DataFrame``."""
        polars: Any = import_module("polars")
        return polars.DataFrame(self)

    def to_xarray(self, index: str | None = None) -> Any:
        """An ``xarray.Dataset`` with one variable per column.

        Args:
            index: column that becomes the coordinate; by default ``time_s`` if there is one, else the number of the row.

        Raises:
            KeyError: there is no such column.
        """
        xarray: Any = import_module("xarray")
        along = index or ("time_s" if "time_s" in self else None)
        if along is None:
            return xarray.Dataset({name: ("row", self._whole(name)) for name in self.columns})
        variables = {name: (along, self._whole(name)) for name in self.columns if name != along}
        return xarray.Dataset(variables, coords={along: self._column(along)})

    def _whole(self, name: str) -> npt.NDArray[Any]:
        """A column without a mask: absent numbers are NaN."""
        import numpy as np

        values: Any = self._column(name)
        whole = cast(Any, values.astype(float)).filled(np.nan) if isinstance(values, np.ma.MaskedArray) else values
        return cast("npt.NDArray[Any]", whole)

    def __reduce__(self) -> tuple[Any, ...]:
        core = self._core
        columns = [(name, core.kind(at), core.column(at)) for at, name in enumerate(core.names)]
        return (_rebuild, (columns,))

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


def _rebuild(columns: list[tuple[str, str, Any]]) -> Table:
    return Table._of(_jostle.Table.of(columns))


def _plain(value: Any) -> Any:
    """The Python number of a NumPy number; ``None`` if absent."""
    import numpy as np

    if value is np.ma.masked:
        return None
    return value.item() if isinstance(value, np.generic) else value
