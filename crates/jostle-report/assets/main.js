// Puts the page together: controls, charts, scene, tables.

const byId = (id) => document.getElementById(id);
const colours = (i) => `var(--c${i % 7})`;

const view = new TimeView(page.duration);
const scene = new Scene(byId("scene"));
const hingeLegend = new HingeLegend(byId("hinge-legend"));
const groups = gatherImpacts(page.impacts, 0.02);

const player = new Player(page.duration, (t, following) => {
  scene.draw(t);
  hingeLegend.draw(t);
  view.setCursor(t, following);
  byId("clock").textContent = `${fixed(t, 3)} s`;
  byId("scrub").value = t;
  byId("scrub").setAttribute("aria-valuetext", `${fixed(t, 2)} seconds`);
  const force = forces.reduce((sum, f) => sum + (f.time.length ? Math.max(0, interpolate(f.time, f.values, t)) : 0), 0);
  byId("force-now").textContent = force > 1 ? `${fixed(force / 1e3, 0)} kN` : "";
});
const seek = (t) => player.seek(t);

// --- Charts --------------------------------------------------------------------------------------------

/** The contacts with an impact, hardest first, at most as many as there are colours. */
const struck = contacts.filter((c) => c.impacts > 0).sort((a, b) => b.peak - a.peak);

/** Name of a side of a gap; null is a wall. */
function sideName(building) {
  return building === null ? "wall" : page.buildings[building].name;
}

function contactName(contact) {
  const [left, right] = contact.gap.between.map(sideName);
  return page.gaps.length > 1 ? `${left}–${right}, ${contact.label}` : contact.label;
}

function groundChart(host) {
  const series = [{ label: "ground", colour: "var(--ink-2)", ...ground }];
  return new TimeChart(host, view, { title: "Ground acceleration", unit: "m/s²", series, height: 150, seek });
}

function forceChart(host) {
  const shown = struck.slice(0, 7).sort((a, b) => b.height - a.height);
  const series = shown.map((contact, i) => ({
    label: contactName(contact),
    colour: colours(i),
    time: forces[contact.index].time,
    values: scaled(forces[contact.index].values, 1e-3),
  }));
  const title = struck.length > shown.length ? `Contact force, ${shown.length} hardest of ${struck.length} contacts` : "Contact force";
  return new TimeChart(host, view, { title, unit: "kN", series, seek });
}

/** Energies piled up: the sum of all meets the input. */
function energyChart(host) {
  const terms = ["contact", "hysteretic", "damped", "strain", "kinetic"].filter(
    (term) => run.columns.has(`e:${term}`) && (term !== "hysteretic" || page.hysteretic),
  );
  const input = run.columns.get("e:input");
  if (!terms.length || !input) return null;
  const largest = greatest(input);
  const [factor, unit] = largest >= 1e6 ? [1e-6, "MJ"] : largest >= 1e3 ? [1e-3, "kJ"] : [1, "J"];
  const colour = { contact: 1, hysteretic: 3, damped: 2, strain: 4, kinetic: 5 };
  let pile = new Float64Array(run.time.length);
  const series = terms.map((term) => {
    const own = scaled(run.columns.get(`e:${term}`), factor);
    pile = pile.map((sum, i) => sum + own[i]);
    return { label: term, colour: colours(colour[term]), time: run.time, values: pile, read: own, area: true };
  });
  series.reverse();
  series.push({ label: "input", colour: "var(--ink)", time: run.time, values: scaled(input, factor) });
  return new TimeChart(host, view, { title: "Energy, piled up to the input", unit, series, seek });
}

/** Both sides of a contact with and without pounding, and the closing between them. */
function contactCharts(host, contact) {
  const sides = [0, 1].map((side) => {
    const building = contact.gap.between[side];
    const name = sideName(building);
    // A wall moves with the ground.
    const still = (table) => table && new Float64Array(table.time.length);
    if (building === null) return { building, name, run: still(run), without: still(without) };
    const of = (table) => table && displacementColumn(table, building, contact.floors[side], contact.height);
    return { building, name, run: of(run), without: of(without) };
  });
  if (sides.some((side) => !side.run)) return [];
  const series = [];
  const moving = sides.filter((side) => side.building !== null);
  for (const side of moving) {
    series.push({ label: side.name, colour: colours(side.building), time: run.time, values: scaled(side.run, 1e3) });
  }
  for (const side of moving.filter((s) => s.without)) {
    const values = scaled(side.without, 1e3);
    series.push({ label: `${side.name} without`, colour: colours(side.building), time: without.time, values, dashed: true });
  }
  const closing = ([left, right]) => left.map((u, i) => (u - right[i]) * 1e3);
  const closings = [
    { label: "closing", colour: "var(--ink)", time: run.time, values: closing(sides.map((s) => s.run)) },
  ];
  if (sides.every((side) => side.without)) {
    const values = closing(sides.map((s) => s.without));
    closings.push({ label: "without", colour: "var(--ink-2)", time: without.time, values, dashed: true });
  }
  const width = contact.width * 1e3;
  const levels = [{ value: width, label: `gap ${readableLength(contact.width)}` }];
  const name = contactName(contact);
  return [
    new TimeChart(host, view, { title: `Displacement, ${name}`, unit: "mm", series, seek }),
    new TimeChart(host, view, { title: `Closing, ${name}`, unit: "mm", series: closings, levels, zone: width, seek }),
  ];
}

