// The buildings to scale, moving. Sideways motion and gaps share one exaggeration, so that floors that
// touch are drawn touching.

/** Whether both sides of a gap stand in the row of buildings. */
const inARow = (gap) => !gap.walls.some((wall) => page.walls[wall ?? -1]?.on_site);

class Scene {
  constructor(host) {
    this.host = host;
    this.svg = svg("svg", { role: "img", "aria-label": say("the_buildings_at_the_current_instant") }, host);
    this.ghost = false;
    this.marked = true;
    this.time = 0;
    this.take();
    this.exaggeration = this.fitting();
    this.build();
    new ResizeObserver(([{ contentRect }]) => {
      this.room = contentRect.width;
      requestAnimationFrame(() => this.layout());
    }).observe(host);
  }

  /** What the run that is loaded says. */
  take() {
    this.low = Math.min(...page.buildings.map((b) => b.elevation ?? 0));
    this.top = Math.max(...page.buildings.flatMap((b) => levelsOf(b))) - this.low;
    this.run = this.columns(run);
    this.peak = Math.max(1e-9, ...this.run.flat().filter(Boolean).map(greatest));
    this.groundPeak = greatest(ground.values) || 1;
    this.hardest = Math.max(1e-9, ...page.impacts.map((impact) => impact.peak));
    this.other = without && this.columns(without);
    this.byContact = contacts.map((contact) => page.impacts.filter((impact) => impact.contact === contact.index));
    this.starts = this.byContact.map((list) => list.map((impact) => impact.start));
  }

  /** Shows another run; the picture keeps its exaggeration and its instant. */
  refresh() {
    this.take();
    this.svg.replaceChildren();
    this.build();
    this.layout();
  }

  /** Keeps the present run, to be drawn behind others of the same floors; `null` forgets it. */
  pin(kept) {
    this.pinned = kept && { table: run, columns: this.run, floors: page.buildings.map((b) => b.heights.length).join() };
    this.draw(this.time);
  }

  /** Displacement columns: per building, per floor from the ground or the mat up, which is floor 0. */
  columns(table) {
    return page.buildings.map((b, i) => [0, ...b.heights].map((_, floor) => table.columns.get(`u:${i}:${floor}`)));
  }

  /** The round exaggeration that moves the roofs by about a twentieth of the height. */
  fitting() {
    const wanted = (0.06 * this.top) / this.peak;
    return [1, 2, 5, 10, 20, 50, 100].findLast((f) => f <= wanted) ?? 1;
  }

  build() {
    this.back = svg("g", { class: "back" }, this.svg);
    this.parts = page.buildings.map((building, i) => {
      const group = svg("g", { class: "building", style: `--c:var(--c${i % 7})` }, this.svg);
      return {
        pinned: svg("path", { class: "pinned" }, group),
        ghost: svg("path", { class: "ghost" }, group),
        bearings: svg("path", { class: "bearings" }, group),
        panels: svg("path", { class: "panels" }, group),
        struts: [1, 2].map((stage) => svg("path", { class: `strut-${stage}` }, group)),
        walls: svg("path", { class: "panels" }, group),
        braces: svg("path", { class: "braces" }, group),
        columns: svg("path", { class: "columns" }, group),
        floors: svg("path", { class: building.frame ? "beams" : "slabs" }, group),
        // Yielded ones by their ductility.
        hinges: [0, 1].map((stage) => svg("path", { class: `hinge-${stage}` }, group)),
        yielded: grades.map((_, grade) => svg("path", { class: `hinge-2 grade-${grade}` }, group)),
        places: hinges.filter((hinge) => hinge.building === i),
      };
    });
    // A wall of the site has no place in a row of buildings.
    this.walls = page.walls.map((wall) => ({
      ...wall,
      beside: wall.on_site ? [null, null] : wall.beside,
      path: svg("path", { class: "wall" }, this.svg),
    }));
    this.links = page.links.map((link) => ({ link, path: svg("path", { class: "link" }, this.svg) }));
    this.flashes = contacts.map(() => svg("circle", { class: "flash" }, this.svg));
    // Above the flashes, which would hide signs and digits.
    for (const part of this.parts) part.sway = svg("text", { class: "sway", "text-anchor": "middle" }, this.svg);
    this.instant = svg("text", { class: "instant", x: 12, y: 24 }, this.svg);
    this.arrow = svg("path", { class: "ground-arrow" }, this.svg);
  }

