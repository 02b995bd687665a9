// What the charts over time show of the run that is loaded.

const colours = (i) => `var(--c${i % 7})`;

/** The contacts with an impact, largest peak force first. */
const struckContacts = () => contacts.filter((c) => c.impacts > 0).sort((a, b) => b.peak - a.peak);

/** The wall on a side of a gap, if it is one. */
const wallOf = (gap, side) => page.walls[gap.walls[side] ?? -1];

/** Name of a side of a gap. */
function sideName(gap, side) {
  const building = gap.between[side];
  return building === null ? wallOf(gap, side)?.name || say("wall") : page.buildings[building].name;
}

function contactName(contact) {
  const [left, right] = [0, 1].map((side) => sideName(contact.gap, side));
  return page.gaps.length > 1 ? `${left} ↔ ${right}, ${contact.label}` : contact.label;
}

function groundChart() {
  const series = [{ label: say("ground"), colour: "var(--ink-2)", ...ground }];
  const { across } = page.bearing ?? {};
  if (across) series.push({ label: say("ground_across"), colour: "var(--c3)", time: unpack(across.time), values: unpack(across.values) });
  const { name, factor } = unitOf("m/s²");
  for (const own of series) own.values = scaled(own.values, factor);
  return { title: say("ground_acceleration_title"), unit: name, series, height: 150 };
}

/** The contacts of the chart of forces, at most as many as there are colours, the highest first. */
const forceContacts = () => struckContacts().slice(0, 7).sort((a, b) => b.height - a.height);

/** Colours of these by the index of the contact. */
const contactColours = () => new Map(forceContacts().map((contact, i) => [contact.index, `var(--f${i})`]));

function forceChart() {
  const [struck, shown] = [struckContacts(), forceContacts()];
  const series = shown.map((contact, i) => ({
    label: contactName(contact),
    colour: `var(--f${i})`,
    time: forces[contact.index].time,
    values: scaled(forces[contact.index].values, unitOf("kN").factor),
  }));
  const title = struck.length > shown.length ? say("contact_force_of_some", { shown: shown.length, struck: struck.length }) : say("contact_force_title");
  return { title, unit: unitOf("kN").name, series };
}

/** Every impact at its instant and height, with an area as its peak force; a click goes there. */
function heightChart() {
  const height = unitOf("m");
  const hardest = Math.max(...page.impacts.map((impact) => impact.peak));
  const coloured = contactColours();
  const dots = page.impacts.map((impact) => {
    const contact = contacts[impact.contact];
    return {
      at: impact.at,
      value: contact.height * height.factor,
      size: Number((1.5 + 8.5 * Math.sqrt(impact.peak / hardest)).toFixed(1)),
      colour: coloured.get(contact.index) ?? "var(--ink-2)",
      title: say("impact_in_words", { instant: fixed(impact.at, 3), contact: contactName(contact), force: readable(impact.peak * unitOf("kN").factor) }),
      pick: () => showImpact(impact),
    };
  });
  const roofs = new Map();
  for (const building of page.buildings) {
    const roof = levelsOf(building).at(-1);
    roofs.set(roof, [...(roofs.get(roof) ?? []), building.name]);
  }
  const levels = [...roofs].map(([roof, names]) => ({ value: roof * height.factor, label: say("roof_of_names", { names: names.join(", ") }), quiet: true }));
  return { title: say("height_of_impacts"), unit: height.name, series: [], levels, dots };
}

const energyNames = {
  friction: say("friction"),
  contact: say("contact"),
  hysteretic: say("hysteretic"),
  damped: say("damped"),
  strain: say("strain"),
  kinetic: say("kinetic"),
};

/** Energies, stacked: their sum meets the input. */
function energyChart() {
  const terms = Object.keys(energyNames).filter(
    (term) => run.columns.has(`e:${term}`) && (term !== "hysteretic" || page.hysteretic),
  );
  const input = run.columns.get("e:input");
  if (!terms.length || !input) return null;
  const largest = greatest(input);
  const kilojoules = unitOf("kJ");
  const prefixed = largest >= 1e6 ? [1e-6, "MJ"] : largest >= 1e3 ? [1e-3, "kJ"] : [1, "J"];
  const [factor, unit] = kilojoules.name === "kJ" ? prefixed : [kilojoules.factor, kilojoules.name];
  let pile = new Float64Array(run.time.length);
  const series = terms.map((term) => {
    const own = scaled(run.columns.get(`e:${term}`), factor);
    pile = pile.map((sum, i) => sum + own[i]);
    return { label: energyNames[term], colour: `var(--e-${term})`, time: run.time, values: pile, read: own, area: true };
  });
  series.reverse();
  series.push({ label: say("input"), colour: "var(--ink)", time: run.time, values: scaled(input, factor) });
  return { title: say("energy_balance_stacked"), unit, series };
}

/** Displacement of a side of a face or corner in plan along its normal, at its middle. */
function alongNormal(table, building, { plan, floors, height }, side) {
  const of = (floor) => alongNormalAt(table, building, plan, floor);
  return floors[side] === null ? betweenFloors(building, height, of) : of(floors[side]);
}

function alongNormalAt(table, building, plan, floor) {
  const [u, v, r] = ["u", "v", "r"].map((name) => table.columns.get(`${name}:${building}:${floor}`));
  if (!u || !v || !r) return undefined;
  const { plans, mat } = page.buildings[building];
  const { centre } = floor ? plans[floor - 1] : mat;
  const [dx, dy] = [0, 1].map((axis) => plan.at[axis] - centre[axis]);
  const [nx, ny] = plan.normal;
  return u.map((value, i) => nx * (value - r[i] * dy) + ny * (v[i] + r[i] * dx));
}

