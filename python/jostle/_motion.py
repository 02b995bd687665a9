"""Ground motions."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from . import _jostle
from ._errors import JostleWarning, MissingFileError, ModelError
from ._units import MotionUnits, Quantity, argument, in_si, refuse

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._selection import DesignSpectrum, Selection

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

    Examples:
        >>> import jostle
        >>> spectrum = jostle.Motion.el_centro().spectrum([0.5, 1.0], damping=[0.02, 0.05])
        >>> spectrum.pseudo_acceleration.shape
        (2, 2)
    """

    periods: npt.NDArray[np.float64]
    damping: npt.NDArray[np.float64]
    displacement: npt.NDArray[np.float64]
    pseudo_velocity: npt.NDArray[np.float64]
    pseudo_acceleration: npt.NDArray[np.float64]
    total_acceleration: npt.NDArray[np.float64]
    inelastic: list[dict[str, Any]]

    def _repr_html_(self) -> str:
        from ._draw import spectrum_html

        return spectrum_html(self)


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

    Examples:
        >>> import jostle
        >>> motion = jostle.Motion.el_centro().scaled(pga="0.2 g")
        >>> round(motion.pga, 3)
        1.961
    """

    _core: _jostle.Motion
    #: How well an artificial motion matches its spectrum: ``misfit``, ``worst_period_s``, …; ``None`` of others.
    matched: dict[str, Any] | None = None

    def __init__(
        self,
        acceleration: npt.ArrayLike,
        *,
        step: Quantity,
        unit: str = "m/s2",
        name: str = "motion",
    ) -> None:
        import numpy as np

        if hasattr(acceleration, "dimensionality"):  # a quantity of pint has its own unit
            acceleration, unit = cast(Any, acceleration).to("m/s**2").magnitude, "m/s2"
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
        format: str | None = None,
        record_scale: float | None = None,
        remove_mean: bool | None = None,
    ) -> Motion:
        """Reads a record in a supported format, or returns a built-in one by its name.

        Args:
            path: the file, or the name of a built-in record.
            unit: unit of the values of a text file that does not state it; it overrides that of AT2 files and columns of text.
            step: time step of a text file that does not state it; it overrides that of AT2 files.
            column: column of the acceleration in a text file, from 1.
            component: channel of a file with several: its name, a direction such as ``"N-S"``, or its number.
            read: how the lines of a text file are read, as ``read`` in model files: ``skip``, ``last``, ``per_line``,
                ``content`` (``"values"``, ``"pairs"`` or ``"columns"``) and ``widths``, such as ``{"per_line": 8}``.
            format: format of the file, if auto-detection is wrong.
            record_scale: factor on the numbers of the file, for example the size of one count.
            remove_mean: true removes the mean of the record.

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
            return cls._of(_jostle.Motion.record(
                    name, unit, seconds, column, channel, lines, format, record_scale, remove_mean
                ))
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
            longitude: longitude of the buildings [degrees]; with ``latitude`` it selects the nearest point. Not needed if there
                is only one.
            latitude: latitude of the buildings [degrees].
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

    @staticmethod
    def builtin() -> dict[str, str]:
        """Built-in motions: name and description."""
        return dict(_jostle.motion_list())

    @classmethod
    def synth(
        cls,
        target: DesignSpectrum,
        *,
        seed: int = 1,
        duration: Quantity = 40.0,
        step: Quantity = 0.005,
        pga: Quantity | None = None,
        periods: tuple[Quantity, Quantity] | None = None,
        damping: float = 0.05,
        tolerance: float = 0.05,
    ) -> Motion:
        """An artificial motion, sines under an envelope, matched to a design spectrum.

        ``motion.matched`` states how well the spectra match.

        Args:
            target: the spectrum.
            seed: seed of the phases.
            duration: length, > 0.
            step: time step, > 0.
            pga: peak acceleration; by default that of the code for time histories, or of the spectrum at T = 0.
            periods: first and last matched period; by default from 0.05 s, or four steps, to 6 s, or the end of the spectrum.
            damping: fraction of critical.
            tolerance: largest difference from the spectrum.

        Raises:
            ModelError: a number outside its range, or the spectrum cannot be matched.
        """
        numbers = (_positive("step", step), _positive("duration", duration), float(damping), float(tolerance))
        return cls._matched_to(target, None, numbers, seed, pga, periods)

    def match(
        self,
        target: DesignSpectrum,
        *,
        pga: Quantity | None = None,
        periods: tuple[Quantity, Quantity] | None = None,
        damping: float = 0.05,
        tolerance: float = 0.05,
    ) -> Motion:
        """This motion matched to a design spectrum; step and duration are kept. Arguments as for :meth:`synth`.

        Raises:
            ModelError: a number outside its range, or the spectrum cannot be matched.
        """
        return self._matched_to(target, self._core, (0.005, 40.0, float(damping), float(tolerance)), 1, pga, periods)

    @classmethod
    def _matched_to(
        cls,
        target: DesignSpectrum,
        record: _jostle.Motion | None,
        numbers: tuple[float, float, float, float],
        seed: int,
        pga: Quantity | None,
        periods: tuple[Quantity, Quantity] | None,
    ) -> Motion:
        peak = None if pga is None else in_si("pga", pga, "acceleration")
        ends = None if periods is None else [in_si("periods", period, "time") for period in periods]
        if ends is not None and len(ends) != 2:
            raise ValueError(f"periods: expected the first and the last one, found {len(ends)}")
        return cls._made(*_jostle.match_spectrum(target._words, record, numbers, seed, peak, ends))

    @classmethod
    def _made(cls, core: _jostle.Motion, facts: str, warning: str | None) -> Motion:
        motion = cls._of(core)
        motion.matched = json.loads(facts)
        if warning is not None:
            warnings.warn(warning, JostleWarning, stacklevel=4)
        return motion

    @classmethod
    def recipe(cls, name: str) -> Motion:
        """A named artificial motion, such as ``"nanjing-artificial"``, generated again from its parameters."""
        return cls._made(*_jostle.recipe(name))

    @classmethod
    def noise(
        cls,
        *,
        pga: Quantity,
        seed: int = 1,
        duration: Quantity = 30.0,
        step: Quantity = 0.005,
        frequency: Quantity = 2.5,
        ground_damping: float = 0.6,
        corner: Quantity = 0.25,
        corner_damping: float = 0.6,
    ) -> Motion:
        """Filtered white noise (Kanai and Tajimi, Clough and Penzien).

        Args:
            pga: peak acceleration, > 0.
            seed: seed of the noise.
            duration: length, > 0.
            step: time step, > 0.
            frequency: frequency of the ground filter [Hz].
            ground_damping: damping of the ground filter.
            corner: frequency of the second filter [Hz]; 0 disables it.
            corner_damping: damping of the second filter.
        """
        numbers = (
            _positive("step", step),
            _positive("duration", duration),
            in_si("pga", pga, "acceleration"),
            in_si("frequency", frequency, "frequency"),
            float(ground_damping),
            in_si("corner", corner, "frequency"),
            float(corner_damping),
        )
        return cls._of(_jostle.noise(numbers, seed))

    @classmethod
    def pulse(
        cls,
        *,
        shape: str,
        velocity: Quantity,
        period: Quantity,
        gamma: float = 2.0,
        phase: float = 0.0,
        before: Quantity = 1.0,
        after: Quantity = 5.0,
        step: Quantity = 0.005,
    ) -> Motion:
        """A near-fault velocity pulse.

        Args:
            shape: ``"mavroeidis"``, ``"makris-a"``, ``"makris-b"``, ``"makris-c1"``, ``"makris-c2"``, …
            velocity: peak velocity, > 0.
            period: period of the pulse, > 0.
            gamma: oscillations of a mavroeidis pulse, above 1.
            phase: phase of a mavroeidis pulse [rad].
            before: time at rest before the pulse.
            after: time at rest after the pulse.
            step: time step, > 0.
        """
        numbers = (
            in_si("velocity", velocity, "speed"),
            _positive("period", period),
            float(gamma),
            in_si("phase", phase, "number"),
            in_si("before", before, "time"),
            in_si("after", after, "time"),
            _positive("step", step),
        )
        return cls._of(_jostle.pulse(shape, numbers))

    @staticmethod
    def select(
        target: DesignSpectrum,
        *,
        periods: Sequence[Quantity],
        natural: Sequence[Motion | str | os.PathLike[str]] = (),
        artificial: Sequence[Motion | str | os.PathLike[str]] = (),
        mass_ratios: Sequence[float] = (),
        damping: float = 0.05,
        pga: Quantity | None = None,
        unscaled: bool = False,
    ) -> Selection:
        """Checks a set of motions by the rules of a code.

        Args:
            target: design spectrum of the code.
            periods: main periods of the structure; the longest is T1.
            natural: recorded motions.
            artificial: artificial motions.
            mass_ratios: effective mass ratio of each period; by default equal ones.
            damping: fraction of critical.
            pga: peak of every motion; by default that of the code for time histories.
            unscaled: true leaves the motions as they are.

        Raises:
            ModelError: no motions, or a number outside its range.
        """
        from ._selection import Selection

        def cores(motions: Sequence[Motion | str | os.PathLike[str]]) -> list[_jostle.Motion]:
            return [(own if isinstance(own, Motion) else Motion.read(own))._core for own in motions]

        seconds = [in_si("periods", period, "time") for period in periods]
        peak = None if pga is None else in_si("pga", pga, "acceleration")
        ratios = [float(ratio) for ratio in mass_ratios]
        return Selection(
            *_jostle.select(
                target._words, cores(natural), cores(artificial), seconds, ratios, float(damping), peak, bool(unscaled)
            )
        )

    def processed(
        self,
        *,
        start: Quantity | None = None,
        stop: Quantity | None = None,
        detrend: int | None = None,
        detrend_velocity: int | None = None,
        high_pass: Quantity | None = None,
        low_pass: Quantity | None = None,
        order: int = 4,
        resample: Quantity | None = None,
        pad_before: Quantity | None = None,
        pad_after: Quantity | None = None,
        at_rest: bool = False,
        scale: float | None = None,
        pga: Quantity | None = None,
    ) -> Motion:
        """Returns the motion after these steps, which are applied in this order.

        Args:
            start: keep from this time on.
            stop: keep until this time.
            detrend: subtract a polynomial of this degree fitted to the acceleration.
            detrend_velocity: subtract the derivative of a polynomial of this degree fitted to the velocity.
            high_pass: corner of a high-pass Butterworth filter without phase shift [Hz].
            low_pass: corner of a low-pass Butterworth filter without phase shift [Hz].
            order: order of both filters: 2, 4, 6 or 8.
            resample: new time step.
            pad_before: time at rest before the motion.
            pad_after: time at rest after the motion.
            at_rest: true corrects the motion so that velocity and displacement end at zero.
            scale: factor.
            pga: peak acceleration.

        Raises:
            ModelError: a number outside its range.
        """
        given: dict[str, tuple[Quantity | None, str]] = {
            "from": (start, "time"),
            "to": (stop, "time"),
            "high_pass": (high_pass, "frequency"),
            "low_pass": (low_pass, "frequency"),
            "resample": (resample, "time"),
            "pad_before": (pad_before, "time"),
            "pad_after": (pad_after, "time"),
            "scale": (scale, "number"),
            "pga": (pga, "acceleration"),
        }
        numbers = {name: in_si(name, value, kind) for name, (value, kind) in given.items() if value is not None}
        for name, whole in (("detrend", detrend), ("detrend_velocity", detrend_velocity), ("order", order)):
            if whole is not None:
                if isinstance(whole, bool) or int(whole) != whole or whole < 0:
                    raise ValueError(f"{name}: expected a whole number, found {whole!r}")
                numbers[name] = float(whole)
        return self._of(_jostle.processed(self._core, {**numbers, "at_rest": float(at_rest)}))

    def measures(self) -> dict[str, Any]:
        """Peaks, durations and intensities as ``jostle motion show`` prints them; names contain units."""
        return cast("dict[str, Any]", json.loads(self._core.measures()))

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the motion, scale included, as ``.at2`` (g, eight digits) or ``.csv`` (m/s², all digits).

        Raises:
            FileExistsError: the file exists; ``force=True`` replaces it.
        """
        self._core.write(os.fspath(path), force)
        return Path(path)

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes a page with charts of the motion.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.write_text(os.fspath(path), self._core.page(), "page", force)
        return Path(path)

    def _baked(self) -> Motion:
        """The values as they are used, as a record; a wave given by a formula with 200 points in a period."""
        return Motion(self.acceleration, step=self.step or self._core.drawn_step, name=self.name)

    def _as_table(self, taken: set[str]) -> tuple[dict[str, Any], dict[str, str]]:
        """``[motion]`` of a model file, and the files that it names."""
        name, _, numbers, pga, factor, reverse, duration = self._core.state()
        table: dict[str, Any] = {}
        files: dict[str, str] = {}
        text = self._core.csv()
        if text is not None:
            plain = "".join(c if c.isalnum() or c in "-_ " else "_" for c in name).strip() or "motion"
            file, count = f"{plain}.csv", 1
            while file in taken:
                count += 1
                file = f"{plain}-{count}.csv"
            table["record"], files[file] = file, text
        elif len(numbers) == 2:
            table.update(kind="sine", amplitude=numbers[0], period=numbers[1])
        else:
            table.update(kind="ricker", amplitude=numbers[0], period=numbers[1], centre=numbers[2])
        scaling = {"pga": pga, "scale": factor, "reverse": reverse or None, "duration": duration}
        table.update({key: value for key, value in scaling.items() if value is not None})
        return table, files

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
            post_yield: ratio of post-yield to initial stiffness of the inelastic spectra.
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
