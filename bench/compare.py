"""jostle and OpenSeesPy on the same models, in turn. See bench/run."""

import argparse
import json
import os
import sys
import traceback
from datetime import datetime, timezone
from pathlib import Path

import machine
import page
import programs
import reference
import scaling
import studies
import validation
import whole
from cases import CASES

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "results"
# The step that most people take throughout [s].
USUAL_STEP = 1e-4


def say(text):
    print(text, file=sys.stderr, flush=True)


# Looser tolerances than jostle's own, tried as the steps of OpenSees are.
LOOSER = (2e-3, 5e-3, 1e-2)


def cheapest(case, solver, known):
    """The loosest tolerance with which the force is as accurate as is asked; all tighter ones must be so as well."""
    found, limit = None, known.get("jostle", {}).get("peak_force_n")
    for tolerance in LOOSER if limit else ():
        run = programs.jostle(case, solver, tolerance, least=0.0, fewest=1)
        if abs(run["peak_force_n"] / limit - 1.0) > reference.MATCHED:
            break
        found = tolerance
    return found


# Of floors; the last two in space only.
MOTIONS = (
    ("displacement_max_m", "displacement_min_m"),
    ("displacement_across_max_m", "displacement_across_min_m"),
    ("rotation_max_rad", "rotation_min_rad"),
)


def peaks(found):
    """Peaks that both programs report, those of a kind and building or gap in one list: displacements and rotations of floors, forces
    of contacts or of faces, forces of links."""
    kinds = []
    for building in found["buildings"]:
        floors = building["floors"]
        for names in MOTIONS:
            if names[0] in floors[0]:
                kinds.append([floor[name] for floor in floors for name in names])
    if "faces" in found or "plan_m" in next(iter(found.get("gaps", [{}])[0].get("contacts", [])), {}):
        faces = found["faces"] if "faces" in found else [face for gap in found["gaps"] for face in gap["contacts"]]
        kinds.append([face["peak_force_n"] for face in faces])
        return kinds
    if "gaps" in found:
        gaps = [gap["contacts"] for gap in found["gaps"]]
    else:
        numbers = sorted({contact["gap"] for contact in found["contacts"]})
        gaps = [[contact for contact in found["contacts"] if contact["gap"] == number] for number in numbers]
    for contacts in gaps:
        in_order = sorted(contacts, key=lambda contact: (contact["height_m"], contact["floors"]))
        kinds.append([contact["peak_force_n"] for contact in in_order])
    kinds.append([link["peak_force_n"] for link in found.get("links", [])])
    return kinds


def largest_error(kinds, converged):
    """The largest difference, relative to the greatest of its kind; None if the lists do not belong together."""
    if [len(kind) for kind in kinds] != [len(kind) for kind in converged]:
        return None
    worst = 0.0
    for kind, limit in zip(kinds, converged):
        scale = max(map(abs, limit), default=0.0)
        if scale > 0.0:
            worst = max(worst, *(abs(a - b) / scale for a, b in zip(kind, limit)))
    return worst


def compare(case, known):
    """Both programs on one case: jostle, OpenSees, jostle again."""
    ways = [(solver, None) for solver in case.solvers if case.linear or solver != "modal"]
    ways += [(solver, tolerance) for solver, _ in ways if (tolerance := cheapest(case, solver, known))]
    rows = [programs.jostle(case, *way) for way in ways]
    settings = known.get("opensees", {}).get("settings", {"free": 2e-3, "parts": 10, "axial": "stiff"})
    say(f"{case.name}: OpenSees with {settings}")
    best = programs.opensees(case, **settings)
    again = [programs.jostle(case, *way) for way in ways]
    for row, second in zip(rows, again):
        # The machine is not ours alone: the quieter half counts.
        for name in ("cpu_s", "median_s", "process_cpu_s"):
            row[name] = min(row[name], second[name])
        row["runs"] += second["runs"]
        row["same_bits"] = row["peak_force_n"] == second["peak_force_n"]
    say(f"{case.name}: OpenSees with uniform steps of {1e3 * USUAL_STEP:g} ms for {case.piece:g} s")
    usual = programs.opensees(case, axial="ties", uniform=USUAL_STEP, duration=case.piece)
    whole = best["duration_s"] / usual["duration_s"]
    usual |= {"cpu_s": usual["cpu_s"] * whole, "steps": round(usual["steps"] * whole), "estimated_from_s": case.piece}
    converged = peaks(programs.jostle(case, ways[0][0], 1e-6, least=0.0, fewest=1)["summary"])
    for row in rows:
        row["error_of_peaks"] = largest_error(peaks(row["summary"]), converged)
    best["error_of_peaks"] = largest_error(peaks(best["result"]), converged)
    for row in rows + [best]:
        limit = known.get("jostle" if row["program"] == "jostle" else "opensees", {}).get("peak_force_n")
        row["error"] = None if limit is None else abs(row["peak_force_n"] / limit - 1.0)
        row["matched"] = None if limit is None else row["error"] <= reference.MATCHED
    apart = abs(known["jostle"]["peak_force_n"] / known["opensees"]["peak_force_n"] - 1.0) if known else None
    for row in rows:
        row["ratio_best"], row["ratio_usual"] = best["cpu_s"] / row["cpu_s"], usual["cpu_s"] / row["cpu_s"]
        row.pop("summary")
    for row in (best, usual):
        row.pop("result")
    return {"case": case.name, "title": case.title, "rows": rows + [best, usual], "limits_apart": apart}


