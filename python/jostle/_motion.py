"""Ground motions."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _jostle
from ._errors import MissingFileError, ModelError
from ._units import MotionUnits, Quantity, argument, in_si, refuse

if TYPE_CHECKING:
    from typing_extensions import Unpack

    import numpy as np
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Response spectra; ``d`` damping ratios, ``n`` periods, ``i`` pairs of damping and ductility.

    Attributes:
        periods: natural periods [s], shape ``(n,)``.
        damping: fractions of critical, shape ``(d,)``.
        displacement: relative displacement [m], shape ``(d, n)``.
        pseudo_velocity: [m/s], shape ``(d, n)``.
        pseudo_acceleration: [m/s²], shape ``(d, n)``.
        total_acceleration: [m/s²], shape ``(d, n)``.
        inelastic: one dict for each pair: ``damping``, ``ductility``, ``yield_acceleration_m_s2``, ``reduction`` and
            ``displacement_m``.
    """

    periods: npt.NDArray[np.float64]
    damping: npt.NDArray[np.float64]
    displacement: npt.NDArray[np.float64]
    pseudo_velocity: npt.NDArray[np.float64]
    pseudo_acceleration: npt.NDArray[np.float64]
    total_acceleration: npt.NDArray[np.float64]
    inelastic: list[dict[str, Any]]


def _spectrum(tree: dict[str, Any]) -> Spectrum:
    import numpy as np

    curves = tree["spectra"]

    def rows(key: str) -> npt.NDArray[np.float64]:
        return np.array([curve[key] for curve in curves], dtype=np.float64)

    return Spectrum(
        periods=np.array(tree["periods_s"], dtype=np.float64),
        damping=rows("damping"),
        displacement=rows("displacement_m"),
        pseudo_velocity=rows("pseudo_velocity_m_s"),
        pseudo_acceleration=rows("pseudo_acceleration_m_s2"),
        total_acceleration=rows("total_acceleration_m_s2"),
        inelastic=tree.get("inelastic", []),
    )


