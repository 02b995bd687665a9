def load_by_weight(axial):
    """Every building that starts under its weight gets it, and settles."""
    weights = {tag: mass * GRAVITY for tag, _, _, mass, _ in NODES if not IN_PLAN}
    for tag, mass, load in CARRIED:
        weights[tag] = weights.get(tag, 0.0) + mass * GRAVITY + load
    standing = [range(first, last + 1) for first, last in (building["nodes"] for building in BUILDINGS if building["weight"])]
    weights = {tag: weight for tag, weight in weights.items() if weight and any(tag in nodes for nodes in standing)}
    if not weights:
        return
    prepare(axial)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for tag, weight in weights.items():
        ops.load(tag, *((0.0, 0.0, -weight, 0.0, 0.0, 0.0) if IN_SPACE else (0.0, -weight, 0.0)))
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


def prepare(axial):
    """Everything that an analysis needs apart from the algorithm and the integrator. To be called once: a second
    SparseSYM brings the program down."""
    if IN_PLAN:
        # Points follow their floor by levers, which Plain cannot do.
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("ProfileSPD")
    elif axial == "ties":
        # SparseSYM (SparseSPD) and equalDOF together give wrong answers without an error. Transformation does not take
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


class Run:
    """Steps taken, and how."""

    def __init__(self, watch, grounds):
        self.watch, self.grounds, self.panels = watch, grounds, Panels()
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
        status = self.step_by(step)
        self.steps += 1
        self.short_steps += short
        self.iterations += 1 if self.way == "linear" else ops.testIter()
        if status != 0:
            self.failures += 1
            if not self.rescue(step):
                return False
        self.watch.changed |= self.panels.drop()
        return True

    def renew(self, algorithm):
        """A fresh analysis from the last step that converged, which Transformation by itself does not go back to."""
        if IN_PLAN:
            ops.wipeAnalysis()
            prepare("ties")
            integrate()
        self.use(algorithm)
        if IN_PLAN:
            ops.analysis("Transient")

    def step_by(self, step):
        self.grounds.move_to(ops.getTime() + step)
        return ops.analyze(1, step)

    def rescue(self, step):
        """A step that did not converge, in parts with a fresh tangent at every iteration."""
        way = self.way
        self.renew("newton")

        def advance(part):
            done = self.step_by(part) == 0
            if not done:
                self.renew("newton")
            return done

        done = in_parts(advance, step)
        self.use(way)
        if not done:
            print(f"stopped at {ops.getTime():.6g} s of the motion: a step of {step:g} s does not converge, not even in "
                  "parts; try another with --free, or see --log FILE for what OpenSees says", file=sys.stderr)
        return done


class Peaks:
    """Greatest displacements relative to the ground of each building, where OpenSees' own recorders do not have them: those of floors
    on grounds that move apart, of foundations, and of what can lift off."""

    def __init__(self, grounds):
        self.grounds = grounds
        self.followed = []
        for index, building in enumerate(BUILDINGS):
            if GROUNDS:
                self.followed += [(tag, 1, index) for tag in building["floors"]]
            if "foundation" in building:
                self.followed += [(building["foundation"], direction, index) for direction in (1, 3)]
        self.of = {(tag, direction): [0.0, 0.0] for tag, direction, _ in self.followed}
        self.footings = {footing: [0.0, 0.0] for building in BUILDINGS for footing in footings_of(building)}
        self.follow_footings()

    def follow_footings(self):
        for footing, low_high in self.footings.items():
            if IN_PLAN:
                risen = [ops.nodeDisp(point, 3) for point in footing]
            else:
                tag, *arms = footing
                risen = [ops.nodeDisp(tag, 2) + arm * ops.nodeDisp(tag, 3) for arm in arms]
            low_high[0], low_high[1] = min(low_high[0], *risen), max(low_high[1], *risen)

    def follow(self):
        self.follow_footings()
        if not self.followed:
            return
        grounds = self.grounds.displacements(ops.getTime())
        for tag, direction, index in self.followed:
            value = ops.nodeDisp(tag, direction) - (grounds[index] if direction == 1 else 0.0)
            low_high = self.of[tag, direction]
            low_high[0], low_high[1] = min(low_high[0], value), max(low_high[1], value)


def integrate():
    ops.integrator("Newmark", 0.5, 0.25)


