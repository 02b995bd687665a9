"""Motions of an ``EventGrid.csv``, as the tools of NHERI SimCenter write and read it."""

from __future__ import annotations

import csv
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING

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
        factor = _number(listed, "factor", row.get("factor") or "1")
        motion = Motion.read(record, unit=unit, component=component, format="simcenter")
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