  /** Places the buildings; sizes the picture to the room there is. */
  layout() {
    this.room ??= this.host.clientWidth;
    this.width = TimeChart.paperWidth ?? Math.max(this.room, 240);
    const f = this.exaggeration;
    const free = f * this.peak + 0.02 * this.top + 0.5;
    this.thickness = 0.05 * this.top;
    // Beside a wall: the gap before it, and its thickness.
    const away = (wall, side) => (wall.widths[side] === null ? free : f * wall.widths[side]);
    const outside = (side, building) => {
      const own = this.walls.filter((wall) => wall.beside[side] === building && wall.beside[1 - side] === null);
      return own.length ? Math.max(...own.map((wall) => away(wall, side) + this.thickness)) : null;
    };
    const last = page.buildings.length - 1;
    this.ends = [outside(1, 0), outside(0, last)];
    const [room, roomRight] = this.ends.map((ends) => ends ?? free);
    const widths = page.buildings.map((b) => b.spans.reduce((sum, span) => sum + span, 0));
    let x = room;
    this.left = widths.map((width, i) => {
      const start = x;
      const gaps = page.gaps.filter((g) => g.between[0] === i && g.between[1] !== null);
      const narrowest = Math.min(...gaps.map((g) => g.width));
      const shared = this.walls.find((wall) => wall.beside[0] === i && wall.beside[1] === i + 1);
      if (gaps.length) x += width + f * narrowest;
      else if (shared) x += width + away(shared, 0) + this.thickness + away(shared, 1);
      else x += width + (outside(0, i) ?? f * this.peak + 1) + (outside(1, i + 1) ?? f * this.peak + 1);
      return start;
    });
    for (const wall of this.walls) {
      if (wall.on_site) continue;
      const [left, right] = wall.beside;
      const from = left === null ? null : this.left[left] + widths[left] + away(wall, 0);
      const to = right === null ? from + this.thickness : this.left[right] - away(wall, 1);
      wall.faces = [from ?? to - this.thickness, to];
    }
    this.pit = page.buildings.some((building) => building.isolated || building.footing) ? Scene.pit : 0;
    this.below = Scene.below + this.pit;
    const total = this.left[last] + widths[last] + roomRight;
    // On paper the picture shares its page with the answer.
    const tallest = TimeChart.paperWidth ? 330 : this.width < 600 ? 340 : 560;
    this.scale = Math.min((this.width - 2 * Scene.beside) / total, (tallest - 100) / this.top);
    this.base = this.top * this.scale + 34;
    this.shift = (this.width - total * this.scale) / 2;
    this.svg.setAttribute("viewBox", `0 0 ${this.width} ${this.base + 70 + this.below}`);
    this.widths = widths;
    this.drawBack();
    this.draw(this.time);
  }

  /** Height of bearings, and of contact springs, as drawn [px]. */
  static pit = 20;

  /** Room for dimensions on either side of the row and below it [px]. */
  static beside = 34;
  static below = 22;

  px(x) {
    return this.shift + x * this.scale;
  }

  /** Of a height above the datum of elevations. */
  py(height) {
    return this.base - (height - this.low) * this.scale;
  }

  /** The surface of the ground: the datum, down to the foundation below a building that reaches deeper, as high as the foundation around
   * one that stands higher. */
  surface() {
    let path = "";
    page.buildings.forEach((building, i) => {
      const foot = levelsOf(building)[0];
      const [level, own] = [this.py(Math.max(foot, 0)), this.py(foot)];
      const [left, right] = [this.left[i], this.left[i] + this.widths[i]].map((x) => this.px(x));
      path += i ? `H${(left + this.px(this.left[i - 1] + this.widths[i - 1])) / 2}V${level}` : `M0,${level}`;
      path += `H${left}V${own}H${right}V${level}`;
    });
    return `${path}H${this.width}`;
  }

