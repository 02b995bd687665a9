"""Buildings, gaps and links: the parts of a model."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Union

from ._units import (
    FrameUnits,
    GapUnits,
    GivenUnits,
    LinkUnits,
    Quantities,
    Quantity,
    ShearUnits,
    SpaceFrameUnits,
    merge,
    split,
    with_unit,
)

if TYPE_CHECKING:
    import numpy.typing as npt
    from typing_extensions import Unpack

    #: Contact laws of model files.
    _Law = Literal[
        "linear",
        "kelvin",
        "kelvin-no-tension",
        "modified-kelvin",
        "hertz",
        "hertz-damp",
        "ye",
        "jankowski",
        "bilinear",
        "restitution",
        "rubber",
        "formula",
    ]
    #: What a coefficient of restitution means.
    _RestitutionIs = Literal["input", "realised"]
    #: Damping of the law ``modified-kelvin``.
    _Variant = Literal["ye", "mahmoud-jankowski"]
    #: Force and length of given matrices.
    _MatrixUnits = Literal["N, m", "kN, m", "N, mm", "kN, mm", "kip, ft", "kip, in"]
    #: Whether members change their length, or shear deforms them.
    _Flexibility = Literal["rigid", "flexible"]

#: A section, a damping, … as the table of the model file.
Table = Mapping[str, object]

#: Where neighbours touch or are joined: a word, pairs of floors or heights, or heights.
Floors = Union[str, Sequence[Union[Quantity, Sequence[Quantity]]]]


class Part:
    """A table of the model file. The reader of model files checks it when a model is created."""

    #: Keywords with a unit in their name that editors offer.
    _with_units: ClassVar[tuple[str, ...]] = ()

    def __init__(self, fields: Mapping[str, object], extra: Mapping[str, object]) -> None:
        self._fields = merge(type(self).__name__, fields, extra, self._with_units)

    def to_dict(self) -> dict[str, Any]:
        """The table as in a model file."""
        return dict(self._fields)

    def __repr__(self) -> str:
        fields = ", ".join(f"{key}={value!r}" for key, value in self._fields.items())
        return f"{type(self).__name__}({fields})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and repr(self) == repr(other)

    __hash__ = None  # type: ignore[assignment]


class Frame(Part):
    """A plane frame of columns and beams with lumped masses.

    Args:
        name: name of the building, used by gaps and links; ``"B1"``, ``"B2"``, … by default.
        storeys: number of storeys, 1 to 200; not needed with a list per storey.
        storey_height: one length, or a list from the ground up.
        spans: widths of the bays from left to right, lengths.
        column: section of the columns, or a list from the ground up: ``{"width": "500 mm", "depth": "500 mm"}`` or
            ``{"EI": "150 MN.m2"}``; keys may contain units, ``{"width_mm": 500, "depth_mm": 500}``. Or a list of
            tables that each apply to some positions, where later tables override earlier ones: ``[{"EI": "60 MN.m2"}, {"line":
            2, "EI": "95 MN.m2"}, {"line": [3, 4], "storeys": [3, 6],
            "omit": True}]``.
        beam: section of the beams, a list from the ground up, or a list of tables for some positions each: ``bay``, ``floors``,
            ``omit``.
        elastic_modulus: modulus of elasticity.
        concrete: ``"C30"`` (GB 50010), ``"C30/37"`` (EN 1992-1-1) or ``"f'c = 4 ksi"`` (ACI 318), instead of
            ``elastic_modulus``.
        stiffness_factor: factor on every EI, or ``{"column": 0.7, "beam": 0.35}``.
        density: density of columns, 2500 kg/m³ by default.
        beam_mass: mass per length carried by the beams, including their self weight: one value, or a list from the ground up.
        floor_mass: additional mass of a whole floor: one value, or a list from the ground up.
        floor_load: weight per floor that the columns carry in addition to that of the masses: one value, or a list from the
            ground up.
        column_segments: segments of a column in one storey, 4 by default.
        beam_segments: segments of the beams, 4 by default: one count, or one per span.
        axial: ``"rigid"`` or ``"flexible"`` columns, or ``{"columns": …, "beams": …}``; by default columns with ``EA`` are flexible
            in frames that have walls, are more than 3 times as high as wide or have more than ten storeys, except on a
            foundation.
        joint: semi-rigid connections of beams, ``{"rotational_stiffness": "2e8 N.m/rad"}``; with ``"hinge"`` they yield:
            ``{"rule": "bilinear", "yield": "200 kN.m", "post_yield": 0.02}``.
        rigid_ends: fraction of the half depths of columns and beams that is rigid inside joints: 0 by default, 1 up to the
            faces; or
            lengths from the axes, ``{"beams": "0.25 m", "columns": "0.3 m"}``.
        damping: ``{"ratio": 0.05, "modes": [1, 3]}`` or ``{"alpha": …, "beta": …}``; 5 % by default; with hinges,
            3 % or less is usual.
        base: springs and dashpots under every column: ``"fixed"`` (default) or ``{"rotational_stiffness": …}``.
        isolation: bearings and a mat under the building, such as ``{"kind": "lead-rubber", "mat_mass": "150 t", …}``; with
            ``"bounds": {"lower": 0.85, "upper": 1.3}`` a run also computes both bounds of the bearings.
        foundation: rigid foundation on the ``soil`` of the model, ``{"length": "12 m", "width": "12 m", "mass": "120 t"}``;
            ``"uplift": True, "springs": 11`` lets it lift off, with ``gravity=True``.
        hinges: plastic hinges at the member ends; without them the frame is elastic:
            ``{"rule": "peak-oriented", "from": "section"}`` or
            ``{"rule": "normal", "initial": 100, "column": {"cracking": "120 kN.m", …}, "beam": {…}}``. With
            ``{"rule": "fibre", "length": "0.4 m"}`` the ends of columns with bars are fibres, whose strength follows the axial force;
            ``"steel": "menegotto-pinto"`` bends the loops of their bars, and ``"limits": {"buckling": 0.04}`` states strains
            by which they are judged. ``{"rule": "surface", "length": "0.4 m"}`` lets them yield on the interaction diagram
            instead, or on ``"surface": {"axial": ["-6 MN", "-2 MN", "1 MN"], "moment": ["0 kN.m", "500 kN.m", "0 kN.m"]}``.
        shear_failure: shear failure of columns: ``{"rule": "sezen-moehle", "residual": 0.2}`` or
            ``{"strength": "300 kN", "slope": "5 MN/m"}``; without it their shear strength has no limit.
        rotation_limit: hinge rotations at which members reach performance levels:
            ``[{"of": "columns", "limits": {"io": "5 mrad", "ls": "15 mrad", "cp": "20 mrad"}}]``.
        brace: braces between joints: ``[{"storeys": [1, 3], "bay": 1, "direction": "both", "EA": "600 MN"}]``, or
            ``{"from": "0.1", "to": "2.3", "EA": "2 GN"}`` between two joints, each given by floor and line; with ``"hinge"``
            they yield, or buckle: ``{"profile": "HEB160", "hinge": {"rule": "buckling", "curve": "c", "yield_strength": "275
            MPa"}}``.
        infill: masonry panels in the bays, modelled by compression-only struts:
            ``[{"storeys": [2, 4], "modulus": "4 GPa", "thickness": "200 mm", "width": "1.4 m"}]``; ``"out_of_plane"`` compares
            their out-of-plane capacity with the demand, and with ``"remove": True`` they fall out; ``"density": "1400 kg/m3"``
            adds their mass to the floors; ``"offset": "300 mm"`` places the ends of struts on the columns away from the joints,
            and
            ``"damage_drifts"`` are the drifts of four damage states.
        wall: walls, each of which replaces a column line: ``[{"at": "4.5 m", "length": "3 m", "thickness": "250 mm"}]``; with
            ``"hinge"``
            they yield at their feet, or above its ``"floors"``. Bars make feet of fibres: ``{"steel": "HRB400",
            "bars": {"edges": "8 d20", "edge_length": "500 mm", "web": "20 d10"}, "hinge": {"rule": "fibre", "length": "1 m"}}``.
        coupling_beam: beams between walls, with separate properties; their forces are reported:
            ``[{"between": [1, 2], "width": "250 mm", "depth": "800 mm"}]``.
        elevation: height of the base above a datum common to all buildings, 0 by default; contacts and links use heights above
            it.
        position: position along the row, for ``apparent_velocity`` and ``coherency`` of the motion.
        motion: ground motion under this building, if it differs: ``{"arrival": "30 ms"}``, ``{"record": …, "scale": …}``.
        gravity: whether the run starts from the displacements under self weight; ``False`` by default.
        p_delta: whether P-Delta from the weight above is included; by default ``True`` with hinges, otherwise ``False``.
        damper: dampers and other links between two floors of this building, such as
            ``[{"floors": [0, 1], "law": "viscous", "damping": "200 kN.(s/m)^0.5", "exponent": 0.5}]``.
        soil_spring: soil beside floors below ground, for buildings without a plan on a fixed base:
            ``[{"floors": [1, 2], "stiffness": "200 MN/m", "strength": "1.5 MN", "gapping": True}]``.
        codes: factors of this building for the separation rules of codes: ``{"behaviour_factor": 3.9}``.
        shear: ``"rigid"`` (default), or ``"flexible"`` for members with shear deformation (Timoshenko), or
            ``{"columns": …, "beams": …}``.
        poisson_ratio: for the shear modulus, 0.2 by default.
        floors: another name for ``storeys``.
        **units: the same with units in names, as in ``storey_height_m=3.2``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> frame = jostle.Frame(
        ...     "A", storeys=2, storey_height="3.2 m", spans=["6 m"], concrete="C30", beam_mass="24 kN/m",
        ...     column={"width": "450 mm", "depth": "450 mm"}, beam={"width": "300 mm", "depth": "550 mm"},
        ... )
        >>> len(jostle.Model([frame]).periods())
        3
    """

    _with_units = tuple(FrameUnits.__annotations__)

    def __init__(
        self,
        name: str | None = None,
        *,
        storeys: int | None = None,
        storey_height: Quantities | None = None,
        spans: Quantities | None = None,
        column: Table | Sequence[Table] | None = None,
        beam: Table | Sequence[Table] | None = None,
        elastic_modulus: Quantity | None = None,
        concrete: str | None = None,
        stiffness_factor: float | Table | None = None,
        density: Quantity | None = None,
        beam_mass: Quantities | None = None,
        floor_mass: Quantities | None = None,
        floor_load: Quantities | None = None,
        column_segments: int | None = None,
        beam_segments: int | Iterable[int] | None = None,
        axial: _Flexibility | Table | None = None,
        joint: Table | None = None,
        rigid_ends: float | Table | None = None,
        damping: Table | None = None,
        base: Literal["fixed"] | Table | None = None,
        isolation: Table | None = None,
        foundation: Table | None = None,
        hinges: Table | None = None,
        shear_failure: Table | None = None,
        rotation_limit: Sequence[Table] | None = None,
        brace: Sequence[Table] | None = None,
        infill: Sequence[Table] | None = None,
        wall: Sequence[Table] | None = None,
        coupling_beam: Sequence[Table] | None = None,
        elevation: Quantity | None = None,
        position: Quantity | None = None,
        motion: Table | None = None,
        gravity: bool | None = None,
        p_delta: bool | None = None,
        damper: Sequence[Table] | None = None,
        soil_spring: Sequence[Table] | None = None,
        codes: Table | None = None,
        shear: _Flexibility | Table | None = None,
        poisson_ratio: float | None = None,
        floors: int | None = None,
        **units: Unpack[FrameUnits],
    ) -> None:
        super().__init__(
            {
                "name": name,
                "kind": "frame",
                "storeys": storeys,
                "storey_height": storey_height,
                "spans": spans,
                "column": _sections(column),
                "beam": _sections(beam),
                "elastic_modulus": elastic_modulus,
                "concrete": concrete,
                "stiffness_factor": stiffness_factor,
                "density": density,
                "beam_mass": beam_mass,
                "floor_mass": floor_mass,
                "floor_load": floor_load,
                "column_segments": column_segments,
                "beam_segments": beam_segments,
                "axial": axial,
                "joint": joint,
                "rigid_ends": rigid_ends,
                "damping": damping,
                "base": base,
                "isolation": isolation,
                "foundation": foundation,
                "hinges": hinges,
                "shear_failure": shear_failure,
                "rotation_limit": rotation_limit,
                "brace": brace,
                "infill": infill,
                "wall": wall,
                "coupling_beam": coupling_beam,
                "elevation": elevation,
                "position": position,
                "motion": motion,
                "gravity": gravity,
                "p_delta": p_delta,
                "damper": damper,
                "soil_spring": soil_spring,
                "codes": codes,
                "shear": shear,
                "poisson_ratio": poisson_ratio,
                "floors": floors,
            },
            units,
        )


class Shear(Part):
    """A shear building: floor masses on storey springs.

    Args:
        name: name of the building, used by gaps and links; ``"B1"``, ``"B2"``, … by default.
        mass: floor masses from the ground up, or one value for all.
        stiffness: storey stiffnesses from the ground up, or one value for all; with a plan also ``{"x": …, "y": …, "torsion":
            …}``.
        storeys: number of storeys, 1 to 200; not needed with a list per storey.
        storey_height: one length, or a list from the ground up; 3 m by default.
        damping: ``{"ratio": 0.05, "modes": [1, 3]}`` or ``{"alpha": …, "beta": …}``; 5 % by default; with hinges,
            3 % or less is usual.
        base: springs and dashpots under the building: ``"fixed"`` (default) or ``{"horizontal_stiffness": …}``;
            with a plan also ``rotational_stiffness``, ``torsional_stiffness`` and ``across``.
        isolation: bearings and a mat under the building, such as ``{"kind": "lead-rubber", "mat_mass": "150 t", …}``; with
            ``"bounds": {"lower": 0.85, "upper": 1.3}`` a run also computes both bounds of the bearings.
        foundation: rigid foundation on the ``soil`` of the model, ``{"length": "12 m", "width": "12 m", "mass": "120 t"}``;
            ``"uplift": True, "springs": 11`` lets it lift off, with ``gravity=True``.
            With a plan, ``length`` is along x, and ``"torsional_stiffness"`` replaces that of the soil.
        hinges: cracking and yield of the storeys; without it they are elastic: ``{"rule": "bilinear", "yield": "20 mm",
            "post_yield": 0.05}``; timber and masonry: ``{"rule": "pinched", "pinching": {"deformation": 0.8, "force": 0.2}, …}``.
        rotation_limit: for frames at lines of the plan, hinge rotations at which members reach performance levels:
            ``[{"of": "columns", "limits": {"io": "5 mrad", "ls": "15 mrad", "cp": "20 mrad"}}]``.
        elevation: height of the base above a datum common to all buildings, 0 by default; contacts and links use heights above
            it.
        position: position along the row, for ``apparent_velocity`` and ``coherency`` of the motion.
        motion: ground motion under this building, if it differs: ``{"arrival": "30 ms"}``, ``{"record": …, "scale": …}``.
        gravity: whether the run starts from the displacements under self weight; ``False`` by default.
        p_delta: whether P-Delta from the weight above is included; by default ``True`` with hinges, otherwise ``False``.
        damper: dampers and other links between two floors of this building, such as
            ``[{"floors": [0, 1], "law": "viscous", "damping": "200 kN.(s/m)^0.5", "exponent": 0.5}]``.
        soil_spring: soil beside floors below ground, for buildings without a plan on a fixed base:
            ``[{"floors": [1, 2], "stiffness": "200 MN/m", "strength": "1.5 MN", "gapping": True}]``.
        codes: factors of this building for the separation rules of codes: ``{"behaviour_factor": 3.9}``.
        floors: another name for ``storeys``.
        plan: width along x and depth across, ``["20 m", "12 m"]``, corners counter-clockwise, or a list of ``{"size": …}`` or
            ``{"corners": …}`` from the ground up; the building then translates in both directions and rotates.
        at: position of the origin of the plan on the site; by default the buildings stand in a row.
        mass_centre: centre of mass relative to the origin of the plan; by default the centroid of the plan.
        polar_mass: polar mass moment of inertia; by default that of mass spread evenly over the plan.
        eccentricity: centre of stiffness relative to the centre of mass; 0 by default.
        element: columns and walls at points of the plan, instead of ``stiffness``:
            ``[{"at": ["1 m", "1 m"], "stiffness": {"x": "10 MN/m", "y": "12 MN/m"}}]``; with ``hinges`` they yield:
            ``{"rule": "bilinear", "post_yield": 0.05, "x": {"yield": "8 mm"}, "y": {"yield": "6 mm"}}``.
        frame: plane frames at lines of the plan, alone or in addition to ``stiffness`` or ``element``; the building then has the
            kind ``"frame"``: ``[{"name": "1", "at": ["0 m", "0 m"], "direction": "x", "spans": ["6 m", "6 m"], "column": …,
            "beam": …,
            "concrete": "C30", "lines": ["A1", "B1", "C1"]}]``.
        **units: the same with units in names, as in ``mass_t=[40, 40]``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> tower = jostle.Shear("A", mass_t=[40, 30], stiffness_mn_m=[60, 50], storey_height="3 m")
        >>> len(jostle.Model([tower]).periods())
        2
    """

    _with_units = tuple(ShearUnits.__annotations__)

    def __init__(
        self,
        name: str | None = None,
        *,
        mass: Quantities | None = None,
        stiffness: Quantities | Table | Sequence[Any] | None = None,
        storeys: int | None = None,
        storey_height: Quantities | None = None,
        damping: Table | None = None,
        base: Literal["fixed"] | Table | None = None,
        isolation: Table | None = None,
        foundation: Table | None = None,
        hinges: Table | None = None,
        rotation_limit: Sequence[Table] | None = None,
        elevation: Quantity | None = None,
        position: Quantity | None = None,
        motion: Table | None = None,
        gravity: bool | None = None,
        p_delta: bool | None = None,
        damper: Sequence[Table] | None = None,
        soil_spring: Sequence[Table] | None = None,
        codes: Table | None = None,
        floors: int | None = None,
        plan: Sequence[Any] | None = None,
        at: Sequence[Quantity] | None = None,
        mass_centre: Sequence[Any] | None = None,
        polar_mass: Quantities | None = None,
        eccentricity: Sequence[Any] | None = None,
        element: Sequence[Any] | None = None,
        frame: Sequence[Table] | None = None,
        **units: Unpack[ShearUnits],
    ) -> None:
        super().__init__(
            {
                "name": name,
                "kind": "shear" if frame is None else "frame",
                "storeys": storeys,
                "storey_height": storey_height,
                "mass": mass,
                "stiffness": stiffness,
                "damping": damping,
                "base": base,
                "isolation": isolation,
                "foundation": foundation,
                "hinges": hinges,
                "rotation_limit": rotation_limit,
                "elevation": elevation,
                "position": position,
                "motion": motion,
                "gravity": gravity,
                "p_delta": p_delta,
                "damper": damper,
                "soil_spring": soil_spring,
                "codes": codes,
                "floors": floors,
                "plan": plan,
                "at": at,
                "mass_centre": mass_centre,
                "polar_mass": polar_mass,
                "eccentricity": eccentricity,
                "element": element,
                "frame": frame,
            },
            units,
        )


class SpaceFrame(Part):
    """A building of columns at grid intersections, beams along the grid lines, and rigid floors; it translates in both
    directions and rotates.

    Args:
        name: name of the building, used by gaps and links; ``"B1"``, ``"B2"``, … by default.
        lines_x: positions along x of the grid lines across, from the origin of the plan, in ascending order.
        lines_y: positions across of the grid lines along x, from the origin of the plan, in ascending order.
        column: columns at the grid intersections: ``{"size": ["500 mm", "500 mm"]}``, sizes along x and across, or a list of
            such tables, each
            with ``"x"``, ``"y"`` and ``"storeys"`` for the positions to which it applies; later tables override earlier ones.
            Bars, for fibres
            and for comparison with capacities: ``"steel": "HRB400", "bars": "12 d20", "ties": "d10 @ 100 mm"``.
        beam_x: beams along x: ``{"width": "300 mm", "depth": "600 mm"}``, with bars likewise, or a list.
        beam_y: beams across, likewise.
        mass: floor masses from the ground up, or one value for all, including beams and columns.
        floor_load: weight per floor that the columns carry in addition to that of the masses: one value, or a list from the
            ground up.
        storeys: number of storeys, 1 to 200; not needed with a list per storey.
        storey_height: one length, or a list from the ground up; 3 m by default.
        elastic_modulus: modulus of elasticity.
        concrete: ``"C30"`` (GB 50010), ``"C30/37"`` (EN 1992-1-1) or ``"f'c = 4 ksi"`` (ACI 318), instead of
            ``elastic_modulus``.
        stiffness_factor: factor on every EI, or ``{"column": 0.7, "beam": 0.35}``.
        torsion_factor: factor on every GJ, 1 by default.
        axial: axial deformation of columns: ``"flexible"`` (default) or ``"rigid"``.
        shear: ``"rigid"`` (default), or ``"flexible"`` for members with shear deformation (Timoshenko), or
            ``{"columns": …, "beams": …}``.
        poisson_ratio: for the shear modulus, 0.2 by default.
        density: density of columns and walls, 2500 kg/m³ by default; ``mass`` of the floors includes their mass.
        rigid_ends: fraction of the half depths of columns and beams that is rigid inside joints: 0 by default, 1 up to the
            faces; or
            ``{"beams": "0.25 m", "columns": "0.3 m"}``.
        brace: braces between joints: ``[{"along": "x", "x": 1, "y": [1, 2], "storeys": [1, 3], "direction": "both", "EA": "600 MN"}]``, or
            ``{"from": "0.1.1", "to": "2.3.2", "EA": "2 GN"}`` between two joints, each given by floor and lines,
            where x and y are the lines at which the bays begin; with ``"hinge"`` they yield or buckle.
        infill: masonry panels in the bays, likewise: ``[{"along": "y", "x": 1, "modulus": "4 GPa", "thickness": "200 mm",
            "width": "mainstone"}]``.
        wall: walls, each of which replaces the columns at a grid intersection: ``[{"along": "x", "x": 2, "y": 1, "length": "3
            m", "thickness": "250 mm"}]``. With bars, the foot of a wall can consist of fibres, as in plane frames:
            ``{"steel": "HRB400", "bars": "24 d16", "hinge": {"rule": "fibre", "length": "1 m"}}``.
        rotation_limit: hinge rotations at which members reach performance levels:
            ``[{"of": "columns", "storeys": 1, "limits": {"io": "5 mrad", "cp": "20 mrad"}}]``.
        hinges: plastic hinges at the ends of columns, about both axes, and of beams; without them the frame is elastic:
            ``{"rule": "bilinear", "column": {"x": {"yield": "300 kN.m", "post_yield": 0.02}, "y": {…}}, "beam": {…}}``. With
            ``{"rule": "fibre", "length": "0.4 m", "fibres": [20, 16]}`` the ends of columns with bars are fibres, whose strength follows
            the axial force and the moment about the other axis. With ``{"rule": "surface", "length": "0.4 m", "exponent": 1.5}``
            they yield on the interaction diagrams of both planes, or on ``"surface": {"axial": ["-6 MN", "-2 MN", "1 MN"],
            "moment": ["0 kN.m", "500 kN.m", "0 kN.m"], "across": ["0 kN.m", "400 kN.m", "0 kN.m"]}``.
        joint: yielding connections between beams and columns: ``{"rotational_stiffness": "40 MN.m/rad", "hinge": {"rule":
            "bilinear", "yield":
            "180 kN.m", "post_yield": 0.03}}``, or such a table for each direction of beams, ``{"x": …, "y": …}``.
        shear_failure: shear failure of columns, independently in each direction: ``{"rule": "sezen-moehle", "residual": 0.2}`` or
            ``{"strength": "300 kN", "slope": "5 MN/m"}``; without it their shear strength has no limit.
        angle: angle from x of the site to the lines along x, counter-clockwise, 0 by default.
        plan: width along x and depth across, ``["20 m", "12 m"]``, corners counter-clockwise, or a list of ``{"size": …}`` or
            ``{"corners": …}`` from the ground up; the rectangle of the outer lines by default.
        at: position of the origin of the plan on the site; by default the buildings stand in a row.
        mass_centre: centre of mass relative to the origin of the plan; by default the centroid of the plan.
        polar_mass: polar mass moment of inertia; by default that of mass spread evenly over the plan.
        stiffness: storey stiffnesses in addition to the frame: one value, a list, or ``{"x": …, "y": …, "torsion": …}``.
        eccentricity: centre of ``stiffness`` relative to the centre of mass; 0 by default.
        element: walls at points of the plan, in addition to the frame:
            ``[{"at": ["1 m", "1 m"], "stiffness": {"x": "10 MN/m", "y": "12 MN/m"}}]``.
        damping: ``{"ratio": 0.05, "modes": [1, 3]}`` or ``{"alpha": …, "beta": …}``; 5 % by default; with hinges,
            3 % or less is usual.
        base: springs and dashpots under the building: ``"fixed"`` (default) or ``{"horizontal_stiffness": …,
            "rotational_stiffness": …, "torsional_stiffness": …}``.
        foundation: rigid foundation on the ``soil`` of the model, ``{"length": "12 m", "width": "12 m", "mass": "120 t"}``;
            ``length`` is along x, and ``"torsional_stiffness"`` replaces that of the soil.
        isolation: bearings and a mat under the building, such as ``{"kind": "lead-rubber", "mat_mass": "150 t", …}``; with
            ``"bounds": {"lower": 0.85, "upper": 1.3}`` a run also computes both bounds of the bearings.
        gravity: whether the run starts from the displacements under self weight; ``False`` by default. Fibres need it.
        p_delta: whether P-Delta from the weight above is included; by default ``True`` with hinges, otherwise ``False``.
        elevation: height of the base above a datum common to all buildings, 0 by default; contacts and links use heights above
            it.
        position: position along the row, for ``apparent_velocity`` and ``coherency`` of the motion.
        motion: ground motion under this building, if it differs: ``{"arrival": "30 ms"}``, ``{"record": …, "scale": …}``.
        damper: dampers and other links between two floors of this building.
        soil_spring: soil beside floors below ground; only for buildings without a plan.
        codes: factors of this building for the separation rules of codes: ``{"behaviour_factor": 3.9}``.
        floors: another name for ``storeys``.
        **units: the same with units in names, as in ``lines_x_m=[0, 6, 12]``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> beam = {"width": "300 mm", "depth": "500 mm"}
        >>> frame = jostle.SpaceFrame(
        ...     "A", storeys=1, storey_height_m=3, lines_x_m=[0, 6], lines_y_m=[0, 5], mass_t=60, elastic_modulus_gpa=30,
        ...     column={"size": ["450 mm", "400 mm"]}, beam_x=beam, beam_y=beam,
        ... )
        >>> len(jostle.Model([frame]).periods())
        2
    """

    _with_units = tuple(SpaceFrameUnits.__annotations__)

    def __init__(
        self,
        name: str | None = None,
        *,
        lines_x: Quantities | None = None,
        lines_y: Quantities | None = None,
        column: Table | Sequence[Table] | None = None,
        beam_x: Table | Sequence[Table] | None = None,
        beam_y: Table | Sequence[Table] | None = None,
        mass: Quantities | None = None,
        floor_load: Quantities | None = None,
        storeys: int | None = None,
        storey_height: Quantities | None = None,
        elastic_modulus: Quantity | None = None,
        concrete: str | None = None,
        stiffness_factor: float | Table | None = None,
        torsion_factor: float | None = None,
        axial: _Flexibility | None = None,
        shear: _Flexibility | Table | None = None,
        poisson_ratio: float | None = None,
        density: Quantity | None = None,
        rigid_ends: float | Table | None = None,
        brace: Sequence[Table] | None = None,
        infill: Sequence[Table] | None = None,
        wall: Sequence[Table] | None = None,
        hinges: Table | None = None,
        joint: Table | None = None,
        shear_failure: Table | None = None,
        rotation_limit: Sequence[Table] | None = None,
        angle: Quantity | None = None,
        plan: Sequence[Any] | None = None,
        at: Sequence[Quantity] | None = None,
        mass_centre: Sequence[Any] | None = None,
        polar_mass: Quantities | None = None,
        stiffness: Quantities | Table | Sequence[Any] | None = None,
        eccentricity: Sequence[Any] | None = None,
        element: Sequence[Any] | None = None,
        damping: Table | None = None,
        base: Literal["fixed"] | Table | None = None,
        foundation: Table | None = None,
        isolation: Table | None = None,
        gravity: bool | None = None,
        p_delta: bool | None = None,
        elevation: Quantity | None = None,
        position: Quantity | None = None,
        motion: Table | None = None,
        damper: Sequence[Table] | None = None,
        soil_spring: Sequence[Table] | None = None,
        codes: Table | None = None,
        floors: int | None = None,
        **units: Unpack[SpaceFrameUnits],
    ) -> None:
        super().__init__(
            {
                "name": name,
                "kind": "space-frame",
                "lines_x": lines_x,
                "lines_y": lines_y,
                "column": _sections(column),
                "beam_x": _sections(beam_x),
                "beam_y": _sections(beam_y),
                "mass": mass,
                "floor_load": floor_load,
                "storeys": storeys,
                "storey_height": storey_height,
                "elastic_modulus": elastic_modulus,
                "concrete": concrete,
                "stiffness_factor": stiffness_factor,
                "torsion_factor": torsion_factor,
                "axial": axial,
                "shear": shear,
                "poisson_ratio": poisson_ratio,
                "density": density,
                "rigid_ends": rigid_ends,
                "brace": brace,
                "infill": infill,
                "wall": wall,
                "hinges": hinges,
                "joint": joint,
                "shear_failure": shear_failure,
                "rotation_limit": rotation_limit,
                "angle": angle,
                "plan": plan,
                "at": at,
                "mass_centre": mass_centre,
                "polar_mass": polar_mass,
                "stiffness": stiffness,
                "eccentricity": eccentricity,
                "element": element,
                "damping": damping,
                "base": base,
                "foundation": foundation,
                "isolation": isolation,
                "gravity": gravity,
                "p_delta": p_delta,
                "elevation": elevation,
                "position": position,
                "motion": motion,
                "damper": damper,
                "soil_spring": soil_spring,
                "codes": codes,
                "floors": floors,
            },
            units,
        )


class Given(Part):
    """A building by the matrices of another program, or by its modes. It is elastic.

    By matrices, give ``matrices`` and ``ports``; by modes, ``mass``, ``periods`` and ``shapes``. With a ``plan`` it translates
    in both directions and rotates.

    Args:
        name: name of the building, used by gaps and links; ``"B1"``, ``"B2"``, … by default.
        matrices: a NumPy archive with the arrays ``K`` and ``M`` and optionally ``C``, ``r`` and ``h``, or a mapping with
            ``"stiffness"`` and ``"mass"`` and optionally ``"damping"``, ``"influence"`` and ``"heights"``: arrays, lists
            or Matrix Market files. Each has n rows; the mass matrix is diagonal, and may be a list of n masses.
            ``"influence"`` is 1 for displacements that move with the ground and 0 for rotations and vertical ones.
        ports: floors by name, ``{"1": {"dof": 1, "height": "3 m"}}``; ``dof`` counts rows from 1. With a plan
            ``{"1": {"dofs": [1, 2, 3], "at": ["4 m", "3 m"], "height": "3 m"}}``: rows of x, y and rotation of the point ``at``,
            by default the middle of the plan; other rows carry no mass and are condensed.
        plan: width along x and depth across, ``["20 m", "12 m"]``, corners counter-clockwise, or a list of ``{"size": …}`` or
            ``{"corners": …}`` from the ground up; the mass matrix may then couple x, y and rotation of a floor.
        at: position of the origin of the plan on the site; by default the buildings stand in a row.
        angle: angle from x of the site to x of the plan and of the matrices, counter-clockwise, 0 by default.
        isolation: with a plan: bearings and a mat under the building, whose matrices are then those on a fixed base.
        units: force and length of the matrices, ``"N, m"`` by default; ``"kN, m"``, ``"N, mm"``, ``"kN, mm"``, ``"kip, ft"``,
            ``"kip, in"``.
        mass: floor masses from the ground up.
        periods: periods of the modes.
        shapes: displacements of all floors in every mode, from the ground up, at any scale; array shape ``(modes, floors)``.
        remainder_period: period of the residual response that the given modes leave out; by default estimated from a uniform
            building.
        contact_flexibility: displacement of the floor in contact per unit force on it, instead: ``"2.1e-8 m/N"``.
        contact_floor: the floor to which this refers, from 1; by default the highest that a neighbour reaches.
        storeys: number of storeys of a building given by modes; not needed with a list of masses.
        storey_height: one length, or a list from the ground up, of a building given by modes; 3 m by default.
        damping: ``{"ratio": 0.05, "modes": [1, 3]}`` or ``{"alpha": …, "beta": …}``; 5 % by default; not together with a
            damping matrix.
        damper: dampers and other links between two floors of this building, such as
            ``[{"floors": [0, 1], "law": "viscous", "damping": "200 kN.(s/m)^0.5", "exponent": 0.5}]``.
        rotation_limit: not applicable, because a building given by matrices has no hinges.
        soil_spring: soil beside floors below ground; only for buildings without a plan.
        elevation: height of the base above a datum common to all buildings, 0 by default; contacts and links use heights above
            it.
        position: position along the row, for ``apparent_velocity`` and ``coherency`` of the motion.
        motion: ground motion under this building, if it differs: ``{"arrival": "30 ms"}``, ``{"record": …, "scale": …}``.
        codes: factors of this building for the separation rules of codes: ``{"behaviour_factor": 3.9}``.
        **units_in_names: the same with units in names, as in ``storey_height_m=3.2``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> block = jostle.Given("A", mass=["40 t", "30 t"], periods=[0.3, 0.1], shapes=[[0.6, 1.0], [1.0, -0.8]])
        >>> jostle.Model([block]).periods().round(6).tolist()
        [0.3, 0.1]
    """

    _with_units = tuple(GivenUnits.__annotations__)

    def __init__(
        self,
        name: str | None = None,
        *,
        matrices: str | os.PathLike[str] | Mapping[str, object] | None = None,
        ports: Mapping[str, Mapping[str, object]] | None = None,
        units: _MatrixUnits | None = None,
        plan: Sequence[Any] | None = None,
        at: Sequence[Quantity] | None = None,
        angle: Quantity | None = None,
        isolation: Table | None = None,
        mass: Quantities | None = None,
        periods: Quantities | None = None,
        shapes: npt.ArrayLike | None = None,
        remainder_period: Quantity | None = None,
        contact_flexibility: Quantity | None = None,
        contact_floor: int | None = None,
        storeys: int | None = None,
        storey_height: Quantities | None = None,
        damping: Table | None = None,
        damper: Sequence[Table] | None = None,
        rotation_limit: Sequence[Table] | None = None,
        soil_spring: Sequence[Table] | None = None,
        elevation: Quantity | None = None,
        position: Quantity | None = None,
        motion: Table | None = None,
        codes: Table | None = None,
        **units_in_names: Unpack[GivenUnits],
    ) -> None:
        super().__init__(
            {
                "name": name,
                "kind": "given",
                "matrices": matrices,
                "ports": ports,
                "units": units,
                "plan": plan,
                "at": at,
                "angle": angle,
                "isolation": isolation,
                "mass": mass,
                "periods": periods,
                "shapes": shapes,
                "remainder_period": remainder_period,
                "contact_flexibility": contact_flexibility,
                "contact_floor": contact_floor,
                "storeys": storeys,
                "storey_height": storey_height,
                "damping": damping,
                "damper": damper,
                "rotation_limit": rotation_limit,
                "soil_spring": soil_spring,
                "elevation": elevation,
                "position": position,
                "motion": motion,
                "codes": codes,
            },
            units_in_names,
        )


class Gap(Part):
    """The gap between two neighbours, or beside a rigid wall, and its contact law.

    Args:
        width: width at rest, a length ≥ 0, or a list for the contacts in the order of ``floors``, from the lowest up
            if these are not listed.
        between: names of the left and the right neighbour, ``"wall"`` for a rigid wall at an end of the row; in order
            by default. Between buildings with a plan that have ``at``, ``"all"`` in the last gap means all neighbours within
            reach
            that no other gap names.
        floors: ``"common"`` (default), ``"all"`` for floors against floors or columns, pairs of floors or heights
            ``[[5, 5], [4, "12.8 m"]]``, or heights.
        level_tolerance: floors whose heights differ by no more than this can touch, 1 mm by default.
        law: contact law, ``"hertz-damp"`` by default.
        stiffness: contact stiffness: N/m^1.5 for Hertz laws, N/m for linear ones.
        restitution: coefficient of restitution, 0.65 by default.
        restitution_is: ``"input"`` (default): it is used in the published formula. ``"realised"``: damping is
            calibrated so that free masses rebound with it.
        damping: of ``"kelvin"``, ``"kelvin-no-tension"`` and ``"modified-kelvin"`` with
            ``variant="mahmoud-jankowski"``: dashpot of every contact instead of ``restitution``,
            independent of the masses; with a plan that of a whole face.
        formula: of the law ``"formula"``: the contact force in N, as ``"k * d^1.5 * (1 + 0.6 * v / v0)"``, in terms of
            indentation ``d``, its rate ``v``, impact speed ``v0``, ``stiffness`` ``k``, ``restitution`` ``e`` and effective
            mass ``m``, all in SI.
        variant: of the law ``"modified-kelvin"``: ``"ye"`` (default), damping proportional to the indentation, or
            ``"mahmoud-jankowski"``, damping during approach only.
        yield_share: of the law ``"bilinear"``: yield indentation ÷ greatest design indentation, 0.1 by default.
        design_speed: of the law ``"bilinear"``: impact speed for which its stiffnesses are computed; by default that of
            each impact.
        second_stiffness: of the law ``"bilinear"``: stiffness beyond yield, in N/m, instead of ``restitution``;
            ``stiffness`` is then the first one, in N/m.
        yield_: of the law ``"bilinear"`` with ``second_stiffness``: indentation at which it yields.
        crush: of the laws ``"linear"`` and ``"hertz"``: permanent crushing of the face, ``{"force": "600 kN", "hardening":
            0.05}``;
            the gap is wider afterwards.
        thickness: of the law ``"rubber"``: thickness of the bumper.
        exponent: of the law ``"rubber"``: exponent of the compression, 2.65 by default.
        stiffness_per_length: with a plan, instead of ``stiffness``: that of a face per metre of its length.
        points: with a plan: contact points of a face, 2 to 9, 5 by default.
        reach: with a plan: greatest distance between edges that can touch, 0.5 m by default.
        friction: with a plan: coefficient of friction along faces, at least 0 and below 1; 0 by default.
        tangential_stiffness: with a plan and friction: tangential stiffness of a whole face while it sticks;
            by default 0.89 times its normal stiffness.
        minimum_separation: impacts of one contact with less time between them count as one; 0 s by default.
        **units: the same with units in names, as in ``width_mm=20``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> jostle.Gap(width_mm=20, law="hertz-damp").to_dict()["width"]
        '20 mm'
    """

    _with_units = tuple(GapUnits.__annotations__)

    def __init__(
        self,
        width: Quantities | None = None,
        *,
        between: Sequence[str] | Literal["all"] | None = None,
        floors: Floors | None = None,
        level_tolerance: Quantity | None = None,
        law: _Law | None = None,
        stiffness: Quantity | None = None,
        restitution: float | None = None,
        restitution_is: _RestitutionIs | None = None,
        damping: Quantity | None = None,
        formula: str | None = None,
        variant: _Variant | None = None,
        yield_share: float | None = None,
        design_speed: Quantity | None = None,
        second_stiffness: Quantity | None = None,
        yield_: Quantity | None = None,
        crush: Table | None = None,
        thickness: Quantity | None = None,
        exponent: float | None = None,
        stiffness_per_length: Quantity | None = None,
        points: int | None = None,
        reach: Quantity | None = None,
        friction: float | None = None,
        tangential_stiffness: Quantity | None = None,
        minimum_separation: Quantity | None = None,
        **units: Unpack[GapUnits],
    ) -> None:
        super().__init__(
            {
                "between": between,
                "width": width,
                "floors": floors,
                "level_tolerance": level_tolerance,
                "law": law,
                "stiffness": stiffness,
                "restitution": restitution,
                "restitution_is": restitution_is,
                "damping": damping,
                "formula": formula,
                "variant": variant,
                "yield_share": yield_share,
                "design_speed": design_speed,
                "second_stiffness": second_stiffness,
                "yield": yield_,
                "crush": crush,
                "thickness": thickness,
                "exponent": exponent,
                "stiffness_per_length": stiffness_per_length,
                "points": points,
                "reach": reach,
                "friction": friction,
                "tangential_stiffness": tangential_stiffness,
                "minimum_separation": minimum_separation,
            },
            units,
        )


class Link(Part):
    """Springs, dampers and sliders between floors of two neighbours, of a building and a wall, or of one building.

    Args:
        between: names of the left and the right neighbour, ``"wall"`` for a rigid wall at an end of the row; the same
            building twice for links between its floors.
        floors: points that are joined, as for a gap; every pair of floors at equal height by default.
        level_tolerance: floors whose heights differ by no more than this can be joined, 1 mm by default.
        law: ``"linear"`` by default, ``"viscous"``, ``"maxwell"``, ``"friction"``, ``"yielding"``, ``"cable"`` or ``"stopper"``.
        stiffness: stiffness of each link, ≥ 0; in series with the dashpot for viscous and maxwell.
        damping: damping coefficient of each link, ≥ 0; for viscous with an exponent, as in ``"150 kN.(s/m)^0.35"``.
        exponent: viscous: exponent of the rate, 0.1 to 2; 1 by default.
        slip_force: friction: force at which it slips, > 0.
        stick_stiffness: friction: stiffness while it sticks, > 0.
        hinge: yielding: rule and corners, as ``{"rule": "bilinear", "yield": "120 kN", "post_yield": 0.05}``.
        slack: cable: elongation at which it becomes taut, ≥ 0; 0 by default.
        gap: stopper: shortening at which it closes, ≥ 0; 0 by default.
        at: between buildings with a plan: coordinates of both ends on the site, ``[["10 m", "4 m"], ["10.1 m", "4 m"]]``; the
            force acts between them.
        **units: the same with units in names, as in ``damping_kn_s_m=500``.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> jostle.Link(["A", "B"], damping_kn_s_m=400).to_dict()["damping"]
        '400 kN.s/m'
    """

    _with_units = tuple(LinkUnits.__annotations__)

    def __init__(
        self,
        between: Sequence[str],
        *,
        floors: Floors | None = None,
        level_tolerance: Quantity | None = None,
        law: str | None = None,
        stiffness: Quantity | None = None,
        damping: Quantity | None = None,
        exponent: float | None = None,
        slip_force: Quantity | None = None,
        stick_stiffness: Quantity | None = None,
        hinge: Table | None = None,
        slack: Quantity | None = None,
        gap: Quantity | None = None,
        at: Sequence[Sequence[Quantity]] | None = None,
        **units: Unpack[LinkUnits],
    ) -> None:
        super().__init__(
            {
                "between": between,
                "floors": floors,
                "level_tolerance": level_tolerance,
                "law": law,
                "stiffness": stiffness,
                "damping": damping,
                "exponent": exponent,
                "slip_force": slip_force,
                "stick_stiffness": stick_stiffness,
                "hinge": hinge,
                "slack": slack,
                "gap": gap,
                "at": at,
            },
            units,
        )


class Wall(Part):
    """A wall beside a building, to which gaps and links can refer: rigid, or a mass on a spring and a dashpot.

    Args:
        name: name used by gaps and links.
        stiffness: stiffness of the wall at the point of contact, > 0; without it the wall is rigid.
        damping: dashpot parallel to the spring, ≥ 0; 0 by default.
        mass: mass of the wall that moves in an impact, > 0; required with a stiffness.
        position: position along the row, for ``apparent_velocity`` and ``coherency`` of the motion; without it the wall stands
            on the
            ground of the building that it faces.
        from_: with buildings with a plan: one end of its face on the site, ``["21 m", "0 m"]``; ``from`` in a model file. The
            wall
            is on the right-hand side of the face, looking from ``from_`` to ``to``.
        to: the other end of its face.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> jostle.Wall("street", mass="20 t", stiffness="200 MN/m").to_dict()["stiffness"]
        '200 MN/m'
    """

    def __init__(
        self,
        name: str,
        *,
        stiffness: Quantity | None = None,
        damping: Quantity | None = None,
        mass: Quantity | None = None,
        position: Quantity | None = None,
        from_: Sequence[Quantity] | None = None,
        to: Sequence[Quantity] | None = None,
    ) -> None:
        super().__init__(
            {
                "name": name,
                "stiffness": stiffness,
                "damping": damping,
                "mass": mass,
                "position": position,
                "from": from_,
                "to": to,
            },
            {},
        )


class Soil(Part):
    """Soil under buildings with a foundation.

    Args:
        shear_wave_velocity: shear wave velocity at the strains of the motion, > 0.
        density: density, > 0.
        poisson_ratio: Poisson's ratio, at least 0 and below 0.5.
        damping: hysteretic damping ratio at the strains of the motion; 0 by default.
        coupling: ``"none"`` (default), ``"static"``, or ``{"stiffness": …, "damping": …}``, matrices over u and θ of every
            foundation from left to right, which replace all other keys.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.

    Examples:
        >>> import jostle
        >>> jostle.Soil(shear_wave_velocity="200 m/s", density="1800 kg/m3").to_dict()["density"]
        '1800 kg/m3'
    """

    def __init__(
        self,
        *,
        shear_wave_velocity: Quantity | None = None,
        density: Quantity | None = None,
        poisson_ratio: float | None = None,
        damping: float | None = None,
        coupling: Literal["none", "static"] | Table | None = None,
    ) -> None:
        super().__init__(
            {
                "shear_wave_velocity": shear_wave_velocity,
                "density": density,
                "poisson_ratio": poisson_ratio,
                "damping": damping,
                "coupling": coupling,
            },
            {},
        )


#: A building as a part, or as the table of the model file.
Building = Union[Frame, Shear, SpaceFrame, Given, Table]

_SECTION = ("width", "depth", "mass")


def _sections(sections: Table | Sequence[Table] | None) -> object:
    """Sections, with units in keys turned into texts."""
    if isinstance(sections, Mapping):
        section: dict[str, object] = {}
        for key, value in sections.items():
            parts = split(key, _SECTION) if isinstance(key, str) else None
            section[parts[0] if parts else key] = with_unit(value, parts[1]) if parts else value
        return section
    if isinstance(sections, (list, tuple)):
        return [_sections(section) for section in sections]
    return sections
