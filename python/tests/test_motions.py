"""Ground motions."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from jostle import ModelError, Motion


def test_el_centro_is_the_digitisation_of_peknold() -> None:
    motion = Motion.el_centro()
    assert motion.step == 0.02 and motion.duration == pytest.approx(31.18)
    # Peak and Arias intensity known for this digitisation; its g is 9.81 m/s2, that of the intensity 9.80665.
    assert motion.pga == pytest.approx(0.31882 * 9.81, rel=1e-9)
    a = motion.acceleration * 9.80665 / 9.81
    squares = np.sum((a[1:] ** 2 + a[:-1] ** 2) / 2) * motion.step
    assert np.pi / (2 * 9.80665) * squares == pytest.approx(1.8010, rel=1e-3)
    assert len(motion.time) == len(a) == 1560


def test_an_array_is_the_file_of_its_values(tmp_path: Path) -> None:
    values = np.sin(np.arange(200) * 0.1) * 0.2
    path = tmp_path / "wave.csv"
    path.write_text("# step = 0.01 s\n# unit = g\n" + "\n".join(map(repr, values.tolist())) + "\n")
    ours, theirs = Motion(values, step=0.01, unit="g"), Motion.read(path)
    assert ours.acceleration.tobytes() == theirs.acceleration.tobytes()
    assert ours.duration == theirs.duration == pytest.approx(1.99)
    assert Motion(values.tolist(), step="10 ms", unit="g").pga == ours.pga
    assert Motion(values[::-1], step="10 ms", unit="g").pga == ours.pga


def test_at2_files_are_read(tmp_path: Path) -> None:
    path = tmp_path / "X.AT2"
    path.write_text("PEER\nQUAKE\nACCELERATION IN UNITS OF G\nNPTS=   4, DT=   .0100 SEC\n 0 .1 -.3 .05\n")
    motion = Motion.read(path)
    assert motion.acceleration == pytest.approx(9.80665 * np.array([0, 0.1, -0.3, 0.05]))
    path.write_text("PEER\nQUAKE\nACCELERATION IN UNITS OF G\nNPTS=   4, DT=   .0100 SEC\n 0 .1 x .05\n")
    with pytest.raises(ModelError, match=r'X.AT2:5: "x" is not a number'):
        Motion.read(path)


def test_lines_are_read_as_stated(tmp_path: Path) -> None:
    values = 0.2 * np.sin(np.arange(160) * 0.1) * np.exp(-(((np.arange(160) - 80) / 40) ** 2))
    path = tmp_path / "eight.acc"
    path.write_text("\n".join("".join(f"{a:10.6f}" for a in line) for line in values.reshape(20, 8)) + "\n")
    with pytest.raises(ModelError, match="per_line = 8"):
        Motion.read(path, unit="g", step=0.01, column=2)
    for read in ({"per_line": 8}, {"content": "values"}, {"content": "values", "widths": [10]}):
        motion = Motion.read(path, unit="g", step=0.01, read=read)
        assert motion.acceleration == pytest.approx(9.80665 * values, abs=1e-5)
    with pytest.raises(TypeError, match="unknown key 'lines'"):
        Motion.read(path, read={"lines": 8})
    with pytest.raises(ModelError, match="content must be one of values, pairs, columns"):
        Motion.read(path, read={"content": "rows"})


def test_scaling() -> None:
    motion = Motion.el_centro()
    assert motion.scaled(pga="0.2 g").pga == pytest.approx(0.2 * 9.80665, rel=1e-15)
    assert motion.scaled(pga_cm_s2=220).pga == pytest.approx(2.2, rel=1e-15)
    assert motion.scaled(1.5).pga == pytest.approx(1.5 * motion.pga, rel=1e-15)
    twice = motion.scaled(pga="0.2 g").scaled(2.0)
    assert twice.pga == pytest.approx(0.4 * 9.80665, rel=1e-15)
    back = motion.reversed().scaled(-1.0)
    assert np.array_equal(back.acceleration, motion.acceleration)
    assert np.array_equal(motion.reversed().acceleration, -motion.acceleration)
    assert motion.scaled(pga=1.0).reversed().scaled(-2.0).acceleration == pytest.approx(
        motion.scaled(pga=2.0).acceleration
    )


def test_the_peak_is_that_of_the_whole_record() -> None:
    cut = Motion.el_centro().lasting("1 s").scaled(pga="1 m/s2")
    assert cut.duration == 1.0 and cut.pga < 0.5
    assert len(cut.time) == 51
    long = Motion.el_centro().lasting("40 s")
    assert long.acceleration[-1] == 0.0 and long.time[-1] == pytest.approx(40.0)


def test_waves_are_exact() -> None:
    t = np.linspace(0, 7.9, 200)
    sine = Motion.sine(amplitude="2 m/s2", period="0.7 s", duration="8 s")
    assert sine.at(t) == pytest.approx(2 * np.sin(2 * np.pi * t / 0.7), abs=1e-13)
    pulse = Motion.ricker(amplitude="2 m/s2", period="0.7 s")
    tau = np.pi * (t - 1.05) / 0.7
    assert pulse.at(t) == pytest.approx(2 * (1 - 2 * tau**2) * np.exp(-(tau**2)), abs=1e-13)
    assert pulse.step is None and pulse.time[1] == 0.7 / 200


def test_interpolation_is_straight_and_zero_outside() -> None:
    motion = Motion([0.0, 1.0, -1.0], step=0.5)
    assert motion.at([-1, 0.25, 0.75, 1.0, 2.0]).tolist() == [0.0, 0.5, 0.0, -1.0, 0.0]


@pytest.mark.parametrize(
    ("values", "step", "unit", "problem"),
    [
        ([1.0], 0.01, "m/s2", "at least two values"),
        ([1.0, float("nan")], 0.01, "m/s2", 'motion:2: "NaN" is not a number'),
        ([1.0, 900.0], 0.01, "m/s2", "beyond any earthquake"),
        ([1.0, 300.0], 0.01, "g", "surely not g"),
        ([1.0, 2.0], 0.01, "m/s", "not an acceleration"),
        ([1.0, 2.0], 100.0, "m/s2", "time step"),
        ([1.0, 2.0], "3 kg", "m/s2", "step: expected a time"),
    ],
)
def test_useless_motions_are_refused(
    values: list[float], step: float | str, unit: str, problem: str
) -> None:
    with pytest.raises(ModelError, match=problem):
        Motion(values, step=step, unit=unit)


def test_useless_arguments_are_refused() -> None:
    motion = Motion.el_centro()
    with pytest.raises(TypeError, match="give either a factor or pga"):
        motion.scaled()
    with pytest.raises(TypeError, match="give either a factor or pga"):
        motion.scaled(2.0, pga=1.0)
    with pytest.raises(ValueError, match="must be greater than zero"):
        motion.scaled(pga=0.0)
    with pytest.raises(ModelError, match="exceeds 100 m/s2"):
        motion.scaled(1e6)
    with pytest.raises(TypeError, match="one row of numbers"):
        Motion([[1.0, 2.0]], step=0.01)
    with pytest.raises(ModelError, match="did you mean"):
        Motion.read("el-centro-1940-nss")
    with pytest.raises(ValueError, match="must lie between"):
        motion.lasting(0.0)


def test_motions_travel() -> None:
    for motion in (
        Motion.el_centro().scaled(pga=2.0).reversed().lasting(5.0),
        Motion.sine(amplitude=1.0, period=0.5, duration=3.0).scaled(1.5),
        Motion.ricker(amplitude=1.0, period=0.5, centre=1.0, duration=3.0),
        Motion([0.0, 0.1, 0.2], step=0.01, unit="g", name="mine"),
    ):
        copy = pickle.loads(pickle.dumps(motion))
        assert copy.name == motion.name and copy.duration == motion.duration
        assert copy.acceleration.tobytes() == motion.acceleration.tobytes()
        assert copy.scale == motion.scale