  drawBack() {
    const back = this.back;
    back.replaceChildren();
    const surface = this.surface();
    svg("path", { class: "soil", d: `${surface}V${this.base + 7}H0Z` }, back);
    svg("path", { class: "ground", d: surface }, back);
    page.buildings.forEach((building, i) => {
      const base = this.py(levelsOf(building)[0]);
      if (building.footing) this.drawFooting(building.footing, this.left[i] + this.widths[i] / 2, base);
      if (!building.isolated) return;
      const free = this.exaggeration * this.peak;
      const walls = [0, 1].map((side) => this.walls.find((wall) => wall.beside[1 - side] === i));
      const from = this.px(walls[0] ? walls[0].faces[1] : this.left[i] - free);
      const to = this.px(walls[1] ? walls[1].faces[0] : this.left[i] + this.widths[i] + free);
      svg("rect", { class: "pit", x: from, y: base - 1, width: Math.max(to - from, 0), height: this.pit + 1 }, back);
      svg("path", { class: "ground", d: `M${from},${base}V${base + this.pit}H${to}V${base}` }, back);
      svg("rect", { class: "soil", x: from, y: base + this.pit, width: Math.max(to - from, 0), height: 7 }, back);
    });
    const row = this.base + 24 + this.below;
    page.buildings.forEach((building, i) => {
      const room = page.buildings.length > 1 ? this.widths[i] * this.scale + 4 : this.width;
      const x = this.px(this.left[i] + this.widths[i] / 2);
      const label = svg("text", { class: "name", x, y: row, "text-anchor": "middle" }, back);
      label.textContent = building.name;
      // Measured only if it may be too long: that makes the browser lay out the page at once.
      if (12 * building.name.length < room) return;
      for (let kept = building.name.length - 1; kept > 0 && label.getComputedTextLength() > room; kept--) {
        label.textContent = `${building.name.slice(0, kept)}…`;
      }
    });
    const named = new Set();
    for (const gap of page.gaps) {
      const pair = [...gap.between, ...gap.walls].join();
      if (named.has(pair) || !inARow(gap)) continue;
      named.add(pair);
      const [left, right] = [0, 1].map((side) => this.faceAtRest(gap, side));
      const x = this.px((left + right) / 2);
      const near = Math.min(...gap.between.filter((b) => b !== null).map((b) => this.widths[b])) * this.scale;
      const widths = page.gaps.filter((own) => [...own.between, ...own.walls].join() === pair).map((own) => readableLength(own.width));
      const label = near <= 70 ? widths.join(", ") : widths.length > 1 ? say("gaps_of_widths", { widths: widths.join(", ") }) : say("gap_width", { width: widths[0] });
      svg("text", { class: "gap-name", x, y: row + 17, "text-anchor": "middle" }, back).textContent = label;
    }
    const arrow = { class: "ground-name", x: this.width / 2 - this.reach - 10, y: this.base + 62 + this.below, "text-anchor": "end" };
    svg("text", arrow, back).textContent = this.width < 600 ? say("ground") : say("ground_acceleration");
    page.buildings.forEach((building, i) => this.drawDimensions(building, i));
  }

