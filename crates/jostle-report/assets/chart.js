// Charts over time: one shared range, one shared cursor, values read where the pointer is.

/** The visible range and the pointer, shared by all charts. */
class TimeView {
  constructor(end) {
    this.full = [0, end];
    this.range = [0, end];
    this.cursor = 0;
    this.pointer = null;
    this.charts = new Set();
  }

  /** Shortest visible range [s]. */
  static shortest = 1e-3;

  show(start, end) {
    const length = Math.min(Math.max(end - start, TimeView.shortest), this.full[1] - this.full[0]);
    const middle = (start + end) / 2;
    const first = Math.min(Math.max(middle - length / 2, this.full[0]), this.full[1] - length);
    this.range = [first, first + length];
    this.redraw();
  }

  zoom(factor, around) {
    const [start, end] = this.range;
    const centre = around ?? (this.cursor >= start && this.cursor <= end ? this.cursor : (start + end) / 2);
    this.show(centre - (centre - start) * factor, centre + (end - centre) * factor);
  }

  whole() {
    this.show(...this.full);
  }

  get isWhole() {
    return this.range[1] - this.range[0] >= (this.full[1] - this.full[0]) * 0.9999;
  }

  redraw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = null;
      for (const chart of this.charts) chart.draw();
    });
  }

  /** Moves the cursor; keeps it in sight when the charts are zoomed. */
  setCursor(t, follow) {
    this.cursor = t;
    const [start, end] = this.range;
    if (follow && (t < start || t > end)) {
      const length = end - start;
      this.show(t - 0.1 * length, t + 0.9 * length);
    }
    for (const chart of this.charts) chart.drawCursor();
  }

  setPointer(t) {
    this.pointer = t;
    for (const chart of this.charts) chart.drawCursor();
  }
}

const margin = { left: 58, right: 12, top: 8, bottom: 24 };

/**
 * One chart. `series`: [{ label, colour, time, values, dashed, area, read }], values in the shown unit;
 * `levels`: [{ value, label, quiet }] horizontal lines; `zone`: value above which the ground is shaded;
 * `dots`: [{ at, value, size, colour, title, pick }] discs, where `pick` is called for a click on one.
 */
class TimeChart {
  constructor(host, view, { title, unit, series, levels = [], zone, dots = [], height = 190, seek }) {
    Object.assign(this, { view, unit, series, levels, zone, dots, onScreen: height, seek, title });
    this.figure = html("figure", "chart", undefined, host);
    this.caption = html("figcaption", "", undefined, this.figure);
    this.svg = svg("svg", { role: "img", tabindex: 0 }, this.figure);
    this.layers = {};
    const clipped = clip(this.svg);
    this.clipBox = clipped.rect;
    for (const name of ["zone", "grid", "lines", "dots", "levels", "marks"]) {
      const inside = name === "grid" || name === "levels" ? {} : clipped.attributes;
      this.layers[name] = svg("g", { class: name, ...inside }, this.svg);
    }
    this.name();
    this.cursorLine = svg("line", { class: "cursor" }, this.layers.marks);
    this.pointerLine = svg("line", { class: "pointer" }, this.layers.marks);
    this.selection = svg("rect", { class: "selection" }, this.layers.marks);
    this.listen();
    view.charts.add(this);
    this.observer = new ResizeObserver(([{ contentRect }]) => {
      this.room = contentRect.width;
      requestAnimationFrame(() => this.draw());
    });
    this.observer.observe(this.figure);
    // A page that shows run after run draws what is in sight, and the rest when it comes near.
    this.near = !TimeChart.lazy;
    if (!TimeChart.lazy) return;
    this.sight = new IntersectionObserver(([{ isIntersecting }]) => {
      this.near = isIntersecting;
      if (this.near && this.late) this.draw();
    }, { rootMargin: "400px" });
    this.sight.observe(this.figure);
  }

  /** Title, legend and lines, anew. */
  name() {
    this.caption.replaceChildren();
    html("span", "unit", ` [${this.unit}]`, html("span", "chart-title", this.title, this.caption));
    this.readouts = this.makeLegend(this.caption);
    this.instant = html("output", "hover-time", "", this.caption);
    this.svg.setAttribute("aria-label", say("over_time_of", { title: this.title }));
    this.layers.lines.replaceChildren();
    this.paths = this.series.map((s) =>
      svg("path", { class: `line${s.dashed ? " dashed" : ""}${s.area ? " area" : ""}`, style: `--c:${s.colour}` }, this.layers.lines),
    );
  }

