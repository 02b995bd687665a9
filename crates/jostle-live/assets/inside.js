// Messages to the engine inside this page: WebAssembly in a worker.

/** The model and its files. */
const carried = JSON.parse(byId("inside").textContent);
let worker = null;
let compiled = null;
/** Runs and reports that the worker has not finished. */
let busy = 0;

const fromBase64 = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

function send(message) {
  if (!worker) return false;
  const long = message.op === "run" || message.op === "report";
  if (message.op === "stop") {
    restart();
    if (waiting) receive(JSON.stringify({ op: "stopped", id: waiting.id }));
    return true;
  }
  // A run cannot be interrupted from outside: a newer one starts a new worker.
  if (message.op === "run" && busy) restart();
  if (long) busy += 1;
  worker.postMessage({ request: JSON.stringify(message) });
  return true;
}

/** Ends the worker and what it computes, and starts another one. */
function restart() {
  worker?.terminate();
  busy = 0;
  curveChanged();
  const source = new Blob([byId("worker").textContent], { type: "text/javascript" });
  const address = URL.createObjectURL(source);
  worker = new Worker(address);
  worker.onmessage = ({ data }) => take(data);
  worker.postMessage({ compiled, inside: carried, greet: !greeted });
}

function take({ data, share, busy: searching, done, failed, stopped, unable }) {
  if (stopped !== undefined) failed = say("the_engine_stopped", { reason: stopped });
  if (unable !== undefined) failed = say("the_engine_cannot_be_started", { reason: unable });
  if (data !== undefined) receive(data);
  if (share !== undefined && waiting) showProgress({ id: waiting.id, share });
  if (searching) busy += 1;
  if (done) busy = Math.max(busy - 1, 0);
  if (failed !== undefined) {
    const id = waiting?.id;
    restart();
    if (id !== undefined) settle(id);
    showFaults({ faults: [{ path: "", problem: failed }] });
  }
}

async function connect() {
  if (typeof DecompressionStream === "undefined" || typeof WebAssembly === "undefined") {
    showConnection(say("this_page_needs_a_browser"));
    return;
  }
  try {
    const bytes = await through(fromBase64(byId("engine").textContent), new DecompressionStream("gzip"));
    compiled = await WebAssembly.compile(bytes);
  } catch (error) {
    showConnection(say("the_engine_of_this_page_cannot", { reason: error.message }));
    return;
  }
  byId("engine").remove();
  restart();
}
