// Charts over period or frequency, with linear or logarithmic axes.

/** Positions and labels of a logarithmic axis. */
function logTicks(low, high) {
  const values = [];
  const crowded = Math.log10(high / low) > 3.5;
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power++) {
    for (const m of crowded ? [1] : [1, 2, 5]) {
      const value = m * 10 ** power;
      if (value >= low * 0.999 && value <= high * 1.001) values.push(value);
    }
  }
  return values;
}

/** A short number for an axis or a read-out. */
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-4 ? value.toExponential(1).replace("-", "−") : String(Number(value.toPrecision(3))).replace("-", "−");
}

/**
 * One chart. `series`: [{ label, colour, x, y, dashed, thin }]; `marks`: positions of vertical lines;
 * `axes`: { x: "log" | "linear", y: "log" | "linear" }.
 */
class SpectrumChart {
  constructor(host, { title, unit, xUnit, xName, series, marks = [], axes, height = 300, range }) {
    Object.assign(this, { title, unit, xUnit, xName, marks, axes, height, range });
    this.figure = html("figure", "chart", undefined, host);
    this.caption = html("figcaption", "", undefined, this.figure);
    this.svg = svg("svg", { role: "img", "aria-label": title }, this.figure);
    this.pointer = null;
    this.svg.addEventListener("pointermove", (event) => {
      this.pointer = event.clientX - this.svg.getBoundingClientRect().left;
      this.read();
    });
    this.svg.addEventListener("pointerleave", () => {
      this.pointer = null;
      this.read();
    });
    this.show(series, title, unit);
    new ResizeObserver(() => requestAnimationFrame(() => this.draw())).observe(this.figure);
  }

  show(series, title, unit) {
    Object.assign(this, { series, title, unit });
    this.caption.replaceChildren();
    html("span", "unit", ` [${unit}]`, html("span", "chart-title", title, this.caption));
    const legend = html("span", "legend", undefined, this.caption);
    this.readouts = series.map((s) => {
      const key = html("span", "key", undefined, legend);
      if (!s.label && series.length > 1) key.hidden = true;
      if (s.label) html("span", `swatch${s.dashed ? " dashed" : ""}`, undefined, key).style.setProperty("--c", s.colour);
      html("span", "", s.label, key);
      return html("output", "value", "", key);
    });
    this.place = html("output", "quiet", "", legend);
    this.draw();
  }

  setAxes(axes) {
    this.axes = axes;
    this.draw();
  }

  extent(of, logarithmic) {
    let [low, high] = [Infinity, -Infinity];
    for (const s of this.series) {
      for (let i = 0; i < s.x.length; i++) {
        const value = s[of][i];
        if (!Number.isFinite(value) || (logarithmic && value <= 0)) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    if (!(high > -Infinity)) return [0, 1];
    if (of === "x") return this.range && logarithmic ? this.range : [logarithmic ? low : 0, high];
    if (logarithmic) return [Math.max(low, high * 1e-5) * 0.8, high * 1.3];
    return [0, high > 0 ? high * 1.06 : 1];
  }

  scale(value, [low, high], logarithmic) {
    return logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  }

  px(value) {
    return margin.left + this.scale(value, this.xs, this.axes.x === "log") * (this.width - margin.left - margin.right);
  }

  py(value) {
    const inner = this.height - margin.top - margin.bottom;
    return this.height - margin.bottom - this.scale(value, this.ys, this.axes.y === "log") * inner;
  }

  draw() {
    this.width = Math.max(this.figure.clientWidth, 240);
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.replaceChildren();
    this.xs = this.extent("x", this.axes.x === "log");
    this.ys = this.extent("y", this.axes.y === "log");
    const grid = svg("g", { class: "grid" }, this.svg);
    const [right, bottom] = [this.width - margin.right, this.height - margin.bottom];
    const steps = (range, logarithmic, count) => (logarithmic ? logTicks(...range) : ticks(...range, count).values);
    for (const value of steps(this.ys, this.axes.y === "log", 5)) {
      const y = this.py(value);
      svg("line", { x1: margin.left, x2: right, y1: y, y2: y }, grid);
      svg("text", { x: margin.left - 7, y: y + 3.5, "text-anchor": "end" }, grid).textContent = short(value);
    }
    for (const value of steps(this.xs, this.axes.x === "log", 8)) {
      const x = this.px(value);
      svg("line", { x1: x, x2: x, y1: margin.top, y2: bottom }, grid);
      const anchor = x > right - 24 ? "end" : "middle";
      svg("text", { x, y: this.height - 7, "text-anchor": anchor }, grid).textContent = `${short(value)} ${this.xUnit}`;
    }
    for (const value of this.marks) {
      const x = this.px(value);
      svg("line", { x1: x, x2: x, y1: margin.top, y2: bottom, class: "level" }, this.svg);
      svg("text", { x: x + 4, y: margin.top + 12, class: "level-name" }, this.svg).textContent = `${short(value)} ${this.xUnit}`;
    }
    const clip = svg("clipPath", { id: (this.clip ??= `spectrum-clip-${SpectrumChart.count++}`) }, this.svg);
    svg("rect", { x: margin.left, y: margin.top, width: right - margin.left, height: bottom - margin.top }, clip);
    const lines = svg("g", { "clip-path": `url(#${this.clip})` }, this.svg);
    for (const s of this.series) {
      const points = [];
      for (let i = 0; i < s.x.length; i++) {
        const hidden = (this.axes.x === "log" && s.x[i] <= 0) || (this.axes.y === "log" && s.y[i] <= 0);
        if (!hidden && Number.isFinite(s.y[i])) points.push(`${this.px(s.x[i]).toFixed(2)},${this.py(s.y[i]).toFixed(2)}`);
      }
      if (!points.length) continue;
      const line = svg("path", { class: `line${s.dashed ? " dashed" : ""}`, style: `--c:${s.colour}`, d: `M${points.join("L")}` }, lines);
      if (s.thin) line.style.opacity = 0.75;
      if (s.bold) line.style.strokeWidth = 2.6;
    }
    this.cursor = svg("line", { class: "pointer", y1: margin.top, y2: bottom }, this.svg);
    this.read();
  }

  static count = 0;

  read() {
    const inside = this.pointer !== null && this.pointer >= margin.left && this.pointer <= this.width - margin.right;
    this.cursor.style.display = inside ? "" : "none";
    this.place.textContent = "";
    for (const readout of this.readouts) readout.textContent = "";
    if (!inside) return;
    this.cursor.setAttribute("x1", this.pointer);
    this.cursor.setAttribute("x2", this.pointer);
    const share = (this.pointer - margin.left) / (this.width - margin.left - margin.right);
    const [low, high] = this.xs;
    const x = this.axes.x === "log" ? low * (high / low) ** share : low + share * (high - low);
    this.place.textContent = say("at_value_of", { name: this.xName, value: short(x), unit: this.xUnit });
    this.series.forEach((s, i) => {
      this.readouts[i].textContent = x < s.x[0] || x > s.x[s.x.length - 1] ? "–" : short(interpolate(s.x, s.y, x));
    });
  }
}
