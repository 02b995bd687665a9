"""Writes an irregular frame as a text model of ETABS, and the flexibility of its floors by OpenSees.

    pip install openseespy && python3 write.py

The frame has what no regular one has: a column over two storeys, braces hinged at both ends, a beam between the middles of
two others, a beam and a column off the axes, a leg that stands on a pin, stiff end lengths, and a smaller upper storey. Units
are kN and m.
"""

from pathlib import Path

import numpy as np
import openseespy.opensees as ops

HERE = Path(__file__).parent
LEVELS = {"Base": -1.0, "S1": 3.0, "S2": 6.5, "S3": 10.0}
STORIES = list(LEVELS)
CENTRES = {"S1": (5.0, 4.0), "S2": (5.2, 4.1), "S3": (3.0, 4.0)}
E, NU = 2.0e8, 0.3
G = E / (2 * (1 + NU))
# Area, torsion constant, second moments about 2 and 3; no shear areas: no deformation by shear.
SECTIONS = {
    "COL": (0.020, 4.0e-6, 1.0e-4, 3.0e-4),
    "BEAM": (0.012, 1.0e-6, 2.0e-5, 2.0e-4),
    "BRACE": (0.004, 3.0e-6, 2.0e-6, 2.0e-6),
}
POINTS = {
    "1": (0, 0), "2": (6, 0), "3": (10, 0),
    "4": (0, 8), "5": (6, 8), "6": (10, 8),
    "7": (3, 0), "8": (3, 8), "9": (10, 4),
}
# Name, kind, point below or first, point above or second, storeys between, storey, section, angle, releases, stiff ends.
MEMBERS = []


def member(name, kind, a, b, below, story, section, angle=0.0, releases="", stiff=(0.0, 0.0)):
    MEMBERS.append((name, kind, a, b, below, story, section, angle, releases, stiff))


for story in ("S1", "S2"):
    for point in ("1", "2", "4", "5"):
        angle = 30.0 if point == "5" else 0.0
        member(f"C{point}", "COLUMN", point, point, 1, story, "COL", angle, "", (0.0, 0.3))
for point in ("1", "4"):
    member(f"C{point}", "COLUMN", point, point, 1, "S3", "COL", 90.0)
# Two storeys high.
for point in ("3", "6"):
    member(f"T{point}", "COLUMN", point, point, 2, "S2", "COL")
for story in ("S1", "S2"):
    member("B12", "BEAM", "1", "2", 0, story, "BEAM", 0.0, "", (0.2, 0.25))
    member("B45", "BEAM", "4", "5", 0, story, "BEAM")
    member("B14", "BEAM", "1", "4", 0, story, "BEAM")
    member("B25", "BEAM", "2", "5", 0, story, "BEAM", 0.0, "M3J")
    # From the middle of a beam to that of another, hinged.
    member("B78", "BEAM", "7", "8", 0, story, "BEAM", 0.0, "M2I M3I M2J M3J")
for a, b in (("2", "3"), ("5", "6"), ("3", "6"), ("2", "9")):
    member(f"B{a}{b}", "BEAM", a, b, 0, "S2", "BEAM")
member("B14", "BEAM", "1", "4", 0, "S3", "BEAM")
for story in ("S1", "S2", "S3"):
    member("D14", "BRACE", "1", "4", 1, story, "BRACE", 0.0, "M2I M3I M2J M3J")
member("D12", "BRACE", "1", "2", 1, "S1", "BRACE", 0.0, "M2I M3I M2J M3J")
# All, but the foot of one column is a pin.
FEET = {point: "UX UY UZ RX RY RZ" for point in ("1", "2", "4", "5", "6")} | {"3": "UX UY UZ"}


def place(point, level):
    x, y = POINTS[point]
    return np.array([x, y, LEVELS[level]], float)


def ends(own):
    _, _, a, b, below, story, *_ = own
    lower = STORIES[STORIES.index(story) - below]
    return place(a, lower), place(b, story)