class Motion:
    """Horizontal ground acceleration, positive to the right.

    Args:
        acceleration: at least two values, equally spaced, the first at time zero; shape ``(points,)``.
        step: time step, a time between 1e-6 s and 10 s.
        unit: unit of the values, such as ``"g"`` or ``"cm/s2"``.
        name: name on summaries.

    Raises:
        ModelError: too few values, values that are not finite or beyond 100 m/s², an unusable step or unit.
    """

    _core: _jostle.Motion

    def __init__(
        self,
        acceleration: npt.ArrayLike,
        *,
        step: Quantity,
        unit: str = "m/s2",
        name: str = "motion",
    ) -> None:
        import numpy as np

        values = np.ascontiguousarray(acceleration, dtype=np.float64)
        if values.ndim != 1:
            raise TypeError(f"acceleration: expected one row of numbers, found shape {values.shape}")
        self._core = _jostle.Motion.sampled(name, values, unit, in_si("step", step, "time"))

    @classmethod
    def _of(cls, core: _jostle.Motion) -> Motion:
        motion = cls.__new__(cls)
        motion._core = core
        return motion

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        *,
        unit: str | None = None,
        step: Quantity | None = None,
        column: int | None = None,
        component: str | int | None = None,
        read: Mapping[str, Any] | None = None,
    ) -> Motion:
        """Reads a record in a supported format, or returns a built-in one by its name.

        Args:
            path: the file, or the name of a built-in record.
            unit: unit of the values of a text file that does not state it.
            step: time step of a text file that does not state it.
            column: column of the acceleration in a text file, from 1.
            component: channel of a file with several: its name, a direction such as ``"N-S"``, or its number.
            read: how the lines of a text file are read, as ``read`` in model files: ``skip``, ``last``, ``per_line``,
                ``content`` (``"values"``, ``"pairs"`` or ``"columns"``) and ``widths``, such as ``{"per_line": 8}``.

        Raises:
            MissingFileError: neither a file nor a built-in record; a ``ModelError`` and a ``FileNotFoundError``.
            ModelError: with file, line and remedy.
        """
        seconds = None if step is None else in_si("step", step, "time")
        name = os.fspath(path)
        stated = dict(read or {})
        keys = ("skip", "last", "per_line", "content", "widths")
        unknown = sorted(set(stated) - set(keys))
        if unknown:
            raise TypeError(f"read: unknown key {unknown[0]!r}; known: {', '.join(keys)}")
        skip, last, per_line, content, widths = (stated.get(key) for key in keys)
        lines = (skip, last, per_line, content, None if widths is None else list(widths))
        channel = None if component is None else str(component)
        try:
            return cls._of(_jostle.Motion.record(name, unit, seconds, column, channel, lines))
        except ModelError as error:
            if os.path.lexists(name) or "there is no record" not in str(error):
                raise
            raise MissingFileError(str(error), name) from None

    @classmethod
    def from_event_grid(
        cls,
        path: str | os.PathLike[str],
        *,
        unit: str,
        longitude: float | None = None,
        latitude: float | None = None,
        component: str = "x",
    ) -> list[Motion]:
        """Reads the motions of one point of an ``EventGrid.csv`` of NHERI SimCenter, each scaled by its factor.

        The grid lists points (``GP_file,Longitude,Latitude``), each file of a point lists records (``TH_file,factor``), and a record is
        a file of JSON with ``dT`` and ``data_x``, ``data_y`` or ``data_z``.

        Args:
            path: the file ``EventGrid.csv``.
            unit: unit of the accelerations, which the files do not state: ``"g"``, ``"m/s2"``, ``"in/s2"``.
            longitude: place of the buildings [degrees]; with ``latitude`` it chooses the nearest point. Not needed if there is one point.
            latitude: as ``longitude``.
            component: ``"x"``, ``"y"`` or ``"z"``.

        Raises:
            MissingFileError: a file that is listed does not exist.
            ModelError: a file cannot be understood, or lists nothing.
        """
        from ._event_grid import read

        return read(path, unit, longitude, latitude, component)

    @classmethod
    def el_centro(cls) -> Motion:
        """El Centro 1940, north-south, as digitised by Peknold: 1560 points, 0.02 s, 0.319 g."""
        return cls.read("el-centro-1940-ns")

    @classmethod
    def sine(cls, *, amplitude: Quantity, period: Quantity, duration: Quantity) -> Motion:
        """``amplitude · sin(2π t / period)``, evaluated exactly at every instant."""
        return cls._of(
            _jostle.Motion.sine(
                in_si("amplitude", amplitude, "acceleration"),
                _positive("period", period),
                _positive("duration", duration),
            )
        )

    @classmethod
    def ricker(
        cls,
        *,
        amplitude: Quantity,
        period: Quantity,
        centre: Quantity | None = None,
        duration: Quantity | None = None,
    ) -> Motion:
        """A Ricker pulse that peaks with ``amplitude`` at ``centre`` (1.5 periods by default)."""
        seconds = _positive("period", period)
        return cls._of(
            _jostle.Motion.ricker(
                in_si("amplitude", amplitude, "acceleration"),
                seconds,
                1.5 * seconds if centre is None else _positive("centre", centre),
                None if duration is None else _positive("duration", duration),
            )
        )

    def scaled(
        self,
        factor: float | None = None,
        *,
        pga: Quantity | None = None,
        **units: Unpack[MotionUnits],
    ) -> Motion:
        """The same motion scaled to a peak (``pga="0.2 g"`` or ``pga_g=0.2``), or by a factor.

        The peak refers to the whole record, even if the analysis is shorter.
        """
        extra: dict[str, Any] = dict(units)
        peak = argument("pga", pga, "acceleration", extra)
        refuse("scaled", extra, ["pga", "factor", *MotionUnits.__annotations__])
        if (peak is None) == (factor is None):
            raise TypeError("scaled: give either a factor or pga")
        if peak is not None and not peak > 0.0:
            raise ValueError(f"pga: must be greater than zero, found {peak} m/s2")
        by = None if factor is None else in_si("factor", factor, "number")
        return self._of(self._core.changed(pga=peak, factor=by))

    def reversed(self) -> Motion:
        """The same motion with its sign changed."""
        return self._of(self._core.changed(reverse=True))

    def lasting(self, duration: Quantity) -> Motion:
        """The same motion with this duration: cut, or continued with the ground at rest."""
        return self._of(self._core.changed(duration=_positive("duration", duration)))

    def spectrum(
        self,
        periods: npt.ArrayLike | None = None,
        damping: float | Sequence[float] = 0.05,
        *,
        ductility: Sequence[float] = (),
        post_yield: float = 0.0,
        between: bool = False,
    ) -> Spectrum:
        """Returns response spectra, exact for linear acceleration between the samples.

        Args:
            periods: natural periods, > 0 [s], shape ``(n,)``; by default 200 from 0.02 to 10 s.
            damping: fraction of critical, 0 to below 1; one or several.
            ductility: ductilities of additional inelastic spectra, each ≥ 1.
            post_yield: ratio of post-yield to initial stiffness of these.
            between: true finds peaks between the samples too; false, as usual, at the samples only.

        Raises:
            ModelError: a number outside its range.
        """
        import numpy as np

        if periods is None:
            periods = np.geomspace(0.02, 10.0, 200)
        wanted = np.ascontiguousarray(periods, dtype=np.float64).ravel()
        dampings = [damping] if isinstance(damping, (int, float)) else list(damping)
        text = self._core.spectrum(
            wanted.tolist(), [float(d) for d in dampings], list(ductility), post_yield, between
        )
        return _spectrum(json.loads(text))

    @property
    def name(self) -> str:
        """Name."""
        return self._core.name

    @property
    def step(self) -> float | None:
        """Time step of the record [s]; ``None`` for analytic motions."""
        return self._core.step

    @property
    def duration(self) -> float:
        """Length [s]."""
        return self._core.duration

    @property
    def pga(self) -> float:
        """Peak ground acceleration, scale included [m/s²]."""
        return self._core.peak

    @property
    def scale(self) -> float:
        """Factor on the record, negative when reversed [–]."""
        return self._core.scale

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Instants of the record [s], shape ``(points,)``; for analytic motions 200 per period."""
        import numpy as np

        step = self._core.drawn_step
        points = min(int(self.duration / step * (1 + 1e-12)) + 1, 10_000_000)
        return np.arange(points, dtype=np.float64) * step

    @property
    def acceleration(self) -> npt.NDArray[np.float64]:
        """Ground acceleration at ``time``, scale included [m/s²]."""
        return self._core.at(self.time)

    def at(self, time: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Ground acceleration at any instants, linear between the points of a record [m/s²].

        Args:
            time: instants [s], shape ``(n,)``.
        """
        import numpy as np

        return self._core.at(np.ascontiguousarray(time, dtype=np.float64).ravel())

    def __repr__(self) -> str:
        return f"<Motion {self.name!r}, {self.duration:.6g} s, peak {self.pga:.4g} m/s2>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, self._core.state())

    def _repr_html_(self) -> str:
        from ._draw import history_svg

        curves = [(self.name, self.time, self.acceleration)]
        return history_svg("Ground acceleration", "m/s²", curves)


def _positive(name: str, value: Quantity) -> float:
    seconds = in_si(name, value, "time")
    if not 0.0 < seconds <= 10_000.0:
        raise ValueError(f"{name}: must lie between 0 and 10000 s, found {seconds} s")
    return seconds


def _rebuild(*state: Any) -> Motion:
    return Motion._of(_jostle.Motion.from_state(*state))
