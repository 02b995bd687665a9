// What every drawing needs: numbers as text, elements, and axes with their grid.

/** Fixed decimals with a true minus sign, and thin spaces between thousands from ten thousand on. */
function fixed(value, decimals) {
  if (!Number.isFinite(value)) return "–";
  const plain = value.toFixed(decimals);
  if (Math.abs(value) >= 9999.5) return plain.replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f").replace("-", "−");
  const text = plain;
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** A value with at most four digits, as the tables and tiles of pages have peaks. */
function readable(value) {
  const size = Math.abs(value);
  return fixed(Number(value.toPrecision(4)), size >= 1000 ? 0 : size >= 100 ? 1 : size >= 1 || size === 0 ? 2 : 3);
}

/** An SI value in a unit, with its name. */
const inUnit = (value, { name, factor, least }, decimals) => `${fixed(value * factor, Math.max(decimals, least))} ${name}`;

/** An SI value in a unit with three digits, as far as histories on pages are exact. */
const inThreeDigits = (value, { name, factor }) => `${fixed(Number((value * factor).toPrecision(3)), 0)} ${name}`;

/** Round values between two ends, about `count` of them, and the decimals they need. */
function ticks(low, high, count) {
  const raw = (high - low) / count;
  if (!(raw > 0) || !Number.isFinite(raw)) return { values: [low], decimals: 0 };
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const values = [];
  for (let i = Math.ceil(low / step); i <= high / step + 1e-9; i++) values.push(i * step);
  return { values, decimals: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/** Positions on a logarithmic axis. */
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

const svgNamespace = "http://www.w3.org/2000/svg";

/** A new SVG element with attributes, inside a parent. */
function svg(name, attributes, parent) {
  const element = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes ?? {})) element.setAttribute(key, value);
  parent?.append(element);
  return element;
}

/** A new HTML element with a class and text, inside a parent. */
function html(name, className, text, parent) {
  const element = document.createElement(name);
  if (className) element.className = className;
  if (text !== undefined) element.textContent = text;
  parent?.append(element);
  return element;
}

/** Places values between `low` and `high` from one position of a drawing to another, and reads positions back. */
function axis([low, high], [from, to], log = false) {
  const share = log ? (value) => Math.log(value / low) / Math.log(high / low) : (value) => (value - low) / (high - low);
  const valueAt = log ? (part) => low * (high / low) ** part : (part) => low + part * (high - low);
  return { at: (value) => from + share(value) * (to - from), value: (position) => valueAt((position - from) / (to - from)) };
}

/**
 * Grid and numbers of a plot, added to a group. `x` and `y`: `ends` of the axis; `log`; about how many numbers (`count`); `text`
 * of a number and the decimals it needs; `name`, below the middle of the axis or along it; `lines: false` for numbers alone;
 * `place` in the place of what it would place itself. Returns what places values, their inverse, and the box of the plot.
 */
function plot(group, { width, height, margin, x, y }) {
  const box = { left: margin.left, top: margin.top, right: width - margin.right, bottom: height - margin.bottom };
  const across = x.place ?? axis(x.ends, [box.left, box.right], x.log);
  const up = y.place ?? axis(y.ends, [box.bottom, box.top], y.log);
  const numbers = ({ ends, log, count = 5, text = fixed }) => {
    const { values, decimals } = log ? { values: logTicks(...ends) } : ticks(...ends, count);
    const zero = (value) => !log && Math.abs(value) < 1e-9 * (ends[1] - ends[0]);
    return values.map((value) => ({ value, text: text(value, decimals), kind: zero(value) ? "zero" : "" }));
  };
  for (const { value, text, kind } of numbers(y)) {
    const at = up.at(value).toFixed(1);
    if (y.lines !== false) svg("line", { x1: box.left, x2: box.right, y1: at, y2: at, class: kind }, group);
    svg("text", { x: box.left - 6, y: up.at(value) + 3.5, "text-anchor": "end" }, group).textContent = text;
  }
  for (const { value, text, kind } of numbers(x)) {
    const at = across.at(value);
    if (at < box.left - 0.5 || at > box.right + 0.5) continue;
    if (x.lines !== false) svg("line", { x1: at.toFixed(1), x2: at.toFixed(1), y1: box.top, y2: box.bottom, class: kind }, group);
    // The last number ends with the drawing.
    const last = at > box.right - 24 && margin.right < 24;
    svg("text", { x: last ? width - 4 : at.toFixed(1), y: box.bottom + 15, "text-anchor": last ? "end" : "middle" }, group).textContent = text;
  }
  const middle = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
  if (x.name) svg("text", { x: middle[0], y: height - 4, "text-anchor": "middle", class: "axis" }, group).textContent = x.name;
  if (y.name) svg("text", { x: 12, y: middle[1], "text-anchor": "middle", class: "axis", transform: `rotate(-90 12 ${middle[1]})` }, group).textContent = y.name;
  return { px: across.at, py: up.at, x: across, y: up, box };
}

/** A box of a drawing outside of which nothing shows that takes its `attributes`; `rect` is its size. No two of a page have one name. */
function clip(drawing) {
  const id = `clip-${clip.count++}`;
  const rect = svg("rect", {}, svg("clipPath", { id }, svg("defs", {}, drawing)));
  return { rect, attributes: { "clip-path": `url(#${id})` } };
}

clip.count = 0;

/** A group of a drawing that shows nothing outside a box. */
function inside(drawing, { left, top, right, bottom }) {
  const { rect, attributes } = clip(drawing);
  const size = { x: left, y: top, width: right - left, height: bottom - top };
  for (const [key, value] of Object.entries(size)) rect.setAttribute(key, value);
  return svg("g", attributes, drawing);
}
