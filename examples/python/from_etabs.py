# %% [markdown]
# # Two buildings from ETABS
#
# Result workbooks of two buildings become a pair: how much gap do they need, and what does an impact change?
# Editors that know cells show this script as a notebook.

# %%
from pathlib import Path

import jostle

workbooks = Path(__file__).resolve().parents[1] / "etabs"
pair = jostle.import_etabs(workbooks / "hotel.xlsx", workbooks / "annexe.xlsx", to="pair.toml", gap="50 mm", force=True)
print(pair)

# %% [markdown]
# What was read, what limits the model, and its periods beside those of ETABS. Then: is the model sound?

# %%
print(pair.model.check())

# %% [markdown]
# One record. The summary has peaks with contact and their ratio to those without.

# %%
result = jostle.run(pair.model)
print(result)

# %% [markdown]
# The gap needed, beside rules and codes, and a page with everything.

# %%
for joint in jostle.critical_gap(pair.model):
    print(f"{1e3 * joint.gap:.1f} mm without pounding")
    for rule in joint.rules:
        print(f"  {rule.rule}: {1e3 * rule.gap:.0f} mm, {rule.impact_count} impacts")
print(result.report("pair.html", force=True))
