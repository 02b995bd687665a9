# %% [markdown]
# # A building from OpenSees
#
# A frame in OpenSeesPy stands beside a shear building of jostle. Editors that know cells show this script as a notebook.

# %%
import jostle

try:
    import openseespy.opensees as ops
except ImportError as error:
    print(f"left out: {error}; pip install openseespy")
    raise SystemExit from None

# %% [markdown]
# A portal frame of two storeys, in kN, m and t: lumped masses, beams and columns elastic, Rayleigh damping.

# %%
ops.wipe()
ops.model("basic", "-ndm", 2, "-ndf", 3)
for floor, height in enumerate((0.0, 4.0, 7.2)):
    for line, x in enumerate((0.0, 6.0)):
        node = 10 * floor + line
        ops.node(node, x, height)
        if floor == 0:
            ops.fix(node, 1, 1, 1)
        else:
            ops.mass(node, 20.0, 0.0, 0.0)
ops.geomTransf("Linear", 1)
for floor in (0, 1):
    for line in (0, 1):
        ops.element("elasticBeamColumn", 100 + 10 * floor + line, 10 * floor + line, 10 * (floor + 1) + line, 0.16, 3e7, 2.1e-3, 1)
    ops.element("elasticBeamColumn", 200 + floor, 10 * (floor + 1), 10 * (floor + 1) + 1, 0.18, 3e7, 5.4e-3, 1)
ops.rayleigh(0.5, 0.001, 0.0, 0.0)

# %% [markdown]
# Its matrices become a building of jostle, with the periods that OpenSees finds.

# %%
frame = jostle.from_opensees(ops, units="kN, m", side="right", name="frame")
neighbour = jostle.Shear("neighbour", mass="60 t", stiffness="180 MN/m", storeys=2, storey_height=["4 m", "3.2 m"])
model = jostle.Model([frame, neighbour], jostle.Gap("10 mm"), motion="el-centro-1940-ns")
periods = jostle.modes(model)["frame"].periods
expected = sorted((6.283185307179586 / value**0.5 for value in ops.eigen("-fullGenLapack", 2)), reverse=True)
for ours, theirs in zip(periods, expected):
    print(f"{ours:.9f} s, OpenSees {theirs:.9f} s")

# %%
print(jostle.run(model))
