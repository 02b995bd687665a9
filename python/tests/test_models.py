"""Models from files, texts, dicts and builders, and what is said when they are wrong."""

from __future__ import annotations

import errno
import inspect
import json
import pickle
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import TOWERS, Program, build_towers

import jostle
from jostle import Frame, Gap, Link, Model, ModelError, Shear, _builders

TREE: dict[str, Any] = {
    "building": [{"kind": "shear", "storeys": 2, "mass": "40 t", "stiffness": "60 MN/m", "storey_height": 3}]
}


def frame(**changes: Any) -> Frame:
    fields: dict[str, Any] = {
        "storeys": 2,
        "storey_height": "3 m",
        "spans": ["6 m"],
        "column": {"width": "500 mm", "depth": "500 mm"},
        "beam": {"width": "300 mm", "depth": "600 mm"},
        "elastic_modulus": "30 GPa",
        "beam_mass": "3600 kg/m",
    }
    return Frame(**{**fields, **changes})


def test_units_in_names_are_units_in_texts() -> None:
    named = Frame(
        storeys=2,
        storey_height_cm=300,
        spans_m=[6],
        column={"width_mm": 500, "depth_mm": np.int64(500)},
        beam=[{"width_mm": 300, "depth_m": 0.6}] * 2,
        elastic_modulus_gpa=30,
        beam_mass_kg_m=np.array([3600.0, 3600.0]),
    )
    said = frame(storey_height="300 cm", beam=[{"width": "300 mm", "depth": "0.6 m"}] * 2)
    assert Model([named]).description == Model([said]).description


@pytest.mark.parametrize(
    ("named", "said"),
    [
        (Shear(storeys=1, mass_t=40, stiffness_mn_m=60), Shear(storeys=1, mass="40 t", stiffness="60 MN/m")),
        (Shear(storeys=1, mass_kg=4e4, stiffness_kn_m=6e4), Shear(storeys=1, mass=4e4, stiffness=6e7)),
        (Shear(storeys=1, mass_kn=400, stiffness_n_m=6e7), Shear(storeys=1, mass="400 kN", stiffness="6e7 N/m")),
        (frame(beam_mass=None, beam_mass_kn_m=30), frame(beam_mass="30 kN/m")),
        (frame(density_kg_m3=2400), frame(density="2400 kg/m3")),
        (frame(floor_mass_t=[1, 2]), frame(floor_mass=["1 t", "2 t"])),
        (frame(elastic_modulus=None, elastic_modulus_mpa=3e4), frame(elastic_modulus="30000 MPa")),
        (frame(storey_height=None, storey_height_ft=10), frame(storey_height="10 ft")),
    ],
)  # fmt: skip
@pytest.mark.filterwarnings("ignore::jostle.ModelWarning")
def test_every_unit_of_names(named: Frame | Shear, said: Frame | Shear) -> None:
    assert Model([named]).description == Model([said]).description


def test_gaps_find_their_neighbours() -> None:
    row = [Shear(n, storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3) for n in "abc"]
    model = Model(row, [Gap("10 mm"), Gap(width_mm=20, law="linear", stiffness_mn_m=500)])
    assert [gap["between"] for gap in model.description["gaps"]] == [["a", "b"], ["b", "c"]]
    assert [gap["width_m"] for gap in model.description["gaps"]] == [0.01, 0.02]
    same = Model(row, Gap("10 mm"))
    assert [gap["width_m"] for gap in same.description["gaps"]] == [0.01, 0.01]
    nameless = [Shear(storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3)] * 2
    assert Model(nameless, Gap("5 mm")).description["gaps"][0]["between"] == ["B1", "B2"]


