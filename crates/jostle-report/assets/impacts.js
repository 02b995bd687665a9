// Every impact by itself: its force over time and over indentation, with the hardest shown first.

/** Small panels shown before the reader asks for all, and then. */
const firstPanels = 24;
const mostPanels = 240;

/** The points of an impact: time from its start [ms], force and indentation or null in the units of the page. */
function pointsOf(impact) {
  const { time, values, indentation } = forces[impact.contact];
  // The rows around it, in which the force is zero, belong to it.
  const slack = 1e-6;
  const first = Math.max(indexBefore(time, impact.start - slack), 0);
  const last = Math.min(indexBefore(time, impact.end + slack) + 1, time.length - 1);
  const points = [];
  for (let k = first; k <= last; k++) {
    const apart = values[k] === 0 && (time[k] < impact.start - slack || time[k] > impact.end + slack);
    const at = Math.min(Math.max(time[k], impact.start), impact.end);
    points.push({
      time: 1e3 * ((apart ? at : time[k]) - impact.start),
      force: values[k] * unitOf("kN").factor,
      depth: indentation ? unitOf("mm").factor * indentation[k] : null,
    });
  }
  return points.some(({ force }) => force !== 0) ? points : [];
}

class ImpactPanels {
  constructor(host) {
    this.host = host;
    this.chosen = -1;
    this.all = false;
  }

  /** Takes over the run that is loaded and shows its hardest impact. */
  refresh() {
    this.shapes = page.impacts.map(pointsOf);
    this.colours = contactColours();
    const drawn = page.impacts.map((_, i) => i).filter((i) => this.shapes[i].length > 2);
    this.byForce = drawn.sort((a, b) => page.impacts[b].peak - page.impacts[a].peak);
    this.host.hidden = !this.byForce.length;
    this.host.replaceChildren();
    if (!this.byForce.length) return;
    this.build();
    this.show(this.byForce[0]);
  }

  build() {
    const bar = html("div", "controls", undefined, this.host);
    this.said = html("output", "impact-name", "", bar);
    if (this.byForce.length > 1) {
      const buttons = html("span", "buttons", undefined, bar);
      for (const [name, step] of [[say("earlier"), -1], [say("later"), 1], [say("hardest"), 0]]) {
        const button = html("button", "", name, buttons);
        button.type = "button";
        button.addEventListener("click", () => this.move(step));
      }
    }
    this.pictures = html("div", "multiples impact-pictures", undefined, this.host);
    this.strip = html("div", "impact-strip", undefined, this.host);
    this.fillStrip();
  }

  /** One panel for each impact, in order of time, all with one scale of force. */
  fillStrip() {
    this.strip.replaceChildren();
    this.buttons = new Map();
    if (this.byForce.length < 2) return;
    const shown = this.byForce.slice(0, this.all ? mostPanels : firstPanels).sort((a, b) => a - b);
    const hardest = page.impacts[this.byForce[0]].peak * unitOf("kN").factor;
    for (const i of shown) {
      const { start, peak, contact } = page.impacts[i];
      const button = html("button", "impact-panel", undefined, this.strip);
      button.type = "button";
      button.setAttribute("aria-pressed", String(i === this.chosen));
      button.title = `${fixed(start, 3)} s, ${contactName(contacts[contact])}`;
      const points = this.shapes[i];
      const length = Math.max(points.at(-1).time, 1e-9);
      const place = ({ time, force }) => `${(2 + (96 * time) / length).toFixed(1)},${(42 - (38 * force) / hardest).toFixed(1)}`;
      const drawing = svg("svg", { viewBox: "0 0 100 44", "aria-hidden": "true" }, button);
      svg("path", { class: "line area", style: this.colour(i), d: `M${points.map(place).join("L")}Z` }, drawing);
      html("span", "", `${fixed(start, 2)} s`, button);
      html("span", "unit", `${readable(peak * unitOf("kN").factor)} ${unitOf("kN").name}`, button);
      button.addEventListener("click", () => showImpact(page.impacts[i]));
      this.buttons.set(i, button);
    }
    if (!this.all && this.byForce.length > firstPanels) {
      const more = html("button", "", this.byForce.length > mostPanels ? say("show_the_hardest", { count: mostPanels }) : say("show_all", { count: this.byForce.length }), this.strip);
      more.type = "button";
      more.addEventListener("click", () => {
        this.all = true;
        this.fillStrip();
      });
    }
  }

