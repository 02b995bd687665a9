"""Notebook display of models, motions and results: HTML with inline SVG, offline, for light and dark themes."""

from __future__ import annotations

import html
import math
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._check import Check
    from ._compare import Comparison
    from ._contact_advice import ContactAdvice
    from ._model import Model
    from ._modes import BuildingModes
    from ._motion import Spectrum
    from ._result import Contact, Result
    from ._section import SectionAnswer
    from ._selection import Selection
    from ._size import SizeAnswer
    from ._study import CriticalGap, Study, StudyResult
    from ._suite import Suite
    from ._table import Table

#: A label, instants and values.
Curve = tuple[str, "npt.NDArray[np.float64]", "npt.NDArray[np.float64]"]
#: Colours that can be told apart on light and on dark ground.
COLOURS = ("#2a83c4", "#e0701f", "#12966b", "#bb6299", "#c98500", "#6f7dd8", "#7a808a")
_FONT = "font-family:system-ui,sans-serif"
#: Drawn width of a shear building, which has none [m].
_NOMINAL_WIDTH = 6.0
#: Rows of a table that a notebook shows.
_SHOWN = 10


def colour(index: int) -> str:
    """Colour of a building or curve."""
    return COLOURS[index % len(COLOURS)]


def contact_name(contact: Contact) -> str:
    """Name of a contact for legends."""
    left, right = contact.floors
    place = f"floor {left}" if left == right else f"floors {left} | {right}"
    if left is None or right is None:
        place = f"{contact.height:.2f} m"
    return f"{'–'.join(contact.between)}, {place}"


def model_html(model: Model) -> str:
    """The buildings to scale, with masses and periods."""
    tree = model.description
    rows = [
        (
            building["name"],
            building["kind"],
            f"{len(building['floor_heights_m'])}",
            f"{building['floor_heights_m'][-1]:.6g}",
            f"{1e-3 * building['mass_kg']:.4g}",
            ", ".join(f"{period:.3f}" for period in building["periods_s"][:3]),
        )
        for building in tree["buildings"]
    ]
    heads = ("building", "kind", "storeys", "height [m]", "mass [t]", "periods [s]")
    motion = "no ground motion"
    try:
        ground = None if model.records else model.motion
        if model.records:
            motion = f"{len(model.records)} records: {', '.join(model.records)}"
        elif ground is not None:
            motion = f"{ground.name}, peak {100 * ground.pga:.4g} cm/s², {ground.duration:.4g} s"
    except ValueError as error:
        motion = str(error)
    return (
        f'<div style="{_FONT}"><b>{_text(tree["title"])}</b>{model_svg(tree)}{_rows(heads, rows)}'
        f'<div style="opacity:.75">{_text(motion)}</div></div>'
    )


def model_svg(tree: dict[str, Any]) -> str:
    """The buildings to scale; gaps are drawn wide enough to be seen."""
    buildings, gaps = tree["buildings"], tree["gaps"]
    widths = [sum(b["spans_m"]) or _NOMINAL_WIDTH for b in buildings]
    tallest = max(b["floor_heights_m"][-1] for b in buildings)
    between = 54.0
    scale = min(300 / tallest, max(120.0, 720 - between * len(buildings)) / sum(widths))
    base, x = tallest * scale + 26, 44.0
    parts: list[str] = []
    edges = []
    for index, building in enumerate(buildings):
        lines = [x]
        for span in building["spans_m"] or [_NOMINAL_WIDTH]:
            lines.append(lines[-1] + span * scale)
        parts.append(_building(building, lines, base, scale, colour(index)))
        edges.append((lines[0], lines[-1]))
        x = lines[-1] + between
    names = [building["name"] for building in buildings]
    walls = (edges[0][0] - 0.5 * between, edges[-1][1] + 0.5 * between)
    drawn: set[int] = set()

    def sides(pair: Sequence[str]) -> tuple[float, float]:
        """Positions of the left and the right side of a gap or a link."""
        places = []
        for side, name in enumerate(pair):
            if name == "wall":
                places.append(walls[side])
                drawn.add(side)
            else:
                places.append(edges[names.index(name)][1 - side])
        return places[0], places[1]

    for gap in gaps:
        left, right = sides(gap["between"])
        for contact in gap["contacts"]:
            y = base - contact["height_m"] * scale
            parts.append(
                f'<path d="M{left + 3:.1f},{y:.1f}H{right - 3:.1f}" '
                'stroke="currentColor" stroke-dasharray="2 3" opacity=".6"/>'
            )
        label = f"gap {1e3 * gap['width_m']:.4g} mm"
        parts.append(_svg_text((left + right) / 2, base + 34, label, "middle", 12))
    for link in tree["links"]:
        left, right = sides(link["between"])
        for floor in link["floors"]:
            y = base - floor["height_m"] * scale
            middle = (left + right) / 2
            parts.append(
                f'<path d="M{left:.1f},{y:.1f}H{middle - 4:.1f}m0,-5v10M{middle + 4:.1f},{y - 6:.1f}h-8m0,12h8'
                f'M{middle:.1f},{y:.1f}H{right:.1f}" stroke="currentColor" stroke-width="1.5" fill="none"/>'
            )
    for side in sorted(drawn):
        roof = base - buildings[-side]["floor_heights_m"][-1] * scale
        start = walls[side] - (8 if side == 0 else 0)
        parts.append(
            f'<rect x="{start:.1f}" y="{roof:.1f}" width="8" height="{base - roof:.1f}" '
            'fill="currentColor" opacity=".5"/>'
        )
    width = x - between + 44
    return (
        f'<svg viewBox="0 0 {width:.0f} {base + 44:.0f}" width="{width:.0f}" role="img" '
        f'style="max-width:100%;display:block;{_FONT}"><title>{_text(tree["title"])}</title>'
        f'<path d="M0,{base:.1f}H{width:.0f}" stroke="currentColor" stroke-width="1.5"/>{"".join(parts)}</svg>'
    )


