"""What the command line computes besides runs, as functions, against the command line and against closed forms."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import TOWERS, Program

import jostle


def test_a_check_says_what_the_program_says(program: Program, towers_file: Path, towers: jostle.Model) -> None:
    found = towers.check()
    printed = program("check", str(towers_file)).stdout
    # Time and memory are of the machine.
    own = [line for line in str(found).splitlines() if "on this machine" not in line]
    assert own == [line for line in printed.rstrip().splitlines() if "on this machine" not in line]
    assert found.work is not None and found.work["steps"] * found.work["step_s"] == pytest.approx(12.0)
    assert [own["id"] for own in found.findings] and found.site is None


def test_sections_are_those_of_the_program(program: Program) -> None:
    answer = jostle.section(width="500 mm", depth=0.5, bars="12 d20", axial_load="800 kN", length=3.2)
    options = ["--width", "500mm", "--depth", "500mm", "--bars", "12 d20", "--axial-load", "800kN", "--length", "3.2m"]
    printed = json.loads(program("section", *options, "--json").stdout)
    assert printed["sections"] == answer.tree
    # Steel of twelve bars.
    assert answer[0]["steel_area_m2"] == pytest.approx(12 * np.pi * 0.02**2 / 4, rel=1e-12)
    curvature, moment = answer.curve()
    assert curvature.shape == moment.shape and len(moment) > 10
    with pytest.raises(TypeError, match="bars missing"):
        jostle.section(width=0.5, depth=0.5)
    with pytest.raises(jostle.ModelError, match="no reinforced members"):
        jostle.section(model="paper")
    with pytest.raises(jostle.ModelError, match='strength: must be one of .* found "odd"'):
        jostle.section(width=0.5, depth=0.5, bars="12 d20", strength="odd")


def test_the_smallest_gap_is_found_by_size_too(towers: jostle.Model) -> None:
    """Two algorithms: a search over the key, and bracketing of runs."""
    (gap,) = jostle.critical_gap(towers, outcomes=False, tolerance="0.05 mm")
    found = jostle.size(
        towers, vary={"gap.width": ("5 mm", "300 mm")}, keep="impact_count == 0", minimise="gap.width", trials=80
    )
    assert found.objective == pytest.approx(gap.gap, abs=2e-4)
    assert found.best is not None and found.best["gap.width"].endswith("mm")
    assert len(found.trials) == found.summary["trials"]
    with pytest.raises(jostle.ModelError, match="trials: must be at least 10"):
        jostle.size(towers, vary="gap.width", minimise="gap.width", trials=3)


def test_exports_are_those_of_the_program(program: Program, towers: jostle.Model, towers_file: Path, tmp_path: Path) -> None:
    script = towers.export()
    assert script.text == program("export", str(towers_file), "--to", "openseespy").stdout
    assert towers.export(tmp_path / "towers.py").files == (tmp_path / "towers.py",)
    (tmp_path / "mine.py").write_text("mine")
    with pytest.raises(FileExistsError, match="pass force=True"):
        towers.export(tmp_path / "mine.py")
    matrices = towers.export(tmp_path / "matrices", to="matrices")
    arrays = np.load(matrices.files[0])
    # A chain of three storeys: k1 + k2 in the corner.
    stiffness = next(arrays[name] for name in arrays.files if arrays[name].shape == (3, 3) and arrays[name][0, 0] > 1e7)
    assert stiffness[0, 0] == pytest.approx(60e6)
    with pytest.raises(jostle.ModelError, match="name a folder"):
        towers.export(to="matrices")


def test_motions_are_made_as_by_the_program(program: Program, tmp_path: Path) -> None:
    target = jostle.DesignSpectrum("en1998", type=1, ground="B", ag="0.2 g")
    made = jostle.Motion.synth(target, duration="10 s", step=0.01, seed=3, periods=(0.1, 2.0), tolerance=0.1)
    options = ["--code", "en1998", "--type", "1", "--ground", "B", "--ag", "0.2g", "--duration", "10s", "--step", "0.01s"]
    options += ["--seed", "3", "--periods", "0.1", "2.0", "--tolerance", "0.1", "--out", "made.csv"]
    assert program("motion", "synth", "spectrum", *options).returncode == 0
    assert np.array_equal(jostle.Motion.read(tmp_path / "made.csv").acceleration, made.acceleration)
    # The spectrum of the motion, computed again, lies within the tolerance.
    assert made.matched is not None
    periods = np.geomspace(0.1, 2.0, 40)
    found = made.spectrum(periods).pseudo_acceleration[0] / target.acceleration(periods)
    assert np.abs(found - 1).max() < made.matched["misfit"] + 0.05
    noise = jostle.Motion.noise(pga="0.3 g", duration=8, seed=5)
    assert noise.pga == pytest.approx(0.3 * 9.80665, rel=1e-12)
    pulse = jostle.Motion.pulse(shape="makris-b", velocity="0.6 m/s", period="1.2 s")
    assert pulse.measures()["pgv_m_s"] == pytest.approx(0.6, rel=2e-3)
    with pytest.raises(jostle.ModelError, match="shape must be one of mavroeidis"):
        jostle.Motion.pulse(shape="square", velocity=1, period=1)
    assert "nanjing-artificial" in jostle.Motion.builtin()


def test_processing_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    own = jostle.Motion.el_centro().processed(
        start="1 s", stop="20 s", detrend=1, high_pass="0.1 Hz", low_pass=20, resample=0.01, pad_after=2, pga="0.2 g"
    )
    options = ["--from", "1s", "--to", "20s", "--detrend", "1", "--high-pass", "0.1Hz", "--low-pass", "20Hz"]
    options += ["--resample", "0.01s", "--pad-after", "2s", "--pga", "0.2g"]
    assert program("motion", "convert", "el-centro-1940-ns", "c.csv", *options).returncode == 0
    assert np.array_equal(jostle.Motion.read(tmp_path / "c.csv").acceleration, own.acceleration)
    assert own.save(tmp_path / "own.csv").read_text() == (tmp_path / "c.csv").read_text()
    with pytest.raises(FileExistsError, match="pass force=True"):
        own.save(tmp_path / "own.csv")


def test_a_set_is_judged_as_by_the_program(program: Program) -> None:
    target = jostle.DesignSpectrum("gb50011", intensity=8, site="II", group=1, level="rare")
    found = jostle.Motion.select(
        target, periods=["0.8 s", 0.27], natural=[jostle.Motion.el_centro()], artificial=["nanjing-artificial"]
    )
    options = ["--code", "gb50011", "--intensity", "8", "--site", "II", "--group", "1", "--level", "rare"]
    options += ["--periods", "0.8,0.27", "--natural", "el-centro-1940-ns", "--artificial", "nanjing-artificial"]
    printed = json.loads(program("motion", "select", *options, "--json").stdout)
    assert printed == found.tree and not found.passes
    with pytest.raises(jostle.ModelError, match="name some with natural and artificial"):
        jostle.Motion.select(target, periods=[1.0])
    with pytest.raises(jostle.ModelError, match="mass_ratios: 1 values for 2 periods"):
        jostle.Motion.select(target, periods=[1.0, 0.3], natural=["el-centro-1940-ns"], mass_ratios=[1])


def gaps(model: jostle.Model) -> Any:
    return jostle.run(model, record_interval=None).summary["gaps"]


@pytest.mark.parametrize(
    "motion",
    [
        jostle.Motion.el_centro().scaled(pga="0.25 g").reversed().lasting("8 s"),
        jostle.Motion.el_centro().scaled(1.7),
        jostle.Motion.sine(amplitude="2 m/s2", period="0.6 s", duration="5 s"),
        jostle.Motion.ricker(amplitude="3 m/s2", period="0.6 s", duration="3 s"),
    ],
    ids=["record", "factor", "sine", "ricker"],
)
def test_changed_models_are_saved_bit_by_bit(motion: jostle.Motion, towers: jostle.Model, tmp_path: Path) -> None:
    changed = towers.changed(motion=motion, gap="13 mm").set("building.soft.mass", ["42 t", "40 t", "30 t"])
    path = changed.save(tmp_path / "own" / "towers.toml")
    assert gaps(jostle.Model.load(path)) == gaps(changed)
    assert gaps(pickle.loads(pickle.dumps(changed))) == gaps(changed)
    again = jostle.Model.loads(changed.to_toml(), folder=tmp_path / "own")
    assert again.description == changed.description
    with pytest.raises(FileExistsError, match="pass force=True"):
        changed.set("title", "Another").save(path)
    plain = towers.changed(motion=motion, gap="13 mm")
    assert gaps(jostle.Model.loads(plain.to_toml(), folder=tmp_path / "own")) == gaps(plain)


def test_a_gap_with_several_widths_keeps_their_differences(tmp_path: Path) -> None:
    text = TOWERS.replace('width = "20 mm"', 'width = ["20 mm", "22 mm", "25 mm"]')
    changed = jostle.Model.loads(text).changed(gap="10 mm")
    assert gaps(jostle.Model.loads(changed.to_toml())) == gaps(changed)
    widths = [own["width_m"] for own in jostle.Model.loads(changed.to_toml()).description["gaps"][0]["contacts"]]
    assert widths == pytest.approx([0.010, 0.012, 0.015], abs=1e-12)


def test_changed_models_vary_in_studies(towers: jostle.Model, tmp_path: Path) -> None:
    motion = jostle.Motion.el_centro().scaled(pga="0.25 g").lasting("6 s")
    changed = towers.changed(motion=motion, gap="12 mm")
    vary = [{"name": "gap", "path": "gap[0].width", "values": ["8 mm", "12 mm"]}]
    result = jostle.Study(changed, vary).run(tmp_path / "out", report=False)
    expected = [gaps(changed.changed(gap=width))[0]["peak_force_n"] for width in ("8 mm", "12 mm")]
    assert list(result["peak_force_n"]) == expected
    ready = jostle.Study.ready_made("gap-sweep", changed)
    assert ready.cases > 5 and ready.varied
    with pytest.raises(jostle.ModelError, match="there is no ready-made study 'odd'"):
        jostle.Study.ready_made("odd", changed)


def test_suites_take_any_motion(towers: jostle.Model) -> None:
    motions = [jostle.Motion.el_centro().scaled(pga=f"{pga} g").lasting("6 s") for pga in (0.2, 0.3)]
    suite = jostle.run_suite(towers, motions=motions, report=False)
    assert suite.records == ["el-centro-1940-ns", "el-centro-1940-ns-2"]
    expected = [gaps(towers.changed(motion=motion))[0]["peak_force_n"] for motion in motions]
    assert list(suite["soft-stiff.peak_force_n"].values) == pytest.approx(expected, rel=1e-12)
    several = towers.changed(motion=["el-centro-1940-ns", "nanjing-artificial"])
    assert several.records == ["el-centro-1940-ns", "nanjing-artificial"]
    with pytest.raises(jostle.ModelError, match="either Motion objects or records"):
        towers.changed(motion=[motions[0], "el-centro-1940-ns"])
    with pytest.raises(jostle.ModelError, match="the list is empty"):
        towers.changed(motion=[])


def test_set_speaks_of_the_path(towers: jostle.Model) -> None:
    with pytest.raises(jostle.ModelError, match=r"gap\[3\].width: gap has 1 entry"):
        towers.set("gap[3].width", 1)
    with pytest.raises(jostle.ModelError, match="nearest|did you mean|unknown|no key"):
        towers.set("gap[0].witdh", "20 mm")
    assert towers.set("gap[0].width", np.float64(0.03)).description["gaps"][0]["width_m"] == 0.03
    assert towers.set("motion.pga", None).motion is not None


def test_unusual_values_are_accepted_if_asked(towers_file: Path) -> None:
    text = towers_file.read_text().replace('"20 mm"', "40.0")
    towers_file.write_text(text)
    with pytest.raises(jostle.ModelError, match="40"):
        jostle.Model.load(towers_file)
    accepted = jostle.Model.load(towers_file, accept_unusual=True)
    assert accepted.description["gaps"][0]["width_m"] == 40.0


def test_pint_quantities_are_quantities(towers: jostle.Model) -> None:
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    assert jostle.run(towers, gap=15 * unit.mm, pga=0.2 * unit.standard_gravity).summary["gaps"][0]["width_m"] == 0.015
    tower = jostle.Shear(
        "A", mass=[40, 30] * unit.tonne, stiffness=[60.0, 50.0] * unit.MN / unit.m, storey_height=3.2 * unit.m
    )
    plain = jostle.Shear("A", mass=["40 t", "30 t"], stiffness=["60 MN/m", "50 MN/m"], storey_height=3.2)
    assert jostle.Model([tower]).periods() == pytest.approx(jostle.Model([plain]).periods(), rel=1e-12)
    gap = jostle.Gap(20 * unit.mm, stiffness=2e9 * unit.N / unit.m**1.5)
    assert jostle.Model([tower, plain.__class__("B", mass="40 t", stiffness="60 MN/m", storeys=2, storey_height=3.2)], gap)
    motion = jostle.Motion([0, 0.1, -0.2, 0.0] * unit.standard_gravity, step=10 * unit.ms)
    assert motion.pga == pytest.approx(0.2 * 9.80665) and motion.step == 0.01
    assert jostle.collide(m1=40 * unit.tonne, m2="60 t", speed=40 * unit.cm / unit.s).impact_speed == pytest.approx(0.4)
    with pytest.raises(jostle.ModelError, match="gap: .*expected a length"):
        jostle.run(towers, gap=15 * unit.kg)
    with pytest.raises(jostle.ModelError, match="mass, length and time"):
        jostle.run(towers, gap=15 * unit.kelvin)


def test_tables_are_cut_and_sent(result: jostle.Result) -> None:
    table = result.impacts
    forces = table["peak_force_n"]
    strong = table[forces > np.median(forces)]
    assert len(strong) == int((forces > np.median(forces)).sum()) > 0
    assert np.array_equal(strong["peak_force_n"], forces[forces > np.median(forces)])
    assert list(table[1:4]["start_s"]) == list(table["start_s"][1:4])
    assert list(table[::-1]["start_s"]) == list(table["start_s"][::-1])
    assert [own["start_s"] for own in table[[2, 0]]] == [table[2]["start_s"], table[0]["start_s"]]
    assert len(table[np.array([], dtype=int)]) == len(table[[]]) == 0
    history = result.history
    late = history[history["time_s"] > 5.0]
    assert late["time_s"].min() > 5.0 and late.columns == history.columns
    for one in (table, late, result.buildings):
        again = pickle.loads(pickle.dumps(one))
        assert again.columns == one.columns and list(again) == list(one)
    assert table.to_polars().height == table.to_pandas().shape[0] == len(table)
    xarray = pytest.importorskip("xarray")
    assert isinstance(late.to_xarray(), xarray.Dataset)
    assert late.to_xarray().sizes == {"time_s": len(late)} and table.to_xarray().sizes == {"row": len(table)}
    with pytest.raises(IndexError, match="the mask has 1 entries"):
        table[[True]]
    with pytest.raises(TypeError, match="true and false or by numbers"):
        table[np.array([0.5])]


def test_starter_files_and_schemas_are_those_of_the_program(program: Program, tmp_path: Path) -> None:
    assert program("new", "mine", "--template", "towers").returncode == 0
    assert (tmp_path / "mine.toml").read_text() == jostle.template("towers", "mine")
    assert jostle.Model.loads(jostle.template()).buildings
    assert jostle.schema() == json.loads(program("schema").stdout)
    assert jostle.schema("results") == json.loads(program("schema", "--results").stdout)
    assert jostle.schema("combinations").startswith(program("schema", "--combinations").stdout[:40])
    with pytest.raises(jostle.ModelError, match="there is no template 'odd'"):
        jostle.template("odd")
    assert str(jostle.method("paper")) == program("method", "paper").stdout.rstrip()
