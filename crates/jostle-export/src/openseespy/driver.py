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
LONGEST = 1e4  # of a sine [s]: OpenSees integrates it to its end before the first step
DIRECTIONS = {1: 1, 2: 2, 6: 3}
IN_PLAN = bool(ARMS) or bool(JOINTS)  # nodes are floors seen from above: they move along x, across, and turn
IN_SPACE = bool(JOINTS)  # columns and beams stand between the floors: x and y are the site, z is up
TURN = 6 if IN_SPACE else 3  # rotation about the vertical axis, of floors in plan
NORMALS = {tag: (x, y) for tag, _, _, x, y, *_ in FACES}
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
    add_sliders()
    if any(axial == "stiff" or not tied for *_, tied in RIGID):
        rigid = len(MATERIALS) + 1
        ops.uniaxialMaterial("Elastic", rigid, stiffest or 1e12)
        for tag, first, last, direction, tied in RIGID:
            if axial == "stiff" or not tied:
                ops.element("zeroLength", tag, first, last, "-mat", rigid, "-dir", direction)
    for tag, first, last, material in LEANING:
        ops.element("zeroLength", tag, first, last, "-mat", material, "-dir", 1)
    add_contacts()


def failing(tag, where, *numbers):
    """Arguments of LimitState: the falling branch is part of its backbone; no pinching, no other damage.

    With degrade = 1, peaks of one direction count in the other. That needs a limit curve, of some column, which is never reached."""
    *backbone, slope, residual = numbers
    never = 1e12
    element, foot, head = next(row[:3] for row in MEMBERS if where[row[1]][1] != where[row[2]][1])
    ops.limitCurve("ThreePoint", tag, element, 0.0, never, 2.0, never, 3.0, never, -slope, residual, 2, 0, foot, head, 1, 2)
    return [*backbone, 1.0, 1.0, 0.0, 0.0, 0.0, tag, 2, 1]


def add_sliders():
    """Bearings in plan: elastic up to a strength that bounds their force in every direction together."""
    for number, (tag, ground, mat, stiffness, strength) in enumerate(SLIDERS, start=1):
        ops.section("Bidirectional", number, stiffness, strength, 0.0, 0.0)
        ops.element("zeroLengthSection", tag, ground, mat, number, "-doRayleigh", 0)


def add_contacts():
    """Contacts, links, and Rayleigh damping."""
    for tag, left, right, material, *_ in CONTACTS:
        if tag not in CORNERS:
            ops.element("zeroLength", tag, left, right, "-mat", material, "-dir", 1, *orientation(tag))
    for tag, left, right, material, *_ in LINKS:
        ops.element("zeroLength", tag, left, right, "-mat", material, "-dir", 1)
    for number, building in enumerate(BUILDINGS, start=1):
        first, last = building["nodes"]
        # On the initial stiffness of everything that is not a bare spring.
        ops.region(number, "-node", *range(first, last + 1), "-rayleigh", building["alpha"], 0.0, building["beta"], 0.0)


