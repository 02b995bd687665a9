// Puts the page together: controls, charts, scene, tables.

const byId = (id) => document.getElementById(id);

let view, scene, space, orbits = [], hingeLegend, groups, player, above, beside, below, panels;
const seek = (t) => player.seek(t);

/** Builds the page around the run that is loaded. */
function start() {
  loadHinges();
  view = new TimeView(page.duration);
  scene = new Scene(byId("scene"));
  showSpace();
  player = new Player(page.duration, showInstant);
  const charts = byId("time-charts");
  above = new ChartList(html("div", "", undefined, charts), view, seek);
  beside = new ChartList(html("div", "place", undefined, charts), view, seek);
  below = new ChartList(html("div", "", undefined, charts), view, seek);
  panels = new ImpactPanels(byId("impact-panels"));
  bind();
  show();
  exaggeration.value = Math.log10(scene.exaggeration);
  setExaggeration(scene.exaggeration);
  setSpeed();
  player.seek(tellingInstant());
}

/** The scene and the paths of buildings in space. Only pages that may show them have these parts and their scripts. */
function showSpace() {
  const inSpace = page.buildings.every((building) => building.plans);
  const host = byId("space");
  if (host) {
    byId("in-space").hidden = !inSpace;
    if (inSpace && space) space.refresh();
    else if (inSpace) space = new SpaceScene(host);
    else if (space) space = space.remove();
  }
  const paths = inSpace && byId("orbits");
  paths?.replaceChildren?.();
  orbits = paths ? page.buildings.map((_, i) => new Orbit(paths, i)) : [];
}

/** Shows the run that is loaded in the page that is there, at the same instant. */
function refresh() {
  loadHinges();
  if (view.full[1] !== page.duration) {
    view.full = [0, page.duration];
    view.range = [0, page.duration];
    player.duration = page.duration;
  }
  for (const loop of loopCharts) view.charts.delete(loop);
  scene.refresh();
  showSpace();
  show();
  player.seek(player.time);
}

let loopCharts = [];

/** Charts, marks and legends of the run that is loaded. */
function show() {
  groups = gatherImpacts(page.impacts, 0.02);
  hingeLegend = new HingeLegend(byId("hinge-legend"));
  byId("scrub").max = page.duration;
  above.show([groundChart(), ...(struckContacts().length ? [forceChart(), heightChart()] : [])]);
  fillPlaces(byId("place"));
  beside.show(placeCharts(byId("place").value));
  below.show([energyChart()].filter(Boolean));
  loopCharts = byId("loops") ? page.loops.map((loop) => new LoopChart(byId("loops"), view, loop)) : [];
  const devices = byId("device-loops");
  // Devices move sideways, as storeys do.
  if (devices) loopCharts.push(...page.devices.map((device) => new LoopChart(devices, view, { ...device, storey: true, backbone: device.outline })));
  for (const loop of loopCharts) loop.draw();
  panels.refresh();
  byId("zoom-impact").hidden = !groups.length;
  const marks = byId("marks");
  marks.replaceChildren();
  for (const group of gatherImpacts(page.impacts, page.duration / 400)) {
    const mark = html("i", "", undefined, marks);
    mark.style.left = `${(100 * group.at) / page.duration}%`;
    mark.style.height = `${25 + 75 * Math.sqrt(group.peak / scene.hardest)}%`;
  }
}

function showInstant(t, following) {
  scene.draw(t);
  space?.draw(t);
  for (const orbit of orbits) orbit.draw(t);
  hingeLegend.draw(t);
  panels.draw(t);
  view.setCursor(t, following);
  byId("clock").textContent = `${fixed(t, 3)} s`;
  byId("scrub").value = t;
  byId("scrub").setAttribute("aria-valuetext", say("seconds", { seconds: fixed(t, 2) }));
  const force = forces.reduce((sum, f) => sum + (f.time.length ? Math.max(0, interpolate(f.time, f.values, t)) : 0), 0);
  byId("force-now").lastChild.textContent = force > 1 ? inThreeDigits(force, unitOf("kN")) : "";
  byId("force-now").firstChild.hidden = !(force > 1);
}

// --- Controls ------------------------------------------------------------------------------------------

const exaggeration = byId("exaggeration");
const setExaggeration = (factor) => {
  scene.exaggeration = factor;
  byId("exaggeration-value").textContent = `${factor < 10 ? Number(factor.toFixed(1)) : Math.round(factor)}×`;
  scene.layout();
};
const speed = byId("speed");
const setSpeed = () => {
  player.speed = Number(speed.value);
  scene.afterglow = 0.25 * Math.min(Math.max(player.speed, 0.02), 1);
};

