"""Contact stiffness from slabs and masses."""

import json
import math

import pytest
from conftest import Program

import jostle


def test_equal_floors_collide_as_rods() -> None:
    (advice,) = jostle.contact_advice(mass=45e3, length=12, width=10, thickness="150 mm", modulus="30 GPa", speed=0.5)
    wave = advice.wave
    assert wave is not None
    # F = v/2 √(E A m/L), for a time of 2 L/c with c² = E A L/m.
    assert wave.peak_force == pytest.approx(0.25 * math.sqrt(30e9 * 1.5 * 45e3 / 12), rel=1e-9)
    assert wave.duration == pytest.approx(2 * math.sqrt(45e3 * 12 / (30e9 * 1.5)), rel=1e-9)
    assert wave.restitution == pytest.approx(1.0, abs=1e-9)
    assert advice.linear is not None and advice.linear.low <= advice.linear.value <= advice.linear.high
    assert {one.family for one in advice.estimates} == {"hertz", "linear"}


def test_numbers_are_those_of_the_command_line(program: Program) -> None:
    done = program("contact-advice", "--mass", "40 t, 60 t", "--concrete", "C30/37", "--json")
    assert done.returncode == 0, done.stderr
    (found,) = json.loads(done.stdout)["contacts"]
    (advice,) = jostle.contact_advice(mass=["40 t", "60 t"], concrete="C30/37")
    assert advice.moduli == (33e9, 33e9) and advice.linear is None and advice.wave is None
    assert advice.hertz.value == found["hertz"]["value"]
    assert [one.stiffness for one in advice.estimates] == [one["stiffness"] for one in found["estimates"]]


def test_a_model_gives_the_masses() -> None:
    (advice,) = jostle.contact_advice(jostle.Model.paper_example())
    assert advice.height is not None and all(mass is not None and mass > 0 for mass in advice.masses)


def test_wrong_values_are_named_by_their_argument() -> None:
    with pytest.raises(jostle.ModelError, match="^mass: is missing"):
        jostle.contact_advice()
    with pytest.raises(jostle.ModelError, match="give all three"):
        jostle.contact_advice(mass=40e3, length=12)
    with pytest.raises(TypeError, match="mass: expected"):
        jostle.contact_advice(mass=[1.0, 2.0, 3.0])
