// What cracks and yields: where its marks are drawn, how many there are, and the loops of the worst.

/** Places that can yield. */
let hinges = [];

/** Takes over the places of the run that is loaded. */
function loadHinges() {
  hinges = page.hinges.map(([building, kind, level, line, end, cracked, yielded, ductility, buckles]) => ({
    building,
    kind,
    level,
    line,
    end,
    cracked: cracked ?? Infinity,
    yielded: yielded ?? Infinity,
    grade: gradeOf(ductility),
    buckles,
  }));
}

/** Lower ends of the ductilities that share a colour. */
const grades = [1, 2, 4, 6, 8];
/** Place of a ductility among them. */
const gradeOf = (ductility) => Math.max(grades.findLastIndex((low) => ductility >= low), 0);

/** Names of the stages; braces that buckle have none between. */
function stageNames() {
  const some = hinges.some((hinge) => hinge.buckles);
  const all = hinges.every((hinge) => hinge.buckles);
  return [
    all ? say("neither_yielded_nor_buckled") : say("not_cracked"),
    all ? null : say("cracked"),
    some ? say("yielded_or_buckled") : say("yielded"),
  ];
}

/** 0 not cracked, 1 cracked, 2 yielded. */
function stageAt(hinge, t) {
  return t >= hinge.yielded ? 2 : t >= hinge.cracked ? 1 : 0;
}

/** Outline of the mark of a stage around a point: rings, discs, and larger diamonds, told apart without colour. */
function markOutline(stage, x, y, size) {
  const r = size * [0.72, 0.95, 1.4][stage];
  const at = `${(x - r).toFixed(1)},${y.toFixed(1)}`;
  const d = r.toFixed(1);
  if (stage < 2) return `M${at}a${d},${d} 0 1 0 ${(2 * r).toFixed(1)},0a${d},${d} 0 1 0 ${(-2 * r).toFixed(1)},0z`;
  return `M${at}l${d},${-d}l${d},${d}l${-d},${d}z`;
}

/** The legend below the buildings, with counts that follow the clock. */
class HingeLegend {
  constructor(host) {
    host?.replaceChildren();
    if (host && page.buildings.some((building) => building.diagonals?.some((own) => own.stage > 0))) html("span", "key", say("struts_of_the_whole_run"), host);
    if (!host || !hinges.length) return;
    const named = page.buildings.length > 1;
    this.rows = stageNames().map((name, stage) => {
      if (name === null) return [];
      const key = html("span", "key", undefined, host);
      const mark = svg("svg", { class: "mark", viewBox: "0 0 14 14", "aria-hidden": "true" }, key);
      svg("path", { class: `hinge-${stage}`, d: markOutline(stage, 7, 7, 4.2) }, mark);
      html("span", "", name, key);
      const counts = page.buildings.map((building, i) => {
        if (!hinges.some((hinge) => hinge.building === i)) return null;
        const place = html("span", "count", undefined, key);
        if (named) html("span", "", `${building.name} `, place);
        return html("output", "", "", place);
      });
      return counts;
    });
    if (!hinges.some((hinge) => hinge.yielded < Infinity)) return;
    const scale = html("span", "key", say("yielded_greatest_ductility"), host);
    grades.forEach((low, grade) => {
      const step = html("span", "grade-step", undefined, scale);
      const mark = svg("svg", { class: "mark", viewBox: "0 0 14 14", "aria-hidden": "true" }, step);
      svg("path", { class: `hinge-2 grade-${grade}`, d: markOutline(2, 7, 7, 4.2) }, mark);
      html("span", "", grade + 1 < grades.length ? `${low}–${grades[grade + 1]}` : say("over_value", { value: low }), step);
    });
  }

  draw(t) {
    if (!this.rows) return;
    const counts = this.rows.map((row) => row.map(() => 0));
    for (const hinge of hinges) counts[stageAt(hinge, t)][hinge.building] += 1;
    this.rows.forEach((row, stage) =>
      row.forEach((place, i) => {
        if (place) place.textContent = counts[stage][i];
      }),
    );
  }
}
