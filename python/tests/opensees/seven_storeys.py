"""Seven storeys and two bays of steel, in kip and inches.

Dimensions and sections: example 1 of the verification manual of SAP2000 (Computers and Structures, Inc.), whose periods are 1.2732,
0.4313, 0.2420, 0.1602, 0.1190, 0.0951 and 0.0795 s. The script is our own.
"""

import openseespy.opensees as ops

E, FLOOR_MASS, BAY = 29500.0, 0.49, 360.0
HEIGHTS = [162.0, 162.0, 156.0, 156.0, 156.0, 156.0, 156.0]
# Area and second moment.
SECTIONS = {
    "W14X176": (51.7, 2150.0), "W14X211": (62.1, 2670.0), "W14X246": (72.3, 3230.0), "W14X287": (84.4, 3910.0),
    "W24X110": (32.5, 3330.0), "W24X130": (38.3, 4020.0), "W24X160": (47.1, 5120.0),
}  # fmt: skip
BEAMS = ["W24X160"] * 2 + ["W24X130"] * 2 + ["W24X110"] * 3
OUTER = ["W14X246"] * 3 + ["W14X211"] * 2 + ["W14X176"] * 2
INNER = ["W14X287"] * 3 + ["W14X246"] * 2 + ["W14X211"] * 2

ops.wipe()
ops.model("basic", "-ndm", 2, "-ndf", 3)
for level in range(8):
    for line in range(3):
        tag = 3 * level + line + 1
        ops.node(tag, line * BAY, sum(HEIGHTS[:level]))
        if level == 0:
            ops.fix(tag, 1, 1, 1)
    if level:
        middle = 3 * level + 2
        ops.mass(middle, FLOOR_MASS, 1e-10, 1e-10)
        ops.equalDOF(middle, middle - 1, 1)
        ops.equalDOF(middle, middle + 1, 1)
ops.geomTransf("Linear", 1)
element = 0
for line in range(3):
    for level in range(7):
        element += 1
        area, second = SECTIONS[(INNER if line == 1 else OUTER)[level]]
        below = 3 * level + line + 1
        ops.element("elasticBeamColumn", element, below, below + 3, area, E, second, 1)
for level in range(1, 8):
    area, second = SECTIONS[BEAMS[level - 1]]
    for line in range(2):
        element += 1
        left = 3 * level + line + 1
        ops.element("elasticBeamColumn", element, left, left + 1, area, E, second, 1)
