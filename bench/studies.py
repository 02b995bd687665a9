"""Studies: a thousand cases beside OpenSees, and how well cores are used. See bench/run --study."""

import csv
import json
import os
import resource
import statistics
import subprocess
import tempfile
import time
from datetime import datetime, timezone
from pathlib import Path

import machine
import page
import programs
from cases import Case

STUDIES = Path(__file__).resolve().parent.parent / "benches" / "studies"
# Cases of the study that OpenSees computes as well, spread evenly over all of them.
SAMPLE = 12
# Rounds of the measurement of cores, and the share of the million towers that one of them takes.
ROUNDS, SHARE = 7, 200


def study(name, *options):
    """Starts a study in a folder of its own; reports and tables beside the rows are left out."""
    folder = tempfile.TemporaryDirectory()
    command = [programs.JOSTLE, "study", str(STUDIES / name), "--out", folder.name, *options]
    started = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return process, folder, started


def wait(running):
    """Waits for studies that run side by side; the wall time of all together [s]."""
    started = min(start for _, _, start in running)
    for process, _, _ in running:
        _, said = process.communicate(timeout=programs.PATIENCE)
        if process.returncode:
            raise RuntimeError(said[-2000:])
    return time.perf_counter() - started


def cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def thousand(say):
    """The study on one thread, its report and tables included, before and after what OpenSees needs for a sample."""
    rounds = []

    def once():
        before = cpu()
        running = study("gap_by_pga.toml", "--jobs", "1")
        wall = wait([running])
        rounds.append({"cpu_s": cpu() - before, "wall_s": wall})
        say(f"study: {rounds[-1]['cpu_s']:.2f} s of CPU")
        with open(Path(running[1].name) / "cases.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        lost = [row["case"] for row in rows if row["status"] != "completed"]
        if lost:
            raise RuntimeError(f"cases {', '.join(lost)} did not finish: {rows[int(lost[0])]['reason']}")
        return rows

    for _ in range(2):
        rows = once()
    sample = []
    for place in range(SAMPLE):
        row = rows[(2 * place + 1) * len(rows) // (2 * SAMPLE)]
        options = ("--gap", f"{row['gap_m']} m", "--pga", f"{row['pga_m_s2']} m/s2")
        case = Case("study", f"case {row['case']}", "paper", options)
        theirs = programs.opensees(case, free=4e-3, parts=5, axial="stiff")
        force = float(row["peak_force_n"])
        sample.append({
            "case": int(row["case"]), "gap_m": float(row["gap_m"]), "pga_m_s2": float(row["pga_m_s2"]),
            "jostle_peak_force_n": force, "jostle_impacts": int(row["impact_count"]),
            "opensees_peak_force_n": theirs["peak_force_n"], "opensees_impacts": theirs["impacts"],
            "opensees_cpu_s": theirs["cpu_s"],
        })
        say(f"case {row['case']}: OpenSees {theirs['cpu_s']:.1f} s, {theirs['peak_force_n'] / 1e3:.2f} kN; jostle {force / 1e3:.2f} kN")
    for _ in range(2):
        once()
    # Both programs meet the machine as it is: no quietest round here.
    ours = statistics.median(run["cpu_s"] for run in rounds)
    mean = statistics.mean(one["opensees_cpu_s"] for one in sample)
    apart = [abs(one["jostle_peak_force_n"] / one["opensees_peak_force_n"] - 1.0) for one in sample if one["opensees_peak_force_n"]]
    return {
        "cases": len(rows), "rounds": rounds, "cpu_s": ours, "sample": sample, "opensees_mean_cpu_s": mean,
        "ratio": mean * len(rows) / ours,
        "forces_apart": {"median": statistics.median(apart), "largest": max(apart)} if apart else None,
    }


def cores(say):
    """Cases a second of one thread, of two threads, and of two processes with nothing in common, in turn."""
    found = {"one": [], "threads": [], "processes": []}
    count = 1_000_000 // SHARE
    for turn in range(ROUNDS):
        shard = lambda index: ["--shard", f"{index}/{SHARE}", "--no-report"]
        ways = {
            "one": [shard(1) + ["--jobs", "1"]],
            "threads": [shard(2) + ["--jobs", "2"]],
            "processes": [shard(3) + ["--jobs", "1"], shard(4) + ["--jobs", "1"]],
        }
        for way, commands in ways.items():
            wall = wait([study("million_towers.toml", *options) for options in commands])
            found[way].append(count * len(commands) / wall)
        say(f"round {turn + 1}: " + ", ".join(f"{way} {rates[-1]:.0f}/s" for way, rates in found.items()))
    middle = {way: statistics.median(rates) for way, rates in found.items()}
    return {
        "cases": count, "rates": found, **middle,
        "efficiency": middle["threads"] / (2.0 * middle["one"]),
        "machine": middle["processes"] / (2.0 * middle["one"]),
    }


def text(results):
    """What the page says."""
    study, lines = results.get("study"), []
    if study:
        apart = study["forces_apart"]
        lines.append(
            f"**A study of {study['cases']} cases.** The study varies 25 gaps and 40 peak accelerations of J1 and J2, both elastic (`benches/studies/gap_by_pga.toml`), with modal stepping on "
            f"one thread. The whole process, including its report and tables, takes {page.seconds(study['cpu_s'])} of CPU time (median of {len(study['rounds'])} runs), or "
            f"{1e3 * study['cpu_s'] / study['cases']:.2f} ms per case. OpenSees at its best takes {page.seconds(study['opensees_mean_cpu_s'])} per case for the time steps alone. This is the mean of "
            f"{len(study['sample'])} cases that are evenly distributed over the study; both programs were run alternately. The ratio is **{page.times(study['ratio'])}** per core (aim: 20 000 ×). "
            f"The peak forces of these cases differ by {apart['median']:.0e} (median) and by at most {apart['largest']:.0e}."
        )
    used = results.get("cores")
    if used:
        lines.append(
            f"**Two cores.** {used['cases']} of the million pairs of towers of `benches/studies/million_towers.toml` were run in {len(used['rates']['one'])} alternating rounds. In the median, one thread "
            f"computes {used['one']:.0f} cases per second, two threads {used['threads']:.0f}, and two independent processes {used['processes']:.0f}. The efficiency of two "
            f"threads is {used['efficiency']:.2f}. That of two processes, the limit of this machine, is {used['machine']:.2f}; threads are "
            f"{max(0.0, 1.0 - used['threads'] / used['processes']):.1%} slower than processes."
        )
    if results:
        about = next(iter(results.values()))["machine_description"]
        lines.append(f"`bench/run --study`, {', '.join(sorted({part['at'][:10] for part in results.values()}))}: {about['processor']}, {about['cores']} cores, {about['system']}; {about['commit']}.")
    return "\n\n".join(lines)


def main(folder, say, parts):
    path = folder / "study.json"
    results = json.loads(path.read_text()) if path.exists() else {}
    for name, measure in (("cores", cores), ("study", thousand)):
        if parts and name not in parts:
            continue
        results[name] = measure(say)
        results[name] |= {"machine_description": machine.describe(), "at": datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC")}
        path.with_suffix(".tmp").write_text(json.dumps(results, indent=1, ensure_ascii=False) + "\n")
        os.replace(path.with_suffix(".tmp"), path)
    print(text(results))
    page.rewrite_studies(text(results))
    return 0