function floorCharts(host, building, floor) {
  const column = `u:${building}:${floor}`;
  const values = run.columns.get(column);
  if (!values) return [];
  const name = page.buildings[building].name;
  const series = [{ label: name, colour: colours(building), time: run.time, values: scaled(values, 1e3) }];
  if (without && page.gaps.length) {
    const free = scaled(without.columns.get(column) ?? new Float64Array(), 1e3);
    if (free.length) series.push({ label: "without", colour: colours(building), time: without.time, values: free, dashed: true });
  }
  return [new TimeChart(host, view, { title: `Displacement, ${name}, floor ${floor}`, unit: "mm", series, seek })];
}

/** Fills the list of places and draws the charts of the chosen one. */
function placeCharts(host) {
  const select = byId("place");
  const addGroup = (label, entries) => {
    if (!entries.length) return;
    const group = document.createElement("optgroup");
    group.label = label;
    for (const [value, text] of entries) group.append(new Option(text, value));
    select.append(group);
  };
  const byHeight = [...contacts].sort((a, b) => b.height - a.height);
  addGroup("Contacts", byHeight.map((contact) => [`contact ${contact.index}`, contactName(contact)]));
  page.buildings.forEach((building, i) => {
    const floors = building.heights.map((_, k) => building.heights.length - k);
    addGroup(building.name, floors.map((floor) => [`floor ${i} ${floor}`, `${building.name}, floor ${floor}`]));
  });
  let shown = [];
  const show = () => {
    for (const chart of shown) chart.remove();
    const [kind, first, second] = select.value.split(" ");
    shown = kind === "contact" ? contactCharts(host, contacts[Number(first)]) : floorCharts(host, Number(first), Number(second));
  };
  select.addEventListener("change", show);
  const start = struck[0] ?? byHeight[0];
  if (start) select.value = `contact ${start.index}`;
  show();
}

const charts = byId("time-charts");
groundChart(charts);
if (struck.length) forceChart(charts);
placeCharts(html("div", "", undefined, charts));
energyChart(charts);
if (byId("loops")) for (const loop of page.loops) new LoopChart(byId("loops"), view, loop);

// --- Controls ------------------------------------------------------------------------------------------

const scrub = byId("scrub");
scrub.max = page.duration;
scrub.addEventListener("input", () => seek(Number(scrub.value)));
byId("play").addEventListener("click", () => player.toggle());
player.onState = (playing) => {
  byId("play").classList.toggle("playing", playing);
  byId("play").setAttribute("aria-label", playing ? "Pause" : "Play");
};
const speed = byId("speed");
const setSpeed = () => {
  player.speed = Number(speed.value);
  scene.afterglow = 0.25 * Math.min(Math.max(player.speed, 0.02), 1);
};
speed.addEventListener("change", setSpeed);
setSpeed();

/** The next group of impacts in a direction, around the clock. */
function jump(direction) {
  if (!groups.length) return;
  const ahead = groups.find((group) => group.at > player.time + 1e-6) ?? groups[0];
  const behind = groups.findLast((group) => group.at < player.time - 1e-6) ?? groups[groups.length - 1];
  player.seek((direction > 0 ? ahead : behind).at, true);
}
byId("next")?.addEventListener("click", () => jump(1));
byId("previous")?.addEventListener("click", () => jump(-1));

byId("zoom-in").addEventListener("click", () => view.zoom(0.5));
byId("zoom-out").addEventListener("click", () => view.zoom(2));
byId("zoom-all").addEventListener("click", () => view.whole());
const zoomImpact = byId("zoom-impact");
zoomImpact.hidden = !groups.length;
/** Stops at the peak force of an impact, with the impact filling the charts. */
function showImpact({ start, end, at }) {
  const length = Math.max(end - start, 1e-3);
  player.pause();
  seek(at);
  view.show(start - 0.6 * length, end + 0.6 * length);
}
zoomImpact.addEventListener("click", () => {
  const distance = ({ start, end }) => Math.max(start - player.time, player.time - end, 0);
  showImpact(groups.reduce((best, group) => (distance(group) < distance(best) ? group : best)));
});

