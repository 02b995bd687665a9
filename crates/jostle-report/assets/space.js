// Buildings in space, drawn on a canvas without perspective: floors, contact points, forces, slip and the shaking ground.

/** A colour of the style sheet as the browser resolves it. */
function resolvedColour(name) {
  const probe = document.createElement("i");
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}

class SpaceScene {
  constructor(host) {
    this.host = host;
    this.canvas = html("canvas", "", undefined, host);
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", say("the_buildings_in_space"));
    this.time = 0;
    this.turn = -0.9;
    this.tilt = 0.5;
    this.zoom = 1;
    this.shown = true;
    this.lettered = true;
    this.take();
    this.exaggeration = this.suited();
    this.spread();
    this.ended = new AbortController();
    this.bind();
    this.watchers = [
      new ResizeObserver(() => this.layout()),
      new IntersectionObserver(([entry]) => {
        this.shown = entry.isIntersecting;
        this.draw(this.time);
      }),
    ];
    for (const watcher of this.watchers) watcher.observe(host);
  }

  /** Shows another run, seen from the same side. */
  refresh() {
    this.take();
    this.spread();
    this.layout();
  }

  /** Leaves the page, with what listens for it. */
  remove() {
    this.ended.abort();
    for (const watcher of this.watchers) watcher.disconnect();
    this.canvas.remove();
  }

  take() {
    this.buildings = page.buildings.map((building, i) => ({
      plans: building.plans,
      mat: building.mat,
      members: (building.members ?? []).map((member, k) => ({ ...member, hinges: hinges.filter((hinge) => hinge.building === i && hinge.line === k + 1) })),
      diagonals: (building.diagonals ?? []).filter((own) => own.ends),
      levels: [0, ...building.heights],
      // A mat is the floor before the first one.
      matMotion: building.mat && ["u", "v", "r"].map((name) => run.columns.get(`${name}:${i}:0`)),
      motion: building.plans.map((_, k) => ["u", "v", "r"].map((name) => run.columns.get(`${name}:${i}:${k + 1}`))),
    }));
    this.places = contacts.filter((contact) => contact.plan);
    this.impacts = this.places.map((contact) => page.impacts.filter((impact) => impact.contact === contact.index));
    this.hardest = Math.max(1e-9, ...page.impacts.map((impact) => impact.peak));
    const all = page.buildings.flatMap((building) => building.plans.flatMap((plan) => plan.corners));
    const range = (axis) => [Math.min(...all.map((p) => p[axis])), Math.max(...all.map((p) => p[axis]))];
    [this.x, this.y] = [range(0), range(1)];
    this.top = Math.max(...page.buildings.flatMap((building) => building.heights));
    this.size = Math.hypot(this.x[1] - this.x[0], this.y[1] - this.y[0]);
    const moves = this.buildings.flatMap((building) => building.motion.flatMap(([u, v]) => [u, v].filter(Boolean).map(greatest)));
    this.peak = Math.max(1e-9, ...moves);
    this.across = page.bearing?.across && { time: unpack(page.bearing.across.time), values: unpack(page.bearing.across.values) };
    this.groundPeak = Math.hypot(greatest(ground.values), this.across ? greatest(this.across.values) : 0) || 1;
    // A moat wall before a mat stands below the ground, as deep as a part of a storey.
    const inMoat = this.places.some((contact) => contact.gap.between.includes(null) && !(contact.height > 0));
    this.depth = inMoat ? 0.4 * Math.min(...page.buildings.map((building) => building.heights[0])) : 0;
    this.theme = null;
  }

  /** A round exaggeration that makes motions easy to see. */
  suited() {
    const wanted = (0.05 * this.size) / this.peak;
    return [1, 2, 5, 10, 20, 50, 100, 200].findLast((f) => f <= wanted) ?? 1;
  }

  /** Moves buildings apart, so that gaps are as exaggerated as displacements: along the gaps, from the first building on. */
  spread() {
    this.shifts = page.buildings.map(() => null);
    this.shifts[0] = [0, 0];
    for (let again = true; again; ) {
      again = false;
      for (const contact of this.places) {
        const [a, b] = contact.gap.between;
        if (a === null || b === null) continue;
        const more = (this.exaggeration - 1) * contact.width;
        const apart = contact.plan.normal.map((n) => n * more);
        const [from, to, sign] = this.shifts[a] && !this.shifts[b] ? [a, b, 1] : this.shifts[b] && !this.shifts[a] ? [b, a, -1] : [];
        if (sign === undefined) continue;
        this.shifts[to] = this.shifts[from].map((s, axis) => s + sign * apart[axis]);
        again = true;
      }
      if (!again && this.shifts.includes(null)) {
        this.shifts[this.shifts.indexOf(null)] = [0, 0];
        again = true;
      }
    }
  }

