"""How the cost of a run grows with storeys, with buildings and with the tolerance: three plots. See bench/run --whole."""

import tempfile
from pathlib import Path

import programs
from cases import Case

FIGURES = Path(__file__).resolve().parent.parent / "docs" / "figures"

MOTION = """title = "{title}"

[motion]
record = "el-centro-1940-ns"
reverse = true
pga = "220 cm/s2"
duration = "15 s"
"""
FRAME = """
[[building]]
name = "{name}"
kind = "frame"
storeys = {storeys}
storey_height = "3.2 m"
spans = ["6.0 m", "2.4 m", "6.0 m"]
column = {{ width = "{column} mm", depth = "{column} mm" }}
beam = {{ width = "300 mm", depth = "600 mm" }}
elastic_modulus = "30 GPa"
stiffness_factor = 0.5
density = "2500 kg/m3"
beam_mass = "5850 kg/m"
column_segments = 4
beam_segments = [8, 4, 8]
damping = {{ ratio = 0.05, modes = [1, 3] }}
"""
GAP = """
[[gap]]
between = ["{left}", "{right}"]
width = "40 mm"
law = "hertz-damp"
stiffness = "2e9 N/m^1.5"
restitution = 0.65
"""
STOREYS, BUILDINGS, TOLERANCES = (2, 4, 8, 16), (2, 4, 8, 16), (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)


def row(storeys):
    """A row of frames with these numbers of storeys."""
    text = MOTION.format(title="Frames in a row")
    for place, count in enumerate(storeys):
        column = 500 + 10 * max(0, count - 5)
        text += FRAME.format(name=f"B{place + 1}", storeys=count, column=column)
    for place in range(1, len(storeys)):
        text += GAP.format(left=f"B{place}", right=f"B{place + 1}")
    return text


def of_text(text, solver, folder):
    path = Path(folder) / "model.toml"
    path.write_text(text)
    run = programs.jostle(Case("scaling", "", str(path)), solver, fewest=3, least=0.3)
    return {name: run[name] for name in ("cpu_s", "steps", "short_steps", "factorisations", "impacts")}


def measure(say):
    """Times and work counts, solver by solver."""
    found = {"storeys": {}, "buildings": {}, "tolerance": {}}
    with tempfile.TemporaryDirectory() as folder:
        for solver in ("modal", "riccati"):
            found["storeys"][solver] = [[n, of_text(row([n, 2 * n]), solver, folder)] for n in STOREYS]
            say(f"storeys, {solver}: " + ", ".join(f"{1e3 * run['cpu_s']:.3g} ms" for _, run in found["storeys"][solver]))
            found["buildings"][solver] = [[n, of_text(row([5, 10] * (n // 2)), solver, folder)] for n in BUILDINGS]
            say(f"buildings, {solver}: " + ", ".join(f"{1e3 * run['cpu_s']:.3g} ms" for _, run in found["buildings"][solver]))
            many = Case("scaling", "", "paper", ("--pga", "70cm/s2", "--gap", "10mm"))
            runs = []
            for tolerance in TOLERANCES:
                run = programs.jostle(many, solver, tolerance, fewest=3, least=0.3)
                runs.append([tolerance, {name: run[name] for name in ("cpu_s", "steps", "short_steps", "factorisations", "impacts")}])
            found["tolerance"][solver] = runs
            say(f"tolerance, {solver}: " + ", ".join(f"{1e3 * run['cpu_s']:.3g} ms" for _, run in runs))
    return found


# Axis, title, and what the horizontal axis shows.
PLOTS = {
    "storeys": ("storeys of the lower of two frames", "Two frames, n beside 2 n storeys, 15 s"),
    "buildings": ("frames in the row", "Frames of 5 and 10 storeys in a row, 15 s"),
    "tolerance": ("tolerance", "Frames of 5 and 10 storeys, 21 impacts, 31 s"),
}
COLOURS = {"modal": "#0072b2", "riccati": "#d55e00"}


def draw(found):
    """One figure for every plot, in docs/figures."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "jostle", "font.size": 10, "svg.fonttype": "none"})
    import matplotlib.pyplot as plt

    for name, (axis, title) in PLOTS.items():
        figure, plot = plt.subplots(figsize=(5.2, 3.4), layout="constrained")
        for solver, runs in found[name].items():
            x = [value for value, _ in runs]
            plot.loglog(x, [1e3 * run["cpu_s"] for _, run in runs], "o-", color=COLOURS[solver], label=solver)
        plot.set_xlabel(axis)
        plot.set_ylabel("computing time of the time steps [ms]")
        plot.set_title(title, fontsize=10)
        if name == "tolerance":
            plot.invert_xaxis()
        else:
            values = [value for value, _ in found[name]["modal"]]
            plot.set_xticks(values, [str(value) for value in values])
            plot.minorticks_off()
        plot.grid(True, which="major", color="#dddddd", linewidth=0.6)
        plot.legend(frameon=False)
        figure.savefig(FIGURES / f"performance-{name}.svg", metadata={"Date": None})
        plt.close(figure)
