// Loops of hinges: force over deformation, with the cursor of the charts over time.

/** One loop. Registered with the charts over time, it draws what they show up to their cursor. */
class LoopChart {
  constructor(host, view, data) {
    this.view = view;
    this.name = data.name;
    this.time = unpack(data.time);
    const [dUnit, fUnit] = data.storey ? ["mm", "kN"] : ["mrad", "kN·m"];
    this.x = scaled(unpack(data.deformation), 1e3);
    this.y = scaled(unpack(data.force), 1e-3);
    this.backbone = data.backbone.map(([x, y]) => [1e3 * x, 1e-3 * y]);
    const figure = html("figure", "multiple loop", undefined, host);
    const caption = html("figcaption", "", undefined, figure);
    html("span", "", data.name, caption);
    const numbers = `ductility ${readable(data.ductility)}, ${readable(data.dissipated / 1e3)} kJ`;
    html("span", "unit", numbers, caption);
    this.svg = svg("svg", { viewBox: `0 0 ${LoopChart.width} ${LoopChart.height}`, role: "img" }, figure);
    this.svg.setAttribute("aria-label", `${fUnit} over ${dUnit}, ${data.name}`);
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
    const { left, right, top, bottom } = LoopChart.margin;
    const [width, height] = [LoopChart.width - right, LoopChart.height - bottom];
    // The curve of first loading is drawn as far as the loop reaches, and a little more.
    const reach = 1.06 * Math.max(1e-9, greatest(this.x));
    const top_ = 1.1 * Math.max(1e-9, greatest(this.y), ...this.backbone.filter(([x]) => Math.abs(x) <= reach).map(([, y]) => Math.abs(y)));
    this.px = (x) => left + ((x + reach) / (2 * reach)) * (width - left);
    this.py = (y) => height - ((y + top_) / (2 * top_)) * (height - top);
    const grid = svg("g", { class: "grid" }, this.svg);
    const xs = ticks(-reach, reach, 5);
    for (const value of xs.values) {
      const x = this.px(value).toFixed(1);
      svg("line", { x1: x, x2: x, y1: top, y2: height, class: Math.abs(value) < 1e-9 * reach ? "zero" : "" }, grid);
      svg("text", { x, y: height + 14, "text-anchor": "middle" }, grid).textContent = fixed(value, xs.decimals);
    }
    const ys = ticks(-top_, top_, 5);
    for (const value of ys.values) {
      const y = this.py(value);
      svg("line", { x1: left, x2: width, y1: y, y2: y, class: Math.abs(value) < 1e-9 * top_ ? "zero" : "" }, grid);
      svg("text", { x: left - 5, y: y + 3.5, "text-anchor": "end" }, grid).textContent = fixed(value, ys.decimals);
    }
    svg("text", { x: width, y: LoopChart.height - 4, "text-anchor": "end" }, grid).textContent = dUnit;
    svg("text", { x: left + 4, y: top + 10 }, grid).textContent = fUnit;
    const id = `loop-clip-${LoopChart.count++}`;
    svg("rect", { x: left, y: top, width: width - left, height: height - top }, svg("clipPath", { id }, svg("defs", {}, this.svg)));
    const inside = svg("g", { "clip-path": `url(#${id})` }, this.svg);
    this.first = svg("path", { class: "backbone" }, inside);
    this.whole = svg("path", { class: "line whole" }, inside);
    this.strong = svg("path", { class: "line" }, inside);
    this.dot = svg("circle", { class: "now", r: 4.5 }, inside);
  }

  static count = 0;

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
    this.first.setAttribute("d", `M${outline.join("L")}`);
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
