"""Tables for people, and the section of docs/performance.md."""

import json
import math
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "performance.md"
BEGIN = "<!-- bench/run: what follows is written by it -->"
END = "<!-- bench/run: end -->"
BEGIN_STUDIES = "<!-- bench/run --study: what follows is written by it -->"
END_STUDIES = "<!-- bench/run --study: end -->"
BEGIN_GLANCE = "<!-- bench/run, at a glance: what follows is written by it -->"
END_GLANCE = "<!-- bench/run, at a glance: end -->"
BEGIN_LIMITS = "<!-- bench/run, limits: what follows is written by it -->"
END_LIMITS = "<!-- bench/run, limits: end -->"
# What the project set itself: case, solver, ratio to OpenSees at its best.
TARGETS = {
    ("few", "modal"): 5000, ("many", "modal"): 5000, ("high-rise", "modal"): 1000, ("row", "modal"): 3000, ("linked-row", "modal"): 3000,
    ("space", "modal"): 1000, ("space-block", "modal"): 1000, ("yielding-towers", "series"): 100, ("inelastic", "riccati"): 1000, ("few", "riccati"): 300, ("many", "riccati"): 300,
}


def seconds(value):
    if value >= 3600:
        return f"{value / 3600:.1f} h"
    if value >= 120:
        return f"{value / 60:.0f} min"
    return f"{value:.3g} s" if value >= 1 else f"{1e3 * value:.3g} ms"


def times(value):
    return "" if value is None else f"{rounded(value):,}".replace(",", " ") + " ×"


def rounded(value):
    """Three digits, as a whole number where it is large."""
    if value < 100:
        return float(f"{value:.3g}")
    digits = 10 ** (int(math.log10(value)) - 2)
    return int(round(value / digits) * digits)


