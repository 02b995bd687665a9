"""Capacity curves, matrices and spectra."""

import json
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


def test_curves_are_those_of_the_command_line(program: Program) -> None:
    found = told(program, "pushover", "paper-inelastic", "--building", "J1", "--json")["curves"][0]
    (curve,) = jostle.pushover(jostle.Model.example("paper-inelastic"), building="J1")
    assert curve.tree == found
    assert curve.base_shear.shape == curve.roof_drift.shape
    assert curve.storey_drifts.shape == (len(curve.roof_drift), 5)
    assert curve.base_shear.max() > 3e5 and "J1" in repr(curve)
    assert any(event["what"] == "yields" for point in curve.events for event in point)
    assert "<svg" in curve._repr_html_()


def test_wrong_arguments_are_named() -> None:
    model = jostle.Model.example("paper")
    with pytest.raises(jostle.ModelError, match="^building: there is no building"):
        jostle.pushover(model, building="J9")
    with pytest.raises(jostle.ModelError, match="^pattern: expected first-mode"):
        jostle.pushover(model, pattern="sideways")
    with pytest.raises(jostle.ModelError, match="^drift: must lie"):
        jostle.pushover(model, drift=3)


def test_matrices_have_the_periods_of_the_modes() -> None:
    model = jostle.Model.example("paper")
    parts = model.matrices("J1")
    # Massless rotations are condensed away, the rest is an ordinary eigenproblem.
    heavy = parts.mass > 0
    k = parts.stiffness
    light = np.linalg.solve(k[np.ix_(~heavy, ~heavy)], k[np.ix_(~heavy, heavy)])
    condensed = k[np.ix_(heavy, heavy)] - k[np.ix_(heavy, ~heavy)] @ light
    root = 1 / np.sqrt(parts.mass[heavy])
    squares = np.linalg.eigvalsh(root[:, None] * condensed * root)
    periods = 2 * np.pi / np.sqrt(squares[:3])
    assert periods == pytest.approx(jostle.modes(model, 3)["J1"].periods, rel=1e-8)
    assert len(parts.floors) == 5
    assert parts.damping == pytest.approx(parts.damping.T)


def test_spectra_are_those_of_the_command_line(program: Program) -> None:
    found = told(program, 
        "motion", "spectrum", "el-centro-1940-ns", "--periods", "0.5s,1s,2s", "--damping", "0.02", "--json"
    )
    spectrum = jostle.Motion.el_centro().spectrum([0.5, 1.0, 2.0], 0.02)
    assert spectrum.displacement[0].tolist() == found["spectra"][0]["displacement_m"]
    # Chopra, Dynamics of structures, figure 6.4.1: 5.97 and 7.47 inches.
    assert spectrum.displacement[0, 1:] / 0.0254 == pytest.approx([5.97, 7.47], rel=5e-3)


def test_a_sine_has_its_resonance() -> None:
    # Steady state at resonance: amplitude / (2 ζ ω²).
    sine = jostle.Motion.sine(amplitude=1.0, period=0.5, duration=60.0)
    found = sine.spectrum([0.5], 0.05).displacement[0, 0]
    omega = 2 * np.pi / 0.5
    assert found == pytest.approx(1 / (2 * 0.05 * omega**2), rel=1e-3)


def test_constant_ductility_of_one_is_elastic() -> None:
    spectrum = jostle.Motion.el_centro().spectrum([0.5], 0.05, ductility=[1.0, 4.0])
    one, four = spectrum.inelastic
    assert one["displacement_m"][0] == pytest.approx(spectrum.displacement[0, 0], rel=5e-3)
    assert four["yield_acceleration_m_s2"][0] < 0.6 * one["yield_acceleration_m_s2"][0]
