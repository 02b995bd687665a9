"""Studies: many cases of one model, on all cores or on a cluster."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _jostle
from ._cluster import run_parts
from ._errors import ModelError, ModelWarning, StudyWarning
from ._answers import Answers
from ._model import Base as _Base
from ._model import Model
from ._progress import CountLine, Observer
from ._tree import text_of
from ._units import Quantity, in_si

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

class Study:
    """Many cases of one model: lists, ranges and distributions of any key of the model file.

    The table has one row per case and is bit-identical for any number of threads, processes, workers and interruptions.
    ``docs/studies.md`` describes the contents of a study.

    Args:
        model: the base model: a :class:`Model`, a model file, the name of a built-in model, or a tree.
        vary: keys that vary, as in ``[{"name": "gap", "path": "gap[0].width", "values": ["20 mm", "40 mm"]}]``; may
            be omitted for a model that lists several records.
        design: the design of the cases, as in ``{"kind": "latin-hypercube", "samples": 200, "seed": 1}``; by
            default every combination.
        title: title of its report.
        **wishes: ``histories``, ``without_contact``, ``fragility``, ``ida``, ``sensitivity`` and ``selection`` as in a study file.

    Raises:
        ModelError: all faults at once, each with its location.

    Examples:
        >>> import jostle
        >>> study = jostle.Study("paper", [{"name": "gap", "path": "gap[0].width", "values": ["20 mm", "40 mm"]}])
        >>> study.cases
        2
    """

    _core: _jostle.Study
    _recipe: tuple[str, str, bool, str, _Base | None, bool]

    def __init__(
        self,
        model: Model | str | os.PathLike[str] | Mapping[str, Any],
        vary: Iterable[Mapping[str, Any]] = (),
        *,
        design: Mapping[str, Any] | None = None,
        title: str = "Untitled study",
        **wishes: Any,
    ) -> None:
        tree: dict[str, Any] = {"title": title, **wishes}
        if factors := [dict(entry) for entry in vary]:
            tree["vary"] = factors
        if design is not None:
            tree["design"] = dict(design)
        base: _Base | None = None
        if isinstance(model, Model):
            base = model._base()
        elif isinstance(model, Mapping):
            tree["model"] = dict(model)
        else:
            tree["base"] = os.fspath(model)
        self._build("study", text_of(tree, "study"), True, os.getcwd(), base)

    def _build(
        self, name: str, text: str, is_json: bool, folder: str, base: _Base | None, any_build: bool = False
    ) -> None:
        self._recipe = (name, text, is_json, folder, base, any_build)
        self._core = _jostle.Study.read(name, text, is_json, folder, base, any_build)
        for warning in self._core.warnings:
            warnings.warn(warning, ModelWarning, stacklevel=3)

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], *, model: Model | None = None, any_build: bool = False
    ) -> Study:
        """Reads a study file, JSON if its name ends in ``.json``, else TOML.

        Args:
            path: the file.
            model: replaces the base model of the file.
            any_build: continues folders that another build of jostle started.
        """
        name = os.fspath(path)
        try:
            text = Path(name).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ModelError(f"{name}: cannot be read: {error}") from None
        study = cls.__new__(cls)
        folder = os.path.dirname(os.path.abspath(name))
        base = None if model is None else model._base()
        study._build(name, text, name.lower().endswith(".json"), folder, base, any_build)
        return study

    @classmethod
    def ready_made(cls, name: str, model: Model | str | os.PathLike[str] | Mapping[str, Any] = "paper") -> Study:
        """A ready-made study of a model, as ``jostle study NAME MODEL``.

        Args:
            name: ``"gap-sweep"``, ``"ida"``, ``"fragility"``, ``"sensitivity"``, ``"tornado"``, ``"table2"`` or ``"angles"``.
            model: the model, its file, the name of a built-in model, or a tree.

        Raises:
            ModelError: there is no such study, or the model has nothing to vary.
        """
        base = Model.from_any(model)._base()
        if name not in _jostle.ready_made_names():
            known = ", ".join(_jostle.ready_made_names())
            raise ModelError(f"name: there is no ready-made study {name!r}; there are {known}")
        text, notes = _jostle.ready_made(name, base)
        study = cls.__new__(cls)
        study._build(name, text, False, os.getcwd(), base)
        for note in notes:
            warnings.warn(note, ModelWarning, stacklevel=2)
        return study

    @property
    def title(self) -> str:
        """Title."""
        return self._core.title

    @property
    def varied(self) -> list[str]:
        """What varies, in sentences."""
        return self._core.varied

    @property
    def cases(self) -> int:
        """Number of cases."""
        return self._core.cases

    @property
    def seed(self) -> int:
        """Random seed."""
        return self._core.seed

    @property
    def columns(self) -> list[str]:
        """Names of the columns of the table; they contain units."""
        return self._core.columns

    def run(
        self,
        out: str | os.PathLike[str],
        *,
        jobs: int | None = None,
        shard: tuple[int, int] | None = None,
        client: Any = None,
        progress: bool | Observer = False,
        report: bool = True,
        csv: bool = False,
    ) -> StudyResult:
        """Runs the unfinished cases of a folder. The same call resumes after any interruption.

        Ctrl-C raises ``KeyboardInterrupt`` within a second; finished cases are kept. Finished parts are verified: a part
        that is damaged or belongs to another study is moved to ``set-aside`` with a ``StudyWarning``, and computed
        again.

        Args:
            out: folder of the results; with a client, one that all workers can access.
            jobs: threads; by default one per core. No effect with a client.
            shard: ``(i, n)`` computes the i-th of n equal shares, i from 1; all may use one folder.
            client: a ``dask.distributed.Client``: its workers compute the parts of the table. If a worker
                dies, another one continues its part after the last finished case.
            progress: true shows a line on a terminal or a bar in a notebook; or a function called with
                the numbers of finished cases and of all cases.
            report: true writes the report and its tables when all cases are finished.
            csv: true writes ``cases.csv`` even for more than 200 000 cases.

        Raises:
            ModelError: the folder contains another study, or an argument is wrong.
            OSError: a file cannot be written; finished cases are kept.
        """
        folder = os.path.abspath(os.fspath(out))
        observer = None if isinstance(progress, bool) else progress
        with CountLine("cases") if progress is True else contextlib.nullcontext() as line:
            observer = observer if line is None else line
            if client is not None:
                if shard is not None:
                    raise ModelError("shard: does not go with a client, which shares the work by itself")
                self._run_on(client, folder, observer)
            else:
                index, of = (1, 1) if shard is None else shard
                if not 1 <= index <= of:
                    raise ModelError(f"shard: expected (i, n) with i from 1 to n, found {shard}")
                if jobs is not None and jobs < 1:
                    raise ModelError(f"jobs: must be at least 1, found {jobs}")
                self._core.run(folder, jobs, index - 1, of, observer, _remark)
        result = StudyResult(self, Path(folder))
        if report and result.complete:
            self._core.finish(folder, csv)
        return result

    def _run_on(self, client: Any, folder: str, observer: Observer | None) -> None:
        """Submits every missing part to the workers of a client."""

        def told(done: int, parts: int) -> None:
            if observer is not None:
                observer(self.cases * done / parts, float(self.cases))

        run_parts(client, self._core, folder, _compute, pickle.dumps(self), f"jostle-{id(self)}", told)
        # Nothing is left to compute: moves files of others aside, and makes runs of single cases that are missing.
        self._core.run(folder, 1, remark=_remark)

    def run_case(self, case: int, out: str | os.PathLike[str]) -> Path:
        """Runs one case with its histories and report into a folder, and returns the path of the report."""
        self._core.run_case(case, os.fspath(out))
        return Path(out) / "report.html"

    def __repr__(self) -> str:
        return f"<Study {self.title!r}: {self.cases} cases>"

    def _repr_html_(self) -> str:
        from ._draw import study_html

        return study_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, self._recipe)


@dataclass(frozen=True)
class StudyResult:
    """The folder of a study.

    ``polars.read_parquet(result.parts)``, ``pandas.read_parquet(result.folder / "cases")`` and DuckDB's
    ``FROM 'folder/cases/*.parquet'`` read the whole table.

    Attributes:
        study: the study.
        folder: its folder.

    Examples:
        >>> import jostle
        >>> study = jostle.Study("paper", [{"name": "gap", "path": "gap[0].width", "values": ["20 mm", "150 mm"]}])
        >>> result = study.run("out", report=False)
        >>> (result["impact_count"] > 0).tolist()
        [True, False]
    """

    study: Study
    folder: Path

    @property
    def complete(self) -> bool:
        """Whether every case is finished."""
        return not self.study._core.missing(os.fspath(self.folder))

    @property
    def parts(self) -> str:
        """The files of the table as a pattern."""
        return os.fspath(self.folder / "cases" / "*.parquet")

    @property
    def report(self) -> Path:
        """The report."""
        return self.folder / "report.html"

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """A column case by case: floats in SI, NaN where absent, or texts as objects."""
        import numpy as np

        if name not in self.study.columns:
            raise KeyError(f"{name!r}; the columns are {', '.join(self.study.columns)}")
        numbers, texts = self.study._core.read_columns(os.fspath(self.folder), [name])
        if name in texts:
            return np.array(texts[name], dtype=object)
        return np.array(numbers[name], dtype=float)

    def _repr_html_(self) -> str:
        from ._draw import study_result_html

        return study_result_html(self)

    def to_pandas(self) -> Any:
        """The table as a ``pandas.DataFrame``."""
        pandas: Any = import_module("pandas")
        return pandas.read_parquet(self.folder / "cases")

    def to_polars(self) -> Any:
        """The table as a ``polars.DataFrame``."""
        polars: Any = import_module("polars")
        return polars.read_parquet(self.parts)


@dataclass(frozen=True)
class WorstAngle:
    """The angle of incidence at which a quantity is greatest.

    Attributes:
        quantity: column of the table.
        angle: from x to the motion, counter-clockwise [rad].
        value: the greatest value [SI].
        case: number of its case.

    Examples:
        >>> import jostle
        >>> def tower(name, x):
        ...     plan = [[x, 0], [x + 12, 0], [x + 12, 8], [x, 8]]
        ...     stiffness = {"x": "60 MN/m", "y": "50 MN/m", "torsion": "4 GN.m"}
        ...     return jostle.Shear(name, mass=["90 t"], stiffness=[stiffness], storey_height="3 m", plan=plan)
        >>> model = jostle.Model([tower("A", 0.0), tower("B", 12.02)], jostle.Gap(), motion=jostle.Motion.el_centro().lasting("5 s"))
        >>> angles = jostle.angles(model, "out", step="90 deg", report=False)
        >>> worst = angles.worst("peak_force_n")
        >>> worst.quantity
        'peak_force_n'
    """

    quantity: str
    angle: float
    value: float
    case: int


@dataclass(frozen=True)
class AngleStudy(StudyResult):
    """The folder of a study over the angle of incidence.

    Examples:
        >>> import jostle
        >>> def tower(name, x):
        ...     plan = [[x, 0], [x + 12, 0], [x + 12, 8], [x, 8]]
        ...     stiffness = {"x": "60 MN/m", "y": "50 MN/m", "torsion": "4 GN.m"}
        ...     return jostle.Shear(name, mass=["90 t"], stiffness=[stiffness], storey_height="3 m", plan=plan)
        >>> model = jostle.Model([tower("A", 0.0), tower("B", 12.02)], jostle.Gap(), motion=jostle.Motion.el_centro().lasting("5 s"))
        >>> angles = jostle.angles(model, "out", step="90 deg", report=False)
        >>> angles.worst("peak_force_n").case in range(4)
        True
    """

    @property
    def angle(self) -> npt.NDArray[np.float64]:
        """The angle of every case, from x to the motion, counter-clockwise [rad]."""
        return cast("npt.NDArray[np.float64]", self["angle_rad"])

    def worst(self, quantity: str = "peak_force_n") -> WorstAngle:
        """The first angle with the greatest value of a column, such as ``"A.base_torque_peak_n_m"``.

        Raises:
            ValueError: the column is a text, or empty.
        """
        import numpy as np

        values = self[quantity]
        if values.dtype == object or not np.isfinite(values).any():
            raise ValueError(f"{quantity}: there are no numbers to compare")
        case = int(np.nanargmax(values))
        return WorstAngle(quantity, float(self.angle[case]), float(values[case]), case)


def angles(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str],
    *,
    step: Quantity = "5 deg",
    start: Quantity = 0.0,
    stop: Quantity | None = None,
    quantities: Sequence[str] = (),
    jobs: int | None = None,
    progress: bool | Observer = False,
    report: bool = True,
) -> AngleStudy:
    """Runs a model with plans at many angles of incidence, with and without contact, as ``jostle study angles``.

    The same call resumes after any interruption. The report plots quantities over the angle (roses).

    Args:
        model: the model, or a model file.
        out: folder of the results.
        step: step between angles, > 0: ``"10 deg"``, or radians.
        start: first angle, from x counter-clockwise.
        stop: last angle; by default a full circle, which ends one step before the first angle.
        quantities: columns to draw; by default forces, impacts and peaks of buildings.
        jobs: threads; by default one per core.
        progress: true shows a line or a bar; or a function called with the numbers of finished cases and of all cases.
        report: true writes the report and its tables.

    Raises:
        ModelError: the model is wrong or has no plans; the range is empty.
        OSError: a file cannot be written; finished cases are kept.

    Examples:
        >>> import jostle
        >>> def tower(name, x):
        ...     plan = [[x, 0], [x + 12, 0], [x + 12, 8], [x, 8]]
        ...     stiffness = {"x": "60 MN/m", "y": "50 MN/m", "torsion": "4 GN.m"}
        ...     return jostle.Shear(name, mass=["90 t"], stiffness=[stiffness], storey_height="3 m", plan=plan)
        >>> model = jostle.Model([tower("A", 0.0), tower("B", 12.02)], jostle.Gap(), motion=jostle.Motion.el_centro().lasting("5 s"))
        >>> angles = jostle.angles(model, "out", step="90 deg", report=False)
        >>> len(angles.angle)
        4
    """
    import math

    def degrees(name: str, value: Quantity) -> float:
        return math.degrees(in_si(name, value, "number"))

    model = Model.from_any(model)
    first = degrees("start", start)
    last = first + 360.0 if stop is None else degrees("stop", stop)
    base = model._base()
    text, notes = _jostle.incidence(base, first, last, degrees("step", step), list(quantities))
    study = Study.__new__(Study)
    study._build("angles", text, False, os.getcwd(), base)
    for note in notes:
        warnings.warn(note, ModelWarning, stacklevel=2)
    done = study.run(out, jobs=jobs, progress=progress, report=report)
    return AngleStudy(study, done.folder)


@dataclass(frozen=True)
class RuleGap:
    """The gap that a rule requires, and the outcome with this gap.

    Attributes:
        rule: short name.
        source: source of the rule.
        gap: width [m].
        impact_count: impacts at this gap; ``None`` without a run.
        peak_force: greatest force at this gap [N].
        code: name of the code as in ``[codes]``; ``None`` for general rules.
        inputs: inputs that the rule used, with defaults marked.
        setbacks: distances of both buildings from the property line between them [m], for rules about property lines.

    Examples:
        >>> import jostle
        >>> (gap,) = jostle.critical_gap("paper", outcomes=False, tolerance="1 mm", codes=["en1998"])
        >>> [rule.rule for rule in gap.rules]
        ['ABS', 'SRSS', '0.7 SRSS', 'DDC', 'EN 1998-1']
    """

    rule: str
    source: str
    gap: float
    impact_count: int | None
    peak_force: float | None
    code: str | None = None
    inputs: tuple[str, ...] = ()
    setbacks: tuple[float, float] | None = None


@dataclass(frozen=True)
class GapPoint:
    """Results for one width of a gap.

    Attributes:
        width: width [m].
        impact_count: impacts in the gap.
        peak_force: greatest contact force in the gap [N].
        first_impact: time of the first impact [s]; ``None`` if there is none.
        met: whether the run met its tolerance; ``None`` without an estimate.

    Examples:
        >>> import jostle
        >>> (gap,) = jostle.critical_gap("paper", outcomes=False, tolerance="1 mm", curve=3)
        >>> [point.impact_count > 0 for point in gap.curve]
        [True, True, False]
    """

    width: float
    impact_count: int
    peak_force: float
    first_impact: float | None
    met: bool | None


@dataclass(frozen=True)
class CriticalGap:
    """The gap needed between two neighbours under one motion.

    Attributes:
        between: names of the neighbours.
        motion: name of the motion.
        pga: peak acceleration of the motion [m/s²].
        gap: smallest gap found without an impact [m].
        pounding_at: widest tested gap with an impact; ``None`` if there is no impact even at a gap of zero [m].
        closing_without_contact: peak closing of the buildings without contact [m].
        rules: gaps required by rules and codes.
        left_out: rules that cannot be applied, and the keys of ``[codes]`` that they need.
        curve: force and impacts over the gap, from zero to the gap needed for both signs; empty unless requested.
        reversed_gap: smallest gap without an impact under the motion with the other sign [m].
        reversed_curve: ``curve`` under the motion with the other sign.
        gap_at_bounds: smallest gap without an impact at the lower and at the upper bounds of the bearings, the larger of the two
            signs; ``None`` if the model states no bounds [m].

    Examples:
        >>> import jostle
        >>> (gap,) = jostle.critical_gap("paper", outcomes=False, tolerance="1 mm")
        >>> gap.between, round(gap.gap, 3)
        (('J1', 'J2'), 0.137)
    """

    between: tuple[str, str]
    motion: str
    pga: float
    gap: float
    pounding_at: float | None
    closing_without_contact: float
    rules: tuple[RuleGap, ...]
    left_out: tuple[tuple[str, str], ...] = ()
    curve: tuple[GapPoint, ...] = ()
    reversed_gap: float | None = None
    reversed_curve: tuple[GapPoint, ...] = ()
    gap_at_bounds: tuple[float, float] | None = None

    def _repr_html_(self) -> str:
        from ._draw import gap_html

        return gap_html(self)


def critical_gap(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    *,
    motions: Sequence[Any] | None = None,
    pga: Quantity | None = None,
    tolerance: Quantity = 1e-4,
    system: str | None = None,
    codes: Sequence[str] = (),
    outcomes: bool = True,
    curve: int = 0,
) -> Answers[CriticalGap]:
    """Returns the gap needed, found by bracketing, and compares it with ABS, SRSS, DDC and codes.

    Args:
        model: the model, or a model file.
        motions: ground motions, or names or paths of records; by default those of the model.
        pga: scales every motion to this peak [m/s², or a text with a unit].
        tolerance: width of the final bracket, ≥ 1e-9 [m].
        system: structural system for GB 50011: ``frame``, ``frame-wall``, ``wall`` or ``steel-frame``; by default that of
            ``[codes]`` in the model file.
        codes: codes whose rules are listed, such as ``["en1998", "asce7"]``; by default those of ``[codes]``, else all.
        outcomes: true also runs the model with the gap of every rule.
        curve: number of equally spaced widths, from zero to the gap needed, at which force and impacts are also computed, 2 to
            10000; 0 for none.

    Returns:
        One entry for every gap of the model and every motion.

    Raises:
        ModelError: model, motion or an argument is wrong.
        AnalysisError: a run failed.

    Examples:
        >>> import jostle
        >>> (gap,) = jostle.critical_gap("paper", outcomes=False, tolerance="1 mm")
        >>> gap.gap < gap.closing_without_contact + 0.002
        True
    """
    if curve and not 2 <= curve <= 10000:
        raise ModelError(f"curve: must be 0 or 2 to 10000, found {curve}")
    model = Model.from_any(model)
    width = in_si("tolerance", tolerance, "length")
    found: Answers[CriticalGap] = Answers()
    own: Sequence[str | None] = model.records or [None]
    for motion in own if motions is None else motions:
        one = model
        if motion is not None or pga is not None:
            one = model.changed(motion=motion, pga=pga)
        for gap in json.loads(_jostle.critical_gaps(one._core, width, system, list(codes), outcomes, curve)):
            rules = tuple(
                RuleGap(
                    rule["rule"],
                    rule["source"],
                    rule["gap_m"],
                    rule["impact_count"],
                    rule["peak_force_n"],
                    rule["code"],
                    tuple(rule["inputs"]),
                    None if rule["setbacks_m"] is None else cast("tuple[float, float]", tuple(rule["setbacks_m"])),
                )
                for rule in gap["rules"]
            )
            found.append(
                CriticalGap(
                    cast("tuple[str, str]", tuple(gap["between"])),
                    gap["motion"],
                    gap["pga_m_s2"],
                    gap["gap_m"],
                    gap["pounding_at_m"],
                    gap["closing_without_contact_m"],
                    rules,
                    tuple((rule["rule"], rule["needs"]) for rule in gap["left_out"]),
                    _points(gap.get("curve", ())),
                    gap["reversed_gap_m"],
                    _points(gap.get("reversed_curve", ())),
                    cast("tuple[float, float] | None", tuple(gap["gap_at_bounds_m"]) if "gap_at_bounds_m" in gap else None),
                )
            )
    return found


def _points(curve: Sequence[Mapping[str, Any]]) -> tuple[GapPoint, ...]:
    """Points of a curve over the gap."""
    names = ("width_m", "impact_count", "peak_force_n", "first_impact_s", "met")
    return tuple(GapPoint(*(point[name] for name in names)) for point in curve)


#: The study that this process computes parts of, by its bytes.
_shared: dict[bytes, Study] = {}


def _read_study(share: bytes) -> Study:
    """A study from its bytes, read once by every process."""
    if share not in _shared:
        _shared.clear()
        _shared[share] = pickle.loads(share)
    return _shared[share]


def _compute(share: bytes, folder: str, part: int) -> int:
    """One part, on a worker, which looks at no other file of the folder."""
    return _read_study(share)._core.run(folder, 1, remark=_remark, only=part)[1]


def _remark(text: str) -> None:
    """Issues a warning about the folder of a study."""
    import warnings

    warnings.warn(text, StudyWarning, stacklevel=4)


def _rebuild(
    name: str, text: str, is_json: bool, folder: str, base: _Base | None, any_build: bool = False
) -> Study:
    study = Study.__new__(Study)
    study._recipe = (name, text, is_json, folder, base, any_build)
    study._core = _jostle.Study.read(name, text, is_json, folder, base, any_build)
    return study
