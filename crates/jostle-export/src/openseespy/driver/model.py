# ---------------------------------------------------------------------------------------------------------------
# From here on every exported script is the same.

import argparse
import json
import math
import os
import sys
import tempfile
import time

try:
    import openseespy.opensees as ops
except (ImportError, RuntimeError) as problem:
    sys.exit(f"OpenSeesPy cannot be loaded: {problem}\npip install openseespy; on Debian it needs libblas3 liblapack3 libgfortran5")

# Members that keep their length, where no tie sees to it: EA = STIFF * 12 EI / l^2.
STIFF = 1e4
HALVINGS = 30  # of a step that does not converge, at most
MOST_PARTS = 10_000  # of such a step
SETTLED = 1e-10  # displacement in the last iteration [m]
SKEW = 1e-9  # cosine of a right angle, with rounding
OF_SHEAR = 1_000_000  # sections of members that shear are numbered from here on
LONGEST = 1e4  # of a sine [s]: OpenSees integrates it to its end before the first step
IN_PLAN = bool(ARMS or JOINTS or UPRIGHT)  # nodes are floors seen from above: they move along x, across, and turn
IN_SPACE = bool(JOINTS or UPRIGHT or ROCKING)  # columns and beams stand between the floors: x and y are the site, z is up
TURN = 6 if IN_SPACE else 3  # rotation about the vertical axis, of floors in plan
FIXED_ALONG = []  # nodes that are fixed along the row, which move with grounds that move apart
NORMALS = {tag: (x, y) for tag, _, _, x, y, *_ in FACES} | {tag: (x, y) for tag, x, y in DIRECTIONS}
CORNERS = {}  # contacts that end where a corner leaves its edge
for tag, *end in ENDS:
    CORNERS.setdefault(tag, []).append(end)


def build(axial):
    """The model. axial: "ties" (members keep their length exactly) or "stiff" (almost, but without constraints)."""
    ops.wipe()
    if IN_SPACE:
        build_in_space()
        return
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    where = {}
    for tag, x, y, mass, inertia in NODES:
        where[tag] = (x, y)
        ops.node(tag, x, y)
        if mass or inertia:
            ops.mass(tag, mass, mass, inertia)
    fixed = {tag: list(held) for tag, *held in SUPPORTS}
    if axial == "ties":
        for tag, direction in HELD:
            fixed.setdefault(tag, [0, 0, 0])[direction - 1] = 1
        for kept, tied, *directions in TIES:
            ops.equalDOF(kept, tied, *directions)
    for tag, held in fixed.items():
        ops.fix(tag, *held)
    FIXED_ALONG[:] = [tag for tag, held in fixed.items() if held[0]]
    for kept, tied in ARMS:
        ops.rigidLink("beam", kept, tied)
    ops.geomTransf("Linear", 1)
    stiffest = 0.0
    for tag, first, last, ei, ea, ga in MEMBERS:
        length = math.dist(where[first], where[last])
        if ea is None:
            ea = STIFF * 12.0 * ei / length**2
        stiffest = max(stiffest, ea / length)
        if ga is None:
            ops.element("elasticBeamColumn", tag, first, last, ea, 1.0, ei, 1)
        else:
            ops.element("ElasticTimoshenkoBeam", tag, first, last, 1.0, 1.0, ea, ei, ga, 1)
    for name, tag, *arguments in MATERIALS:
        if name == "LimitState":
            arguments = failing(tag, where, *arguments)
        ops.uniaxialMaterial(name, tag, *arguments)
    for tag, first, last, springs, damped in SPRINGS:
        directions, materials = [pair[0] for pair in springs], [pair[1] for pair in springs]
        extra = ["-doRayleigh", 1] if damped else []
        ops.element("zeroLength", tag, first, last, "-mat", *materials, "-dir", *directions, *extra)
    for tag, first, last, material, share, damped in LEVERED:
        # Shear of a link: the difference of displacements across it, and its length times rotations.
        extra = ["-doRayleigh"] if damped else []
        ops.element("twoNodeLink", tag, first, last, "-mat", material, "-dir", 2, "-shearDist", share, *extra)
    add_upright_springs()
    add_diagonals()
    add_sliders()
    add_fibres()
    if any(axial == "stiff" or not tied for *_, tied in RIGID):
        rigid = len(MATERIALS) + 1
        ops.uniaxialMaterial("Elastic", rigid, stiffest or 1e12)
        for tag, first, last, direction, tied in RIGID:
            if axial == "stiff" or not tied:
                ops.element("zeroLength", tag, first, last, "-mat", rigid, "-dir", direction)
    for tag, first, last, material in LEANING:
        ops.element("zeroLength", tag, first, last, "-mat", material, "-dir", 1)
    damp()


