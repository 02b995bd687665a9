// Charts over period or frequency, with linear or logarithmic axes.

/** A short number for an axis or a read-out. */
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, power] = value.toExponential(1).replace("e+", "e").split("e");
    const exponent = [...power].map((digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])).join("");
    const front = mantissa === "1.0" ? "" : `${Number(mantissa)} × `;
    return `${front}10${exponent}`.replace("-", "−");
  }
  const [whole, part] = String(Number(value.toPrecision(size >= 1e3 ? 4 : 3))).replace("-", "−").split(".");
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return part ? `${grouped}.${part}` : grouped;
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

  draw() {
    this.width = Math.max(this.figure.clientWidth, 240);
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.svg.replaceChildren();
    const ends = (of) => ({ ends: this.extent(of, this.axes[of] === "log"), log: this.axes[of] === "log" });
    const x = { ...ends("x"), count: 8, text: (value) => `${short(value)} ${this.xUnit}` };
    const grid = svg("g", { class: "grid" }, this.svg);
    this.plot = plot(grid, { width: this.width, height: this.height, margin, x, y: { ...ends("y"), text: short } });
    const { px, py, box } = this.plot;
    for (const value of this.marks) {
      const at = px(value);
      svg("line", { x1: at, x2: at, y1: box.top, y2: box.bottom, class: "level" }, this.svg);
      svg("text", { x: at + 4, y: box.top + 12, class: "level-name" }, this.svg).textContent = `${short(value)} ${this.xUnit}`;
    }
    const lines = inside(this.svg, box);
    for (const s of this.series) {
      const points = [];
      for (let i = 0; i < s.x.length; i++) {
        const hidden = (this.axes.x === "log" && s.x[i] <= 0) || (this.axes.y === "log" && s.y[i] <= 0);
        if (!hidden && Number.isFinite(s.y[i])) points.push(`${px(s.x[i]).toFixed(2)},${py(s.y[i]).toFixed(2)}`);
      }
      if (!points.length) continue;
      const line = svg("path", { class: `line${s.dashed ? " dashed" : ""}`, style: `--c:${s.colour}`, d: `M${points.join("L")}` }, lines);
      if (s.thin) line.style.opacity = 0.75;
      if (s.bold) line.style.strokeWidth = 2.6;
    }
    this.cursor = svg("line", { class: "pointer", y1: box.top, y2: box.bottom }, this.svg);
    this.read();
  }

  read() {
    const { box } = this.plot;
    const seen = this.pointer !== null && this.pointer >= box.left && this.pointer <= box.right;
    this.cursor.style.display = seen ? "" : "none";
    this.place.textContent = "";
    for (const readout of this.readouts) readout.textContent = "";
    if (!seen) return;
    this.cursor.setAttribute("x1", this.pointer);
    this.cursor.setAttribute("x2", this.pointer);
    const x = this.plot.x.value(this.pointer);
    this.place.textContent = say("at_value_of", { name: this.xName, value: short(x), unit: this.xUnit });
    this.series.forEach((s, i) => {
      this.readouts[i].textContent = x < s.x[0] || x > s.x[s.x.length - 1] ? "–" : short(interpolate(s.x, s.y, x));
    });
  }
}
