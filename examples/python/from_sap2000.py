# %% [markdown]
# # Two frames from SAP2000
#
# Text models of two buildings become a pair of space frames: how much gap do they need, and what does an impact change?
# Editors that know cells show this script as a notebook.

# %%
from pathlib import Path

import jostle

west = Path(__file__).resolve().parents[1] / "sap2000" / "frame.s2k"
# The neighbour of this example is the same frame of half the modulus of elasticity.
east = Path("east.s2k")
east.write_text(west.read_text().replace("E1=305914.863893378", "E1=152957.431946689"))
pair = jostle.import_sap2000(west, east, to="pair.toml", gap="20 mm", force=True)
print(pair)

# %% [markdown]
# What was read, and what SAP2000 knew that the model does not have. Is the model sound?

# %%
print(pair.model.check())

# %% [markdown]
# One record, 0.4 g along X. The summary has peaks with contact and their ratio to those without.

# %%
model = pair.model.set("motion.pga", "0.4 g")
result = jostle.run(model)
print(result)

# %% [markdown]
# The gap needed, and a page with everything.

# %%
for joint in jostle.critical_gap(model):
    print(f"{1e3 * joint.gap:.1f} mm without pounding")
print(result.report("pair.html", force=True))