def add_upright_springs():
    """Springs of frames at lines, and of walls on the site, along and across a direction."""
    for tag, first, last, direction, material, damped, (x, y) in UPRIGHT_SPRINGS:
        extra = ["-doRayleigh", 1] if damped else []
        ops.element("zeroLength", tag, first, last, "-mat", material, "-dir", direction, *extra, "-orient", x, y, 0.0, -y, x, 0.0)


def add_diagonals():
    """Braces and struts, along the lines between their joints."""
    for tag, first, last, material, damped in DIAGONALS:
        extra = ["-doRayleigh"] if damped else []
        ops.element("twoNodeLink", tag, first, last, "-mat", material, "-dir", 1, *extra)


def failing(tag, where, *numbers):
    """Arguments of LimitState: the falling branch is part of its backbone; no pinching, no other damage.

    With degrade = 1, peaks of one direction count in the other. That needs a limit curve, of some column, which is never reached."""
    *backbone, slope, residual = numbers
    never = 1e12
    up = 3 if IN_SPACE else 2
    element, foot, head = next(row[:3] for row in (*MEMBERS, *COLUMNS_AND_BEAMS) if where[row[1]][up - 1] != where[row[2]][up - 1])
    ops.limitCurve("ThreePoint", tag, element, 0.0, never, 2.0, never, 3.0, never, -slope, residual, 2, 0, foot, head, 1, up)
    return [*backbone, 1.0, 1.0, 0.0, 0.0, 0.0, tag, 2, 1]


def add_sliders():
    """Bearings in plan: elastic up to a strength that bounds their force in every direction together."""
    for number, (tag, ground, mat, stiffness, strength) in enumerate(SLIDERS, start=1):
        ops.section("Bidirectional", number, stiffness, strength, 0.0, 0.0)
        ops.element("zeroLengthSection", tag, ground, mat, number, "-doRayleigh", 0)


def add_fibres():
    """Ends of members made of fibres: sections without length, so that strains are elongations, and areas of one."""
    known = None
    for section, along, across, material in FIBRES:
        if section != known:
            known = section
            # Ties or a diaphragm see to torsion.
            ops.section("Fiber", len(SLIDERS) + section, *(["-GJ", 1.0] if IN_SPACE else []))
        ops.fiber(-along, -across, 1.0, material)
    for tag, lower, upper, section, (x, y), _ in FIBRE_ENDS:
        axis = [0.0, 0.0, 1.0] if IN_SPACE else [0.0, 1.0, 0.0]
        ops.element("zeroLengthSection", tag, lower, upper, len(SLIDERS) + section, "-orient", *axis, -x, -y, 0.0, "-doRayleigh", 0)


def join_buildings():
    """Contacts and links. They join buildings that bear their weight: zeroLength counts from the displacements that it finds."""
    for tag, left, right, material, *_ in CONTACTS:
        if tag not in CORNERS:
            ops.element("zeroLength", tag, left, right, "-mat", material, "-dir", 1, *orientation(tag))
    heights = {tag: y for tag, _, y, *_ in NODES}
    for tag, left, right, material, *_, turning in LINKS:
        if turning:
            lower, upper = sorted((left, right), key=heights.get)
            ops.element("twoNodeLink", tag, lower, upper, "-mat", material, "-dir", 2)
        else:
            ops.element("zeroLength", tag, left, right, "-mat", material, "-dir", 1, *orientation(tag))


def damp():
    """Rayleigh damping."""
    for number, building in enumerate(BUILDINGS, start=1):
        first, last = building["nodes"]
        # On the initial stiffness of everything that is not a bare spring.
        ops.region(number, "-node", *range(first, last + 1), "-rayleigh", building["alpha"], 0.0, building["beta"], 0.0)
        # What yields and is damped by its tangent: by that at the last step.
        nodes = range(first, last + 1)
        springs = [row for row in (*SPRINGS, *LEVERED, *TILTED_STOREYS) if row[1] in nodes or row[2] in nodes]
        springs += [spring for *_, springs in HINGED_ENDS for spring in springs if spring[1] in nodes]
        springs += [row for row in DIAGONALS if row[1] in nodes or row[2] in nodes]
        springs += [row[:-1] for row in UPRIGHT_SPRINGS if row[1] in nodes]
        by_tangent = [row[0] for row in springs if row[-1] == "tangent"]
        if by_tangent:
            ops.region(len(BUILDINGS) + number, "-eleOnly", *by_tangent, "-rayleigh", 0.0, 0.0, 0.0, building["beta"])


