"""Two free masses, and contact laws of one's own."""

import json
import math
from typing import Any

import numpy as np
import pytest
from conftest import Program

import jostle


def told(program: Program, *arguments: str) -> dict[str, Any]:
    done = program(*arguments)
    assert done.returncode == 0, done.stderr
    tree: dict[str, Any] = json.loads(done.stdout)
    return tree

GIVEN: dict[str, Any] = {"m1": "50 t", "m2": "80 t", "speed": "0.5 m/s"}
M1, M2, V = 5e4, 8e4, 0.5


def test_an_elastic_spring_has_its_closed_form() -> None:
    met = jostle.collide("linear", **GIVEN, stiffness="80 MN/m")
    mass = M1 * M2 / (M1 + M2)
    assert met.peak_force == pytest.approx(V * math.sqrt(80e6 * mass), rel=1e-9)
    assert met.duration == pytest.approx(math.pi * math.sqrt(mass / 80e6), rel=1e-9)
    assert met.realised_restitution == pytest.approx(1.0, abs=1e-9)
    assert met.force.max() == pytest.approx(met.peak_force, rel=1e-3)
    assert len(met.time) == len(met.rate) > 100


def test_numbers_are_those_of_the_command_line(program: Program) -> None:
    found = told(program, 
        "collide", "--law", "jankowski", "--m1", "50t", "--m2", "80t", "--speed", "0.5m/s", "--restitution", "0.6",
        "--json",
    )  # fmt: skip
    met = jostle.collide("jankowski", **GIVEN, restitution=0.6)
    assert met.peak_force == found["peak_force_n"]
    assert met.realised_restitution == found["realised_restitution"]


def test_every_law_meets() -> None:
    laws = jostle.contact_laws()
    assert {law["law"] for law in laws} >= {"hertz-damp", "restitution", "rubber"}
    met = jostle.collide_all(**GIVEN, restitution=0.7, restitution_is="realised")
    damped = [one for one in met if one.law not in ("linear", "hertz", "rubber")]
    for one in damped:
        assert one.realised_restitution == pytest.approx(0.7, abs=1e-6), one


def test_a_law_of_ones_own_is_the_built_in_one() -> None:
    k, e = 2e9, 0.65
    zeta = 0.75 * (1 - e * e)

    def hertz_damp(indentation: float, rate: float, impact_speed: float) -> float:
        return float(k * indentation**1.5 * (1 + zeta * rate / impact_speed))

    own = jostle.collide(jostle.ContactLaw(hertz_damp, "own"), **GIVEN)
    ours = jostle.collide("hertz-damp", **GIVEN, restitution=e)
    for key in ("peak_force", "duration", "peak_indentation", "realised_restitution", "dissipated"):
        assert getattr(own, key) == pytest.approx(getattr(ours, key), rel=1e-5), key
    assert "own" in repr(own) and "<svg" in own._repr_html_()


def test_errors_speak_of_keywords() -> None:
    with pytest.raises(jostle.ModelError, match="^restitution: must be"):
        jostle.collide("hertz-damp", **GIVEN, restitution=1.5)
    with pytest.raises(jostle.ModelError, match="castle"):
        jostle.collide("castle", **GIVEN)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="m1: expected"):
        jostle.collide("hertz", m1=[], m2=1.0, speed=1.0)  # type: ignore[arg-type]
    with pytest.raises(jostle.AnalysisError, match="not come apart|force is"):
        jostle.collide(jostle.ContactLaw(lambda d, r, s: float("nan")), **GIVEN)


def two_towers(gap: jostle.Gap) -> jostle.Model:
    soft = jostle.Shear("soft", mass=["40 t"], stiffness=["8 MN/m"], storey_height="3 m")
    stiff = jostle.Shear("stiff", mass=["60 t"], stiffness=["60 MN/m"], storey_height="3 m")
    motion = jostle.Motion.sine(amplitude="2 m/s2", period="0.7 s", duration="3 s")
    return jostle.Model([soft, stiff], gap, motion=motion)


def test_an_experiment_finds_what_a_run_finds() -> None:
    k = 5e8
    model = two_towers(jostle.Gap("10 mm", law="hertz", stiffness="5e8 N/m^1.5"))
    law = jostle.ContactLaw(lambda d, r, s: k * d**1.5)
    tried = jostle.experiment(model, law, step=5e-5)
    run = jostle.run(model)
    assert tried.peak_force == pytest.approx(run.summary["gaps"][0]["peak_force_n"], rel=2e-3)
    ours = np.interp(tried.time, run.time, run.floor("soft", 1).displacement)
    assert np.abs(tried.displacement["soft"][:, 0] - ours).max() < 2e-4


def test_an_experiment_knows_walls_and_links() -> None:
    row = [
        jostle.Shear("a", mass=["40 t", "40 t"], stiffness="30 MN/m", storey_height=3),
        jostle.Shear("b", mass=["50 t", "50 t"], stiffness="90 MN/m", storey_height=3),
    ]
    law: dict[str, Any] = {"law": "hertz", "stiffness": "5e8 N/m^1.5"}
    gaps = [
        jostle.Gap("10 mm", between=["a", "b"], **law),
        jostle.Gap("4 mm", between=["b", "wall"], **law),
    ]
    link = jostle.Link(["a", "b"], floors=[[1, 1]], damping="200 kN.s/m", stiffness="2 MN/m")
    motion = jostle.Motion.el_centro().scaled(pga="0.4 g").lasting("4 s")
    model = jostle.Model(row, gaps, links=link, motion=motion)
    tried = jostle.experiment(model, jostle.ContactLaw(lambda d, r, s: 5e8 * d**1.5), step=1e-4)
    run = jostle.run(model)
    assert all(gap["impact_count"] > 0 for gap in run.summary["gaps"])
    assert tried.peak_force == pytest.approx(max(c.peak_force for c in run.contacts), rel=3e-3)
    for name in ("a", "b"):
        ours = np.interp(tried.time, run.time, run.floor(name, 2).displacement)
        assert np.abs(tried.displacement[name][:, 1] - ours).max() < 2e-4


def test_an_experiment_refuses_what_it_cannot() -> None:
    with pytest.raises(jostle.ModelError, match="may yield"):
        jostle.experiment(jostle.Model.example("paper-inelastic"), jostle.ContactLaw(lambda d, r, s: d))
