"""Writes buildings of walls as text models of ETABS, and the flexibility of their floors by shells of OpenSees.

    pip install openseespy && python3 write.py

`core`: a core of three walls, open on one side, six storeys. `closed`: the same with a beam across the opening at every floor.
`coupled`: two walls in one plane with beams between them, and a wall across so that the floors do not turn freely.
Units are kN and m. Shells are ShellMITC4 of a third of a metre; with half a metre,
numbers differ by 2 % (coupled) and 4 % (core) of √(F_ii F_jj).
"""

from pathlib import Path

import numpy as np
import openseespy.opensees as ops

HERE = Path(__file__).parent
E, NU = 3.0e7, 0.2
G = E / (2 * (1 + NU))
HEIGHT = 3.0
BEAM = (0.3, 0.6)  # width, depth

BUILDINGS = {
    # Walls: foot from, to, thickness. Beams: from, to.
    "core": dict(
        storeys=6,
        walls=[((0, 0), (4, 0), 0.3), ((4, 0), (4, 5), 0.25), ((4, 5), (0, 5), 0.3)],
        beams=[],
        centre=(2.0, 2.5),
    ),
    "closed": dict(
        storeys=6,
        walls=[((0, 0), (4, 0), 0.3), ((4, 0), (4, 5), 0.25), ((4, 5), (0, 5), 0.3)],
        beams=[((0, 0), (0, 5))],
        centre=(2.0, 2.5),
    ),
    "coupled": dict(
        storeys=5,
        walls=[((0, 0), (3, 0), 0.25), ((5, 0), (8, 0), 0.25), ((0, 6), (0, 10), 0.25), ((8, 6), (8, 10), 0.25)],
        beams=[((3, 0), (5, 0))],
        centre=(4.0, 3.0),
    ),
}


def write_e2k(name, storeys, walls, beams, centre):
    del centre
    lines = ["$ CONTROLS", '  UNITS  "KN"  "M"  "C"', "", "$ STORIES - IN SEQUENCE FROM TOP"]
    lines += [f'  STORY "S{story}"  HEIGHT {HEIGHT}' for story in range(storeys, 0, -1)]
    lines += ['  STORY "Base"  ELEV 0', "", "$ DIAPHRAGM NAMES", '  DIAPHRAGM "D1"    TYPE RIGID', ""]
    lines += ["$ MATERIAL PROPERTIES", '  MATERIAL  "C"    TYPE "Concrete"', f'  MATERIAL  "C"    SYMTYPE "Isotropic"  E {E:.0f}  U {NU}', ""]
    lines += ["$ FRAME SECTIONS", f'  FRAMESECTION  "B"  MATERIAL "C"  SHAPE "Concrete Rectangular"  D {BEAM[1]} B {BEAM[0]}', ""]
    lines += ["$ WALL PROPERTIES"]
    for thickness in sorted({wall[2] for wall in walls}):
        lines.append(f'  SHELLPROP  "W{thickness}"  PROPTYPE  "Wall"  MATERIAL "C"  MODELINGTYPE "ShellThin"  WALLTHICKNESS {thickness}')
    points = sorted({end for wall in walls for end in wall[:2]} | {end for beam in beams for end in beam})
    number = {point: index + 1 for index, point in enumerate(points)}
    lines += ["", "$ POINT COORDINATES"] + [f'  POINT "{number[p]}"  {p[0]} {p[1]}' for p in points]
    lines += ["", "$ LINE CONNECTIVITIES"]
    lines += [f'  LINE  "B{i}"  BEAM  "{number[a]}"  "{number[b]}"  0' for i, (a, b) in enumerate(beams)]
    lines += ["", "$ AREA CONNECTIVITIES"]
    lines += [f'  AREA "W{i}"  PANEL  4  "{number[a]}"  "{number[b]}"  "{number[b]}"  "{number[a]}"  1  1  0  0' for i, (a, b, _) in enumerate(walls)]
    lines += ["", "$ POINT ASSIGNS"] + [f'  POINTASSIGN  "{i}"  "Base"  RESTRAINT "UX UY UZ RX RY RZ"' for i in number.values()]
    lines += ["", "$ LINE ASSIGNS"]
    lines += [f'  LINEASSIGN  "B{i}"  "S{story}"  SECTION "B"' for story in range(1, storeys + 1) for i in range(len(beams))]
    lines += ["", "$ AREA ASSIGNS"]
    lines += [f'  AREAASSIGN  "W{i}"  "S{story}"  SECTION "W{wall[2]}"' for story in range(1, storeys + 1) for i, wall in enumerate(walls)]
    (HERE / f"{name}.e2k").write_text("\n".join(lines) + "\n")


