"""A two-storey building in plan whose walls yield, stepped by OpenSees; writes yielding_in_plan.json.

    python yielding_in_plan.py        # needs openseespy 3.7.1.2

Floors are nodes of a plane model seen from above: x and y are the site, the rotation is about the vertical axis. Every wall is a
zeroLength element with Steel01 between two nodes at its point, tied to the floors by rigidLink. This script does not come from
jostle's exporter.
"""

import json
import math

import openseespy.opensees as ops

G = 9.80665
MASS, SIDES = [240e3, 200e3], [16.0, 10.0]
CENTRE = [8.0, 5.0]
# Place, stiffness along x and across [N/m], yield displacements [m], and the ratio after yield.
WALLS = [
    ([2.0, 1.5], [90e6, 40e6], [6e-3, 8e-3], 0.04),
    ([14.0, 8.0], [45e6, 110e6], [9e-3, 5e-3], 0.03),
    ([5.0, 9.0], [60e6, 30e6], [7e-3, 1e-2], 0.05),
]
ALPHA = 0.5
DURATION = 8.0
AMPLITUDES, PERIODS, DURATIONS = [0.35 * G, 0.25 * G], [0.61, 0.43], [8.0, 8.0]


def run(step):
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ground, floors = [1], [2, 3]
    ops.node(1, *CENTRE)
    ops.fix(1, 1, 1, 1)
    for floor, mass in zip(floors, MASS):
        ops.node(floor, *CENTRE)
        polar = mass * (SIDES[0] ** 2 + SIDES[1] ** 2) / 12
        ops.mass(floor, mass, mass, polar)
    tag, walls = 10, []
    for storey, (lower, upper) in enumerate([(1, 2), (2, 3)]):
        for place, stiffness, yields, ratio in WALLS:
            ends = []
            for node in (lower, upper):
                ops.node(tag, *place)
                if node == 1:
                    ops.fix(tag, 1, 1, 1)
                else:
                    ops.rigidLink("beam", node, tag)
                ends.append(tag)
                tag += 1
            materials = []
            for k, u in zip(stiffness, yields):
                ops.uniaxialMaterial("Steel01", tag, k * u, k, ratio)
                materials.append(tag)
                tag += 1
            ops.element("zeroLength", tag, *ends, "-mat", *materials, "-dir", 1, 2)
            walls.append(tag)
            tag += 1
    ops.rayleigh(ALPHA, 0.0, 0.0, 0.0)
    steps = round(DURATION / step)
    for direction, (amplitude, period) in enumerate(zip(AMPLITUDES, PERIODS), start=1):
        values = [amplitude * math.sin(2 * math.pi * k * step / period) for k in range(steps + 2)]
        ops.timeSeries("Path", direction, "-dt", step, "-values", *values)
        ops.pattern("UniformExcitation", direction, direction, "-accel", direction)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-6, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    greatest = [[0.0] * 3 for _ in floors]
    least = [[0.0] * 3 for _ in floors]
    forces = [[0.0] * 2 for _ in walls]
    torque, base = 0.0, [0.0, 0.0]
    for _ in range(steps):
        if ops.analyze(1, step):
            raise SystemExit("no convergence")
        for index, floor in enumerate(floors):
            for component in range(3):
                u = ops.nodeDisp(floor, component + 1)
                greatest[index][component] = max(greatest[index][component], u)
                least[index][component] = min(least[index][component], u)
        now = []
        for index, wall in enumerate(walls):
            own = ops.eleResponse(wall, "material", 1, "stress") + ops.eleResponse(wall, "material", 2, "stress")
            now.append(own)
            forces[index] = [max(a, abs(b)) for a, b in zip(forces[index], own)]
        sums = [sum(own[axis] for own in now[: len(WALLS)]) for axis in range(2)]
        base = [max(a, abs(b)) for a, b in zip(base, sums)]
        moment = sum(
            (place[0] - CENTRE[0]) * own[1] - (place[1] - CENTRE[1]) * own[0]
            for (place, *_), own in zip(WALLS, now)
        )
        torque = max(torque, abs(moment))
    return {
        "displacement_max": greatest,
        "displacement_min": least,
        "wall_forces_peak_n": forces,
        "base_shear_peak_n": base,
        "base_torque_peak_n_m": torque,
    }


def main():
    step = 5e-4
    fine, coarse = run(step), run(2 * step)
    flat = lambda value: sum(map(flat, value), []) if isinstance(value, list) else [value]
    change = 0.0
    for key in fine:
        a, b = flat(fine[key]), flat(coarse[key])
        change = max(change, max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, a)))
    result = {
        "source": "openseespy 3.7.1.2 by yielding_in_plan.py: Newmark average acceleration, Newton, Steel01 at plan points",
        "step_s": step,
        "change_when_halved": change,
        **fine,
    }
    with open("yielding_in_plan.json", "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
    print(change, fine["displacement_max"], fine["base_torque_peak_n_m"])


main()
