"""A two-storey space frame with hinges at its member ends, stepped by OpenSees; writes yielding_space_frame.json.

    python yielding_space_frame.py        # needs openseespy 3.7.1.2

Columns and beams are elasticBeamColumn elements between nodes of their own. Floors are rigid diaphragms for these nodes and for the
joints. Hinges are zeroLength elements with Steel01 between both; elastic springs, which are STIFF, join them in the other directions,
because a node cannot be tied to two others. This script does not come from jostle's exporter.
"""

import json
import math

import openseespy.opensees as ops

G = 9.80665
E, NU = 30e9, 0.2
INITIAL = 50.0
LINES = [[0.0, 6.0], [0.0, 5.0]]
HEIGHTS = [0.0, 3.6, 6.8]
MASS, POLAR = [90e3, 75e3], [457.5e3, 381.25e3]
CENTRE = [2.5, 2.9]
ALPHA = 0.5
DURATION = 5.0
AMPLITUDES, PERIODS = [0.45 * G, 0.35 * G], [0.61, 0.43]
FLOORS = [1, 2]
STIFF = [1e15, 1e14]  # vertically [N/m], and in rotation [N m/rad]


def section(a, b):
    """EA, GJ, and EI for bending along the side a and along the side b."""
    long, short = max(a, b), min(a, b)
    ratio = short / long
    torsion = long * short**3 * (1 / 3 - 0.21 * ratio * (1 - ratio**4 / 12))
    return E * a * b, E / (2 * (1 + NU)) * torsion, E * a**3 * b / 12, E * a * b**3 / 12


def members():
    """Columns, beams along x, beams across: ends as (level, x, y), section, yield moments by axis of bending, ratio after yield."""
    found = []
    for x in range(2):
        for y in range(2):
            for storey in range(2):
                ends = [(storey, x, y), (storey + 1, x, y)]
                if (x, y) == (0, 0):
                    found.append((ends, section(0.6, 0.5), [320e3, 260e3], 0.02))
                else:
                    found.append((ends, section(0.45, 0.4), [150e3, 120e3], 0.02))
    for y in range(2):
        for floor in (1, 2):
            found.append(([(floor, 0, y), (floor, 1, y)], section(0.5, 0.3), [110e3, None], 0.03))
    for x in range(2):
        for floor in (1, 2):
            found.append(([(floor, x, 0), (floor, x, 1)], section(0.45, 0.25), [None, 75e3], 0.03))
    return found