  /** Shows other data in the same place. */
  update({ title, unit, series, levels = [], zone, dots = [], height = 190 }) {
    const named = (chart) => JSON.stringify([chart.title, chart.unit, chart.series.map((s) => [s.label, s.colour, s.dashed, s.area])]);
    const before = named(this);
    Object.assign(this, { title, unit, series, levels, zone, dots, onScreen: height });
    if (named(this) !== before) this.name();
    this.draw();
  }

  /** Whether charts out of sight wait. */
  static lazy = false;

  /** Width while printing [px]; otherwise as wide as there is room. */
  static paperWidth = null;

  /** On paper all charts are as high as the lowest, so that a page holds more of them and their axes of time line up. */
  get height() {
    return TimeChart.paperWidth === null ? this.onScreen : Math.min(this.onScreen, 150);
  }

  remove() {
    this.view.charts.delete(this);
    this.observer.disconnect();
    this.sight?.disconnect();
    this.figure.remove();
  }

  makeLegend(caption) {
    const legend = html("span", "legend", undefined, caption);
    return this.series.map((s) => {
      const key = html("span", "key", undefined, legend);
      // A chart of one line needs no name for it.
      if (s.label) {
        const swatch = html("span", `swatch${s.dashed ? " dashed" : ""}`, undefined, key);
        swatch.style.setProperty("--c", s.colour);
        html("span", "", s.label, key);
      }
      return html("output", "value", "", key);
    });
  }

  /** Axis of time: what is in sight. */
  get across() {
    return axis(this.view.range, [margin.left, this.width - margin.right]);
  }

  x(t) {
    return this.across.at(t);
  }

  time(x) {
    return this.across.value(x);
  }

  y(value) {
    return axis(this.scale, [this.height - margin.bottom, margin.top]).at(value);
  }

  draw() {
    this.late = !this.near && TimeChart.paperWidth === null;
    if (this.late) return;
    // Asking the browser for a width makes it lay out the page at once.
    this.room ??= this.figure.clientWidth;
    this.width = TimeChart.paperWidth ?? Math.max(this.room, 240);
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    const box = {
      x: margin.left,
      y: margin.top,
      width: this.width - margin.left - margin.right,
      height: this.height - margin.top - margin.bottom,
    };
    for (const [key, value] of Object.entries(box)) this.clipBox.setAttribute(key, value);
    const visible = this.series.map((s) => this.visible(s));
    this.scale = this.valueRange(visible);
    this.drawGrid();
    this.series.forEach((s, i) => this.paths[i].setAttribute("d", this.path(s, visible[i])));
    this.drawDots();
    for (const line of [this.cursorLine, this.pointerLine]) {
      line.setAttribute("y1", margin.top);
      line.setAttribute("y2", this.height - margin.bottom);
    }
    this.drawCursor();
  }

  /** First and last point to draw: those in sight and one beyond on either side. */
  visible({ time }) {
    const [start, end] = this.view.range;
    return [Math.max(indexBefore(time, start), 0), Math.min(indexBefore(time, end) + 1, time.length - 1)];
  }

