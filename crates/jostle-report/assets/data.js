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
  // Histories are thinned; peaks of impacts are known.
  for (const { contact, at, peak } of page.impacts ?? []) {
    const { time, values } = forces[contact];
    const before = indexBefore(time, at);
    const nearest = at - time[before] < time[before + 1] - at ? before : before + 1;
    if (values[nearest] > 0.98 * peak) [time[nearest], values[nearest]] = [at, peak];
  }
  contacts = page.gaps.flatMap((gap) => gap.contacts.map((contact) => ({ ...contact, gap })));
}

const embedded = document.getElementById("page-data");
if (embedded) load(JSON.parse(embedded.textContent), null);

/** Displacement history of a building at a height: of a floor, or between floors on a straight line. Floor 0 is its mat. */
function displacementColumn(table, building, floor, height) {
  const of = (floor) => table.columns.get(`u:${building}:${floor}`);
  return floor || floor === 0 ? of(floor) : betweenFloors(building, height, of);
}

/** What floors have, as a list over time, at a height between them, on a straight line. */
function betweenFloors(building, height, of) {
  const [base, ...floors] = levelsOf(page.buildings[building]);
  const above = floors.findIndex((h) => h >= height - 1e-3);
  if (above < 0) return undefined;
  const below = above > 0 ? floors[above - 1] : base;
  const part = (height - below) / (floors[above] - below);
  const [upper, lower] = [of(above + 1), of(above)];
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
