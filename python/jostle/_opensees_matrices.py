"""Mass, damping and stiffness of a model in OpenSees, condensed to its floors, in SI."""

from __future__ import annotations

import contextlib
import io
import math
import re
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._builders import Given, Table
from ._errors import ModelError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    _Array = npt.NDArray[np.float64]

#: Masses below this share of the largest are fillers, such as the 1e-10 of many scripts.
_FILLER = 1e-8
#: Levels closer than this share of the height are one.
_LEVEL = 1e-4
#: Greatest asymmetry of a matrix, and greatest mass off the diagonal, in parts of the greatest entry.
_ROUNDING = 1e-9
#: Most equations: each matrix is a full one.
_MOST = 4000
#: Forces [N] and lengths [m].
_FORCES = {
    "n": 1.0, "kn": 1e3, "mn": 1e6, "kgf": 9.80665, "tonf": 9806.65, "tf": 9806.65,
    "lb": 4.4482216152605, "lbf": 4.4482216152605, "kip": 4448.2216152605, "kips": 4448.2216152605,
}  # fmt: skip
_LENGTHS = {
    "m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254, "inch": 0.0254, "ft": 0.3048,
}  # fmt: skip

@dataclass
class CondensedModel:
    """A building as jostle takes it: matrices of its floors, in SI; what is not carried over, in ``remarks``."""

    mass: _Array
    stiffness: _Array
    damping: _Array | None
    influence: _Array | None
    heights: _Array | None
    ports: dict[str, dict[str, Any]]
    stated: Table | None
    plan: Any = None
    angle: float | None = None
    remarks: list[str] = field(default_factory=list)
    #: Node of every port, number of equations of the model, and periods [s].
    nodes: list[int] = field(default_factory=list)
    equations: int = 0
    periods: _Array | None = None
    #: Height of the lowest node in the script [m].
    elevation: float = 0.0

    def given(self, name: str | None) -> Given:
        matrices: dict[str, object] = {"stiffness": self.stiffness, "mass": self.mass}
        if self.damping is not None:
            matrices["damping"] = self.damping
        if self.influence is not None:
            matrices["influence"] = self.influence
        if self.heights is not None:
            matrices["heights"] = self.heights
        angle = None if self.angle is None else f"{self.angle:g} deg"
        elevation = self.elevation or None
        return Given(
            name,
            matrices=matrices,
            ports=self.ports,
            plan=self.plan,
            angle=angle,
            elevation=elevation,
            damping=self.stated,
        )


def _fault(problem: str, remedy: str | None = None) -> ModelError:
    text = f"OpenSees: {problem}" + (f"\n  {remedy}" if remedy else "")
    return ModelError(text, [("", problem, remedy, None, None)])


def unit_factors(units: str) -> tuple[float, float]:
    """One unit of force [N] and of length [m]."""
    parts = [part.strip().lower() for part in units.split(",")]
    if len(parts) != 2 or parts[0] not in _FORCES or parts[1] not in _LENGTHS:
        raise ModelError(
            f'units: expected force and length, such as "kN, m" or "kip, in", found {units!r}; '
            f"forces: {', '.join(_FORCES)}; lengths: {', '.join(_LENGTHS)}"
        )
    return _FORCES[parts[0]], _LENGTHS[parts[1]]


