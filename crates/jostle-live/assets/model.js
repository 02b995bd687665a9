// The model on this page: its text, changes under way, undo, the address, and what the engine is asked. How messages reach it is in a file of its own: `send` and `connect`.

/** What is asked for: the text of the model file and which of its records to take. */
const state = { text: "", record: 0 };
/** Changes not yet in the text: paths and values as typed. */
let edits = new Map();
let knobs = [];
let knownRecords = [];

const past = [];
const future = [];
/** What Undo returns to, and the knob that last changed. */
let before = null;
let lastChange = { path: null, at: 0 };
/** Changes of one knob within this time are one step of Undo [ms]. */
const oneStep = 700;
const mostSteps = 200;

/** Notes the state before a change, so that Undo returns to it. */
function remember(path) {
  const now = performance.now();
  const same = path !== null && path === lastChange.path && now - lastChange.at < oneStep;
  lastChange = { path, at: now };
  if (same) return;
  past.push({ ...state });
  if (past.length > mostSteps) past.shift();
  future.length = 0;
  showSteps();
}

function step(from, to) {
  if (!from.length) return;
  to.push({ ...state });
  Object.assign(state, from.pop());
  edits.clear();
  lastChange = { path: null, at: 0 };
  showSteps();
  curveChanged();
  ask();
}

function showSteps() {
  byId("undo").disabled = !past.length;
  byId("redo").disabled = !future.length;
}

/** Changes the value of a key; an empty one removes it. */
function change(path, typed) {
  remember(path);
  edits.set(path, typed);
  if (path !== curve.path && path !== curve.across?.path) curveChanged();
  ask();
}

/** Changes several keys in one step. */
function changeAll(pairs) {
  remember(pairs.map(([path]) => path).join());
  for (const [path, typed] of pairs) edits.set(path, typed);
  ask();
}

/** Replaces the text. */
function replaceText(text) {
  remember(null);
  state.text = text;
  edits.clear();
  curveChanged();
  ask();
}

// --- The address ---------------------------------------------------------------------------------------

const fromAddress = (text) => Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));

async function through(bytes, stream) {
  const passed = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(passed).arrayBuffer());
}

let writing = 0;
/** Keeps the state in the address, a moment after the last change. */
function keepInAddress() {
  clearTimeout(writing);
  writing = setTimeout(async () => {
    const kept = JSON.stringify({ text: state.text, record: state.record, curve: curveState() });
    const bytes = await through(new TextEncoder().encode(kept), new CompressionStream("deflate-raw"));
    const pieces = [];
    for (let i = 0; i < bytes.length; i += 8192) pieces.push(String.fromCharCode(...bytes.subarray(i, i + 8192)));
    const text = btoa(pieces.join("")).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    // A page inside another one has no address of its own.
    if (parent === window) history.replaceState(null, "", `${location.pathname}${location.search}#${text}`);
  }, 400);
}

/** The state in the address, if there is one. */
async function fromTheAddress() {
  const text = location.hash.slice(1);
  if (!text) return null;
  try {
    const bytes = await through(fromAddress(text), new DecompressionStream("deflate-raw"));
    const kept = JSON.parse(new TextDecoder().decode(bytes));
    return typeof kept.text === "string" ? kept : null;
  } catch {
    return null;
  }
}

// Another address in the same tab, or a step back in its history, does not load the page anew.
addEventListener("hashchange", async () => {
  const kept = await fromTheAddress();
  if (!kept) return;
  remember(null);
  edits.clear();
  Object.assign(state, { text: kept.text, record: kept.record ?? 0 });
  restoreCurve(kept.curve);
  curveChanged();
  ask();
});

// --- The engine ----------------------------------------------------------------------------------------

let asked = 0;
/** The request that is not answered yet: its number, when it was sent, and its changes. */
let waiting = null;
/** Whether something changed since then. */
let again = false;
/** A run that takes longer than this gives way to a newer one [ms]. */
const patience = 300;
let hurry = 0;
/** Shows how long a run takes, also before its first step. */
let ticking = 0;

const request = () => ({ text: state.text, edits: [...edits], record: state.record });

/** Runs the model as it now stands; one request at a time, unless the one under way takes long. */
function ask() {
  if (waiting && performance.now() - waiting.at < patience) {
    again = true;
    clearTimeout(hurry);
    hurry = setTimeout(() => again && ask(), patience);
    return;
  }
  again = false;
  asked += 1;
  waiting = { id: asked, at: performance.now(), edits: new Map(edits), text: state.text };
  if (!send({ op: "run", id: asked, ...request() })) waiting = null;
  clearInterval(ticking);
  ticking = setInterval(() => (waiting ? showProgress(waiting) : clearInterval(ticking)), 1000);
  showWaiting();
}

/** Says in the page whether an answer is awaited. */
function showWaiting() {
  document.body.dataset.waiting = String(waiting !== null || again);
}

/** Takes an answer over: its text has the changes of its request. */
function settle(id, text) {
  if (!waiting || waiting.id !== id) return false;
  if (text !== undefined && text !== null && state.text === waiting.text) {
    state.text = text;
    for (const [path, typed] of waiting.edits) if (edits.get(path) === typed) edits.delete(path);
  }
  waiting = null;
  clearTimeout(hurry);
  byId("working").hidden = true;
  if (again) ask();
  // After what follows is shown.
  queueMicrotask(showWaiting);
  return true;
}

/** JSON and numbers of a binary message. */
function unpackMessage(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  return [...json, new Float32Array(buffer, 4 + length)];
}

let greeted = false;

/** Takes a message of the engine: text, or a frame with its numbers. */
function receive(data) {
  if (typeof data !== "string") return showFrame(...unpackMessage(data));
  const message = JSON.parse(data);
  const answers = {
    hello: () => hello(message),
    faults: () => settle(message.id, message.text) && showFaults(message),
    progress: () => showProgress(message),
    accuracy: () => showAccuracy(message),
    stopped: () => waiting?.id === message.id && settle(message.id) && showStopped(),
    points: () => addPoints(message),
    marks: () => addMarks(message),
    "no-curve": () => noCurve(message),
    file: () => keepFile(message),
    model: () => replaceText(message.text),
  };
  answers[message.op]?.();
}

/** Says above the page why nothing is computed; an empty text when all is well. */
function showConnection(text) {
  const status = byId("connection");
  status.hidden = !text;
  status.textContent = text;
}

async function hello({ name, text, records, knobs: opened }) {
  showConnection("");
  knownRecords = records;
  if (!greeted) {
    greeted = true;
    const kept = await fromTheAddress();
    state.text = kept?.text ?? text;
    state.record = kept?.record ?? 0;
    restoreCurve(kept?.curve);
    // Values can be changed while the first run is under way.
    if (state.text === text) takeKnobs(opened);
  }
  state.name = name;
  curveChanged();
  ask();
}

/** Gives a file to the browser to keep. */
function keepFile({ name, kind, text }) {
  const link = html("a");
  link.href = URL.createObjectURL(new Blob([text], { type: kind }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Name of the model file without folders and ending. */
const stem = () => (state.name ?? "model").split(/[\\/]/).pop().replace(/\.[^.]*$/, "");
