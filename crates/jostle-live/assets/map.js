// Results over two keys: a heat map that is drawn as its cells come, with the present values as a cross.

/** Cells along each key. */
const mapCells = 24;
/** Colours from low to high: viridis, which rises in lightness, so that it reads without colour vision too. */
const scale = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

function colourOf(share) {
  const at = Math.min(Math.max(share, 0), 1) * (scale.length - 1);
  const low = Math.min(Math.floor(at), scale.length - 2);
  const parts = scale[low].map((from, i) => Math.round(from + (at - low) * (scale[low + 1][i] - from)));
  return `rgb(${parts.join()})`;
}

const knobOf = (path) => knobs.find((one) => one.path === path?.replace("[*]", "[0]"));
const nameOf = (path) => [...byId("over").options].find((option) => option.value === path)?.textContent ?? path;
const withUnit = (name, unit) => `${name}${unit ? ` [${unit}]` : ""}`;

/** The second key with its range; `null` for a curve. */
function axisAcross(path) {
  const knob = knobOf(path);
  if (!knob || path === curve.path) return null;
  const { from, to } = rangeAround(knob);
  return { path, unit: knob.unit, from, to, whole: knob.kind === "count" };
}

const cellsAlong = ({ from, to, whole }) => (whole ? Math.min(Math.round(to - from) + 1, mapCells) : mapCells);

/** Chooses the second key; an empty path returns to the curve. */
function chooseAcross(path) {
  curve.across = path ? axisAcross(path) : null;
  curveChanged();
  computeCurve();
  keepInAddress();
}

/** Fills the list of second keys: all that the curve can run over, except its own. */
function fillAcross() {
  const select = byId("across");
  const options = [...byId("over").options].filter((option) => option.value !== curve.path && option.value !== "gap[*].width");
  const described = options.map((option) => option.value).join();
  if (select.dataset.entries !== described) {
    select.dataset.entries = described;
    select.replaceChildren(new Option(say("no_second_value"), ""), ...options.map((option) => new Option(option.textContent, option.value)));
  }
  // A key that is gone, or that has another unit now, leaves the curve.
  if (curve.across && knobOf(curve.across.path)?.unit !== curve.across.unit) curve.across = null;
  select.value = curve.across?.path ?? "";
}

const map = { left: 72, right: 92, top: 14, bottom: 42, height: 340 };

function drawMap() {
  // Marks of a curve have no place in a map.
  byId("curve-marks").replaceChildren();
  const host = byId("curve-picture");
  const measure = Number(byId("measure").value);
  const { name, unit } = results[measure];
  const { across } = curve;
  const { left, right, top, bottom, height } = map;
  const width = Math.max(host.clientWidth, 260);
  const [columns, lines] = [cellsAlong(curve), cellsAlong(across)];
  const cell = { width: (width - left - right) / columns, height: (height - top - bottom) / lines };
  // Cells are drawn around their values.
  const column = (x) => Math.round(((x - curve.from) / (curve.to - curve.from)) * (columns - 1));
  const line = (z) => Math.round(((z - across.from) / (across.to - across.from)) * (lines - 1));
  const px = (x) => left + (((x - curve.from) / (curve.to - curve.from)) * (columns - 1) + 0.5) * cell.width;
  const py = (z) => height - bottom - (((z - across.from) / (across.to - across.from)) * (lines - 1) + 0.5) * cell.height;
  const known = (curve.lines[0] ?? []).filter((point) => point.z !== undefined);
  const values = known.filter((point) => point.y).map((point) => point.y[measure]);
  const high = Math.max(...values, 0) || 1;
  Object.assign(map, { width, cell, columns, lines, px, py });
  const image = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": say("one_over_two", { name, other: nameOf(curve.path), another: nameOf(across.path) }) });
  const cells = svg("g", { class: "cells" }, image);
  for (const point of known) {
    const box = svg("rect", {
      x: left + column(point.x) * cell.width,
      y: height - bottom - (line(point.z) + 1) * cell.height,
      width: cell.width + 0.6,
      height: cell.height + 0.6,
      class: point.y ? "" : "failed",
      fill: point.y ? colourOf(point.y[measure] / high) : "var(--rule)",
    }, cells);
    const result = point.y ? counted(point.y[measure], unit) : say("the_run_failed");
    svg("title", {}, box).textContent = `${written(point.x)} ${curve.unit}, ${written(point.z)} ${across.unit}: ${result}`;
  }
  const numbers = (key, count, at) => ({ ends: [key.from, key.to], count, place: { at }, lines: false, name: withUnit(nameOf(key.path), key.unit) });
  const x = numbers(curve, Math.max(3, (width - left - right) / 90), px);
  plot(svg("g", { class: "grid" }, image), { width, height, margin: map, x, y: numbers(across, 6, py) });
  const focused = map.cross && document.activeElement === map.cross;
  drawScale(image, high, unit);
  drawCross(image);
  host.replaceChildren(image);
  if (focused) map.cross.focus({ preventScroll: true });
  byId("curve-caption").textContent = say("one_over_two", { name: withUnit(name, unit), other: nameOf(curve.path), another: nameOf(across.path) });
  const done = curve.fresh && known.length < columns * lines ? say("cells_of", { done: known.length, all: columns * lines }) : "";
  if (curve.fresh && !curve.stale) byId("curve-note").textContent = curve.problem || done + say("click_a_cell");
}