def run(step):
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for floor, mass, polar, z in zip(FLOORS, MASS, POLAR, HEIGHTS[1:]):
        ops.node(floor, *CENTRE, z)
        ops.mass(floor, mass, mass, 0.0, 0.0, 0.0, polar)
        ops.fix(floor, 0, 0, 1, 1, 1, 0)
    joints, tag = {}, 10
    tied = {floor: [] for floor in FLOORS}
    for direction, stiffness in zip((1, 2), STIFF):
        ops.uniaxialMaterial("Elastic", direction, stiffness)
    for level in range(3):
        for x in range(2):
            for y in range(2):
                ops.node(tag, LINES[0][x], LINES[1][y], HEIGHTS[level])
                joints[level, x, y] = tag
                if level == 0:
                    ops.fix(tag, *[1] * 6)
                else:
                    tied[level].append(tag)
                tag += 1
    ops.geomTransf("Linear", 1, 1, 0, 0)  # columns: the local z axis is x
    ops.geomTransf("Linear", 2, 0, 0, 1)  # beams: the local z axis is up
    hinges, feet = [], []
    for ends, (ea, gj, along, across), moments, ratio in members():
        is_column = ends[0][0] != ends[1][0]
        places = [(LINES[0][x], LINES[1][y], HEIGHTS[level]) for level, x, y in ends]
        length = math.dist(*places)
        nodes = []
        # Bending along x turns about y (5), bending across about x (4).
        axes = [axis for axis, moment in zip((5, 4), moments) if moment]
        for end, place in zip(ends, places):
            ops.node(tag, *place)
            nodes.append(tag)
            if end[0] == 0:
                ops.fix(tag, *[int(direction not in axes) for direction in range(1, 7)])
                tag += 1
                continue
            tied[end[0]].append(tag)
            directions = [direction for direction in (3, 4, 5) if direction not in axes]
            materials = [1 if direction == 3 else 2 for direction in directions]
            ops.element("zeroLength", tag, joints[end], tag, "-mat", *materials, "-dir", *directions)
            tag += 1
        ops.element("elasticBeamColumn", tag, *nodes, ea, 1.0, 1.0, gj, along, across, 1 if is_column else 2)
        if is_column and ends[0][0] == 0:
            feet.append((tag, places[0]))
        tag += 1
        for axis, moment in zip((5, 4), moments):
            if not moment:
                continue
            # A beam bends in its vertical plane: along its depth, the first side.
            rigidity = across if is_column and axis == 4 else along
            for end, node in zip(ends, nodes):
                ops.uniaxialMaterial("Steel01", tag, moment, INITIAL * rigidity / length, ratio)
                ops.element("zeroLength", tag, joints[end], node, "-mat", tag, "-dir", axis)
                hinges.append(tag)
                tag += 1
    for floor, own in tied.items():
        ops.rigidDiaphragm(3, floor, *own)
    ops.rayleigh(ALPHA, 0.0, 0.0, 0.0)
    steps = round(DURATION / step)
    for direction, (amplitude, period) in enumerate(zip(AMPLITUDES, PERIODS), start=1):
        values = [amplitude * math.sin(2 * math.pi * k * step / period) for k in range(steps + 2)]
        ops.timeSeries("Path", direction, "-dt", step, "-values", *values)
        ops.pattern("UniformExcitation", direction, direction, "-accel", direction)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormDispIncr", 1e-13, 50)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    greatest = [[0.0] * 3 for _ in FLOORS]
    least = [[0.0] * 3 for _ in FLOORS]
    forces = [0.0] * len(hinges)
    torque, base = 0.0, [0.0, 0.0]
    for _ in range(steps):
        if ops.analyze(1, step):
            raise SystemExit("no convergence")
        for index, floor in enumerate(FLOORS):
            for component, direction in enumerate((1, 2, 6)):
                u = ops.nodeDisp(floor, direction)
                greatest[index][component] = max(greatest[index][component], u)
                least[index][component] = min(least[index][component], u)
        for index, hinge in enumerate(hinges):
            forces[index] = max(forces[index], abs(ops.eleResponse(hinge, "material", 1, "stress")[0]))
        sums, moment = [0.0, 0.0], 0.0
        for foot, place in feet:
            own = ops.eleForce(foot)[:6]
            sums = [a + b for a, b in zip(sums, own)]
            moment += (place[0] - CENTRE[0]) * own[1] - (place[1] - CENTRE[1]) * own[0] + own[5]
        base = [max(a, abs(b)) for a, b in zip(base, sums)]
        torque = max(torque, abs(moment))
    return {
        "displacement_max": greatest,
        "displacement_min": least,
        "hinge_moments_peak_n_m": forces,
        "base_shear_peak_n": base,
        "base_torque_peak_n_m": torque,
    }


def main():
    step = 1e-3
    fine, coarse = run(step), run(2 * step)
    flat = lambda value: sum(map(flat, value), []) if isinstance(value, list) else [value]
    change = 0.0
    for key in fine:
        a, b = flat(fine[key]), flat(coarse[key])
        change = max(change, max(abs(x - y) for x, y in zip(a, b)) / max(map(abs, a)))
    result = {
        "source": "openseespy 3.7.1.2 by yielding_space_frame.py: Newmark average acceleration, Newton, Steel01 at member ends",
        "step_s": step,
        "change_when_doubled": change,
        **fine,
    }
    with open("yielding_space_frame.json", "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
        file.write("\n")
    print(change, fine["displacement_max"], fine["base_torque_peak_n_m"])


main()