def write_e2k():
    lines = ["$ CONTROLS", '  UNITS  "KN"  "M"  "C"', "", "$ STORIES - IN SEQUENCE FROM TOP"]
    for above, below in zip(STORIES[:0:-1], STORIES[-2::-1]):
        lines.append(f'  STORY "{above}"  HEIGHT {LEVELS[above] - LEVELS[below]}')
    lines += [f'  STORY "Base"  ELEV {LEVELS["Base"]}', "", "$ DIAPHRAGM NAMES", '  DIAPHRAGM "D1"    TYPE RIGID', ""]
    lines += ["$ MATERIAL PROPERTIES", '  MATERIAL  "S"    TYPE "Steel"', f'  MATERIAL  "S"    SYMTYPE "Isotropic"  E {E:.0f}  U {NU}', ""]
    lines.append("$ FRAME SECTIONS")
    for name, (area, torsion, i22, i33) in SECTIONS.items():
        lines.append(f'  FRAMESECTION  "{name}"  MATERIAL "S"  SHAPE "General"  D 0.3 B 0.3')
        lines.append(f'  FRAMESECTION  "{name}"  AREA {2 * area} TORSION {torsion} I22 {i22} I33 {i33} AMOD 0.5')
    lines += ["", "$ POINT COORDINATES"] + [f'  POINT "{p}"  {x} {y}' for p, (x, y) in POINTS.items()]
    lines += ["", "$ LINE CONNECTIVITIES"]
    for name, kind, a, b, below in dict.fromkeys(own[:5] for own in MEMBERS):
        lines.append(f'  LINE  "{name}"  {kind}  "{a}"  "{b}"  {below}')
    lines += ["", "$ POINT ASSIGNS"] + [f'  POINTASSIGN  "{p}"  "Base"  RESTRAINT "{held}"' for p, held in FEET.items()]
    lines += ["", "$ LINE ASSIGNS"]
    for name, _, _, _, _, story, section, angle, releases, (i, j) in MEMBERS:
        text = f'  LINEASSIGN  "{name}"  "{story}"  SECTION "{section}"'
        text += f"  ANG {angle}" if angle else ""
        text += f'  RELEASE "{releases}"' if releases else ""
        # Half of the lengths is stiff.
        text += f"  LENGTHOFFI {2 * i} LENGTHOFFJ {2 * j} RIGIDZONE 0.5" if i or j else ""
        lines.append(text)
    (HERE / "irregular.e2k").write_text("\n".join(lines) + "\n")


def flexibility():
    """Displacements of the centres of mass of the floors under unit loads there."""
    joints, split = [], []
    for own in MEMBERS:
        joints += ends(own)
    joints = np.unique(np.round(joints, 6), axis=0)
    find = lambda at: int(np.argmin(np.linalg.norm(joints - at, axis=1))) + 1
    for own in MEMBERS:
        a, b = ends(own)
        along = (joints - a) @ (b - a) / ((b - a) @ (b - a))
        on = [s for s, at in zip(along, joints) if 1e-6 < s < 1 - 1e-6 and np.linalg.norm(a + s * (b - a) - at) < 1e-6]
        cuts = [0.0, *sorted(on), 1.0]
        split += [(own, a + s * (b - a), a + t * (b - a), s == 0.0, t == 1.0) for s, t in zip(cuts, cuts[1:])]

    def model():
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        for tag, at in enumerate(joints, 1):
            ops.node(tag, *map(float, at))
        for point, held in FEET.items():
            ops.fix(find(place(point, "Base")), *(int(word in held.split()) for word in ("UX", "UY", "UZ", "RX", "RY", "RZ")))
        masters = []
        for index, (story, centre) in enumerate(CENTRES.items()):
            tag = 1000 + index
            ops.node(tag, *map(float, centre), LEVELS[story])
            ops.fix(tag, 0, 0, 1, 1, 1, 0)
            slaves = [j for j, at in enumerate(joints, 1) if abs(at[2] - LEVELS[story]) < 1e-6]
            ops.rigidDiaphragm(3, tag, *slaves)
            masters.append(tag)
        for tag, (own, a, b, first, last) in enumerate(split, 1):
            *_, section, angle, releases, (i, j) = own
            area, torsion, i22, i33 = SECTIONS[section]
            one = (b - a) / np.linalg.norm(b - a)
            up = np.array([1.0, 0, 0]) if np.hypot(*one[:2]) < 1e-3 else np.array([0, 0, 1.0])
            two = up - (up @ one) * one
            two /= np.linalg.norm(two)
            turn = np.radians(angle)
            two = np.cos(turn) * two + np.sin(turn) * np.cross(one, two)
            # OpenSees: vecxz and x make the plane xz; z here is axis 3, y is axis 2.
            three = np.cross(one, two)
            offset = [*(one * i * first), *(-one * j * last)]
            ops.geomTransf("Linear", tag, *map(float, three), "-jntOffset", *map(float, offset))
            words = releases.split()
            code = lambda what: (what + "I" in words and first) + 2 * (what + "J" in words and last)
            ops.element("elasticBeamColumn", tag, find(a), find(b), area, E, G, torsion, i22, i33, tag,
                        "-releasez", code("M3"), "-releasey", code("M2"))
        return masters

    rows = []
    for load in range(3 * len(CENTRES)):
        masters = model()
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        forces = [0.0] * 6
        forces[(0, 1, 5)[load % 3]] = 1.0
        ops.load(masters[load // 3], *forces)
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("FullGeneral")
        ops.algorithm("Linear")
        ops.integrator("LoadControl", 1.0)
        ops.analysis("Static")
        assert ops.analyze(1) == 0
        rows.append([ops.nodeDisp(tag, way) / 1e3 for tag in masters for way in (1, 2, 6)])
    return np.array(rows)


if __name__ == "__main__":
    write_e2k()
    matrix = flexibility()
    lines = ["# Displacements of the floors (x, y, turn, from the ground up) under unit loads there [m/N]; by write.py with OpenSees."]
    (HERE / "flexibility.txt").write_text("\n".join(lines + [" ".join(f"{value:.12e}" for value in row) for row in matrix]) + "\n")
    print(np.abs(matrix - matrix.T).max() / np.abs(matrix).max())