  /** Bay widths below the ground, storey heights beside the first and the last building. */
  drawDimensions(building, i) {
    const back = this.back;
    const mark = 3.5;
    const metres = (value) => `${Number((value * unitOf("m").factor).toPrecision(4))}`;
    if (building.frame) {
      const y = this.base + 16 + this.pit;
      let x = this.left[i];
      let path = `M${this.px(x).toFixed(1)},${y}H${this.px(x + this.widths[i]).toFixed(1)}`;
      for (const span of [0, ...building.spans]) {
        x += span;
        path += `M${(this.px(x) - mark).toFixed(1)},${y + mark}l${2 * mark},${-2 * mark}`;
        const text = `${metres(span)} ${unitOf("m").name}`;
        if (span * this.scale < 6.2 * text.length) continue;
        const label = { class: "dimension-name", x: this.px(x - span / 2), y: y + 12, "text-anchor": "middle" };
        svg("text", label, back).textContent = text;
      }
      svg("path", { class: "dimension", d: path }, back);
    }
    const last = page.buildings.length - 1;
    if (i !== 0 && i !== last) return;
    const right = i === last && last > 0;
    // Clear of the greatest sway, or outside the wall.
    const sway = this.exaggeration * this.peak;
    const near = right ? this.px(this.left[i] + this.widths[i] + sway) + 14 : this.px(this.left[i] - sway) - 14;
    const x = this.ends[Number(right)] === null ? near : right ? this.width - Scene.beside + 8 : Scene.beside - 8;
    const heights = levelsOf(building);
    const [foot, roof] = [heights[0], heights.at(-1)];
    const storeys = heights.slice(1).map((height, k) => height - heights[k]);
    const path = heights.map((height) => `M${x - mark},${(this.py(height) + mark).toFixed(1)}l${2 * mark},${-2 * mark}`).join("");
    svg("path", { class: "dimension", d: `M${x},${this.py(foot).toFixed(1)}V${this.py(roof).toFixed(1)}${path}` }, back);
    const write = (text, height) => {
      const at = [right ? x + 14 : x - 6, this.py(height)];
      const label = { class: "dimension-name", x: at[0], y: at[1], "text-anchor": "middle", transform: `rotate(-90 ${at[0]} ${at[1]})` };
      svg("text", label, back).textContent = text;
    };
    // Equal storeys above each other share a label.
    const runs = [];
    storeys.forEach((storey, k) => {
      const last = runs.at(-1);
      if (last && Math.abs(storey - last.storey) < 1e-6) last.count += 1;
      else runs.push({ storey, count: 1, from: heights[k] });
    });
    const middle = (foot + roof) / 2;
    // A lone 6 or 9 can be read upside down.
    const alone = (storey) => (metres(storey).includes(".") ? metres(storey) : `${metres(storey)}.0`);
    const label = ({ storey, count }) => (count > 1 ? `${count} × ${metres(storey)}` : alone(storey));
    const fits = (run) => run.count * run.storey * this.scale > Math.max(24, 6.2 * label(run).length);
    if (runs.length === 1) write(storeys.length > 1 ? `${storeys.length} × ${metres(storeys[0])} ${unitOf("m").name} = ${metres(roof - foot)} ${unitOf("m").name}` : `${metres(roof - foot)} ${unitOf("m").name}`, middle);
    else if (runs.every(fits)) runs.forEach((run) => write(label(run), run.from + (run.count * run.storey) / 2));
    else write(say("roof_and_storeys", { height: metres(roof - foot), storeys: storeys.length }), middle);
  }

  /** Where the left (0) or the right (1) side of a gap or a link is at rest [m]. */
  faceAtRest(part, side, floor = 0) {
    const building = part.between[side];
    if (building === null) return this.walls[part.walls[side]].faces[1 - side];
    return this.outer(building, floor)[1 - side];
  }

  /** Where the first and the last column line at a floor stand at rest [m]. */
  outer(i, floor) {
    const { standing } = page.buildings[i];
    const lines = this.lines(i).filter((_, line) => !standing || standing[line].includes(Math.max(floor, 1)));
    return [lines[0], lines.at(-1)];
  }

  lines(i) {
    return page.buildings[i].spans.reduce((xs, span) => [...xs, xs[xs.length - 1] + span], [this.left[i]]);
  }

  /** The same now, at a height. */
  face(part, side, height, sways) {
    const building = part.between[side];
    const levels = building === null ? [] : levelsOf(page.buildings[building]);
    const rest = this.faceAtRest(part, side, levels.findIndex((level) => level > height - 1e-6));
    if (building === null) return rest + this.exaggeration * this.wallSway(this.walls[part.walls[side]]);
    return rest + this.exaggeration * interpolate(levels, sways[building], height);
  }

  /** Displacement of a wall now [m]. */
  wallSway(wall) {
    const values = run.columns.get(`u:${wall.column}:0`);
    return values ? interpolate(run.time, values, this.time) : 0;
  }

  /** How far the arrow of the ground acceleration reaches at its peak [px]. */
  get reach() {
    return Math.min(90, this.width / 6);
  }

