"""Runs either program as a user would, and says what it found and what it cost."""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
JOSTLE = os.environ["JOSTLE"]
# A run that takes longer than this is given up [s].
PATIENCE = 6 * 3600.0


def model_of(case):
    """The model as either program's command line wants it."""
    for folder in (HERE / "models", HERE.parent / "crates/jostle-validation/data/opensees"):
        if (folder / case.model).exists():
            return str(folder / case.model)
    return case.model


def call(command):
    """Runs a command; its JSON and the CPU time of the process [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not done.stdout.strip():
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stderr.strip()[-2000:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads(done.stdout), cpu


SOLVERS = ["riccati", "modal"]


def jostle(case, solver="riccati", tolerance=None, least=1.0, most=25, fewest=3):
    """jostle with automatic steps, again and again for a second.

    What is counted is the wall time of stepping in the quickest run, which is never less than its CPU time."""
    command = [JOSTLE, "run", model_of(case), "--json", "--no-report", "--solver", solver, *case.options]
    with tempfile.TemporaryDirectory() as folder:
        if tolerance is not None:
            command[2] = with_tolerance(model_of(case), tolerance, folder)
        runs, started = [], time.perf_counter()
        while len(runs) < fewest or (time.perf_counter() - started < least and len(runs) < most):
            runs.append(call(command))
            if runs[0][0]["work"]["wall_s"] > 20.0:
                break
    runs.sort(key=lambda run: run[0]["work"]["wall_s"])
    summary, _ = runs[0]
    median, _ = runs[len(runs) // 2]
    peaks = [contact["peak_force_n"] for gap in summary["gaps"] for contact in gap["contacts"]]
    work = summary["work"]
    return {
        "program": "jostle",
        "way": solver,
        "settings": f"tolerance {tolerance or 1e-3:g}",
        "cpu_s": work["wall_s"],
        "median_s": median["work"]["wall_s"],
        "process_cpu_s": sorted(run[1] for run in runs)[len(runs) // 2],
        "runs": len(runs),
        "steps": work["steps"],
        "short_steps": work["contact_steps"],
        "factorisations": work["factorizations"],
        "solutions": work["solves"],
        "peak_force_n": max(peaks, default=0.0),
        "impacts": sum(gap["impact_count"] for gap in summary["gaps"]),
        "first_impact_s": min((gap["first_impact_s"] for gap in summary["gaps"] if gap["first_impact_s"] is not None), default=None),
        "summary": summary,
    }


def with_tolerance(model, tolerance, folder):
    """The model with another tolerance, as a file."""
    path = Path(model)
    if tolerance == 1e-3:
        return model
    text = path.read_text() if path.exists() else (HERE.parent / "crates/jostle-io/data" / f"{model}.toml").read_text()
    if "[analysis]" in text:
        raise RuntimeError(f"{model} has its own settings")
    copy = Path(folder) / "model.toml"
    copy.write_text(text + f"\n[analysis]\ntolerance = {tolerance!r}\n")
    return str(copy)


def opensees(case, free=2e-3, parts=10, axial="stiff", uniform=None, duration=None):
    """OpenSees on the exported script."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "model.py"
        exported = [JOSTLE, "export", model_of(case), "--to", "openseespy", "-o", str(script), *case.options]
        subprocess.run(exported, check=True, capture_output=True, timeout=60)
        command = [sys.executable, str(script), "--axial", axial]
        command += ["--uniform", repr(uniform)] if uniform else ["--free", repr(free), "--parts", str(parts)]
        command += ["--duration", repr(duration)] if duration else []
        result, process_cpu = call(command)
    work = result["work"]
    # In space jostle gives the force of a face, the sum over its points.
    faces = [face["peak_force_n"] for face in result.get("faces", [])]
    return {
        "program": "OpenSeesPy",
        "way": "uniform" if uniform else "best",
        "settings": f"{1e3 * uniform:g} ms" if uniform else f"{1e3 * free:g} ms, near contact {1e3 * free / parts:g} ms, {axial}",
        "cpu_s": work["cpu_s"],
        "process_cpu_s": process_cpu,
        "steps": work["steps"],
        "short_steps": work["short_steps"],
        "iterations": work["iterations"],
        "failed_steps": work["failed_steps"],
        "late_impacts": work["late_impacts"],
        "equations": work["equations"],
        "complete": result["complete"],
        "peak_force_n": max(faces, default=result["peak_force_n"]),
        "impacts": sum(face["impact_count"] for face in result["faces"]) if faces else result["impact_count"],
        "first_impact_s": result["first_impact_s"],
        "duration_s": result["duration_s"],
        "version": result["version"],
        "result": result,
    }