/** Both sides of a contact with and without pounding, and the closing between them. */
function contactCharts(contact) {
  const sides = [0, 1].map((side) => {
    const building = contact.gap.between[side];
    const name = sideName(contact.gap, side);
    // A rigid wall moves with the ground.
    const column = wallOf(contact.gap, side)?.column;
    const wall = (table) => table && (table.columns.get(`u:${column}:0`) ?? new Float64Array(table.time.length));
    if (building === null) return { building, name, run: wall(run), without: wall(without) };
    const of = (table) => table && (contact.plan ? alongNormal(table, building, contact, side) : displacementColumn(table, building, contact.floors[side], contact.height));
    return { building, name, run: of(run), without: of(without) };
  });
  if (sides.some((side) => !side.run)) return [];
  const length = unitOf("mm");
  const series = [];
  const moving = sides.filter((side) => side.building !== null);
  for (const side of moving) {
    series.push({ label: side.name, colour: colours(side.building), time: run.time, values: scaled(side.run, length.factor) });
  }
  for (const side of moving.filter((s) => s.without)) {
    const values = scaled(side.without, length.factor);
    series.push({ label: say("name_without", { name: side.name }), colour: colours(side.building), time: without.time, values, dashed: true });
  }
  // Between floors columns bend, so the run itself says how far they close.
  const closing = (table, [left, right]) => scaled(table.columns.get(`c:${contact.index}`) ?? left.map((u, i) => u - right[i]), length.factor);
  const closings = [
    { label: say("closing"), colour: "var(--ink)", time: run.time, values: closing(run, sides.map((s) => s.run)) },
  ];
  if (sides.every((side) => side.without)) {
    const values = closing(without, sides.map((s) => s.without));
    closings.push({ label: say("without"), colour: "var(--ink-2)", time: without.time, values, dashed: true });
  }
  const width = contact.width * length.factor;
  const levels = [{ value: width, label: say("gap_width", { width: readableLength(contact.width) }) }];
  const name = contactName(contact);
  const bent = moving.some((side) => contact.floors[sides.indexOf(side)] === null);
  return [
    { title: (contact.plan ? say("displacement_along_the_normal_of", { name }) : say("displacement_of_contact", { name })) + (bent ? say("straight_lines_between_floors") : ""), unit: length.name, series },
    { title: say("closing_of", { name }), unit: length.name, series: closings, levels, zone: width },
  ];
}

/** What a floor does over time: displacements, and of floors with a plan rotation. */
const FLOOR_CHARTS = [
  ["u", say("displacement_title"), unitOf("mm")],
  ["v", say("displacement_across_title"), unitOf("mm")],
  ["r", say("rotation_title"), { name: "mrad", factor: 1e3 }],
];

const floorCharts = (building, floor) => FLOOR_CHARTS.flatMap((chart) => floorChart(building, floor, chart));

function floorChart(building, floor, [letter, quantity, unit]) {
  const column = `${letter}:${building}:${floor}`;
  const values = run.columns.get(column);
  if (!values) return [];
  const { name } = page.buildings[building];
  const where = floor ? say("floor_one", { one: floor }) : say("mat");
  const series = [{ label: name, colour: colours(building), time: run.time, values: scaled(values, unit.factor) }];
  if (without && page.gaps.length) {
    const free = scaled(without.columns.get(column) ?? new Float64Array(), unit.factor);
    if (free.length) series.push({ label: say("without"), colour: colours(building), time: without.time, values: free, dashed: true });
  }
  return [{ title: `${quantity}, ${name}, ${where}`, unit: unit.name, series }];
}

/** Charts in a host, one for each description; those that are there take the new data over. */
class ChartList {
  constructor(host, view, seek) {
    Object.assign(this, { host, view, seek, charts: [] });
  }

  show(descriptions) {
    descriptions.forEach((description, i) => {
      if (this.charts[i]) this.charts[i].update(description);
      else this.charts.push(new TimeChart(this.host, this.view, { ...description, seek: this.seek }));
    });
    for (const chart of this.charts.splice(descriptions.length)) chart.remove();
  }
}

/** Fills the list of places; keeps the chosen one if it is still there. */
function fillPlaces(select) {
  const kept = select.value;
  select.replaceChildren();
  const addGroup = (label, entries) => {
    if (!entries.length) return;
    const group = document.createElement("optgroup");
    group.label = label;
    for (const [value, text] of entries) group.append(new Option(text, value));
    select.append(group);
  };
  const byHeight = [...contacts].sort((a, b) => b.height - a.height);
  addGroup(say("contacts"), byHeight.map((contact) => [`contact ${contact.index}`, contactName(contact)]));
  page.buildings.forEach((building, i) => {
    const floors = building.heights.map((_, k) => building.heights.length - k);
    if (building.isolated) floors.push(0);
    addGroup(building.name, floors.map((floor) => [`floor ${i} ${floor}`, `${building.name}, ${floor ? say("floor_one", { one: floor }) : say("mat")}`]));
  });
  const start = struckContacts()[0] ?? byHeight[0];
  const wanted = kept || (start && `contact ${start.index}`);
  if ([...select.options].some((option) => option.value === wanted)) select.value = wanted;
}

/** The charts of the place that is chosen. */
function placeCharts(value) {
  const [kind, first, second] = value.split(" ");
  return kind === "contact" ? contactCharts(contacts[Number(first)]) : floorCharts(Number(first), Number(second));
}