def test_walls_links_and_widths_of_their_own() -> None:
    row = [Shear(n, storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3) for n in "ab"]
    gaps = [
        Gap(width_mm=[10, 20], between=["a", "b"], level_tolerance="5 mm"),
        Gap("30 mm", between=["wall", "a"], floors=[["wall", 2]]),
        Gap("40 mm", between=["b", "wall"]),
        Gap("5 mm", between=["a", "b"], floors=[[2, 2]], law="rubber", stiffness_mn_m=20, thickness_mm=4),
    ]
    link = Link(["a", "b"], damping_kn_s_m=500, stiffness="1 MN/m", floors=[[2, 2]])
    description = Model(row, gaps, links=link).description
    assert [gap["between"] for gap in description["gaps"]][1:3] == [["wall", "a"], ["b", "wall"]]
    assert [contact["width_m"] for contact in description["gaps"][0]["contacts"]] == [0.01, 0.02]
    assert [contact["floors"] for contact in description["gaps"][1]["contacts"]] == [[None, 2]]
    [joined] = description["links"]
    assert joined["damping_n_s_m"] == 5e5 and joined["stiffness_n_m"] == 1e6
    assert joined["floors"] == [{"floors": [2, 2], "height_m": 6.0}]
    assert link == Link(["a", "b"], damping="500 kN.s/m", stiffness="1 MN/m", floors=[[2, 2]])
    assert "<rect" in Model(row, gaps, links=[link])._repr_html_()
    with pytest.raises(ModelError, match="two buildings that are not neighbours|no building"):
        Model(row, [], links=Link(["wall", "wall"], damping=1e5))
    with pytest.raises(ModelError, match="neither|damping"):
        Model(row, [], links=Link(["a", "b"]))


def test_a_gap_between_strangers_is_refused() -> None:
    row = [Shear(n, storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3) for n in "ab"]
    with pytest.raises(ModelError, match='there is no building "c"'):
        Model(row, Gap("10 mm", between=["a", "c"]))


def test_errors_are_those_of_the_command_line(program: Program, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(TOWERS.replace('"3.2 m"', '"3.2 kg"', 1).replace("restitution =", "restituton ="))
    done = program("check", str(path))
    assert done.returncode == 2
    with pytest.raises(ModelError) as caught:
        Model.load(path)
    assert f"error: {caught.value}".strip() == done.stderr.strip()
    faults = caught.value.faults
    assert [fault.path for fault in faults] == ["building[0].storey_height", "gap[0].restituton"]
    assert faults[0].line == 12 and faults[0].column == 17
    assert faults[1].remedy == 'did you mean "restitution"?'
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value) and again.faults == faults


def test_errors_of_models_made_in_python_name_the_field() -> None:
    with pytest.raises(ModelError) as caught:
        Model([Shear("a", mass="40 kg/m", stiffness="60 MN/m", storeys=2, storey_height=3)])
    assert str(caught.value) == (
        'model: building[0].mass: expected a mass (such as "40 t"), found "40 kg/m"\n\n1 fault in model'
    )
    assert caught.value.faults[0].line is None


def test_errors_end_in_the_users_own_line() -> None:
    with pytest.raises(ModelError) as caught:
        Model.from_dict({})
    assert len(caught.traceback) <= 3, "short tracebacks"


def test_faults_that_only_assembly_shows_name_their_line() -> None:
    text = TOWERS.replace('storey_height = "3.2 m"', 'storey_height = "3.2 m"\ndamping = { modes = [1, 9] }', 1)
    with pytest.raises(ModelError) as caught:
        Model.loads(text, name="x.toml")
    assert caught.value.faults[0].line == 13


@pytest.mark.parametrize(
    ("tree", "problem"),
    [
        ({"building": [{"mass": float("nan")}]}, r"building\[0\].mass: expected a finite number"),
        ({"building": [{"mass": [1.0, float("inf")]}]}, r"building\[0\].mass\[1\]"),
        ({"building": {1: 2}}, "building: keys are texts, found int"),
        ({"building": b"x"}, "building: a model cannot hold a bytes"),
        ({"building": object()}, "a model cannot hold a object"),
        ({"title": 10**400}, "title: expected a number of usable size"),
    ],
)
def test_what_no_file_can_hold_is_named(tree: Any, problem: str) -> None:
    with pytest.raises(ModelError, match=problem):
        Model.from_dict(tree)


