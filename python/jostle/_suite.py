"""Suites: one model under several records, with governing values."""

from __future__ import annotations

import contextlib
import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, cast

from . import _jostle
from ._errors import JostleWarning
from ._model import Model
from ._motion import Motion
from ._progress import Observer, ProgressLine
from ._table import Table


class _SuiteLine(ProgressLine):
    """Shows the share of a suite that is done."""

    def __call__(self, time: float, duration: float) -> None:
        if self._is_due():
            self._draw(min(max(time, 0.0), 1.0), f"{100 * time:3.0f} %")


@dataclass(frozen=True)
class Governing:
    """One quantity over the records of a suite, in SI.

    Attributes:
        name: name with its unit at the end, such as ``"A.drift_peak"``.
        values: one value per record; ``None`` for records that did not reach their end.
        mean: arithmetic mean.
        standard_deviation: with n − 1; ``None`` for a single value.
        minimum: least value.
        maximum: greatest value.
        maximum_record: record of the greatest value, from 0.
        median: median.
        p16: 16 % quantile.
        p84: 84 % quantile.
        governing: the mean or the greatest value, by the rule of the suite.

    Examples:
        >>> import jostle
        >>> suite = jostle.run_suite("paper", motions=["el-centro-1940-ns", "nanjing-artificial"], report=False)
        >>> drift = suite["J1.drift_peak"]
        >>> drift.minimum <= drift.mean <= drift.maximum
        True
    """

    name: str
    values: tuple[float | None, ...]
    mean: float
    standard_deviation: float | None
    minimum: float
    maximum: float
    maximum_record: int
    median: float
    p16: float
    p84: float
    governing: float


class Suite:
    """Results of a model under several records.

    Examples:
        >>> import jostle
        >>> suite = jostle.run_suite("paper", motions=["el-centro-1940-ns", "nanjing-artificial"], report=False)
        >>> len(suite.table)
        2
    """

    _core: _jostle.Suite
    _folder: Path | None

    @classmethod
    def _of(cls, core: _jostle.Suite, folder: Path | None) -> Suite:
        suite = cls.__new__(cls)
        suite._core, suite._folder = core, folder
        return suite

    @property
    def folder(self) -> Path | None:
        """Folder with the files of the suite and of every record; ``None`` if none were written."""
        return self._folder

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Records, rule and statistics: the tree of ``suite.json``."""
        return cast("dict[str, Any]", json.loads(self._core.json()))

    @property
    def records(self) -> list[str]:
        """Names of the motions, in the order of the model."""
        return [record["motion"]["name"] for record in self.summary["records"]]

    @property
    def rule(self) -> str:
        """Rule for the governing values, in a sentence."""
        return cast(str, self.summary["governing"]["text"])

    def record(self, record: str | int) -> dict[str, Any]:
        """The summary of one record, the tree of its ``summary.json``, by name or by number from 0.

        Raises:
            KeyError: there is no such record.
        """
        at = self.records.index(record) if record in self.records else record
        if not isinstance(at, int) or not -len(self.records) <= at < len(self.records):
            raise KeyError(f"there is no record {record!r}; there are {', '.join(self.records)}")
        return cast("dict[str, Any]", json.loads(self._core.record_json(at % len(self.records))))

    @cached_property
    def table(self) -> Table:
        """One row per record: motion, status and all quantities; columns as in ``suite.parquet``."""
        return Table._of(self._core.table())

    @cached_property
    def statistics(self) -> Table:
        """One row per quantity: mean, spread, greatest and governing value."""
        return Table._of(self._core.statistics())

    @property
    def quantities(self) -> list[str]:
        """Names of all quantities."""
        return [quantity["name"] for quantity in self.summary["quantities"]]

    def __getitem__(self, name: str) -> Governing:
        for quantity in self.summary["quantities"]:
            if quantity["name"] == name:
                return Governing(**{**quantity, "values": tuple(quantity["values"])})
        raise KeyError(f"{name!r}; the quantities are {', '.join(self.quantities)}")

    def __str__(self) -> str:
        return self._core.text().rstrip()

    def __repr__(self) -> str:
        return f"<Suite {self.summary['title']!r}: {len(self.records)} records>"

    def _repr_html_(self) -> str:
        from ._draw import suite_html

        return suite_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Suite cannot be pickled; send suite.summary")


def run_suite(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str] | None = None,
    *,
    motions: Sequence[Motion | str | os.PathLike[str]] | None = None,
    governing: str | None = None,
    report: bool = True,
    sensitivity: bool = False,
    jobs: int | None = None,
    progress: bool | Observer = False,
    force: bool = False,
) -> Suite:
    """Runs a model under every one of its records, on all cores.

    With a folder, the same call continues after any interruption: finished records are not run again. Results are
    bit-identical for any number of threads. Ctrl-C raises ``KeyboardInterrupt``; finished records are kept.

    Args:
        model: a model with several records, ``motion={"record": ["a.at2", "b.at2"]}``, or its file or tree.
        out: folder for the files of the suite and of every record; ``None`` writes nothing.
        motions: :class:`Motion` objects, used as they are, or records by name or path, with the scaling of the model; by
            default the records of the model.
        governing: rule for the governing values: ``"gb50011"``, ``"en1998"``, ``"asce7"``, ``"mean"`` or ``"maximum"``; by
            default that of the model, else that of the code to whose spectrum the motions are matched, else
            ``"maximum"``.
        report: true adds a run without contact for every record and, with a folder, its report.
        sensitivity: also runs every record with other contact stiffnesses and restitutions.
        jobs: number of records that run at the same time; by default one per core.
        progress: true shows a line on a terminal or a bar in a notebook; or a function called with the finished
            fraction and 1.
        force: replaces files in the folder that jostle did not write.

    Raises:
        ModelError: the model, one of its records or an argument is wrong.
        FileExistsError: the folder contains a file of such a name that jostle did not write.

    Examples:
        >>> import jostle
        >>> suite = jostle.run_suite("paper", motions=["el-centro-1940-ns", "nanjing-artificial"], report=False)
        >>> suite.records
        ['el-centro-1940-ns', 'nanjing-artificial']
    """
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs: must be at least 1, found {jobs}")
    model = Model.from_any(model)
    if motions is not None:
        model = model.changed(motion=list(motions))
    folder = None if out is None else Path(out)
    if folder is not None:
        os.makedirs(folder, exist_ok=True)
    line = _SuiteLine("records  ") if progress is True else contextlib.nullcontext()
    with line as shown:
        observer = shown or (progress if callable(progress) else None)
        core = _jostle.run_suite(
            model._core,
            None if folder is None else os.path.abspath(folder),
            governing,
            bool(report),
            bool(sensitivity),
            jobs,
            bool(force),
            observer,
        )
    suite = Suite._of(core, folder)
    for text in suite.summary["warnings"]:
        warnings.warn(text, JostleWarning, stacklevel=2)
    return suite
