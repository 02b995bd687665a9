// Heat map of pairs by storeys, and the curves of the chosen pair.

const data = JSON.parse(document.getElementById("page-data").textContent);
const at = (id) => document.getElementById(id);
const curveOf = new Map();
for (const one of data.curves) curveOf.set([one.pair, one.gap, one.state].join("|"), one);
const find = (pair, gap, state) => curveOf.get([pair, gap, state].join("|"));
const SHOWN = { factor: say("classes_factor"), median: say("classes_median_with"), touching: say("classes_touching"), columns: say("classes_columns") };
const place = (pair) => `${pair.position} · ${pair.alignment}`;
const distinct = (values) => [...new Set(values)];

function options(id, values) {
  at(id).replaceChildren(...values.map(([value, text]) => new Option(text, value)));
}
const same = (value) => [value, value];
options("class", distinct(data.pairs.map((pair) => pair.class)).map(same));
options("neighbour", distinct(data.pairs.map((pair) => pair.neighbour)).map(same));
options("place", distinct(data.pairs.map(place)).map(same));
options("state", data.states.map((name, i) => [i, name]));
options("shown", Object.entries(SHOWN));
// The state with most factors first.
const filled = data.states.map((_, state) => data.pairs.filter((_, pair) => (find(pair, data.gaps[0], state)?.factor ?? null) !== null).length);
at("state").value = filled.indexOf(Math.max(...filled));
at("gap").max = data.gaps.length - 1;
at("gap").value = 0;
let chosen = null;

const digits = (value) => (value === null || value === undefined ? "–" : Number(value.toPrecision(3)).toString());

/** Pairs of the chosen classes and place. */
function chosenPairs() {
  const wanted = (pair) => pair.class === at("class").value && pair.neighbour === at("neighbour").value && place(pair) === at("place").value;
  return data.pairs.map((pair, index) => ({ pair, index })).filter(({ pair }) => wanted(pair));
}

function drawMap() {
  const gap = data.gaps[at("gap").value];
  at("gap-width").textContent = `${digits(gap * unitOf("mm").factor)} ${unitOf("mm").name}`;
  const state = Number(at("state").value);
  const shown = at("shown").value;
  const pairs = chosenPairs();
  const rising = (values) => distinct(values).sort((a, b) => a - b);
  const rows = rising(pairs.map(({ pair }) => pair.storeys));
  const columns = rising(pairs.map(({ pair }) => pair.beside));
  if (!pairs.some(({ index }) => index === chosen)) chosen = pairs[0]?.index ?? null;
  const values = pairs.map(({ index }) => find(index, gap, state)?.[shown]).filter((value) => value !== null && value !== undefined);
  const isFactor = shown === "factor";
  // Factors are seen from 1 on to either side, by ratios.
  const reach = Math.max(Math.log(1.2), ...(isFactor ? values.map((value) => Math.abs(Math.log(value))) : []));
  const low = isFactor ? -reach : 0;
  const high = isFactor ? reach : Math.max(shown === "median" ? 0.1 : 1, ...values);
  const shade = (at) => (isFactor ? { kind: at < 0 ? " worse" : " better", share: Math.abs(at) / reach } : { kind: "", share: at / high });
  const [left, top, side] = [64, 26, 64];
  const picture = svg("svg", { viewBox: `0 0 ${left + side * columns.length + 160} ${top + side * rows.length + 46}`, role: "img", "aria-label": SHOWN[shown], style: `max-width:${left + side * columns.length + 160}px` });
  svg("text", { x: 0, y: 14 }, picture).textContent = say("classes_storeys_of_class");
  rows.forEach((row, r) => (svg("text", { x: left - 8, y: top + side * (rows.length - r - 0.5) + 4, "text-anchor": "end" }, picture).textContent = row));
  columns.forEach((column, c) => svg("text", { x: left + side * (c + 0.5), y: top + side * rows.length + 18, "text-anchor": "middle" }, picture).textContent = column);
  svg("text", { x: left, y: top + side * rows.length + 38 }, picture).textContent = say("classes_storeys_of_neighbour");
  for (const { pair, index } of pairs) {
    const one = find(index, gap, state);
    const value = one?.[shown];
    const known = value !== null && value !== undefined;
    const { kind, share } = known ? shade(isFactor ? Math.log(value) : value) : { kind: "", share: 0 };
    const [x, y] = [left + side * columns.indexOf(pair.beside), top + side * (rows.length - 1 - rows.indexOf(pair.storeys))];
    const cell = svg("rect", { class: `study-cell${kind}${known ? "" : " empty"}${index === chosen ? " linked" : ""}`, x: x + 1, y: y + 1, width: side - 2, height: side - 2, style: `--s:${(100 * share).toFixed(1)}%`, tabindex: 0, role: "button", "aria-label": `${pair.storeys} / ${pair.beside}: ${digits(value)}` }, picture);
    svg("title", {}, cell).textContent = known ? `${SHOWN[shown]}: ${digits(value)}` : one?.note ?? say("classes_no_curve");
    const choose = () => { chosen = index; draw(); };
    cell.addEventListener("click", choose);
    cell.addEventListener("keydown", (event) => { if (event.key === "Enter") choose(); });
    svg("text", { class: `study-number${share > 0.5 ? " on-dark" : ""}`, x: x + side / 2, y: y + side / 2 + 4, "text-anchor": "middle" }, picture).textContent = digits(value);
  }
  const bar = left + side * columns.length + 20;
  for (let i = 0; i < 24; i++) {
    const { kind, share } = shade(low + ((i + 0.5) / 24) * (high - low));
    svg("rect", { class: `study-cell${kind}`, x: bar, y: top + (side * rows.length * (23 - i)) / 24, width: 12, height: (side * rows.length) / 24 + 0.3, style: `--s:${(100 * share).toFixed(1)}%` }, picture);
  }
  for (const part of [0, 0.5, 1]) {
    const at = low + part * (high - low);
    svg("text", { x: bar + 18, y: top + side * rows.length * (1 - part) + 4 }, picture).textContent = digits(isFactor ? Math.exp(at) : at);
  }
  at("map").replaceChildren(picture);
}