def test_endless_trees_are_refused() -> None:
    tree: dict[str, Any] = {}
    tree["building"] = [tree]
    with pytest.raises(ModelError, match="nested too deeply"):
        Model.from_dict(tree)


def test_numpy_stands_for_numbers_and_lists() -> None:
    tree = {"building": [{**TREE["building"][0], "mass": np.array([4e4, 4e4]), "stiffness": np.float32(6e7)}]}
    assert Model.from_dict(tree).description == Model.from_dict(TREE).description


def test_json_is_read_as_well(tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    path.write_text(json.dumps(TREE))
    expected = Model.from_dict(TREE).description
    assert Model.load(path).description == expected
    assert Model.loads(json.dumps(TREE)).description == expected


def test_the_words_of_arguments() -> None:
    model = build_towers()
    with pytest.raises(ModelError, match="^gap: expected a length"):
        model.changed(gap="3 kg")
    with pytest.raises(TypeError, match="gap is given twice"):
        model.changed(gap="3 mm", gap_mm=3)
    with pytest.raises(TypeError, match="unexpected keyword argument 'gap_pt'"):
        model.changed(gap_pt=3)  # type: ignore[call-arg]
    with pytest.raises(ModelError, match="must not be negative"):
        model.changed(gap=-0.1)
    with pytest.raises(TypeError, match="width is given twice"):
        Gap("3 mm", width_mm=3)
    with pytest.raises(ModelError, match="^model: gap"):
        Model([Shear("a", mass=1, stiffness=1, storeys=1, storey_height=3)], Gap("3 mm"))
    with pytest.raises(TypeError, match="expected a Model"):
        jostle.modes("paper")  # type: ignore[arg-type]


def test_changes_leave_the_model_alone(towers: Model) -> None:
    before = towers.description
    wide = towers.changed(gap_mm=35, pga="1 m/s2")
    assert towers.description == before
    assert wide.description["gaps"][0]["width_m"] == 0.035
    assert wide.motion is not None and wide.motion.pga == 1.0


def test_models_travel(towers_file: Path) -> None:
    pulse = jostle.Motion.ricker(amplitude="3 m/s2", period="0.5 s").scaled(2.0).reversed()
    for model in (
        Model.paper_example(),
        Model.load(towers_file).changed(gap="5 mm").changed(pga="1 m/s2"),
        build_towers().changed(motion=pulse),
    ):
        copy = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(model))))
        assert copy.description == model.description
        ours, theirs = copy.motion, model.motion
        assert ours is not None and theirs is not None
        assert ours.acceleration.tobytes() == theirs.acceleration.tobytes()


def test_what_may_not_be_meant_is_a_warning() -> None:
    with pytest.warns(jostle.ModelWarning, match="storeys of 3 m are assumed"):
        model = Model([Shear("a", mass=["40 t", "40 t"], stiffness="60 MN/m")])
    assert len(model.warnings) == 1


def test_records_are_found_beside_the_file(tmp_path: Path) -> None:
    (tmp_path / "quake.csv").write_text("# step = 0.01 s\n# unit = m/s2\n" + "0\n1\n-1\n" * 20)
    tree = {**TREE, "motion": {"record": "quake.csv"}}
    path = tmp_path / "model.json"
    path.write_text(json.dumps(tree))
    for model in (Model.load(path), Model.from_dict(tree, folder=tmp_path)):
        assert model.motion is not None and model.motion.name == "quake"
    lost = Model.from_dict(tree)
    with pytest.raises(ModelError, match='there is no record "quake.csv"'):
        jostle.run(lost)
    with pytest.raises(ModelError, match="^motion: there is no record"):
        jostle.run(lost, motion="quake2.csv")
    assert jostle.run(lost, motion=jostle.Motion.read(tmp_path / "quake.csv")).completed


