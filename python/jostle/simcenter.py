"""A building of a jostle model as the structural model of a SimCenter workflow (R2DTool, EE-UQ): ``CustomPy``.

The main script of the workflow is one line, ``from jostle.simcenter import custom_analysis``. It runs the model that the inventory
names under the motion of the event, with its neighbours, and returns the demands of one building::

    id,Latitude,Longitude,NumberOfStories,…,JostleModel,JostleBuilding
    1,38.09,15.48,5,…,C:/models/pair.toml,J1
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ._errors import JostleWarning, ModelError
from ._model import Model
from ._motion import Motion
from ._run import run

__all__ = ["custom_analysis"]

#: Units of length of SimCenter [m].
_LENGTHS = {
    "m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "in": 0.0254, "inch": 0.0254, "ft": 0.3048, "mile": 1609.344,
}  # fmt: skip
#: Direction of a degree of freedom as the summary writes it.
_ALONG = {1: "", 2: "across_"}


def custom_analysis(
    AIM: Mapping[str, Any] | None = None,
    EVENT: Mapping[str, Any] | None = None,
    SAM: Mapping[str, Any] | None = None,
    EDP: Mapping[str, Any] | None = None,
    *,
    BIM: Mapping[str, Any] | None = None,
) -> dict[str, float]:
    """Runs the model of an asset under an event and returns its demands.

    ``GeneralInformation`` of the asset names ``JostleModel``, a model file or a built-in model, and may name ``JostleBuilding``
    (the first by default) and ``JostleGap`` (width of every gap, with its unit). Degree of freedom 1 is along the row and 2 across, for
    buildings with a plan; vertical motion is left out with a warning. The motion is used as it is: scaling, sign and angle of the
    model's own motion do not apply. Accelerations and demands are in the units of the asset; if it has none, lengths are in
    inches, as in SimCenter.

    Args:
        AIM: the asset.
        EVENT: the event: ``timeSeries`` and ``pattern``.
        SAM: the structural model; not used.
        EDP: the requested demands; jostle warns of demands that are not among its results.
        BIM: the name of ``AIM`` in older versions of SimCenter.

    Returns:
        Demands by name, ``"1-PFA-2-1"`` for floor 2 along: peak floor accelerations ``PFA`` (floor 0 is the ground), displacements
        ``PFD``, storey drift ratios ``PID``, roof drift ratio ``PRD``, residual drift ratios ``RID``.

    Raises:
        ModelError: the asset or the event lacks something, or the model is wrong.
    """
    asset = AIM if AIM is not None else BIM
    if asset is None or EVENT is None:
        raise ModelError("SimCenter: custom_analysis needs AIM and EVENT")
    general = asset.get("GeneralInformation", asset)
    name = general.get("JostleModel")
    if not name:
        raise ModelError(
            "SimCenter: GeneralInformation names no JostleModel; add a column JostleModel with the path of a model file to the inventory"
        )
    length, time = _units(asset)
    parts = _components(EVENT, length / time**2)
    model = _with_motion(_model(str(name), asset), parts, str(EVENT.get("name", "event")))
    if general.get("JostleGap"):
        model = model.changed(gap=str(general["JostleGap"]))
    summary = run(model, record_interval=None).summary
    names = [own["name"] for own in summary["buildings"]]
    building = str(general.get("JostleBuilding") or names[0])
    if building not in names:
        raise ModelError(f"SimCenter: JostleBuilding: the model has no {building!r}; it has {', '.join(names)}")
    floors = summary["buildings"][names.index(building)]["floors"]
    storeys = general.get("NumberOfStories")
    if storeys is not None and int(storeys) != len(floors):
        raise ModelError(f"SimCenter: NumberOfStories is {storeys}, and building {building!r} has {len(floors)} floors")
    demands: dict[str, float] = {}
    for dof in parts:
        demands.update(_demands(floors, dof, parts[dof], length, time))
    _say_missing(EDP, demands)
    return demands


def _units(asset: Mapping[str, Any]) -> tuple[float, float]:
    units = asset.get("units") or {}
    unit = str(units.get("length", "inch"))
    if unit not in _LENGTHS:
        raise ModelError(f"SimCenter: units: length: expected one of {', '.join(_LENGTHS)}, found {unit!r}")
    seconds = {"sec": 1.0, "s": 1.0}.get(str(units.get("time", "sec")))
    if seconds is None:
        raise ModelError(f"SimCenter: units: time: expected sec, found {units.get('time')!r}")
    return _LENGTHS[unit], seconds


#: Values [m/s²] and time step [s].
_Component = tuple[list[float], float]


def _components(event: Mapping[str, Any], factor: float) -> dict[int, _Component]:
    """Accelerations by degree of freedom."""
    series = {str(own.get("name")): own for own in event.get("timeSeries") or []}
    found: dict[int, _Component] = {}
    for pattern in event.get("pattern") or []:
        dof = int(pattern.get("dof", 0))
        if dof not in _ALONG:
            warnings.warn(
                f"SimCenter: the motion in degree of freedom {dof} is left out: jostle takes 1, along, and 2, across",
                JostleWarning,
                stacklevel=3,
            )
            continue
        own = series.get(str(pattern.get("timeSeries")))
        if own is None:
            raise ModelError(f"SimCenter: EVENT: pattern names {pattern.get('timeSeries')!r}, which is no timeSeries")
        step = own.get("dT", event.get("dT"))
        if not isinstance(step, (int, float)) or not own.get("data"):
            raise ModelError(f"SimCenter: EVENT: timeSeries {own.get('name')!r} has no data with dT")
        scale = factor * float(own.get("factor", 1.0)) * float(pattern.get("factor", 1.0))
        found[dof] = ([scale * float(value) for value in own["data"]], float(step))
    if not found:
        raise ModelError("SimCenter: EVENT: has no motion in degree of freedom 1 or 2")
    return found


def _model(name: str, asset: Mapping[str, Any]) -> Model:
    """The model, looked for here and in the folder of common files of the workflow."""
    common = asset.get("commonFileDir")
    if not os.path.exists(name) and common and (Path(common) / name).exists():
        name = os.fspath(Path(common) / name)
    return Model.from_any(name)


def _with_motion(model: Model, parts: Mapping[int, _Component], name: str) -> Model:
    in_plan = any("plans" in own for own in model.description["buildings"])
    if 2 in parts and not in_plan:
        if 1 not in parts:
            raise ModelError("SimCenter: the event moves the ground across only, and no building of the model has a plan")
        warnings.warn(
            "SimCenter: the motion across is left out: no building of the model has a plan",
            JostleWarning,
            stacklevel=3,
        )
        parts = {1: parts[1]}
    if len(parts) == 1:
        [(dof, (values, step))] = parts.items()
        motion = Motion(values, step=step, name=name)
        return model.changed(motion=motion, angle="90 deg" if dof == 2 else None)
    # Two components are two records that the model names.
    return model.set("motion", {"record": _record(parts[1], 1), "across": _record(parts[2], 2)})


def _record(component: _Component, dof: int) -> str:
    """A record file beside the other files of the analysis."""
    values, step = component
    path = Path(f"jostle-{dof}.csv").resolve()
    lines = [f"{index * step!r},{value!r}" for index, value in enumerate(values)]
    path.write_text("# unit = m/s2\ntime_s,acceleration_m_s2\n" + "\n".join(lines) + "\n", "utf-8")
    return os.fspath(path)


def _demands(
    floors: list[dict[str, Any]], dof: int, component: _Component, length: float, time: float
) -> dict[str, float]:
    """Demands in one direction, in the units of the asset."""
    own = _ALONG[dof]
    acceleration = time**2 / length
    demands = {f"1-PFA-0-{dof}": max(abs(value) for value in component[0]) * acceleration}
    if floors and f"total_acceleration_{own}peak_m_s2" not in floors[0]:
        return demands
    shift = 0.0
    for number, floor in enumerate(floors, 1):
        shift = max(abs(floor[f"displacement_{own}{end}_m"]) for end in ("max", "min"))
        demands[f"1-PFA-{number}-{dof}"] = floor[f"total_acceleration_{own}peak_m_s2"] * acceleration
        demands[f"1-PFD-{number}-{dof}"] = shift / length
        demands[f"1-PID-{number}-{dof}"] = floor[f"storey_drift_{own}peak"]
        # The residual drift is known along the row.
        if dof == 1:
            demands[f"1-RID-{number}-{dof}"] = abs(floor["residual_drift"])
    demands[f"1-PRD-{len(floors)}-{dof}"] = shift / floors[-1]["height_m"]
    return demands


#: Demands as SimCenter asks for them, and as it looks for them in the answer.
_ASKED = {
    "max_abs_acceleration": ("PFA", "floor"),
    "max_rel_disp": ("PFD", "floor"),
    "max_drift": ("PID", "floor2"),
    "max_roof_drift": ("PRD", "floor2"),
    "residual_drift": ("RID", "floor"),
    "residual_disp": ("RFD", "floor"),
}


def _say_missing(asked: Mapping[str, Any] | None, demands: Mapping[str, float]) -> None:
    """Warns of demands that SimCenter will set to NaN without a message."""
    missing = []
    for group in (asked or {}).get("EngineeringDemandParameters") or []:
        for response in group.get("responses") or []:
            name, key = _ASKED.get(str(response.get("type")), ("", ""))
            for dof in response.get("dofs") or [1, 2]:
                wanted = f"1-{name}-{response.get(key)}-{dof}"
                if wanted not in demands:
                    missing.append(wanted if name else str(response.get("type")))
    if missing:
        more = f" and {len(missing) - 6} more" if len(missing) > 6 else ""
        warnings.warn(
            f"SimCenter: {', '.join(missing[:6])}{more} are not among the results and become NaN", JostleWarning, stacklevel=3
        )
