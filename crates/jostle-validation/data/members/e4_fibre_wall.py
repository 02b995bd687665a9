"""Writes e4_fibre_wall.json: a wall whose foot is a section of fibres, pushed over under a constant axial force.

Sums over 4000 slices of concrete and the bars, and a bisection for the elongation at every rotation; nothing of jostle is used.
The wall above its foot is a cantilever: u = theta h + M h^2 / 3EI, V = M / h.
"""

import json
import math
from pathlib import Path

WALL = {
    "height_m": 6.0,
    "length_m": 4.0,
    "thickness_m": 0.3,
    "hinge_length_m": 1.0,
    "concrete": {"fc": 30e6, "ec0": 0.002, "ecu": 0.02, "residual": 0.2},
    "steel": {"fy": 400e6, "Es": 2e11, "b": 0.01},
    "edges": {"bars": 6, "diameter_m": 0.02, "length_m": 0.6},
    "web": {"bars": 16, "diameter_m": 0.01},
    "cover_m": 0.035,
    "E": 30e9,
    "floor_mass_kg": 100e3,
    "floor_load_n": 2e6,
    "g": 9.80665,
}
SLICES = 4000


def bars():
    """Places and areas: the bars of an edge stand around a rectangle, those of the web in pairs."""
    edges, web = WALL["edges"], WALL["web"]
    area = math.pi / 4 * edges["diameter_m"] ** 2
    first = WALL["cover_m"] + edges["diameter_m"] / 2
    last = edges["length_m"] - first
    rows = [first, (first + last) / 2, last]
    half = WALL["length_m"] / 2
    found = [(side * (half - row), 2 * area) for side in (-1, 1) for row in rows]
    pairs = web["bars"] // 2
    between = WALL["length_m"] - 2 * edges["length_m"]
    area = math.pi / 4 * web["diameter_m"] ** 2
    found += [(between * (k + 0.5) / pairs - between / 2, 2 * area) for k in range(pairs)]
    return found


def envelope(strain):
    """Kent and Park, positive in compression."""
    law = WALL["concrete"]
    if strain <= 0:
        return 0.0
    ratio = strain / law["ec0"]
    if ratio <= 1:
        return law["fc"] * ratio * (2 - ratio)
    fallen = min((strain - law["ec0"]) / (law["ecu"] - law["ec0"]), 1.0)
    return law["fc"] * (1 - (1 - law["residual"]) * fallen)


def concrete(strain, greatest):
    """Karsan and Jirsa below the greatest strain so far."""
    if strain >= greatest or greatest <= 0:
        return envelope(strain)
    law = WALL["concrete"]
    ratio = greatest / law["ec0"]
    plastic = 0.145 * ratio**2 + 0.13 * ratio if ratio < 2 else 0.707 * (ratio - 2) + 0.834
    slope = min(envelope(greatest) / (greatest - plastic * law["ec0"]), 2 * law["fc"] / law["ec0"])
    return max(envelope(greatest) - slope * (greatest - strain), 0.0)


def steel(strain):
    law = WALL["steel"]
    yields = law["fy"] / law["Es"]
    beyond = max(abs(strain) - yields, 0.0)
    return math.copysign(law["Es"] * (min(abs(strain), yields) + law["b"] * beyond), strain)


def main():
    slices = [WALL["length_m"] * ((k + 0.5) / SLICES - 0.5) for k in range(SLICES)]
    area = WALL["length_m"] * WALL["thickness_m"] / SLICES
    laid = bars()
    weight = WALL["floor_load_n"] + WALL["floor_mass_kg"] * WALL["g"]
    inertia = WALL["thickness_m"] * WALL["length_m"] ** 3 / 12
    height, over = WALL["height_m"], WALL["hinge_length_m"]
    greatest = [0.0] * SLICES

    def forces(elongation, rotation):
        axial = moment = 0.0
        for place, most in zip(slices, greatest):
            force = -concrete(-(elongation + place * rotation) / over, most) * area
            axial += force
            moment += force * place
        for place, steel_area in laid:
            force = steel((elongation + place * rotation) / over) * steel_area
            axial += force
            moment += force * place
        return axial, moment

    points = []
    low, high = -2e-3, 2e-3
    count = 240
    for step in range(count + 1):
        rotation = 1.02e-2 * (step / count) ** 2
        low, high = low - 1e-3, high + 2e-3
        for _ in range(40):
            middle = (low + high) / 2
            if forces(middle, rotation)[0] < -weight:
                low = middle
            else:
                high = middle
        moment = forces(low, rotation)[1]
        greatest[:] = [
            max(most, -(low + place * rotation) / over) for most, place in zip(greatest, slices)
        ]
        if step % 20 == 0 and step > 0:
            roof = rotation * height + moment * height**2 / (3 * WALL["E"] * inertia)
            points.append(
                {"roof_m": float(f"{roof:.8g}"), "V_n": float(f"{moment / height:.8g}")}
            )
    case = {
        "case": "e4_fibre_wall",
        "description": "A wall with edges and a web whose foot is a section of fibres, pushed over under its weight.",
        "convention": "SI. Concrete: Kent, Scott and Park with the unloading of Karsan and Jirsa, no tension, unconfined; bars bilinear. Bars displace no concrete. Strains are constant over the hinge length; the wall above is elastic over its whole height and rigid in shear.",
        "provenance": "e4_fibre_wall.py, which sums over 4000 slices and finds the elongation by bisection",
        "input": WALL,
        "static": {"points": points},
    }
    target = Path(__file__).with_suffix(".json")
    target.write_text(json.dumps(case, indent=1) + "\n")


main()
