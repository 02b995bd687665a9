// Deformed shapes with the states of hinges, and where they are on the capacity curve.

const data = JSON.parse(document.getElementById("page-data").textContent);
/** Numbers of a packed list: scale · integer, little-endian. */
function unpack({ scale, data: text }) {
  const view = new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  return Float64Array.from({ length: view.byteLength / 2 }, (_, i) => scale * view.getInt16(2 * i, true));
}

/** Place of a value in a rising list: index of the entry before it and the share of the way to the next. */
function between(list, value) {
  let i = 0;
  while (i + 2 < list.length && list[i + 1] <= value) i++;
  const span = list[i + 1] - list[i];
  return [i, span > 0 ? Math.min(1, Math.max(0, (value - list[i]) / span)) : 0];
}

const frame = { left: 70, top: 24, width: 380, height: 400 };
const side = { left: 520, width: 180 };

class PushView {
  constructor(section, building) {
    this.building = building;
    this.find = (role) => section.querySelector(`[data-role="${role}"]`);
    this.curves = building.curves.map((curve) => ({
      ...curve,
      shapes: unpack(curve.shapes),
      drifts: unpack(curve.drifts),
    }));
    this.slider = this.find("slider");
    this.exaggeration = this.find("exaggeration");
    this.which = this.find("which");
    this.here = this.find("here");
    this.scale = Math.min(frame.width / Math.max(building.width, 0.35 * building.height), frame.height / building.height);
    this.build();
    this.slider.addEventListener("input", () => this.draw());
    this.exaggeration.addEventListener("input", () => this.draw());
    this.which?.addEventListener("change", () => this.draw());
    for (const [role, way] of [["before", -1], ["after", 1]]) this.find(role).addEventListener("click", () => this.jump(way));
    for (const row of section.querySelectorAll("tr[data-roof]")) {
      row.addEventListener("click", () => {
        if (this.which) this.which.value = row.dataset.curve;
        this.slider.value = Number(row.dataset.roof) / this.curves[Number(row.dataset.curve)].end;
        this.draw();
        this.host.scrollIntoView({ block: "nearest", behavior: "smooth" });
      });
    }
    this.exaggeration.value = Math.min(30, Math.max(1, Math.round(0.12 / building.drift)));
    this.slider.value = 1;
    this.draw();
  }

  get curve() {
    return this.curves[this.which ? Number(this.which.value) : 0];
  }

  jump(way) {
    const { events, end } = this.curve;
    const now = Number(this.slider.value) * end;
    const next = way > 0 ? events.find((roof) => roof > now + 1e-9 * end) : events.findLast((roof) => roof < now - 1e-9 * end);
    this.slider.value = (next ?? (way > 0 ? end : 0)) / end;
    this.draw();
  }

  build() {
    const { building, scale } = this;
    this.host = this.find("scene");
    const top = frame.top + frame.height - building.height * scale;
    this.x = (value) => frame.left + 0.5 * (frame.width - building.width * scale) + value * scale;
    this.y = (value) => top + (building.height - value) * scale;
    const drawing = svg("svg", { viewBox: `0 0 720 ${frame.top + frame.height + 50}`, role: "img", "aria-label": say("deformed_shape_of", { name: building.name }) }, this.host);
    const ground = this.y(0);
    svg("path", { class: "ground", d: `M${frame.left - 20} ${ground}H${frame.left + frame.width + 20}` }, drawing);
    svg("path", { class: "straight", d: this.lines(null) }, drawing);
    this.bent = svg("path", { class: "bent" }, drawing);
    this.push = svg("path", { class: "push" }, drawing);
    this.heads = svg("path", { class: "push-head" }, drawing);
    const storey = (building.height / building.floors.length) * scale;
    this.offset = Math.min(9, 0.22 * storey);
    // Fibres of a section share one mark.
    const marks = new Map();
    const mark = () => svg("circle", { class: "hinge", r: Math.min(4.5, Math.max(1.6, 0.1 * storey)) }, drawing);
    this.hinges = building.hinges.map((where) => {
      if (where && !marks.has(where.join())) marks.set(where.join(), mark());
      return where && marks.get(where.join());
    });
    // Storey drifts.
    const peak = Math.max(...this.curves.map((curve) => curve.drifts.reduce((most, drift) => Math.max(most, Math.abs(drift)), 0)), 1e-9);
    this.drift = (value) => side.left + (value / peak) * side.width;
    svg("path", { class: "axis-line", d: `M${side.left} ${ground}V${this.y(building.height)}M${side.left} ${ground}H${side.left + side.width}` }, drawing);
    svg("text", { x: side.left, y: ground + 36 }, drawing).textContent = say("storey_drift");
    svg("text", { x: side.left + side.width, y: ground + 18, "text-anchor": "end" }, drawing).textContent = `${fixed(100 * peak, 2)} %`;
    svg("text", { x: side.left, y: ground + 18 }, drawing).textContent = "0";
    this.profile = svg("path", { class: "profile" }, drawing);
    this.said = svg("text", { x: frame.left + frame.width / 2, y: ground + 30, "text-anchor": "middle" }, drawing);
  }

