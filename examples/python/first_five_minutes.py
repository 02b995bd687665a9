"""First five minutes: two buildings, an earthquake, and what happens between them.

Run it as a script, or cell by cell as a notebook (VS Code, Spyder and Jupytext know the ``# %%`` marks).
"""

# %% The frames of the paper, as they come with the package.
import jostle

model = jostle.Model.paper_example()
print(model.buildings, "first periods [s]:", [float(model.periods(b)[0].round(3)) for b in (0, 1)])

# %% One run. The summary is the one of the command line.
result = jostle.run(model, pga="70 cm/s2", gap="10 mm", progress=True)
print(result)

# %% Every impact is a row of a table; here the first ten. polars.DataFrame(result.impacts) and pyarrow.table(result.impacts) work as well.
for impact in sorted(result.impacts, key=lambda impact: impact["start_s"])[:10]:
    print(
        f"t = {impact['start_s']:7.3f} s  floor {impact['left_floor']}  "
        f"{impact['peak_force_n'] / 1e3:6.1f} kN  {impact['impact_speed_m_s']:.3f} m/s"
    )

# %% Histories are NumPy arrays in SI.
roof = result.floor("J1", 5)
strongest = abs(roof.total_acceleration).argmax()
print(
    f"The low roof is shaken hardest at t = {result.time[strongest]:.3f} s: "
    f"{roof.total_acceleration[strongest]:.2f} m/s2 at {1e3 * roof.displacement[strongest]:.1f} mm"
)

# %% A building of your own, a record of your own: here a pulse made on the spot.
import numpy as np

t = np.arange(0, 6, 0.01)
pulse = jostle.Motion(
    0.3 * np.exp(-((t - 1.5) ** 2)) * np.sin(2 * np.pi * t / 0.9),
    step="0.01 s",
    unit="g",
    name="pulse",
)
old = jostle.Shear(
    "old house", mass_t=[180, 180, 150], stiffness_mn_m=[160, 150, 120], storey_height_m=3.0
)
new = jostle.Frame(
    "new frame",
    storeys=5,
    storey_height="3.0 m",
    spans=["6.0 m", "6.0 m"],
    column={"width": "450 mm", "depth": "450 mm"},
    beam={"width": "300 mm", "depth": "550 mm"},
    concrete="C30",
    beam_mass="24 kN/m",
)
pair = jostle.Model(
    [old, new], jostle.Gap("10 mm", law="hertz-damp"), motion=pulse, title="Old and new"
)
print(jostle.run(pair))

# %% Pages and pictures. In a notebook, `result` alone shows summary, forces and the animation.
print("written:", result.report("report.html"))
result.plot().savefig("histories.png", dpi=120)