def footings_of(building):
    """What can lift off: its node and the distances of its outermost contact springs, in plan the points of all."""
    return building.get("footings", []) + ([tuple(building["bed"])] if "bed" in building else [])


def march(args, duration):
    """Runs through the motion; returns what was counted."""
    watch, grounds = Watch(), Grounds()
    run, peaks = Run(watch, grounds), Peaks(grounds)
    integrate()
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
            peaks.follow()
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
                    peaks.follow()
            else:
                complete = run.advance(free, False)
                watch.count(watch.closings(), True)
                peaks.follow()
            if not complete:
                break
    return watch, run, peaks, complete, time.process_time() - cpu, time.perf_counter() - wall


# What is recorded of links: file, response, and whether they stand on a foundation that turns.
LINK_FORCES = (("links", "localForce", False), ("turning links", "basicForce", True))


def envelopes(folder):
    """Greatest displacements of floors and forces of contacts, kept by OpenSees itself."""
    floors = [tag for building in BUILDINGS for tag in building["floors"]]
    directions = [1, 2, TURN] if IN_PLAN else [1]
    ops.recorder("EnvelopeNode", "-file", os.path.join(folder, "floors"), "-precision", 12, "-node", *floors, "-dof", *directions, "disp")
    if CONTACTS and not IN_PLAN:
        elements = [row[0] for row in CONTACTS]
        ops.recorder("EnvelopeElement", "-file", os.path.join(folder, "forces"), "-precision", 12, "-ele", *elements, "localForce")
    for name, force, turning in LINK_FORCES:
        elements = [row[0] for row in LINKS if row[-1] == turning]
        if elements:
            ops.recorder("EnvelopeElement", "-file", os.path.join(folder, name), "-precision", 12, "-ele", *elements, force)
    if FIBRE_ENDS:
        elements = [row[0] for row in FIBRE_ENDS]
        ops.recorder("EnvelopeElement", "-file", os.path.join(folder, "sections"), "-precision", 12, "-ele", *elements, "section", "force")
    if VERTICAL:
        tags = [tag for masses in masses_of_floors() for tag in masses]
        ops.recorder("EnvelopeNode", "-file", os.path.join(folder, "vertical"), "-precision", 12, "-node", *tags, "-dof", 2, "disp")


def forces_of_sections(folder):
    """Greatest forces of fibres of every end: axial, positive in tension, and moments, as jostle counts them."""
    low, high, _ = read(folder, "sections")
    both = list(zip(low, high))
    keys = [("axial", "n", 1.0), ("moment", "n_m", 1.0)]
    if IN_SPACE:
        keys.append(("moment_across", "n_m", -1.0))
    # Torsion comes last.
    count = len(keys) + IN_SPACE
    found = {}
    for place, (tag, *_) in enumerate(FIBRE_ENDS):
        own = found[tag] = {}
        for (key, unit, sign), extremes in zip(keys, both[count * place :]):
            least, most = sorted(sign * value for value in extremes)
            own.update({f"{key}_max_{unit}": most, f"{key}_min_{unit}": least})
    return found


def masses_of_floors():
    """Nodes with mass at the height of every floor that can move vertically, building by building."""
    held = {tag for tag, *fixed in SUPPORTS if fixed[1]} | {tag for tag, direction in HELD if direction == 2}
    height = {tag: y for tag, _, y, *_ in NODES}
    for building in BUILDINGS:
        first, last = building["nodes"]
        own = [tag for tag, _, _, mass, _ in NODES if mass and first <= tag <= last and tag not in held]
        for floor in building["floors"]:
            yield [tag for tag in own if abs(height[tag] - height[floor]) < 1e-6]


def read(folder, name):
    with open(os.path.join(folder, name)) as file:
        return [[float(value) for value in line.split()] for line in file]


def modes(args):
    """Natural periods, longest first [s]."""
    build("ties")
    join_buildings()
    prepare("ties")
    try:
        values = ops.eigen("-genBandArpack", args.modes)
    except Exception:
        # ARPACK makes more vectors than modes are asked for, twice as many or eight more, and stops where fewer masses move.
        build("ties")
        join_buildings()
        prepare("ties")
        heavy = sum(1 for row in NODES for mass in (row[3], row[3], row[4]) if mass)
        values = ops.eigen("-fullGenLapack", min(args.modes, heavy))
    # Of displacements without mass LAPACK finds infinite ones.
    return [2.0 * math.pi / math.sqrt(value) for value in values if 0.0 < value < 1e20]


