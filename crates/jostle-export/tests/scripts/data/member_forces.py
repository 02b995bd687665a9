#!/usr/bin/env python3
"""Forces of columns and beams of frame.toml by OpenSees, as frame_member_forces.csv.

    python crates/jostle-export/tests/scripts/data/member_forces.py JOSTLE

JOSTLE is the program, such as target/debug/jostle. Needs openseespy. Writes the file beside this one.
"""

import csv
import importlib.util
import pathlib
import subprocess
import sys
import tempfile

import openseespy.opensees as ops

HERE = pathlib.Path(__file__).parent
STEP = 5e-4  # s
EVERY = 50  # steps between rows
# Name, and the coordinates of both ends [m].
MEMBERS = {
    "A.column.1.1": ((0.0, 0.0), (0.0, 3.2)),
    "A.column.2.1": ((6.0, 0.0), (6.0, 3.2)),
    "A.column.3.2": ((11.0, 3.2), (11.0, 6.4)),
    "A.beam.1.1": ((0.0, 3.2), (6.0, 3.2)),
    "A.beam.3.2": ((6.0, 9.6), (11.0, 9.6)),
}


def exported(jostle, folder):
    """The script that jostle writes for the model, as a module."""
    path = pathlib.Path(folder) / "frame.py"
    subprocess.run([jostle, "export", HERE / "frame.toml", "--to", "openseespy", "-o", path], check=True)
    spec = importlib.util.spec_from_file_location("frame", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def end_elements(script, ends):
    """Elements at the lower or left and at the upper or right end of a member."""
    where = {tag: (x, y) for tag, x, y, *_ in script.NODES}
    (x0, y0), (x1, y1) = ends
    within = lambda tag: x0 <= where[tag][0] <= x1 and y0 <= where[tag][1] <= y1
    own = [(tag, where[first], where[last]) for tag, first, last, *_ in script.MEMBERS if within(first) and within(last)]
    start = next(tag for tag, first, _ in own if first == ends[0])
    end = next(tag for tag, _, last in own if last == ends[1])
    return start, end


def main():
    with tempfile.TemporaryDirectory() as folder:
        script = exported(sys.argv[1], folder)
    script.build("ties")
    script.prepare("ties")
    script.shake()
    ops.integrator("Newmark", 0.5, 0.25)
    ops.algorithm("Linear")
    ops.analysis("Transient")
    elements = {name: end_elements(script, ends) for name, ends in MEMBERS.items()}
    rows = []
    for step in range(1, round(script.DURATION / STEP) + 1):
        if ops.analyze(1, STEP) != 0:
            sys.exit("a step failed")
        if step % EVERY:
            continue
        for name, (start, end) in elements.items():
            _, shear, moment, *_ = ops.eleResponse(start, "localForce")
            *_, last_shear, last_moment = ops.eleResponse(end, "localForce")
            forces = [f"{force:.4f}" for force in (shear, moment, last_shear, last_moment)]
            rows.append([name, f"{step * STEP:.3f}", *forces])
    with open(HERE / "frame_member_forces.csv", "w", newline="") as file:
        file.write("# frame.toml by OpenSees (openseespy), elasticBeamColumn, Newmark 1/2 and 1/4, steps of 0.5 ms, members that\n")
        file.write("# keep their length by equalDOF, as member_forces.py computes them; forces on the ends as localForce gives\n")
        file.write("# them: shear at the lower or left end, moment there, shear and moment at the other end [N, N m].\n")
        file.write(f"# OpenSees {ops.version()}\n")
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["member", "time_s", "shear_start_n", "moment_start_nm", "shear_end_n", "moment_end_nm"])
        out.writerows(sorted(rows))


if __name__ == "__main__":
    main()