def test_dampers_of_a_building_are_links_inside_it() -> None:
    damper = {"floors": [0, 1], "law": "viscous", "damping": "200 kN.(s/m)^0.5", "exponent": 0.5}
    tower = Shear("a", storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3, damper=[damper])
    plain = Shear("a", storeys=2, mass="40 t", stiffness="60 MN/m", storey_height=3)
    link = Link(
        ["a", "a"], floors=[[0, 1]], law="viscous", damping="200 kN.(s/m)^0.5", exponent=0.5
    )
    motion = jostle.Motion.el_centro().lasting("5 s")
    models = [
        Model([tower], motion=motion, output={"links": True}),
        Model([plain], links=link, motion=motion, output={"links": True}),
    ]
    runs = [jostle.run(model) for model in models]
    links = [run.summary["links"] for run in runs]
    assert links[0] == links[1]
    assert links[0][0]["dissipated_j"] > 0
    [joined] = runs[0].links
    assert joined.stroke is not None and joined.speed is not None
    assert max(abs(joined.stroke)) == pytest.approx(links[0][0]["stroke_peak_m"], rel=1e-2)
    assert max(abs(joined.speed)) == pytest.approx(links[0][0]["speed_peak_m_s"], rel=1e-2)
    assert jostle.run(Model([tower], motion=motion)).links[0].stroke is None
    with pytest.raises(ModelError, match=r"damper\[0\]\.floors: floor 5 does not exist"):
        Model([Shear("a", mass=[4e4, 4e4], stiffness=[6e7, 6e7], damper=[{**damper, "floors": [0, 5]}])])


def test_every_key_of_the_model_file_is_a_keyword() -> None:
    schema = json.loads(
        subprocess.run(
            [sys.executable, "-m", "jostle", "schema"], check=True, capture_output=True, text=True
        ).stdout
    )["properties"]

    def keys(table: dict[str, Any]) -> set[str]:
        return set(table["properties"]) - {"kind"}

    def keywords(part: type) -> set[str]:
        # What is a word of Python itself, such as yield, ends with an underscore.
        return {name.rstrip("_") for name in inspect.signature(part).parameters} - {"units"}

    frame, in_plan, shear, space, given = schema["building"]["items"]["oneOf"]
    assert keywords(Frame) == keys(frame)
    assert keywords(Shear) == keys(shear) == keys(in_plan)
    # These are not possible with a space frame.
    refused = {"frame"}
    assert keywords(jostle.SpaceFrame) == keys(space) - refused
    # "units" is a key of its own there; floors is another name of storeys, and gravity is part of the matrices.
    without = {"floors", "gravity", "p_delta", "units"}
    assert keywords(jostle.Given) - {"units_in_names"} == keys(given) - without
    assert keywords(Gap) == keys(schema["gap"]["items"])
    assert keywords(jostle.Link) == keys(schema["link"]["items"])
    laws = set(schema["gap"]["items"]["properties"]["law"]["enum"])
    literal = inspect.getsource(_builders).split("_Law = Literal[")[1].split("]")[0]
    assert set(re.findall(r'"([^"]+)"', literal)) == laws


def test_frames_stand_at_lines_of_a_plan_before_a_wall() -> None:
    frame = {
        "spans": ["6 m", "6 m"],
        "column": {"width": "500 mm", "depth": "500 mm"},
        "beam": {"width": "300 mm", "depth": "600 mm"},
        "concrete": "C30",
    }
    frames = [
        {**frame, "name": "x", "at": [["0 m", "0 m"], ["0 m", "12 m"]]},
        {**frame, "name": "y", "at": [["0 m", "0 m"], ["12 m", "0 m"]], "direction": "y"},
    ]
    tower = Shear("a", mass="150 t", storeys=3, storey_height="3.2 m", plan=["12 m", "12 m"], frame=frames)
    wall = jostle.Wall("boundary", from_=["12.01 m", "0 m"], to=["12.01 m", "12 m"])
    gap = Gap(between=["a", "boundary"], width="10 mm", law="kelvin", stiffness="100 MN/m")
    motion = jostle.Motion.el_centro().scaled(pga="0.3 g").lasting("6 s")
    model = Model([tower], gap, motion=motion, walls=[wall])
    run = jostle.run(model, record_interval=None)
    assert run.summary["buildings"][0]["floors"][2]["displacement_across_max_m"] < 1e-6
    assert run.summary["gaps"][0]["peak_force_n"] > 0
    assert len(jostle.modes(model)["a"].periods) > 3


