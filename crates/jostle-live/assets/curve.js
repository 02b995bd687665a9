// Results over one key: a curve that is drawn as its points come, with the present value as a line to drag.

const results = [
  { name: say("peak_force_title"), unit: unitOf("kN").name, factor: 1e3 * unitOf("kN").factor },
  { name: say("number_of_impacts"), unit: "", factor: 1 },
  { name: say("peak_storey_drift"), unit: "%", factor: 1 },
  { name: say("peak_floor_acceleration"), unit: unitOf("m/s²").name, factor: unitOf("m/s²").factor },
];
/** Units in which widths of gaps are typed. */
const metresPer = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, ft: 0.3048, "": 1 };
/** The width of a gap in the unit of the page. */
const gapWidth = (metres) => fixed(metres * unitOf("mm").factor, Math.max(1, unitOf("mm").least));
/** A width that a rule requires, rounded up: whole millimetres, or hundredths of an inch. */
function requiredWidth(metres) {
  const { factor, least } = unitOf("mm");
  const steps = least > 0 ? 100 : 1;
  return fixed(Math.ceil(metres * factor * steps - 1e-6) / steps, least > 0 ? 2 : 0);
}
const curvePoints = 120;
const pointsPerRecord = 60;

const curve = {
  path: null,
  unit: "",
  from: 0,
  to: 1,
  whole: false,
  /** Whether its ends were typed. */
  fixed: false,
  records: [],
  /** Second key of a map, with its range; `null` for a curve. */
  across: null,
  id: 0,
  of: 0,
  /** Points per record, rising. */
  lines: [],
  marks: [],
  problem: "",
  stale: true,
  /** Whether what is drawn belongs to the latest request. */
  fresh: true,
};
let restored = null;

const curveState = () => ({ path: curve.path, from: curve.from, to: curve.to, fixed: curve.fixed, records: curve.records, across: curve.across?.path ?? null, measure: byId("measure").value });
function restoreCurve(kept) {
  restored = kept ?? null;
  if (kept) byId("measure").value = kept.measure;
}

/** Knobs that a curve can run over. */
const runsOver = (knob) => knob.number !== null && (knob.kind === "quantity" || knob.kind === "count") && Number.isFinite(knob.number);

/** The number of the knob of the curve, in its unit. */
function present() {
  const path = curve.path?.replace("[*]", "[0]");
  const knob = knobs.find((one) => one.path === path);
  return knob && knob.unit === curve.unit ? knob.number : null;
}

/** Fills the list of keys and chooses one: the gap, unless another was chosen. */
function fillOver() {
  const select = byId("over");
  const usable = knobs.filter(runsOver);
  const gaps = usable.filter((knob) => /^gap\[\d+\]\.width$/.test(knob.path));
  const entries = gaps.length > 1 ? [["gap[*].width", say("all_gaps")]] : [];
  for (const knob of gaps) entries.push([knob.path, say("gap_of", { name: knob.group })]);
  for (const knob of usable.filter((knob) => !gaps.includes(knob))) {
    entries.push([knob.path, `${knob.group}: ${nameOfKnob(knob)}`]);
  }
  const described = JSON.stringify(entries);
  if (select.dataset.entries !== described) {
    select.dataset.entries = described;
    select.replaceChildren(...entries.map(([path, name]) => new Option(name, path)));
  }
  const known = (path) => entries.some(([other]) => other === path);
  if (restored && known(restored.path)) {
    Object.assign(curve, { path: restored.path, from: restored.from, to: restored.to, fixed: restored.fixed, records: restored.records ?? [] });
    const knob = knobs.find((one) => one.path === curve.path.replace("[*]", "[0]"));
    Object.assign(curve, { unit: knob.unit, whole: knob.kind === "count" });
    curve.across = restored.across ? axisAcross(restored.across) : null;
  } else if (!known(curve.path)) chooseOver(entries[0]?.[0] ?? null);
  restored = null;
  const unit = knobs.find((one) => one.path === curve.path?.replace("[*]", "[0]"))?.unit;
  if (unit !== undefined && unit !== curve.unit) chooseOver(curve.path);
  select.value = curve.path;
  fillAcross();
  byId("curve").hidden = !curve.path;
}

