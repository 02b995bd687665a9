"""Buildings from OpenSees: its own periods and forces, and every trap with its message."""

from __future__ import annotations

import contextlib
import io
import math
import runpy
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import jostle
from jostle import _opensees_file
from jostle._opensees_matrices import read_model

try:
    with contextlib.redirect_stderr(io.StringIO()):
        import openseespy.opensees as ops
except Exception as error:
    pytest.skip(f"OpenSeesPy cannot be imported: {error}", allow_module_level=True)

SCRIPTS = Path(__file__).parent / "opensees"
#: N/m of one kip/in.
KIP_IN = 4448.2216152605 / 0.0254


@pytest.fixture(autouse=True)
def empty_model() -> Iterator[None]:
    ops.wipe()
    yield
    ops.wipe()


def build(script: str) -> None:
    with contextlib.redirect_stderr(io.StringIO()):
        runpy.run_path(str(SCRIPTS / f"{script}.py"))


def own_periods(count: int) -> Any:
    ops.constraints("Transformation")
    with contextlib.redirect_stderr(io.StringIO()):
        squares = ops.eigen("-fullGenLapack", count)
    return 2.0 * math.pi / np.sqrt(np.array(squares))


def quietly(*arguments: Any, **options: Any) -> jostle.Given:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jostle.ModelWarning)
        return jostle.from_opensees(*arguments, **options)


def read_script(script: str, **options: Any) -> jostle.Given:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jostle.ModelWarning)
        return jostle.import_opensees(SCRIPTS / f"{script}.py", **options)


def damp(first: int, second: int) -> tuple[float, float]:
    """Rayleigh damping of 5 % at two modes."""
    with contextlib.redirect_stderr(io.StringIO()):
        squares = ops.eigen("-fullGenLapack", second)
    a, b = squares[first - 1] ** 0.5, squares[second - 1] ** 0.5
    beta = 2.0 * 0.05 / (a + b)
    ops.rayleigh(beta * a * b, beta, 0.0, 0.0)
    return beta * a * b, beta


def portal(**masses: float) -> None:
    """Two storeys and one bay, kN and m, mass on the left nodes only unless told."""
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for level in range(3):
        for line in range(2):
            ops.node(2 * level + line + 1, 6.0 * line, 3.5 * level)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 1, 1, 1)
    for level in (1, 2):
        ops.mass(2 * level + 1, 20.0, masses.get("up", 0.0), 0.0)
    ops.geomTransf("Linear", 1)
    for tag, (i, j) in enumerate([(1, 3), (3, 5), (2, 4), (4, 6), (3, 4), (5, 6)], 1):
        ops.element("elasticBeamColumn", tag, i, j, 0.16, 3e7, 2e-3, 1)


def test_periods_are_those_of_opensees_and_as_published() -> None:
    build("seven_storeys")
    own = own_periods(7)
    building = quietly(ops, units="kip, in", name="A")
    # The period of the two kinds of model differs by rounding alone, although jostle holds 7 of 49 displacements.
    ours = jostle.modes(jostle.Model(building), 7)["A"].periods
    assert ours == pytest.approx(own, rel=1e-10)
    published = [1.2732, 0.4313, 0.2420, 0.1602, 0.1190, 0.0951, 0.0795]
    assert ours == pytest.approx(published, rel=6e-4)


def test_periods_in_space_are_those_of_opensees() -> None:
    build("space")
    own = own_periods(6)
    for direction in ("x", "y"):
        build("space")
        building = quietly(ops, direction=direction, name="A")
        tree = building.to_dict()
        ours = jostle.modes(jostle.Model(building), 6)["A"].periods
        assert ours == pytest.approx(own, rel=1e-10)
        mass = np.array(tree["matrices"]["mass"])
        # Static moment of the mass about the retained node: 2 (300 − 200) kg × 2 m.
        coupling = abs(mass[1, 2])
        assert coupling == pytest.approx(400.0, rel=1e-12)
        assert ("angle" in tree) == (direction == "y")