def flexibility(storeys, walls, beams, centre, size=1 / 3):
    def model():
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        nodes = {}

        def node(x, y, z):
            key = (round(x, 6), round(y, 6), round(z, 6))
            if key not in nodes:
                nodes[key] = len(nodes) + 1
                ops.node(nodes[key], *map(float, key))
                if z == 0:
                    ops.fix(nodes[key], *[1] * 6)
            return nodes[key]

        tag = 0
        for index, (a, b, thickness) in enumerate(walls):
            ops.section("ElasticMembranePlateSection", index + 1, E, NU, thickness, 0.0)
            a, b = np.array(a, float), np.array(b, float)
            across = max(1, round(np.linalg.norm(b - a) / size))
            up = max(1, round(HEIGHT / size))
            for i in range(across):
                p, q = a + (b - a) * i / across, a + (b - a) * (i + 1) / across
                for j in range(storeys * up):
                    z, w = HEIGHT * j / up, HEIGHT * (j + 1) / up
                    tag += 1
                    ops.element("ShellMITC4", tag, node(*p, z), node(*q, z), node(*q, w), node(*p, w), index + 1)
        width, depth = BEAM
        area = width * depth
        ratio = width / depth
        torsion = depth * width**3 * (1 / 3 - 0.21 * ratio * (1 - ratio**4 / 12))
        for story in range(1, storeys + 1):
            for a, b in beams:
                tag += 1
                transform = tag
                ops.geomTransf("Linear", transform, *map(float, np.cross([b[0] - a[0], b[1] - a[1], 0], [0, 0, 1])))
                # A shell does not hold a beam against turning in its plane: the beam goes on into the wall, stiff, for one metre.
                for end, other in ((a, b), (b, a)):
                    along = np.subtract(end, other) / np.linalg.norm(np.subtract(end, other))
                    inner = tuple(np.round(np.add(end, along), 6))
                    if (round(inner[0], 6), round(inner[1], 6), round(HEIGHT * story, 6)) in nodes:
                        tag += 1
                        ops.element("ElasticTimoshenkoBeam", tag, node(*end, HEIGHT * story), node(*inner, HEIGHT * story), E, G, 10 * area,
                                    10 * torsion, 10 * depth * width**3 / 12, 10 * width * depth**3 / 12, 10 * area, 10 * area, transform)
                ops.element("ElasticTimoshenkoBeam", 50000 + tag, node(*a, HEIGHT * story), node(*b, HEIGHT * story), E, G, area, torsion,
                            depth * width**3 / 12, width * depth**3 / 12, 5 / 6 * area, 5 / 6 * area, transform)
        masters = []
        for story in range(1, storeys + 1):
            z = HEIGHT * story
            slaves = [n for key, n in nodes.items() if abs(key[2] - z) < 1e-6]
            master = 100000 + story
            ops.node(master, *centre, z)
            ops.fix(master, 0, 0, 1, 1, 1, 0)
            ops.rigidDiaphragm(3, master, *slaves)
            masters.append(master)
        return masters

    masters = model()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.algorithm("Linear")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    rows, load = [], 0
    for master in masters:
        for way in (0, 1, 5):
            load += 1
            ops.timeSeries("Constant", load)
            ops.pattern("Plain", load, load)
            forces = [0.0] * 6
            forces[way] = 1.0
            ops.load(master, *forces)
            assert ops.analyze(1) == 0
            rows.append([ops.nodeDisp(other, way) / 1e3 for other in masters for way in (1, 2, 6)])
            ops.remove("loadPattern", load)
    return np.array(rows)


if __name__ == "__main__":
    for name, building in BUILDINGS.items():
        write_e2k(name, **building)
        matrix = flexibility(**building)
        lines = [f"# Displacements of the floors of {name} (x, y, turn, from the ground up) under unit loads there [m/N]; by write.py with OpenSees."]
        (HERE / f"{name}.txt").write_text("\n".join(lines + [" ".join(f"{v:.9e}" for v in row) for row in matrix]) + "\n")
