// Paths of corners in plan: displacement across against displacement along x, with and without contact.

/** A list of values at the instants of a table for one corner: along x and across, in the unit of the page. */
function cornerPath(table, building, floor, corner) {
  const plan = page.buildings[building].plans[floor - 1];
  const [u, v, r] = ["u", "v", "r"].map((name) => table.columns.get(`${name}:${building}:${floor}`));
  if (!u || !v || !r) return null;
  const [dx, dy] = [0, 1].map((axis) => plan.corners[corner][axis] - plan.centre[axis]);
  const { factor } = unitOf("mm");
  return { x: u.map((value, i) => factor * (value - r[i] * dy)), y: v.map((value, i) => factor * (value + r[i] * dx)) };
}

/** One path, with a list of corners to choose from. */
class Orbit {
  constructor(host, building) {
    this.building = building;
    this.host = html("figure", "multiple orbit", undefined, host);
    const caption = html("figcaption", "", undefined, this.host);
    this.select = html("select", "", undefined, caption);
    this.select.setAttribute("aria-label", say("corner_title"));
    this.host.style.setProperty("--c", `var(--c${building % 7})`);
    const { name, plans } = page.buildings[building];
    for (let floor = plans.length; floor > 0; floor--) {
      plans[floor - 1].corners.forEach((_, corner) => this.select.append(new Option(say("corner_of_floor", { name, floor, corner: corner + 1 }), `${floor} ${corner}`)));
    }
    this.select.value = this.busiest(plans.length);
    this.select.addEventListener("change", () => this.build());
    this.svg = svg("svg", { viewBox: `0 0 ${Orbit.side} ${Orbit.side}`, role: "img" }, this.host);
    this.build();
  }

  static side = 320;

  /** The corner of the roof that moves farthest. */
  busiest(floor) {
    const far = page.buildings[this.building].plans[floor - 1].corners.map((_, corner) => {
      const path = cornerPath(run, this.building, floor, corner);
      return path ? path.x.reduce((most, x, i) => Math.max(most, Math.hypot(x, path.y[i])), 0) : 0;
    });
    return `${floor} ${far.indexOf(Math.max(...far))}`;
  }

  build() {
    const [floor, corner] = this.select.value.split(" ").map(Number);
    this.path = cornerPath(run, this.building, floor, corner);
    const free = without && page.gaps.length ? cornerPath(without, this.building, floor, corner) : null;
    this.svg.replaceChildren();
    if (!this.path) return;
    this.svg.setAttribute("aria-label", say("orbit_of", { name: this.select.selectedOptions[0].text }));
    const reach = 1.08 * Math.max(...[this.path, free].filter(Boolean).flatMap(({ x, y }) => [greatest(x), greatest(y)]), 1e-6);
    const margin = { left: 56, right: 12, top: 14, bottom: 32 };
    // Both axes to the same scale.
    const [wide, tall] = [Orbit.side - margin.left - margin.right, Orbit.side - margin.top - margin.bottom];
    const axisOf = (name, share) => ({ ends: [-reach * share, reach * share], name: `${name} [${unitOf("mm").name}]` });
    const [x, y] = [axisOf("x", 1), axisOf("y", tall / wide)];
    this.plot = plot(svg("g", { class: "grid" }, this.svg), { width: Orbit.side, height: Orbit.side, margin, x, y });
    const within = inside(this.svg, this.plot.box);
    const points = ({ x, y }) => x.reduce((text, value, i) => `${text}${i ? "L" : "M"}${this.plot.px(value).toFixed(1)} ${this.plot.py(y[i]).toFixed(1)}`, "");
    if (free) svg("path", { class: "path-without", d: points(free) }, within);
    svg("path", { class: "path-run", d: points(this.path) }, within);
    this.dot = svg("circle", { class: "now", r: 4 }, within);
    this.draw(this.time ?? 0);
  }

  draw(t) {
    this.time = t;
    if (!this.path) return;
    this.dot.setAttribute("cx", this.plot.px(interpolate(run.time, this.path.x, t)).toFixed(1));
    this.dot.setAttribute("cy", this.plot.py(interpolate(run.time, this.path.y, t)).toFixed(1));
  }
}
