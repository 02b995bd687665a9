# %% [markdown]
# # From Python
#
# This page is a Python script, shown with its results. To run it yourself, first install the package
# ([Install and first run](install.html)).
#
# ## A first run
#
# `jostle.run` runs a model file or a built-in example and returns a result. The built-in example `paper` consists of two frames with five
# and ten storeys. Printing the result shows its summary.

# %%
import jostle

result = jostle.run("paper", pga="70 cm/s2", gap="10 mm")
print(result)

# %% [markdown]
# `result.summary` contains the numbers of `summary.json` in SI units, and `result.impacts` has one entry per impact.

# %%
gap = result.summary["gaps"][0]
print(gap["impact_count"], "impacts, peak force", round(gap["peak_force_n"] / 1e3, 1), "kN")
result.impacts[0]

# %% [markdown]
# ## Histories
#
# Histories of displacements and forces are NumPy arrays. Displacements are relative to the ground and positive to the right.

# %%
import matplotlib.pyplot as plt

figure, (upper, lower) = plt.subplots(2, sharex=True, figsize=(9, 5))
for name in ("J1", "J2"):
    upper.plot(result.time, result.floor(name, 5).displacement * 1e3, label=f"{name}, floor 5")
upper.set_ylabel("displacement [mm]")
upper.legend()
lower.plot(result.time, result.contacts[-1].force / 1e3, color="C3")
lower.set_ylabel("contact force\nfloor 5 [kN]")
lower.set_xlabel("time [s]")
lower.set_xlim(0, 15)
plt.show()

# %% [markdown]
# ## Your own buildings
#
# A model can be built from Python objects instead of a model file. A keyword whose name ends in a unit, such as `width_mm`, takes a number
# in this unit. All other keywords take a string with a unit, or a number in SI units.

# %%
soft = jostle.Shear("soft", mass=["40 t", "40 t", "30 t"], stiffness_mn_m=[30, 30, 20], storey_height="3.2 m")
stiff = jostle.Shear("stiff", mass=["60 t", "60 t", "50 t"], stiffness_mn_m=[90, 90, 80], storey_height="3.2 m")
pair = jostle.Model(
    [soft, stiff],
    jostle.Gap(width_mm=20, law="hertz-damp"),
    motion=jostle.Motion.el_centro().scaled(pga="0.3 g"),
    title="Soft and stiff",
)
print("periods of soft [s]:", pair.periods("soft"))
print(jostle.run(pair))

# %% [markdown]
# ## Peak force against gap
#
# Repeated runs of one model give the peak force as a function of the gap. With `record_interval=None` a run stores no histories, which
# saves memory and time. The peaks are the same.

# %%
import numpy as np

gaps = np.linspace(0, 0.1, 21)
forces = [
    jostle.run(pair, gap=float(gap), record_interval=None).summary["gaps"][0]["peak_force_n"] / 1e3 for gap in gaps
]
plt.figure(figsize=(9, 3))
plt.plot(gaps * 1e3, forces, "o-")
plt.xlabel("gap [mm]")
plt.ylabel("peak force [kN]")
plt.show()

# %% [markdown]
# ## The required gap
#
# `jostle.critical_gap` returns the gap needed under the motion of the model, and the gaps required by rules and codes.

# %%
(critical,) = jostle.critical_gap(pair)
print(f"gap needed: {critical.gap * 1e3:.1f} mm")
for rule in critical.rules:
    print(f"{rule.rule:12} {rule.gap * 1e3:6.1f} mm")

# %% [markdown]
# ## Errors
#
# A wrong unit raises `jostle.ModelError`. Its message names the invalid value and suggests a correction.

# %%
try:
    jostle.Model([soft, stiff], jostle.Gap("20 kg"))
except jostle.ModelError as error:
    print(error)

# %% [markdown]
# Next: the page [jostle in Python](../python.html) describes studies, motions, user-defined contact laws, and all classes and functions.