def build_in_space():
    """Floors at their centres of mass, joints tied to them, columns and beams.

    Nothing lets floors rise or tilt, so soft springs hold them there: fixed in these directions, they would break the constraints of
    what is tied to them (Transformation). Springs of storeys join points at different heights; their length has no effect."""
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    heights = dict(LEVELS)
    heights.update({point: heights[floor] for floor, point in ARMS})
    free = max(tag for tag, *_ in NODES + JOINTS + HINGED_ENDS) + 1
    hold = len(MATERIALS) + 2
    ops.uniaxialMaterial("Elastic", hold, 1e6)
    for tag, x, y, mass, inertia in NODES:
        ops.node(tag, x, y, heights.get(tag, 0.0))
        if mass or inertia:
            ops.mass(tag, mass, mass, 0.0, 0.0, 0.0, inertia)
    places = {tag: (x, y) for tag, x, y, *_ in NODES}
    for number, (floor, z) in enumerate(LEVELS):
        ops.node(free + number, *places[floor], z)
        ops.fix(free + number, 1, 1, 1, 1, 1, 1)
        ops.element("zeroLength", 10_000_000 + number, free + number, floor, "-mat", hold, hold, hold, "-dir", 3, 4, 5)
    where = {}
    tied = {}
    mats = {building["floors"][0] for building in BUILDINGS if building.get("has_mat")}
    feet = []
    for tag, x, y, z, floor in JOINTS:
        where[tag] = (x, y, z)
        ops.node(tag, x, y, z)
        if floor is None:
            ops.fix(tag, 1, 1, 1, 1, 1, 1)
        else:
            tied.setdefault(floor, []).append(tag)
            if floor in mats:
                feet.append(tag)
    for tag, *_ in SUPPORTS:
        ops.fix(tag, 1, 1, 1, 1, 1, 1)
    floors = {tag: floor for tag, *_, floor in JOINTS}
    for tag, joint, *_ in HINGED_ENDS:
        where[tag] = where[joint]
        ops.node(tag, *where[joint])
        if floors[joint] is None:
            ops.fix(tag, 1, 1, 0, 0, 0, 1)
        else:
            tied.setdefault(floors[joint], []).append(tag)
    for floor, joints in tied.items():
        ops.rigidDiaphragm(3, floor, *joints)
    for kept, point in ARMS:
        ops.rigidLink("beam", kept, point)
    transforms = {}
    for tag, first, last, bending, sideways, torsion, ea, ga, towards in COLUMNS_AND_BEAMS:
        length = math.dist(where[first], where[last])
        if ea is None:
            ea = STIFF * 12.0 * max(bending, sideways) / length**2
        if towards not in transforms:
            transforms[towards] = len(transforms) + 1
            ops.geomTransf("Linear", transforms[towards], *towards)
        # The local axis z lies in the plane of bending, so that bending there turns the section about y.
        if ga is None:
            ops.element("elasticBeamColumn", tag, first, last, ea, 1.0, 1.0, torsion, bending, sideways, transforms[towards])
        else:
            along, across = ga
            ops.element("ElasticTimoshenkoBeam", tag, first, last, 1.0, 1.0, ea, torsion, bending, sideways, across, along, transforms[towards])
    for foot in feet:
        # Held as by the ground, but free to move with the mat.
        ops.fix(foot, 0, 0, 1, 1, 1, 0)
    for name, tag, *arguments in MATERIALS:
        ops.uniaxialMaterial(name, tag, *arguments)
    for _, _, (x, y), springs in HINGED_ENDS:
        for tag, first, last, direction, material in springs:
            ops.element("zeroLength", tag, first, last, "-mat", material, "-dir", direction, "-orient", x, y, 0.0, -y, x, 0.0)
    for tag, first, last, springs, damped in SPRINGS:
        directions, materials = [pair[0] for pair in springs], [pair[1] for pair in springs]
        extra = ["-doRayleigh", 1] if damped else []
        ops.element("zeroLength", tag, first, last, "-mat", *materials, "-dir", *directions, *extra)
    add_sliders()
    add_contacts()


def orientation(tag):
    """Local axes of a contact in plan: along its normal, and along its face."""
    if tag not in NORMALS:
        return []
    x, y = NORMALS[tag]
    return ["-orient", x, y, 0.0, -y, x, 0.0]


