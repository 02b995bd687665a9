// Puts the live page together: frames as they come, compare, save.

/** What the latest frame said of its run. */
let latest = null;
/** The run that others are compared with. */
let pinned = null;
let frames = 0;

/** Shows a run: everything changes in one go, so that nothing flashes. */
function showFrame(head, data, numbers) {
  if (!settle(head.id, head.text)) return;
  latest = head;
  clearFaults();
  load(data, numbers);
  byId("headline").textContent = head.headline;
  for (const [name, markup] of head.parts) {
    const host = byId(`part-${name}`);
    if (host.shown === markup) continue;
    host.shown = markup;
    host.innerHTML = markup;
  }
  byId("code").hidden = !page.gaps.length;
  byId("show-hinges").parentElement.hidden = !page.hinges.length;
  byId("ghost").parentElement.hidden = !page.without || !page.gaps.length;
  for (const id of ["next", "previous"]) byId(id).hidden = !page.impacts.length;
  showAccuracy({ id: head.id, text: head.accuracy, notes: head.notes });
  if (frames === 0) start();
  else refresh();
  frames += 1;
  document.body.dataset.frames = frames;
  takeKnobs(head.knobs);
  byId("gap-of-plan").hidden = !gapIsOfPlan();
  showRecords(head.records);
  fillOver();
  fillCurveRecords();
  moveCursor(present());
  if (curve.stale) computeCurve();
  showComparison();
  keepInAddress();
}

/** Accuracy and notes of the latest run; they come again once it is known whether its results are sensitive. */
function showAccuracy({ id, text, notes }) {
  if (latest?.id !== id) return;
  byId("accuracy").replaceChildren(html("b", "", `${say("accuracy")} `), `${text.replace(/^accuracy: /, "")}.`);
  const host = byId("notes");
  host.hidden = !notes.length;
  host.replaceChildren(...notes.map((note) => html("p", "", note)));
}

/** The list of records of a model that lists several. */
function showRecords(records) {
  const select = byId("several");
  byId("record-choice").hidden = records.length < 2;
  if (select.dataset.names !== records.join()) {
    select.dataset.names = records.join();
    select.replaceChildren(...records.map((name, i) => new Option(name, i)));
  }
  select.value = Math.min(state.record, Math.max(records.length - 1, 0));
  const names = byId("record-names");
  if (names.childElementCount !== knownRecords.length) names.replaceChildren(...knownRecords.map((name) => new Option(name, name)));
}

/** How far a run has come; without a share while it prepares. A part that is repeated does not count back. */
function showProgress({ id, share = null }) {
  if (waiting?.id !== id) return;
  byId("working").hidden = false;
  const bar = byId("progress");
  if (share === null) bar.removeAttribute("value");
  else bar.value = waiting.share = Math.max(share, waiting.share ?? 0);
  const part = share === null ? "" : `${Math.floor(100 * waiting.share)} %, `;
  byId("done").textContent = `${part}${Math.round((performance.now() - waiting.at) / 1000)} s`;
}

function showStopped() {
  byId("headline").textContent = latest ? say("stopped") : say("stopped_before_results");
}

// --- Compare -------------------------------------------------------------------------------------------

/** A number with about four digits. */
const counted = (value, unit) => `${Number.isInteger(value) ? value : readable(value)}${unit ? ` ${unit}` : ""}`;

function showComparison() {
  byId("compare").hidden = !pinned;
  if (!pinned || !latest) return;
  const table = byId("comparison");
  table.replaceChildren();
  const head = html("tr", "", undefined, html("thead", "", undefined, table));
  for (const name of ["", say("pinned"), say("now"), say("change")]) html("th", name ? "number" : "", name, head).scope = "col";
  const body = html("tbody", "", undefined, table);
  const names = [...new Set([...pinned.numbers, ...latest.numbers].map(({ name }) => name))];
  for (const name of names) {
    const [was, is] = [pinned, latest].map(({ numbers }) => numbers.find((number) => number.name === name));
    const row = html("tr", "", undefined, body);
    html("th", "", name, row).scope = "row";
    for (const number of [was, is]) html("td", "number", number ? counted(number.value, number.unit) : "–", row);
    const part = was && is && was.value !== 0 ? (is.value / was.value - 1) * 100 : null;
    html("td", "number", part === null ? "–" : `${part > 0 ? "+" : ""}${fixed(part, 1)} %`, row);
  }
}

function togglePin() {
  pinned = pinned ? null : latest;
  scene?.pin(Boolean(pinned));
  const button = byId("pin");
  button.setAttribute("aria-pressed", String(Boolean(pinned)));
  button.textContent = pinned ? say("unpin") : say("pin");
  showComparison();
}

// --- Narrow screens --------------------------------------------------------------------------------------

const narrow = matchMedia("(max-width: 860px)");
/** What the results say stands before the controls on narrow screens, and in its place on others. */
const firstResults = ["headline", "part-warnings", "part-tiles"].map(byId);
const homes = firstResults.map((own) => {
  const home = document.createComment("");
  own.before(home);
  return home;
});
const beforeControls = html("div", "first-results");
function placeFirstResults() {
  if (narrow.matches) {
    document.querySelector(".columns-of-page").prepend(beforeControls);
    beforeControls.append(...firstResults);
  } else {
    firstResults.forEach((own, i) => homes[i].after(own));
    beforeControls.remove();
  }
}
narrow.addEventListener("change", placeFirstResults);
placeFirstResults();

// --- Controls ------------------------------------------------------------------------------------------

byId("undo").addEventListener("click", () => step(past, future));
byId("redo").addEventListener("click", () => step(future, past));
byId("pin").addEventListener("click", togglePin);
byId("stop").addEventListener("click", () => {
  byId("headline").textContent = say("stopping");
  send({ op: "stop" });
});
byId("search").addEventListener("input", showKnobs);
byId("several").addEventListener("change", (event) => {
  remember(null);
  state.record = Number(event.target.value);
  curveChanged();
  ask();
});
byId("save-model").addEventListener("click", () => {
  const json = state.text.trimStart().startsWith("{");
  keepFile({ name: `${stem()}.${json ? "json" : "toml"}`, kind: "text/plain", text: state.text });
});
byId("save-report").addEventListener("click", () => send({ op: "report", id: 0, ...request() }));

let typing = 0;
byId("text").addEventListener("input", (event) => {
  clearTimeout(typing);
  typing = setTimeout(() => replaceText(event.target.value), 350);
});
byId("text").addEventListener("blur", (event) => (event.target.value = state.text));

document.addEventListener("keydown", (event) => {
  const own = event.target.closest?.("textarea, input:not([type=range], [type=checkbox])");
  if (own || !(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
  event.preventDefault();
  event.shiftKey ? step(future, past) : step(past, future);
});

TimeChart.lazy = true;
bindCurve();
connect();
