"""Two storeys in space with rigid diaphragms, in N and m; more mass on the side of larger x.

Dimensions: the response-spectrum example in the documentation of OpenSeesPy. The script is our own. The retained nodes lie in the
middle, away from the centres of mass, so that the mass matrix couples translation and rotation.
"""

import openseespy.opensees as ops

E, G, AREA, SECOND, TORSION, MASS = 3e10, 1.25e10, 0.09, 6.75e-4, 1.14075e-3, 200.0
CORNERS = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)]

ops.wipe()
ops.model("basic", "-ndm", 3, "-ndf", 6)
for level in range(3):
    tags = [10 * level + corner + 1 for corner in range(4)]
    for tag, (x, y) in zip(tags, CORNERS):
        ops.node(tag, x, y, 3.0 * level)
        if level:
            own = MASS * (1.5 if x > 2.0 else 1.0)
            ops.mass(tag, own, own, 0.0, 0.0, 0.0, 0.0)
        else:
            ops.fix(tag, 1, 1, 1, 1, 1, 1)
    if level:
        retained = 10 * level + 9
        ops.node(retained, 2.0, 1.5, 3.0 * level)
        ops.fix(retained, 0, 0, 1, 1, 1, 0)
        ops.rigidDiaphragm(3, retained, *tags)
ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
ops.geomTransf("Linear", 2, 0.0, 0.0, 1.0)
element = 0
for level in (1, 2):
    for corner in range(4):
        element += 1
        here = 10 * level + corner + 1
        ops.element("elasticBeamColumn", element, here - 10, here, AREA, E, G, TORSION, SECOND, SECOND, 1)
        element += 1
        there = 10 * level + (corner + 1) % 4 + 1
        ops.element("elasticBeamColumn", element, here, there, AREA, E, G, TORSION, SECOND, SECOND, 2)
