"""The package and the command line give the same numbers, bit for bit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import Program, build_towers

import jostle


def without_clock(summary: dict[str, Any]) -> dict[str, Any]:
    """A summary without the only number that a clock makes."""
    return {**summary, "work": {**summary["work"], "wall_s": 0}}


def told(program: Program, *arguments: str) -> dict[str, Any]:
    done = program(*arguments)
    assert done.returncode == 0, done.stderr
    summary: dict[str, Any] = json.loads(done.stdout)
    return without_clock(summary)


def test_the_example_alone(program: Program) -> None:
    ours = jostle.run(jostle.Model.paper_example(), record_interval=None)
    assert without_clock(ours.summary) == told(program, "run", "--json", "--no-report")


def test_the_example_with_the_run_without_contact(program: Program) -> None:
    ours = jostle.run(
        jostle.Model.paper_example(), gap="10 mm", pga="70 cm/s2", without_contact=True
    )
    theirs = told(program, "run", "--json", "--pga", "70 cm/s2", "--gap", "10 mm")
    assert without_clock(ours.summary) == theirs
    assert theirs["gaps"][0]["closing_without_contact_m"] > 0.01


def test_a_file_from_dict_and_builders_are_one_model(
    program: Program, towers_file: Path, towers: jostle.Model, result: jostle.Result
) -> None:
    tomllib = pytest.importorskip("tomllib")
    tree = tomllib.loads(towers_file.read_text(encoding="utf-8"))
    expected = told(program, "run", str(towers_file), "--json", "--no-report")
    for model in (jostle.Model.load(towers_file), jostle.Model.from_dict(tree), build_towers()):
        assert model.description == towers.description
        assert without_clock(jostle.run(model, record_interval=None).summary) == expected


def test_histories_and_impacts_are_those_of_the_files(
    program: Program, towers_file: Path, tmp_path: Path, result: jostle.Result
) -> None:
    assert program("run", str(towers_file), "--out", "theirs", "--no-report").returncode == 0
    for name, table in (("history", result.history), ("impacts", result.impacts)):
        theirs = pq.read_table(tmp_path / "theirs" / f"{name}.parquet")
        ours = pa.table(table)
        assert len(ours) > 10
        assert ours.column_names == theirs.column_names == table.columns
        assert ours.equals(theirs.cast(ours.schema))


def test_saved_files_are_those_of_the_command_line(
    program: Program, towers_file: Path, tmp_path: Path, result: jostle.Result
) -> None:
    assert program("run", str(towers_file), "--out", "theirs").returncode == 0
    ours = result.save(tmp_path / "ours" / "deep")
    for name in ("history.parquet", "buildings.parquet", "floors.parquet", "impacts.parquet"):
        assert (ours / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    summaries = [json.loads((f / "summary.json").read_text()) for f in (ours, tmp_path / "theirs")]
    assert without_clock(summaries[0]) == without_clock(summaries[1])
    pages = [(f / "report.html").read_text("utf-8") for f in (ours, tmp_path / "theirs")]
    lines = [[line for line in page.splitlines() if "wall time" not in line] for page in pages]
    assert len(pages[0]) == pytest.approx(len(pages[1]), abs=20)
    data = [page.split('id="page-data"')[1].split("</script>")[0] for page in pages]
    assert data[0] == data[1], "the same pictures"
    assert len(lines[0]) == len(lines[1])


def test_saved_files_of_a_yielding_model(program: Program, tmp_path: Path) -> None:
    assert program("new", "short", "--template", "paper-inelastic").returncode == 0
    short = tmp_path / "short.toml"
    text = short.read_text("utf-8")
    assert "[motion]\n" in text
    short.write_text(text.replace("[motion]\n", '[motion]\nduration = "6 s"\n'), "utf-8")
    assert program("run", "short.toml", "--out", "theirs").returncode == 0
    ours = jostle.run(short).save(tmp_path / "ours")
    theirs = tmp_path / "theirs"
    names = sorted(file.name for file in theirs.iterdir())
    assert names == sorted(file.name for file in ours.iterdir())
    assert "hinges.parquet" in names
    for name in (name for name in names if name.endswith(".parquet")):
        assert (ours / name).read_bytes() == (theirs / name).read_bytes(), name
    page = (ours / "report.html").read_text("utf-8")
    assert "column section" in page, "reinforced sections"


def test_modes(program: Program, towers_file: Path, towers: jostle.Model) -> None:
    theirs = told_modes(program, str(towers_file), "--count", "5")
    ours = jostle.modes(towers, 5)
    assert list(ours) == ["soft", "stiff"]
    for building in theirs:
        modes = ours[building["name"]]
        assert modes.lateral_periods.tolist() == building["periods_s"]
        assert modes.periods.tolist() == [mode["period_s"] for mode in building["modes"]]
        assert modes.floor_shapes.tolist() == [mode["floor_shape"] for mode in building["modes"]]
        assert modes.floor_shapes.shape == (len(modes), 3)
    assert np.array_equal(towers.periods("soft"), ours["soft"].lateral_periods)


def told_modes(program: Program, *arguments: str) -> list[dict[str, Any]]:
    done = program("modes", *arguments, "--json")
    assert done.returncode == 0, done.stderr
    buildings: list[dict[str, Any]] = json.loads(done.stdout)["buildings"]
    return buildings


def test_printed_summary(program: Program, towers_file: Path, result: jostle.Result) -> None:
    printed = program("run", str(towers_file), "--no-report").stdout
    for ours, theirs in zip(str(result).splitlines(), printed.splitlines()):
        if not ours.startswith("energy balance"):  # ends with the time it took
            assert ours == theirs


def test_runs_repeat_bit_for_bit(towers: jostle.Model, result: jostle.Result) -> None:
    again = jostle.run(towers)
    for name in result.history.columns:
        assert again.history[name].tobytes() == result.history[name].tobytes(), name
