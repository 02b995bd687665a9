// Knobs for the values of the model file: sliders, fields, choices, with faults beside them.

/** Keys in view without a search, by table. */
const usual = [
  /^gap\[\d+\]\.(width|law|stiffness|restitution)$/,
  /^motion\.(record|pga|scale|reverse|kind|amplitude|period)$/,
  /^building\[\d+\]\.(storeys|storey_height|stiffness_factor|damping\.ratio|at|mass|stiffness|beam_mass|floor_mass|column\.depth|beam\.depth)$/,
  /^link\[\d+\]\.(stiffness|damping)$/,
];
/** Those of buildings in space, stated or not. */
const usualInSpace = /^(motion\.angle|gap\[\d+\]\.friction)$/;
const isInSpace = (all = knobs) => all.some(({ path, value }) => value !== null && (/^building\[\d+\]\.(plan|at)\b/.test(path) || (/^building\[\d+\]\.kind$/.test(path) && value.includes("space-frame"))));
/** Whether gaps follow from where plans are, and have no width of their own. */
const gapIsOfPlan = () => isInSpace() && !knobs.some(({ path, value }) => /^gap\[\d+\]\.width$/.test(path) && value !== null);

/** With the number that an absent key of space has, so that it has a slider as well. */
function withStandard(knob) {
  if (knob.value !== null || !usualInSpace.test(knob.path)) return knob;
  return { ...knob, number: 0, unit: knob.path === "motion.angle" ? "deg" : "" };
}

/** Only keys that the file states, and some that scale the motion. */
const isUsual = (knob) =>
  (usualInSpace.test(knob.path) && isInSpace()) ||
  usual.some((pattern) => pattern.test(knob.path)) && (knob.value !== null || /\.(pga|stiffness_factor|ratio|reverse)$/.test(knob.path));

/** The ends of a slider around a value: linear for what may vanish, by ratios for stiffnesses and the like. */
function sliderRange(knob) {
  const x = knob.number;
  if (knob.kind === "count") return { low: 1, high: Math.max(2 * x, 10), step: 1 };
  if (knob.kind !== "quantity" || x === null || !Number.isFinite(x)) return null;
  if (knob.path === "motion.angle") return knob.unit === "deg" ? { low: -180, high: 180, step: 1 } : { low: -Math.PI, high: Math.PI };
  if (/^gap.*friction$/.test(knob.path)) return { low: 0, high: 0.9, step: 0.01 };
  if (/restitution$/.test(knob.path)) return { low: 0.05, high: 1, step: 0.01 };
  if (/ratio$/.test(knob.path)) return { low: 0, high: Math.max(0.2, 2 * x) };
  if (/width$/.test(knob.path) && knob.path.startsWith("gap")) return { low: 0, high: x > 0 ? 4 * x : 100 };
  if (!(x > 0)) return null;
  if (/stiffness$|EI$|EA$|modulus$/.test(knob.path)) return { low: x / 10, high: 10 * x, log: true };
  return { low: x / 4, high: 3 * x };
}

/** Lists, which do not fit into one line. */
const isLong = ({ value }) => value?.startsWith("[") && value.length > 16;

/** A number with four digits, as short as it can be written. */
const written = (x) => String(Number(x.toPrecision(4)));

/** What names that only the files of jostle know mean. */
const meanings = { pga: say("peak_acceleration_pga"), EI: say("flexural_rigidity_ei"), EA: say("axial_rigidity_ea") };
const nameOfKnob = ({ name }) => {
  const last = name.split(".").pop();
  const plain = name.replaceAll("_", " ").replaceAll(".", " · ");
  return meanings[last] ? plain.slice(0, plain.length - last.length) + meanings[last] : plain;
};

const rows = new Map();

/** One knob: a label, a slider where there is a number, a field, and its fault. */
class KnobRow {
  constructor(knob) {
    this.row = html("div", `knob${isLong(knob) ? " list" : knob.kind === "text" ? " wide" : ""}`);
    const id = `knob-${KnobRow.count++}`;
    const label = html("label", "knob-name", nameOfKnob(knob), this.row);
    label.htmlFor = id;
    label.title = `${knob.path}: ${knob.doc}`;
    this.field = this.makeField(knob, id);
    this.row.append(this.field);
    this.range = sliderRange(knob);
    if (this.range) {
      this.slider = html("input", "knob-slider", undefined, this.row);
      Object.assign(this.slider, { type: "range", min: 0, max: 1, step: this.range.step ? this.range.step / (this.range.high - this.range.low) : 0.002 });
      this.slider.setAttribute("aria-label", say("key_of_group", { key: knob.name, group: knob.group }));
      this.slider.addEventListener("input", () => this.slide());
    }
    this.fault = html("p", "fault", undefined, this.row);
    this.fault.id = `${id}-fault`;
    this.fault.hidden = true;
    this.field.setAttribute("aria-describedby", this.fault.id);
    this.take(knob);
  }

  static count = 0;

