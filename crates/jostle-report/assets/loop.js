// Loops of hinges: force over deformation, with the cursor of the charts over time.

/**
 * Grid and units of a small plot. `x` and `y` are the ends of its axes. Returns what places values, and a group that cuts
 * off what lies outside.
 */
function smallPlot(host, { width, height, margin: { left, right, top, bottom }, x, y, xUnit, yUnit }) {
  const [end, floor] = [width - right, height - bottom];
  const px = (value) => left + ((value - x[0]) / (x[1] - x[0])) * (end - left);
  const py = (value) => floor - ((value - y[0]) / (y[1] - y[0])) * (floor - top);
  const zero = (value, [low, high]) => (Math.abs(value) < 1e-9 * (high - low) ? "zero" : "");
  const grid = svg("g", { class: "grid" }, host);
  const xs = ticks(...x, 5);
  for (const value of xs.values) {
    const at = px(value).toFixed(1);
    svg("line", { x1: at, x2: at, y1: top, y2: floor, class: zero(value, x) }, grid);
    svg("text", { x: at, y: floor + 14, "text-anchor": "middle" }, grid).textContent = fixed(value, xs.decimals);
  }
  const ys = ticks(...y, 5);
  for (const value of ys.values) {
    const at = py(value);
    svg("line", { x1: left, x2: end, y1: at, y2: at, class: zero(value, y) }, grid);
    svg("text", { x: left - 5, y: at + 3.5, "text-anchor": "end" }, grid).textContent = fixed(value, ys.decimals);
  }
  svg("text", { x: end, y: height - 4, "text-anchor": "end" }, grid).textContent = xUnit;
  svg("text", { x: left + 4, y: top + 10 }, grid).textContent = yUnit;
  const id = `plot-clip-${smallPlot.count++}`;
  svg("rect", { x: left, y: top, width: end - left, height: floor - top }, svg("clipPath", { id }, svg("defs", {}, host)));
  return { px, py, inside: svg("g", { "clip-path": `url(#${id})` }, host) };
}

smallPlot.count = 0;

/** One loop. Registered with the charts over time, it draws what they show up to their cursor. */
class LoopChart {
  constructor(host, view, data) {
    this.view = view;
    this.name = data.name;
    this.time = unpack(data.time);
    const [length, force, moment, energy] = [unitOf("mm"), unitOf("kN"), unitOf("kN·m"), unitOf("kJ")];
    const across = data.is_path || data.storey ? length : { name: data.over_time ? "s" : "mrad", factor: 1e3 };
    const up = data.is_path ? length : data.over_time || data.storey ? force : moment;
    const [dUnit, fUnit] = [across.name, up.name];
    this.x = data.over_time ? this.time : scaled(unpack(data.deformation), across.factor);
    this.isPath = data.is_path;
    const { factor } = up;
    this.y = scaled(unpack(data.force), factor);
    this.ends = data.over_time && [0, page.duration];
    this.marks = (data.marks ?? []).map((at) => across.factor * at);
    this.backbone = data.backbone.map(([x, y]) => [across.factor * x, factor * y]);
    const figure = html("figure", "multiple loop", undefined, host);
    const caption = html("figcaption", "", undefined, figure);
    html("span", "", data.name, caption);
    const numbers = data.note ?? say("loop_numbers", { ductility: readable(data.ductility), dissipated: readable(data.dissipated * energy.factor) });
    html("span", "unit", numbers, caption);
    this.svg = svg("svg", { viewBox: `0 0 ${LoopChart.width} ${LoopChart.height}`, role: "img" }, figure);
    this.svg.setAttribute("aria-label", say("loop_of", { force: fUnit, deformation: dUnit, name: data.name }));
    this.svg.style.setProperty("--c", `var(--c${data.building % 7})`);
    this.frame(dUnit, fUnit);
    this.layout();
    view.charts.add(this);
  }

  static width = 320;
  static height = 250;
  static margin = { left: 46, right: 10, top: 8, bottom: 32 };

  /** Scales, grid and the lines that never change. */
  frame(dUnit, fUnit) {
    // The curve of first loading is drawn as far as the loop reaches, and a little more.
    const moved = Math.max(1e-9, greatest(this.x));
    // Stops and limits are shown where they are near.
    this.marks = this.marks.filter((at) => Math.abs(at) < 1.6 * moved);
    let reach = 1.06 * Math.max(moved, greatest(this.marks));
    let top = 1.1 * Math.max(1e-9, greatest(this.y), ...this.backbone.filter(([x]) => Math.abs(x) <= reach).map(([, y]) => Math.abs(y)));
    const { width, height, margin } = LoopChart;
    if (this.isPath) {
      // Both axes to the same scale.
      const share = (height - margin.top - margin.bottom) / (width - margin.left - margin.right);
      const most = 1.06 * Math.max(moved, greatest(this.y), ...this.backbone.map(([x]) => Math.abs(x)));
      [reach, top] = [most / share, most];
    }
    const ends = { x: this.ends || [-reach, reach], y: [-top, top], xUnit: dUnit, yUnit: fUnit };
    const { px, py, inside } = smallPlot(this.svg, { width, height, margin, ...ends });
    Object.assign(this, { px, py });
    for (const at of this.marks) svg("path", { class: "mark-line", d: `M${px(at).toFixed(1)},${margin.top}V${height - margin.bottom}` }, inside);
    this.first = svg("path", { class: "backbone" }, inside);
    this.whole = svg("path", { class: "line whole" }, inside);
    this.strong = svg("path", { class: "line" }, inside);
    this.dot = svg("circle", { class: "now", r: 4.5 }, inside);
  }

  /** Texts of all points once, so that a moving cursor only cuts them. */
  layout() {
    this.text = "";
    this.starts = [];
    for (let k = 0; k < this.time.length; k++) {
      this.starts.push(this.text.length);
      this.text += `L${this.px(this.x[k]).toFixed(1)},${this.py(this.y[k]).toFixed(1)}`;
    }
    this.starts.push(this.text.length);
    this.whole.setAttribute("d", this.text ? `M${this.text.slice(1)}` : "");
    const outline = this.backbone.map(([x, y]) => `${this.px(x).toFixed(1)},${this.py(y).toFixed(1)}`);
    this.first.setAttribute("d", outline.length ? `M${outline.join("L")}` : "");
  }

  at(t) {
    return [interpolate(this.time, this.x, t), interpolate(this.time, this.y, t)];
  }

  draw() {
    this.drawCursor();
  }

  drawCursor() {
    const now = this.view.pointer ?? this.view.cursor;
    const from = Math.min(this.view.range[0], now);
    const point = (t) => {
      const [x, y] = this.at(t);
      return `${this.px(x).toFixed(1)},${this.py(y).toFixed(1)}`;
    };
    const [first, last] = [indexBefore(this.time, from) + 1, indexBefore(this.time, now) + 1];
    const between = this.text.slice(this.starts[first], this.starts[Math.max(first, last)]);
    this.strong.setAttribute("d", `M${point(from)}${between}L${point(now)}`);
    const [x, y] = this.at(now);
    this.dot.setAttribute("cx", this.px(x).toFixed(1));
    this.dot.setAttribute("cy", this.py(y).toFixed(1));
  }
}