def analyse(args):
    duration = args.duration or DURATION
    build(args.axial)
    load_by_weight(args.axial)
    join_buildings()
    prepare(args.axial)
    shake()
    with tempfile.TemporaryDirectory() as folder:
        envelopes(folder)
        watch, run, peaks, complete, cpu, wall = march(args, duration)
        equations = ops.systemSize()
        reached = ops.getTime()
        ops.wipe()
        low, high, _ = read(folder, "floors")
        forces = [-force for force in watch.force]
        if CONTACTS and not IN_PLAN:
            forces = read(folder, "forces")[0]
        vertical = iter(read(folder, "vertical")[2] if VERTICAL else [])
        sections = forces_of_sections(folder) if FIBRE_ENDS else {}
        pulls = {}
        for name, _, turning in LINK_FORCES:
            elements = [row[0] for row in LINKS if row[-1] == turning]
            pulls.update(zip(elements, read(folder, name)[2] if elements else []))
    peaks_of_floors = iter(zip(high, low))
    floors_of_masses = masses_of_floors()
    buildings = []
    for building in BUILDINGS:
        floors = []
        first = 0 if building.get("has_mat") else 1
        for number, (tag, (right, left)) in enumerate(zip(building["floors"], peaks_of_floors), start=first):
            if GROUNDS:
                left, right = peaks.of[tag, 1]
            floors.append({"floor": number, "displacement_max_m": right, "displacement_min_m": left})
            if VERTICAL:
                peak = max((next(vertical) for _ in next(floors_of_masses)), default=0.0)
                floors[-1]["vertical_displacement_peak_m"] = peak
            if IN_PLAN:
                for key in ("displacement_across", "rotation"):
                    unit = "rad" if key == "rotation" else "m"
                    floors[-1][f"{key}_max_{unit}"], floors[-1][f"{key}_min_{unit}"] = next(peaks_of_floors)
        buildings.append({"name": building["name"], "floors": floors})
        first, last = building["nodes"]
        own = [{"name": row[-1], **sections[row[0]]} for row in FIBRE_ENDS if first <= row[1] <= last]
        if own:
            buildings[-1]["sections"] = own
        if "foundation" in building:
            sway, rocking = (peaks.of[building["foundation"], direction] for direction in (1, 3))
            buildings[-1]["foundation"] = {
                "sway_max_m": sway[1],
                "sway_min_m": sway[0],
                "rocking_max_rad": rocking[1],
                "rocking_min_rad": rocking[0],
            }
        risen = [peaks.footings[footing] for footing in footings_of(building)]
        if risen:
            buildings[-1]["footings"] = [{"uplift_m": max(0.0, high), "sinking_m": max(0.0, -low)} for low, high in risen]
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
    for tag, _, _, _, number, floors, height, _ in LINKS:
        links.append({"link": number, "floors": list(floors), "height_m": height, "peak_force_n": pulls[tag]})
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
        **({"fallen_s": [run.panels.fallen.get(number) for number in range(len(FALLING))]} if FALLING else {}),
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
    used = [material for *_, springs, _ in (*SPRINGS, *TILTED_STOREYS) for _, material in springs] + [row[3] for row in LINKS]
    used += [row[3] for row in (*LEVERED, *DIAGONALS)]
    used += [material for *_, springs in HINGED_ENDS for *_, material, _ in springs]
    used += [row[4] for row in UPRIGHT_SPRINGS]
    yields = bool(SLIDERS or FIBRE_ENDS) or any(MATERIALS[material - 1][0] != "Elastic" for material in used)
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
    if args.axial == "stiff" and any("foundation" in building for building in BUILDINGS):
        parser.error("--axial stiff: buildings on foundations need ties; leave it out")
    ops.logFile(args.log, "-noEcho")
    result = {"title": TITLE, "periods_s": modes(args)} if args.modes else analyse(args)
    json.dump(result, sys.stdout, indent=1)
    print()
    return 0 if result.get("complete", True) else 1


if __name__ == "__main__":
    sys.exit(main())
