// Puts the page of a motion, or of a set of motions, together.

const element = (id) => document.getElementById(id);
const colours = (i) => `var(--c${i % 7})`;

// --- Over time -----------------------------------------------------------------------------------------

const timeHost = element("time-charts");
if (timeHost) {
  const view = new TimeView(page.duration);
  const seek = (t) => view.setCursor(t);
  const time = ground.time;
  const chart = (title, unit, values, factor, more = {}) =>
    new TimeChart(timeHost, view, {
      title,
      unit,
      height: 170,
      seek,
      series: [{ label: "", colour: "var(--c0)", time, values: scaled(values, factor) }],
      ...more,
    });
  chart(say("acceleration_title"), "m/s²", ground.values, 1);
  chart(say("velocity_title"), "m/s", unpack(page.velocity), 1);
  chart(say("displacement_title"), "mm", unpack(page.displacement), 1e3);
  chart(say("arias_intensity"), say("of_the_whole"), unpack(page.husid), 100, {
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
  psa: [say("pseudo_acceleration_title"), "m/s²", 1],
  sa: [say("total_acceleration_title"), "m/s²", 1],
  psv: [say("pseudo_velocity_title"), "m/s", 1],
  sd: [say("displacement_title"), "mm", 1e3],
};
const axesOf = { semilog: { x: "log", y: "linear" }, linear: { x: "linear", y: "linear" }, log: { x: "log", y: "log" } };

const curves = (quantity) =>
  page.spectra.map((s, i) => ({
    label: s.label,
    colour: s.bold ? "var(--ink)" : s.code ? "var(--alarm)" : colours(i),
    x: s.periods,
    y: scaled(s[quantity] ?? [], quantities[quantity][2]),
    dashed: s.dashed,
    bold: s.bold,
    thin: s.thin,
  }));
const [quantity, axes] = [element("quantity"), element("axes")];
const spectra = new SpectrumChart(element("spectra"), {
  title: quantities.psa[0],
  unit: quantities.psa[1],
  xUnit: "s",
  xName: "T",
  series: curves("psa"),
  marks: page.marks,
  axes: axesOf.semilog,
  height: 340,
});
quantity?.addEventListener("change", () => {
  const [title, unit] = quantities[quantity.value];
  spectra.show(curves(quantity.value), title, unit);
});
axes.addEventListener("change", () => spectra.setAxes(axesOf[axes.value]));

const fourier = element("fourier");
if (fourier) {
  new SpectrumChart(fourier, {
    title: say("fourier_amplitude"),
    unit: "m/s",
    xUnit: "Hz",
    xName: "f",
    series: [{ label: "", colour: "var(--c0)", x: page.fourier.frequency, y: page.fourier.amplitude }],
    axes: axesOf.log,
    height: 260,
  });
}