def table(results):
    lines = [
        "| case | program | time steps | whole process | steps (short) | factorisations | error of the force | of all peaks | peak force | impacts | OpenSees at its best | uniform 0.1 ms |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for result in results:
        for index, row in enumerate(result["rows"]):
            uniform = row["way"] == "uniform"
            error = row.get("error")
            work = row.get("factorisations")
            if row["program"] != "jostle":
                work = f"{row['iterations']} iterations" if not uniform else ""
            lines.append("| " + " | ".join([
                result["title"] if index == 0 else "",
                f"{row['program']} {row['way']} ({row['settings']})",
                ("about " if uniform else "") + seconds(row["cpu_s"]),
                "" if uniform else seconds(row["process_cpu_s"]),
                f"{row['steps']}" + ("" if uniform else f" ({row['short_steps']})"),
                str(work),
                "" if uniform else ("?" if error is None else f"{error:.0e}"),
                "" if row.get("error_of_peaks") is None else f"{row['error_of_peaks']:.0e}",
                "" if uniform else f"{row['peak_force_n'] / 1e3:.2f} kN",
                "" if uniform else str(row["impacts"]),
                times(row.get("ratio_best")),
                times(row.get("ratio_usual")),
            ]) + " |")
    return "\n".join(lines)


def word(reached):
    return "reached" if reached else "missed"


def glance(results, study, whole):
    """The aims, and what was measured."""
    lines = ["| case, solver | jostle | OpenSees at its best | ratio | aim | result |", "|---|---|---|---|---|---|"]
    by_case = {result["case"]: result for result in results}
    for (case, way), target in TARGETS.items():
        result = by_case.get(case)
        rows = [row for row in result["rows"] if row["way"] == way and row.get("matched")] if result else []
        if not rows:
            continue
        best = max(rows, key=lambda row: row["ratio_best"])
        theirs = next(row for row in result["rows"] if row["way"] == "best")
        lines.append(
            f"| {result['title']}, {way} | {seconds(best['cpu_s'])}, {best['steps']} steps | {seconds(theirs['cpu_s'])}, {theirs['steps']} steps | "
            f"{times(best['ratio_best'])} | {times(target)} | {word(best['ratio_best'] >= target)} |"
        )
    one = study.get("study")
    if one:
        lines.append(
            f"| study of {one['cases']} cases of the built-in example, whole process, per core | {seconds(one['cpu_s'])} | "
            f"{seconds(one['opensees_mean_cpu_s'] * one['cases'])}, from {len(one['sample'])} cases | {times(one['ratio'])} | 20 000 × | {word(one['ratio'] >= 20000)} |"
        )
    pairs = whole.get("pairs")
    if pairs:
        lines.append(
            f"| 100 pairs of four beside six yielding storeys, 31 s, whole process, per core | {pairs['per_second']:.0f} pairs per second | | | 300 per second | "
            f"{word(pairs['per_second'] >= 300)} |"
        )
    curve = whole.get("curve")
    if curve:
        lines.append(
            f"| peak force against gap for the built-in example, {curve['points']} gaps with {curve['impacts']:.0f} impacts on average, whole process, one core | "
            f"{seconds(curve['cpu_s'])} | | | 250 ms | {word(curve['cpu_s'] <= 0.25)} |"
        )
    names = {"two-towers-in-space": ("two towers of ten storeys in space, 31 s", 0.01), "block-of-nine": ("block of nine buildings in space", 0.2)}
    for name, (title, target) in names.items():
        found = whole.get("space", {}).get(name)
        if found:
            lines.append(
                f"| {title} | {seconds(found['cpu_s'])}, {found['steps']} steps, {found['impacts']} impacts | | | {seconds(target)} | {word(found['cpu_s'] <= target)} |"
            )
    promise = whole.get("promise")
    if promise:
        lines.append(
            f"| runs needed to meet the tolerance, {promise['models']} random models | median {promise['median_runs']:g}, mean {promise['mean_runs']:.2f} | | | "
            f"1.3 | {word(promise['median_runs'] <= 1.3)} |"
        )
    start = whole.get("start")
    if start:
        lines.append(f"| time from the start of the program to the first step | {seconds(start['cpu_s'])} | | | 3 ms | {word(start['cpu_s'] <= 3e-3)} |")
    return "\n".join(lines)


def limits(results, study, whole):
    """Why no more is reached, with counts."""
    by_case = {result["case"]: result for result in results}

    def row(case, way):
        rows = by_case[case]["rows"] if case in by_case else []
        return next((row for row in rows if row["way"] == way and row.get("matched")), None)

    lines, free, closed = [], row("few", "modal"), row("many", "modal")
    if free and closed:
        each = (closed["cpu_s"] - free["cpu_s"]) / max(1, closed["short_steps"] - free["short_steps"])
        lines.append(
            f"- *Elastic buildings* need one step per point of the record, and short steps around contacts. A run with one impact has {free['steps']} steps, {free['short_steps']} of them in contact, "
            f"and takes {seconds(free['cpu_s'])}. A contact step takes about {1e6 * each:.1f} µs: it solves for the forces of all closed contacts, and updates peaks and the energy balance."
        )
    one = study.get("study")
    if one and free:
        aim = one["opensees_mean_cpu_s"] / 20000
        lines.append(
            f"- *Studies.* The aim of 20 000 times the speed of OpenSees corresponds to {seconds(aim)} per case, less than the {seconds(free['cpu_s'])} of a single run with one impact. A case takes "
            f"{seconds(one['cpu_s'] / one['cases'])}, because narrow gaps have hundreds of impacts, and runs with more than twelve impacts are made twice to check whether they are "
            "sensitive. To reach the aim, the time before the first and after the last impact of a case would have to be skipped."
        )
    yielding = row("inelastic", "riccati")
    if yielding:
        lines.append(
            f"- *Yielding frames* solve for 260 and 770 displacements in each of {yielding['steps']} steps, and update the factors {yielding['factorisations']} times because hinges change their stiffness. "
            "The aim of 1 000 times would require longer steps in which changes of hinges are located, or steps for the displacements of joints only."
        )
    pairs = whole.get("pairs")
    series = row("yielding-towers", "series")
    if pairs and series:
        lines.append(
            f"- *Yielding shear buildings* need {series['solutions']} solutions, one for each segment between stiffness changes and each iteration of contact forces. A solution takes "
            f"{1e6 / pairs['per_second'] / series['solutions']:.1f} µs, including all other work of a run. The series, the search for stiffness changes, and peaks and energy take similar shares."
        )
    slow = row("few", "riccati")
    if slow:
        lines.append(
            f"- *The Riccati solver* advances all 840 displacements of the built-in example in {slow['steps']} steps of {1e6 * slow['cpu_s'] / slow['steps']:.1f} µs each, "
            "including the coarser run for the error estimate."
        )
    linked = row("linked-row", "modal")
    if linked:
        lines.append(
            f"- *Rows* with dampers need {linked['steps']} steps, {linked['short_steps']} of them in contact, and {linked['solutions']} solutions for all modes of all buildings. "
            f"A solution takes {1e6 * linked['cpu_s'] / linked['solutions']:.1f} µs, including the motions of all floors, peaks and energy. An impact of two buildings shortens the steps of all buildings."
        )
    space = row("space", "modal")
    if space:
        lines.append(
            f"- *Buildings in space* come into contact point by point, and each opening and closing of a point ends a step. Two towers need {space['steps']} steps, {space['short_steps']} of them in contact, and "
            f"{space['solutions']} solutions of {1e6 * space['cpu_s'] / space['solutions']:.1f} µs each, including those that locate these events. "
            "A contact step solves for the forces at the ends of up to ten faces. Forces, motions of all floors and corners, and peaks and energy take similar shares. The aim of 1 000 times would require "
            "several events in one step."
        )
    curve = whole.get("curve")
    if curve:
        lines.append(
            f"- *Peak force against gap* requires {curve['points']} runs of {1e3 * curve['cpu_s'] / curve['points']:.1f} ms each; those with narrow gaps have hundreds of impacts. The time before the first impact "
            "could be shared by several runs, but it is short for narrow gaps."
        )
    promise = whole.get("promise")
    if promise:
        lines.append(
            f"- *The tolerance* requires a further run if it is not met ({promise['repeated']} of {promise['models']} random models), and another run to check whether results are sensitive "
            f"({promise['second_run_for_sensitivity']} models, those with more than twelve impacts)."
        )
    return "\n".join(lines)


def rewrite(folder, order):
    """The section between the marks, from everything that lies in the folder."""
    results = [json.loads((folder / f"{name}.json").read_text()) for name in order if (folder / f"{name}.json").exists()]
    if not results:
        return
    machine = results[-1]["machine"]
    versions = sorted({row["version"] for result in results for row in result["rows"] if row["program"] != "jostle"})
    when = sorted({result["at"][:10] for result in results})
    apart = [result["limits_apart"] for result in results if result["limits_apart"] is not None]
    study, whole = (json.loads(path.read_text()) if path.exists() else {} for path in (folder / "study.json", folder / "whole.json"))
    put_between(BEGIN_GLANCE, END_GLANCE, "\n".join([BEGIN_GLANCE, "", glance(results, study, whole), "", END_GLANCE]))
    put_between(BEGIN_LIMITS, END_LIMITS, "\n".join([BEGIN_LIMITS, "", limits(results, study, whole), "", END_LIMITS]))
    text = "\n".join([
        BEGIN,
        "",
        f"`bench/run`, {' and '.join(when)}: {machine['jostle']} ({machine['commit']}, {machine['rustc']}), OpenSeesPy {', '.join(versions)} on Python "
        f"{machine['python']}; {machine['processor']}, {machine['cores']} cores, {machine['system']}; load {' … '.join(sorted({str(r['machine']['load']) for r in results}))}.",
        "",
        table(results),
        "",
        f"The converged peak forces of both programs differ by at most {max(apart):.1e}." if apart else "",
        "",
        END,
    ])
    put_between(BEGIN, END, text)


def rewrite_studies(text):
    """The section on studies."""
    put_between(BEGIN_STUDIES, END_STUDIES, "\n".join([BEGIN_STUDIES, "", text, "", END_STUDIES]))


def put_between(begin, end, text):
    page = PAGE.read_text()
    start, end = page.index(begin), page.index(end) + len(end)
    temporary = PAGE.with_suffix(".tmp")
    temporary.write_text(page[:start] + text + page[end:])
    temporary.replace(PAGE)