def test_a_building_is_turned_to_the_row() -> None:
    build("space")
    along_y = quietly(ops, direction=2, name="A")
    model = jostle.Model(along_y)
    plan = np.array(model.description["buildings"][0]["plans"][0]["corners_m"])
    # 3 m along the row and 4 m across.
    assert np.ptp(plan[:, 0]) == pytest.approx(3.0)
    assert np.ptp(plan[:, 1]) == pytest.approx(4.0)


def test_rotations_have_units_of_their_own() -> None:
    build("space")
    metres, feet = (np.array(quietly(ops, units=units).to_dict()["matrices"]["mass"]) for units in ("N, m", "kip, ft"))
    kip, foot = 4448.2216152605, 0.3048
    assert feet[0, 0] == pytest.approx(metres[0, 0] * kip / foot, rel=1e-12)
    assert feet[1, 2] == pytest.approx(metres[1, 2] * kip, rel=1e-12)
    assert feet[2, 2] == pytest.approx(metres[2, 2] * kip * foot, rel=1e-12)


def test_rayleigh_damping_is_found() -> None:
    build("seven_storeys")
    alpha, beta = damp(1, 3)
    stated = quietly(ops, units="kip, in").to_dict()["damping"]
    assert float(stated["alpha"].split()[0]) == pytest.approx(alpha, rel=1e-9)
    assert float(stated["beta"].split()[0]) == pytest.approx(beta, rel=1e-9)


def test_a_pair_pounds_as_in_opensees() -> None:
    # OpenSees 3.7.1 with both frames in one domain and zeroLength ElasticPPGap springs of 1000 kip/in, 0.5 in apart, El
    # Centro at 0.4 g, Newmark with steps of 0.1 ms: 1050.697 and 2426.458 kN; with jostle 1050.695 and 2426.463 kN.
    build("seven_storeys")
    damp(1, 3)
    left = quietly(ops, units="kip, in", name="A")
    right = read_script("two_storeys", units="kip, in", side="left", name="B")
    model = jostle.Model(
        [left, right],
        jostle.Gap(width="0.5 in", law="linear", stiffness=f"{1000.0 * KIP_IN!r} N/m"),
        motion={"record": "el-centro-1940-ns", "pga": "0.4 g"},
        analysis={"tolerance": 1e-5},
    )
    summary = jostle.run(model, record_interval=None).summary
    forces = [contact["peak_force_n"] for contact in summary["gaps"][0]["contacts"]]
    assert forces == pytest.approx([1_050_697.0, 2_426_458.0], rel=1e-5)
    roofs = [building["floors"][-1]["displacement_max_m"] for building in summary["buildings"]]
    assert roofs == pytest.approx([0.162907, 0.115963], rel=1e-5)


def test_a_floor_is_hit_where_a_unit_force_says() -> None:
    # Tied nodes list their equations in another order, free ones first: with vertical mass the wrong one would be found.
    portal(up=20.0)
    for level in (1, 2):
        ops.equalDOF(2 * level + 1, 2 * level + 2, 1)
        ops.mass(2 * level + 2, 0.0, 20.0, 0.0)
    tree = quietly(ops, side="right", units="kN, m").to_dict()
    inverse = np.linalg.inv(np.array(tree["matrices"]["stiffness"]))
    for port, node in (("1", 4), ("2", 6)):
        ops.loadConst("-time", 0.0)
        ops.timeSeries("Constant", node)
        ops.pattern("Plain", node, node)
        ops.load(node, 1.0, 0.0, 0.0)
        ops.wipeAnalysis()
        ops.constraints("Transformation")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.integrator("LoadControl", 1.0)
        ops.algorithm("Linear")
        ops.analysis("Static")
        assert ops.analyze(1) == 0
        row = tree["ports"][port]["dof"] - 1
        assert 1e-3 * ops.nodeDisp(node, 1) == pytest.approx(inverse[row, row], rel=1e-10)
        ops.remove("loadPattern", node)
        ops.reset()