def build_in_space():
    """Floors at their centres of mass, joints tied to them, columns and beams.

    Nothing lets floors rise or tilt, so soft springs hold them there: fixed in these directions, they would break the constraints of
    what is tied to them (Transformation). Springs of storeys join points at different heights; their length has no effect."""
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    heights = dict(LEVELS)
    heights.update({point: heights.get(floor, 0.0) for floor, point in ARMS})
    heights.update(RAISED)
    rocking = {tag: turning for tag, *turning in ROCKING}
    tilted = {floor for _, _, floor, _ in TILTED}
    riding = {foot for _, foot in RIDING}
    free = max(tag for tag, *_ in NODES + JOINTS + HINGED_ENDS + UPRIGHT) + 1
    hold = len(MATERIALS) + 2
    ops.uniaxialMaterial("Elastic", hold, 1e6)
    for tag, x, y, mass, inertia in NODES:
        ops.node(tag, x, y, heights.get(tag, 0.0))
        if mass or inertia:
            along_x, across = mass if isinstance(mass, tuple) else (mass, mass)
            ops.mass(tag, along_x, across, 0.0, *rocking.get(tag, (0.0, 0.0)), inertia)
    places = {tag: (x, y) for tag, x, y, *_ in NODES}
    for number, (floor, z) in enumerate(LEVELS):
        ops.node(free + number, *places[floor], z)
        ops.fix(free + number, 1, 1, 1, 1, 1, 1)
        directions = [3] if floor in tilted else [3, 4, 5]
        ops.element("zeroLength", 10_000_000 + number, free + number, floor, "-mat", *[hold] * len(directions), "-dir", *directions)
    where = {}
    tied = {}
    feet = []
    for tag, x, y, z, floor in JOINTS:
        where[tag] = (x, y, z)
        ops.node(tag, x, y, z)
        if floor is None:
            ops.fix(tag, 1, 1, 1, 1, 1, 1)
        elif tag not in riding:
            tied.setdefault(floor, []).append(tag)
            if z == 0.0:
                feet.append(tag)
    for tag, *_ in SUPPORTS:
        ops.fix(tag, 1, 1, 1, 1, 1, 1)
    add_upright(where, tied, riding, free + len(LEVELS), hold)
    # Of an askew frame also across it, where nothing but a soft spring holds it.
    own = {}
    for tag, *_, (c, s), _, mass, turning in UPRIGHT:
        along_x, across = abs(c) > SKEW, abs(s) > SKEW
        own[tag] = (mass * along_x, mass * across, turning * across, turning * along_x)
    for tag, mass, _ in CARRIED:
        along_x, across, *turning = own.pop(tag, (0.0, 0.0, 0.0, 0.0))
        ops.mass(tag, along_x, across, mass, *turning, 0.0)
    for tag, (along_x, across, *turning) in own.items():
        ops.mass(tag, along_x, across, 0.0, *turning, 0.0)
    floors = {tag: floor for tag, *_, floor in JOINTS}
    for tag, joint, _, springs in HINGED_ENDS:
        where[tag] = where[joint]
        ops.node(tag, *where[joint])
        if any(direction == 1 for *_, direction, _, _ in springs):
            continue  # it fails in shear, and slides
        if floors[joint] is None:
            ops.fix(tag, 1, 1, 0, 0, 0, 1)
        else:
            tied.setdefault(floors[joint], []).append(tag)
    for floor, joints in tied.items():
        ops.rigidDiaphragm(3, floor, *joints)
    for kept, point in (*ARMS, *RIDING):
        ops.rigidLink("beam", kept, point)
    transforms = {}
    rigid = {tag: lengths for tag, *lengths in RIGID_ENDS}
    for tag, first, last, bending, sideways, torsion, ea, ga, towards in COLUMNS_AND_BEAMS:
        length = math.dist(where[first], where[last])
        if ea is None:
            ea = STIFF * 12.0 * max(bending, sideways) / length**2
        start, end = rigid.get(tag, (0.0, 0.0))
        axis = [(b - a) / length for a, b in zip(where[first], where[last])]
        offsets = [start * part for part in axis] + [-end * part for part in axis]
        key = (towards, *offsets)
        if key not in transforms:
            transforms[key] = len(transforms) + 1
            ops.geomTransf("Linear", transforms[key], *towards, *(["-jntOffset", *offsets] if any(offsets) else []))
        # The local axis z lies in the plane of bending, so that bending there turns the section about y.
        if ga is None:
            ops.element("elasticBeamColumn", tag, first, last, ea, 1.0, 1.0, torsion, bending, sideways, transforms[key])
        elif any(offsets):
            # ElasticTimoshenkoBeam takes no offsets. Two points integrate the flexibility of a straight member exactly.
            along, across = ga
            ops.section("Elastic", OF_SHEAR + tag, 1.0, ea, sideways, bending, 1.0, torsion, across / ea, along / ea)
            ops.beamIntegration("Legendre", tag, OF_SHEAR + tag, 2)
            ops.element("forceBeamColumn", tag, first, last, transforms[key], tag)
        else:
            along, across = ga
            ops.element("ElasticTimoshenkoBeam", tag, first, last, 1.0, 1.0, ea, torsion, bending, sideways, across, along, transforms[key])
    for foot in feet:
        # Held as by the ground, but free to move with the mat.
        ops.fix(foot, 0, 0, 1, 1, 1, 0)
    for name, tag, *arguments in MATERIALS:
        if name == "LimitState":
            arguments = failing(tag, where, *arguments)
        ops.uniaxialMaterial(name, tag, *arguments)
    for _, _, (x, y), springs in HINGED_ENDS:
        for tag, first, last, direction, material, damped in springs:
            extra = ["-doRayleigh", 1] if damped else []
            ops.element("zeroLength", tag, first, last, "-mat", material, "-dir", direction, *extra, "-orient", x, y, 0.0, -y, x, 0.0)
    add_upright_springs()
    for tag, first, last, springs, damped in SPRINGS:
        directions, materials = [pair[0] for pair in springs], [pair[1] for pair in springs]
        extra = ["-doRayleigh", 1] if damped else []
        ops.element("zeroLength", tag, first, last, "-mat", *materials, "-dir", *directions, *extra)
    for tag, base, floor, material in TILTED:
        ops.element("zeroLength", tag, base, floor, "-mat", material, material, "-dir", 4, 5)
    for tag, first, last, springs, damped in TILTED_STOREYS:
        # Axes of such a link: upwards, along x, along y.
        directions, materials = [{1: 2, 2: 3, 6: 4}[pair[0]] for pair in springs], [pair[1] for pair in springs]
        extra = ["-doRayleigh"] if damped else []
        ops.element("twoNodeLink", tag, first, last, "-mat", *materials, "-dir", *directions, "-orient", 1.0, 0.0, 0.0, *extra)
    add_diagonals()
    add_sliders()
    add_fibres()
    damp()


