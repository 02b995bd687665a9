"""Fragility models of ``jostle classes``, read and evaluated by the engine of OpenQuake."""

import csv
import math
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


def test_openquake_evaluates_the_curves_that_pelicun_gets(program: Callable[..., Any], tmp_path: Path) -> None:
    pytest.importorskip("openquake.risklib.read_nrml", reason="pip install openquake.engine to compare with OpenQuake")
    nrml = pytest.importorskip("openquake.hazardlib.nrml")
    (tmp_path / "classes.toml").write_text(CLASSES, encoding="utf-8")
    done = program("classes", "classes.toml", "--out", "results")
    assert done.returncode == 0, done.stderr
    with (tmp_path / "results" / "pelicun.csv").open(encoding="utf-8") as table:
        rows = {row["ID"]: row for row in csv.DictReader(table)}
    model = nrml.to_python(str(tmp_path / "results" / "fragility.xml"))
    assert len(model) == len(rows) == 2
    for key, functions in model.items():
        row = rows[key[1] if isinstance(key, tuple) else key]
        built = functions.build(model.limitStates)
        assert len(built) == 4
        for state, function in enumerate(built, 1):
            median, dispersion = float(row[f"LS{state}-Theta_0"]), float(row[f"LS{state}-Theta_1"])
            for ratio in (0.7, 1.0, 1.4):
                intensity = min(max(ratio * median, functions.minIML), functions.maxIML)
                wanted = 0.5 * math.erfc(-math.log(intensity / median) / dispersion / math.sqrt(2.0))
                assert float(function(np.array([intensity]))[0]) == pytest.approx(wanted, abs=1e-9)
