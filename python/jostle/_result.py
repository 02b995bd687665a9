"""Results of a run."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _jostle
from ._animation import Animation
from ._model import Model
from ._motion import Motion
from ._table import Table

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    from matplotlib.figure import Figure


#: Histories that only floors with a plan have.
_IN_PLAN = (
    "displacement_across",
    "velocity_across",
    "total_acceleration_across",
    "rotation",
    "rotation_rate",
    "rotation_acceleration",
)


@dataclass(frozen=True, eq=False)
class Floor:
    """Histories of one floor: arrays of shape ``(n,)`` at the instants of ``result.time``.

    Attributes:
        building: name of the building.
        floor: floor, from 1.
        displacement: relative to the ground, positive to the right [m].
        velocity: relative to the ground [m/s].
        total_acceleration: ground included [m/s²].
        displacement_across: displacement across the row [m]; this and the following attributes are ``None`` without a plan.
        velocity_across: velocity across the row, relative to the ground [m/s].
        total_acceleration_across: across, ground included [m/s²].
        rotation: counter-clockwise seen from above [rad].
        rotation_rate: rotation rate [rad/s].
        rotation_acceleration: rotational acceleration [rad/s²].

    Examples:
        >>> import jostle
        >>> result = jostle.run("paper")
        >>> result.floor("J1", -1).displacement.shape == result.time.shape
        True
    """

    building: str
    floor: int
    displacement: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    total_acceleration: npt.NDArray[np.float64]
    displacement_across: npt.NDArray[np.float64] | None = None
    velocity_across: npt.NDArray[np.float64] | None = None
    total_acceleration_across: npt.NDArray[np.float64] | None = None
    rotation: npt.NDArray[np.float64] | None = None
    rotation_rate: npt.NDArray[np.float64] | None = None
    rotation_acceleration: npt.NDArray[np.float64] | None = None


@dataclass(frozen=True, eq=False)
class Corner:
    """Histories of a corner of a floor with a plan, at the instants of ``result.time``.

    Arrays have the shape ``(n, 2)``: along x and across.

    Attributes:
        building: name of the building.
        floor: floor, from 1.
        corner: number of the corner, from 1, in the order of ``plan``.
        at: position of the corner on the site at rest [m].
        displacement: relative to the ground [m].
        velocity: relative to the ground [m/s].
        total_acceleration: ground included [m/s²], for small rotations.

    Examples:
        >>> import jostle
        >>> def tower(name, x):
        ...     plan = [[x, 0], [x + 12, 0], [x + 12, 8], [x, 8]]
        ...     stiffness = {"x": "60 MN/m", "y": "50 MN/m", "torsion": "4 GN.m"}
        ...     return jostle.Shear(name, mass=["90 t"], stiffness=[stiffness], storey_height="3 m", plan=plan)
        >>> model = jostle.Model([tower("A", 0.0), tower("B", 12.02)], jostle.Gap(), motion=jostle.Motion.el_centro().lasting("5 s"))
        >>> jostle.run(model).building("A").corner(3).at
        (12.0, 8.0)
    """

    building: str
    floor: int
    corner: int
    at: tuple[float, float]
    displacement: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    total_acceleration: npt.NDArray[np.float64]


class BuildingResult:
    """Histories of one building: ``result.building("A").corner(3)``.

    Examples:
        >>> import jostle
        >>> result = jostle.run("paper")
        >>> result.building("J1").floor(-1).floor
        5
    """

    _result: Result
    _at: int

    @classmethod
    def _of(cls, result: Result, at: int) -> BuildingResult:
        building = cls.__new__(cls)
        building._result, building._at = result, at
        return building

    @property
    def name(self) -> str:
        """Name."""
        return cast(str, self.summary["name"])

    @property
    def summary(self) -> dict[str, Any]:
        """The entry of this building in ``result.summary``."""
        return cast("dict[str, Any]", self._result.summary["buildings"][self._at])

    def floor(self, floor: int) -> Floor:
        """Histories of a floor, from 1; -1 is the roof."""
        return self._result.floor(self._at, floor)

    def corner(self, corner: int, floor: int = -1) -> Corner:
        """Histories of a corner.

        Args:
            corner: its number, from 1, in the order of ``plan``.
            floor: floor, from 1; -1 is the roof.

        Raises:
            ValueError: the building has no plan, or no such corner or floor.
        """
        import numpy as np

        own = self.floor(floor)
        plans = self._result.model.description["buildings"][self._at].get("plans")
        if not plans:
            raise ValueError(f"{own.building!r} has no plan, so its floors have no corners")
        plan = plans[own.floor - 1]
        corners = plan["corners_m"]
        number = index(corner)
        if not 1 <= number <= len(corners):
            raise ValueError(f"floor {own.floor} of {own.building!r} has corners 1 to {len(corners)}, found {corner}")
        at = corners[number - 1]
        arm = (at[0] - plan["centre_m"][0], at[1] - plan["centre_m"][1])

        def moved(
            x: npt.NDArray[np.float64], y: npt.NDArray[np.float64] | None, turn: npt.NDArray[np.float64] | None
        ) -> npt.NDArray[np.float64]:
            # u = (u_x − θ r_y, u_y + θ r_x)
            assert y is not None and turn is not None
            return np.stack([x - turn * arm[1], y + turn * arm[0]], axis=1)

        return Corner(
            building=own.building,
            floor=own.floor,
            corner=number,
            at=(at[0], at[1]),
            displacement=moved(own.displacement, own.displacement_across, own.rotation),
            velocity=moved(own.velocity, own.velocity_across, own.rotation_rate),
            total_acceleration=moved(
                own.total_acceleration, own.total_acceleration_across, own.rotation_acceleration
            ),
        )

    def __repr__(self) -> str:
        return f"<BuildingResult {self.name!r}>"


@dataclass(frozen=True, eq=False)
class Contact:
    """One location where two neighbours can touch.

    Attributes:
        between: names of the left and the right building, or ``"wall"``.
        floors: floors on the left and on the right, from 1; ``None`` for a point between floors, and for a wall.
        height: height above the base, or above the datum of elevations [m].
        force: contact force at the instants of ``result.time``, positive in compression [N], shape ``(n,)``.
        peak_force: greatest force [N].
        impact_count: number of impacts.

    Examples:
        >>> import jostle
        >>> result = jostle.run("paper", gap="10 mm")
        >>> max(contact.impact_count for contact in result.contacts) > 0
        True
    """

    between: tuple[str, str]
    floors: tuple[int | None, int | None]
    height: float
    force: npt.NDArray[np.float64]
    peak_force: float
    impact_count: int


@dataclass(frozen=True, eq=False)
class LinkedFloors:
    """One spring or damper between two neighbours, or inside a building.

    Attributes:
        between: names of the left and the right building, or ``"wall"``.
        floors: floors on the left and on the right, from 1; ``None`` for a point between floors, and for a wall.
        height: height above the base, or above the datum of elevations [m].
        force: force at the instants of ``result.time``, positive in compression [N], shape ``(n,)``.
        stroke: shortening since rest at these instants [m]; ``None`` unless the model has ``output={"links": True}``.
        speed: rate of shortening [m/s]; ``None`` under the same condition.
        peak_force: force of greatest magnitude, with its sign [N].
        peak_stroke: greatest change of length, either sign [m].
        dissipated: energy dissipated in the damper [J].

    Examples:
        >>> import jostle
        >>> tower = jostle.Shear("A", mass="40 t", stiffness="60 MN/m", storeys=2, storey_height="3 m")
        >>> other = jostle.Shear("B", mass="40 t", stiffness="90 MN/m", storeys=2, storey_height="3 m")
        >>> link = jostle.Link(["A", "B"], damping="400 kN.s/m")
        >>> pair = jostle.Model([tower, other], jostle.Gap("20 mm"), links=link, motion=jostle.Motion.el_centro())
        >>> jostle.run(pair).links[0].dissipated > 0
        True
    """

    between: tuple[str, str]
    floors: tuple[int | None, int | None]
    height: float
    force: npt.NDArray[np.float64]
    stroke: npt.NDArray[np.float64] | None
    speed: npt.NDArray[np.float64] | None
    peak_force: float
    peak_stroke: float
    dissipated: float


class Result:
    """Summary, histories and impacts of a run.

    Histories are read-only NumPy views of one table.

    Examples:
        >>> import jostle
        >>> result = jostle.run("paper", gap="10 mm")
        >>> len(result.impacts) == result.summary["gaps"][0]["impact_count"]
        True
    """

    _core: _jostle.Run
    _model: Model
    _interval: float | None
    _twin: _jostle.Run | None

    @classmethod
    def _of(
        cls,
        model: Model,
        core: _jostle.Run,
        interval: float | None,
        twin: _jostle.Run | None = None,
    ) -> Result:
        result = cls.__new__(cls)
        result._core, result._model = core, model
        result._interval, result._twin = interval, twin
        return result

    @property
    def model(self) -> Model:
        """The model that was run."""
        return self._model

    @property
    def motion(self) -> Motion:
        """The ground motion that was used."""
        return cast(Motion, self._model.motion)

    @property
    def completed(self) -> bool:
        """Whether the end of the motion was reached."""
        return self._core.completed

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Peaks, impacts, energies and work: the tree of ``summary.json``; names contain units."""
        return cast("dict[str, Any]", json.loads(self._core.summary_json(self._twin)))

    @property
    def checks(self) -> list[dict[str, Any]]:
        """Checks that the model or the results did not pass, worst first; empty if all passed.

        Each has ``id``, ``name``, ``grade`` (``"remark"``, ``"note"`` or ``"warning"``), ``value`` and ``limit`` in ``unit``,
        ``where``, ``text`` and ``remedy``. docs/checks.md lists all checks.
        """
        return cast("list[dict[str, Any]]", self.summary["checks"])

    @cached_property
    def _rows(self) -> dict[tuple[str, str, int, int], int]:
        return {row: at for at, row in enumerate(self._core.rows)}

    def _history(self, owner: str, name: str, place: int = 0, floor: int = 0) -> npt.NDArray[np.float64]:
        if not self._rows:
            raise ValueError("no histories were recorded; run with a record_interval")
        return cast("npt.NDArray[np.float64]", self._core.histories[self._rows[owner, name, place, floor]])

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Recorded instants [s], shape ``(n,)``; dense during contact."""
        return self._history("run", "time")

    @property
    def ground_acceleration(self) -> npt.NDArray[np.float64]:
        """Ground acceleration at ``time`` [m/s²], shape ``(n,)``."""
        return self._history("run", "ground_acceleration")

    def floor(self, building: str | int, floor: int) -> Floor:
        """Histories of a floor.

        Args:
            building: name of the building, or its position from the left, from 0.
            floor: floor, from 1; -1 is the roof.
        """
        buildings = self.summary["buildings"]
        at = position(building, [building["name"] for building in buildings])
        count = len(buildings[at]["floors"])
        number = index(floor)
        number += count + 1 if number < 0 else 0
        name = buildings[at]["name"]
        if not 1 <= number <= count:
            raise ValueError(f"{name!r} has floors 1 to {count}, found {floor}")
        return Floor(
            building=name,
            floor=number,
            displacement=self._history("floor", "displacement", at, number),
            velocity=self._history("floor", "velocity", at, number),
            total_acceleration=self._history("floor", "total_acceleration", at, number),
            **{
                key: self._history("floor", key, at, number)
                for key in _IN_PLAN
                if ("floor", key, at, number) in self._rows
            },
        )

    def building(self, building: str | int) -> BuildingResult:
        """Histories of a building, and of the corners of its floors.

        Args:
            building: name, or position from the left, from 0.
        """
        names = [building["name"] for building in self.summary["buildings"]]
        return BuildingResult._of(self, position(building, names))

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """All contacts, gap by gap in the order of the model, each from the lowest up, with their force histories."""
        found: list[Contact] = []
        for gap in self.summary["gaps"]:
            for contact in gap["contacts"]:
                found.append(
                    Contact(
                        between=tuple(gap["between"]),
                        floors=tuple(contact["floors"]),
                        height=contact["height_m"],
                        force=self._history("contact", "force", len(found)),
                        peak_force=contact["peak_force_n"],
                        impact_count=contact["impact_count"],
                    )
                )
        return tuple(found)

    @property
    def links(self) -> tuple[LinkedFloors, ...]:
        """All springs and dampers, link by link, each from the lowest up, with their forces; those of a building come last."""
        found: list[LinkedFloors] = []
        for link in self.summary["links"]:
            for floor in link["floors"]:
                at = len(found)
                moves = ("link", "stroke", at, 0) in self._rows
                found.append(
                    LinkedFloors(
                        between=tuple(link["between"]),
                        floors=tuple(floor["floors"]),
                        height=floor["height_m"],
                        force=self._history("link", "force", at),
                        stroke=self._history("link", "stroke", at) if moves else None,
                        speed=self._history("link", "speed", at) if moves else None,
                        peak_force=floor["peak_force_n"],
                        peak_stroke=floor["peak_stroke_m"],
                        dissipated=floor["dissipated_j"],
                    )
                )
        return tuple(found)

    @property
    def energies(self) -> dict[str, npt.NDArray[np.float64]]:
        """Histories of the energies [J]: ``input`` = ``kinetic`` + ``strain`` + ``damped`` + ``hysteretic`` + ``contact``."""
        self._history("run", "time")  # raises if there are no histories
        names = [name for owner, name, *_ in self._rows if owner == "energy"]
        return {name: self._history("energy", name) for name in names}

    @cached_property
    def history(self) -> Table:
        """All histories, one row per recorded instant, columns as in ``history.parquet``."""
        return Table._of(self._core.history_table())

    @cached_property
    def impacts(self) -> Table:
        """One row per impact in the order of time, columns as in ``impacts.parquet``."""
        return Table._of(self._core.impact_table())

    @cached_property
    def buildings(self) -> Table:
        """One row per building, columns as in ``buildings.parquet``.

        Peaks with contact, without (``base_shear_peak_without_contact_n``) and their ratio (``base_shear_peak_amplification``).
        The latter two come from the run without contact, which is computed on first access.
        """
        return Table._of(self._core.building_table(self._compared()))

    @cached_property
    def floors(self) -> Table:
        """One row per floor, building by building from the ground up, columns as in ``floors.parquet``.

        Peaks with contact, without (``storey_drift_peak_without_contact``) and their ratio
        (``storey_drift_peak_amplification``). The latter two come from the run without contact, which is computed on first
        access.
        """
        return Table._of(self._core.floor_table(self._compared()))

    def _compared(self) -> _jostle.Run | None:
        """The run without contact, computed if it does not exist yet; ``None`` if there is nothing to compare."""
        without = self.without_contact
        return None if without is None else without._core

    def members(self, building: str | None = None) -> Table:
        """Greatest forces of columns and beams, for a model with ``output={"members": True}``.

        One row per end, and one on either side of every point where a neighbour can strike a column: ``member``
        (such as ``"J1.column.2.3"``: line 2, storey 3), ``end``, ``struck_height_m``, ``axial_max_n``, ``axial_min_n``,
        ``shear_peak_n``, ``moment_peak_n_m``. Axial forces are positive in tension.

        Args:
            building: name of a building; ``None`` for all.

        Raises:
            KeyError: no building has this name.
            ValueError: the model does not request member forces, or no building is a frame.
        """
        index = self._index_of(building)
        if not any("members" in own for own in self.summary["buildings"]):
            raise ValueError('no forces of columns and beams were asked for; add output={"members": True} to the model')
        return Table._of(self._core.member_table(index))

    def capacity(self, building: str | None = None) -> Table:
        """Demand over capacity of reinforced columns, beams and joints, for a model with ``output={"capacity": True}``.

        One row per member and rule, the governing rule first, then one per joint (``J1.joint.LINE.FLOOR``) and rule that has
        a clause for joints: ``member``, ``rule``, then for shear and bending (none of joints) the
        greatest ratio (``shear_ratio``, ``bending_ratio``, under the axial force of the same instant), its time
        (``…_at_s``), section (``…_end``), the capacity at this time (``shear_capacity_n``, ``bending_capacity_n_m``), the first
        exceedance (``…_exceeded_s``) and the start of the impact in progress (``…_impact_s``); ``axial_failure_drift`` and
        ``axial_failure_ratio`` of columns. Absent values are NaN.

        Args:
            building: name of a building; ``None`` for all.

        Raises:
            KeyError: no building has this name.
            ValueError: no capacity is known: members have no bars and ties, or member forces are not requested.
        """
        index = self._index_of(building)
        if not any("capacity" in own for own in self.summary["buildings"]):
            raise ValueError(
                'no capacity is known; give columns and beams bars and ties, and add output={"capacity": True} to the model'
            )
        return Table._of(self._core.capacity_table(index))

    def _index_of(self, building: str | None) -> int | None:
        if building is None:
            return None
        names = [own["name"] for own in self.summary["buildings"]]
        if building not in names:
            raise KeyError(f"no building is called {building!r}; there are {', '.join(map(repr, names))}")
        return names.index(building)

    @cached_property
    def member_history(self) -> Table | None:
        """Forces over time of the members named in ``output={"members": [...]}``, columns as in ``members.parquet``."""
        table = self._core.member_history_table()
        return None if table is None else Table._of(table)

    @cached_property
    def floor_spectra(self) -> Table | None:
        """Response spectra of floors, for a model with ``output={"floor_spectra": True}``, else ``None``.

        One row per floor, run (``contact`` is ``"with"`` or, after ``run(without_contact=True)``, ``"without"``), damping
        ratio and period; columns as in ``floor_spectra.parquet``. Peak accelerations with and without the filter are in
        ``summary["floor_spectra"]``.
        """
        table = self._core.floor_spectra_table(self._twin)
        return None if table is None else Table._of(table)

    @cached_property
    def without_contact(self) -> Result | None:
        """The result of the same buildings without contact, computed on first access. ``None`` if the model has no gaps."""
        if not self.summary["gaps"] or not self.completed:
            return None
        if self._twin is None:
            twin = _jostle.run(self._model._core, False, self._interval, True)
            if twin.interrupted:
                raise KeyboardInterrupt
            return Result._of(self._model, twin, self._interval)
        return Result._of(self._model, self._twin, self._interval)

    def _page(self, method: bool = False) -> str:
        """The page of the report, compared with a run without contact only if there is one already."""
        twin = self.__dict__.get("without_contact")
        return self._core.report(self._twin if twin is None else twin._core, method)

    def report(self, path: str | os.PathLike[str], *, method: bool = False, force: bool = False) -> Path:
        """Writes the report: one HTML page with animation, histories and tables, which opens offline.

        The page includes a comparison with a run without contact, which is computed if it does not exist yet.

        Args:
            path: file to write; an earlier page of jostle is replaced.
            method: adds the accuracy of each solver formulation for these buildings.
            force: true replaces other files too.

        Returns:
            The path.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
            OSError: the file cannot be written; an existing file is then unchanged.
        """
        _ = self.without_contact
        self._core.write(path, self._page(method), force)
        return Path(path)

    def save(
        self, folder: str | os.PathLike[str], *, report: bool = True, method: bool = False, force: bool = False
    ) -> Path:
        """Writes ``summary.json``, tables of histories, buildings, floors and impacts, and ``report.html``, as ``jostle run`` does.

        Models that yield also get ``hinges.parquet``.

        Args:
            folder: created if it does not exist.
            report: false omits the report and its run without contact.
            method: adds to the report the accuracy of each solver formulation for these buildings.
            force: true replaces files of these names even if jostle did not write them.

        Returns:
            The folder.

        Raises:
            FileExistsError: a file of such a name exists and jostle did not write it; nothing is written.
        """
        os.makedirs(folder, exist_ok=True)
        self._core.check_folder(folder, force)
        twin = self._twin
        if report and twin is None and self.without_contact is not None:
            twin = self.without_contact._core
        self._core.save(folder, report, twin, method)
        return Path(folder)

    def to_excel(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the numbers as an Excel workbook: summary, buildings, floors, contacts, impacts and, if requested, members.

        Each sheet is one table with names and units in its first two rows; numbers are in SI, missing values are empty cells. The
        sheet ``Quantities`` explains every column. Numbers without contact are included if that run exists, as after
        ``run(without_contact=True)``.

        Args:
            path: file to write; an earlier workbook of jostle is replaced.
            force: true replaces other files too.

        Returns:
            The path.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
            OSError: the file cannot be written; an existing file is then unchanged.
        """
        twin = self.__dict__.get("without_contact")
        self._core.workbook(path, self._twin if twin is None else twin._core, force)
        return Path(path)

    def pdf(self, path: str | os.PathLike[str], *, paper: str = "a4", force: bool = False) -> Path:
        """Prints the report to a PDF file with an installed Chromium browser.

        Args:
            path: file to write; an earlier PDF of a report is replaced.
            paper: ``"a4"`` or ``"letter"``.
            force: true replaces other files too.

        Returns:
            The path.

        Raises:
            ModelError: no Chromium was found, with a remedy.
            AnalysisError: Chromium could not print.
            FileExistsError: the file exists and is not a PDF of a report.
        """
        _ = self.without_contact
        self._core.print(path, self._page(), paper, force)
        return Path(path)

    def animate(self) -> Animation:
        """The animation of the buildings, for a notebook, or for a browser with ``.show()``."""
        return Animation(self._page())

    def plot(self) -> Figure:
        """A matplotlib figure: roof displacements, contact forces, ground acceleration (needs matplotlib)."""
        from ._plot import figure

        return figure(self)

    def __str__(self) -> str:
        return self._core.text(self._twin).rstrip()

    def __repr__(self) -> str:
        return f"<Result {self.summary['title']!r}: {self._core.verdict()}>"

    def _repr_html_(self) -> str:
        from ._draw import result_html

        return result_html(self)

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError(
            "a Result cannot be pickled; send result.summary or arrays, or run the model where it is needed "
            "(models can be pickled)"
        )


def position(building: str | int, names: Sequence[str]) -> int:
    """Index of a building by name or index."""
    if isinstance(building, str):
        if building in names:
            return names.index(building)
        raise ValueError(f"there is no building {building!r}; the buildings are {', '.join(names)}")
    at = index(building)
    at += len(names) if at < 0 else 0
    if not 0 <= at < len(names):
        raise ValueError(f"there is no building {building}; there are {len(names)}, counted from 0")
    return at