# What is measured besides the cases, by name.
WHOLE = {
    "pairs": whole.pairs, "curve": whole.curve, "start": whole.start, "promise": whole.promise, "space": whole.space,
    "growth": scaling.measure,
}


def measure_whole(names):
    """Measures some of these, or all, and keeps them in one file."""
    path = RESULTS / "whole.json"
    results = json.loads(path.read_text()) if path.exists() else {}
    for name in names or WHOLE:
        say(f"== {name}")
        found = WHOLE[name](say)
        if found is None:
            continue
        results[name] = found
        results["machine"] = machine.describe()
        results["at"] = datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
        path.with_suffix(".tmp").write_text(json.dumps(results, indent=1, ensure_ascii=False) + "\n")
        os.replace(path.with_suffix(".tmp"), path)
    if "growth" in results:
        scaling.draw(results["growth"])


def main():
    parser = argparse.ArgumentParser(prog="bench/run", description=__doc__)
    parser.add_argument("cases", nargs="*", help=f"of {', '.join(case.name for case in CASES)}; without: all")
    parser.add_argument("--quick", action="store_true", help="two towers and the first five seconds of the example")
    parser.add_argument("--reference", action="store_true", help="find settings and converged values again")
    parser.add_argument("--validation", action="store_true", help="OpenSees' answers for the models of the validation")
    parser.add_argument("--study", nargs="*", choices=["study", "cores"], help="a thousand cases against OpenSees, and how well two cores are used")
    parser.add_argument("--whole", nargs="*", choices=sorted(WHOLE), help="whole programs, space and growth, jostle alone")
    parser.add_argument("--keep-page", action="store_true", help="leave docs/performance.md alone")
    args = parser.parse_args()
    unknown = set(args.cases) - {case.name for case in CASES}
    if unknown:
        parser.error(f"there is no case {', '.join(sorted(unknown))}")
    if args.study is not None:
        RESULTS.mkdir(exist_ok=True)
        return studies.main(RESULTS, say, args.study)
    if args.whole is not None:
        RESULTS.mkdir(exist_ok=True)
        measure_whole(args.whole)
        page.rewrite(RESULTS, [case.name for case in CASES])
        return 0
    if args.validation:
        return validation.main(say)
    asked = [case for case in CASES if case.name in args.cases] or [case for case in CASES if not case.by_name]
    chosen = [case for case in asked if case.quick or not args.quick]
    references = reference.load()
    if args.reference:
        for case in chosen:
            references[case.name] = reference.refine(case, say)
            reference.store(references)
        return 0
    RESULTS.mkdir(exist_ok=True)
    failed = False
    for case in chosen:
        say(f"== {case.name}: {case.title}")
        try:
            result = compare(case, references.get(case.name, {}))
        except Exception:  # the others are still worth having
            say(traceback.format_exc())
            failed = True
            continue
        result["machine"] = machine.describe()
        result["at"] = datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
        path = RESULTS / f"{case.name}.json"
        path.with_suffix(".tmp").write_text(json.dumps(result, indent=1, ensure_ascii=False) + "\n")
        os.replace(path.with_suffix(".tmp"), path)
        print(page.table([result]), flush=True)
    if not args.cases and not args.quick:
        studies.main(RESULTS, say, [])
        measure_whole([])
    if not args.keep_page and not args.quick:
        page.rewrite(RESULTS, [case.name for case in CASES])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