def test_masses_without_a_place_to_hit_are_named() -> None:
    portal()
    with pytest.raises(jostle.ModelError, match=r"nodes 4 at 3\.5 m, 6 at 7 m have none") as caught:
        quietly(ops, side="right", units="kN, m")
    assert "equalDOF" in str(caught.value)
    # On the other side there is mass, and other nodes can be named.
    assert quietly(ops, side="left", units="kN, m").to_dict()["ports"]["2"]["height"] == 7.0
    assert quietly(ops, ports=[5, 3], units="kN, m").to_dict()["ports"]["1"]["height"] == 3.5


def test_masses_of_fillers_count_as_none() -> None:
    portal(up=1e-10)
    assert np.shape(quietly(ops, side="left", units="kN, m").to_dict()["matrices"]["mass"]) == (2,)


def frame_of_three_storeys(filler: float) -> None:
    """Two bays of 20 ft, three storeys of 12 ft, in kip and in; vertical and rotary masses of every node as given."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for level in range(4):
        for line in range(3):
            ops.node(10 * level + line, 240.0 * line, 144.0 * level)
    for line in range(3):
        ops.fix(line, 1, 1, 1)
    tag = 0
    for level in range(1, 4):
        for line in range(3):
            tag += 1
            node = 10 * level + line
            ops.element("elasticBeamColumn", tag, node - 10, node, 26.5, 29000.0, 999.0, 1)
            ops.mass(node, 40.0 / 386.089, filler, filler)
        for line in range(2):
            tag += 1
            node = 10 * level + line
            ops.element("elasticBeamColumn", tag, node, node + 1, 16.2, 29000.0, 1350.0, 1)
        for line in (1, 2):
            ops.equalDOF(10 * level, 10 * level + line, 1)


@pytest.mark.parametrize("filler", [1e-12, 1e-9, 1e-6])
def test_periods_printed_are_those_without_fillers(filler: float, tmp_path: Path) -> None:
    frame_of_three_storeys(0.0)
    ops.constraints("Transformation")
    exact = own_periods(3)
    assert exact == pytest.approx([0.62839, 0.19502, 0.11236], abs=5e-6)
    frame_of_three_storeys(filler)
    read = read_model(ops, 1, "right", "kip, in", None, None, None)
    assert read.periods is not None
    # Below the limit masses are omitted. Above it they are part of the model, and change its periods by parts of a million.
    if filler < 1e-8 * 40.0 / 386.089:
        assert len(read.mass) == 3
        assert read.periods == pytest.approx(exact, rel=1e-9)
    else:
        assert len(read.mass) == 12
        assert read.periods[:3] == pytest.approx(own_periods(3), rel=1e-6)


def refuse(match: str, **options: Any) -> None:
    with pytest.raises(jostle.ModelError, match=match):
        quietly(ops, **{"side": "left", "units": "kN, m", **options})


def test_models_that_are_no_buildings_are_refused() -> None:
    refuse("no model in memory")
    portal()
    refuse("units: expected force and length", units="kip")
    refuse("direction: expected 1 or 2", direction=3)
    refuse("direction: a model in the plane", direction=2)
    refuse("side: expected", side="up")
    refuse("no node 99", ports=[99])
    ops.node(50, 0.0, 10.0)
    ops.mass(50, 1.0, 1.0, 0.0)
    refuse("node 50, displacement 1.* has mass and no stiffness")
    ops.wipe()
    portal()
    ops.node(50, 9.0, 7.0)
    ops.uniaxialMaterial("Elastic", 1, 1e3)
    ops.element("truss", 50, 6, 50, 0.1, 1)
    # It resists along the truss only; across it and in rotation nothing does, and nothing moves there.
    assert quietly(ops, side="left", units="kN, m").to_dict()["kind"] == "given"
    ops.wipe()
    portal()
    for tag in (3, 5):
        ops.mass(tag, 0.0, 0.0, 0.0)
    refuse("no displacement carries mass")


def test_a_mechanism_is_named() -> None:
    portal()
    ops.node(50, 8.0, 7.0)
    ops.node(51, 10.0, 7.0)
    ops.element("elasticBeamColumn", 50, 50, 51, 0.1, 3e7, 1e-3, 1)
    refuse("mechanism: node 5")


def test_a_consistent_mass_is_refused() -> None:
    portal()
    ops.remove("ele", 5)
    ops.element("elasticBeamColumn", 5, 3, 4, 0.16, 3e7, 2e-3, 1, "-mass", 2.0, "-cMass")
    refuse("mass matrix is not diagonal")


def test_a_node_tied_twice_is_refused() -> None:
    portal()
    ops.equalDOF(3, 4, 1)
    ops.equalDOF(5, 4, 3)
    refuse(r"node 4 is tied to several nodes \(3, 5\)")


def test_damping_by_regions_that_overwrite_each_other_is_said() -> None:
    portal()
    ops.region(1, "-ele", 1, 2, 3, "-rayleigh", 0.5, 0.001, 0.0, 0.0)
    with pytest.warns(jostle.ModelWarning, match=r"damping is not α M \+ β K \(remainder [1-9]\.\de-0\d .* region -node") as said:
        building = jostle.from_opensees(ops, side="left", units="kN, m")
    assert len(said) == 1
    assert "damping" in building.to_dict()["matrices"]
    assert jostle.Model(building).periods(0)[0] > 0.0


def test_what_is_not_carried_over_is_said() -> None:
    portal()
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(5, 0.0, -100.0, 0.0)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("ProfileSPD")
    ops.integrator("LoadControl", 1.0)
    ops.algorithm("Linear")
    ops.analysis("Static")
    ops.analyze(1)
    with pytest.warns(jostle.ModelWarning) as said:
        jostle.from_opensees(ops, side="left", units="kN, mm")
    texts = [str(own.message) for own in said]
    for expected in ("P-Delta", "no damping", "check units"):
        assert any(expected in text for text in texts), (expected, texts)


def test_gravity_is_in_the_tangent_and_the_model_stays_as_it_is() -> None:
    # A cantilever with P-Delta: 3 E I / L³ − P / L.
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 3.0)
    ops.fix(1, 1, 1, 1)
    ops.mass(2, 10.0, 0.0, 0.0)
    ops.geomTransf("PDelta", 1)
    ops.element("elasticBeamColumn", 1, 1, 2, 0.16, 3e7, 2e-3, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -2000.0, 0.0)

    def stiffness() -> float:
        return float(np.array(quietly(ops, units="kN, m").to_dict()["matrices"]["stiffness"])[0, 0])

    bare = 3.0 * 3e7 * 2e-3 / 27.0
    assert stiffness() == pytest.approx(1e3 * bare, rel=1e-12)
    assert ops.nodeDisp(2) == [0.0, 0.0, 0.0]
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-8, 20)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    assert ops.analyze(1) == 0
    before = ops.nodeDisp(2)
    assert stiffness() == pytest.approx(1e3 * (bare - 2000.0 / 3.0), rel=1e-12)
    assert ops.nodeDisp(2) == before
    assert ops.getTime() == 1.0


def test_a_script_that_wipes_its_model_is_read(tmp_path: Path) -> None:
    building = read_script("two_storeys", units="kip, in", side="left")
    assert building.to_dict()["name"] == "two_storeys"
    assert len(building.to_dict()["ports"]) == 2
    broken = tmp_path / "broken.py"
    broken.write_text("import openseespy.opensees as ops\nops.wipe()\nraise ValueError('no section')\n")
    with pytest.raises(jostle.ModelError, match=r"broken\.py:3: ValueError: no section"):
        jostle.import_opensees(broken)
    broken.write_text("import sys\nsys.exit('no record')\n")
    with pytest.raises(jostle.ModelError, match="ended with exit code 'no record'"):
        jostle.import_opensees(broken)
    broken.write_text("pass\n")
    with pytest.raises(jostle.ModelError, match="leaves no model"):
        jostle.import_opensees(broken)
    with pytest.raises(jostle.MissingFileError):
        jostle.import_opensees(tmp_path / "absent.py")
    tcl = tmp_path / "model.tcl"
    tcl.write_text("wipe\n")
    with pytest.raises(jostle.ModelError, match="Tcl"):
        jostle.import_opensees(tcl)


@pytest.mark.parametrize(("name", "units", "extra"), [("seven_storeys", "kip, in", []), ("space", "N, m", ["--direction", "y"])])
def test_the_command_writes_a_model_file(
    name: str, units: str, extra: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    to = tmp_path / "model.toml"
    arguments = [str(SCRIPTS / f"{name}.py"), "--to", str(to), "--units", units, "--name", "A", *extra]
    assert _opensees_file.main(arguments) == 0
    assert "written" in capsys.readouterr().out
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", jostle.ModelWarning)
        written = jostle.Model.load(to)
        build(name)
        direction = extra[1] if extra else "x"
        direct = jostle.Model(quietly(ops, units=units, name="A", direction=direction))
    # NumPy's own file against numbers in text: the same bits.
    assert list(written.periods(0)) == list(direct.periods(0))
    # Its own file is replaced, another is not.
    assert _opensees_file.main(arguments) == 0
    to.write_text("# mine\n")
    assert _opensees_file.main(arguments) == 2
    assert "was not written by jostle" in capsys.readouterr().err
    assert to.read_text() == "# mine\n"
    assert not list(tmp_path.glob(".*"))


def test_materials_that_yield_in_springs_and_trusses_are_named() -> None:
    materials: dict[int, tuple[Any, ...]] = {
        1: ("Elastic", 1e4),
        2: ("Steel01", 100.0, 1e4, 0.01),
        3: ("ElasticPP", 1e4, 0.01),
        4: ("Parallel", 1, 2),
        5: ("Parallel", 1, 1),
        6: ("Elastic", 1e4, 0.0, 5e3),
        7: ("Viscous", 10.0, 1.0),
        8: ("Viscous", 10.0, 0.5),
        9: ("ElasticMultiLinear", "-strain", -1.0, 0.0, 1.0, "-stress", -1.0, 0.0, 1.0),
    }

    def remarks(kind: str, *tags: int) -> str:
        ops.wipe()
        portal()
        for tag, values in materials.items():
            ops.uniaxialMaterial(values[0], tag, *values[1:])
        if kind == "truss":
            ops.element("truss", 50, 3, 6, 0.1, *tags)
        elif kind == "twoNodeLink":
            ops.element("twoNodeLink", 50, 3, 6, "-mat", *tags, "-dir", *range(1, len(tags) + 1))
        else:
            ops.node(60, *ops.nodeCoord(5))
            ops.fix(60, 1, 1, 1)
            ops.element("zeroLength", 50, 60, 5, "-mat", *tags, "-dir", *range(1, len(tags) + 1))
        return " ".join(read_model(ops, 1, "left", "kN, m", None, None, None).remarks)

    for kind in ("truss", "twoNodeLink", "zeroLength"):
        for linear in (1, 5):
            assert "do not yield" not in remarks(kind, linear), (kind, linear)
        for tag, name in (
            (2, "Steel01"), (3, "ElasticPPMaterial"), (4, "Steel01"), (6, "ElasticMaterial"), (9, "ElasticMultiLinear"),
        ):  # fmt: skip
            said = remarks(kind, tag)
            assert f"1 {kind[0].upper()}{kind[1:]} with {name} enter with their current tangent" in said, (kind, tag, said)
    # Dashpots print no JSON, which makes that of the model invalid as a whole.
    assert "do not yield" not in remarks("zeroLength", 1, 7)
    assert "ZeroLength with Viscous and Steel01 enter" in remarks("zeroLength", 8, 2)


def space(up: int, at_supports: float = 0.0) -> list[int]:
    """A storey on four columns in space, whose height is y (1) or z (2); its nodes."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    other = 3 - up
    ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
    nodes = []
    for index, (x, across) in enumerate(((0.0, 0.0), (6.0, 0.0), (6.0, 5.0), (0.0, 5.0))):
        for level, height in enumerate((at_supports, at_supports + 4.0)):
            place = [x, 0.0, 0.0]
            place[up], place[other] = height, across
            ops.node(10 * index + level + 1, *place)
        ops.fix(10 * index + 1, 1, 1, 1, 1, 1, 1)
        ops.element("elasticBeamColumn", index + 1, 10 * index + 1, 10 * index + 2, 0.16, 3e7, 1.2e7, 4e-3, 2e-3, 2e-3, 1)
        nodes.append(10 * index + 2)
    return nodes


