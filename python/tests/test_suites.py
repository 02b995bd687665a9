"""Suites of records and floor spectra, against single runs and plain arithmetic."""

from __future__ import annotations

import json
import statistics
from pathlib import Path
from typing import Any

import jostle
import numpy as np
import pytest

RECORDS = ["el-centro-1940-ns", "nanjing-artificial"]


def tree(**further: Any) -> dict[str, Any]:
    tower = {"kind": "shear", "storey_height": 3.0}
    return {
        "motion": {"record": RECORDS, "pga": "3 m/s2", "duration": "12 s"},
        "building": [
            {"name": "A", "mass": [4e4, 4e4], "stiffness": [2e7, 2e7], **tower},
            {"name": "B", "mass": [6e4], "stiffness": [9e7], **tower},
        ],
        "gap": [{"between": ["A", "B"], "width": "10 mm"}],
        "analysis": {"tolerance": 0.01},
        **further,
    }


def test_a_suite_has_the_numbers_of_its_records(tmp_path: Path) -> None:
    suite = jostle.run_suite(tree(), tmp_path / "suite", governing="mean")
    assert suite.records == RECORDS
    assert suite.folder == tmp_path / "suite"
    peaks = []
    for record in RECORDS:
        single = jostle.run(tree(), motion=record, without_contact=True)
        own = suite.record(record)
        assert own["gaps"] == single.summary["gaps"]
        peaks.append(max(floor["storey_drift_peak"] for floor in own["buildings"][0]["floors"]))
    drift = suite["A.drift_peak"]
    assert list(drift.values) == peaks
    assert drift.mean == pytest.approx(statistics.mean(peaks), rel=1e-14)
    assert drift.standard_deviation == pytest.approx(statistics.stdev(peaks), rel=1e-12)
    assert drift.governing == drift.mean
    assert drift.maximum == max(peaks) == peaks[drift.maximum_record]
    assert list(suite.table["A.drift_peak"]) == peaks
    assert "A.drift_peak" in list(suite.statistics["quantity"])
    assert json.loads((tmp_path / "suite" / "suite.json").read_text()) == suite.summary
    assert "governing" in str(suite)
    again = jostle.run_suite(tree(), tmp_path / "suite", governing="mean", jobs=1)
    assert again.summary == suite.summary


def test_a_suite_without_a_folder_writes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shares: list[float] = []
    suite = jostle.run_suite(tree(), report=False, progress=lambda share, whole: shares.append(share / whole))
    assert list(tmp_path.iterdir()) == []
    assert all(0.0 <= share <= 1.0 for share in shares)
    assert suite["A-B.peak_force_n"].governing == suite["A-B.peak_force_n"].maximum
    with pytest.raises(KeyError, match="the quantities are"):
        suite["drift"]
    with pytest.raises(KeyError, match="there is no record 7"):
        suite.record(7)


def test_arguments_are_checked() -> None:
    with pytest.raises(jostle.ModelError, match="a suite needs a model with several records"):
        jostle.run_suite({**tree(), "motion": {"record": RECORDS[0]}})
    with pytest.raises(jostle.ModelError, match="governing: expected one of gb50011"):
        jostle.run_suite(tree(), governing="ec8")
    with pytest.raises(ValueError, match="jobs: must be at least 1"):
        jostle.run_suite(tree(), jobs=0)
    with pytest.warns(jostle.JostleWarning, match="at least eleven motions are required"):
        jostle.run_suite(tree(), governing="asce7", report=False)


def test_floor_spectra_are_a_table() -> None:
    asked = tree(output={"floor_spectra": {"floors": ["A.floor.2"], "periods": [0.1, 0.5], "damping": [0.02, 0.05]}})
    result = jostle.run(asked, motion=RECORDS[0], without_contact=True)
    table = result.floor_spectra
    assert table is not None
    # Two runs, two damping ratios, two periods.
    assert len(table) == 8
    floor = result.summary["floor_spectra"]["floors"][0]
    with_contact = np.array(table["contact"]) == "with"
    curve = np.array(table["pseudo_acceleration_m_s2"])[with_contact & (np.array(table["damping"]) == 0.05)]
    assert list(curve) == floor["spectra"][1]["pseudo_acceleration_m_s2"]
    assert floor["without_contact"]["peak_acceleration_m_s2"] < floor["peak_acceleration_m_s2"]
    assert jostle.run(tree(), motion=RECORDS[0]).floor_spectra is None


def test_a_report_becomes_a_pdf(tmp_path: Path) -> None:
    result = jostle.run(tree(), motion=RECORDS[0])
    with pytest.raises(jostle.ModelError, match="paper: expected one of a4, letter"):
        result.pdf(tmp_path / "report.pdf", paper="a3")
    try:
        result.pdf(tmp_path / "report.pdf")
    except jostle.ModelError as error:
        assert "apt install chromium" in str(error)
        pytest.skip("no Chromium")
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF-")
