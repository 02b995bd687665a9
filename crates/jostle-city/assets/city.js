// The map of a city: outlines on a canvas, coloured by what the run says of each building.
const page = JSON.parse(document.getElementById("page-data").textContent);
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const element = (id) => document.getElementById(id);

// Outlines: for each building the number of corners, then their steps in decimetres, zigzag, seven bits a byte.
const packed = bytes(page.outlines);
let place = 0;
const whole = () => {
  let value = 0, shift = 1;
  for (;;) {
    const byte = packed[place++];
    value += (byte & 127) * shift;
    if (byte < 128) return value;
    shift *= 128;
  }
};
const signed = () => { const value = whole(); return value % 2 ? -(value + 1) / 2 : value / 2; };
const count = page.count;
const starts = new Uint32Array(count + 1);
const corners = [];
let x = 0, y = 0;
for (let at = 0; at < count; at++) {
  const of = whole();
  starts[at] = corners.length;
  for (let corner = 0; corner < of; corner++) {
    x += signed(); y += signed();
    corners.push(x / 10, y / 10);
  }
}
starts[count] = corners.length;
const boxes = new Float32Array(4 * count);
const all = [Infinity, Infinity, -Infinity, -Infinity];
for (let at = 0; at < count; at++) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = starts[at]; k < starts[at + 1]; k += 2) {
    box[0] = Math.min(box[0], corners[k]); box[2] = Math.max(box[2], corners[k]);
    box[1] = Math.min(box[1], corners[k + 1]); box[3] = Math.max(box[3], corners[k + 1]);
  }
  boxes.set(box, 4 * at);
  for (const k of [0, 1]) { all[k] = Math.min(all[k], box[k]); all[k + 2] = Math.max(all[k + 2], box[k + 2]); }
}

// Answers: a byte each, 255 for certain; 'known' is 0 for buildings without a neighbour.
const known = bytes(page.known);
const values = bytes(page.values);
const width = page.width; // struck at each median, column hits, at least slight … complete alone, the same with neighbours
const medians = page.medians_mm;
const value = (at, column) => values[at * width + column] / 255;
const struck = (at, median) => {
  // Between two medians that were kept the probability is taken as linear in their logarithms.
  let k = 0;
  while (k < medians.length - 2 && medians[k + 1] < median) k++;
  const share = Math.log(median / medians[k]) / Math.log(medians[k + 1] / medians[k]);
  const t = Math.min(1, Math.max(0, share));
  return (1 - t) * value(at, k) + t * value(at, k + 1);
};
const COLUMN = medians.length, ALONE = COLUMN + 1, WITH = ALONE + 4;
const slider = element("median");
const median = () => page.median_mm * 2 ** Number(slider.value);
const shows = {
  struck: { of: (at) => struck(at, median()), steps: [0.05, 0.2, 0.4, 0.6, 0.8], text: (v) => `${Math.round(100 * v)} %` },
  column: { of: (at) => value(at, COLUMN), steps: [0.01, 0.1, 0.25, 0.5, 0.75], text: (v) => `${Math.round(100 * v)} %` },
  moderate: { of: (at) => value(at, WITH + 1), steps: [0.05, 0.2, 0.4, 0.6, 0.8], text: (v) => `${Math.round(100 * v)} %` },
  extensive: { of: (at) => value(at, WITH + 2), steps: [0.02, 0.1, 0.2, 0.4, 0.6], text: (v) => `${Math.round(100 * v)} %` },
  change: { of: (at) => value(at, WITH + 1) - value(at, ALONE + 1), steps: [-0.1, -0.02, 0.02, 0.1, 0.2], text: (v) => `${v < 0 ? "−" : "+"}${Math.abs(Math.round(100 * v))} %` },
};
const LIGHT = ["#e8edf2", "#bcd9ee", "#7fb8de", "#3c8ec6", "#125f9e", "#0a2f5c"];
const DARK = ["#2b323a", "#2c4a63", "#2f6f9f", "#4b9ed6", "#8fcbf2", "#e2f3ff"];
const LIGHT_CHANGE = ["#3c8ec6", "#bcd9ee", "#e8edf2", "#f6c9a8", "#dd7733", "#8e2f0d"];
const DARK_CHANGE = ["#4b9ed6", "#2c4a63", "#2b323a", "#7a4a24", "#d5803c", "#ffc48c"];
const dark = () => {
  const theme = document.documentElement.dataset.theme;
  return theme ? theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
};
const IDLE = () => (dark() ? "#4a535f" : "#c3cad2");
const choice = element("show");
const colours = () => choice.value === "change" ? (dark() ? DARK_CHANGE : LIGHT_CHANGE) : (dark() ? DARK : LIGHT);
const bin = (own, v) => { let k = 0; while (k < own.steps.length && v >= own.steps[k]) k++; return k; };