def test_space_frames_yield_member_by_member() -> None:
    moments = {"yield": "120 kN.m", "post_yield": 0.02}
    frame = jostle.SpaceFrame(
        "a",
        lines_x_m=[0, 6],
        lines_y_m=[0, 5],
        storeys=2,
        storey_height="3.2 m",
        mass_t=60,
        elastic_modulus_gpa=30,
        column={"size": ["450 mm", "400 mm"]},
        beam_x={"width_mm": 300, "depth_mm": 500},
        beam_y=[{"width": "300 mm", "depth": "450 mm", "hinge": {"yield": "80 kN.m", "post_yield": 0.02}}],
        hinges={"rule": "bilinear", "column": {"x": moments, "y": {**moments, "yield": "100 kN.m"}}, "beam": moments},
        damping={"ratio": 0.05, "modes": [1, 2]},
    )
    motion = jostle.Motion.el_centro().scaled(pga="0.6 g").lasting("4 s")
    run = jostle.run(Model([frame], motion=motion))
    hinges = run.summary["buildings"][0]["hinges"]
    # Columns at two ends in two planes, beams at two ends.
    assert hinges["total"] == 8 * 4 + 8 * 2
    places = {spring["place"] for spring in hinges["list"]}
    assert hinges["yielded"] > 0 and "column.1.1.1, foot, x" in places
    own = jostle.modes(Model([frame]))["a"]
    assert len(own.periods) == 6
    for kind in ("x", "across", "torsion"):
        assert abs(getattr(own, f"effective_mass_ratios_{kind}").sum() - 1) < 1e-9
    assert "mass torsion [%]" in own._repr_html_()
    with pytest.raises(ModelError, match="vertical plane only"):
        Model([jostle.SpaceFrame(**{**keywords_of(frame), "hinges": {"rule": "bilinear", "beam": {"x": moments}}})])


def keywords_of(part: Any) -> dict[str, Any]:
    return {key: value for key, value in part.to_dict().items() if key != "kind" and value is not None}


def test_given_buildings_are_those_of_their_matrices() -> None:
    shear = Shear("a", mass=[4e4, 3e4], stiffness=[6e7, 5e7], storey_height=3)
    matrices = {"stiffness": np.array([[11e7, -5e7], [-5e7, 5e7]]), "mass": np.diag([4e4, 3e4])}
    ports: dict[str, dict[str, object]] = {
        "1": {"dof": 1, "height": 3},
        "2": {"dof": 2, "height": "6 m"},
    }
    given = jostle.Given("a", matrices=matrices, ports=ports)
    stiff = Shear("b", mass=[4e4, 4e4], stiffness=[9e7, 9e7], storey_height=3)
    motion = jostle.Motion.el_centro().lasting("6 s")
    gap = Gap("5 mm", law="kelvin", stiffness="100 MN/m")
    models = [Model([shear, stiff], gap, motion=motion), Model([given, stiff], gap, motion=motion)]
    runs = [jostle.run(model, record_interval=None, sensitivity=True) for model in models]
    forces = [run.summary["gaps"][0]["peak_force_n"] for run in runs]
    assert forces[0] > 0
    assert forces[1] == pytest.approx(forces[0], rel=1e-9)
    spread = runs[0].summary["contact_sensitivity"]["gaps"][0]
    assert spread["peak_force_min_n"] < forces[0] < spread["peak_force_max_n"]
    modes = jostle.modes(Model([shear]))["a"]
    by_modes = jostle.Given(
        "a", mass=[4e4, 3e4], periods=modes.periods, shapes=modes.floor_shapes, storey_height_m=3
    )
    again = jostle.modes(Model([by_modes]))["a"]
    assert again.periods == pytest.approx(modes.periods, rel=1e-9)
    with pytest.raises(jostle.ModelError, match="symmetric"):
        Model([jostle.Given(matrices={**matrices, "stiffness": [[2, 1], [0, 2]]}, ports=ports)])


