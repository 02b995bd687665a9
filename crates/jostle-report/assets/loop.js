// Loops of hinges: force over deformation, with the cursor of the charts over time.

/** One loop. Registered with the charts over time, it draws what they show up to their cursor. */
class LoopChart {
  constructor(host, view, data) {
    this.view = view;
    this.name = data.name;
    this.time = unpack(data.time);
    const [length, force, moment, energy] = [unitOf("mm"), unitOf("kN"), unitOf("kN·m"), unitOf("kJ")];
    const turns = { name: "mrad", factor: 1e3 };
    const across = data.over_time ? { name: "s", factor: 1 } : data.is_path || data.storey ? length : turns;
    const up = data.is_path ? length : data.storey ? force : moment;
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
  static margin = { left: 66, right: 10, top: 8, bottom: 32 };

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
    const [x, y] = [{ ends: this.ends || [-reach, reach], name: dUnit }, { ends: [-top, top], name: fUnit }];
    const { px, py, box } = plot(svg("g", { class: "grid" }, this.svg), { width, height, margin, x, y });
    const within = inside(this.svg, box);
    Object.assign(this, { px, py });
    for (const at of this.marks) svg("path", { class: "mark-line", d: `M${px(at).toFixed(1)},${margin.top}V${height - margin.bottom}` }, within);
    this.first = svg("path", { class: "backbone" }, within);
    this.whole = svg("path", { class: "line whole" }, within);
    this.strong = svg("path", { class: "line" }, within);
    this.dot = svg("circle", { class: "now", r: 4.5 }, within);
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