/** Standard normal distribution function, within 1e-7 (Abramowitz and Stegun 26.2.17). */
function normal(z) {
  const t = 1 / (1 + 0.2316419 * Math.abs(z));
  const tail = 0.3989422804 * Math.exp(-0.5 * z * z) * t * (0.31938153 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return z > 0 ? 1 - tail : tail;
}

function drawCurves() {
  if (chosen === null) return;
  const gap = data.gaps[at("gap").value];
  const pair = data.pairs[chosen];
  at("chosen").textContent = say("classes_chosen", { storeys: pair.storeys, class: pair.class, beside: pair.beside, neighbour: pair.neighbour, gap: digits(gap * unitOf("mm").factor) });
  const most = data.range[1];
  const [width, height, margin] = [596, 316, { left: 56, right: 20, top: 12, bottom: 44 }];
  const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": say("classes_probability"), style: "max-width:640px" });
  const measure = { ends: [0, most], count: 4, name: `${data.measure} [g]`, lines: false };
  const { px, py } = plot(svg("g", { class: "grid" }, picture), { width, height, margin, x: measure, y: { ends: [0, 1], count: 4, name: say("classes_probability_axis") } });
  data.states.forEach((name, state) => {
    const colour = `var(--c${state})`;
    for (const [own, dash] of [[find(chosen, null, state), "5 4"], [find(chosen, gap, state), "none"]]) {
      if (!own) continue;
      if (own.median !== null) {
        const points = Array.from({ length: 121 }, (_, i) => (most * (i + 0.01)) / 120);
        const line = points.map((value) => `${px(value).toFixed(1)},${py(normal(Math.log(value / own.median) / own.dispersion)).toFixed(1)}`);
        svg("polyline", { points: line.join(" "), fill: "none", stroke: colour, "stroke-width": 2, "stroke-dasharray": dash }, picture);
      }
      for (const [level, cases, reached] of own.counts) {
        const dot = svg("circle", { cx: px(level), cy: py(reached / cases), r: 3.4, stroke: colour, fill: dash === "none" ? colour : "var(--paper)" }, picture);
        svg("title", {}, dot).textContent = `${name}: ${reached} / ${cases}`;
      }
    }
  });
  at("curve").replaceChildren(picture);
  const heads = [say("classes_state"), say("classes_median_without"), say("classes_median_with"), say("classes_interval"), say("classes_factor_short"), say("classes_note")];
  const row = (cells, tag) => {
    const line = document.createElement("tr");
    line.append(...cells.map((text) => Object.assign(document.createElement(tag), { textContent: text })));
    return line;
  };
  const lines = data.states.map((name, state) => {
    const [alone, own] = [find(chosen, null, state), find(chosen, gap, state)];
    const line = row([name, digits(alone?.median), digits(own?.median), own?.interval ? own.interval.map(digits).join(" – ") : "–", digits(own?.factor), own?.note ?? alone?.note ?? (own?.median && !own.interval ? say("classes_no_interval") : "")], "td");
    line.lastChild.className = "in-words";
    line.style.borderLeft = `4px solid var(--c${state})`;
    return line;
  });
  at("numbers").replaceChildren(row(heads, "th"), ...lines);
}

function draw() {
  drawMap();
  drawCurves();
}
for (const id of ["class", "neighbour", "place", "state", "shown", "gap"]) at(id).addEventListener("input", draw);
draw();