/** Runs the curve over another key, around its present value. */
function chooseOver(path) {
  curve.path = path;
  const knob = knobs.find((one) => one.path === path?.replace("[*]", "[0]"));
  if (!knob) return;
  Object.assign(curve, { unit: knob.unit, whole: knob.kind === "count", fixed: false });
  if (curve.across?.path === path) curve.across = null;
  fitRange(knob);
  curveChanged();
}

/** Values around the present one. */
function rangeAround(knob) {
  const range = sliderRange(knob) ?? { low: 0.5 * knob.number, high: 1.5 * knob.number };
  return { from: range.log ? knob.number / 4 : range.low, to: range.log ? 4 * knob.number : range.high };
}

/** Ends of the curve that show what matters: for a gap, all that still pounds. */
function fitRange(knob) {
  Object.assign(curve, rangeAround(knob));
  const needed = Math.max(...(latest?.needed ?? []).map((width) => width ?? 0), 0);
  if (knob.path.startsWith("gap") && needed > 0) {
    const perUnit = metresPer[knob.unit];
    if (perUnit) curve.to = Math.max(Number(((1.4 * needed) / perUnit).toPrecision(2)), 1.1 * knob.number);
  }
}

/** Notes that the curve no longer belongs to the model. */
function curveChanged() {
  curve.stale = true;
  // What is still computed belongs to the model before.
  if (curve.computing) send({ op: "stop-curve" });
  curve.computing = false;
}

/** Whether the points that came are all. */
const curveDone = () => curve.of > 0 && curve.lines.flat().length >= curve.of;

let computing = 0;
/** Computes the curve a moment after the last change. */
function computeCurve() {
  clearTimeout(computing);
  if (!curve.stale || !curve.path) return;
  // The curve before stays, pale, until points of the new one come.
  byId("curve-picture").classList.add("stale");
  byId("curve-note").textContent = say("computing_the_curve");
  computing = setTimeout(() => {
    curve.stale = false;
    const knob = knobs.find((one) => one.path === curve.path.replace("[*]", "[0]"));
    if (!knob) return;
    if (!curve.fixed) fitRange(knob);
    curve.id += 1;
    curve.fresh = false;
    curve.computing = true;
    send(curveRequest("curve"));
    byId("from").value = written(curve.from);
    byId("to").value = written(curve.to);
    byId("unit").textContent = curve.unit;
  }, 220);
}

function curveRequest(op) {
  const { path, unit, from, to, whole, records, id } = curve;
  const several = records.length > 1;
  if (curve.across) {
    const across = { ...curve.across, points: cellsAlong(curve.across) };
    return { op, ...request(), id, path, unit, from, to, whole, across, points: cellsAlong(curve) };
  }
  const points = whole ? Math.min(Math.round(to - from) + 1, curvePoints) : several ? pointsPerRecord : curvePoints;
  return { op, ...request(), id, path, unit, from, to, whole, records, points };
}

/** Removes the curve before, once anything is known of the new one. */
function beginCurve() {
  if (curve.fresh) return;
  Object.assign(curve, { fresh: true, lines: [], marks: [], problem: "", of: 0 });
  byId("curve-picture").classList.remove("stale");
}

function addPoints({ id, points, of }) {
  if (id !== curve.id) return;
  beginCurve();
  curve.of = of;
  for (const point of points) {
    // Forces come in kN, accelerations in m/s².
    point.y &&= point.y.map((value, i) => value * results[i].factor);
    const line = (curve.lines[point.record] ??= []);
    if (curve.across) line.push(point);
    else line.splice(indexBefore(line.map((p) => p.x), point.x) + 1, 0, point);
  }
  if (curveDone()) curve.computing = false;
  drawCurve();
}

