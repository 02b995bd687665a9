"""Fragility models of ``jostle classes``, read and evaluated by the engine of OpenQuake."""

import csv
import math
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

CLASSES = """
[class]
types = ["C1"]
storeys = [2]
level = "low"
[neighbour]
types = ["C3"]
storeys = [2]
level = "pre"
[pair]
gaps = ["5 mm"]
[motion]
record = ["el-centro-1940-ns", "nanjing-artificial"]
[intensity]
levels = ["0.05 g", "0.1 g", "0.2 g", "0.3 g", "0.4 g", "0.6 g", "0.9 g", "1.2 g", "1.6 g"]
[run]
resamples = 0
"""


def results(program: Callable[..., Any], folder: Path) -> tuple[Path, dict[str, dict[str, str]]]:
    """The folder of a run, and the rows of its table for Pelicun by their names."""
    (folder / "classes.toml").write_text(CLASSES, encoding="utf-8")
    done = program("classes", "classes.toml", "--out", "results")
    assert done.returncode == 0, done.stderr
    with (folder / "results" / "pelicun.csv").open(encoding="utf-8") as table:
        rows = {row["ID"]: row for row in csv.DictReader(table)}
    return folder / "results", rows


def exceeded(row: dict[str, str], state: int, intensity: float) -> float:
    """Probability of a damage state or a worse one at an intensity in g."""
    median, dispersion = float(row[f"LS{state}-Theta_0"]), float(row[f"LS{state}-Theta_1"])
    return 0.5 * math.erfc(-math.log(intensity / median) / dispersion / math.sqrt(2.0))


def test_openquake_evaluates_the_curves_that_pelicun_gets(program: Callable[..., Any], tmp_path: Path) -> None:
    pytest.importorskip("openquake.risklib.read_nrml", reason="pip install openquake.engine to compare with OpenQuake")
    nrml = pytest.importorskip("openquake.hazardlib.nrml")
    folder, rows = results(program, tmp_path)
    model = nrml.to_python(str(folder / "fragility.xml"))
    assert len(model) == len(rows) == 2
    for key, functions in model.items():
        row = rows[key[1] if isinstance(key, tuple) else key]
        built = functions.build(model.limitStates)
        assert len(built) == 4
        for state, function in enumerate(built, 1):
            median = float(row[f"LS{state}-Theta_0"])
            for ratio in (0.7, 1.0, 1.4):
                intensity = min(max(ratio * median, functions.minIML), functions.maxIML)
                found = float(function(np.array([intensity]))[0])
                assert found == pytest.approx(exceeded(row, state, intensity), abs=1e-9)


STATES = ("no_damage", "slight", "moderate", "extensive", "complete")


def test_openquake_computes_damage(program: Callable[..., Any], tmp_path: Path) -> None:
    pytest.importorskip(
        "openquake.calculators.base", reason="pip install openquake.engine and all it needs", exc_type=ImportError
    )
    folder, rows = results(program, tmp_path)
    write = {
        "exposure.xml": """<?xml version="1.0" encoding="utf-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
<exposureModel id="pairs" category="buildings" taxonomySource="jostle">
<description>one asset of every class</description>
<conversions><costTypes><costType name="structural" type="aggregated" unit="EUR"/></costTypes></conversions>
<occupancyPeriods/><assets>exposure.csv</assets></exposureModel></nrml>
""",
        "exposure.csv": "id,lon,lat,taxonomy,number,structural\n"
        + "".join(f"a{at},15.48,38.09,{name},1,1000\n" for at, name in enumerate(rows)),
        "gmf.csv": "eid,sid,gmv_PGA\n0,0,0.3\n",
        "sites.csv": "site_id,lon,lat\n0,15.48,38.09\n",
        "job.ini": """[general]
description = fragility of jostle
calculation_mode = scenario_damage
exposure_file = exposure.xml
structural_fragility_file = fragility.xml
gmfs_file = gmf.csv
sites_csv = sites.csv
asset_hazard_distance = 5
discrete_damage_distribution = false
export_dir = out
""",
    }
    for name, text in write.items():
        (folder / name).write_text(text, encoding="utf-8")
    # Without CI the engine calls home.
    environment = {**os.environ, "CI": "1", "OQ_DATADIR": str(tmp_path / "data")}
    command = [sys.executable, "-m", "openquake.commands", "engine", "--run", "job.ini", "--exports", "csv"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    (table,) = (folder / "out").glob("avg_damages*.csv")
    lines = [line for line in table.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    found = {row["taxonomy"]: row for row in csv.DictReader(lines)}
    assert set(found) == set(rows)
    for name, row in rows.items():
        worse = [1.0, *(exceeded(row, state, 0.3) for state in range(1, 5)), 0.0]
        for at, state in enumerate(STATES):
            share = float(found[name][f"structural-{state}"])
            assert share == pytest.approx(worse[at] - worse[at + 1], abs=1e-5), f"{name}: {state}"


def test_pelicun_computes_damage(program: Callable[..., Any], tmp_path: Path) -> None:
    assessment = pytest.importorskip("pelicun.assessment", reason="pip install pelicun")
    pandas = pytest.importorskip("pandas")
    folder, rows = results(program, tmp_path)
    samples, intensity = 20_000, 0.3
    model = assessment.Assessment({"PrintLog": False, "Seed": 7})
    model.stories = 1
    columns = pandas.MultiIndex.from_tuples([("PGA", "0", "1")], names=["type", "loc", "dir"])
    units = pandas.DataFrame([["g"]], columns=columns, index=["Units"])
    demand = pandas.DataFrame(np.full((samples, 1), intensity), columns=columns)
    model.demand.load_sample(pandas.concat([units, demand]))
    count = len(rows)
    parts: dict[str, list[Any]] = {"Units": ["ea"], "Location": ["0"], "Direction": ["1"], "Theta_0": [1.0], "Blocks": [1]}
    marginals = pandas.DataFrame({key: count * value for key, value in parts.items()}, index=list(rows))
    model.asset.load_cmp_model({"marginals": marginals})
    model.asset.generate_cmp_sample(samples)
    model.damage.load_model_parameters([str(folder / "pelicun.csv")], set(rows))
    model.damage.calculate()
    shares = model.damage.save_sample().mean()
    for name, row in rows.items():
        for state in range(1, 5):
            found = sum(value for key, value in shares.items() if key[0] == name and int(key[-1]) >= state)
            assert found == pytest.approx(exceeded(row, state, intensity), abs=0.02), f"{name}: {state}"
