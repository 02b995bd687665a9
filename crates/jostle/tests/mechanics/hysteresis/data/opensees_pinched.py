"""Pinched springs in OpenSees: material Hysteretic, through growing, one-sided, inner and random cycles.

Writes opensees_pinched.json, which the tests read; run again with `pip install openseespy==3.7.1.2`.
Hysteretic does not look for corners inside a step: each quarter of a leg is stepped finely, and a step that would
pass zero force stops there. `energy` is damage per energy of loading both sides to yield; OpenSees divides by the
area of the whole backbone, so its parameter is larger by the ratio of the two.
"""
import json
import random

import openseespy.opensees as ops

STEPS = 5000  # per quarter of a leg
FAR = 1000.0


def curve(cracking, yielding, k1, r2, r3):
    f1 = k1 * cracking
    if cracking == yielding:  # two points on the last line
        return [(cracking, f1), (2 * cracking, f1 + r3 * k1 * cracking), (FAR, f1 + r3 * k1 * (FAR - cracking))]
    f2 = f1 + r2 * k1 * (yielding - cracking)
    return [(cracking, f1), (yielding, f2), (FAR, f2 + r3 * k1 * (FAR - yielding))]


def area(points):
    points = [(0.0, 0.0), *points]
    return sum(0.5 * (d - c) * (f + g) for (c, f), (d, g) in zip(points, points[1:]))


def to_yield(points, side):
    return area(points[: 1 if side[0] == side[1] else 2])


def follow(case):
    sides = [case["positive"], case["negative"]]
    curves = [curve(s[0], s[1], case["initial"], s[2], s[3]) for s in sides]
    ratio = sum(map(area, curves)) / sum(to_yield(c, s) for c, s in zip(curves, sides))
    backbone = [value for sign, points in zip((1.0, -1.0), curves) for d, f in points for value in (sign * f, sign * d)]
    rule = case["pinched"]
    ops.wipe()
    ops.uniaxialMaterial("Hysteretic", 1, *backbone, rule["deformation"], rule["force"], rule["ductility"],
                         rule["energy"] * ratio, rule["exponent"])
    ops.testUniaxialMaterial(1)
    forces, here = [], 0.0
    for target in case["deformation"]:
        start = here
        for quarter in range(1, 5):
            begin, end = here, start + (target - start) * quarter / 4
            for step in range(1, STEPS + 1):
                goal = begin + (end - begin) * step / STEPS
                stress, tangent = ops.getStress(), ops.getTangent()
                after = stress + tangent * (goal - here)
                if step > 1 and stress * (goal - here) < 0.0 and stress * after < 0.0:
                    ops.setStrain(here - stress / tangent)
                ops.setStrain(goal)
                here = goal
            forces.append(ops.getStress())
    return forces


def draw(seed, legs, largest):
    source = random.Random(seed)
    return [round(source.uniform(-largest, largest), 4) for _ in range(legs)]


def crossing(seed, legs, largest):
    """Random legs from side to side, long enough to pass zero force every time."""
    source = random.Random(seed)
    return [round((-1) ** n * source.uniform(1.2, largest), 4) for n in range(legs)]


EQUAL = (1.0, 4.0, 1 / 3, 0.05)
GROWING = [sign * amplitude for amplitude in (0.7, 1.5, 2.5, 4.0, 4.0, 6.0, 6.0, 8.0, 3.0) for sign in (1, -1)]
ONE_SIDED = [3.0, 0.5, 5.0, 1.0, 7.0, -0.5, 7.0, -1.5, 8.0, 2.0, 9.0, -4.0, 6.0, -6.0]
INNER = [5.0, -5.0, 1.0, -1.0, 2.0, 0.0, 3.0, 2.5, 3.5, -2.0, -1.7, -3.0, -2.5, -4.0, 0.3, -0.3, 0.2, -0.1, 6.0, 5.7, 6.3, -6.0, -5.0, -7.0]
WOOD = {"deformation": 0.8, "force": 0.2, "exponent": 0.0, "ductility": 0.0, "energy": 0.0}

cases = [
    {"name": "growing", "positive": EQUAL, "negative": EQUAL, "deformation": GROWING, "pinched": WOOD},
    {"name": "one-sided, different sides", "positive": (1.0, 4.0, 0.3, 0.02), "negative": (0.6, 5.0, 0.2, 0.0), "deformation": ONE_SIDED, "pinched": WOOD},
    {"name": "inner cycles", "positive": EQUAL, "negative": EQUAL, "deformation": INNER, "pinched": {**WOOD, "deformation": 0.5, "force": 0.3}},
    {"name": "random", "positive": (1.0, 4.0, 0.3, 0.02), "negative": (0.6, 5.0, 0.2, 0.0), "deformation": draw(1, 60, 9.0), "pinched": {**WOOD, "deformation": 0.3, "force": 0.5}},
    {"name": "random, bilinear", "positive": (1.0, 1.0, 1.0, 0.03), "negative": (1.5, 1.5, 1.0, 0.0), "deformation": draw(2, 60, 9.0), "pinched": WOOD},
    {"name": "random, exponent", "positive": (1.0, 1.0, 1.0, 0.03), "negative": (1.5, 1.5, 1.0, 0.0), "deformation": draw(3, 60, 9.0), "pinched": {**WOOD, "exponent": 0.5}},
    {"name": "random, exponent, trilinear", "positive": EQUAL, "negative": (0.5, 3.0, 0.4, 0.01), "deformation": draw(4, 60, 9.0), "pinched": {**WOOD, "exponent": 0.2, "deformation": 0.4}},
    {"name": "growing, damage by ductility", "positive": EQUAL, "negative": EQUAL, "deformation": GROWING[2:], "pinched": {**WOOD, "ductility": 0.03}},
    {"name": "growing, damage by energy", "positive": EQUAL, "negative": EQUAL, "deformation": GROWING[2:], "pinched": {**WOOD, "energy": 0.02}},
    {"name": "crossing, both, exponent", "positive": (1.0, 4.0, 0.3, 0.02), "negative": (0.6, 5.0, 0.2, 0.0), "deformation": crossing(5, 40, 8.0), "pinched": {**WOOD, "exponent": 0.3, "ductility": 0.005, "energy": 0.004}},
    {"name": "flat slip", "positive": (1.0, 1.0, 1.0, 0.05), "negative": (1.0, 1.0, 1.0, 0.05), "deformation": draw(6, 40, 8.0), "pinched": {**WOOD, "deformation": 0.6, "force": 0.0}},
]
for case in cases:
    case["initial"] = 100.0
    case["force"] = follow(case)

note = {
    "made_with": "OpenSees " + ops.version() + ", opensees_pinched.py beside this file",
    "sides": "cracking and yield deformation, post-cracking and post-yield ratio",
    "force": "at each quarter of each leg",
}
with open("opensees_pinched.json", "w") as file:
    json.dump({"note": note, "cases": cases}, file, indent=1)