function addMarks({ id, marks }) {
  if (id !== curve.id) return;
  beginCurve();
  curve.marks = marks;
  drawCurve();
}

function noCurve({ id, problem }) {
  if (id !== curve.id) return;
  beginCurve();
  curve.problem = problem;
  drawCurve();
}

const picture = { height: 236, left: 62, right: 16, top: 30, bottom: 40 };

/** Percentile of a sorted list, 0 to 1. */
function percentile(sorted, p) {
  const at = p * (sorted.length - 1);
  const low = Math.floor(at);
  return sorted[low] + (at - low) * ((sorted[low + 1] ?? sorted[low]) - sorted[low]);
}

/** Mean and 16th and 84th percentile of all records where all have a value. */
function spread(lines, measure) {
  const byValue = new Map();
  for (const line of lines) for (const point of line) if (point.y) byValue.set(point.x, [...(byValue.get(point.x) ?? []), point.y[measure]]);
  return [...byValue]
    .filter(([, values]) => values.length === lines.length)
    .sort(([a], [b]) => a - b)
    .map(([x, values]) => {
      const sorted = values.sort((a, b) => a - b);
      return { x, mean: sorted.reduce((sum, value) => sum + value, 0) / sorted.length, low: percentile(sorted, 0.16), high: percentile(sorted, 0.84) };
    });
}

function drawCurve() {
  if (!curve.path) return;
  if (curve.across) return drawMap();
  const host = byId("curve-picture");
  const measure = Number(byId("measure").value);
  const { name, unit } = results[measure];
  const width = Math.max(host.clientWidth, 240);
  const { height } = picture;
  const lines = curve.lines.filter(Boolean);
  const all = lines.flat().filter((point) => point.y);
  const high = Math.max(...all.map((point) => point.y[measure]), 0) * 1.08 || 1;
  const { from, to } = curve;
  const image = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": say("one_over_other", { name, other: curve.path }) });
  const over = byId("over").selectedOptions[0]?.textContent ?? curve.path;
  const x = { ends: [from, to], count: Math.max(4, width / 80), name: `${over} [${curve.unit || "–"}]` };
  const { px, py } = plot(svg("g", { class: "grid" }, image), { width, height, margin: picture, x, y: { ends: [0, high] } });
  Object.assign(picture, { width, px });
  const path = (points, y) => {
    let text = "";
    let pen = "M";
    for (const point of points) {
      if (!point.y && !Number.isFinite(y(point))) { pen = "M"; continue; }
      text += `${pen}${px(point.x).toFixed(1)},${py(y(point)).toFixed(1)}`;
      pen = "L";
    }
    return text;
  };
  const drawing = svg("g", {}, image);
  const valueOf = (point) => (point.y ? point.y[measure] : NaN);
  if (lines.length > 1) {
    const stats = spread(lines, measure);
    if (stats.length > 1) {
      const edge = (key) => stats.map((point) => `${px(point.x).toFixed(1)},${py(point[key]).toFixed(1)}`);
      svg("path", { class: "spread", d: `M${edge("high").join("L")}L${edge("low").reverse().join("L")}Z` }, drawing);
    }
    lines.forEach((line, i) => svg("path", { class: "line thin", style: `--c:${colours(i)}`, d: path(line, valueOf) }, drawing));
    if (stats.length > 1) svg("path", { class: "line mean", d: path(stats.map((s) => ({ x: s.x, y: [s.mean] })), (p) => p.y[0]) }, drawing);
  } else if (lines.length) svg("path", { class: "line curve-line", style: "--c:var(--c0)", d: path(lines[0], valueOf) }, drawing);
  drawMarks(image, px);
  const focused = document.activeElement === picture.handle;
  drawCursor(image);
  host.replaceChildren(image);
  if (focused) picture.handle.focus({ preventScroll: true });
  const records = curve.records.length > 1 ? say("records_of_the_curve", { count: curve.records.length }) : "";
  byId("curve-caption").textContent = say("one_against_other", { result: withUnit(name, unit), key: withUnit(over, curve.unit), records });
  const needed = knownMarks().find((mark) => mark.needed);
  const done = all.length ? say("points_of", { done: lines.flat().length, all: curve.of }) : "";
  const found = needed ? say("smallest_gap_is", { width: gapWidth(needed.width) }) : "";
  if (curve.fresh && !curve.stale) byId("curve-note").textContent = curve.problem || found + (lines.flat().length < curve.of ? done : "") + say("drag_the_line_or_use");
}

