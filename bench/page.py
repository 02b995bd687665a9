"""Tables for people, and the section of docs/performance.md."""

import json
import math
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "performance.md"
BEGIN = "<!-- bench/run: what follows is written by it -->"
END = "<!-- bench/run: end -->"
BEGIN_STUDIES = "<!-- bench/run --study: what follows is written by it -->"
END_STUDIES = "<!-- bench/run --study: end -->"
# What the project set itself: solver, case, ratio to OpenSees at its best.
TARGETS = {
    ("riccati", "few"): 300, ("riccati", "many"): 300, ("modal", "few"): 5000, ("modal", "many"): 5000,
    ("riccati", "inelastic"): 1000, ("series", "yielding-towers"): 100, ("modal", "towers"): 5000, ("modal", "high-rise"): 1000,
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
        "| case | program | CPU | steps (short) | factorisations | error of the force | peak force | impacts | OpenSees at its best | uniform 0.1 ms |",
        "|---|---|---|---|---|---|---|---|---|---|",
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
                f"{row['steps']}" + ("" if uniform else f" ({row['short_steps']})"),
                str(work),
                "" if uniform else ("?" if error is None else f"{error:.0e}"),
                "" if uniform else f"{row['peak_force_n'] / 1e3:.2f} kN",
                "" if uniform else str(row["impacts"]),
                times(row.get("ratio_best")),
                times(row.get("ratio_usual")),
            ]) + " |")
    return "\n".join(lines)


def missed(results):
    """Every target with the best ratio of a run that is accurate enough."""
    lines = []
    for result in results:
        for (way, case), target in TARGETS.items():
            rows = [row for row in result["rows"] if case == result["case"] and way == row["way"] and row.get("matched")]
            if rows:
                best = max(row["ratio_best"] for row in rows)
                word = "reached" if best >= target else "missed"
                lines.append(f"- {result['title']}, {way}: target {times(target)}, {word} ({times(best)})")
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
    text = "\n".join([
        BEGIN,
        "",
        f"`bench/run`, {' and '.join(when)}: {machine['jostle']} ({machine['commit']}, {machine['rustc']}), OpenSeesPy {', '.join(versions)} on Python "
        f"{machine['python']}; {machine['processor']}, {machine['cores']} cores, {machine['system']}; load {' … '.join(sorted({str(r['machine']['load']) for r in results}))}.",
        "",
        table(results),
        "",
        f"Both programs converge to forces that are at most {max(apart):.1e} apart." if apart else "",
        "",
        missed(results),
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
