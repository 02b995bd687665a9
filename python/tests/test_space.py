"""Buildings with plans from Python: angle, corners, and the study of the angle of incidence."""

from __future__ import annotations

import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import TOWERS

import jostle

SPACE = """
title = "Two in space"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "5 s"
[[building]]
name = "A"
kind = "shear"
plan = ["10 m", "6 m"]
mass = ["100 t", "80 t"]
storey_height = "3 m"
stiffness = { x = "60 MN/m", y = "25 MN/m" }
eccentricity = ["1 m", "-0.5 m"]
[[building]]
name = "B"
kind = "shear"
plan = [["0 m", "0 m"], ["8 m", "0 m"], ["8 m", "7 m"], ["0 m", "7 m"]]
at = ["10.02 m", "1 m"]
mass = ["120 t", "120 t"]
storey_height = "3 m"
stiffness = "150 MN/m"
[[gap]]
between = ["A", "B"]
"""


def model() -> jostle.Model:
    return jostle.Model.loads(SPACE)


def test_the_angle_is_that_of_the_model_file() -> None:
    text = SPACE.replace('duration = "5 s"', 'duration = "5 s"\nangle = "40 deg"', 1)
    own = jostle.run(jostle.Model.loads(text))
    given = jostle.run(model(), angle="40 deg")
    assert own.summary["buildings"] == given.summary["buildings"]
    radians = jostle.run(model().changed(angle=math.radians(40.0)))
    assert radians.summary["gaps"][0]["peak_force_n"] == pytest.approx(own.summary["gaps"][0]["peak_force_n"], rel=1e-9)
    again = pickle.loads(pickle.dumps(model().changed(angle="40 deg")))
    assert jostle.run(again).summary["buildings"] == given.summary["buildings"]
    with pytest.raises(jostle.ModelError):
        jostle.run(jostle.Model.loads(TOWERS), angle="40 deg")
    with pytest.raises(jostle.ModelError, match="angle"):
        model().changed(angle="40 mm")


def test_corners_move_with_their_floors() -> None:
    result = jostle.run(model(), angle="30 deg")
    building = result.building("A")
    assert building.name == "A" and building.summary["name"] == "A"
    floor = building.floor(-1)
    assert floor.floor == 2
    assert floor.rotation is not None and floor.displacement_across is not None
    corner = building.corner(3)
    assert (corner.floor, corner.corner, corner.at) == (2, 3, (10.0, 6.0))
    # The centre of mass is the centroid, at (5 m, 3 m).
    expected = np.stack(
        [floor.displacement - 3.0 * floor.rotation, floor.displacement_across + 5.0 * floor.rotation], axis=1
    )
    np.testing.assert_allclose(corner.displacement, expected, atol=1e-15)
    assert corner.displacement.shape == (len(result.time), 2)
    # Its peak is that of the summary: the greatest of all corners.
    peaks = [np.hypot(*building.corner(number).displacement.T).max() for number in (1, 2, 3, 4)]
    own = building.summary["floors"][1]["corner_displacement_peak_m"]
    assert max(peaks) == pytest.approx(own, rel=2e-3) and max(peaks) <= own * (1.0 + 1e-9)
    # The velocity is the rate of the displacement, where instants are close.
    rate = np.gradient(corner.displacement[:, 0], result.time)
    scale = np.abs(corner.velocity[:, 0]).max()
    assert np.abs(rate - corner.velocity[:, 0])[5:-5].max() < 0.1 * scale
    assert result.building(1).corner(2, floor=1).at == (18.02, 1.0)
    with pytest.raises(ValueError, match="corners 1 to 4"):
        building.corner(5)
    with pytest.raises(ValueError, match="has no plan"):
        jostle.run(jostle.Model.loads(TOWERS)).building("soft").corner(1)
    assert jostle.run(jostle.Model.loads(TOWERS)).floor("soft", 1).rotation is None


def test_the_study_of_angles(tmp_path: Path) -> None:
    with pytest.warns(jostle.ModelWarning, match="one component"):
        study = jostle.angles(model(), tmp_path / "out", step="60 deg", jobs=2)
    assert study.complete and study.study.cases == 6
    np.testing.assert_allclose(np.degrees(study.angle), [0.0, 60.0, 120.0, 180.0, 240.0, 300.0])
    worst = study.worst("A.base_torque_peak_n_m")
    torque = study["A.base_torque_peak_n_m"]
    assert worst.value == torque.max() and worst.angle == study.angle[worst.case]
    run = jostle.run(model(), angle=worst.angle)
    assert run.summary["buildings"][0]["base_torque_peak_n_m"] == pytest.approx(worst.value, rel=1e-6)
    assert (tmp_path / "out" / "worst_angles.csv").is_file()
    assert "study-rose" in study.report.read_text(encoding="utf-8")
    with pytest.raises(ValueError):
        study.worst("motion")
    with pytest.raises(jostle.ModelError, match="step"):
        jostle.angles(model(), tmp_path / "none", step=0.0)
    with pytest.raises(jostle.ModelError, match="no plan"):
        jostle.angles(jostle.Model.loads(TOWERS), tmp_path / "none")