/** The colour bar. */
function drawScale(image, high, unit) {
  const { right, top, bottom, height, width } = map;
  const x = width - right + 18;
  const group = svg("g", { class: "grid colour-bar" }, image);
  const steps = 40;
  const part = (height - top - bottom) / steps;
  for (let i = 0; i < steps; i++) {
    svg("rect", { x, y: height - bottom - (i + 1) * part, width: 14, height: part + 0.6, fill: colourOf((i + 0.5) / steps) }, group);
  }
  const values = ticks(0, high, 5);
  for (const value of values.values) {
    if (value > high) continue;
    svg("text", { x: x + 19, y: height - bottom - (value / high) * (height - top - bottom) + 3.5 }, group).textContent = fixed(value, values.decimals);
  }
  svg("text", { x, y: height - bottom + 15 }, group).textContent = unit;
}

/** The present values, as a cross that moves with the arrow keys. */
function drawCross(image) {
  const cross = svg("g", { class: "cross", tabindex: 0, role: "application", "aria-roledescription": say("cursor_of_the_map") }, image);
  // White under black shows on every colour.
  for (const kind of ["under", "over"]) svg("path", { class: kind }, cross);
  map.cross = cross;
  moveCross();
}

/** Present values of both keys; `null` for one that is not a number now. */
const presentBoth = () => [present(), knobOf(curve.across.path)?.number ?? null];

function moveCross([x, z] = presentBoth()) {
  const { cross, px, py, left, right, top, bottom, height, width } = map;
  const inside = x !== null && z !== null && x >= curve.from && x <= curve.to && z >= curve.across.from && z <= curve.across.to;
  cross.style.display = inside ? "" : "none";
  if (!inside) return;
  for (const line of cross.children) line.setAttribute("d", `M${left},${py(z)}H${width - right}M${px(x)},${top}V${height - bottom}`);
  cross.setAttribute("aria-label", `${nameOf(curve.path)} ${written(x)} ${curve.unit}, ${nameOf(curve.across.path)} ${written(z)} ${curve.across.unit}`);
}

/** Sets both keys. */
function setBoth(x, z) {
  const near = ({ from, to, whole }, value) => {
    const within = Math.min(Math.max(value, from), to);
    return whole ? Math.round(within) : Number(within.toPrecision(4));
  };
  const values = [near(curve, x), near(curve.across, z)];
  moveCross(values);
  changeAll([curve, curve.across].map(({ path, unit }, i) => [path, `${values[i]} ${unit}`.trim()]));
}

/** The values under the pointer, at the middle of their cell. */
function cellAt(event) {
  const box = byId("curve-picture").getBoundingClientRect();
  const index = (share, count) => Math.min(Math.max(Math.floor(share * count), 0), count - 1) / (count - 1);
  const x = index((event.clientX - box.left - map.left) / (map.width - map.left - map.right), map.columns);
  const z = index((box.top + map.height - map.bottom - event.clientY) / (map.height - map.top - map.bottom), map.lines);
  const { across } = curve;
  return [curve.from + x * (curve.to - curve.from), across.from + z * (across.to - across.from)];
}

/** Moves the cross by one cell. */
function stepCross(event) {
  const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const [x, z] = presentBoth();
  if (!(event.key in moves) || x === null || z === null || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  const [right, up] = moves[event.key];
  const { across } = curve;
  setBoth(x + (right * (curve.to - curve.from)) / (map.columns - 1), z + (up * (across.to - across.from)) / (map.lines - 1));
}
