class Path:
    """A ground from rest: the exact integrals of its acceleration, which is straight between the points of a record."""

    def __init__(self, motion, arrival):
        self.motion, self.arrival, self.factor = motion, arrival, motion["MOTION_FACTOR"]
        self.end = motion["DURATION"]
        if "RECORD" in motion:
            self.step, self.values = motion["RECORD_STEP"], motion["RECORD"]
            self.end = min(self.end, self.step * (len(self.values) - 1))
            self.points = [(0.0, 0.0)]
            for first, last in zip(self.values, self.values[1:]):
                self.points.append(over_line(self.points[-1], first, last, self.step, 1.0))

    def at(self, time):
        """Velocity and displacement [m/s, m]."""
        t = time - self.arrival
        if t <= 0.0:
            return 0.0, 0.0
        v, d = self.moved(min(t, self.end))
        return self.factor * v, self.factor * (d + v * max(0.0, t - self.end))

    def moved(self, t):
        if "RECORD" in self.motion:
            index = min(int(t / self.step), len(self.values) - 1)
            last = self.values[min(index + 1, len(self.values) - 1)]
            return over_line(self.points[index], self.values[index], last, self.step, t / self.step - index)
        if "SINE" in self.motion:
            amplitude, period = self.motion["SINE"]
            omega = 2.0 * math.pi / period
            speed = amplitude / omega
            return speed * (1.0 - math.cos(omega * t)), speed * (t - math.sin(omega * t) / omega)
        amplitude, period, centre = self.motion["RICKER"]
        now, first = (math.exp(-((math.pi * (at - centre) / period) ** 2)) for at in (t, 0.0))
        width = 0.5 * (period / math.pi) ** 2
        return (
            amplitude * ((t - centre) * now + centre * first),
            amplitude * (width * (first - now) + centre * first * t),
        )


def over_line(start, first, last, step, share):
    """Velocity and displacement after a share of a step in which the acceleration is a straight line."""
    v, d = start
    t, rise = share * step, share * (last - first)
    return v + t * (first + 0.5 * rise), d + t * (v + t * (0.5 * first + rise / 6.0))


def motion_of(name):
    return globals() if name is None else vars(name)


class Grounds:
    """Grounds that move apart: every support moves with that of its building.

    The handler Plain leaves supports where they are put, and takes a step back where it fails. Masses stand on none of them, so
    that their accelerations do not matter."""

    def __init__(self):
        self.paths = [Path(motion_of(motion), arrival) for motion, arrival in GROUNDS]
        self.supports = []
        for building in BUILDINGS[: len(GROUNDS)]:
            first, last = building["nodes"]
            self.supports.append([tag for tag in FIXED_ALONG if first <= tag <= last])

    def move_to(self, time):
        for path, supports in zip(self.paths, self.supports):
            velocity, displacement = path.at(time)
            for tag in supports:
                ops.setNodeDisp(tag, 1, displacement)
                ops.setNodeVel(tag, 1, velocity)

    def displacements(self, time):
        """Of the ground of every building."""
        return [path.at(time)[1] for path in self.paths] or [0.0] * len(BUILDINGS)


def acceleration_at(motion, time):
    """Of a ground motion, its factor included."""
    if time < 0.0 or time > motion["DURATION"] and "RECORD" not in motion:
        return 0.0
    if "SINE" in motion:
        amplitude, period = motion["SINE"]
        value = amplitude * math.sin(2.0 * math.pi * time / period)
    else:
        step, values = ground_values(motion)
        index = int(time / step)
        share = time / step - index
        pair = (values + [0.0, 0.0])[index : index + 2] if index < len(values) else (0.0, 0.0)
        value = pair[0] + share * (pair[1] - pair[0])
    return motion["MOTION_FACTOR"] * value


def ground_acceleration(building, time):
    """Along x and across, under a building."""
    if GROUNDS:
        name, arrival = GROUNDS[building]
        return acceleration_at(motion_of(name), time - arrival), 0.0
    if not IN_PLAN:
        return acceleration_at(globals(), time), 0.0
    x = y = 0.0
    motions = [(globals(), globals().get("ANGLE", 0.0))]
    if "ACROSS" in globals():
        motions.append((vars(ACROSS), ANGLE + 0.5 * math.pi))
    for motion, angle in motions:
        value = acceleration_at(motion, time)
        x, y = x + value * math.cos(angle), y + value * math.sin(angle)
    return x, y


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
    """Ground motion, and the accelerations that belong to its first value."""
    shake_upwards()
    if GROUNDS:
        return
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
            start_with(direction, -value, {tag for tag, *_ in NODES})


def start_with(direction, value, among):
    """Accelerations of masses, and of what moves with them."""
    resting = {tag for tag, *held in SUPPORTS if held[direction - 1]}
    resting |= {tag for tag, own in HELD if own == direction}
    heavy = {tag for tag, _, _, mass, _ in NODES if mass}
    heavy |= {tied for kept, tied, *directions in TIES if direction in directions}
    heavy |= {tied for kept, tied in ARMS}
    for tag in (heavy - resting) & among:
        ops.setNodeAccel(tag, direction, value, "-commit")


def shake_upwards():
    """Vertical shaking, as loads -m a on masses: vertical displacements are relative to the ground of each building."""
    for number, (building, shaken) in enumerate(zip(BUILDINGS, VERTICAL), start=101):
        if shaken is None:
            continue
        name, arrival = shaken
        motion = motion_of(name)
        step, values = ground_values(motion)
        values = values[: math.floor(motion["DURATION"] / step * (1.0 + 1e-12)) + 1]
        factor = motion["MOTION_FACTOR"]
        ops.timeSeries("Path", number, "-dt", step, "-values", *values, "-factor", factor, "-startTime", arrival)
        ops.pattern("Plain", number, number)
        first, last = building["nodes"]
        own = [(tag, mass) for tag, _, _, mass, _ in NODES if mass and first <= tag <= last]
        for tag, mass in own:
            ops.load(tag, 0.0, -mass, 0.0)
        if arrival == 0.0 and values[0]:
            start_with(2, -values[0] * factor, {tag for tag, _ in own})