def load_by_weight(axial):
    """Every building that starts under its weight gets it, and settles."""
    if not any(building["weight"] for building in BUILDINGS):
        return
    prepare(axial)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for building in BUILDINGS:
        first, last = building["nodes"]
        for tag, _, _, mass, _ in NODES:
            if building["weight"] and first <= tag <= last and mass:
                ops.load(tag, 0.0, -mass * GRAVITY, 0.0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")

    def load(part):
        ops.integrator("LoadControl", part)
        return ops.analyze(1) == 0

    if not all(load(0.1) or in_parts(load, 0.1) for _ in range(10)):
        sys.exit("stopped: the buildings do not come to rest under their weight; see --log FILE for what OpenSees says")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()


def in_parts(advance, step):
    """Advances by a step in parts, halved where one does not converge and doubled after one that does.

    Hinges much stiffer than their members need it: Newton's method jumps from one side of their short elastic range to
    the other until a part is small enough to end within it."""
    whole = left = 2**HALVINGS
    part = whole // 2
    for _ in range(MOST_PARTS):
        part = min(part, left)
        if advance(step * part / whole):
            left -= part
            part *= 2
        else:
            part //= 2
        if left == 0 or part == 0:
            break
    return left == 0


def ground_values(motion):
    """Step and values of a ground motion, unscaled."""
    if "RECORD" in motion:
        return motion["RECORD_STEP"], motion["RECORD"]
    if "RICKER" in motion:
        amplitude, period, centre = motion["RICKER"]
        wave = lambda t: (math.pi * (t - centre) / period) ** 2
        ricker = lambda t: amplitude * (1.0 - 2.0 * wave(t)) * math.exp(-wave(t))
    else:
        amplitude, period = motion["SINE"]
        ricker = lambda t: amplitude * math.sin(2.0 * math.pi * t / period)
    step = 1e-4
    return step, [ricker(step * k) for k in range(math.ceil(motion["DURATION"] / step) + 1)]


def shake():
    """Horizontal ground motion, and the accelerations that belong to its first value."""
    motions = [(globals(), globals().get("ANGLE", 0.0))]
    if "ACROSS" in globals():
        motions.append((vars(ACROSS), ANGLE + 0.5 * math.pi))
    start, number = [0.0, 0.0], 1
    for motion, angle in motions:
        shares = [math.cos(angle), math.sin(angle)] if IN_PLAN else [1.0, 0.0]
        for direction, share in enumerate(shares, start=1):
            # Of a right angle the cosine is not zero, and rounding is no motion.
            if abs(share) < 1e-15:
                continue
            number += 1
            factor = share * motion["MOTION_FACTOR"]
            if "SINE" in motion:
                amplitude, period = motion["SINE"]
                end = LONGEST if motion["DURATION"] >= DURATION else motion["DURATION"]
                ops.timeSeries("Trig", number, 0.0, end, period, "-factor", amplitude * factor)
            else:
                step, values = ground_values(motion)
                ops.timeSeries("Path", number, "-dt", step, "-values", *values, "-factor", factor)
                start[direction - 1] += values[0] * factor
            ops.pattern("UniformExcitation", number, direction, "-accel", number)
    for direction, value in enumerate(start, start=1):
        if value:
            resting = {tag for tag, *held in SUPPORTS if held[direction - 1]}
            heavy = {tag for tag, _, _, mass, _ in NODES if mass}
            heavy |= {tied for kept, tied, *directions in TIES if direction in directions}
            heavy |= {tied for kept, tied in ARMS}
            for tag in heavy - resting:
                ops.setNodeAccel(tag, direction, -value, "-commit")


def prepare(axial):
    """Everything that an analysis needs apart from the algorithm and the integrator. To be called once: a second
    SparseSYM brings the program down."""
    if IN_PLAN:
        # Points follow their floor by levers, which Plain cannot do.
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("ProfileSPD")
    elif axial == "ties":
        # SparseSYM (SparseSPD) and equalDOF together give wrong answers without a word. Transformation does not take
        # back a step that failed; Plain lets tied displacements share their equation and does.
        ops.constraints("Plain")
        ops.numberer("RCM")
        ops.system("ProfileSPD")
    else:
        ops.constraints("Plain")
        ops.numberer("RCM")
        ops.system("SparseSYM")
    ops.test("NormDispIncr", SETTLED, 25, 0)


ALGORITHMS = {
    # One factorisation for all steps of a size; no iteration: right for linear steps, useless in contact.
    "linear": ("Linear", False, False, True),
    # One factorisation for all steps of a size, iterated: contact is soft beside the inertia of a short step.
    "kept": ("ModifiedNewton", "-FactorOnce"),
    # A factorisation a step, or an iteration.
    "modified": ("ModifiedNewton",),
    "newton": ("Newton",),
}


class Watch:
    """Contacts: which are near, which are closed, what was counted."""

    def __init__(self):
        self.faces = [(left, right, gap) for _, left, right, _, gap, *_ in CONTACTS]
        self.tags = [row[0] for row in CONTACTS]
        self.normals = [NORMALS.get(tag) for tag in self.tags]
        self.closed = [False] * len(CONTACTS)
        self.impacts = [0] * len(CONTACTS)
        self.first = [None] * len(CONTACTS)
        self.deepest = [-math.inf] * len(CONTACTS)
        self.force = [0.0] * len(CONTACTS)
        self.late = 0
        # Faces in plan: their points, and those that have an element now.
        self.points = {}
        for index, tag in enumerate(self.tags):
            if IN_PLAN:
                self.points.setdefault(FACES[index][1], []).append(index)
        self.sums = {face: 0.0 for face in self.points}
        self.episodes = {face: 0 for face in self.points}
        self.present = [tag not in CORNERS for tag in self.tags]
        self.changed = False
        self.left_edge = 0

    def difference(self, index, of):
        """Left minus right of a displacement or a velocity, along the normal."""
        left, right, _ = self.faces[index]
        if self.normals[index] is None:
            return of(left, 1) - of(right, 1)
        x, y = self.normals[index]
        return x * (of(left, 1) - of(right, 1)) + y * (of(left, 2) - of(right, 2))

    def closings(self):
        if not IN_PLAN:
            disp = ops.nodeDisp
            return [disp(left, 1) - disp(right, 1) - gap for left, right, gap in self.faces]
        closings = [self.difference(index, ops.nodeDisp) - face[2] for index, face in enumerate(self.faces)]
        self.follow_corners(closings)
        return closings

    def is_near(self, step, closings):
        """Whether a contact may close within a step: with its speed, a half more, and an acceleration of 6 m/s2."""
        reserve = 3.0 * step * step
        for index, closing in enumerate(closings):
            # A corner far beyond the end of its edge touches nothing.
            if not self.present[index] and self.inside(index) + 15.0 * step + reserve < 0.0:
                continue
            if closing + reserve > 0.0:
                return True
            # Nothing closes faster than 10 m/s.
            if closing + 15.0 * step + reserve > 0.0:
                rate = self.difference(index, ops.nodeVel)
                if closing + 1.5 * max(rate, 0.0) * step + reserve > 0.0:
                    return True
        return False

    def follow_corners(self, closings):
        """Gives corners that can touch an edge an element, and takes it from those that left the edge.

        A corner touches where it comes to the edge from outside, between its ends. It is free again at the end of the edge."""
        for index, closing in enumerate(closings):
            tag = self.tags[index]
            if tag not in CORNERS:
                continue
            inside = self.inside(index)
            if self.present[index] and inside <= 0.0:
                self.left_edge += closing > 0.0
                self.present[index] = self.closed[index] = False
                self.changed = True
                ops.remove("element", tag)
            elif not self.present[index] and inside > 0.0 and closing <= 0.0:
                self.present[index] = self.changed = True
                self.add_corner(index)

    def inside(self, index):
        """How far a corner is inside of the ends of its edge [m]."""
        return min(distance_inside(end) for end in CORNERS[self.tags[index]])

    def add_corner(self, index):
        tag, left, right, material, *_ = CONTACTS[index]
        # zeroLength counts strains and their rates from those that it finds; it shall find none.
        found = []
        for node in (left, right):
            for direction in (1, 2):
                found.append((node, direction, ops.nodeDisp(node, direction), ops.nodeVel(node, direction)))
                ops.setNodeDisp(node, direction, 0.0, "-commit")
                ops.setNodeVel(node, direction, 0.0, "-commit")
        ops.element("zeroLength", tag, left, right, "-mat", material, "-dir", 1, *orientation(tag))
        for node, direction, displacement, velocity in found:
            ops.setNodeDisp(node, direction, displacement, "-commit")
            ops.setNodeVel(node, direction, velocity, "-commit")

    def count(self, closings, free):
        if IN_PLAN:
            self.count_faces(closings)
        for index, closing in enumerate(closings):
            if closing > self.deepest[index]:
                self.deepest[index] = closing
            closed = closing > 0.0 and self.present[index]
            if closed and not self.closed[index]:
                self.impacts[index] += 1
                self.late += free
                if self.first[index] is None:
                    self.first[index] = ops.getTime()
            self.closed[index] = closed

    def count_faces(self, closings):
        """Forces of points and their sums over faces; impacts of faces, from the first point that touches to the last."""
        for face, points in self.points.items():
            now = [index for index in points if self.present[index] and closings[index] > 0.0]
            if now and not any(self.closed[index] for index in points):
                self.episodes[face] += 1
            total = 0.0
            for index in now:
                force = max(0.0, -ops.eleResponse(self.tags[index], "localForce")[0])
                self.force[index] = max(self.force[index], force)
                total += force
            self.sums[face] = max(self.sums[face], total)


def distance_inside(end):
    """How far a corner is inside of an end of its edge [m]."""
    own, other, inside = end
    for sign, side in ((1.0, own), (-1.0, other)):
        if side is not None:
            node, *shares = side
            inside += sign * sum(share * ops.nodeDisp(node, direction) for direction, share in zip((1, 2, TURN), shares))
    return inside


class Run:
    """Steps taken, and how."""

    def __init__(self, watch):
        self.watch = watch
        self.steps = self.short_steps = self.iterations = self.failures = 0
        self.way = None

    def use(self, algorithm):
        # Setting it anew also makes it factorise anew, as a change of step must.
        ops.algorithm(*ALGORITHMS[algorithm])
        self.way = algorithm

    def advance(self, step, short):
        if self.watch.changed:
            # Elements came or went: what is factorised is of another model.
            self.watch.changed = False
            self.use(self.way)
        status = ops.analyze(1, step)
        self.steps += 1
        self.short_steps += short
        self.iterations += 1 if self.way == "linear" else ops.testIter()
        if status != 0:
            self.failures += 1
            return self.rescue(step)
        return True

    def rescue(self, step):
        """A step that did not converge, in parts with a fresh tangent at every iteration."""
        if IN_PLAN:
            print(f"stopped at {ops.getTime():.6g} s of the motion: a step of {step:g} s does not converge, and Transformation "
                  "does not take it back; try shorter ones with --free, or see --log FILE", file=sys.stderr)
            return False
        way = self.way
        self.use("newton")
        done = in_parts(lambda part: ops.analyze(1, part) == 0, step)
        self.use(way)
        if not done:
            print(f"stopped at {ops.getTime():.6g} s of the motion: a step of {step:g} s does not converge, not even in "
                  "parts; try another with --free, or see --log FILE for what OpenSees says", file=sys.stderr)
        return done


def march(args, duration):
    """Runs through the motion; returns what was counted."""
    watch = Watch()
    run = Run(watch)
    ops.integrator("Newmark", 0.5, 0.25)
    run.use(args.algorithm if args.uniform else args.free_algorithm)
    ops.analysis("Transient")
    complete = True
    cpu, wall = time.process_time(), time.perf_counter()
    if args.uniform:
        for _ in range(round(duration / args.uniform)):
            if not run.advance(args.uniform, True):
                complete = False
                break
            watch.count(watch.closings(), False)
    else:
        free, parts = args.free, args.parts
        short = free / parts
        near = False
        for _ in range(round(duration / free)):
            closings = watch.closings()
            now_near = watch.is_near(free, closings)
            if now_near != near:
                near = now_near
                run.use(args.contact_algorithm if near else args.free_algorithm)
            if near:
                for _ in range(parts):
                    complete = complete and run.advance(short, True)
                    watch.count(watch.closings(), False)
            else:
                complete = run.advance(free, False)
                watch.count(watch.closings(), True)
            if not complete:
                break
    return watch, run, complete, time.process_time() - cpu, time.perf_counter() - wall


def envelopes(folder):
    """Greatest displacements of floors and forces of contacts, kept by OpenSees itself."""
    floors = [tag for building in BUILDINGS for tag in building["floors"]]
    directions = [1, 2, TURN] if IN_PLAN else [1]
    ops.recorder("EnvelopeNode", "-file", os.path.join(folder, "floors"), "-precision", 12, "-node", *floors, "-dof", *directions, "disp")
    if CONTACTS and not IN_PLAN:
        elements = [row[0] for row in CONTACTS]
        ops.recorder("EnvelopeElement", "-file", os.path.join(folder, "forces"), "-precision", 12, "-ele", *elements, "localForce")


    if LINKS:
        elements = [row[0] for row in LINKS]
        ops.recorder("EnvelopeElement", "-file", os.path.join(folder, "links"), "-precision", 12, "-ele", *elements, "localForce")


def read(folder, name):
    with open(os.path.join(folder, name)) as file:
        return [[float(value) for value in line.split()] for line in file]


def modes(args):
    """Natural periods, longest first [s]."""
    build("ties")
    prepare("ties")
    values = ops.eigen("-genBandArpack", args.modes)
    return [2.0 * math.pi / math.sqrt(value) for value in values]


def analyse(args):
    duration = args.duration or DURATION
    build(args.axial)
    load_by_weight(args.axial)
    prepare(args.axial)
    shake()
    with tempfile.TemporaryDirectory() as folder:
        envelopes(folder)
        watch, run, complete, cpu, wall = march(args, duration)
        equations = ops.systemSize()
        reached = ops.getTime()
        ops.wipe()
        low, high, _ = read(folder, "floors")
        forces = [-force for force in watch.force]
        if CONTACTS and not IN_PLAN:
            forces = read(folder, "forces")[0]
        pulls = read(folder, "links")[2] if LINKS else []
    peaks = iter(zip(high, low))
    buildings = []
    for building in BUILDINGS:
        floors = []
        first = 0 if building.get("has_mat") else 1
        for number, (right, left) in zip(range(first, first + len(building["floors"])), peaks):
            floors.append({"floor": number, "displacement_max_m": right, "displacement_min_m": left})
            if IN_PLAN:
                for key in ("displacement_across", "rotation"):
                    unit = "rad" if key == "rotation" else "m"
                    floors[-1][f"{key}_max_{unit}"], floors[-1][f"{key}_min_{unit}"] = next(peaks)
        buildings.append({"name": building["name"], "floors": floors})
    contacts = []
    for index, (_, _, _, _, gap, number, floors, height) in enumerate(CONTACTS):
        contacts.append({
            "gap": number,
            "floors": list(floors),
            "height_m": height,
            "closing_peak_m": watch.deepest[index] + gap,
            "impact_count": watch.impacts[index],
            "peak_force_n": max(0.0, -forces[index]),
            "first_impact_s": watch.first[index],
        })
    faces = []
    for face, points in watch.points.items():
        _, _, _, _, _, number, floors, _ = CONTACTS[points[0]]
        times = [watch.first[index] for index in points if watch.first[index] is not None]
        faces.append({
            "face": face,
            "kind": FACES[points[0]][2],
            "gap": number,
            "floors": list(floors),
            "impact_count": watch.episodes[face],
            "peak_force_n": watch.sums[face],
            "first_impact_s": min(times, default=None),
        })
    links = []
    for (_, _, _, _, number, floors, height), force in zip(LINKS, pulls):
        links.append({"link": number, "floors": list(floors), "height_m": height, "peak_force_n": force})
    firsts = [contact["first_impact_s"] for contact in contacts if contact["first_impact_s"] is not None]
    return {
        "title": TITLE,
        "exported_by": EXPORTED_BY,
        "program": "OpenSeesPy",
        "version": ops.version(),
        "python": sys.version.split()[0],
        "way": {
            "axial": args.axial,
            "uniform_s": args.uniform,
            "free_s": None if args.uniform else args.free,
            "contact_s": args.uniform or args.free / args.parts,
            "algorithms": [args.algorithm] if args.uniform else [args.free_algorithm, args.contact_algorithm],
        },
        "duration_s": duration,
        "reached_s": reached,
        "complete": complete,
        "buildings": buildings,
        "contacts": contacts,
        **({"faces": faces, "corners_that_left_edges": watch.left_edge} if IN_PLAN else {}),
        "links": links,
        "impact_count": sum(watch.impacts),
        "peak_force_n": max((contact["peak_force_n"] for contact in contacts), default=0.0),
        "first_impact_s": min(firsts, default=None),
        "work": {
            "equations": equations,
            "steps": run.steps,
            "short_steps": run.short_steps,
            "iterations": run.iterations,
            "failed_steps": run.failures,
            "late_impacts": watch.late,
            "cpu_s": cpu,
            "wall_s": wall,
        },
    }


def main():
    used = [material for *_, springs, _ in SPRINGS for _, material in springs] + [row[3] for row in LINKS]
    used += [material for *_, springs in HINGED_ENDS for *_, material in springs]
    yields = bool(SLIDERS) or any(MATERIALS[material - 1][0] != "Elastic" for material in used)
    parser = argparse.ArgumentParser(description=f"{TITLE}: for OpenSeesPy, {EXPORTED_BY}. Prints JSON.")
    parser.add_argument("--uniform", type=float, metavar="DT", help="one step size throughout [s]")
    parser.add_argument("--free", type=float, default=FREE_STEP, metavar="DT", help="step in free vibration [s] (%(default)s)")
    parser.add_argument("--parts", type=int, default=PARTS_IN_CONTACT, help="parts of it around contact (%(default)s)")
    parser.add_argument("--duration", type=float, help=f"how long [s] ({DURATION})")
    parser.add_argument("--axial", choices=["ties", "stiff"], default="ties", help="members keep their length by ties (ProfileSPD), or almost by stiffness (SparseSYM) (%(default)s)")
    parser.add_argument("--algorithm", choices=ALGORITHMS, default="newton", help="with --uniform (%(default)s)")
    parser.add_argument("--free-algorithm", choices=ALGORITHMS, default="newton" if yields else "linear", help="in free vibration (%(default)s)")
    parser.add_argument("--contact-algorithm", choices=ALGORITHMS, default="newton" if yields else "kept", help="around contact (%(default)s)")
    parser.add_argument("--modes", type=int, metavar="N", help="natural periods only")
    parser.add_argument("--log", metavar="FILE", default=os.devnull, help="what OpenSees has to say")
    args = parser.parse_args()
    ops.logFile(args.log, "-noEcho")
    result = {"title": TITLE, "periods_s": modes(args)} if args.modes else analyse(args)
    json.dump(result, sys.stdout, indent=1)
    print()
    return 0 if result.get("complete", True) else 1


if __name__ == "__main__":
    sys.exit(main())