  /** Sideways places of the floors of a building, the ground or the mat first [m]. */
  places(columns, table, t) {
    const k = Math.min(Math.max(indexBefore(table.time, t), 0), table.time.length - 2);
    const span = table.time[k + 1] - table.time[k];
    const part = span > 0 ? Math.min(Math.max((t - table.time[k]) / span, 0), 1) : 0;
    return columns.map((u) => (u ? u[k] + part * (u[k + 1] - u[k]) : 0));
  }

  draw(t) {
    this.time = t;
    if (!this.scale) return;
    this.instant.textContent = `t = ${fixed(t, 3)} s`;
    const sways = page.buildings.map((_, i) => this.places(this.run[i], run, t));
    page.buildings.forEach((building, i) => this.drawBuilding(building, i, sways[i], t));
    this.walls.filter((wall) => !wall.on_site).forEach((wall) => this.drawWall(wall));
    this.drawLinks(sways);
    this.drawFlashes(sways, t);
    const a = interpolate(ground.time, ground.values, t) / this.groundPeak;
    const middle = this.width / 2;
    const tip = middle + a * this.reach;
    const head = Math.sign(a) * Math.min(7, Math.abs(tip - middle));
    const y = this.base + 58 + this.below;
    this.arrow.setAttribute("d", `M${middle},${y - 5}v10m0,-5H${tip}m${-head},-4l${head},4l${-head},4`);
  }

  /** A foundation that lifts off, on its contact springs; of many springs eleven are drawn. */
  drawFooting([length, springs], middle, base) {
    const shown = Math.min(springs, 11);
    const [left, right] = [-1, 1].map((side) => this.px(middle + (side * length) / 2));
    svg("rect", { class: "footing", x: left, y: base, width: right - left, height: 6 }, this.back);
    const zigzag = (x) => `M${x.toFixed(2)},${base + 6}v2l3,1.5l-6,3l6,3l-3,1.5v2`;
    const places = Array.from({ length: shown }, (_, k) => left + ((right - left) * k) / (shown - 1));
    svg("path", { class: "contact-springs", d: places.map(zigzag).join("") }, this.back);
  }

  /** From the bottom of a pit beside it, or from the ground, to a little above its highest contact. */
  drawWall(wall) {
    const feet = wall.beside.filter((building) => building !== null).map((building) => page.buildings[building]);
    const bottom = Math.max(...feet.map((building) => this.py(levelsOf(building)[0]) + (building.isolated ? this.pit : 0)));
    const top = this.py(wall.top) - Math.max(0.02 * this.top * this.scale, 5);
    const [from, to] = wall.faces.map((x) => this.px(x + this.exaggeration * this.wallSway(wall)).toFixed(2));
    wall.path.setAttribute("d", `M${from},${bottom}V${top.toFixed(2)}H${to}V${bottom}z`);
  }

  /** Bearings lean from the bottom of the pit to the mat. */
  bearings(lines, mat, base) {
    const places = lines.length > 2 ? lines : [lines[0], (lines[0] + lines.at(-1)) / 2, lines.at(-1)];
    const half = Math.min(7, (0.3 * (lines.at(-1) - lines[0]) * this.scale) / places.length);
    const [top, bottom] = [base + 3, base + this.pit];
    return places.map((place, k) => {
      const inwards = k === 0 ? half : k === places.length - 1 ? -half : 0;
      const [foot, head] = [this.px(place) + inwards, this.px(place + this.exaggeration * mat) + inwards];
      return `M${(foot - half).toFixed(2)},${bottom}L${(head - half).toFixed(2)},${top}h${(2 * half).toFixed(2)}L${(foot + half).toFixed(2)},${bottom}z`;
    }).join("");
  }