def add_upright(where, tied, riding, free, hold):
    """Joints of frames at lines of a plan. Nothing turns them across their frame, so a soft spring holds them there."""
    number = 0
    for tag, x, y, z, floor, (c, s), (along, rise, turn), *_ in UPRIGHT:
        where[tag] = (x, y, z)
        ops.node(tag, x, y, z)
        if tag in riding:
            continue
        if floor is not None:
            tied.setdefault(floor, []).append(tag)
            held = [0, 0, rise, turn, turn, 0]
        elif along:
            held = [1, 1, rise, turn, turn, 1]
        else:
            # Between floors, or sliding: it moves along its line.
            held = [int(abs(c) <= SKEW), int(abs(s) <= SKEW), rise, turn, turn, 1]
        if any(held):
            ops.fix(tag, *held)
        soft = ([] if turn else [4]) + ([2] if held[:2] == [0, 0] and floor is None else [])
        if soft:
            ops.node(free + number, x, y, z)
            ops.fix(free + number, 1, 1, 1, 1, 1, 1)
            ops.element("zeroLength", 11_000_000 + number, free + number, tag, "-mat", *[hold] * len(soft), "-dir", *soft, "-orient", c, s, 0.0, -s, c, 0.0)
            number += 1


def orientation(tag):
    """Local axes of a contact in plan: along its normal, and along its face."""
    if tag not in NORMALS:
        return []
    x, y = NORMALS[tag]
    return ["-orient", x, y, 0.0, -y, x, 0.0]
