"""Motions of an ``EventGrid.csv``, as the tools of NHERI SimCenter write and read it."""

from __future__ import annotations

import csv
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._errors import MissingFileError, ModelError

if TYPE_CHECKING:
    from ._motion import Motion


def read(
    path: str | os.PathLike[str],
    unit: str,
    longitude: float | None,
    latitude: float | None,
    component: str,
) -> list[Motion]:
    """The motions of :meth:`Motion.from_event_grid`."""
    from ._motion import Motion

    grid = Path(path)
    rows = _rows(grid, ("GP_file", "Longitude", "Latitude"))
    if not rows:
        raise ModelError(f"{grid}: lists no point")
    site = _nearest(grid, rows, longitude, latitude)
    listed = grid.parent / site
    motions = []
    for row in _rows(listed, ("TH_file",)):
        name = row["TH_file"].strip()
        record = listed.parent / (name if name.lower().endswith(".json") else f"{name}.json")
        tree = _json(record)
        key = f"data_{component}"
        values, step = tree.get(key), tree.get("dT")
        if not isinstance(values, list) or not isinstance(step, (int, float)):
            known = ", ".join(sorted(own for own in tree if own.startswith("data_"))) or "none"
            raise ModelError(f"{record}: has no {key} with dT; components: {known}")
        factor = _number(listed, "factor", row.get("factor") or "1")
        try:
            motion = Motion(values, step=float(step), unit=unit, name=Path(name).stem)
        except (ModelError, TypeError, ValueError) as error:
            raise ModelError(f"{record}: {error}") from None
        motions.append(motion if factor == 1.0 else motion.scaled(factor))
    if not motions:
        raise ModelError(f"{listed}: lists no record")
    return motions


def _text(path: Path) -> str:
    try:
        # Tables of Windows begin with a mark.
        return path.read_text("utf-8-sig")
    except FileNotFoundError:
        raise MissingFileError(f"{path}: there is no such file", os.fspath(path)) from None
    except (OSError, UnicodeDecodeError) as error:
        raise ModelError(f"{path}: cannot be read: {error}") from None


def _rows(path: Path, needed: tuple[str, ...]) -> list[dict[str, str]]:
    reader = csv.DictReader(_text(path).splitlines(), skipinitialspace=True)
    names = [name.strip() for name in reader.fieldnames or []]
    missing = [name for name in needed if name not in names]
    if missing:
        raise ModelError(f"{path}: has no column {missing[0]}; its columns are {', '.join(names) or 'none'}")
    reader.fieldnames = names
    return [{key: value or "" for key, value in row.items() if key} for row in reader]


def _json(path: Path) -> dict[str, Any]:
    try:
        tree = json.loads(_text(path))
    except ValueError as error:
        raise ModelError(f"{path}: is no JSON: {error}") from None
    if not isinstance(tree, dict):
        raise ModelError(f"{path}: is no record, which is a table with dT and data_x")
    # Some hold the whole event.
    events = tree.get("Events")
    if isinstance(events, list) and events and isinstance(events[0], dict):
        series = events[0].get("timeSeries")
        for own in series if isinstance(series, list) else []:
            if isinstance(own, dict):
                tree[str(own.get("name"))] = own.get("data")
                tree["dT"] = own.get("dT", events[0].get("dT"))
    return tree


def _number(path: Path, what: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise ModelError(f"{path}: {what}: expected a number, found {text!r}") from None
    if not math.isfinite(value):
        raise ModelError(f"{path}: {what}: expected a finite number, found {text!r}")
    return value


def _nearest(
    grid: Path, rows: list[dict[str, str]], longitude: float | None, latitude: float | None
) -> str:
    if longitude is None or latitude is None:
        if len(rows) > 1:
            raise ModelError(f"{grid}: lists {len(rows)} points; say which by longitude and latitude, in degrees")
        return rows[0]["GP_file"].strip()
    east = math.cos(math.radians(latitude))

    def distance(row: dict[str, str]) -> float:
        x, y = (_number(grid, name, row[name]) for name in ("Longitude", "Latitude"))
        # The shorter way around.
        along = (x - longitude + 180.0) % 360.0 - 180.0
        return math.hypot(east * along, y - latitude)

    return min(rows, key=distance)["GP_file"].strip()
