"""Demands for SimCenter against results of the command line, and the contract of their driver."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import jostle
from jostle.simcenter import custom_analysis

#: Demands as an asset of five storeys asks for them.
RESPONSES: list[dict[str, Any]] = [{"type": "max_abs_acceleration", "floor": "0", "dofs": [1]}]
for _floor in range(1, 6):
    RESPONSES += [
        {"type": "max_abs_acceleration", "floor": str(_floor), "dofs": [1]},
        {"type": "max_rel_disp", "floor": str(_floor), "dofs": [1]},
        {"type": "max_drift", "floor1": str(_floor - 1), "floor2": str(_floor), "dofs": [1]},
    ]
RESPONSES.append({"type": "max_roof_drift", "floor1": "0", "floor2": "5", "dofs": [1]})

#: What the driver of SimCenter (BackendApplications a998bcc5) wrote to results.out for the built-in pair, from `jostle run --json` of
#: release 0.1.0 with the first 10 s of El Centro reversed and scaled to 220 cm/s², without the acceleration of the ground.
WRITTEN = [
    8.727129711505459, 0.01829874651768696, 0.0057183582867771756,
    9.431336734957071, 0.043152501919633865, 0.007787112192250538,
    11.281311717885119, 0.06508907726305488, 0.006874417033485755,
    12.781225683816311, 0.08180899232093607, 0.005235821519639995,
    25.994255796937207, 0.09151248226993894, 0.003468387372460459,
    0.005719530141871184,
]  # fmt: skip


def el_centro(factor: float = 1.0) -> list[float]:
    """The first 10 s at 220 cm/s², reversed, in m/s² times a factor: the peak lies among them."""
    motion = jostle.Motion.el_centro().scaled(pga="220 cm/s2").reversed()
    return [factor * float(value) for value in motion.acceleration[:501]]


def asset(**more: Any) -> dict[str, Any]:
    general = {"NumberOfStories": 5, "JostleModel": "paper", "JostleBuilding": "J1", **more.pop("general", {})}
    return {"units": {"length": "m", "time": "sec"}, "GeneralInformation": general, **more}


def event(data: list[float], *, dofs: tuple[int, ...] = (1,)) -> dict[str, Any]:
    series = [{"name": f"data_{dof}", "dT": 0.02, "data": data} for dof in dofs]
    pattern = [{"type": "UniformAcceleration", "timeSeries": f"data_{dof}", "dof": dof} for dof in dofs]
    return {"name": "el-centro", "dT": 0.02, "numSteps": len(data), "timeSeries": series, "pattern": pattern}


def asked(demands: dict[str, float]) -> list[float]:
    """The demands in the order of the responses, as the driver looks for them."""
    kinds = {"max_abs_acceleration": "PFA", "max_rel_disp": "PFD", "max_drift": "PID", "max_roof_drift": "PRD"}
    floors = (response.get("floor", response.get("floor2")) for response in RESPONSES)
    return [demands[f"1-{kinds[own['type']]}-{floor}-1"] for own, floor in zip(RESPONSES, floors)]


def test_demands_are_those_of_the_command_line() -> None:
    found = custom_analysis(AIM=asset(), EVENT=event(el_centro()), SAM={}, EDP={})
    values = asked(found)
    assert values[0] == pytest.approx(2.2, rel=1e-12)
    # The record went through a text of nine digits there.
    assert values[1:] == pytest.approx(WRITTEN, rel=1e-3)
    # The older name of the asset.
    assert custom_analysis(BIM=asset(), EVENT=event(el_centro())) == found


def test_units_of_the_asset_are_understood() -> None:
    metres = custom_analysis(AIM=asset(), EVENT=event(el_centro()))
    # Without units SimCenter means inches.
    inches = custom_analysis(AIM=asset(units={}), EVENT=event(el_centro(1.0 / 0.0254)))
    for name, value in metres.items():
        ratio = 1.0 if name[2:5] in ("PID", "PRD", "RID") else 0.0254
        assert inches[name] * ratio == pytest.approx(value, rel=1e-9), name


def test_a_plan_moves_along_and_across(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    tower = {
        "name": "A", "kind": "shear", "plan": ["20 m", "10 m"], "mass": ["400 t", "400 t"],
        "stiffness": [{"x": "300 MN/m", "y": "300 MN/m", "torsion": "30 GN.m/rad"}] * 2, "storey_height": "3 m",
    }  # fmt: skip
    Path("site.json").write_text(json.dumps({"building": [tower]}))
    own = asset(general={"JostleModel": "site.json", "JostleBuilding": "A", "NumberOfStories": 2})
    data = el_centro()
    both = custom_analysis(AIM=own, EVENT=event(data, dofs=(1, 2)))
    along = custom_analysis(AIM=own, EVENT=event(data, dofs=(1,)))
    across = custom_analysis(AIM=own, EVENT=event(data, dofs=(2,)))
    for floor in (1, 2):
        # The same stiffness and motion both ways, without eccentricity.
        assert both[f"1-PFD-{floor}-1"] == pytest.approx(both[f"1-PFD-{floor}-2"], rel=1e-6)
        assert both[f"1-PFD-{floor}-1"] == pytest.approx(along[f"1-PFD-{floor}-1"], rel=1e-3)
        assert across[f"1-PFD-{floor}-2"] == pytest.approx(along[f"1-PFD-{floor}-1"], rel=1e-3)


def test_what_is_missing_is_said() -> None:
    data = event(el_centro())
    with pytest.raises(jostle.ModelError, match="names no JostleModel"):
        custom_analysis(AIM={"GeneralInformation": {}}, EVENT=data)
    with pytest.raises(jostle.ModelError, match="the model has no 'J9'"):
        custom_analysis(AIM=asset(general={"JostleBuilding": "J9"}), EVENT=data)
    with pytest.raises(jostle.ModelError, match="NumberOfStories is 7"):
        custom_analysis(AIM=asset(general={"NumberOfStories": 7}), EVENT=data)
    with pytest.raises(jostle.ModelError, match="expected one of"):
        custom_analysis(AIM=asset(units={"length": "cubit"}), EVENT=data)
    with pytest.raises(jostle.ModelError, match="no motion in degree of freedom"):
        custom_analysis(AIM=asset(), EVENT={"timeSeries": [], "pattern": []})
    with pytest.raises(jostle.ModelError, match="no timeSeries"):
        custom_analysis(AIM=asset(), EVENT={**data, "timeSeries": []})
    with pytest.raises(jostle.ModelError, match="across only"):
        custom_analysis(AIM=asset(), EVENT=event(el_centro(), dofs=(2,)))
    with pytest.warns(jostle.JostleWarning, match="across is left out"):
        custom_analysis(AIM=asset(), EVENT=event(el_centro(), dofs=(1, 2)))
    wanted = {"EngineeringDemandParameters": [{"responses": [{"type": "residual_disp", "floor": "5", "dofs": [1]}]}]}
    with pytest.warns(jostle.JostleWarning, match="1-RFD-5-1 are not among the results and become NaN"):
        custom_analysis(AIM=asset(), EVENT=data, EDP=wanted)


def test_their_driver_runs_it(tmp_path: Path) -> None:
    # The driver is no package: JOSTLE_SIMCENTER names a copy of SimCenterBackendApplications.
    root = os.environ.get("JOSTLE_SIMCENTER")
    if not root:
        pytest.skip("JOSTLE_SIMCENTER names no copy of SimCenterBackendApplications, whose driver is no package")
    driver = Path(root) / "modules" / "performSIMULATION" / "customPy" / "customPySimulation.py"
    folder = tmp_path / "model"
    folder.mkdir()
    (folder / "main.py").write_text("from jostle.simcenter import custom_analysis\n")
    files = {
        "AIM": asset(),
        "SAM": {"mainScript": "main.py", "modelPath": str(folder), "dofMap": "1", "numStory": 5, "ndm": 2},
        "EVENT": {"Events": [event(el_centro())]},
        "EDP": {"EngineeringDemandParameters": [{"name": "el-centro", "responses": RESPONSES}]},
    }
    options = []
    for name, tree in files.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(tree))
        options += [f"--filename{name}", f"{name}.json"]
    done = subprocess.run([sys.executable, str(driver), *options], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    values = [float(value) for value in (tmp_path / "results.out").read_text().split()]
    assert len(values) == 17
    assert not any(math.isnan(value) for value in values)
    assert values[1:] == pytest.approx(WRITTEN, rel=1e-3)


def write_grid(folder: Path) -> None:
    (folder / "EventGrid.csv").write_text(
        "\ufeffGP_file,Longitude,Latitude\nsite0.csv,15.0,38.0\nsite1.csv, -179.9, 38.0\n", "utf-8"
    )
    (folder / "site0.csv").write_text("TH_file,factor\nRSN30,2.0\nwhole.json,1\n")
    (folder / "site1.csv").write_text("TH_file\nRSN30\n")
    (folder / "RSN30.json").write_text(json.dumps({"name": "RSN30", "dT": 0.01, "data_x": [0.0, 0.1, -0.2]}))
    inner = {"name": "data_x", "dT": 0.005, "data": [0.0, 0.3, 0.0]}
    (folder / "whole.json").write_text(json.dumps({"Events": [{"timeSeries": [inner], "pattern": []}]}))


def test_motions_of_an_event_grid(tmp_path: Path) -> None:
    write_grid(tmp_path)
    grid = tmp_path / "EventGrid.csv"
    near = jostle.Motion.from_event_grid(grid, unit="g", longitude=15.4, latitude=38.1)
    assert [motion.name for motion in near] == ["RSN30", "whole"]
    assert near[0].pga == pytest.approx(0.4 * 9.80665)
    assert np.asarray(near[1].acceleration) == pytest.approx([0.0, 0.3 * 9.80665, 0.0])
    # Across the date line.
    far = jostle.Motion.from_event_grid(grid, unit="g", longitude=179.9, latitude=38.0)
    assert len(far) == 1 and far[0].pga == pytest.approx(0.2 * 9.80665)


@pytest.mark.parametrize(
    ("file", "text", "message"),
    [
        ("EventGrid.csv", "Longitude,Latitude\n1,2\n", "has no column GP_file"),
        ("EventGrid.csv", "GP_file,Longitude,Latitude\n", "lists no point"),
        ("EventGrid.csv", "GP_file,Longitude,Latitude\na,x,2\nb,1,2\n", "Longitude: expected a number"),
        ("EventGrid.csv", "GP_file,Longitude,Latitude\nabsent.csv,1,2\n", "absent.csv: there is no such file"),
        ("site0.csv", "TH_file,factor\n", "lists no record"),
        ("site0.csv", "TH_file,factor\nRSN30,two\n", "factor: expected a number"),
        ("RSN30.json", "{", "EOF while parsing"),
        ("RSN30.json", "[]", "has none of data_x, data_y and data_z"),
        ("RSN30.json", '{"dT": 0.01, "data_y": [0, 1]}', "1: y"),
        ("RSN30.json", '{"dT": 0.01, "data_x": ["a", 1]}', 'invalid type: string "a", expected f64'),
        ("RSN30.json", '{"dT": -1, "data_x": [0, 1]}', "dT of data_x must be greater than 0"),
    ],
)
def test_faults_of_an_event_grid_are_named(file: str, text: str, message: str, tmp_path: Path) -> None:
    write_grid(tmp_path)
    (tmp_path / file).write_text(text)
    with pytest.raises(jostle.ModelError) as caught:
        jostle.Motion.from_event_grid(tmp_path / "EventGrid.csv", unit="g", longitude=15.0, latitude=38.0)
    assert message in str(caught.value)


def test_a_grid_of_several_points_needs_a_place(tmp_path: Path) -> None:
    write_grid(tmp_path)
    with pytest.raises(jostle.ModelError, match="lists 2 points; say which"):
        jostle.Motion.from_event_grid(tmp_path / "EventGrid.csv", unit="g")