const exaggeration = byId("exaggeration");
const setExaggeration = (factor) => {
  scene.exaggeration = factor;
  byId("exaggeration-value").textContent = `${factor < 10 ? Number(factor.toFixed(1)) : Math.round(factor)}×`;
  scene.layout();
};
exaggeration.value = Math.log10(scene.exaggeration);
exaggeration.addEventListener("input", () => setExaggeration(10 ** Number(exaggeration.value)));
setExaggeration(scene.exaggeration);
byId("ghost")?.addEventListener("change", (event) => {
  scene.ghost = event.target.checked;
  scene.draw(player.time);
});

byId("show-hinges")?.addEventListener("change", (event) => {
  scene.marked = event.target.checked;
  byId("hinge-legend").hidden = !scene.marked;
  scene.draw(player.time);
});

byId("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});

document.addEventListener("keydown", (event) => {
  const typing = event.target.closest?.("select, textarea, input[type=text]");
  if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const onButton = event.target.closest?.("button, input[type=checkbox]");
  if (event.key === " " && !onButton) {
    event.preventDefault();
    player.toggle();
  } else if (event.key === "[") jump(-1);
  else if (event.key === "]") jump(1);
});

// On paper the pictures are drawn for its width, so that their letters stay readable.
const drawFor = (width) => {
  TimeChart.paperWidth = width;
  scene.layout();
  for (const chart of view.charts) chart.draw();
};
addEventListener("beforeprint", () => drawFor(720));
addEventListener("afterprint", () => drawFor(null));

const marks = byId("marks");
for (const group of gatherImpacts(page.impacts, page.duration / 400)) {
  const mark = html("i", "", undefined, marks);
  mark.style.left = `${(100 * group.at) / page.duration}%`;
  mark.style.height = `${25 + 75 * Math.sqrt(group.peak / scene.hardest)}%`;
}

// --- Impact table --------------------------------------------------------------------------------------

const table = byId("impact-table");
byId("all-impacts")?.addEventListener("click", (event) => {
  table.classList.remove("clipped");
  event.target.remove();
});
/** A number as printed: thin spaces, true minus, powers of ten. */
function parsePrinted(text) {
  const plain = text.replaceAll("\u202f", "").replace("−", "-");
  const [mantissa, power] = plain.split("×10");
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const exponent = power ? Number([...power].map((c) => (c === "⁻" ? "-" : digits.indexOf(c))).join("")) : 0;
  return Number(mantissa) * 10 ** exponent;
}
table?.querySelectorAll("th").forEach((head, column) => {
  head.querySelector("button").addEventListener("click", () => {
    const rising = head.getAttribute("aria-sort") === (column < 2 ? "ascending" : "descending");
    const order = column < 2 ? (rising ? -1 : 1) : rising ? 1 : -1;
    const body = table.tBodies[0];
    const text = (row) => row.cells[column].textContent;
    const compare = column === 0
      ? (a, b) => text(a).localeCompare(text(b), undefined, { numeric: true })
      : (a, b) => (parsePrinted(text(a)) || 0) - (parsePrinted(text(b)) || 0);
    const rows = [...body.rows].sort((a, b) => order * compare(a, b));
    rows.forEach((row, i) => row.classList.toggle("beyond", i >= Number(table.dataset.first)));
    body.append(...rows);
    table.querySelectorAll("th").forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", order > 0 ? "ascending" : "descending");
  });
});
table?.tBodies[0].addEventListener("click", (event) => {
  const row = event.target.closest("tr");
  if (!row) return;
  showImpact({ start: Number(row.dataset.start), end: Number(row.dataset.end), at: Number(row.dataset.at) });
});

for (const button of document.querySelectorAll("button.unfold")) {
  button.addEventListener("click", () => {
    byId(button.dataset.table).classList.remove("clipped");
    button.remove();
  });
}

// The first picture: the hardest impact, or the nearest the buildings come.
function tellingInstant() {
  if (groups.length) return groups.reduce((best, group) => (group.peak > best.peak ? group : best)).at;
  const contact = contacts.filter((c) => !c.gap.between.includes(null)).sort((a, b) => b.height - a.height)[0];
  const [left, right] = contact ? contact.gap.between : [0, 0];
  const of = (building, side) => displacementColumn(run, building, contact?.floors[side] ?? page.buildings[building].heights.length, contact?.height);
  const [u, v] = [of(left, 0), contact ? of(right, 1) : undefined];
  const measure = (i) => (v ? u[i] - v[i] : Math.abs(u[i]));
  let best = 0;
  for (let i = 1; i < (u?.length ?? 0); i++) if (measure(i) > measure(best)) best = i;
  return run.time[best];
}
player.seek(tellingInstant());