def test_models_with_y_upward_are_refused() -> None:
    for node in space(1):
        ops.mass(node, 10.0, 10.0, 10.0, 0.0, 0.0, 0.0)
    refuse("all supports are at the lowest y and at several z, so y is the height")
    nodes = space(1)
    ops.node(99, 3.0, 4.0, 2.5)
    ops.fix(99, 0, 1, 0, 1, 0, 1)
    ops.mass(99, 40.0, 0.0, 40.0, 0.0, 500.0, 0.0)
    ops.rigidDiaphragm(2, 99, *nodes)
    refuse("rigid diaphragms lie in the plane of x and z")


def test_floors_with_different_masses_along_x_and_y_are_refused() -> None:
    for along_y, said in ((40.0, ""), (30.0, r"node 99\) has 40000 kg along x and 30000 kg along y")):
        nodes = space(2)
        ops.node(99, 3.0, 2.5, 4.0)
        ops.fix(99, 0, 0, 1, 1, 1, 0)
        ops.mass(99, 40.0, along_y, 0.0, 0.0, 0.0, 500.0)
        ops.rigidDiaphragm(3, 99, *nodes)
        if said:
            refuse(said)
        else:
            assert jostle.Model(quietly(ops, side="left", units="kN, m")).periods(0)[0] > 0.0


