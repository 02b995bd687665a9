"""Two storeys and one bay, in kip and inches.

Sections and masses: example 10.5 of Chopra, Dynamics of Structures; storeys are 162 in high, as the lower ones of the seven-storey
frame. The script is our own. It ends with wipe(), as many do.
"""

from openseespy.opensees import *  # noqa: F403

MASS, AREA, SECOND, E, BAY, STOREY = 100.0 / 386.0, 63.41, 320.0, 29000.0, 240.0, 162.0

wipe()  # noqa: F405
model("basic", "-ndm", 2, "-ndf", 3)  # noqa: F405
for level in range(3):
    for line in range(2):
        node(2 * level + line + 1, line * BAY, level * STOREY)  # noqa: F405
fix(1, 1, 1, 1)  # noqa: F405
fix(2, 1, 1, 1)  # noqa: F405
for tag, share in ((3, 1.0), (4, 1.0), (5, 0.5), (6, 0.5)):
    mass(tag, share * MASS, 0.0, 0.0)  # noqa: F405
geomTransf("Linear", 1)  # noqa: F405
for tag, (i, j, factor) in enumerate([(1, 3, 2), (3, 5, 1), (2, 4, 2), (4, 6, 1), (3, 4, 2), (5, 6, 1)], 1):
    element("elasticBeamColumn", tag, i, j, AREA, E, factor * SECOND, 1)  # noqa: F405
squares = eigen("-fullGenLapack", 2)  # noqa: F405
first, second = (square**0.5 for square in squares)
beta = 2.0 * 0.05 / (first + second)
rayleigh(beta * first * second, beta, 0.0, 0.0)  # noqa: F405
wipe()  # noqa: F405
