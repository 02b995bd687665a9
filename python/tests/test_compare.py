"""Comparisons with measurements, against plain arithmetic."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import jostle
import numpy as np
import pytest

TOWER: dict[str, Any] = {
    "title": "One tower",
    "building": [{"name": "A", "kind": "shear", "storey_height": 3.0, "mass": [4e4], "stiffness": [2e7]}],
}
MAP: dict[str, Any] = {
    "table_acceleration": "A0",
    "column": [{"measured": "D1", "computed": "A.floor1.displacement_m"}],
}


def measurements(folder: Path, displacement: float) -> Path:
    rows = []
    for k in range(400):
        t = 0.01 * k
        rows.append(f"{t:.2f}\t{0.1 * math.sin(2 * math.pi * t):.6f}\t{displacement * math.sin(2 * math.pi * t):.6f}")
    path = folder / "test.asc"
    head = "Test\n2\n3\nTime\tA0\tD1\nsec\tg\tmm\n6\n"
    path.write_text(head + "\n".join(rows) + "\n")
    return path



def test_scores_are_those_of_the_columns(tmp_path: Path) -> None:
    found = jostle.compare(TOWER, measurements(tmp_path, 2.0), MAP, tmp_path / "out")
    score = found.score("A.floor1.displacement_m")
    measured = np.array(found.table["A.floor1.displacement_m.measured"])
    computed = np.array(found.table["A.floor1.displacement_m.computed"])
    assert score["peak_measured"] == pytest.approx(np.max(np.abs(measured)), rel=1e-12)
    assert score["peak_ratio"] == pytest.approx(np.max(np.abs(computed)) / np.max(np.abs(measured)), rel=1e-12)
    assert score["correlation"] == pytest.approx(np.corrcoef(measured, computed)[0, 1], rel=1e-10)
    difference = math.sqrt(np.sum((computed - measured) ** 2) / np.sum(measured**2))
    assert score["rms_difference"] == pytest.approx(difference, rel=1e-12)
    assert found.folder == tmp_path / "out"
    assert (tmp_path / "out" / "compare.html").read_text() == found.html()
    assert "A.floor1.displacement_m" in str(found)
    with pytest.raises(KeyError):
        found.score("nothing")


def test_wrong_maps_are_refused(tmp_path: Path) -> None:
    path = measurements(tmp_path, 2.0)
    with pytest.raises(jostle.ModelError, match="did you mean"):
        jostle.compare(TOWER, path, {**MAP, "table_accelaration": "A0"})
    with pytest.raises(jostle.ModelError, match="no column"):
        jostle.compare(TOWER, path, {**MAP, "table_acceleration": "A9"})
    with pytest.raises(jostle.ModelError, match="cannot be read"):
        jostle.compare(TOWER, tmp_path / "none.asc", MAP)