const isWidth = () => /^gap\[.*\]\.width$/.test(curve.path ?? "");

/** Marks of the curve; until they come, what the run without contact says. */
function knownMarks() {
  if (curve.marks.length || !isWidth()) return curve.marks;
  const gap = /^gap\[(\d+)\]/.exec(curve.path)?.[1];
  const width = gap === undefined ? null : latest?.needed[Number(gap)];
  return width > 0 ? [{ name: say("no_pounding"), source: say("greatest_closing_without_contact"), width, needed: true }] : [];
}

/** The gap needed, and rules, as lines with letters; their names stand below the curve. */
function drawMarks(image, px) {
  const list = byId("curve-marks");
  list.replaceChildren();
  const perUnit = metresPer[curve.unit];
  if (!isWidth() || !perUnit) return;
  const seen = knownMarks()
    .map((mark) => ({ ...mark, x: mark.width / perUnit }))
    .filter((mark) => mark.x >= curve.from && mark.x <= curve.to)
    .sort((a, b) => a.x - b.x);
  const group = svg("g", { class: "code-marks" }, image);
  // Marks at one place share a letter.
  const places = seen.filter((mark, i) => i === 0 || px(mark.x) - px(seen[i - 1].x) > 0.5).map(({ x }) => x);
  const clusters = [];
  for (const mark of seen) {
    const x = px(mark.x);
    const place = places.findLastIndex((one) => one <= mark.x);
    const letter = String.fromCharCode(97 + (place % 26));
    const line = svg("g", { class: mark.needed ? "needed" : "" }, group);
    const shown = mark.needed ? gapWidth(mark.width) : requiredWidth(mark.width);
    svg("title", {}, line).textContent = say("mark_of_a_rule", { name: mark.name, width: shown, source: mark.source });
    html("li", mark.needed ? "needed" : "", `${letter} ${mark.name}: ${shown} ${unitOf("mm").name}`, list);
    svg("line", { x1: x, x2: x, y1: picture.top - 4, y2: picture.height - picture.bottom }, line);
    const near = clusters.at(-1);
    if (near && x - near.x < 16) near.last = letter;
    else clusters.push({ x, first: letter, last: letter });
  }
  // Letters of lines that stand close together: the first and the last of them.
  for (const { x, first, last } of clusters) {
    svg("text", { x: x + 2, y: picture.top + 8 }, group).textContent = first === last ? first : `${first}–${last}`;
  }
}

/** The present value, as a line that can be dragged and moved with the arrow keys. */
function drawCursor(image) {
  const x = present();
  const handle = svg("g", { class: "handle", tabindex: 0, role: "slider", "aria-label": byId("over").selectedOptions[0]?.textContent ?? say("value_word") }, image);
  svg("line", { class: "handle-line", y1: picture.top - 14, y2: picture.height - picture.bottom }, handle);
  svg("path", { class: "handle-knob", d: "M-7,-9h14v8l-7,8l-7,-8z" }, handle);
  svg("text", { class: "handle-value", y: picture.top - 18, "text-anchor": "middle" }, handle);
  picture.handle = handle;
  moveCursor(x);
}