def test_given_buildings_in_plan_turn() -> None:
    m, j, k = 4e4, 4e4 * 100 / 12, 6e7
    # A spring across, 1 m right of the middle.
    matrices = {"stiffness": np.array([[k, 0, 0], [0, k, k], [0, k, 40 * k]]), "mass": np.diag([m, m, j])}
    ports: dict[str, dict[str, object]] = {"1": {"dofs": [1, 2, 3], "height": "3 m"}}
    given = jostle.Given("a", matrices=matrices, ports=ports, plan=["8 m", "6 m"], at=["0 m", "0 m"])
    model = Model([given], motion=jostle.Motion.el_centro().lasting("2 s"))
    assert model.description["buildings"][0]["kind"] == "given"
    values = np.linalg.eigvals(np.diag([1 / m, 1 / m, 1 / j]) @ matrices["stiffness"])
    expected = np.sort(2 * np.pi / np.sqrt(np.real(values)))[::-1]
    assert jostle.modes(model)["a"].periods == pytest.approx(expected, rel=1e-10)


def test_keywords_reach_the_model() -> None:
    hinges = {"rule": "bilinear", "yield": "20 mm", "post_yield": 0.05}
    common: dict[str, Any] = {"mass": "40 t", "stiffness": "10 MN/m", "storey_height": 3}
    a = Shear("a", **common, storeys=2, hinges=hinges, p_delta=True, gravity=False)
    b = Shear("b", **common, floors=2, base={"horizontal_stiffness": "90 MN/m"})
    gap = Gap("5 mm", law="bilinear", yield_share=0.2, design_speed_m_s=0.5)
    model = Model([a, b], gap, motion=jostle.Motion.el_centro().lasting("4 s"))
    assert jostle.run(model, record_interval=None).summary["buildings"][0]["hinges"]["yielded"] > 0