  drawBuilding(building, i, sway, t) {
    const part = this.parts[i];
    const f = this.exaggeration;
    const lines = this.lines(i);
    const heights = levelsOf(building);
    // Lines of a frame may lack columns in some storeys.
    const stands = (line, storey) => building.standing?.[line].includes(storey) ?? true;
    const column = (x, places, line) => {
      let path = "";
      for (let k = 1; k < heights.length; k++) {
        if (!stands(line, k)) continue;
        const [x0, x1] = [this.px(x + f * places[k - 1]), this.px(x + f * places[k])];
        const [y0, y1] = [this.py(heights[k - 1]), this.py(heights[k])];
        const middle = (y0 + y1) / 2;
        path += `M${x0.toFixed(2)},${y0.toFixed(2)}C${x0.toFixed(2)},${middle.toFixed(2)} ${x1.toFixed(2)},${middle.toFixed(2)} ${x1.toFixed(2)},${y1.toFixed(2)}`;
      }
      return path;
    };
    const floor = (places) =>
      heights
        .map((h, k) => {
          if (k === 0 && !building.isolated) return "";
          const [first, last] = this.outer(i, k);
          return `M${this.px(first + f * places[k]).toFixed(2)},${this.py(h).toFixed(2)}h${((last - first) * this.scale).toFixed(2)}`;
        })
        .join("");
    part.columns.setAttribute("d", lines.map((x, line) => column(x, sway, line)).join(""));
    part.floors.setAttribute("d", floor(sway));
    this.drawDiagonals(part, building, i, heights, sway, t);
    this.drawWalls(part, building.walls ?? [], lines, heights, sway);
    part.bearings.setAttribute("d", building.isolated ? this.bearings(lines, sway[0], this.py(heights[0])) : "");
    this.drawHinges(part, building, i, heights, sway, t);
    const ghost = this.ghost && this.other ? this.places(this.other[i], without, t) : null;
    const edges = building.standing ? lines.map((_, line) => line) : [0, lines.length - 1];
    const outline = (places) => edges.map((line) => column(lines[line], places, line)).join("") + floor(places);
    part.ghost.setAttribute("d", ghost ? outline(ghost) : "");
    const floors = this.pinned && page.buildings.map((b) => b.heights.length).join();
    const pinned = this.pinned?.floors === floors ? this.pinned : null;
    part.pinned.setAttribute("d", pinned ? outline(this.places(pinned.columns[i], pinned.table, t)) : "");
    const roof = sway[sway.length - 1];
    const [first, last] = this.outer(i, heights.length - 1);
    part.sway.setAttribute("x", this.px((first + last) / 2));
    part.sway.setAttribute("y", this.py(heights[heights.length - 1]) - 12);
    part.sway.textContent = inUnit(roof, unitOf("mm"), 1);
  }

  /** Braces as lines between joints, infill panels as shaded bays. */
  drawDiagonals(part, building, i, heights, sway, t) {
    // Panels that fall out are gone from then on.
    const diagonals = (building.diagonals ?? []).filter(({ until }) => until === undefined || t < until);
    const at = (x, level) => `${this.px(x + this.exaggeration * sway[level]).toFixed(2)},${this.py(heights[level]).toFixed(2)}`;
    const lines = this.lines(i);
    // Those of a space frame are seen across the row.
    const edge = Math.min(...(building.plans ?? []).flatMap((plan) => plan.corners.map((corner) => corner[0])));
    const xs = (own) => (own.ends ? own.ends.map((end) => this.left[i] + end[0] - edge) : own.lines.map((line) => lines[line]));
    const braces = diagonals.filter((own) => !own.infill);
    part.braces.setAttribute("d", braces.map((own) => `M${at(xs(own)[0], own.storey - 1)}L${at(xs(own)[1], own.top ?? own.storey)}`).join(""));
    // Both struts of a panel lie in one bay.
    const panels = diagonals.filter((own) => own.infill && own.lines[0] < own.lines[1]);
    const panel = (own) => {
      const [[left, right], storey] = [xs(own), own.storey];
      return `M${at(left, storey - 1)}L${at(right, storey - 1)}L${at(right, storey)}L${at(left, storey)}z`;
    };
    part.panels.setAttribute("d", panels.map(panel).join(""));
    // Struts by what they went through in the whole run.
    part.struts.forEach((path, k) => {
      const struts = this.marked ? diagonals.filter((own) => own.stage === k + 1) : [];
      path.setAttribute("d", struts.map((own) => `M${at(xs(own)[0], own.storey - 1)}L${at(xs(own)[1], own.top ?? own.storey)}`).join(""));
    });
  }