  makeField(knob, id) {
    let field;
    if (knob.kind === "choice" || knob.kind === "flag") {
      field = html("select");
      const words = knob.kind === "flag" ? ["false", "true"] : knob.choices;
      const standard = (knob.default ?? "").replaceAll('"', "");
      if (!words.includes(standard)) field.append(new Option(knob.default ? `(${knob.default})` : "–", ""));
      for (const word of words) field.append(new Option(word, word));
      this.standard = words.includes(standard) ? standard : "";
      field.addEventListener("change", () => change(this.knob.path, field.value));
    } else {
      field = html(isLong(knob) ? "textarea" : "input");
      if (isLong(knob)) field.rows = Math.min(Math.ceil(knob.value.length / 34), 6);
      else field.type = "text";
      field.spellcheck = false;
      field.autocomplete = "off";
      field.placeholder = (knob.default ?? "").replaceAll('"', "");
      if (knob.path === "motion.record") field.setAttribute("list", "record-names");
      field.addEventListener("change", () => change(this.knob.path, field.value.replace(/\s+/g, " ")));
    }
    field.id = id;
    return field;
  }

  /** Shows a value, unless it is being typed. */
  take(knob) {
    this.knob = knob;
    const value = knob.value ?? this.standard ?? "";
    if (document.activeElement !== this.field || this.field.tagName === "SELECT") this.field.value = value;
    if (this.slider && knob.number !== null && document.activeElement !== this.slider) this.place(knob.number);
    else if (this.slider && knob.number !== null) this.say(knob.number);
  }

  place(x) {
    const { low, high, log } = this.range;
    if (x > high) this.range.high = log ? 10 * x : 2 * x;
    if (x < low) this.range.low = log ? x / 10 : Math.min(0, x);
    const { low: from, high: to } = this.range;
    this.slider.value = log ? Math.log(x / from) / Math.log(to / from) : (x - from) / (to - from);
    this.say(x);
  }

  say(x) {
    this.slider.setAttribute("aria-valuetext", `${written(x)} ${this.knob.unit}`);
  }

  slide() {
    const { low, high, log, step } = this.range;
    const share = Number(this.slider.value);
    let x = log ? low * (high / low) ** share : low + share * (high - low);
    if (step) x = Math.round(x / step) * step;
    const typed = `${written(x)} ${this.knob.unit}`.trim();
    this.field.value = typed;
    this.say(x);
    change(this.knob.path, typed);
  }

  showFault(fault) {
    this.fault.hidden = !fault;
    this.fault.textContent = fault ? [fault.problem, fault.remedy].filter(Boolean).join(". ") : "";
    this.field.setAttribute("aria-invalid", fault ? "true" : "false");
  }
}

let shownKnobs = "";

/** Shows the knobs that are wanted; rows stay where they are while only values change. */
function showKnobs() {
  const words = byId("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = (knob) => {
    const text = `${knob.group} ${knob.name} ${knob.path} ${knob.doc}`.toLowerCase();
    return words.every((word) => text.includes(word));
  };
  const wanted = words.length ? knobs.filter(found).slice(0, 80) : knobs.filter(isUsual);
  // Gaps and motion first: they are turned most.
  const rank = (knob) => (knob.path.startsWith("gap") ? 0 : knob.path.startsWith("motion") ? 1 : 2);
  wanted.sort((a, b) => rank(a) - rank(b));
  const described = JSON.stringify(wanted.map((knob) => [knob.path, knob.group, knob.kind, knob.value === null, knob.number === null, knob.unit, isLong(knob)]));
  if (described !== shownKnobs) {
    const focused = document.activeElement?.closest?.(".knob") && [...rows].find(([, row]) => row.row.contains(document.activeElement));
    const onSlider = focused && document.activeElement === focused[1].slider;
    shownKnobs = described;
    rows.clear();
    const list = byId("knob-list");
    list.replaceChildren();
    let group = null;
    let host = list;
    for (const knob of wanted) {
      if (knob.group !== group) {
        group = knob.group;
        host = html("fieldset", "", undefined, list);
        html("legend", "", knob.path.startsWith("gap") ? say("gap_of", { name: group }) : group, host);
      }
      const row = new KnobRow(knob);
      rows.set(knob.path, row);
      host.append(row.row);
    }
    if (!wanted.length) html("p", "quiet", words.length ? say("no_key_matches") : "", list);
    const kept = focused && rows.get(focused[0]);
    if (kept) (onSlider && kept.slider ? kept.slider : kept.field).focus();
  } else {
    for (const knob of wanted) rows.get(knob.path).take(knob);
  }
}

/** Takes over the knobs of an answer. */
function takeKnobs(taken) {
  knobs = isInSpace(taken) ? taken.map(withStandard) : taken;
  showKnobs();
  const editor = byId("text");
  if (document.activeElement !== editor) editor.value = state.text;
}

/** Faults beside their fields; those without one above the knobs. */
function showFaults({ faults, knobs: taken }) {
  if (taken) takeKnobs(taken);
  clearFaults();
  document.body.classList.add("faulty");
  const others = [];
  for (const fault of faults) {
    // A fault of an entry of a list belongs to the list.
    const row = rows.get(fault.path) ?? [...rows].find(([path]) => fault.path.startsWith(`${path}[`))?.[1];
    if (row) row.showFault(fault);
    else others.push(fault);
  }
  const host = byId("faults");
  host.hidden = !others.length;
  for (const fault of others) {
    const place = fault.line ? say("line_of_the_model", { line: fault.line }) : "";
    html("p", "", `${place}${[fault.path, fault.problem].filter(Boolean).join(": ")}`, host);
    if (fault.remedy) html("p", "quiet", fault.remedy, host);
  }
  byId("headline").textContent = say("the_model_has_a_fault");
}

function clearFaults() {
  document.body.classList.remove("faulty");
  for (const row of rows.values()) row.showFault(null);
  byId("faults").replaceChildren();
  byId("faults").hidden = true;
}
