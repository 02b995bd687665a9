"""Models: buildings in a row, the gaps and links between them, and the ground motion."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _jostle
from ._builders import Building, Gap, Link, Part, Soil, Table, Wall
from ._errors import MissingFileError, ModelError, ModelWarning
from ._motion import Motion
from ._tree import text_of, value_text
from ._units import Quantity, RunUnits, argument, in_si, refuse

if TYPE_CHECKING:
    from ._check import Check
    from ._export import Script
    from ._live import LiveWidget
    from ._matrices import Matrices
    from typing_extensions import Unpack

    import numpy as np
    import numpy.typing as npt


#: Name, text, whether it is JSON, folder, and files in memory by name.
Base = tuple[str, str, bool, str, dict[str, str]]
#: Keys of ``[motion]`` that say which motion it is and how it is scaled.
_OF_MOTION = (
    "record", "kind", "amplitude", "period", "centre", "unit", "step", "column", "component", "format", "record_scale",
    "remove_mean", "read", "pga", "scale", "match", "reverse", "duration", "angle", "across",
)  # fmt: skip


class Model:
    """Buildings from left to right, the gaps between them, a ground motion and settings of the analysis.

    A model is immutable; several threads may share it, and it can be pickled.

    Args:
        buildings: from left to right; tables of the model file are accepted as well.
        gaps: one for each pair of neighbours, or one for all pairs. ``between`` may be omitted, unless there are gaps next
            to walls or several gaps for one pair.
        links: springs and dampers that join neighbours.
        walls: walls beside buildings, to which gaps and links can refer.
        soil: soil under buildings with a foundation.
        motion: a :class:`Motion`, the name or path of a record, or ``[motion]`` of the model file.
        title: printed on summaries and reports.
        analysis: ``[analysis]`` of the model file: ``{"tolerance": 1e-4, "solver": "stiffness"}``.
        output: ``[output]`` of the model file: ``{"members": True}`` for forces of columns and beams,
            ``{"capacity": "gb50010"}`` for their demand over capacity, ``{"links": True}`` for strokes and speeds of links.
        codes: ``[codes]`` of the model file: ``{"show": ["en1998"], "behaviour_factor": 3.9}``.

    Raises:
        ModelError: all faults at once, with the message of the command line.

    Examples:
        >>> import jostle
        >>> tower = jostle.Shear("A", mass="40 t", stiffness="60 MN/m", storeys=2, storey_height="3 m")
        >>> model = jostle.Model([tower], motion=jostle.Motion.el_centro(), title="A tower")
        >>> model.set("building.A.mass", "50 t").buildings
        ['A']
    """

    _core: _jostle.Model
    _recipe: tuple[Any, ...]

    def __init__(
        self,
        buildings: Building | Sequence[Building],
        gaps: Gap | Table | Sequence[Gap | Table] = (),
        *,
        links: Link | Table | Sequence[Link | Table] = (),
        walls: Wall | Table | Sequence[Wall | Table] = (),
        soil: Soil | Table | None = None,
        motion: Motion | str | os.PathLike[str] | Table | None = None,
        title: str | None = None,
        analysis: Table | None = None,
        output: Table | None = None,
        codes: Table | None = None,
    ) -> None:
        row = [buildings] if isinstance(buildings, (Part, Mapping)) else buildings
        tree: dict[str, Any] = {"building": [_table(building) for building in row]}
        tree["gap"] = _gaps(gaps, tree["building"])
        joined = [links] if isinstance(links, (Part, Mapping)) else links
        tree["link"] = [_table(link) for link in joined]
        if walls:
            listed = [walls] if isinstance(walls, (Part, Mapping)) else walls
            tree["wall"] = [_table(wall) for wall in listed]
        if soil is not None:
            tree["soil"] = _table(soil)
        if title is not None:
            tree["title"] = title
        if analysis is not None:
            tree["analysis"] = analysis
        if output is not None:
            tree["output"] = output
        if codes is not None:
            tree["codes"] = codes
        if isinstance(motion, (str, os.PathLike)):
            tree["motion"] = {"record": motion}
        elif motion is not None and not isinstance(motion, Motion):
            tree["motion"] = motion
        given = motion if isinstance(motion, Motion) else None
        self._build("read", ("model", text_of(tree), True, os.getcwd(), False, None), given)

    def _build(self, how: str, arguments: tuple[Any, ...], motion: Motion | None = None) -> None:
        core = getattr(_jostle.Model, how)(*arguments)
        for text in core.warnings:
            warnings.warn(text, ModelWarning, stacklevel=3)
        self._recipe = (how, arguments, motion, None, None, None, None)
        self._core = core if motion is None else core.changed(motion=motion._core)

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, accept_unusual: bool = False) -> Model:
        """Reads a model file: JSON if its name ends in ``.json``, else TOML.

        Args:
            path: the file.
            accept_unusual: accepts values outside their usual ranges, as ``accept_unusual = true`` of the file.

        Raises:
            MissingFileError: there is no such file; a ``ModelError`` and a ``FileNotFoundError``.
            ModelError: all faults of the file at once, each with its line and a remedy.
        """
        name = os.fspath(path)
        is_json = name.lower().endswith(".json")
        if accept_unusual and os.path.isfile(name):
            with open(name, encoding="utf-8-sig") as file:
                folder = os.path.dirname(os.path.abspath(name))
                base: Base = (name, file.read(), is_json, folder, {})
            return cls._read(base, [("analysis.accept_unusual", "true")])
        model = cls.__new__(cls)
        try:
            model._build("load", (name,))
        except ModelError as error:
            if os.path.lexists(name):
                raise
            raise MissingFileError(str(error), name, error.args[1]) from None
        # A pickled model brings its text along; the records stay where they are.
        text, folder = model._core.text, os.path.dirname(os.path.abspath(name))
        model._recipe = ("read", (name, text, is_json, folder, True, None), None, None, None, None, None)
        return model

    @classmethod
    def from_any(cls, model: Model | str | os.PathLike[str] | Mapping[str, Any]) -> Model:
        """Returns a model from a model, a model file, a built-in name such as ``"paper"``, or a tree.

        A file takes precedence over a built-in model of the same name, as on the command line.

        Raises:
            MissingFileError: neither a file nor a built-in name.
            ModelError: all faults of the model at once.
        """
        if isinstance(model, Model):
            return model
        if isinstance(model, Mapping):
            return cls.from_dict(model)
        if isinstance(model, str) and not os.path.exists(model):
            try:
                return cls.example(model)
            except ModelError:
                pass  # no built-in name: what Model.load says of the file is the better message
        return cls.load(model)

    @classmethod
    def of(cls, model: Model | str | os.PathLike[str] | Mapping[str, Any]) -> Model:
        """Deprecated: the former name of :meth:`from_any`."""
        warnings.warn("Model.of is now Model.from_any", DeprecationWarning, stacklevel=2)
        return cls.from_any(model)

    @classmethod
    def loads(cls, text: str, *, name: str = "model", folder: str | os.PathLike[str] = "") -> Model:
        """Reads the text of a model file, TOML, or JSON if it begins with a brace.

        Args:
            text: the text.
            name: name for messages.
            folder: folder of the records; the current folder by default.
        """
        if not isinstance(text, str):
            raise TypeError(f"text: expected a text, found {type(text).__name__}")
        is_json = text.lstrip().startswith("{")
        model = cls.__new__(cls)
        model._build("read", (name, text, is_json, os.path.abspath(folder), True, None))
        return model

    @classmethod
    def from_dict(cls, tree: Mapping[str, Any], *, folder: str | os.PathLike[str] = "") -> Model:
        """A model from the tree of a model file, as ``tomllib`` or ``json`` read it; NumPy arrays are lists.

        Args:
            tree: the tree, as in ``{"building": [{"kind": "shear", "mass": "40 t", …}], "gap": […]}``.
            folder: folder of the records; the current folder by default.
        """
        model = cls.__new__(cls)
        model._build("read", ("model", text_of(tree), True, os.path.abspath(folder), False, None))
        return model

    @classmethod
    def paper_example(cls) -> Model:
        """The five- and ten-storey frames of Zhang et al. (2019), 100 mm apart, under El Centro at 220 cm/s²."""
        model = cls.__new__(cls)
        model._build("builtin", ("paper",))
        return model

    @classmethod
    def example(cls, name: str) -> Model:
        """A built-in model by its name: ``"paper"``, or ``"paper-inelastic"``, whose frames crack and yield."""
        model = cls.__new__(cls)
        model._build("builtin", (name,))
        return model

    def matrices(self, building: str | int = 0) -> Matrices:
        """Mass, damping and stiffness of an elastic building, as used by time steps.

        Args:
            building: name or index.

        Raises:
            ModelError: the building may yield.
        """
        from ._matrices import of_model

        return of_model(self, building)

    def changed(
        self,
        *,
        gap: Quantity | None = None,
        pga: Quantity | None = None,
        motion: Motion | str | os.PathLike[str] | Sequence[Motion | str | os.PathLike[str]] | None = None,
        angle: Quantity | None = None,
        **units: Unpack[RunUnits],
    ) -> Model:
        """Returns the model with another width of every gap, peak acceleration, ground motion or angle of the motion.

        Args:
            gap: width of every gap, a length ≥ 0; also ``gap_mm=20``.
            pga: scales the ground motion to this peak, > 0; also ``pga_g=0.2``.
            motion: a :class:`Motion` is used as it is; a record by name or path keeps the scaling of the model,
                as on the command line. A list of one or the other gives a model with several records, for
                :func:`run_suite`, :func:`critical_gap` and :class:`Study`; analytic motions are then converted to records.
            angle: angle in plan from x to the motion, counter-clockwise, of buildings with a plan: ``"30 deg"``, or
                radians.

        Raises:
            ModelError: there is nothing to change, or a value is out of range.
        """
        extra: dict[str, Any] = dict(units)
        width = argument("gap", gap, "length", extra)
        peak = argument("pga", pga, "acceleration", extra)
        turn = None if angle is None else in_si("angle", angle, "number")
        refuse("changed", extra, ["gap", "pga", "motion", "angle", *RunUnits.__annotations__])
        if motion is not None and not isinstance(motion, (Motion, str, os.PathLike)):
            several = self._with_records(list(motion))
            rest: dict[str, Any] = {"gap": width, "pga": peak, "angle": turn}
            rest = {name: value for name, value in rest.items() if value is not None}
            return several.changed(**rest) if rest else several
        given = motion if isinstance(motion, Motion) else None
        record = None if motion is None or given is not None else os.fspath(cast(str, motion))
        model = type(self).__new__(type(self))
        model._core = self._core.changed(
            gap=width, pga=peak, motion=None if given is None else given._core, record=record, angle=turn
        )
        model._recipe = (self._recipe, (), given, width, peak, record, turn)
        return model

    def set(self, path: str, value: object) -> Model:
        """Returns the model with one value of its model file changed.

        Args:
            path: ``"gap[0].width"``, ``"gap[*].width"``, ``"building.J1.damping.ratio"``, ``"output.members"``, … as in
                studies; missing tables are created.
            value: text with unit, number in SI, flag, list, dict, NumPy array or pint quantity; ``None`` removes the key.

        Raises:
            ModelError: the path does not exist, or the value is wrong.
        """
        if not isinstance(path, str):
            raise TypeError(f"path: expected a text, found {type(path).__name__}")
        return self._read(self._base(), [(path, None if value is None else value_text(value, path))])

    @classmethod
    def _read(cls, base: Base, edits: Sequence[tuple[str, str | None]] = ()) -> Model:
        """The model of a text, with values put in."""
        name, text, is_json, folder, files = base
        if edits:
            text = _jostle.rewritten(base, list(edits))
        model = cls.__new__(cls)
        model._build("read", (name, text, is_json, folder, False, files))
        return model

    def _base(self) -> Base:
        """The model with all its changes as the text of a model file, and its motions as files in memory."""
        how, arguments, motion, gap, pga, record, angle = self._recipe
        if isinstance(how, tuple):
            base = _rebuild(*how)._base()
        elif how == "builtin":
            base = (str(arguments[0]), self._core.text, False, "", {})
        else:
            name, text, is_json, folder, _, files = arguments
            base = (name, text, is_json, folder, dict(files or {}))
        edits: list[tuple[str, str | None]] = []
        if gap is not None:
            for at, widths in enumerate(self._core.widths()):
                edits.append((f"gap[{at}].width", json.dumps(widths[0] if len(widths) == 1 else widths)))
        if motion is not None:
            table, files = motion._as_table(set(base[4]))
            base[4].update(files)
            edits += [(f"motion.{key}", None) for key in _OF_MOTION]
            edits += [(f"motion.{key}", json.dumps(value)) for key, value in table.items()]
        if record is not None:
            edits.append(("motion.record", json.dumps(_placed(record))))
        if pga is not None:
            edits.append(("motion.pga", json.dumps(pga)))
        if angle is not None:
            edits.append(("motion.angle", json.dumps(angle)))
        if not edits:
            return base
        return (base[0], _jostle.rewritten(base, edits), *base[2:])

    def _with_records(self, motions: Sequence[Motion | str | os.PathLike[str]]) -> Model:
        """The model with a list of records."""
        if not motions:
            raise ModelError("motion: the list is empty")
        base = self._base()
        own = [motion for motion in motions if isinstance(motion, Motion)]
        if own and len(own) != len(motions):
            raise ModelError("motion: give either Motion objects or records by name; Motion.read(name) reads a record")
        names: list[str] = []
        edits: list[tuple[str, str | None]] = []
        for motion in motions:
            if isinstance(motion, Motion):
                table, files = motion._baked()._as_table(set(base[4]))
                base[4].update(files)
                names.append(table["record"])
            else:
                names.append(_placed(os.fspath(motion)))
        if own:
            edits = [(f"motion.{key}", None) for key in _OF_MOTION if key not in ("angle", "across")]
        edits.append(("motion.record", json.dumps(names)))
        return self._read(base, edits)

    def to_toml(self) -> str:
        """The text of the model as a model file in TOML, with all its changes; comments of a TOML file are kept.

        A :class:`Motion` object of the model is named there as a record; :meth:`save` writes that file.
        """
        return _jostle.as_toml(self._base())

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the model as a TOML file, and next to it the records and matrices that the model names.

        Args:
            path: the file, ``.toml``.
            force: true replaces files that exist.

        Returns:
            The path.

        Raises:
            FileExistsError: a file exists; nothing is written.
        """
        target = Path(path)
        if target.suffix.lower() == ".json":
            raise ModelError(f"{target}: models are saved as TOML; name the file {target.with_suffix('.toml').name}")
        base = self._base()
        files = {name: text.encode() for name, text in base[4].items()}
        folder = Path(base[3])
        for name in _jostle.named_files(base):
            source = folder / name
            if name in files or os.path.isabs(name) or not source.is_file() or folder == target.parent.absolute():
                continue
            if ".." in Path(name).parts:
                raise ModelError(f"{name}: a file outside the folder of the model; set its absolute path before saving")
            files[name] = source.read_bytes()
        written = {target: _jostle.as_toml(base).encode(), **{target.parent / name: data for name, data in files.items()}}
        for place, data in written.items():
            if not force and place.exists() and place.read_bytes() != data:
                raise FileExistsError(f"{place} exists already; pass force=True to replace it")
        for place, data in written.items():
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(data)
        return target

    def check(self) -> Check:
        """Checks the model without running it: masses, periods, contacts, findings, expected work.

        Raises:
            ModelError: the ground motion cannot be used, or a run would lose all digits.
        """
        from ._check import Check

        return Check(json.loads(self._core.check()))

    def export(self, path: str | os.PathLike[str] | None = None, *, to: str = "openseespy", force: bool = False) -> Script:
        """The model for another program: a script for OpenSeesPy, or NumPy archives of matrices.

        Args:
            path: file for the script, or folder for the matrices; required for matrices.
            to: ``"openseespy"`` or ``"matrices"``.
            force: true replaces files that jostle did not write.

        Raises:
            ModelError: the other program does not support some fields of the model, which the message lists.
            FileExistsError: a file exists and jostle did not write it.
        """
        from ._export import export

        return export(self, path, to, force)

    @property
    def title(self) -> str:
        """Title."""
        return self._core.title

    @property
    def warnings(self) -> list[str]:
        """Warnings about valid but unusual values."""
        return self._core.warnings

    @property
    def records(self) -> list[str]:
        """The records of a model that lists several; empty otherwise.

        A run uses one of them, ``model.changed(motion=name)``; a study and :func:`critical_gap` use all.
        """
        return self._core.records

    @property
    def motion(self) -> Motion | None:
        """The ground motion as it will be used; ``None`` if the model has none.

        Raises:
            ModelError: the record cannot be read or scaled, or the model lists several.
        """
        core = self._core.motion()
        return None if core is None else Motion._of(core)

    @property
    def description(self) -> dict[str, Any]:
        """Buildings, gaps and links in numbers: geometry, masses, periods, contacts; names contain units."""
        return cast("dict[str, Any]", json.loads(self._core.describe()))

    @property
    def buildings(self) -> list[str]:
        """Names of the buildings from left to right."""
        return [building["name"] for building in self.description["buildings"]]

    def periods(self, building: str | int = 0) -> npt.NDArray[np.float64]:
        """Periods of the lateral modes of a building, by name or position, longest first [s]."""
        import numpy as np

        from ._result import position

        at = position(building, self.buildings)
        return np.array(self.description["buildings"][at]["periods_s"])

    def live(self) -> LiveWidget:
        """The live page of this model as a widget of a Jupyter notebook.

        The model is run after every change, in this process. ``widget.values["gap"] = "30 mm"`` changes a value from
        Python, and ``widget.result`` is the :class:`Result` of the current model.

        Raises:
            ImportError: ``anywidget`` is missing; ``pip install "jostle[live]"`` installs it.
        """
        from ._live import widget

        return widget(self)

    def __repr__(self) -> str:
        return f"<Model {self.title!r}: {', '.join(self.buildings)}>"

    def _repr_html_(self) -> str:
        from ._draw import model_html

        return model_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, self._recipe)