  /** Walls as shaded strips as wide as they are long, up one face and down the other. */
  drawWalls(part, walls, lines, heights, sway) {
    const at = (x, level) => `${this.px(x + this.exaggeration * sway[level]).toFixed(2)},${this.py(heights[level]).toFixed(2)}`;
    const wall = ({ line, storeys: [first, last], length }) => {
      const levels = Array.from({ length: last - first + 2 }, (_, k) => first - 1 + k);
      const left = levels.map((level) => at(lines[line] - length / 2, level));
      const right = levels.map((level) => at(lines[line] + length / 2, level));
      return `M${[...left, ...right.reverse()].join("L")}z`;
    };
    part.walls.setAttribute("d", walls.map(wall).join(""));
  }

  /** Marks near the ends of members, off the joint by a little so that all four around it are seen. */
  drawHinges(part, building, i, heights, sway, t) {
    const lines = this.lines(i);
    const size = Math.min(Math.max(this.scale * 0.17, 1.9), 4.2);
    const f = this.exaggeration;
    const outlines = ["", ""];
    const yielded = grades.map(() => "");
    // Along a column from below, on the curve that is drawn.
    const onColumn = (level, x, share) => {
      const bend = 3 * share * share - 2 * share ** 3;
      const rise = 1.5 * share - 1.5 * share * share + share ** 3;
      const [low, high] = [sway[level - 1], sway[level]];
      return [
        this.px(x + f * (low + (high - low) * bend)),
        this.py(heights[level - 1] + (heights[level] - heights[level - 1]) * rise),
      ];
    };
    const mark = (hinge, [x, y]) => {
      const stage = stageAt(hinge, t);
      const outline = markOutline(stage, x, y, "sd".includes(hinge.kind) ? 1.5 * size : size);
      if (stage === 2) yielded[hinge.grade] += outline;
      else outlines[stage] += outline;
    };
    for (const hinge of this.marked ? part.places : []) {
      const { kind, level, line, end } = hinge;
      if (kind === "c") {
        const length = (heights[level] - heights[level - 1]) * this.scale;
        const share = Math.min((2.4 * size) / length, 0.3) / 1.5;
        mark(hinge, onColumn(level, lines[line - 1], end ? 1 - share : share));
      } else if (kind === "m") {
        mark(hinge, onColumn(level, lines[line - 1], end / 1000));
      } else if (kind === "b") {
        const [from, to] = [lines[line - 1], lines[line]].map((x) => this.px(x + f * sway[level]));
        const off = Math.min(2.4 * size, 0.3 * (to - from));
        mark(hinge, [end ? to - off : from + off, this.py(heights[level])]);
      } else if (kind === "d") {
        // Near the middle, so that the marks of two that cross are seen.
        const [share, ends] = [0.42, [line, end]];
        const own = (building.diagonals ?? []).find((one) => one.storey === level && one.lines[0] === line - 1 && one.lines[1] === end - 1);
        const levels = [level - 1, own?.top ?? level];
        const along = ([low, high]) => low + share * (high - low);
        const xs = ends.map((at, k) => this.px(lines[at - 1] + f * sway[levels[k]]));
        const ys = levels.map((at) => this.py(heights[at]));
        mark(hinge, [along(xs), along(ys)]);
      } else if (kind === "f") {
        // Below the ground line: rocking first, sliding beneath it.
        mark(hinge, [this.px(lines[line - 1] + f * sway[0]), this.py(heights[0]) + (end ? 4.6 : 2.2) * size]);
      } else {
        for (const x of this.outer(i, level)) mark(hinge, onColumn(level, x, 0.5));
      }
    }
    outlines.forEach((outline, stage) => part.hinges[stage].setAttribute("d", outline));
    yielded.forEach((outline, grade) => part.yielded[grade].setAttribute("d", outline));
  }