def _building(
    building: dict[str, Any], lines: Sequence[float], base: float, scale: float, ink: str
) -> str:
    heights = building["floor_heights_m"]
    roof = base - heights[-1] * scale
    columns = "".join(f"M{x:.1f},{base:.1f}V{roof:.1f}" for x in lines)
    floors = "".join(
        f"M{lines[0]:.1f},{base - h * scale:.1f}H{lines[-1]:.1f}" for h in heights
    )
    thick = 2.5 if building["kind"] == "frame" else 5
    middle = (lines[0] + lines[-1]) / 2
    return (
        f'<path d="{columns}" stroke="{ink}" stroke-width="2" fill="none"/>'
        f'<path d="{floors}" stroke="{ink}" stroke-width="{thick}" fill="none"/>'
        + _svg_text(middle, roof - 9, f"{heights[-1]:.4g} m", "middle", 11, 0.7)
        + _svg_text(middle, base + 18, building["name"], "middle", 13)
    )


def history_svg(
    title: str, unit: str, curves: Sequence[Curve], height: int = 170, abscissa: str = " s"
) -> str:
    """Curves over time, or over something else, in one frame, thinned to what can be seen."""
    left, right, top, bottom, width = 64, 12, 24, 26, 760
    series = [(label, *thinned(time, values, width)) for label, time, values in curves]
    if not any(len(time) for _, time, _ in series):
        return ""
    end = max(float(time[-1]) for _, time, _ in series if len(time)) or 1.0
    low = min(0.0, *(float(values.min()) for _, _, values in series if len(values)))
    high = max(0.0, *(float(values.max()) for _, _, values in series if len(values)))
    high += 1.0 if high == low else 0.0

    def px(t: Any) -> Any:
        return left + (width - left - right) * t / end

    def py(value: Any) -> Any:
        return top + (height - top - bottom) * (high - value) / (high - low)

    parts = [_svg_text(left, 14, f"{title} [{unit}]", "start", 12)]
    for value in sorted({low, 0.0, high}):
        y = py(value)
        parts.append(
            f'<path d="M{left},{y:.1f}H{width - right}" stroke="currentColor" opacity=".25"/>'
        )
        parts.append(_svg_text(left - 6, y + 4, f"{value:.4g}".replace("-", "−"), "end", 11, 0.75))
    for t in ticks(end):
        anchor = "end" if px(t) > width - 30 else "middle"
        parts.append(_svg_text(px(t), height - 8, f"{t:.6g}{abscissa}", anchor, 11, 0.75))
    for index, (label, time, values) in enumerate(series):
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(px(time), py(values)))
        parts.append(
            f'<polyline points="{points}" fill="none" stroke="{colour(index)}" stroke-width="1.2">'
            f"<title>{_text(label)}</title></polyline>"
        )
    if len(series) > 1 or series[0][0] != title:
        x = float(width - right)
        for index, (label, _, _) in reversed(list(enumerate(series))):
            parts.append(
                f'<text x="{x:.0f}" y="14" text-anchor="end" font-size="11" fill="{colour(index)}">'
                f"{_text(label)}</text>"
            )
            x -= 6.5 * len(label) + 14
    return (
        f'<svg viewBox="0 0 {width} {height}" width="{width}" role="img" '
        f'style="max-width:100%;display:block;{_FONT}">{"".join(parts)}</svg>'
    )