  valueRange(visible) {
    let low = 0;
    let high = 0;
    this.series.forEach(({ time, values }, i) => {
      const [first, last] = visible[i];
      for (let k = first; k <= last; k++) {
        if (time[k] < this.view.range[0] || time[k] > this.view.range[1]) continue;
        low = Math.min(low, values[k]);
        high = Math.max(high, values[k]);
      }
      for (const t of this.view.range) {
        const value = time.length ? interpolate(time, values, t) : 0;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    });
    for (const { value } of [...this.levels, ...this.dots]) high = Math.max(high, value);
    if (high - low < 1e-9) return [0, 1];
    // Whole discs are seen, at the top and at zero.
    const radius = Math.max(0, ...this.dots.map(({ size }) => size));
    const room = Math.max(0.06, (1.3 * radius) / (this.height - margin.top - margin.bottom)) * (high - low);
    const isCut = this.dots.some(({ value }) => value < low + room);
    return [low < 0 || isCut ? low - room : 0, high + room];
  }

  drawGrid() {
    const { grid, zone, levels } = this.layers;
    grid.replaceChildren();
    levels.replaceChildren();
    zone.replaceChildren();
    const right = this.width - margin.right;
    const seconds = { ends: this.view.range, count: Math.max(3, this.width / 110), text: (t, decimals) => `${fixed(t, decimals)} s` };
    plot(grid, { width: this.width, height: this.height, margin, x: seconds, y: { ends: this.scale } });
    for (const { value, label, quiet } of this.levels) {
      const y = this.y(value);
      const tone = quiet ? " quiet-level" : "";
      svg("line", { x1: margin.left, x2: right, y1: y, y2: y, class: `level${tone}` }, levels);
      svg("text", { x: right - 5, y: y - 5, "text-anchor": "end", class: `level-name${tone}` }, levels).textContent = label;
    }
    if (this.zone !== undefined) {
      const y = Math.max(margin.top, this.y(this.zone));
      svg("rect", { x: margin.left, y: margin.top, width: right - margin.left, height: Math.max(0, y - margin.top) }, zone);
    }
  }

  /** Path through the points in sight; of many points in one pixel only the extremes. */
  path(s, [first, last]) {
    if (last < first || !s.time.length) return "";
    const { time, values } = s;
    // Straight axes: a factor and a shift each, in tenths of a pixel.
    const [x0, y0] = [this.x(0), this.y(0)];
    const [perSecond, perUnit] = [10 * (this.x(1) - x0), 10 * (this.y(1) - y0)];
    const points = [];
    const add = (k) => points.push(`${Math.round(10 * x0 + perSecond * time[k]) / 10},${Math.round(10 * y0 + perUnit * values[k]) / 10}`);
    if (last - first < this.width) {
      for (let k = first; k <= last; k++) add(k);
    } else {
      const pixelOf = (k) => Math.floor(x0 + 0.1 * perSecond * time[k]);
      let k = first;
      while (k <= last) {
        const pixel = pixelOf(k);
        let [low, high, end] = [k, k, k];
        while (end < last && pixelOf(end + 1) === pixel) {
          end += 1;
          if (values[end] < values[low]) low = end;
          if (values[end] > values[high]) high = end;
        }
        add(k);
        const [sooner, later] = low < high ? [low, high] : [high, low];
        if (sooner !== k) add(sooner);
        if (later !== sooner) add(later);
        if (end !== later) add(end);
        k = end + 1;
      }
    }
    const line = `M${points.join("L")}`;
    if (!s.area) return line;
    const zero = this.y(0).toFixed(2);
    return `${line}L${this.x(s.time[last]).toFixed(2)},${zero}L${this.x(s.time[first]).toFixed(2)},${zero}Z`;
  }

  /** Discs in sight, the largest at the back. */
  drawDots() {
    const [start, end] = this.view.range;
    const seen = this.dots.filter(({ at }) => at >= start && at <= end).sort((a, b) => b.size - a.size);
    const discs = seen.map(({ at, value, size, colour, title }) => {
      const disc = svg("circle", { class: "disc", style: `--c:${colour}`, cx: this.x(at).toFixed(1), cy: this.y(value).toFixed(1), r: size });
      svg("title", {}, disc).textContent = title;
      return disc;
    });
    this.layers.dots.replaceChildren(...discs);
  }

  /** The disc under a point, the smallest if several are. */
  dotAt(x, y) {
    const near = ({ at, value, size }) => Math.hypot(this.x(at) - x, this.y(value) - y) <= Math.max(size, 6);
    return this.dots.filter(near).sort((a, b) => a.size - b.size)[0];
  }

  drawCursor() {
    if (!this.scale) return;
    const place = (line, t) => {
      const seen = t !== null && t >= this.view.range[0] && t <= this.view.range[1];
      line.style.display = seen ? "" : "none";
      if (!seen) return;
      line.setAttribute("x1", this.x(t));
      line.setAttribute("x2", this.x(t));
    };
    place(this.cursorLine, this.view.cursor);
    place(this.pointerLine, this.view.pointer);
    const t = this.view.pointer ?? this.view.cursor;
    this.instant.textContent = this.view.pointer === null ? "" : say("at_instant", { instant: fixed(t, 3) });
    this.series.forEach((s, i) => {
      const values = s.read ?? s.values;
      this.readouts[i].textContent = values.length ? readable(interpolate(s.time, values, t)) : "";
    });
  }

  listen() {
    const touches = new Map();
    let drag = null;
    let pinch = null;
    const at = (event) => event.clientX - this.svg.getBoundingClientRect().left;
    const inside = (t) => Math.min(Math.max(t, this.view.range[0]), this.view.range[1]);
    const target = this.svg;
    const clearSelection = () => this.selection.setAttribute("width", 0);

    target.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      touches.set(event.pointerId, at(event));
      target.setPointerCapture(event.pointerId);
      if (touches.size === 2) {
        drag = null;
        clearSelection();
        const [a, b] = [...touches.values()];
        pinch = { times: [this.time(a), this.time(b)] };
      } else {
        drag = { from: at(event), moved: false };
      }
    });
    target.addEventListener("pointermove", (event) => {
      const x = at(event);
      if (touches.has(event.pointerId)) touches.set(event.pointerId, x);
      if (pinch && touches.size === 2) {
        this.pinchTo(pinch.times, [...touches.values()]);
      } else if (drag) {
        drag.moved ||= Math.abs(x - drag.from) > 4;
        if (drag.moved) {
          const [low, high] = [Math.min(x, drag.from), Math.max(x, drag.from)];
          const box = { x: low, y: margin.top, width: high - low, height: this.height - margin.top - margin.bottom };
          for (const [key, value] of Object.entries(box)) this.selection.setAttribute(key, value);
        }
      }
      if (event.pointerType === "mouse") this.view.setPointer(inside(this.time(x)));
    });
    const release = (event) => {
      const x = at(event);
      touches.delete(event.pointerId);
      if (touches.size < 2) pinch = null;
      if (drag && event.type === "pointerup") {
        if (drag.moved) {
          const [start, end] = [drag.from, x].sort((a, b) => a - b).map((p) => inside(this.time(p)));
          if (end > start) this.view.show(start, end);
        } else {
          const dot = this.dotAt(x, event.clientY - this.svg.getBoundingClientRect().top);
          if (dot) dot.pick();
          else this.seek(inside(this.time(x)));
        }
      }
      drag = null;
      clearSelection();
    };
    target.addEventListener("pointerup", release);
    target.addEventListener("pointercancel", release);
    target.addEventListener("pointerleave", () => this.view.setPointer(null));
    target.addEventListener("dblclick", () => this.view.whole());
    target.addEventListener(
      "wheel",
      (event) => {
        // Scrolling the page past a chart must not zoom it by accident.
        const meant = event.ctrlKey || event.shiftKey || event.metaKey || document.activeElement === target;
        const move = event.deltaY || event.deltaX;
        if (!meant || (move > 0 && this.view.isWhole)) return;
        event.preventDefault();
        this.view.zoom(Math.exp(Math.max(-1, Math.min(1, move * 0.002))), inside(this.time(at(event))));
      },
      { passive: false },
    );
    target.addEventListener("keydown", (event) => this.key(event));
  }

  /** Shows the range in which two instants lie under two fingers. */
  pinchTo([t1, t2], [x1, x2]) {
    if (Math.abs(x2 - x1) < 8) return;
    const perPixel = (t2 - t1) / (x2 - x1);
    if (!(perPixel > 0)) return;
    const start = t1 - (x1 - margin.left) * perPixel;
    this.view.show(start, start + perPixel * (this.width - margin.left - margin.right));
  }

  key(event) {
    const length = this.view.range[1] - this.view.range[0];
    const actions = {
      ArrowLeft: () => this.seek(this.view.cursor - length / 100),
      ArrowRight: () => this.seek(this.view.cursor + length / 100),
      "+": () => this.view.zoom(0.5),
      "=": () => this.view.zoom(0.5),
      "-": () => this.view.zoom(2),
      Escape: () => this.view.whole(),
      0: () => this.view.whole(),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  }
}
