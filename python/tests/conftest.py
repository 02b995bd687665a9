"""What the tests share. Nothing here touches the compiled half: users do not either."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import jostle

os.environ.setdefault("MPLBACKEND", "Agg")

Program = Callable[..., "subprocess.CompletedProcess[str]"]

TOWERS = """
title = "Two towers"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "12 s"
[[building]]
name = "soft"
kind = "shear"
mass = ["40 t", "40 t", "30 t"]
stiffness = ["30 MN/m", "30 MN/m", "20 MN/m"]
storey_height = "3.2 m"
[[building]]
name = "stiff"
kind = "shear"
mass = ["60 t", "60 t", "50 t"]
stiffness = ["90 MN/m", "90 MN/m", "80 MN/m"]
storey_height = "3.2 m"
[[gap]]
between = ["soft", "stiff"]
width = "20 mm"
law = "hertz-damp"
stiffness = "2e9 N/m^1.5"
restitution = 0.65
"""


def build_towers() -> jostle.Model:
    """The towers of the file above, built in Python."""
    soft = jostle.Shear(
        "soft", mass=["40 t", "40 t", "30 t"], stiffness_mn_m=[30, 30, 20], storey_height="3.2 m"
    )
    stiff = jostle.Shear(
        "stiff", mass_t=[60, 60, 50], stiffness=["90 MN/m", "90 MN/m", 80e6], storey_height=3.2
    )
    gap = jostle.Gap(width_mm=20, law="hertz-damp", stiffness="2e9 N/m^1.5", restitution=0.65)
    motion = jostle.Motion.el_centro().scaled(pga="0.3 g").lasting("12 s")
    return jostle.Model([soft, stiff], gap, motion=motion, title="Two towers")


@pytest.fixture(scope="session")
def towers() -> jostle.Model:
    return jostle.Model.loads(TOWERS)


@pytest.fixture(scope="session")
def result(towers: jostle.Model) -> jostle.Result:
    return jostle.run(towers)


@pytest.fixture
def towers_file(tmp_path: Path) -> Path:
    path = tmp_path / "towers.toml"
    path.write_text(TOWERS, encoding="utf-8")
    return path


@pytest.fixture
def program(tmp_path: Path) -> Program:
    """The installed command line, run in an empty folder."""

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        command = [str(Path(sys.executable).with_name("jostle")), *arguments]
        return subprocess.run(
            command, cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", timeout=300
        )

    return run


@pytest.fixture
def ctrl_c() -> Iterator[None]:
    """Ctrl-C as at a terminal: a shell's jobs in the background start with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