  /** Chooses the impact of a contact that begins at an instant, or the nearest one. */
  showAt(start, contact) {
    // Floors that touch at one instant differ by their contact.
    const far = (i) => Math.abs(page.impacts[i].start - start) + (page.impacts[i].contact === contact ? 0 : 1e-9);
    if (this.byForce?.length) this.show(this.byForce.reduce((best, i) => (far(i) < far(best) ? i : best)));
  }

  /** The impact before or after, or the hardest for 0. */
  move(step) {
    const inOrder = [...this.byForce].sort((a, b) => a - b);
    const next = step ? inOrder[(inOrder.indexOf(this.chosen) + step + inOrder.length) % inOrder.length] : this.byForce[0];
    showImpact(page.impacts[next]);
  }

  show(i) {
    this.chosen = i;
    const impact = page.impacts[i];
    const rank = this.byForce.indexOf(i) + 1;
    const place = contactName(contacts[impact.contact]);
    const order = this.byForce.length > 1 ? (rank === 1 ? say("the_hardest_of", { all: this.byForce.length }) : say("rank_by_force", { rank, all: this.byForce.length })) : "";
    this.said.textContent = say("impact_at", { instant: fixed(impact.start, 3), place, force: readable(impact.peak * unitOf("kN").factor), order });
    for (const [other, button] of this.buttons) button.setAttribute("aria-pressed", String(other === i));
    const points = this.shapes[i];
    this.pictures.replaceChildren();
    this.dots = [this.picture(say("contact_force_over_time"), say("ms_from_first_contact"), points, "time")];
    // A force that acts at once has no indentation.
    const deep = points.filter(({ depth, force }) => depth !== null && (depth > 0 || force === 0));
    if (deep.some(({ depth }) => depth > 0)) this.dots.push(this.picture(say("contact_force_over_indentation"), unitOf("mm").name, deep, "depth"));
    else html("p", "quiet", say("no_loop_at_one_instant"), this.pictures);
    this.draw(player?.time ?? 0);
  }

  picture(name, unit, points, across) {
    const figure = html("figure", "multiple", undefined, this.pictures);
    html("figcaption", "", name, figure);
    const drawing = svg("svg", { viewBox: "0 0 320 230", role: "img", "aria-label": name }, figure);
    const most = (of) => 1.06 * Math.max(...points.map((point) => point[of]), 1e-9);
    const least = Math.min(...points.map(({ force }) => force), 0);
    const x = { ends: [0, most(across)], name: unit };
    const y = { ends: [1.06 * least, most("force")], name: unitOf("kN").name };
    const { px, py, box } = plot(svg("g", { class: "grid" }, drawing), { width: 320, height: 230, margin: LoopChart.margin, x, y });
    const within = inside(drawing, box);
    const d = `M${points.map((point) => `${px(point[across]).toFixed(1)},${py(point.force).toFixed(1)}`).join("L")}`;
    svg("path", { class: "line", style: this.colour(this.chosen), d }, within);
    const dot = svg("circle", { class: "now", r: 4.5 }, within);
    return { dot, px, py, times: points.map(({ time }) => time), across: points.map((point) => point[across]), force: points.map(({ force }) => force) };
  }

  /** The colour of the contact of an impact, as in the chart of forces. */
  colour(i) {
    return `--c:${this.colours.get(page.impacts[i].contact) ?? "var(--ink-2)"}`;
  }

  /** Marks an instant while it lies in the impact that is shown. */
  draw(t) {
    const impact = page.impacts[this.chosen];
    if (!impact || !this.dots) return;
    const within = t >= impact.start && t <= impact.end;
    for (const { dot, px, py, times, across, force } of this.dots) {
      dot.style.display = within ? "" : "none";
      if (!within) continue;
      const at = 1e3 * (t - impact.start);
      dot.setAttribute("cx", px(interpolate(times, across, at)).toFixed(1));
      dot.setAttribute("cy", py(interpolate(times, force, at)).toFixed(1));
    }
  }
}
