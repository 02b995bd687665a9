"""What Python costs on top of Rust, how threads scale, and whether memory stays.

    python benches/python/overhead.py [--rust PROGRAM] [--runs 100] [--leak 10000]

``--rust`` names the program built by ``cargo build --release -p jostle-cli --example loop_of_runs``: the same runs
in Rust alone. Everything is measured in short rounds, in turns; the median of the ratios counts, since machines change their
pace. Nothing else should run meanwhile.
"""

from __future__ import annotations

import argparse
import os
import resource
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

import jostle

TOWERS = Path(__file__).resolve().parents[2] / "examples" / "two_towers.toml"


def python_loop(model: jostle.Model, runs: int) -> None:
    for _ in range(runs):
        jostle.run(model)


def cpu_of_python(model: jostle.Model, runs: int) -> float:
    started = time.process_time()
    python_loop(model, runs)
    return time.process_time() - started


def cpu_of_rust(program: str, runs: int) -> float:
    return float(subprocess.run([program, str(TOWERS), str(runs)], capture_output=True, check=True).stdout)


def wall_of_threads(model: jostle.Model, runs: int, threads: int) -> float:
    """Wall time of ``runs`` runs in each of some threads."""
    workers = [threading.Thread(target=python_loop, args=(model, runs)) for _ in range(threads)]
    started = time.perf_counter()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return time.perf_counter() - started


def wall_of_processes(runs: int, processes: int) -> float:
    """Wall time of ``runs`` runs in each of some processes, which share nothing."""
    code = (
        "import sys, time, jostle; m = jostle.Model.load(sys.argv[1]); jostle.run(m); print(flush=True); "
        "sys.stdin.readline(); [jostle.run(m) for _ in range(int(sys.argv[2]))]; print(flush=True)"
    )
    command = [sys.executable, "-c", code, str(TOWERS), str(runs)]
    pipe = subprocess.PIPE
    workers = [subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True) for _ in range(processes)]
    for worker in workers:
        assert worker.stdout and worker.stdout.readline() == "\n"
    started = time.perf_counter()
    for worker in workers:
        assert worker.stdin
        worker.stdin.write("\n")
        worker.stdin.flush()
    for worker in workers:
        assert worker.stdout and worker.stdout.readline() == "\n"
    taken = time.perf_counter() - started
    for worker in workers:
        worker.communicate()
    return taken


def resident() -> float:
    """Resident memory now [MiB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rust", help="the same loop in Rust")
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--leak", type=int, default=10_000)
    arguments = parser.parse_args()
    model, runs = jostle.Model.load(TOWERS), arguments.runs
    python_loop(model, 3)

    if arguments.rust:
        pairs = [(cpu_of_python(model, runs), cpu_of_rust(arguments.rust, runs)) for _ in range(arguments.rounds)]
        ours, theirs = (statistics.median(column) for column in zip(*pairs))
        more = statistics.median(ours / theirs for ours, theirs in pairs) - 1
        print(f"{runs} runs: Python {ours:.3f} s CPU, Rust {theirs:.3f} s, {100 * more:+.1f} %")
    else:
        ours = statistics.median(cpu_of_python(model, runs) for _ in range(arguments.rounds))
        print(f"{runs} runs: Python {ours:.3f} s CPU")

    cores = len(os.sched_getaffinity(0))
    walls = [
        (wall_of_threads(model, runs, 1), wall_of_threads(model, runs, 2), wall_of_processes(runs, 2))
        for _ in range(arguments.rounds)
    ]
    two, apart = (statistics.median(2 * wall[0] / wall[way] for wall in walls) for way in (1, 2))
    print(
        f"two threads do {two:.2f} times the work of one ({cores} cores), "
        f"two processes that share nothing {apart:.2f} times"
    )

    # Short runs, with everything that leaves something behind.
    motion = jostle.Motion.el_centro().scaled(pga="0.3 g").lasting("4 s")
    short = model.changed(motion=motion)
    before = 0.0
    for number in range(arguments.leak + 1):
        result = jostle.run(short)
        _ = result.summary, result.floor(0, -1).displacement, result.history, len(result.impacts)
        if number % 100 == 0:
            result.history.__arrow_c_stream__()
        if number in (arguments.leak // 10, arguments.leak):
            now = resident()
            grown = f", {now - before:+.2f} MiB" if before else ""
            print(f"after {number} runs: {now:.1f} MiB resident{grown}")
            before = now


if __name__ == "__main__":
    main()