/** The next group of impacts in a direction, around the clock. */
function jump(direction) {
  if (!groups.length) return;
  const ahead = groups.find((group) => group.at > player.time + 1e-6) ?? groups[0];
  const behind = groups.findLast((group) => group.at < player.time - 1e-6) ?? groups[groups.length - 1];
  const group = direction > 0 ? ahead : behind;
  panels.showAt(group.hardest, group.contact);
  player.seek(group.at, true);
}

/** Stops at the peak force of an impact, with the impact filling the charts. */
function showImpact({ start, end, at, contact, hardest = start }) {
  panels.showAt(hardest, contact);
  const length = Math.max(end - start, 1e-3);
  player.pause();
  seek(at);
  view.show(start - 0.6 * length, end + 0.6 * length);
}

function switchTheme() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
}

/** Connects the controls, once. */
function bind() {
  const scrub = byId("scrub");
  scrub.addEventListener("input", () => seek(Number(scrub.value)));
  byId("play").addEventListener("click", () => player.toggle());
  byId("space-play")?.addEventListener("click", () => player.toggle());
  player.onState = (playing) => {
    byId("play").classList.toggle("playing", playing);
    byId("play").setAttribute("aria-label", playing ? say("pause") : say("play"));
    if (space) byId("space-play").textContent = playing ? say("pause") : say("play");
  };
  speed.addEventListener("change", setSpeed);
  byId("next")?.addEventListener("click", () => jump(1));
  byId("previous")?.addEventListener("click", () => jump(-1));
  byId("place").addEventListener("change", () => beside.show(placeCharts(byId("place").value)));
  byId("zoom-in").addEventListener("click", () => view.zoom(0.5));
  byId("zoom-out").addEventListener("click", () => view.zoom(2));
  byId("zoom-all").addEventListener("click", () => view.whole());
  byId("zoom-impact").addEventListener("click", () => {
    if (!groups.length) return;
    const distance = ({ start, end }) => Math.max(start - player.time, player.time - end, 0);
    showImpact(groups.reduce((best, group) => (distance(group) < distance(best) ? group : best)));
  });
  exaggeration.addEventListener("input", () => setExaggeration(10 ** Number(exaggeration.value)));
  byId("ghost")?.addEventListener("change", (event) => {
    scene.ghost = event.target.checked;
    scene.draw(player.time);
  });
  byId("show-hinges")?.addEventListener("change", (event) => {
    scene.marked = event.target.checked;
    byId("hinge-legend").hidden = !scene.marked;
    scene.draw(player.time);
  });
  byId("theme").addEventListener("click", switchTheme);
  document.addEventListener("keydown", (event) => {
    const typing = event.target.closest?.("select, textarea, input:not([type=range], [type=checkbox])");
    if (typing || event.ctrlKey || event.metaKey || event.altKey) return;
    const onButton = event.target.closest?.("button, summary, input[type=checkbox]");
    if (event.key === " " && !onButton) {
      event.preventDefault();
      player.toggle();
    } else if (event.key === "[") jump(-1);
    else if (event.key === "]") jump(1);
  });
  document.addEventListener("click", tableClick);
  // On paper the pictures are drawn for its width, so that their letters stay readable.
  const drawFor = (width) => {
    TimeChart.paperWidth = width;
    // The canvas has the colours of the screen; paper is light.
    document.documentElement.style.colorScheme = width ? "light" : "";
    scene.layout();
    space?.layout();
    for (const chart of view.charts) chart.draw();
  };
  addEventListener("beforeprint", () => drawFor(720));
  addEventListener("afterprint", () => drawFor(null));
}

// --- Tables --------------------------------------------------------------------------------------------

/** A number as printed: thin spaces, true minus, powers of ten. */
function parsePrinted(text) {
  const plain = text.replaceAll("\u202f", "").replace("−", "-");
  const [mantissa, power] = plain.split("×10");
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const exponent = power ? Number([...power].map((c) => (c === "⁻" ? "-" : digits.indexOf(c))).join("")) : 0;
  return Number(mantissa) * 10 ** exponent;
}
/** Sorts the impact table by a column: by the first two upwards, by the others downwards first. */
function sortBy(table, head) {
  const column = head.cellIndex;
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
}

/** Sorting, unfolding and jumping in tables that come and go with their run. */
function tableClick({ target }) {
  const unfold = target.closest("#all-impacts, button.unfold");
  const table = byId(unfold?.dataset.table ?? "impact-table");
  if (unfold) {
    table.classList.remove("clipped");
    unfold.remove();
  } else if (table?.contains(target)) {
    const head = target.closest("th");
    const row = target.closest("tbody tr");
    if (head && target.closest("button")) sortBy(table, head);
    else if (row?.dataset.at) {
      const [start, end, at, contact] = ["start", "end", "at", "contact"].map((name) => Number(row.dataset[name]));
      showImpact({ start, end, at, contact });
    }
  }
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
if (page) start();