def ticks(end: float) -> list[float]:
    """Round values from zero to an end, at most eight."""
    power = 10.0 ** math.floor(math.log10(end / 8))
    step = next((m * power for m in (1, 2, 5, 10) if end / (m * power) <= 8), end)
    return [step * k for k in range(int(end / step * (1 + 1e-9)) + 1)]


def thinned(
    time: npt.NDArray[np.float64], values: npt.NDArray[np.float64], pixels: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Least and greatest value of every pixel's time, and the ends."""
    import numpy as np

    kept: npt.NDArray[Any]
    if len(time) <= 4 * pixels:
        kept = np.arange(len(time))
    else:
        bins = np.floor((time - time[0]) / max(time[-1] - time[0], 1e-300) * (pixels - 1e-9))
        starts = np.flatnonzero(np.r_[True, np.diff(bins) > 0])
        ends = np.r_[starts[1:], len(time)]
        extremes = [
            first + at
            for first, last in zip(starts, ends)
            for at in (values[first:last].argmin(), values[first:last].argmax())
        ]
        kept = np.unique(np.r_[0, extremes, len(time) - 1])
    # A long run at rest is two points.
    still = np.zeros(len(kept), dtype=bool)
    still[1:-1] = (values[kept[1:-1]] == values[kept[:-2]]) & (
        values[kept[1:-1]] == values[kept[2:]]
    )
    kept = kept[~still]
    return time[kept], values[kept]


def result_html(result: Result) -> str:
    """Summary, force history and animation."""
    from ._animation import frame

    summary = result.summary
    parts = [
        f"<b>{_text(summary['title'])}</b>",
        f'<div style="margin:.3em 0 .6em">{_text(result._core.verdict())}</div>',
    ]
    for warning in [summary["ended_early"], *summary["warnings"]]:
        if warning:
            parts.append(f'<div style="color:#c0392b">{_text(warning)}</div>')
    parts.append(_gap_rows(summary))
    parts.append(_building_rows(summary))
    if not result._rows:
        return f'<div style="{_FONT}">{"".join(parts)}</div>'
    struck = sorted(
        (contact for contact in result.contacts if contact.impact_count),
        key=lambda contact: -contact.peak_force,
    )[:4]
    time = result.time
    if struck:
        curves = [(contact_name(c), time, 1e-3 * c.force) for c in struck]
        parts.append(history_svg("Contact force", "kN", curves))
    if len(time) > 1:
        animation = result.animate()
        parts.append(frame(animation._page, 720))
    return f'<div style="{_FONT}">{"".join(parts)}</div>'


def _gap_rows(summary: dict[str, Any]) -> str:
    rows = []
    for gap in summary["gaps"]:
        closing = max((c["closing_peak_m"] for c in gap["contacts"]), default=0.0)
        first = gap["first_impact_s"]
        rows.append(
            (
                "–".join(gap["between"]),
                f"{1e3 * gap['width_m']:.5g}",
                gap["law"],
                f"{gap['impact_count']}",
                f"{1e-3 * gap['peak_force_n']:.1f}",
                f"{1e3 * closing:.1f}",
                "" if first is None else f"{first:.3f}",
            )
        )
    heads = ("gap", "width [mm]", "law", "impacts", "peak force [kN]", "closing [mm]", "first [s]")
    return _rows(heads, rows)


def _building_rows(summary: dict[str, Any]) -> str:
    rows = []
    for building in summary["buildings"]:
        roof = building["floors"][-1]
        peak = max(roof["displacement_max_m"], -roof["displacement_min_m"])
        drift = max(floor["storey_drift_peak"] for floor in building["floors"])
        acceleration = max(f["total_acceleration_peak_m_s2"] for f in building["floors"])
        rows.append(
            (
                building["name"],
                f"{1e3 * peak:.1f}",
                f"{100 * drift:.3f}",
                f"{acceleration:.2f}",
                f"{1e-3 * building['base_shear_peak_n']:.1f}",
            )
        )
    heads = ("building", "roof [mm]", "drift [%]", "acceleration [m/s²]", "base shear [kN]")
    return _rows(heads, rows)


def modes_html(modes: BuildingModes) -> str:
    """Periods, masses and shapes."""
    in_space = bool((modes.effective_mass_ratios_torsion > 0).any())
    names = ("x", "across", "torsion") if in_space else ("x", "y")
    shares = [getattr(modes, f"effective_mass_ratios_{name}") for name in names]
    rows = []
    for index in range(len(modes)):
        shape = " ".join(f"{value:+.2f}" for value in modes.floor_shapes[index])
        rows.append(
            (
                f"{index + 1}",
                f"{modes.periods[index]:.4f}",
                *(f"{100 * share[index]:.2f}" for share in shares),
                shape if modes.lateral[index] else "",
            )
        )
    heads = ("mode", "period [s]", *(f"mass {name} [%]" for name in names), "floors from the ground up")
    return f'<div style="{_FONT}"><b>{_text(modes.name)}</b>{_rows(heads, rows)}</div>'


def table_html(table: Table) -> str:
    """The first rows of a table."""
    shown = [table[index] for index in range(min(len(table), _SHOWN))]
    rows = [[_cell(value) for value in row.values()] for row in shown]
    more = len(table) - len(shown)
    tail = f'<div style="opacity:.75">… {more} more rows</div>' if more > 0 else ""
    body = _rows(table.columns, rows)
    return f'<div style="{_FONT};overflow-x:auto">{body}{tail}</div>'


def _cell(value: object) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _rows(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    body = "".join(
        "<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    if not body:
        return ""
    head = "".join(f"<th>{_text(cell)}</th>" for cell in heads)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _svg_text(
    x: float, y: float, text: str, anchor: str, size: int, opacity: float = 1.0
) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" '
        f'fill="currentColor" opacity="{opacity}">{_text(text)}</text>'
    )


def _text(value: object) -> str:
    return html.escape(str(value))


def _framed(title: str, *parts: str) -> str:
    """A title above tables and pictures."""
    return f'<div style="{_FONT};overflow-x:auto"><b>{_text(title)}</b>{"".join(parts)}</div>'


def text_html(text: str) -> str:
    """Text as printed on a terminal."""
    return f'<pre style="overflow-x:auto">{_text(text)}</pre>'


def gap_html(gap: CriticalGap) -> str:
    """The smallest gap beside those of rules, and force over gap."""
    import numpy as np

    rows = [("gap needed", f"{1e3 * gap.gap:.2f}", "0", "")]
    if gap.reversed_gap is not None:
        rows.append(("the same, motion reversed", f"{1e3 * gap.reversed_gap:.2f}", "", ""))
    for rule in gap.rules:
        count = "" if rule.impact_count is None else f"{rule.impact_count}"
        force = "" if rule.peak_force is None else f"{1e-3 * rule.peak_force:.1f}"
        rows.append((rule.rule, f"{1e3 * rule.gap:.2f}", count, force))
    table = _rows(("rule", "gap [mm]", "impacts", "peak force [kN]"), rows)
    if gap.curve:
        widths = 1e3 * np.array([point.width for point in gap.curve])
        forces = 1e-3 * np.array([point.peak_force for point in gap.curve])
        picture = history_svg("Peak force over gap", "kN", [("force", widths, forces)], abscissa=" mm")
    else:
        picture = bars_svg("Gap", "mm", [(row[0], float(row[1])) for row in rows])
    return _framed(f"{'–'.join(gap.between)} under {gap.motion}, {gap.pga:.4g} m/s²", table, picture)


def suite_html(suite: Suite) -> str:
    """Every record, its greatest force and drift, and the governing values."""
    tree = suite.summary
    shown = [own for own in tree["quantities"] if own["name"].endswith((".peak_force_n", ".drift_peak"))][:6]
    heads = ("record", *(own["name"] for own in shown))
    rows = [
        (name, *("" if own["values"][at] is None else f"{own['values'][at]:.4g}" for own in shown))
        for at, name in enumerate(suite.records)
    ]
    rows += [("governing", *(f"{own['governing']:.4g}" for own in shown))]
    picture = ""
    if shown:
        values = [(name, own) for name, own in zip(suite.records, shown[0]["values"]) if own is not None]
        picture = bars_svg(shown[0]["name"], "SI", values)
    return _framed(tree["title"], f"<div>{_text(suite.rule)}</div>", _rows(heads, rows), picture)


def study_html(study: Study) -> str:
    """What varies."""
    rows = [(text,) for text in study.varied]
    return _framed(f"{study.title}: {study.cases} cases", _rows(("varied",), rows))


def study_result_html(result: StudyResult) -> str:
    """The first cases, and peak force case by case."""
    import numpy as np

    study = result.study
    if not result.complete:
        return _framed(f"{study.title}: {study.cases} cases, not all finished", _text(os.fspath(result.folder)))
    inputs = [name for name in study.columns if name in _columns_shown(study.columns)]
    columns = {name: result[name] for name in inputs}
    rows = [[_cell(_item(values[at])) for values in columns.values()] for at in range(min(study.cases, _SHOWN))]
    more = study.cases - len(rows)
    tail = f'<div style="opacity:.75">… {more} more cases</div>' if more > 0 else ""
    picture = ""
    if "peak_force_n" in study.columns:
        forces = 1e-3 * np.nan_to_num(result["peak_force_n"])
        cases = np.arange(len(forces), dtype=float)
        picture = history_svg("Peak force", "kN", [("Peak force", cases, forces)], abscissa="")
    return _framed(f"{study.title}: {study.cases} cases", _rows(inputs, rows), tail, picture)


def _columns_shown(names: Sequence[str]) -> set[str]:
    """The inputs, which come first, and the greatest answers."""
    end = names.index("status") if "status" in names else 3
    return {*names[1 : max(end, 2)][:6], "impact_count", "peak_force_n"}


def _item(value: Any) -> object:
    return value.item() if hasattr(value, "item") else value


def spectrum_html(spectrum: Spectrum) -> str:
    """Pseudo-acceleration and displacement over the period."""
    labels = [f"{100 * damping:.3g} %" for damping in spectrum.damping]
    kinds = (("Pseudo-acceleration", "m/s²", spectrum.pseudo_acceleration), ("Displacement", "m", spectrum.displacement))
    pictures = (
        history_svg(title, unit, [(label, spectrum.periods, row) for label, row in zip(labels, rows)])
        for title, unit, rows in kinds
        if len(spectrum.periods)
    )
    rows = []
    for label, periods, values in zip(labels, [spectrum.periods] * len(labels), spectrum.pseudo_acceleration):
        at = int(values.argmax()) if len(values) else 0
        if len(values):
            rows.append((label, f"{values[at]:.4g}", f"{periods[at]:.4g}"))
    return _framed("Response spectra", _rows(("damping", "greatest [m/s²]", "at period [s]"), rows), *pictures)


def comparison_html(comparison: Comparison) -> str:
    """Scores of all histories."""
    rows = []
    for column in comparison.summary["columns"]:
        score = column["score"]
        rows.append((column["computed"], column["measured"], *(_cell(value) for value in score.values())))
    keys = list(comparison.summary["columns"][0]["score"]) if rows else []
    heads = ("computed", "measured", *(key.replace("_", " ") for key in keys))
    return _framed(comparison.summary["title"], _rows(heads, rows))


def advice_html(advice: ContactAdvice) -> str:
    """Estimates of stiffness, and the recommended values."""
    rows = [
        (own.name, own.family, f"{own.stiffness:.3e}", f"{1e-3 * own.peak_force:.1f}", f"{1e3 * own.duration:.2f}")
        for own in advice.estimates
    ]
    heads = ("estimate", "family", "stiffness [N/m^1.5, N/m]", "peak force [kN]", "duration [ms]")
    known = [("hertz [N/m^1.5]", advice.hertz), ("linear [N/m]", advice.linear), ("restitution", advice.restitution)]
    wanted = [(name, f"{r.value:.3g}", f"{r.low:.3g}", f"{r.high:.3g}") for name, r in known if r is not None]
    picture = bars_svg("Peak force", "kN", [(own.name, 1e-3 * own.peak_force) for own in advice.estimates])
    notes = "".join(f'<div style="opacity:.75">{_text(note)}</div>' for note in advice.notes)
    title = "–".join(advice.between)
    return _framed(title, _rows(("recommended", "value", "low", "high"), wanted), _rows(heads, rows), picture, notes)


def selection_html(selection: Selection) -> str:
    """Rules and motions."""
    rules = [("yes" if own["met"] else "no", own["found"], own["asked"], own["clause"]) for own in selection.rules]
    rows = [(own["name"], f"{own['pga_m_s2']:.4g}", *(f"{r:.3f}" for r in own["ratios"])) for own in selection.motions]
    heads = ("motion", "peak [m/s²]", *(f"÷ code at {period:g} s" for period in selection.tree["periods_s"]))
    picture = bars_svg("Base shear ÷ code", "–", [(own["name"], own["base_shear_ratio"]) for own in selection.motions])
    title = selection.tree["code"] + (": met" if selection.passes else ": not met")
    return _framed(title, _rows(("met", "found", "asked", "clause"), rules), _rows(heads, rows), picture)


def section_html(answer: SectionAnswer) -> str:
    """Cracking and yield, and moment over curvature."""
    import numpy as np

    rows: list[tuple[str, ...]] = []
    curves: list[Curve] = []
    for at, own in enumerate(answer.tree):
        for kind in ("formula", "fibre"):
            side = own[kind].get("positive")
            if side is not None:
                moments = (side["cracking_moment_nm"], side["yield_moment_nm"])
                turns = (side["cracking_rotation_rad"], side["yield_rotation_rad"])
                numbers = (f"{1e-3 * moments[0]:.1f}", f"{1e3 * turns[0]:.3f}", f"{1e-3 * moments[1]:.1f}", f"{1e3 * turns[1]:.3f}")
                rows.append((own["name"], kind, *numbers))
        if "error" not in own["fibre"] and len(curves) < 4:
            curvature, moment = answer.curve(at)
            curves.append((own["name"], np.asarray(curvature), 1e-3 * moment))
    heads = ("section", "by", "cracks [kN.m]", "[mrad]", "yields [kN.m]", "[mrad]")
    picture = history_svg("Moment over curvature", "kN.m", curves, abscissa=" 1/m") if curves else ""
    return _framed("Sections", _rows(heads, rows), picture)


def size_html(answer: SizeAnswer) -> str:
    """The best trial, and the objective trial by trial."""
    import numpy as np

    tree = answer.summary
    best = tree["best"]
    rows = [] if best is None else [(own["key"], own["text"]) for own in best["inputs"]]
    found = "no trial keeps the conditions" if best is None else f"{best['objective']:.6g}"
    rows.append((f"least {tree['minimise']}", found))
    rows += [("keeps", condition) for condition in tree["keep"]]
    front = [own for own in tree["trade_off"] if len(own["points"]) > 1]
    picture = ""
    if front:
        points = np.array(front[0]["points"], dtype=float)
        order = np.argsort(points[:, 0])
        curve = (tree["minimise"], points[order, 0] - min(0.0, points[:, 0].min()), points[order, 1])
        picture = history_svg(f"{tree['minimise']} against {front[0]['keep']}", "SI", [curve], abscissa="")
    return _framed(tree["title"], _rows(("", "value"), rows), picture)


def check_html(check: Check) -> str:
    """Findings, warnings and the text."""
    rows = [(own["grade"], own["where"], own["text"], own["remedy"]) for own in check.findings]
    rows += [("warning", "", text, "") for text in check.warnings] + [("note", "", text, "") for text in check.notes]
    site = check.site or ""
    return _framed("Check", _rows(("grade", "where", "text", "remedy"), rows), site, text_html(str(check)))


def bars_svg(title: str, unit: str, values: Sequence[tuple[str, float]]) -> str:
    """Named values as horizontal bars."""
    if not values:
        return ""
    most = max((value for _, value in values), default=0.0) or 1.0
    left, width, step = 240, 760, 18
    parts = [_svg_text(left, 14, f"{title} [{unit}]", "start", 12)]
    for at, (name, value) in enumerate(values):
        y = 26 + at * step
        length = max(0.0, (width - left - 80) * value / most)
        parts.append(f'<rect x="{left}" y="{y}" width="{length:.1f}" height="11" fill="{colour(at)}"/>')
        parts.append(_svg_text(left - 8, y + 10, name[:38], "end", 11, 0.85))
        parts.append(_svg_text(left + length + 6, y + 10, f"{value:.4g}", "start", 11, 0.85))
    height = 34 + len(values) * step
    return (
        f'<svg viewBox="0 0 {width} {height}" width="{width}" role="img" '
        f'style="max-width:100%;display:block;{_FONT}">{"".join(parts)}</svg>'
    )
