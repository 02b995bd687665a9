"""How wide must the joint between your two buildings be, and what happens if it is not?

Every run leaves the interpreter to others, so plain threads use all cores.
"""

# %%
from concurrent.futures import ThreadPoolExecutor

import matplotlib.pyplot as plt
import numpy as np

import jostle

# %% Your own pair: change these lines.
left = jostle.Shear(
    "left",
    mass=["120 t", "120 t", "120 t", "90 t"],
    stiffness_mn_m=[110, 100, 90, 80],
    storey_height="3 m",
)
right = jostle.Shear("right", storeys=7, mass="150 t", stiffness="120 MN/m", storey_height="3 m")
motion = jostle.Motion.el_centro().scaled(pga="0.25 g").lasting("20 s")
model = jostle.Model([left, right], jostle.Gap("50 mm"), motion=motion, title="My pair")

# %% Without contact: the gap needed.
needed = jostle.run(model, without_contact=True).summary["gaps"][0]["closing_without_contact_m"]
print(f"No pounding from {1e3 * needed:.1f} mm on.")

# %% All gaps from nothing to a little more than that.
gaps = np.linspace(0.0, 1.05 * needed, 22)


def peaks(gap: float) -> tuple[int, float, float]:
    """Number of impacts, peak force [kN], peak total acceleration [m/s2]."""
    summary = jostle.run(model, gap=gap, record_interval=None).summary
    floors = [floor for building in summary["buildings"] for floor in building["floors"]]
    pounding = summary["gaps"][0]
    acceleration = max(floor["total_acceleration_peak_m_s2"] for floor in floors)
    return pounding["impact_count"], pounding["peak_force_n"] / 1e3, acceleration


with ThreadPoolExecutor() as pool:
    counts, forces, accelerations = zip(*pool.map(peaks, gaps))

print("gap [mm]  impacts  peak force [kN]  acceleration [m/s2]")
for row in zip(1e3 * gaps, counts, forces, accelerations):
    print("{:8.1f}  {:7d}  {:15.1f}  {:19.2f}".format(*row))
assert counts[-1] == 0 and forces[-1] == 0.0, "beyond the gap needed nothing touches"

# %%
figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(8, 6), layout="constrained")
upper.plot(1e3 * gaps, forces, "o-", color="#2a83c4")
upper.set_ylabel("peak contact force [kN]")
lower.plot(1e3 * gaps, accelerations, "o-", color="#e0701f")
lower.set_ylabel("peak floor acceleration [m/s²]")
lower.set_xlabel("gap [mm]")
for axis in (upper, lower):
    axis.axvline(1e3 * needed, color="0.5", ls="--", lw=1)
    axis.grid(alpha=0.3)
figure.savefig("gap_sensitivity.png", dpi=120)
