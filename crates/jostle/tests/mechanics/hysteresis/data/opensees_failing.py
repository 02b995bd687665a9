"""A column that fails in shear, pushed to and fro in OpenSees: elastic beam, and in series at its foot LimitState.

Writes opensees_failing.json, which the tests read; run again with `pip install openseespy==3.7.1.2`. The beam keeps its
ends from turning, 12 EI/L^3. The backbone of LimitState holds the falling branch; pinching 1, 1, no damage, and degrade = 1:
peaks of one direction count in the other. Its limit curve, which the material needs for that, is far away. `slope` is that
of column and spring together: 1/k = 1/k_column + 1/k_spring. LimitState does not look for corners inside a step: each
quarter of a leg is stepped finely. The deformation is that of column and spring, the force the shear of the column.
"""
import json
import random

import openseespy.opensees as ops

STEPS = 4000  # per quarter of a leg
FAR = 1e12


def follow(case):
    length, rigidity, spring = case["length"], case["rigidity"], case["spring"]
    column = 12 * rigidity / length**3
    strength, residual = case["strength"], case["residual"]
    falling = 1 / (1 / case["slope"] + 1 / column)
    failure, end = strength / spring, strength / spring + (strength - residual) / falling
    middle = ((failure + end) / 2, (strength + residual) / 2)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node, y in [(1, 0.0), (2, 0.0), (3, length)]:
        ops.node(node, 0.0, y)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 1, 1)
    ops.fix(3, 0, 0, 1)
    ops.geomTransf("Linear", 1)
    ops.element("elasticBeamColumn", 1, 2, 3, 1.0, 1e12, rigidity / 1e12, 1)
    ops.limitCurve("ThreePoint", 1, 1, 0.0, FAR, 2.0, FAR, 3.0, FAR, -falling, residual, 2, 0, 1, 3, 1, 2)
    points = [(strength, failure), (middle[1], middle[0]), (residual, end)]
    backbone = [sign * value for sign in (1, -1) for point in points for value in point]
    ops.uniaxialMaterial("LimitState", 1, *backbone, 1.0, 1.0, 0.0, 0.0, 0.0, 1, 2, 1)
    ops.element("zeroLength", 2, 1, 2, "-mat", 1, "-dir", 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.sp(3, 1, 1.0)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-6, 50)
    ops.algorithm("Newton")
    forces, here = [], 0.0
    for target in case["deformation"]:
        start = here
        for quarter in range(1, 5):
            goal = start + (target - start) * quarter / 4
            ops.integrator("LoadControl", (goal - here) / STEPS)
            ops.analysis("Static")
            if ops.analyze(STEPS) != 0:
                raise SystemExit(f"{case['name']} does not converge on the way to {target}")
            here = ops.nodeDisp(3, 1)
            assert abs(here - goal) < 1e-12, (here, goal)
            forces.append(-ops.eleForce(2)[0])
    return forces


def draw(seed, legs, largest):
    source = random.Random(seed)
    return [round(source.uniform(-largest, largest), 5) for _ in range(legs)]


COLUMN = {"length": 3.2, "rigidity": 1.5625e8, "spring": 5e8, "strength": 4e5, "slope": 6e6, "residual": 8e4}
GROWING = [sign * 1e-3 * size for size in (5, 9, 20, 20, 40, 40, 60, 80, 80, 50) for sign in (1, -1)]
ONE_SIDED = [0.03, 0.02, 0.04, 0.025, 0.05, -0.005, 0.06, 0.0, 0.09, -0.09]
INNER = [0.03, -0.03, 0.01, -0.01, 0.02, 0.0, 0.025, 0.022, 0.029, -0.02, -0.017, -0.03, -0.035, 0.003, 0.05, 0.047, 0.052]
cases = [
    {"name": "growing", **COLUMN, "deformation": GROWING},
    {"name": "one-sided", **COLUMN, "deformation": ONE_SIDED},
    {"name": "inner cycles", **COLUMN, "deformation": INNER},
    {"name": "random", **COLUMN, "deformation": draw(1, 40, 0.09)},
    {"name": "steep, soft spring", **COLUMN, "spring": 8e7, "slope": 3e7, "deformation": draw(2, 40, 0.04)},
]
for case in cases:
    case["force"] = follow(case)

note = {
    "made_with": "OpenSees " + ops.version() + ", opensees_failing.py beside this file",
    "deformation": "of column and spring, at the ends of legs [m]",
    "force": "shear of the column at each quarter of each leg [N]",
}
with open("opensees_failing.json", "w") as file:
    json.dump({"note": note, "cases": cases}, file, indent=1)