def test_the_level_of_the_base_is_kept(tmp_path: Path) -> None:
    """Feet at 2 ft and a floor 4 ft above them; on the axis, none is written."""
    for level, expected in ((2.0, 0.6096), (0.0, None)):
        for node in space(2, level):
            ops.mass(node, 10.0, 10.0, 0.0, 0.0, 0.0, 0.0)
        building = quietly(ops, side="left", units="kip, ft").to_dict()
        assert building.get("elevation") == (None if expected is None else pytest.approx(expected))
        (port,) = building["ports"].values()
        assert port["height"] == pytest.approx(4 * 0.3048)
    lifted = tmp_path / "lifted.py"
    lifted.write_text(
        "from openseespy.opensees import *\nwipe()\nmodel('basic', '-ndm', 2, '-ndf', 3)\nnode(1, 0.0, 10.0)\nnode(2, 0.0, 14.0)\n"
        "fix(1, 1, 1, 1)\nmass(2, 10.0, 0.0, 0.0)\ngeomTransf('Linear', 1)\n"
        "element('elasticBeamColumn', 1, 1, 2, 0.16, 3e7, 2e-3, 1)\n"
    )
    to = tmp_path / "a.toml"
    assert _opensees_file.main([str(lifted), "--to", str(to), "--units", "kN, m"]) == 0
    assert 'elevation = "10.0 m"' in to.read_text("utf-8")
