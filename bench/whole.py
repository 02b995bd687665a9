"""What whole programs do: pairs of yielding buildings per second, a curve of forces over gaps, the start, the cost of the promise. See
bench/run --whole."""

import json
import os
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

import programs
import studies

MODELS = Path(__file__).resolve().parent / "models"
# Times that each program is run; the quickest counts, since the machine is not ours alone.
TIMES = 5
# Widths of the curve, and random models of which the cost of the promise is taken.
WIDTHS, DRAWN = 200, 60


def cpu_of(command, environment=None):
    """CPU time of a command [s], and what it prints."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=os.environ | (environment or {}))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def pairs(say):
    """A study of a hundred pairs of yielding towers, the whole process on one thread."""
    taken = []
    for _ in range(TIMES):
        before = studies.cpu()
        running = studies.study("yielding_pairs.toml", "--jobs", "1", "--no-report")
        studies.wait([running])
        taken.append(studies.cpu() - before)
    say(f"pairs: {100 / min(taken):.0f} per second")
    return {"cases": 100, "cpu_s": min(taken), "median_s": statistics.median(taken), "per_second": 100 / min(taken)}


def curve(say):
    """Force over the gap of the built-in example, the whole process on one thread."""
    command = [programs.JOSTLE, "gap", "paper", "--curve", str(WIDTHS), "--no-outcomes", "--json"]
    taken = []
    for _ in range(TIMES):
        taken.append(cpu_of(command, {"RAYON_NUM_THREADS": "1"}))
    points = json.loads(taken[0][1])["gaps"][0]["curve"]
    quickest = min(one for one, _ in taken)
    say(f"curve: {quickest:.3f} s")
    return {
        "points": len(points),
        "cpu_s": quickest,
        "impacts": sum(point["impact_count"] for point in points) / len(points),
    }


def start(say):
    """What the program does before it steps: reading, assembling and planning of a small model."""
    taken = [cpu_of([programs.JOSTLE, "check", str(MODELS / "two-towers.toml")])[0] for _ in range(4 * TIMES)]
    say(f"start: {1e3 * min(taken):.1f} ms")
    return {"cpu_s": min(taken), "median_s": statistics.median(taken)}


def promise(say):
    """Random models: time of all runs that the tolerance took over that of the last of them, from runs at the division and shapes found."""
    validation = os.environ.get("JOSTLE_VALIDATION")
    if not validation:
        return None
    repeated, sensitive = [], []
    with tempfile.TemporaryDirectory() as folder:
        for model in range(DRAWN):
            subprocess.run([validation, "--certify-dump", str(model), folder], capture_output=True, check=True)
        for path in sorted(Path(folder).glob("*.json")):
            done = subprocess.run(
                [programs.JOSTLE, "run", str(path), "--no-report", "--json"], capture_output=True, text=True, cwd=folder
            )
            if done.returncode or not done.stdout.strip():
                continue
            summary = json.loads(done.stdout)
            impacts = sum(gap["impact_count"] for gap in summary["gaps"])
            repeated.append(summary["work"]["repeated_runs"])
            sensitive.append(impacts > 12)
    runs = [1 + again + int(more) for again, more in zip(repeated, sensitive)]
    say(f"promise: {statistics.median(runs)} runs of one model in the median, {statistics.mean(runs):.2f} on average")
    return {
        "models": len(runs),
        "median_runs": statistics.median(runs),
        "mean_runs": statistics.mean(runs),
        "repeated": sum(again > 0 for again in repeated),
        "second_run_for_sensitivity": sum(sensitive),
    }


def space(say):
    """Stepping of buildings in space, jostle alone."""
    found = {}
    for name in ("two-towers-in-space", "block-of-nine"):
        path = MODELS / f"{name}.toml"
        if not path.exists():
            continue
        taken = []
        for _ in range(TIMES):
            _, out = cpu_of([programs.JOSTLE, "run", str(path), "--no-report", "--json"])
            taken.append(json.loads(out))
        best = min(taken, key=lambda summary: summary["work"]["wall_s"])
        work = best["work"]
        found[name] = {
            "cpu_s": work["wall_s"],
            "steps": work["steps"],
            "short_steps": work["contact_steps"],
            "solutions": work["solves"],
            "impacts": sum(gap["impact_count"] for gap in best["gaps"]),
        }
        say(f"{name}: {1e3 * work['wall_s']:.1f} ms")
    return found
