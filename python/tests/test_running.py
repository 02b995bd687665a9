"""Threads, progress and Ctrl-C."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import jostle

#: A run of several seconds: the example for an hour.
LONG = "3000 s"


def long_model() -> jostle.Model:
    model = jostle.Model.paper_example()
    assert model.motion is not None
    return model.changed(motion=model.motion.lasting(LONG))


def test_other_threads_go_on() -> None:
    beats = 0

    def stop_after_a_second(reached: float, duration: float) -> None:
        if time.monotonic() - started > 1.0:
            raise StopIteration

    def run() -> None:
        with pytest.raises(StopIteration):
            jostle.run(long_model(), progress=stop_after_a_second)

    started = time.monotonic()
    worker = threading.Thread(target=run)
    worker.start()
    while worker.is_alive():
        time.sleep(0.01)
        beats += 1
    assert beats > 30, "the interpreter was held"


def test_threads_do_not_change_a_bit(towers: jostle.Model, result: jostle.Result) -> None:
    with ThreadPoolExecutor(4) as pool:
        for other in pool.map(jostle.run, [towers] * 8):
            assert other.history["time_s"].tobytes() == result.time.tobytes()
            assert other.summary["gaps"] == result.summary["gaps"]


def test_progress_is_told_and_may_stop() -> None:
    told: list[float] = []

    def observer(reached: float, duration: float) -> None:
        assert duration == 3000.0
        told.append(reached)
        if len(told) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="^enough$"):
        jostle.run(long_model(), progress=observer)
    assert told == sorted(told) and told[0] > 0.0


class Terminal(io.StringIO):
    """Standard error that somebody watches."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("stream", [Terminal, io.StringIO])
def test_a_progress_line_leaves_no_trace(
    stream: type[io.StringIO], monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = stream()
    monkeypatch.setattr(sys, "stderr", shown)

    model = jostle.Model.paper_example()
    assert model.motion is not None
    # A line is shown only for a run that takes a while.
    lasting = 4000.0 if shown.isatty() else 100.0
    result = jostle.run(model, motion=model.motion.lasting(f"{lasting} s"), progress=True)
    assert result.completed
    lines = shown.getvalue().split("\r")
    if shown.isatty():
        assert f"of {lasting} s" in lines[1] and lines[-2].strip() == lines[-1] == ""
    else:
        assert lines == [""], "nothing for logs"


def interrupt_after(seconds: float) -> None:
    def press() -> None:
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=press, daemon=True).start()


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
@pytest.mark.usefixtures("ctrl_c")
def test_ctrl_c_keeps_what_was_computed_and_twice_is_meant() -> None:
    model = long_model()
    interrupt_after(0.7)
    started = time.monotonic()
    with pytest.warns(jostle.InterruptedWarning, match="stopped at t = .* of 3000.000 s"):
        result = jostle.run(model, without_contact=True)
    assert time.monotonic() - started < 5.0
    assert not result.completed and result.summary["ended_early"].startswith("stopped at")
    assert 0.0 < result.time[-1] < 3000.0 and len(result.impacts) == 1
    assert "ended early" in str(result)
    # Again within two seconds: now the user wants out.
    interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt):
        jostle.run(model)


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_ctrl_c_stops_the_command_line_and_keeps_its_results(tmp_path: Path) -> None:
    text = (
        '[motion]\nrecord = "el-centro-1940-ns"\nduration = "9000 s"\n'
        '[[building]]\nkind = "shear"\nstoreys = 40\nmass = "40 t"\nstiffness = "400 MN/m"\nstorey_height = "3 m"\n'
    )
    (tmp_path / "long.toml").write_text(text)
    program = subprocess.Popen(
        [Path(sys.executable).with_name("jostle"), "run", "long.toml", "--out", "kept"],
        cwd=tmp_path, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    time.sleep(1.5)
    program.send_signal(signal.SIGINT)
    _, complaint = program.communicate(timeout=60)
    assert program.returncode == 130, complaint
    assert "stopped; results up to then are in kept" in complaint
    assert (tmp_path / "kept" / "summary.json").exists()
