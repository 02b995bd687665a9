"""Moment and curvature of two sections in OpenSees, until the concrete reaches its strength.

Writes opensees.json, which the tests read; run again with `pip install openseespy==3.7.1.2`.
Concrete04 is Popovics' curve, the same as the rising branch of GB 50010, C.2.4; no tension. Bars displace
concrete: fibres of negative area. N, m.
"""
import json

import openseespy.opensees as ops

LAYERS = 4000


def bend(width, depth, strength, modulus, bars, steel, axial, curvature):
    """One step from rest to the final strains: no fibre unloads on the way."""
    peak = (700 + 172 * (strength / 1e6) ** 0.5) * 1e-6
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.uniaxialMaterial("Concrete04", 1, -strength, -peak, -0.05, modulus)
    ops.uniaxialMaterial("Steel01", 2, steel, 200e9, 0.01)
    ops.section("Fiber", 1)
    ops.patch("rect", 1, LAYERS, 1, -depth / 2, -width / 2, depth / 2, width / 2)
    for below_top, area in bars:
        ops.fiber(depth / 2 - below_top, 0.0, area, 2)
        ops.fiber(depth / 2 - below_top, 0.0, -area, 1)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 1, 0)
    ops.element("zeroLengthSection", 1, 1, 2, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, -axial, 0.0, 0.0)
    ops.sp(2, 3, curvature)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-4, 200)
    ops.algorithm("KrylovNewton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    assert ops.analyze(1) == 0, curvature
    ops.reactions()
    return ops.nodeReaction(2, 3)


def circle(diameter):
    return 3.141592653589793 * diameter**2 / 4


column = [(0.04, 4 * circle(0.02)), (0.18, 2 * circle(0.02)), (0.32, 2 * circle(0.02)), (0.46, 4 * circle(0.02))]
beam = [(0.04, 2 * circle(0.02)), (0.56, 4 * circle(0.02))]
cases = []
for name, width, depth, bars, axial, curvatures in [
    ("column", 0.5, 0.5, column, 1000e3, [0.002, 0.004, 0.006, 0.0075]),
    ("beam", 0.3, 0.6, beam, 0.0, [0.002, 0.004, 0.006, 0.008]),
]:
    moments = [bend(width, depth, 20.1e6, 30e9, bars, 400e6, axial, curvature) for curvature in curvatures]
    cases.append({"name": name, "axial_n": axial, "curvature_1_m": curvatures, "moment_nm": moments})
with open("opensees.json", "w") as file:
    json.dump({"made_with": "OpenSees " + ops.version() + ", opensees.py beside this file", "cases": cases}, file, indent=1)
