// What a run shows: histories, geometry, impacts. A report carries it in its text; a live page loads run after run.

let page = null;
/** Numbers beside the text of a live page. */
let numbers = null;

/** Numbers of a packed list: a part of `numbers`, or offset + scale · integer, little-endian, in base64. */
function unpack({ kind, offset, scale, data, at, count }) {
  if (at !== undefined) return numbers.subarray(at, at + count);
  const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const size = kind === "u32" ? 4 : 2;
  const values = new Float64Array(bytes.length / size);
  for (let i = 0; i < values.length; i++) {
    const integer = kind === "u32" ? view.getUint32(4 * i, true) : view.getInt16(2 * i, true);
    values[i] = offset + scale * integer;
  }
  return values;
}

/** Index of the last entry ≤ value in a rising list; -1 before the first. */
function indexBefore(list, value) {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Value at an instant on straight lines between the points; the ends hold on. */
function interpolate(time, values, t) {
  const i = indexBefore(time, t);
  if (i < 0) return values[0] ?? 0;
  if (i >= time.length - 1) return values[values.length - 1];
  const span = time[i + 1] - time[i];
  return span > 0 ? values[i] + ((t - time[i]) / span) * (values[i + 1] - values[i]) : values[i];
}

function unpackTable(table) {
  if (!table) return null;
  return {
    time: unpack(table.time),
    columns: new Map(table.columns.map(([name, column]) => [name, unpack(column)])),
  };
}

let run, without, ground, forces;
/** All contacts by their index, each with its gap. */
let contacts;

/** Takes over the data of a run. */
function load(data, beside) {
  page = data;
  numbers = beside;
  run = unpackTable(page.run);
  without = unpackTable(page.without);
  ground = { time: unpack(page.ground.time), values: unpack(page.ground.values) };
  forces = page.forces.map(({ time, values, indentation }) => ({
    time: unpack(time),
    values: unpack(values),
    indentation: indentation && unpack(indentation),
  }));
  contacts = page.gaps.flatMap((gap) => gap.contacts.map((contact) => ({ ...contact, gap })));
}

const embedded = document.getElementById("page-data");
if (embedded) load(JSON.parse(embedded.textContent), null);

/** Displacement history of a building at a height: of a floor, or between floors on a straight line. Floor 0 is its mat. */
function displacementColumn(table, building, floor, height) {
  if (floor || floor === 0) return table.columns.get(`u:${building}:${floor}`);
  const [base, ...floors] = levelsOf(page.buildings[building]);
  const above = floors.findIndex((h) => h >= height - 1e-3);
  if (above < 0) return undefined;
  const below = above > 0 ? floors[above - 1] : base;
  const part = (height - below) / (floors[above] - below);
  const upper = table.columns.get(`u:${building}:${above + 1}`);
  const lower = table.columns.get(`u:${building}:${above}`);
  return upper?.map((u, i) => part * u + (1 - part) * (lower ? lower[i] : 0));
}

/** Heights of the base and the floors above the datum of elevations [m]. */
function levelsOf(building) {
  return [0, ...building.heights].map((height) => height + (building.elevation ?? 0));
}

/** The numbers of a list times a factor. */
const scaled = (values, factor) => values.map((value) => value * factor);

function greatest(values) {
  let peak = 0;
  for (const value of values) peak = Math.max(peak, Math.abs(value));
  return peak;
}

/** Fixed decimals with a true minus sign. */
function fixed(value, decimals) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** A value with about three digits, for read-outs. */
function readable(value) {
  const size = Math.abs(value);
  return fixed(value, size >= 1000 ? 0 : size >= 100 ? 1 : size >= 1 || size === 0 ? 2 : 3);
}

/** An SI value in a unit, with its name. */
const inUnit = (value, { name, factor, least }, decimals) => `${fixed(value * factor, Math.max(decimals, least))} ${name}`;

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