  /** Path through all lines; `at` gives the displaced place of a node, or null for the straight building. */
  lines(at) {
    const { nodes, lines, slab } = this.building;
    const place = at ?? ((i) => [this.x(nodes.x[i]), this.y(nodes.y[i])]);
    let path = "";
    for (const line of lines) path += line.map((i, k) => `${k ? "L" : "M"}${place(i).map((v) => v.toFixed(1)).join(" ")}`).join("");
    if (slab) {
      for (const i of this.building.floors) {
        const [x, y] = place(i);
        path += `M${(x - slab * this.scale).toFixed(1)} ${y.toFixed(1)}h${(2 * slab * this.scale).toFixed(1)}`;
      }
    }
    return path;
  }

  draw() {
    const { building, curve, scale } = this;
    const roof = Number(this.slider.value) * curve.end;
    const factor = Number(this.exaggeration.value);
    const [row, share] = between(curve.kept, roof);
    const count = building.nodes.x.length;
    const mix = (list, width, column) => (1 - share) * list[row * width + column] + share * list[(row + 1) * width + column];
    const place = (i) => [
      this.x(building.nodes.x[i] + factor * mix(curve.shapes, 2 * count, 2 * i)),
      this.y(building.nodes.y[i] + factor * mix(curve.shapes, 2 * count, 2 * i + 1)),
    ];
    this.bent.setAttribute("d", this.lines(place));
    let [cracked, yielded] = [0, 0];
    const worst = new Map();
    building.hinges.forEach((where, index) => {
      const circle = this.hinges[index];
      const [cracks, yields] = curve.hinges[index];
      const after = (at) => at !== null && roof >= at - 1e-9 * curve.end;
      const stage = after(yields) ? 2 : after(cracks) ? 1 : 0;
      yielded += stage === 2;
      cracked += stage > 0;
      if (circle) worst.set(circle, { where, stage: Math.max(stage, worst.get(circle)?.stage ?? 0) });
    });
    for (const [circle, { where: [a, b, dx, dy], stage }] of worst) {
      const [first, last] = [place(a), place(b)];
      circle.setAttribute("cx", (0.5 * (first[0] + last[0]) + dx * this.offset).toFixed(1));
      circle.setAttribute("cy", (0.5 * (first[1] + last[1]) - dy * this.offset).toFixed(1));
      circle.setAttribute("class", `hinge${["", " cracked", " yielded"][stage]}`);
    }
    const [at, part] = between(curve.roof, roof);
    const value = (list) => list[at] + part * (list[at + 1] - list[at]);
    const shear = value(curve.shear);
    // Arrows as long as the load of their floor.
    const greatest = Math.max(...curve.loads);
    const most = Math.max(...curve.shear, 1e-9);
    let [shafts, heads] = ["", ""];
    building.floors.forEach((node, floor) => {
      const length = 46 * (curve.loads[floor] / greatest) * Math.max(0, shear / most);
      if (length < 4) return;
      const right = curve.sign > 0;
      const tip = right ? this.x(0) - 14 : this.x(building.width) + 14;
      const y = this.y(building.nodes.y[node]);
      shafts += `M${tip - curve.sign * length} ${y}H${tip}`;
      heads += `M${tip + curve.sign * 6} ${y}l${-curve.sign * 8} -4v8z`;
    });
    this.push.setAttribute("d", shafts);
    this.heads.setAttribute("d", heads);
    const storeys = building.floors.length;
    let below = 0;
    let path = "";
    building.floors.forEach((node, storey) => {
      const drift = (1 - part) * curve.drifts[at * storeys + storey] + part * curve.drifts[(at + 1) * storeys + storey];
      const height = building.nodes.y[node];
      path += `${storey ? "L" : "M"}${this.drift(drift)} ${this.y(below)}V${this.y(height)}`;
      below = height;
    });
    this.profile.setAttribute("d", path);
    this.said.textContent = building.hinges.length ? say("hinges_so_far", { cracked, yielded, all: building.hinges.length }) : say("no_hinges");
    this.find("now").textContent = `${inUnit(roof, unitOf("mm"), 1)} (${fixed((100 * roof) / building.height, 3)} %), ${inUnit(shear, unitOf("kN"), 0)}`;
    this.find("factor").textContent = `${factor}×`;
    const chart = building.chart;
    this.here.setAttribute("cx", chart.left + roof * chart.x);
    this.here.setAttribute("cy", chart.bottom - shear * chart.y);
  }
}

document.querySelectorAll("section[data-building]").forEach((section) => new PushView(section, data[Number(section.dataset.building)]));

document.getElementById("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});
