// The worker of a page without a server: requests in, answers out.

let wasm = null;
let computing = false;
const encoder = new TextEncoder();
const decoder = new TextDecoder();
const fromBase64 = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** Without a request for this long, the accuracy of the latest run is looked for [ms]. */
const rest = 400;
/** Points of a curve are computed for this long before requests are looked at again [ms]. */
const turn = 12;

function write(...parts) {
  const length = parts.reduce((sum, part) => sum + part.length, 0);
  let at = wasm.reserve(length);
  for (const part of parts) {
    new Uint8Array(wasm.memory.buffer, at, part.length).set(part);
    at += part.length;
  }
}

/** Sends the answers that wait. */
function drain() {
  for (;;) {
    const kind = wasm.next();
    if (kind === 0) return;
    const bytes = new Uint8Array(wasm.memory.buffer, wasm.output_address(), wasm.output_length()).slice();
    if (kind === 1) postMessage({ data: decoder.decode(bytes) });
    else postMessage({ data: bytes.buffer }, [bytes.buffer]);
  }
}

/** The text of what is wrong. */
function problem() {
  wasm.next();
  return decoder.decode(new Uint8Array(wasm.memory.buffer, wasm.output_address(), wasm.output_length()));
}

let shared = 0;
/** Reports how much of a run is done, not more often than it can be shown. */
function progress(share) {
  const now = performance.now();
  if (now - shared < 150) return;
  shared = now;
  postMessage({ share });
}

async function begin({ compiled, inside, greet }) {
  wasm = (await WebAssembly.instantiate(compiled, { jostle: { progress } })).exports;
  for (const [path, content] of inside.files) {
    const name = encoder.encode(path);
    write(name, fromBase64(content));
    wasm.provide(name.length);
  }
  const name = encoder.encode(inside.name);
  write(name, encoder.encode(inside.text));
  if (!wasm.open(name.length)) return postMessage({ failed: problem() });
  if (greet) drain();
  else while (wasm.next());
}

function answer(request) {
  write(encoder.encode(request));
  const { op } = JSON.parse(request);
  shared = performance.now();
  if (!wasm.answer()) return postMessage({ failed: problem() });
  drain();
  if (op === "run" || op === "report") postMessage({ done: true });
  planSearch();
  if (op === "curve" && !computing) {
    computing = true;
    turns.port2.postMessage(0);
  }
}

/** Computes points of the curve, and lets requests through between them. */
function compute() {
  const begun = performance.now();
  let more = 1;
  while (more && performance.now() - begun < turn) more = wasm.more();
  drain();
  if (more) turns.port2.postMessage(0);
  else computing = false;
}

let search = 0;
/** Looks for the accuracy of the latest run once nothing else is asked for. */
function planSearch() {
  clearTimeout(search);
  search = setTimeout(() => guarded(findAccuracy), rest);
}

/** Takes another run, which a change of the model replaces like any long one. */
function findAccuracy() {
  if (computing) return planSearch();
  postMessage({ busy: true });
  wasm.accuracy();
  drain();
  postMessage({ done: true });
}

/** Runs a step; the engine ends only by a fault in it, or without memory. */
function guarded(step) {
  try {
    step();
  } catch (error) {
    postMessage({ stopped: error.message });
  }
}

const turns = new MessageChannel();
turns.port1.onmessage = () => guarded(compute);

let ready = null;
onmessage = async ({ data }) => {
  if (data.compiled) ready = begin(data).catch((error) => postMessage({ unable: error.message }));
  else {
    await ready;
    if (wasm) guarded(() => answer(data.request));
  }
};
