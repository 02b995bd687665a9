// Puts the page of a motion, or of a set of motions, together.

const element = (id) => document.getElementById(id);
const colours = (i) => `var(--c${i % 7})`;

// --- Over time -----------------------------------------------------------------------------------------

const timeHost = element("time-charts");
if (timeHost) {
  const view = new TimeView(page.duration);
  const seek = (t) => view.setCursor(t);
  const time = ground.time;
  const chart = (title, { name: unit, factor }, values, more = {}) =>
    new TimeChart(timeHost, view, {
      title,
      unit,
      height: 170,
      seek,
      series: [{ label: "", colour: "var(--c0)", time, values: scaled(values, factor) }],
      ...more,
    });
  chart(say("acceleration_title"), unitOf("m/s²"), ground.values);
  chart(say("velocity_title"), unitOf("m/s"), unpack(page.velocity));
  chart(say("displacement_title"), unitOf("mm"), unpack(page.displacement));
  chart(say("arias_intensity"), { name: say("of_the_whole"), factor: 100 }, unpack(page.husid), {
    levels: page.levels.map((level) => ({ value: 100 * level, label: `${100 * level} %` })),
  });
  element("zoom-in").addEventListener("click", () => view.zoom(0.5));
  element("zoom-out").addEventListener("click", () => view.zoom(2));
  element("zoom-all").addEventListener("click", () => view.whole());
  element("zoom-strong").addEventListener("click", () => view.show(...page.strong));
  addEventListener("beforeprint", () => {
    TimeChart.paperWidth = 720;
    for (const chart of view.charts) chart.draw();
  });
  addEventListener("afterprint", () => {
    TimeChart.paperWidth = null;
    for (const chart of view.charts) chart.draw();
  });
}

// --- Spectra -------------------------------------------------------------------------------------------

const quantities = {
  psa: [say("pseudo_acceleration_title"), unitOf("m/s²")],
  sa: [say("total_acceleration_title"), unitOf("m/s²")],
  psv: [say("pseudo_velocity_title"), unitOf("m/s")],
  sd: [say("displacement_title"), unitOf("mm")],
};
const axesOf = { semilog: { x: "log", y: "linear" }, linear: { x: "linear", y: "linear" }, log: { x: "log", y: "log" } };

const curves = (quantity) =>
  page.spectra.map((s, i) => ({
    label: s.label,
    colour: s.bold ? "var(--ink)" : s.code ? "var(--alarm)" : colours(i),
    x: s.periods,
    y: scaled(s[quantity] ?? [], quantities[quantity][1].factor),
    dashed: s.dashed,
    bold: s.bold,
    thin: s.thin,
  }));
const [quantity, axes] = [element("quantity"), element("axes")];
const spectra = new SpectrumChart(element("spectra"), {
  title: quantities.psa[0],
  unit: quantities.psa[1].name,
  xUnit: "s",
  xName: "T",
  series: curves("psa"),
  marks: page.marks,
  axes: axesOf.semilog,
  height: 340,
});
quantity?.addEventListener("change", () => {
  const [title, unit] = quantities[quantity.value];
  spectra.show(curves(quantity.value), title, unit.name);
});
axes.addEventListener("change", () => spectra.setAxes(axesOf[axes.value]));

const fourier = element("fourier");
if (fourier) {
  new SpectrumChart(fourier, {
    title: say("fourier_amplitude"),
    unit: unitOf("m/s").name,
    xUnit: "Hz",
    xName: "f",
    series: [{ label: "", colour: "var(--c0)", x: page.fourier.frequency, y: scaled(page.fourier.amplitude, unitOf("m/s").factor) }],
    axes: axesOf.log,
    height: 260,
  });
}
