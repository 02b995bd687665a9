"""Peak-oriented and kinematic springs in OpenSees, through random histories.

Writes opensees.json, which the tests read; run again with `pip install openseespy==3.7.1.2`.
OpenSees' Hysteretic material is stepped finely, since it does not look for corners inside a step.
"""
import json
import random

import openseespy.opensees as ops

STEPS = 4000  # per leg of the history


def history(seed, legs, largest):
    draw = random.Random(seed)
    return [round(draw.uniform(-largest, largest), 4) for _ in range(legs)]


def follow(define, path):
    ops.wipe()
    define()
    ops.testUniaxialMaterial(1)
    forces, here = [], 0.0
    for target in path:
        for step in range(1, STEPS + 1):
            ops.setStrain(here + (target - here) * step / STEPS)
        here = target
        forces.append(ops.getStress())
    return forces


def hysteretic(positive, negative):
    (c1, f1), (c2, f2), (c3, f3) = positive
    (n1, g1), (n2, g2), (n3, g3) = negative
    ops.uniaxialMaterial("Hysteretic", 1, f1, c1, f2, c2, f3, c3, -g1, -n1, -g2, -n2, -g3, -n3, 1.0, 1.0, 0.0, 0.0, 0.0)


def iwan(k1, crack, yield_, k3, crack_n, yield_n):
    k2 = (yield_[1] - crack[1]) / (yield_[0] - crack[0])
    ops.uniaxialMaterial("Elastic", 2, k3)
    ops.uniaxialMaterial("ElasticPP", 3, k1 - k2, crack[0], -crack_n)
    ops.uniaxialMaterial("ElasticPP", 4, k2 - k3, yield_[0], -yield_n)
    ops.uniaxialMaterial("Parallel", 1, 2, 3, 4)


def curve(cracking, yielding, k1, r2, r3, far=1000.0):
    f1 = k1 * cracking
    f2 = f1 + r2 * k1 * (yielding - cracking)
    return [(cracking, f1), (yielding, f2), (far, f2 + r3 * k1 * (far - yielding))]


cases = []
for seed, (positive, negative) in enumerate([((1.0, 4.0, 1 / 3, 0.05), (1.0, 4.0, 1 / 3, 0.05)), ((1.0, 4.0, 0.3, 0.02), (0.6, 5.0, 0.2, 0.0)), ((0.5, 3.0, 0.5, 0.1), (1.5, 2.5, 0.4, 0.01))]):
    path = history(seed, 60, 9.0)
    side = lambda s: curve(s[0], s[1], 100.0, s[2], s[3])
    cases.append({"rule": "peak-oriented", "initial": 100.0, "positive": positive, "negative": negative, "deformation": path,
                  "force": follow(lambda: hysteretic(side(positive), side(negative)), path)})
for seed, (crack_n, yield_n) in enumerate([(1.0, 4.0), (0.7, 6.0)], start=10):
    path = history(seed, 60, 9.0)
    force = 100.0 + 30.0 * 3.0
    cases.append({"rule": "normal", "initial": 100.0, "positive": (1.0, 4.0, 0.3, 0.05), "negative": (crack_n, yield_n, 0.3, 0.05), "deformation": path,
                  "force": follow(lambda: iwan(100.0, (1.0, 100.0), (4.0, force), 5.0, crack_n, yield_n), path)})

note = {"made_with": "OpenSees " + ops.version() + ", opensees.py beside this file", "sides": "cracking and yield deformation, post-cracking and post-yield ratio"}
with open("opensees.json", "w") as file:
    json.dump({"note": note, "cases": cases}, file, indent=1)