def _rebuild(
    how: str | tuple[Any, ...],
    arguments: tuple[Any, ...],
    motion: Motion | None,
    gap: float | None,
    pga: float | None,
    record: str | None,
    angle: float | None = None,
) -> Model:
    model = Model.__new__(Model)
    if isinstance(how, tuple):
        core = _rebuild(*how)._core
    else:
        core = getattr(_jostle.Model, how)(*arguments)
    given = None if motion is None else motion._core
    model._core = core.changed(gap=gap, pga=pga, motion=given, record=record, angle=angle)
    model._recipe = (how, arguments, motion, gap, pga, record, angle)
    return model


def _placed(record: str) -> str:
    """A record from anywhere: its absolute path, or a built-in name as it is."""
    return os.path.abspath(record) if os.path.exists(record) else record


def _table(part: object) -> object:
    return part.to_dict() if isinstance(part, Part) else part


def _gaps(gaps: Gap | Table | Sequence[Gap | Table], buildings: list[Any]) -> list[Any]:
    """Tables of the gaps; those without names belong to neighbours in order."""
    tables: list[Any]
    if isinstance(gaps, (Part, Mapping)):
        one = _table(gaps)
        named = isinstance(one, Mapping) and "between" in one
        tables = [one] if named else [one] * max(len(buildings) - 1, 1)
    else:
        tables = [_table(gap) for gap in gaps]
    unnamed = all(isinstance(table, Mapping) and "between" not in table for table in tables)
    if not tables or not unnamed or len(tables) != len(buildings) - 1:
        return tables
    names = [
        building.get("name", f"B{i + 1}") if isinstance(building, Mapping) else f"B{i + 1}"
        for i, building in enumerate(buildings)
    ]
    return [{"between": names[i : i + 2], **dict(table)} for i, table in enumerate(tables)]