function moveCursor(x) {
  if (curve.across) return map.cross && moveCross();
  const { handle, px, width } = picture;
  if (!handle) return;
  const seen = x !== null && x >= curve.from - 1e-9 && x <= curve.to * (1 + 1e-9);
  handle.style.display = seen ? "" : "none";
  if (!seen) return;
  const at = px(x);
  const [line, knob, text] = handle.children;
  line.setAttribute("x1", at);
  line.setAttribute("x2", at);
  knob.setAttribute("transform", `translate(${at},${picture.top - 4})`);
  text.setAttribute("x", Math.min(Math.max(at, 40), width - 40));
  text.textContent = `${written(x)} ${curve.unit}`;
  handle.setAttribute("aria-valuemin", curve.from);
  handle.setAttribute("aria-valuemax", curve.to);
  handle.setAttribute("aria-valuenow", x);
  handle.setAttribute("aria-valuetext", text.textContent);
}

/** Sets the key of the curve to a value. */
function setPresent(x) {
  const inside = Math.min(Math.max(x, curve.from), curve.to);
  const value = curve.whole ? Math.round(inside) : Number(inside.toPrecision(4));
  moveCursor(value);
  change(curve.path, `${value} ${curve.unit}`.trim());
}

function bindCurve() {
  const host = byId("curve-picture");
  let dragging = false;
  const at = (event) => {
    const share = (event.clientX - host.getBoundingClientRect().left - picture.left) / (picture.width - picture.left - picture.right);
    return curve.from + share * (curve.to - curve.from);
  };
  host.addEventListener("pointerdown", (event) => {
    if (event.button || !curve.path) return;
    event.preventDefault();
    host.setPointerCapture(event.pointerId);
    if (curve.across) {
      setBoth(...cellAt(event));
      return map.cross.focus({ preventScroll: true });
    }
    dragging = true;
    setPresent(at(event));
    picture.handle?.focus({ preventScroll: true });
  });
  host.addEventListener("pointermove", (event) => dragging && setPresent(at(event)));
  for (const end of ["pointerup", "pointercancel"]) host.addEventListener(end, () => (dragging = false));
  host.addEventListener("keydown", (event) => {
    if (curve.across) return stepCross(event);
    const step = curve.whole ? 1 : (curve.to - curve.from) / (event.shiftKey ? 20 : 200);
    const moves = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step, PageDown: -10 * step, PageUp: 10 * step };
    const x = present();
    if (x === null || !(event.key in moves) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    setPresent(x + moves[event.key]);
  });
  byId("measure").addEventListener("change", () => {
    drawCurve();
    keepInAddress();
  });
  byId("over").addEventListener("change", (event) => {
    chooseOver(event.target.value);
    computeCurve();
    keepInAddress();
  });
  byId("across").addEventListener("change", (event) => chooseAcross(event.target.value));
  for (const end of ["from", "to"]) {
    byId(end).addEventListener("change", (event) => {
      const typed = Number(event.target.value);
      const ends = { from: curve.from, to: curve.to, [end]: typed };
      const good = event.target.value.trim() !== "" && Number.isFinite(typed) && ends.from < ends.to;
      event.target.setAttribute("aria-invalid", String(!good));
      if (!good) {
        byId("curve-note").textContent = say("the_curve_needs_two_numbers");
        return;
      }
      Object.assign(curve, ends, { fixed: true });
      curveChanged();
      computeCurve();
      keepInAddress();
    });
  }
  byId("save-study").addEventListener("click", () => send({ ...curveRequest("study"), id: curve.id }));
  new ResizeObserver(() => requestAnimationFrame(drawCurve)).observe(host.parentElement);
}

/** Boxes for the records of the curve. */
function fillCurveRecords() {
  const host = byId("curve-records");
  const names = [...new Set([...(latest?.records ?? []), ...knownRecords])];
  if (host.dataset.names === names.join()) return;
  host.dataset.names = names.join();
  host.replaceChildren();
  for (const name of names) {
    const label = html("label", "", undefined, host);
    const box = html("input", "", undefined, label);
    box.type = "checkbox";
    box.checked = curve.records.includes(name);
    label.append(` ${name}`);
    box.addEventListener("change", () => {
      curve.records = names.filter((_, i) => host.querySelectorAll("input")[i].checked);
      curveChanged();
      computeCurve();
      keepInAddress();
    });
  }
}