const canvas = element("map");
const pen = canvas.getContext("2d");
let scale = 1, left = 0, top = 0, chosen = -1, mate = -1;
const fit = () => {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
};
// Whether the map shows the whole city, also after its size changes.
let shows_all = true;
const whole_city = () => {
  shows_all = true;
  // Below it, the length of the scale has a strip of its own.
  const strip = 40 * (devicePixelRatio || 1), height = Math.max(canvas.height - strip, 1);
  scale = 0.96 * Math.min(canvas.width / (all[2] - all[0] || 1), height / (all[3] - all[1] || 1));
  left = (all[0] + all[2]) / 2 - canvas.width / 2 / scale;
  top = (all[1] + all[3]) / 2 + height / 2 / scale;
};
const outline = (at) => {
  for (let k = starts[at]; k < starts[at + 1]; k += 2) {
    const px = (corners[k] - left) * scale, py = (top - corners[k + 1]) * scale;
    if (k === starts[at]) pen.moveTo(px, py); else pen.lineTo(px, py);
  }
  pen.closePath();
};
const seen = (at) => {
  const b = 4 * at;
  return boxes[b + 2] >= left && boxes[b] <= left + canvas.width / scale && boxes[b + 3] >= top - canvas.height / scale && boxes[b + 1] <= top;
};
let waiting = false;
const draw = () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    const own = shows[choice.value], palette = colours();
    pen.clearRect(0, 0, canvas.width, canvas.height);
    const groups = palette.map(() => []), idle = [];
    for (let at = 0; at < count; at++) {
      if (!seen(at)) continue;
      if (known[at]) groups[bin(own, own.of(at))].push(at); else idle.push(at);
    }
    const edge = dark() ? "#15181c" : "#ffffff";
    const fill = (list, colour) => {
      pen.beginPath();
      for (const at of list) outline(at);
      pen.fillStyle = colour;
      pen.fill();
      if (scale > 1.2) { pen.lineWidth = 1; pen.strokeStyle = edge; pen.stroke(); }
    };
    // Buildings without a neighbour are outlines: they have no number.
    pen.beginPath();
    for (const at of idle) outline(at);
    pen.lineWidth = Math.min(1.5, 0.4 * scale) * (devicePixelRatio || 1);
    pen.strokeStyle = IDLE();
    pen.stroke();
    groups.forEach((list, k) => fill(list, palette[k]));
    for (const at of [chosen, mate]) {
      if (at < 0) continue;
      pen.beginPath(); outline(at);
      pen.lineWidth = 3 * (devicePixelRatio || 1);
      pen.strokeStyle = dark() ? "#ff8c42" : "#d55e00";
      pen.stroke();
    }
    // A length in metres or feet in the corner.
    const { name, size } = page.units.height;
    const shown = [5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000].find((own) => own * size * scale > 60) ?? 20000;
    const ratio = devicePixelRatio || 1;
    pen.fillStyle = dark() ? "#e9ebee" : "#1a1d21";
    pen.fillRect(12 * ratio, canvas.height - 14 * ratio, shown * size * scale, 2 * ratio);
    pen.font = `${12 * ratio}px system-ui, sans-serif`;
    pen.fillText(name === "m" && shown >= 1000 ? `${shown / 1000} km` : `${shown} ${name}`, 12 * ratio, canvas.height - 19 * ratio);
  });
};
const legend = () => {
  const own = shows[choice.value], palette = colours();
  const parts = palette.map((colour, k) => {
    const text = k === 0 ? `below ${own.text(own.steps[0])}` : k === palette.length - 1 ? `${own.text(own.steps[k - 1])} and more` : `${own.text(own.steps[k - 1])} to ${own.text(own.steps[k])}`;
    return [colour, text];
  });
  parts.push(["", "no neighbour within reach"]);
  element("legend").replaceChildren(...parts.map(([colour, text]) => {
    const item = document.createElement("span"), box = document.createElement("i");
    if (colour) box.style.background = colour; else box.style.border = `1.5px solid ${IDLE()}`;
    item.append(box, text);
    return item;
  }));
};
const told = () => {
  const { name, size } = page.units.length;
  const shown = (1e-3 * median()) / size;
  element("median-text").value = `${shown < 10 ? shown.toFixed(name === "mm" ? 1 : 2) : Math.round(shown)} ${name}`;
  slider.disabled = choice.value !== "struck";
  legend(); draw(); detail();
};
const detail = () => {
  const box = element("detail");
  // A hint to click is of no use on paper.
  box.classList.toggle("screen", chosen < 0);
  if (chosen < 0) { box.innerHTML = "<h3>No building chosen</h3><p class=\"quiet\">Click a building, or a row of the list below.</p>"; return; }
  box.replaceChildren(...about(chosen), ...(mate >= 0 ? about(mate) : []));
};
/** What is known of a building. */
const about = (own) => {
  const percent = (v) => `${Math.round(100 * v)} %`;
  const rows = [];
  if (known[own]) {
    rows.push(["Struck by a neighbour, averaged over gaps", percent(struck(own, median()))], ["A slab strikes columns, of the samples", percent(value(own, COLUMN))]);
    ["slight", "moderate", "extensive", "complete"].forEach((name, k) => {
      rows.push([`At least ${name}: alone → with`, `${percent(value(own, ALONE + k))} → ${percent(value(own, WITH + k))}`]);
    });
  } else rows.push(["Neighbours within reach", "none"]);
  const list = document.createElement("dl");
  for (const [name, text] of rows) {
    const dt = document.createElement("dt"), dd = document.createElement("dd");
    dt.textContent = name; dd.textContent = text;
    list.append(dt, dd);
  }
  const head = document.createElement("h3");
  head.textContent = `Building ${page.ids[own]}`;
  const what = document.createElement("p");
  what.className = "quiet";
  what.textContent = page.what[page.kinds[own]] + `, ${page.storeys[own]} storey${page.storeys[own] === 1 ? "" : "s"}`;
  return [head, what, list];
};
const at_pointer = (event) => {
  const ratio = devicePixelRatio || 1, r = canvas.getBoundingClientRect();
  const px = left + (event.clientX - r.left) * ratio / scale, py = top - (event.clientY - r.top) * ratio / scale;
  for (let at = 0; at < count; at++) {
    const b = 4 * at;
    if (px < boxes[b] || px > boxes[b + 2] || py < boxes[b + 1] || py > boxes[b + 3]) continue;
    let inside = false;
    for (let k = starts[at], j = starts[at + 1] - 2; k < starts[at + 1]; j = k, k += 2) {
      if ((corners[k + 1] > py) !== (corners[j + 1] > py) && px < (corners[j] - corners[k]) * (py - corners[k + 1]) / (corners[j + 1] - corners[k + 1]) + corners[k]) inside = !inside;
    }
    if (inside) return at;
  }
  return -1;
};
const zoom = (factor, px, py) => {
  shows_all = false;
  const gx = left + px / scale, gy = top - py / scale;
  scale = Math.min(60 * (devicePixelRatio || 1), Math.max(0.5 * Math.min(canvas.width / (all[2] - all[0] || 1), canvas.height / (all[3] - all[1] || 1)), scale * factor));
  left = gx - px / scale; top = gy + py / scale;
  draw();
};
const show_building = (at, other = -1) => {
  chosen = at; mate = other; shows_all = false;
  const b = 4 * at;
  scale = Math.max(scale, 4 * (devicePixelRatio || 1));
  left = (boxes[b] + boxes[b + 2]) / 2 - canvas.width / 2 / scale;
  top = (boxes[b + 1] + boxes[b + 3]) / 2 + canvas.height / 2 / scale;
  draw(); detail();
};
let drag = null;
canvas.addEventListener("pointerdown", (event) => { drag = { x: event.clientX, y: event.clientY, moved: false }; canvas.setPointerCapture(event.pointerId); });
canvas.addEventListener("pointermove", (event) => {
  if (!drag) return;
  const ratio = devicePixelRatio || 1, dx = event.clientX - drag.x, dy = event.clientY - drag.y;
  if (!drag.moved && Math.hypot(dx, dy) < 4) return;
  drag.moved = true; shows_all = false; drag.x = event.clientX; drag.y = event.clientY;
  left -= dx * ratio / scale; top += dy * ratio / scale;
  draw();
});
canvas.addEventListener("pointerup", (event) => {
  if (drag && !drag.moved) { chosen = at_pointer(event); mate = -1; draw(); detail(); }
  drag = null;
});
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  const ratio = devicePixelRatio || 1, r = canvas.getBoundingClientRect();
  zoom(Math.exp(-0.0015 * event.deltaY), (event.clientX - r.left) * ratio, (event.clientY - r.top) * ratio);
}, { passive: false });
element("zoom-in").addEventListener("click", () => zoom(1.6, canvas.width / 2, canvas.height / 2));
element("zoom-out").addEventListener("click", () => zoom(1 / 1.6, canvas.width / 2, canvas.height / 2));
element("zoom-all").addEventListener("click", () => { whole_city(); draw(); });
choice.addEventListener("change", told);
slider.addEventListener("input", told);
for (const row of document.querySelectorAll(".worst tbody tr")) {
  const go = () => show_building(Number(row.dataset.left), Number(row.dataset.right));
  row.addEventListener("click", () => { go(); canvas.scrollIntoView({ block: "nearest" }); });
  row.addEventListener("keydown", (event) => { if (event.key === "Enter") go(); });
}
new ResizeObserver(() => { fit(); if (shows_all) whole_city(); draw(); }).observe(canvas);
new MutationObserver(told).observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", told);
fit(); whole_city(); told();