def test_contact_constants_reach_the_model() -> None:
    common: dict[str, Any] = {"mass": "40 t", "storeys": 1, "storey_height": 3}
    a = Shear("a", **common, stiffness="10 MN/m")
    b = Shear("b", **common, stiffness="90 MN/m")

    def contact(gap: Gap) -> dict[str, Any]:
        model = Model([a, b], gap, motion=jostle.Motion.el_centro().lasting("4 s"))
        gaps = jostle.run(model, record_interval=None).summary["gaps"]
        return {**gaps[0], **gaps[0]["contacts"][0]}

    dashpot = Gap("5 mm", law="kelvin", stiffness_mn_m=90, damping_mn_s_m=1.1)
    assert 0 < contact(dashpot)["equivalent_restitution"] < 1
    crushed = contact(
        Gap("5 mm", law="linear", stiffness_mn_m=200, crush={"force": "200 kN", "hardening": 0.05})
    )
    assert crushed["crushed_depth_m"] > 0
    assert crushed["free_restitution"] is None
    constants = Gap(
        "5 mm", law="bilinear", stiffness_mn_m=400, second_stiffness_mn_m=120, yield_mm=1.5
    )
    assert contact(constants)["law"] == "bilinear (constants given)"
    hertz = contact(Gap("5 mm", law="hertz-damp", stiffness=2e9, restitution=0.5))
    text = "k * d^1.5 * (1 + 0.75 * (1 - e^2) * v / v0)"
    written = contact(Gap("5 mm", law="formula", formula=text, stiffness=2e9, restitution=0.5))
    assert written["law"] == "formula"
    assert written["peak_force_n"] == pytest.approx(hertz["peak_force_n"], rel=1e-6)
    found = jostle.collide(
        "kelvin", m1="40 t", m2="60 t", speed="0.4 m/s", stiffness=1e8, damping="1.1 MN.s/m"
    )
    ratio = 1.1e6 / (2 * np.sqrt(1e8 * 24e3))
    expected = np.exp(-np.pi * ratio / np.sqrt(1 - ratio**2))
    assert found.realised_restitution == pytest.approx(expected, rel=1e-9)
    with pytest.raises(ModelError, match="cannot be combined with restitution"):
        jostle.collide("kelvin", m1=1, m2=1, speed=1, damping=1, restitution=0.5)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: Gap("5 mm", lwa="hertz"), "Gap.. got an unexpected keyword argument 'lwa'; did you mean 'law'"),  # type: ignore[call-arg]
        (lambda: Frame("a", hings={}), "did you mean 'hinges'"),  # type: ignore[call-arg]
        (lambda: Shear("a", stifness="60 MN/m"), "did you mean 'stiffness'"),  # type: ignore[call-arg]
        (lambda: Shear("a", mas_t=[40]), "did you mean 'mass_t'"),  # type: ignore[call-arg]
        (lambda: jostle.run("paper", gpa="1 m/s2"), "^run.. got .*'gpa'; did you mean 'pga'"),  # type: ignore[call-arg]
        (lambda: jostle.run("paper", without_contacts=True), "did you mean 'without_contact'"),  # type: ignore[call-arg]
        (lambda: jostle.Motion.el_centro().scaled(pga_gg=1), "did you mean 'pga_g'"),  # type: ignore[call-arg]
    ],
)
def test_misspelt_keywords_are_refused_with_the_nearest(call: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        call()


def test_a_run_takes_whatever_names_a_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    paper = jostle.run("paper", record_interval=None)
    assert paper.summary["title"] == Model.paper_example().title
    assert jostle.run(TREE, record_interval=None, motion="el-centro-1940-ns").completed
    # As on the command line, a file comes first.
    monkeypatch.chdir(tmp_path)
    (tmp_path / "paper").write_text(TOWERS)
    assert jostle.run("paper", record_interval=None).summary["title"] != paper.summary["title"]


def test_a_file_that_is_not_there_is_a_file_not_found_error() -> None:
    for call in (
        lambda: Model.load("lost.toml"),
        lambda: jostle.run("lost.toml"),
        lambda: jostle.Motion.read("lost.at2"),
    ):
        with pytest.raises(FileNotFoundError, match="lost") as caught:
            call()
        assert isinstance(caught.value, ModelError) and isinstance(caught.value, jostle.MissingFileError)
        assert caught.value.filename.startswith("lost.") and caught.value.errno == errno.ENOENT
        again = pickle.loads(pickle.dumps(caught.value))
        assert str(again) == str(caught.value) and again.filename == caught.value.filename


def test_the_former_name_of_from_any_still_works() -> None:
    with pytest.warns(DeprecationWarning, match="from_any"):
        model = jostle.Model.of("paper")
    assert model.title == jostle.Model.from_any("paper").title


def test_buildings_stand_on_soil() -> None:
    foundation = {"length": "12 m", "width": "12 m", "mass": "120 t"}
    towers = [
        Shear("A", storeys=2, storey_height="3 m", mass_t=40, stiffness_mn_m=60, foundation=foundation),
        Shear("B", storeys=2, storey_height="3 m", mass_t=60, stiffness_mn_m=160, foundation=foundation),
    ]
    gap = Gap(width_mm=10, law="linear", stiffness="500 MN/m")
    soil = jostle.Soil(shear_wave_velocity="150 m/s", density="1800 kg/m3", poisson_ratio=0.33, coupling="static")
    model = Model(towers, gap, soil=soil, motion={"record": "el-centro-1940-ns", "duration": "3 s"})
    for building in jostle.run(model).summary["buildings"]:
        own = building["foundation"]
        assert own["period_ratio"] > 1.0
        assert 0.0 < own["rocking_peak_rad"] < 0.01
        assert own["sway_stiffness_n_m"] == pytest.approx(1.339e9, rel=1e-3)
    with pytest.raises(ModelError, match=r"needs \[soil\]"):
        Model(towers, gap)
    matrix = np.diag([1e9, 5e10])
    one = Model(towers[:1], soil=jostle.Soil(coupling={"stiffness": matrix, "damping": matrix / 100}))
    assert one.description


def test_tall_frames_bounds_of_bearings_and_filtered_accelerations() -> None:
    tall: dict[str, Any] = {"storeys": 12, "storey_height": 3, "spans": [12], "concrete": "C30", "beam_mass": 5000}
    sections: dict[str, Any] = {"column": {"width": 0.5, "depth": 0.5}, "beam": {"width": 0.3, "depth": 0.6}}
    frames = [jostle.Frame("a", **tall, **sections, axial=own) for own in (None, "flexible", "rigid")]
    default, flexible, rigid = (jostle.modes(Model([own]))["a"].periods[0] for own in frames)
    assert default == flexible > rigid

    bearings = {"kind": "linear", "mat_mass": "60 t", "stiffness": "2 MN/m"}

    def run(factor: float, bounds: dict[str, float] | None) -> jostle.Result:
        own = {**bearings, "stiffness": 2e6 * factor}
        own |= {"bounds": bounds} if bounds else {}
        building = Shear("b", mass=[4e4, 4e4], stiffness=[9e7, 9e7], storey_height=3, isolation=own)
        return jostle.run(Model([building], motion=jostle.Motion.el_centro().lasting("6 s")))

    found = run(1, {"lower": 0.8, "upper": 1.25})
    stroke = found.summary["isolation_bounds"]["buildings"][0]["stroke_m"]
    by_hand = [run(factor, None).summary["buildings"][0]["isolation"] for factor in (1, 0.8, 1.25)]
    strokes = [max(own["displacement_max_m"], -own["displacement_min_m"]) for own in by_hand]
    assert [stroke["nominal"], stroke["lower"], stroke["upper"]] == pytest.approx(strokes, rel=1e-9)
    assert stroke["envelope"] == max(strokes)

    # With the run without contact, gaps have the width needed at the bounds as well, as on the command line.
    isolated = Shear(
        "b", mass=[4e4], stiffness=[9e7], storey_height=3, isolation={**bearings, "bounds": {"lower": 0.8, "upper": 1.25}}
    )
    beside = Shear("c", mass=[4e4], stiffness=[9e7], storey_height=3)
    pair = Model([isolated, beside], Gap("100 mm"), motion=jostle.Motion.el_centro().lasting("6 s"))
    summary = jostle.run(pair, without_contact=True).summary
    needed = summary["isolation_bounds"]["gaps"][0]["closing_without_contact_m"]
    assert needed["nominal"] == summary["gaps"][0]["closing_without_contact_m"]
    assert needed["envelope"] == max(needed["nominal"], needed["lower"], needed["upper"]) > needed["nominal"]
    (critical,) = jostle.critical_gap(pair, outcomes=False)
    assert critical.gap_at_bounds is not None
    assert critical.gap_at_bounds[0] >= needed["lower"] - 1e-4

    # Nothing strikes: the filter below 25 Hz leaves the peak.
    for building in found.summary["buildings"]:
        filtered, raw = building["filtered_acceleration_peak_m_s2"], building["total_acceleration_peak_m_s2"]
        assert filtered == pytest.approx(raw, rel=0.02)