@contextlib.contextmanager
def _quiet() -> Iterator[io.StringIO]:
    """Collects what OpenSees prints."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        yield said


@dataclass
class _Node:
    tag: int
    at: list[float]
    #: Equation of every displacement, that of the retained node where the node is tied; negative where there is none.
    equations: list[int]
    #: Displacements that are tied to another node, and that node.
    tied: frozenset[int] = frozenset()
    retained: int | None = None


def _node(ops: Any, tag: int) -> _Node:
    """A node of the model. OpenSees lists free displacements of a tied node first, then those of the retained node."""
    listed, at = list(ops.nodeDOFs(tag)), list(ops.nodeCoord(tag))
    if tag not in (ops.getConstrainedNodes() or []):
        return _Node(tag, at, listed)
    retained = sorted(set(ops.getRetainedNodes(tag)))
    if len(retained) != 1:
        raise _fault(
            f"node {tag} is tied to several nodes ({', '.join(map(str, retained))}); constraints \"Transformation\" take one",
            "tie it to one node by one constraint",
        )
    tied = [place - 1 for place in ops.getConstrainedDOFs(tag, retained[0])]
    count = len(ops.nodeDisp(tag))
    free = [place for place in range(count) if place not in tied]
    if len(listed) != count:
        raise _fault(
            f"node {tag} is tied by a constraint that jostle does not know", "use equalDOF, rigidLink or rigidDiaphragm"
        )
    equations = [-1] * count
    for place, equation in zip([*free, *tied], listed):
        equations[place] = equation
    return _Node(tag, at, equations, frozenset(tied), retained[0])


def _assembled(ops: Any) -> tuple[_Array, _Array, _Array, list[_Node]]:
    """M, C and K over the equations of the model in its units, and its nodes."""
    import numpy as np

    tags = list(ops.getNodeTags() or [])
    if not tags:
        raise _fault("there is no model in memory", "build it before, and do not wipe() it")
    count = sum(len(ops.nodeDisp(tag)) for tag in tags)
    if count > 4 * _MOST:
        raise _fault(
            f"the model has {count} displacements; full matrices of more than {_MOST} are not read",
            "condense it in OpenSees, or give floors by their modes: kind = \"given\" with mass, periods and shapes",
        )

    def one(m: float, c: float, k: float) -> _Array:
        ops.wipeAnalysis()
        ops.constraints("Transformation")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.algorithm("Linear")
        ops.integrator("GimmeMCK", m, c, k)
        ops.analysis("Transient")
        ops.analyze(1, 0.0)
        size = ops.systemSize()
        if size == 0:
            raise _fault("the model has no displacement that is free")
        if size > _MOST:
            raise _fault(
                f"the model has {size} equations; full matrices of more than {_MOST} are not read",
                "condense it in OpenSees, or give floors by their modes: kind = \"given\" with mass, periods and shapes",
            )
        values = np.array(ops.printA("-ret"), dtype=np.float64)
        if values.size != size * size:
            raise _fault(f"printA returned {values.size} values for {size} equations")
        if not np.isfinite(values).all():
            raise _fault("a matrix has entries that are no finite numbers")
        return values.reshape(size, size)

    with _quiet():
        stiffness, damping, mass = one(0, 0, 1), one(0, 1, 0), one(1, 0, 0)
        nodes = [_node(ops, tag) for tag in tags]
        ops.wipeAnalysis()
    return mass, damping, stiffness, nodes


def _symmetric(name: str, matrix: _Array) -> _Array:
    import numpy as np

    greatest = float(np.abs(matrix).max(initial=0.0))
    apart = float(np.abs(matrix - matrix.T).max(initial=0.0))
    if apart > 1e-6 * greatest:
        raise _fault(
            f"the {name} matrix is not symmetric ({apart / greatest:.1e} of its greatest entry)",
            "take friction, contact and follower loads out of the model; jostle adds contact itself",
        )
    symmetric: _Array = 0.5 * (matrix + matrix.T)
    return symmetric


def read_model(
    ops: Any,
    direction: int | str,
    side: str,
    units: str,
    ports: Sequence[int] | None,
    plan: Sequence[Any] | None,
    damping: Table | None,
) -> CondensedModel:
    """The model in memory; arguments are those of :func:`jostle.from_opensees`."""
    import numpy as np

    force, length = unit_factors(units)
    along = {1: 0, 2: 1, "1": 0, "2": 1, "x": 0, "y": 1}.get(direction)
    if along is None:
        raise ModelError(f'direction: expected 1 or 2, "x" or "y", found {direction!r}')
    if side not in ("left", "right"):
        raise ModelError(f'side: expected "left" or "right", found {side!r}')
    mass, viscous, stiffness, nodes = _assembled(ops)
    dimensions = len(nodes[0].at)
    if dimensions not in (2, 3):
        raise _fault(f"the model has {dimensions} dimension; a building needs 2 or 3")
    if dimensions == 2 and along == 1:
        raise ModelError("direction: a model in the plane moves along x; direction = 2 needs one in space")
    up = dimensions - 1

    # Which equations turn: their matrices are in other units.
    turns = np.zeros(len(mass), dtype=bool)
    for node in nodes:
        for place, equation in enumerate(node.equations):
            if equation >= 0 and place >= dimensions:
                turns[equation] = True
    scale = np.where(turns, length, 1.0)
    scales = np.outer(scale, scale) * force / length
    mass, viscous, stiffness = (
        _symmetric(name, own * scales)
        for name, own in (("mass", mass), ("damping", viscous), ("stiffness", stiffness))
    )
    for node in nodes:
        node.at = [length * value for value in node.at]

    bottom = min(node.at[up] for node in nodes)
    height = max(node.at[up] for node in nodes) - bottom
    if not height > 0.0:
        raise _fault(
            "all nodes lie at one height", f"coordinate {up + 1} is the vertical one: {'xyz'[up]}"
        )
    if dimensions == 3:
        _refuse_upward_y(nodes, height)
    remarks = _state_remarks(ops, nodes)
    raw = mass.copy()
    _drop_fillers(mass, turns, height, nodes)
    if not (np.diag(mass)[~turns] > 0.0).any():
        raise _fault("no displacement carries mass", "give floors their mass: ops.mass(node, m, m, 0)")

    # An equation without mass and stiffness moves nothing; one with mass needs stiffness.
    resisted = np.abs(stiffness).max(axis=0) > 1e-14 * np.abs(stiffness).max()
    free = np.flatnonzero(~resisted & (np.diag(mass) > 0.0))
    if len(free):
        raise _fault(
            f"{_who(nodes, free)} has mass and no stiffness", "connect the node, or remove its mass"
        )

    alpha_beta, proportional = _rayleigh(raw, stiffness, viscous)
    levels = _levels(nodes, mass, up, along, bottom, height)
    if not levels:
        raise _fault(
            "no level above the lowest nodes carries horizontal mass",
            "give floors their mass: ops.mass(node, m, m, 0)",
        )
    diaphragms = None if dimensions == 2 else _diaphragms(levels, mass)
    if diaphragms is None:
        read = _one_direction(
            nodes, levels, mass, stiffness, along, up, bottom, side, ports, dimensions
        )
    else:
        if ports is not None:
            raise ModelError("ports: a building with rigid diaphragms is hit along the edges of its plan, not at nodes")
        read = _in_plan(diaphragms, mass, stiffness, along, bottom, plan)
    keep, result = read
    result.remarks[:0] = remarks
    result.equations = len(mass)
    result.elevation = bottom if abs(bottom) > _LEVEL * height else 0.0
    condense = _condensation(stiffness, keep, resisted, nodes)
    result.stiffness = _positive(_symmetric("condensed stiffness", condense.T @ stiffness @ condense))
    _say_units(result, units)
    _periods(result, mass, stiffness, resisted, nodes)

    if damping is not None:
        result.stated = damping
    elif not np.abs(viscous).max() > 0.0:
        result.remarks.append(
            "the model has no damping in its matrix, where objects of the command damping are not, so jostle uses 5 % of critical in "
            "modes 1 and 3; a damping ratio of 0 keeps it undamped"
        )
    elif proportional < 1e-6 and min(alpha_beta) >= 0.0:
        result.stated = {"alpha": f"{alpha_beta[0]!r} 1/s", "beta": f"{alpha_beta[1]!r} s"}
    else:
        # Without mass, C cannot be condensed exactly: displacements follow those with mass as in statics.
        result.damping = _symmetric("condensed damping", condense.T @ viscous @ condense)
        result.remarks.append(
            f"damping is not α M + β K (remainder {proportional:.1e} of its greatest entry), so the matrix itself is used, condensed as in "
            "statics. Of region -node and region -ele with -rayleigh the later one overwrites the earlier; region -ele takes its nodes with it"
        )
    return result


def _state_remarks(ops: Any, nodes: list[_Node]) -> list[str]:
    """What the current state means for the tangent."""
    remarks = []
    moved = max((abs(value) for node in nodes for value in ops.nodeDisp(node.tag)), default=0.0)
    if moved > 0.0:
        remarks.append(
            "the model is displaced: its stiffness is the tangent at this state, with the P-Delta effect of the loads on it"
        )
    other: dict[str, int] = {}
    yields = _yielding(ops)
    for tag in ops.getEleTags() or []:
        kind = str(ops.eleType(tag))
        lower = kind.lower()
        if lower.startswith("elastic"):
            continue
        if lower.startswith(_BY_MATERIAL):
            # A solid of which nothing is printed is taken as elastic, as most are.
            found = yields.get(tag, [] if lower.startswith(_SOLIDS) else ["materials that OpenSees does not print"])
            if not found:
                continue
            kind = f"{kind} with {' and '.join(found)}"
        other[kind] = other.get(kind, 0) + 1
    if other:
        named = ", ".join(f"{count} {kind}" for kind, count in sorted(other.items()))
        remarks.append(f"the building is elastic in jostle; {named} enter with their current tangent and do not yield")
    return remarks


#: Beginnings of element types that are as elastic as their materials.
_SOLIDS = ("shell", "quad", "fournodequad", "brick", "stdbrick", "tri31", "ssp")
_BY_MATERIAL = ("truss", "zerolength", "twonodelink", *_SOLIDS)
#: Materials that combine others, and have no limits of their own.
_COMBINED = ("ParallelMaterial", "SeriesMaterial", "InitStrainMaterial")
#: A material, section or element, as OpenSees prints it: name, type and the rest of its line.
_PRINTED = re.compile(r'\{"name": "?(-?\d+)"?, "type": "(\w+)"(.*)')
#: A material that has no JSON, such as a dashpot: type, tag.
_PLAIN = re.compile(r"(\w+?)(?:Material)?,? tag: (\d+)\s*$")
_BLOCK = re.compile(r'"(uniaxialMaterials|ndMaterials|sections|elements)": \[')


def _yielding(ops: Any) -> dict[int, list[str]]:
    """Types of the materials of every element that are not linear; elements of which nothing is known are missing.

    The text of printModel is read by lines: materials without JSON make it invalid as a whole.
    """
    with tempfile.TemporaryDirectory() as folder, _quiet():
        path = Path(folder) / "model.json"
        try:
            ops.printModel("-JSON", "-file", str(path))
            text = path.read_text("utf-8", "replace")
        except Exception:
            return {}
    # Block, tag: type and what follows it.
    known: dict[tuple[str, int], tuple[str, str]] = {}
    block, last = "", ("", 0)
    for line in text.splitlines():
        begins = _BLOCK.search(line)
        if begins:
            block = begins[1]
        printed, plain = _PRINTED.search(line), _PLAIN.match(line)
        if printed:
            last = (block, int(printed[1]))
            known[last] = (printed[2], printed[3])
        elif plain:
            last = (block, int(plain[2]))
            known[last] = (plain[1], "")
        elif last in known:
            kind, rest = known[last]
            known[last] = (kind, f"{rest}\n{line}")

    def tags(rest: str) -> list[int]:
        listed = re.search(r'"[Mm]aterials?": (\[[^]]*\]|"?-?\d+)', rest)
        return [int(tag) for tag in re.findall(r"-?\d+", listed[1])] if listed else []

    def limits(where: str, tag: int, depth: int = 0) -> list[str]:
        """Types that are not linear, of a material or a section."""
        if (where, tag) not in known or depth > 20:
            return ["a material that OpenSees does not print"]
        kind, rest = known[where, tag]
        if kind == "ElasticMaterial":
            ways = dict(re.findall(r'"(Epos|Eneg)": ([^,}\s]+)', rest))
            return [] if ways.get("Epos") == ways.get("Eneg") else [kind]
        if kind == "Viscous":
            return [] if re.search(r"Alpha: 1\s", f"{rest}\n") else [kind]
        if kind in _COMBINED:
            return [found for inner in tags(rest) for found in limits(where, inner, depth + 1)]
        return [] if kind.startswith("Elastic") and kind not in _ELASTIC_IN_NAME else [kind]

    found: dict[int, list[str]] = {}
    for (where, tag), (kind, rest) in known.items():
        if where != "elements":
            continue
        solid = kind.lower().startswith(_SOLIDS)
        section = re.search(r'"section": "?(-?\d+)', rest)
        kinds = [own for inner in tags(rest) for own in limits("ndMaterials" if solid else "uniaxialMaterials", inner)]
        if section:
            kinds += limits("sections", int(section[1]))
        if section or tags(rest):
            found[tag] = list(dict.fromkeys(kinds))
    return found


#: Types that yield, or are not linear, though their names begin with Elastic.
_ELASTIC_IN_NAME = ("ElasticPPMaterial", "ElasticPP", "ElasticPPGap", "ElasticMultiLinear", "ElasticBilin", "ElasticPowerFunc")


def _refuse_upward_y(nodes: list[_Node], height: float) -> None:
    """Raises an error for a model whose second coordinate is the height, by its diaphragms or its supports."""
    problem = ""
    if any(node.tied == {0, 2, 4} for node in nodes):
        problem = "rigid diaphragms lie in the plane of x and z, so y is the height"
    held = [node.at for node in nodes if not node.tied and max(node.equations[:3]) < 0]
    if held and not problem:
        low_y, low_z = (min(node.at[axis] for node in nodes) for axis in (1, 2))
        spread_y, spread_z = (max(at[axis] for at in held) - low for axis, low in ((1, low_y), (2, low_z)))
        if spread_y < _LEVEL * height and spread_z > _LEVEL * height:
            problem = "all supports are at the lowest y and at several z, so y is the height"
    if problem:
        raise _fault(
            f"{problem}, but jostle takes z as the height",
            "build the model with z upward: exchange y and z of nodes, masses, supports, vecxz and diaphragms",
        )


def _drop_fillers(mass: _Array, turns: npt.NDArray[np.bool_], height: float, nodes: list[_Node]) -> None:
    """Sets masses to zero that are there only to please a solver, by their share of the largest."""
    import numpy as np

    diagonal = np.diag(mass)
    if (diagonal < 0.0).any():
        raise _fault(f"{_who(nodes, np.flatnonzero(diagonal < 0.0))} has a negative mass")
    largest = float(diagonal[~turns].max(initial=0.0))
    # A rotary mass is compared with the largest mass at a tenth of the height.
    least = np.where(turns, _FILLER * largest * (0.1 * height) ** 2, _FILLER * largest)
    fillers = diagonal < least
    mass[fillers, :] = 0.0
    mass[:, fillers] = 0.0


def _who(nodes: list[_Node], equations: Iterable[int]) -> str:
    """Nodes and displacements of equations, as texts of messages."""
    wanted = {int(equation) for equation in equations}
    found = [
        f"node {node.tag}, displacement {place + 1}"
        for node in nodes
        for place, equation in enumerate(node.equations)
        if equation in wanted
    ]
    more = f" and {len(found) - 5} more" if len(found) > 5 else ""
    return "; ".join(found[:5]) + more or "an equation without a node"


@dataclass
class _Level:
    height: float
    nodes: list[_Node]


def _levels(
    nodes: list[_Node], mass: _Array, up: int, along: int, bottom: float, height: float
) -> list[_Level]:
    """Levels above the base where a horizontal displacement carries mass, from the ground up."""
    levels: list[_Level] = []
    for node in sorted(nodes, key=lambda node: node.at[up]):
        if levels and node.at[up] - bottom - levels[-1].height < _LEVEL * height:
            levels[-1].nodes.append(node)
        else:
            levels.append(_Level(node.at[up] - bottom, [node]))

    def massive(node: _Node) -> bool:
        directions = range(up) if up == 2 else (along,)
        own = (node.equations[place] for place in directions)
        return any(equation >= 0 and mass[equation, equation] > 0.0 for equation in own)

    return [
        level
        for level in levels
        if level.height > _LEVEL * height and any(massive(node) for node in level.nodes)
    ]


#: A level with the equations of x, y and rotation of its diaphragm, and the node that has them.
_Diaphragm = tuple[_Level, tuple[int, int, int], _Node]


def _diaphragms(levels: list[_Level], mass: _Array) -> list[_Diaphragm] | None:
    """Rigid diaphragms in space, one at every level with mass; ``None`` if no level has one."""
    found: list[_Diaphragm] = []
    loose: list[str] = []
    for level in levels:
        # Nodes that a rigid diaphragm ties move and turn with the retained one.
        turning: dict[int, list[_Node]] = {}
        for node in level.nodes:
            if len(node.equations) == 6 and node.equations[5] >= 0:
                turning.setdefault(node.equations[5], []).append(node)
        owners = [
            node
            for node in level.nodes
            if len(node.equations) == 6
            and min(node.equations[0], node.equations[1], node.equations[5]) >= 0
            and mass[node.equations[0], node.equations[0]] > 0.0
            and mass[node.equations[1], node.equations[1]] > 0.0
            and mass[node.equations[5], node.equations[5]] > 0.0
            and len(turning[node.equations[5]]) > 1
        ]
        owners = [node for node in owners if not node.tied]
        triples = {(node.equations[0], node.equations[1], node.equations[5]) for node in owners}
        massive = {
            equation
            for node in level.nodes
            for equation in node.equations[:2]
            if equation >= 0 and mass[equation, equation] > 0.0
        }
        if len(triples) == 1 and massive == set(next(iter(triples))[:2]):
            triple = next(iter(triples))
            found.append((level, triple, owners[0]))
        else:
            loose.append(f"{level.height:.4g} m")
    if not found:
        return None
    if loose:
        raise _fault(
            f"levels {', '.join(loose)} carry mass and are no single rigid diaphragm with mass in x, y and rotation; the others are",
            "tie all nodes with mass of these levels by rigidDiaphragm(3, retained, …), and let the retained node turn",
        )
    return found


def _one_direction(
    nodes: list[_Node],
    levels: list[_Level],
    mass: _Array,
    stiffness: _Array,
    along: int,
    up: int,
    bottom: float,
    side: str,
    ports: Sequence[int] | None,
    dimensions: int,
) -> tuple[npt.NDArray[np.intp], CondensedModel]:
    """A building of one direction: floors are levels, hit at their outermost node."""
    import numpy as np

    # `levels` looks in both directions in space; only masses in this one make floors.
    def carries(node: _Node) -> bool:
        equation = node.equations[along]
        return equation >= 0 and bool(mass[equation, equation] > 0.0)

    levels = [level for level in levels if any(carries(node) for node in level.nodes)]
    if not levels:
        raise _fault(f"no level carries mass in direction {along + 1}")
    diagonal = np.diag(mass).copy()
    off = np.abs(mass - np.diag(diagonal)).max(initial=0.0) / diagonal.max()
    if off > _ROUNDING:
        raise _fault(
            f"the mass matrix is not diagonal ({off:.1e} of its greatest entry)",
            "use lumped masses (no -cMass), and let the retained node of a rigid link lie at the centre of mass",
        )
    hit: list[_Node] = []
    if ports is None:
        outermost = max if side == "right" else min
        for level in levels:
            able = [node for node in level.nodes if node.equations[along] >= 0]
            edge = outermost(node.at[along] for node in able)
            reach = _LEVEL * (max(n.at[along] for n in nodes) - min(n.at[along] for n in nodes))
            here = [node for node in able if abs(node.at[along] - edge) <= reach]
            hit.append(next((node for node in here if carries(node)), here[0]))
    else:
        known = {node.tag: node for node in nodes}
        for tag in ports:
            if tag not in known:
                raise ModelError(f"ports: the model has no node {tag}")
            hit.append(known[tag])
        hit.sort(key=lambda node: node.at[up])
    by_tag = {node.tag: node for node in nodes}
    for node in hit:
        if along in node.tied and node.retained is not None:
            apart = abs(by_tag[node.retained].at[up] - node.at[up])
            if apart > _LEVEL * max(own.at[up] - bottom for own in nodes):
                raise _fault(
                    f"node {node.tag}, which is hit, is tied to node {node.retained} at another height", "name other nodes: ports=[…]"
                )
    bare = [node for node in hit if not carries(node)]
    if bare:
        listed = ", ".join(f"{node.tag} at {node.at[up] - bottom:.4g} m" for node in bare[:8])
        raise _fault(
            f"a floor that can be hit needs mass there, and nodes {listed} have none in direction {along + 1}",
            "move part of the mass of the floor there, tie the node with equalDOF to one that has mass, or name other nodes: ports=[…]",
        )
    keep = np.flatnonzero(diagonal > 0.0)
    row = {int(equation): index for index, equation in enumerate(keep)}
    influence, heights = np.zeros(len(mass)), np.zeros(len(mass))
    for node in nodes:
        equation = node.equations[along]
        if equation >= 0 and along not in node.tied:
            influence[equation], heights[equation] = 1.0, node.at[up] - bottom
    chosen: dict[str, dict[str, Any]] = {}
    for index, node in enumerate(hit, 1):
        dof = row[node.equations[along]] + 1
        chosen[str(index)] = {"dof": dof, "height": node.at[up] - bottom}
    read = CondensedModel(
        mass=diagonal[keep],
        stiffness=stiffness,
        damping=None,
        influence=influence[keep],
        heights=heights[keep],
        ports=chosen,
        stated=None,
        nodes=[node.tag for node in hit],
    )
    if dimensions == 3:
        read.remarks.append(
            f"the model is in space and has no rigid diaphragms: only its motion in direction {along + 1} enters jostle, without torsion in contact"
        )
    return keep, read


def _in_plan(
    diaphragms: list[_Diaphragm],
    mass: _Array,
    stiffness: _Array,
    along: int,
    bottom: float,
    plan: Sequence[Any] | None,
) -> tuple[npt.NDArray[np.intp], CondensedModel]:
    """A building with a plan: x, y and rotation of every diaphragm."""
    import numpy as np

    keep = np.array([equation for _, triple, _ in diaphragms for equation in triple])
    ports: dict[str, dict[str, Any]] = {}
    plans: list[dict[str, Any]] = []
    for index, (level, _, retained) in enumerate(diaphragms):
        turns = retained.equations[5]
        tied = [node for node in level.nodes if len(node.equations) == 6 and node.equations[5] == turns]
        xs, ys = ([node.at[place] for node in tied] for place in (0, 1))
        x, y = (min(xs), max(xs)), (min(ys), max(ys))
        if plan is None and not (x[1] > x[0] and y[1] > y[0]):
            raise _fault(
                f"the nodes of the diaphragm at {level.height:.4g} m lie on one line", "give plan=[\"20 m\", \"12 m\"]"
            )
        corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
        plans.append({"corners": corners})
        ports[str(index + 1)] = {
            "dofs": [3 * index + 1, 3 * index + 2, 3 * index + 3],
            "at": retained.at[:2],
            "height": level.height,
        }
    reduced = mass[np.ix_(keep, keep)]
    for index, (level, _, retained) in enumerate(diaphragms):
        along_x, along_y = (float(reduced[3 * index + axis, 3 * index + axis]) for axis in (0, 1))
        if abs(along_x - along_y) > 1e-6 * max(along_x, along_y):
            raise _fault(
                f"the floor at {level.height:.4g} m (node {retained.tag}) has {along_x:.6g} kg along x and {along_y:.6g} kg along y; "
                "a floor with a plan has one mass",
                f"give node {retained.tag} and those that it holds the same mass along x and y",
            )
    read = CondensedModel(
        mass=reduced,
        stiffness=stiffness,
        damping=None,
        influence=None,
        heights=None,
        ports=ports,
        stated=None,
        plan=plans if plan is None else plan,
        # The direction of the row becomes x of the site.
        angle=-90.0 if along == 1 else None,
        nodes=[retained.tag for _, _, retained in diaphragms],
    )
    return keep, read


def _condensation(
    stiffness: _Array, keep: npt.NDArray[Any], resisted: npt.NDArray[np.bool_], nodes: list[_Node]
) -> _Array:
    """The displacements of all equations per unit of those kept, without load on the others."""
    import numpy as np

    rest = np.setdiff1d(np.flatnonzero(resisted), keep)
    shape = np.zeros((len(stiffness), len(keep)))
    shape[keep, np.arange(len(keep))] = 1.0
    if len(rest):
        inner = stiffness[np.ix_(rest, rest)]
        try:
            shape[rest] = -np.linalg.solve(inner, stiffness[np.ix_(rest, keep)])
        except np.linalg.LinAlgError:
            shape[rest] = math.nan
        if not np.isfinite(shape).all() or np.linalg.cond(inner) > 1e14:
            raise _fault(
                f"without its masses the structure is a mechanism: {_who(nodes, _mechanism(inner, rest))}",
                "fix the displacement, or connect the node",
            )
    return shape


def _mechanism(inner: _Array, rest: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """The equations that move most in the softest shape."""
    import numpy as np

    _, shapes = np.linalg.eigh(inner)
    softest = np.abs(shapes[:, 0])
    chosen: npt.NDArray[Any] = rest[softest > 0.5 * softest.max()]
    return chosen


def _positive(stiffness: _Array) -> _Array:
    import numpy as np

    values = np.linalg.eigvalsh(stiffness)
    if values[0] <= 1e-14 * values[-1]:
        raise _fault(
            "the stiffness at this state is not positive definite",
            "take the model before it yields, buckles or loses its supports",
        )
    return stiffness


def _rayleigh(mass: _Array, stiffness: _Array, viscous: _Array) -> tuple[list[float], float]:
    """α and β of C = α M + β K by least squares, and the greatest remainder in parts of the greatest entry.

    Entries are divided by √(K_ii K_jj), so that units do not matter.
    """
    import numpy as np

    size = np.sqrt(np.maximum(np.diag(stiffness), 1e-30 * np.abs(stiffness).max()))
    weight = 1.0 / np.outer(size, size)
    columns = np.stack([(weight * own).ravel() for own in (mass, stiffness)], 1)
    norms = np.abs(columns).max(axis=0)
    norms[norms == 0.0] = 1.0
    wanted = (weight * viscous).ravel()
    greatest = float(np.abs(wanted).max(initial=0.0))
    if greatest == 0.0:
        return [0.0, 0.0], 0.0
    solved, *_ = np.linalg.lstsq(columns / norms, wanted, rcond=None)
    remainder = float(np.abs(wanted - columns / norms @ solved).max()) / greatest
    alpha, beta = (float(value) for value in solved / norms)
    # Coefficients that are rounding.
    shares = np.abs(solved) / greatest
    alpha, beta = (0.0 if share < 1e-9 else value for share, value in zip(shares, (alpha, beta)))
    return [alpha, beta], remainder


def _say_units(read: CondensedModel, units: str) -> None:
    heights = [port["height"] for port in read.ports.values()]
    storeys = [upper - lower for lower, upper in zip([0.0, *heights], heights)]
    if max(storeys) > 15.0 or min(storeys) < 0.5:
        read.remarks.append(
            f"storeys are {min(storeys):.4g} to {max(storeys):.4g} m high in {units!r}; check units, which OpenSees does not know"
        )


def _periods(
    read: CondensedModel, mass: _Array, stiffness: _Array, resisted: npt.NDArray[np.bool_], nodes: list[_Node]
) -> None:
    """Keeps the periods of the whole model, and says what masses that are left out change."""
    import numpy as np

    full = mass if read.plan is not None else None
    reduced = read.mass if read.mass.ndim == 2 else np.diag(read.mass)
    own = _natural(reduced, read.stiffness)
    read.periods = own
    if full is None:
        return
    kept = float(np.trace(full)) - float(np.trace(reduced))
    if not kept > 1e-9 * float(np.trace(full)):
        return
    massive = np.flatnonzero(np.diag(full) > 0.0)
    shape = _condensation(stiffness, massive, resisted, nodes)
    all_periods = _natural(full[np.ix_(massive, massive)], shape.T @ stiffness @ shape)
    count = min(3, len(own))
    change = float(np.abs(own[:count] / all_periods[:count] - 1.0).max())
    read.remarks.append(
        "vertical masses, and those that turn about horizontal axes, are left out: floors with a plan move in x and y and turn; "
        f"the {count} longest periods change by {100 * change:.2g} %"
    )


def _natural(mass: _Array, stiffness: _Array) -> _Array:
    """Periods, longest first [s].

    They are eigenvalues of K⁻¹ M: those of M⁻¹ K lose the digits of the longest periods to the shortest.
    """
    import numpy as np

    factor = np.linalg.cholesky(stiffness)
    half = np.linalg.solve(factor, mass)
    squares = np.linalg.eigvalsh(np.linalg.solve(factor, half.T))
    periods: _Array = 2.0 * math.pi * np.sqrt(np.maximum(squares[::-1], 0.0))
    return periods