  bind() {
    const canvas = this.canvas;
    const pointers = new Map();
    const apart = () => {
      const [a, b] = [...pointers.values()];
      return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const distance = pointers.size === 2 ? apart() : 0;
      pointers.set(event.pointerId, event);
      if (pointers.size === 2) this.scaleBy(apart() / Math.max(distance, 1));
      else this.rotate((event.clientX - before.clientX) * 0.008, (event.clientY - before.clientY) * 0.008);
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
    canvas.addEventListener(
      "wheel",
      (event) => {
        // As for charts: without focus the wheel scrolls the page.
        if (document.activeElement !== canvas && !event.ctrlKey && !event.shiftKey) return;
        event.preventDefault();
        this.scaleBy(Math.exp(-0.001 * event.deltaY));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.08], ArrowDown: [0, 0.08] }[event.key];
      if (step) {
        event.preventDefault();
        this.rotate(...step);
      } else if (event.key === "+" || event.key === "-") this.scaleBy(event.key === "+" ? 1.15 : 1 / 1.15);
    });
    const own = { signal: this.ended.signal };
    byId("space-above").addEventListener("click", () => this.look(0, Math.PI / 2), own);
    byId("space-side").addEventListener("click", () => this.look(0, 0), own);
    byId("space-oblique").addEventListener("click", () => this.look(-0.9, 0.5), own);
    const slider = byId("space-exaggeration");
    const tell = () => (byId("space-exaggeration-value").textContent = `${this.exaggeration < 10 ? Number(this.exaggeration.toFixed(1)) : Math.round(this.exaggeration)}×`);
    slider.value = Math.log10(this.exaggeration);
    tell();
    slider.addEventListener("input", () => {
      this.exaggeration = 10 ** Number(slider.value);
      tell();
      this.spread();
      this.layout();
    }, own);
    byId("space-names").addEventListener("change", (event) => {
      this.lettered = event.target.checked;
      this.draw(this.time);
    }, own);
  }

  rotate(turn, tilt) {
    this.look(this.turn + turn, this.tilt + tilt);
  }

  look(turn, tilt) {
    this.turn = turn;
    this.tilt = Math.min(Math.max(tilt, 0), Math.PI / 2);
    this.layout();
  }

  scaleBy(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.4), 12);
    this.layout();
  }

  /** Sizes the canvas, and the site to it. */
  layout() {
    const width = TimeChart.paperWidth ?? Math.max(this.host.clientWidth, 240);
    const height = Math.min(width < 600 ? 340 : 480, Math.max(0.62 * width, 240));
    const dots = Math.min(devicePixelRatio || 1, 2);
    if (this.canvas.width !== Math.round(width * dots) || this.canvas.height !== Math.round(height * dots)) {
      this.canvas.width = Math.round(width * dots);
      this.canvas.height = Math.round(height * dots);
      this.canvas.style.height = `${height}px`;
    }
    Object.assign(this, { width, height, dots });
    const moved = (axis) => this.shifts.map((shift) => shift[axis]);
    const ends = [this.x, this.y].map(([low, high], axis) => [low + Math.min(...moved(axis)), high + Math.max(...moved(axis))]);
    this.middle = ends.map(([low, high]) => (low + high) / 2);
    // The box of the site, its corners all around, as seen.
    // Half of it: peaks are rare, and a picture in the middle of a wide margin is small.
    const free = 0.5 * this.exaggeration * this.peak;
    const corners = ends[0].flatMap((x, i) => ends[1].flatMap((y, j) => [-this.depth, this.top].map((z) => [x + (i ? free : -free), y + (j ? free : -free), z])));
    this.scale = 1;
    this.centre = [0, 0];
    const seen = corners.map((corner) => this.project(corner));
    const [xs, ys] = [seen.map((p) => p[0]), seen.map((p) => p[1])];
    const [wide, tall] = [xs, ys].map((values) => Math.max(...values) - Math.min(...values));
    this.scale = this.zoom * Math.min((width - 60) / wide, (height - 76) / tall);
    this.centre = [xs, ys].map((values) => (this.scale * (Math.max(...values) + Math.min(...values))) / 2);
    this.draw(this.time);
  }

  /** Place on the canvas and distance towards the eye of a point of the site. */
  project([x, y, z]) {
    const [dx, dy] = [x - this.middle[0], y - this.middle[1]];
    const [ct, st] = [Math.cos(this.turn), Math.sin(this.turn)];
    const [cu, su] = [Math.cos(this.tilt), Math.sin(this.tilt)];
    const right = ct * dx - st * dy;
    const away = st * dx + ct * dy;
    const up = su * away + cu * z;
    const near = -cu * away + su * z;
    return [this.scale * right, -this.scale * up, near];
  }

  /** The same, placed in the middle of the canvas. */
  at(point) {
    const [x, y, near] = this.project(point);
    return [this.width / 2 + x - this.centre[0], this.height / 2 + y - this.centre[1] + 8, near];
  }

  /** Displacement along x and across, and rotation, of a floor now. */
  floorNow(building, floor) {
    const { motion, matMotion } = this.buildings[building];
    return (floor < 0 ? matMotion : motion[floor]).map((values) => (values ? interpolate(run.time, values, this.time) : 0));
  }

  /** The same from the floors of all buildings now; those of mats are not among them. */
  floorIn(state, building, floor) {
    return floor < 0 ? this.floorNow(building, floor) : state[building][floor];
  }

  /** Displacement of a point of a floor [m]. */
  displaced(state, building, floor, [x, y]) {
    const { plans, mat } = this.buildings[building];
    const [cx, cy] = (floor < 0 ? mat : plans[floor]).centre;
    const [u, v, r] = this.floorIn(state, building, floor);
    return [u - r * (y - cy), v + r * (x - cx)];
  }

  /** The same between floors, on a straight line [m]. */
  betweenFloors(state, building, level, point) {
    const { levels, mat } = this.buildings[building];
    const height = level - (page.buildings[building].elevation ?? 0);
    const upper = levels.findIndex((floor, i) => i > 0 && floor >= height - 1e-3) - 1;
    if (upper < 0) return [0, 0];
    const part = (height - levels[upper]) / (levels[upper + 1] - levels[upper]);
    const above = this.displaced(state, building, upper, point);
    const below = upper > 0 || mat ? this.displaced(state, building, upper - 1, point) : [0, 0];
    return [0, 1].map((axis) => part * above[axis] + (1 - part) * below[axis]);
  }

  /** A point of a column between floors as drawn. */
  onColumn(contact, building, [x, y], state) {
    const [u, v] = this.betweenFloors(state, building, contact.height, [x, y]);
    const [sx, sy] = this.shifts[building];
    return [sx + x + this.exaggeration * u, sy + y + this.exaggeration * v, contact.height - (page.buildings[building].elevation ?? 0)];
  }

  /** A point of a floor as drawn, at its height. */
  moved(building, floor, [x, y], [u, v, r]) {
    const { plans, mat, levels } = this.buildings[building];
    const [cx, cy] = (floor < 0 ? mat : plans[floor]).centre;
    const f = this.exaggeration;
    const [sx, sy] = this.shifts[building];
    return [sx + x + f * (u - r * (y - cy)), sy + y + f * (v + r * (x - cx)), levels[floor + 1]];
  }

  draw(t) {
    this.time = t;
    if (!this.width || !(this.shown || TimeChart.paperWidth)) return;
    const theme = `${TimeChart.paperWidth} ${document.documentElement.dataset.theme} ${matchMedia("(prefers-color-scheme: dark)").matches}`;
    if (theme !== this.theme) {
      this.theme = theme;
      this.colours = page.buildings.map((_, i) => resolvedColour(`--c${i % 7}`));
      [this.ink, this.quiet, this.alarm, this.sheet] = ["--ink", "--ink-2", "--alarm", "--sheet"].map(resolvedColour);
      [this.cracked, this.yielded] = ["--cracked", "--yielded"].map(resolvedColour);
    }
    const context = this.canvas.getContext("2d");
    this.context = context;
    context.setTransform(this.dots, 0, 0, this.dots, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.lineJoin = "round";
    const state = this.buildings.map((building, i) => building.plans.map((_, k) => this.floorNow(i, k)));
    const parts = [];
    this.written = [];
    this.names = [];
    this.buildings.forEach((building, i) => this.buildingParts(building, i, state[i], parts));
    // From behind to the front.
    parts.sort((a, b) => a.near - b.near);
    this.groundArrow();
    for (const part of parts) part.paint();
    // Over forces, which would cover names.
    this.contactMarks(state);
    for (const [name, [x, y]] of this.names) this.letter(name, x, y, this.ink, "650 14px system-ui, sans-serif");
    context.fillStyle = this.quiet;
    context.font = "14px system-ui, sans-serif";
    context.textAlign = "left";
    context.fillText(`t = ${fixed(t, 3)} s`, 12, 22);
    this.axes();
  }

  line(points, { fill, stroke, width = 1.2, alpha = 1, closed = false, dash = [] }) {
    const context = this.context;
    context.beginPath();
    points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
    if (closed) context.closePath();
    if (fill) {
      context.globalAlpha = alpha;
      context.fillStyle = fill;
      context.fill();
      context.globalAlpha = 1;
    }
    if (stroke) {
      context.setLineDash(dash);
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.stroke();
      context.setLineDash([]);
    }
  }

  /** Footprint, columns storey by storey, those of a space frame or at the corners, and floors, each with its distance. */
  buildingParts(building, i, state, parts) {
    const colour = this.colours[i];
    const [sx, sy] = this.shifts[i];
    const mean = (points) => points.reduce((sum, p) => sum + p[2], 0) / points.length;
    const foot = building.plans[0].corners.map(([x, y]) => this.at([sx + x, sy + y, 0]));
    parts.push({ near: mean(foot) - 1e6, paint: () => this.line(foot, { stroke: colour, width: 1, dash: [4, 3], closed: true }) });
    let below = building.plans[0].corners.map(([x, y]) => [sx + x, sy + y, 0]);
    if (building.mat) {
      below = building.mat.corners.map((corner) => this.moved(i, -1, corner, this.floorNow(i, -1)));
      const seen = below.map((point) => this.at(point));
      parts.push({ near: mean(seen) - 1e5, paint: () => this.line(seen, { fill: colour, alpha: 0.25, stroke: colour, width: 1.6, closed: true }) });
    }
    building.plans.forEach((plan, k) => {
      const own = plan.corners.map((corner) => this.moved(i, k, corner, state[k]));
      const seen = own.map((point) => this.at(point));
      if (building.members.length === 0 && own.length === below.length) {
        own.forEach((point, c) => {
          const ends = [this.at(below[c]), seen[c]];
          parts.push({ near: mean(ends), paint: () => this.line(ends, { stroke: colour, width: 1.6 }) });
        });
      }
      parts.push({ near: mean(seen), paint: () => this.line(seen, { fill: colour, alpha: 0.22, stroke: colour, width: 1.8, closed: true }) });
      below = own;
    });
    // Braces of a space frame as lines between joints, its infill panels as shaded bays: both struts of a panel lie in one.
    const joint = ([x, y], level) => this.at(level > 0 ? this.moved(i, level - 1, [x, y], state[level - 1]) : building.mat ? this.moved(i, -1, [x, y], this.floorNow(i, -1)) : [sx + x, sy + y, 0]);
    for (const { ends, storey, infill, lines, until } of building.diagonals) {
      if ((infill && lines[0] > lines[1]) || this.time >= until) continue;
      const [low, high] = ends;
      const seen = infill
        ? [joint(low, storey - 1), joint(high, storey - 1), joint(high, storey), joint(low, storey)]
        : [joint(low, storey - 1), joint(high, storey)];
      const look = infill ? { fill: this.quiet, alpha: 0.18, closed: true } : { stroke: colour, width: 1.4, dash: [5, 3] };
      parts.push({ near: mean(seen), paint: () => this.line(seen, look) });
    }
    // Columns and beams of a space frame, and its walls from face to face.
    for (const { ends, floors, hinges: own, wall } of building.members) {
      const place = (end, side) => this.at(floors[side] === null || floors[side] === undefined ? [sx + end[0], sy + end[1], 0] : this.moved(i, floors[side], end, state[floors[side]]));
      const seen = ends.map(place);
      if (wall) {
        const corner = (side, sign) => place([ends[side][0] + sign * wall[0], ends[side][1] + sign * wall[1]], side);
        const face = [corner(0, -1), corner(0, 1), corner(1, 1), corner(1, -1)];
        parts.push({ near: mean(face), paint: () => this.line(face, { fill: colour, alpha: 0.35, stroke: colour, width: 1.4, closed: true }) });
      } else {
        const isColumn = floors[0] !== floors[1];
        parts.push({ near: mean(seen), paint: () => this.line(seen, { stroke: colour, width: isColumn ? 1.8 : 1.1 }) });
      }
      // The worse of both planes of a column.
      for (const end of [0, 1]) {
        const stage = Math.max(0, ...own.filter((hinge) => hinge.end === end).map((hinge) => stageAt(hinge, this.time)));
        if (stage > 0) parts.push({ near: seen[end][2] + 0.01, paint: () => this.hingeMark(stage, seen[end], seen[1 - end]) });
      }
    }
    const roof = building.plans.length - 1;
    const [cx, cy] = building.plans[roof].centre;
    const name = this.at(this.moved(i, roof, [cx, cy], state[roof]));
    parts.push({
      near: 1e6,
      paint: () => this.names.push([page.buildings[i].name, name]),
    });
  }

  /** A disc where a member has cracked, a diamond where it yields, beside its joint. */
  hingeMark(stage, [x0, y0], [x1, y1]) {
    const share = Math.min(0.25, 9 / Math.max(1, Math.hypot(x1 - x0, y1 - y0)));
    const [x, y] = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
    const mark = new Path2D(markOutline(stage, x, y, 3.2));
    const context = this.context;
    context.fillStyle = stage === 2 ? this.yielded : this.cracked;
    context.strokeStyle = this.ink;
    context.lineWidth = 0.8;
    context.fill(mark);
    context.stroke(mark);
  }

  /** A text, above what is written there already. */
  letter(text, x, y, colour, font = "12px system-ui, sans-serif", align = "center") {
    const context = this.context;
    context.font = font;
    context.textAlign = align;
    const wide = context.measureText(text).width;
    const left = align === "center" ? x - wide / 2 : x;
    const covers = (other) => other.left < left + wide && left < other.left + other.wide && Math.abs(other.y - y) < 15;
    while (y > 15 && this.written.some(covers)) y -= 3;
    this.written.push({ left, wide, y });
    context.lineWidth = 3;
    context.strokeStyle = this.sheet;
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  arrow(from, to, colour, width) {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const length = Math.hypot(dx, dy);
    if (length < 2) return;
    const [ux, uy] = [dx / length, dy / length];
    const head = Math.min(9, 0.6 * length);
    this.line([from, [to[0] - 0.8 * head * ux, to[1] - 0.8 * head * uy]], { stroke: colour, width });
    const back = [to[0] - head * ux, to[1] - head * uy];
    const wing = [-0.45 * head * uy, 0.45 * head * ux];
    this.line([to, [back[0] + wing[0], back[1] + wing[1]], [back[0] - wing[0], back[1] - wing[1]]], { fill: colour, closed: true });
  }

  /** Contact points, and on closed contacts forces on both buildings, normals and slip. */
  contactMarks(state) {
    const labels = [];
    this.places.forEach((contact, index) => {
      const { at, normal, length } = contact.plan;
      const [a, b] = contact.gap.between;
      const along = [-normal[1], normal[0]];
      const onSide = (building, side, point) => {
        if (building === null) return this.onWall(contact, side, point);
        const floor = contact.floors[side];
        if (floor === null) return this.onColumn(contact, building, point, state);
        return this.moved(building, floor - 1, point, this.floorIn(state, building, floor - 1));
      };
      const sides = (point) => [onSide(a, 0, point), onSide(b, 1, point)];
      const ends = length > 0 ? [-0.5, 0.5].map((s) => [at[0] + s * length * along[0], at[1] + s * length * along[1]]) : [at];
      for (const side of [0, 1]) {
        const points = ends.map((point) => this.at(sides(point)[side]));
        if ([a, b][side] === null && points.length > 1) {
          // A wall, from the ground or the bottom of the moat up to the contact.
          const bottom = contact.height > 0 ? 0 : -this.depth;
          const feet = ends.map((point) => this.at([...sides(point)[side].slice(0, 2), bottom]));
          this.line([...points, feet[1], feet[0]], { fill: this.quiet, alpha: 0.25, stroke: this.quiet, width: 1, closed: true });
        }
        if (points.length > 1) this.line(points, { stroke: this.alarm, width: 1.4 });
        for (const [x, y] of points) this.dot(x, y, 2.2);
      }
      // The normal, from the first building to the second.
      const foot = sides(at)[0];
      const ahead = 0.05 * this.size;
      this.arrow(this.at(foot), this.at([foot[0] + ahead * normal[0], foot[1] + ahead * normal[1], foot[2]]), this.quiet, 1);
      const series = forces[contact.index];
      const force = series?.time.length ? Math.max(0, interpolate(series.time, series.values, this.time)) : 0;
      if (!(force > 0.002 * this.hardest)) return;
      const now = this.impacts[index].find((impact) => impact.start <= this.time && this.time <= impact.end);
      const centre = now?.centre ?? at;
      const reach = (0.06 + 0.2 * Math.sqrt(force / this.hardest)) * this.size;
      const [onA, onB] = sides(centre);
      const shifted = (point, sign) => [point[0] + sign * reach * normal[0], point[1] + sign * reach * normal[1], point[2]];
      // The force on the first building points against the normal.
      this.arrow(this.at(onA), this.at(shifted(onA, -1)), this.alarm, 2.6);
      this.arrow(this.at(onB), this.at(shifted(onB, 1)), this.alarm, 2.6);
      const slip = this.slip(contact, centre, state);
      const slipped = onA.map((value, axis) => value + (axis < 2 ? this.exaggeration * slip * along[axis] : 0));
      this.line([this.at(onA), this.at(slipped)], { stroke: this.ink, width: 3 });
      const [x, y] = this.at(onB);
      this.dot(x, y, 4);
      labels.push([`${readable(force * unitOf("kN").factor)} ${unitOf("kN").name}`, x, y]);
    });
    if (!this.lettered) return;
    // The lowest first: others make way upwards.
    labels.sort((p, q) => q[2] - p[2]);
    for (const [text, x, y] of labels) this.letter(text, x + 12, y - 12, this.alarm, "650 12px system-ui, sans-serif", "left");
  }

  /** A point of a wall, as far from the building before it as gaps are drawn. */
  onWall(contact, side, [x, y]) {
    const building = contact.gap.between[1 - side];
    const more = (side === 1 ? 1 : -1) * (this.exaggeration - 1) * contact.width;
    const [sx, sy] = this.shifts[building];
    return [sx + x + more * contact.plan.normal[0], sy + y + more * contact.plan.normal[1], contact.height];
  }

  dot(x, y, radius) {
    const context = this.context;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = this.alarm;
    context.fill();
  }

  /** How far the first building has moved along the face against the second since rest, at a point [m]. */
  slip(contact, point, state) {
    const [a, b] = contact.gap.between;
    const along = [-contact.plan.normal[1], contact.plan.normal[0]];
    const [own, other] = [a, b].map((building, side) => {
      // Walls stand on the ground.
      if (building === null) return 0;
      const floor = contact.floors[side];
      const [u, v] = floor === null ? this.betweenFloors(state, building, contact.height, point) : this.displaced(state, building, floor - 1, point);
      return along[0] * u + along[1] * v;
    });
    return own - other;
  }

  /** Ground acceleration as an arrow on the ground, from the middle of the site. */
  groundArrow() {
    const angle = page.bearing?.angle ?? 0;
    const first = interpolate(ground.time, ground.values, this.time);
    const second = this.across ? interpolate(this.across.time, this.across.values, this.time) : 0;
    const a = [first * Math.cos(angle) - second * Math.sin(angle), first * Math.sin(angle) + second * Math.cos(angle)];
    const reach = (0.35 * this.size) / this.groundPeak;
    const from = [this.middle[0], this.middle[1], 0];
    this.arrow(this.at(from), this.at([from[0] + reach * a[0], from[1] + reach * a[1], 0]), this.ink, 2);
  }

  /** Axes in the corner. */
  axes() {
    const corner = [46, this.height - 34];
    const origin = this.project([this.middle[0], this.middle[1], 0]);
    for (const [name, way] of [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]]) {
      const point = this.project([this.middle[0] + way[0], this.middle[1] + way[1], way[2]]);
      const [dx, dy] = [point[0] - origin[0], point[1] - origin[1]].map((value) => (28 * value) / this.scale);
      if (Math.hypot(dx, dy) < 4) continue;
      this.arrow(corner, [corner[0] + dx, corner[1] + dy], this.quiet, 1.2);
      this.letter(name, corner[0] + 1.35 * dx, corner[1] + 1.35 * dy + 4, this.quiet);
    }
  }
}