  /** Dampers as a pot with its rod, springs as a zigzag. */
  drawLinks(sways) {
    for (const { link, path } of this.links) {
      if (link.inside) {
        path.setAttribute("d", this.brace(link, sways));
        continue;
      }
      const [x0, x1] = [0, 1].map((side) => this.px(this.face(link, side, link.height, sways)));
      const y = this.py(link.height);
      const [middle, size] = [(x0 + x1) / 2, 4];
      const line = (dy) => `M${x0.toFixed(2)},${(y + dy).toFixed(2)}`;
      let outline = "";
      if (link.dashpot) {
        const dy = link.spring ? -size : 0;
        const reach = Math.min(size, Math.abs(x1 - x0) / 3);
        outline += `${line(dy)}H${(middle - reach).toFixed(2)}m0,${-size}v${2 * size}`;
        outline += `M${(middle + reach).toFixed(2)},${(y + dy - size).toFixed(2)}h${-2 * reach}m0,${2 * size}h${2 * reach}`;
        outline += `M${middle.toFixed(2)},${(y + dy).toFixed(2)}H${x1.toFixed(2)}`;
      }
      if (link.spring) {
        const dy = link.dashpot ? size : 0;
        const step = (x1 - x0) / 6;
        outline += line(dy);
        [1, 2, 3, 4, 5].forEach((k) => {
          outline += `L${(x0 + k * step).toFixed(2)},${(y + dy + (k % 2 ? -size : size) * (k === 5 ? 0 : 1)).toFixed(2)}`;
        });
        outline += `L${x1.toFixed(2)},${(y + dy).toFixed(2)}`;
      }
      path.setAttribute("d", outline);
    }
  }

  /** A damper inside a building: a line between the middles of its floors, with a pot half way. */
  brace(link, sways) {
    const building = link.between[0];
    const heights = levelsOf(page.buildings[building]);
    const width = Math.min(this.widths[building], 6);
    const middle = this.left[building] + this.widths[building] / 2;
    const [a, b] = link.inside.map((floor, k) => {
      const x = middle + (k ? 0.3 : -0.3) * width + this.exaggeration * sways[building][floor];
      return [this.px(x), this.py(heights[floor])];
    });
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const size = Math.max(Math.hypot(dx, dy), 1e-9);
    const at = (along, across) => `${(a[0] + along * dx - (across * dy) / size).toFixed(2)},${(a[1] + along * dy + (across * dx) / size).toFixed(2)}`;
    return `M${at(0, 0)}L${at(0.42, 0)}M${at(0.42, 4)}L${at(0.42, -4)}M${at(0.58, 4)}L${at(0.4, 4)}M${at(0.58, -4)}L${at(0.4, -4)}M${at(0.58, 4)}L${at(0.58, -4)}M${at(0.58, 0)}L${at(1, 0)}`;
  }

  drawFlashes(sways, t) {
    contacts.forEach((contact, i) => {
      const { impact, strength } = this.glow(i, t);
      const circle = this.flashes[i];
      // A wall of the site has no place in the row; the side of the building that it strikes has.
      const along = contact.plan?.normal[0] ?? 0;
      const shown = impact && (inARow(contact.gap) || Math.abs(along) > 0.7);
      circle.style.display = shown ? "" : "none";
      if (!shown) return;
      const height = contact.height;
      const side = contact.gap.between[0] === null ? 1 : 0;
      circle.setAttribute("cx", this.px(this.face(contact.gap, side, height, sways)));
      circle.setAttribute("cy", this.py(height));
      circle.setAttribute("r", (5 + 17 * Math.sqrt(impact.peak / this.hardest)) * (0.5 + 0.5 * strength));
      circle.style.opacity = (0.9 * strength).toFixed(2);
    });
  }

  /** The latest impact of a contact while it can still be seen. */
  glow(contact, t) {
    const last = this.byContact[contact][indexBefore(this.starts[contact], t)];
    if (!last) return {};
    const strength = t <= last.end ? 1 : Math.exp(-(t - last.end) / this.afterglow);
    return strength > 0.03 ? { impact: last, strength } : {};
  }

  /** How long a flash lingers [s]. */
  afterglow = 0.15;
}

/** A length of the order of a gap without needless decimals. */
function readableLength(metres) {
  const { factor, name } = unitOf("mm");
  return `${Number(name === "in" ? (metres * factor).toFixed(2) : (metres * factor).toPrecision(4))} ${name}`;
}
