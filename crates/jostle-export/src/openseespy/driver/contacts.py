class Watch:
    """Contacts: which are near, which are closed, what was counted."""

    def __init__(self):
        self.faces = [(left, right, gap) for _, left, right, _, gap, *_ in CONTACTS]
        self.tags = [row[0] for row in CONTACTS]
        self.normals = [NORMALS.get(tag) for tag in self.tags]
        # Gaps are those between buildings that bear their weight.
        bears = any(building["weight"] for building in BUILDINGS)
        nodes = {node for left, right, _ in self.faces for node in (left, right)}
        self.rest = {(node, way): ops.nodeDisp(node, way) if bears else 0.0 for node in nodes for way in (1, 2)}
        for index, (left, right, gap) in enumerate(self.faces):
            self.faces[index] = (left, right, gap + self.difference(index, lambda node, way: self.rest[node, way]))
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
        # zeroLength counts strains and their rates from those that it finds; it shall find those at rest.
        found = []
        for node in (left, right):
            for direction in (1, 2):
                found.append((node, direction, ops.nodeDisp(node, direction), ops.nodeVel(node, direction)))
                ops.setNodeDisp(node, direction, self.rest[node, direction], "-commit")
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


class Panels:
    """Panels that fall where the total acceleration of a floor beside them reaches what they bear."""

    def __init__(self):
        self.standing = list(enumerate(FALLING))
        self.fallen = {}

    def drop(self):
        """Removes the struts of those that fall now; whether there were any."""
        if not self.standing:
            return False
        grounds = [ground_acceleration(index, ops.getTime()) for index in range(len(BUILDINGS))]
        left = []
        for number, panel in self.standing:
            limit, building, sides, normal, struts = panel
            ground = grounds[building]
            if all(abs(across(side, normal, ground)) < limit for side in sides):
                left.append((number, panel))
                continue
            for strut in struts:
                ops.remove("element", strut)
            self.fallen[number] = ops.getTime()
        some = len(left) < len(self.standing)
        self.standing = left
        return some


def across(node, normal, ground):
    """Total acceleration of a floor, or of the ground, along a normal."""
    x, y = normal
    total = x * ground[0] + y * ground[1]
    if node is None:
        return total
    # Where grounds move apart, motions are those in space.
    own = sum(part * ops.nodeAccel(node, direction) for direction, part in ((1, x), (2, y)) if part)
    return own if GROUNDS else total + own


def distance_inside(end):
    """How far a corner is inside of an end of its edge [m]."""
    own, other, inside = end
    for sign, side in ((1.0, own), (-1.0, other)):
        if side is not None:
            node, *shares = side
            inside += sign * sum(share * ops.nodeDisp(node, direction) for direction, share in zip((1, 2, TURN), shares))
    return inside
