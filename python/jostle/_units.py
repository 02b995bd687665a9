"""Quantities: texts with units, numbers in SI, and keywords with the unit in their name."""

from __future__ import annotations

import difflib
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, Protocol, TypedDict, Union

from . import _jostle
from ._errors import ModelError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class PhysicalQuantity(Protocol):
    """A number, or an array, with a unit, as of the package pint."""

    @property
    def magnitude(self) -> Any: ...
    @property
    def dimensionality(self) -> Any: ...
    def to(self, other: Any = None) -> Any: ...


#: A text with a unit, a number in SI, or a quantity of pint.
Quantity = Union[str, float, PhysicalQuantity]
#: A quantity, or one per storey or span.
Quantities = Union[Quantity, "Iterable[Quantity]", "npt.NDArray[np.floating[Any]]"]
#: Numbers in the unit of the keyword: one, or one per storey or span.
Numbers = Union[float, "Iterable[float]", "npt.NDArray[np.floating[Any]]"]

#: Units in names of keywords, as in ``width_mm`` or ``stiffness_mn_m``.
UNITS: dict[str, str] = {
    "m": "m", "cm": "cm", "mm": "mm", "ft": "ft", "in": "in",
    "s": "s", "ms": "ms",
    "m_s": "m/s", "cm_s": "cm/s",
    "m_s2": "m/s2", "cm_s2": "cm/s2", "g": "g", "gal": "gal",
    "kg": "kg", "t": "t", "kn": "kN", "mn": "MN", "n": "N",
    "n_m": "N/m", "kn_m": "kN/m", "mn_m": "MN/m", "n_m1_5": "N/m^1.5",
    "m_n": "m/N",
    "n_s_m": "N.s/m", "kn_s_m": "kN.s/m", "mn_s_m": "MN.s/m",
    "pa": "Pa", "mpa": "MPa", "gpa": "GPa",
    "kg_m": "kg/m", "t_m": "t/m", "kg_m3": "kg/m3", "kn_m3": "kN/m3",
}  # fmt: skip

class MotionUnits(TypedDict, total=False):
    """Keywords with units in their names."""

    pga_m_s2: float
    pga_cm_s2: float
    pga_g: float
    pga_gal: float


class RunUnits(MotionUnits, total=False):
    """Keywords with units in their names."""

    gap_m: float
    gap_cm: float
    gap_mm: float
    gap_in: float


class HeightUnits(TypedDict, total=False):
    """Keywords with units in their names."""

    storey_height_m: Numbers
    storey_height_cm: Numbers
    storey_height_mm: Numbers
    storey_height_ft: Numbers
    elevation_m: float


class FrameUnits(HeightUnits, total=False):
    """Keywords with units in their names."""

    spans_m: Iterable[float]
    spans_cm: Iterable[float]
    spans_mm: Iterable[float]
    spans_ft: Iterable[float]
    elastic_modulus_pa: float
    elastic_modulus_mpa: float
    elastic_modulus_gpa: float
    density_kg_m3: float
    density_kn_m3: float
    beam_mass_kg_m: Numbers
    beam_mass_t_m: Numbers
    beam_mass_kn_m: Numbers
    floor_mass_kg: Numbers
    floor_mass_t: Numbers
    floor_mass_kn: Numbers


class ShearUnits(HeightUnits, total=False):
    """Keywords with units in their names."""

    mass_kg: Numbers
    mass_t: Numbers
    mass_kn: Numbers
    stiffness_n_m: Numbers
    stiffness_kn_m: Numbers
    stiffness_mn_m: Numbers


class SpaceFrameUnits(HeightUnits, total=False):
    """Keywords with units in their names."""

    lines_x_m: Iterable[float]
    lines_x_cm: Iterable[float]
    lines_x_mm: Iterable[float]
    lines_x_ft: Iterable[float]
    lines_y_m: Iterable[float]
    lines_y_cm: Iterable[float]
    lines_y_mm: Iterable[float]
    lines_y_ft: Iterable[float]
    mass_kg: Numbers
    mass_t: Numbers
    mass_kn: Numbers
    elastic_modulus_pa: float
    elastic_modulus_mpa: float
    elastic_modulus_gpa: float


class GivenUnits(HeightUnits, total=False):
    """Keywords with units in their names."""

    mass_kg: Numbers
    mass_t: Numbers
    mass_kn: Numbers
    periods_s: Iterable[float]
    remainder_period_s: float
    contact_flexibility_m_n: float


class LinkUnits(TypedDict, total=False):
    """Keywords with units in their names."""

    level_tolerance_m: float
    level_tolerance_cm: float
    level_tolerance_mm: float
    stiffness_n_m: float
    stiffness_kn_m: float
    stiffness_mn_m: float
    damping_n_s_m: float
    damping_kn_s_m: float
    damping_mn_s_m: float
    slip_force_n: float
    slip_force_kn: float
    slip_force_mn: float
    stick_stiffness_n_m: float
    stick_stiffness_kn_m: float
    stick_stiffness_mn_m: float
    slack_m: float
    slack_cm: float
    slack_mm: float
    gap_m: float
    gap_cm: float
    gap_mm: float


class GapUnits(TypedDict, total=False):
    """Keywords with units in their names."""

    design_speed_m_s: float
    design_speed_cm_s: float

    damping_n_s_m: float
    damping_kn_s_m: float
    damping_mn_s_m: float
    second_stiffness_n_m: float
    second_stiffness_kn_m: float
    second_stiffness_mn_m: float
    yield_m: float
    yield_cm: float
    yield_mm: float
    width_m: Numbers
    width_cm: Numbers
    width_mm: Numbers
    width_in: Numbers
    level_tolerance_m: float
    level_tolerance_cm: float
    level_tolerance_mm: float
    thickness_m: float
    thickness_cm: float
    thickness_mm: float
    minimum_separation_s: float
    minimum_separation_ms: float
    stiffness_n_m: float
    stiffness_kn_m: float
    stiffness_mn_m: float
    stiffness_n_m1_5: float


#: Exponents of mass, length and time, and the unit in SI as model files write it.
_SI: dict[tuple[float, float, float], str] = {
    (0, 1, 0): "m", (0, 0, 1): "s", (1, 0, 0): "kg", (0, 0, -1): "Hz",
    (0, 1, -1): "m/s", (0, 1, -2): "m/s2",
    (1, 1, -2): "N", (1, 0, -2): "N/m", (1, -0.5, -2): "N/m^1.5", (-1, 0, 2): "m/N",
    (1, 2, -2): "N.m", (1, 0, -1): "N.s/m", (1, -1, -2): "Pa", (1, -1, 0): "kg/m", (1, -3, 0): "kg/m3",
}  # fmt: skip
_BASE = ("[mass]", "[length]", "[time]")


def without_pint(value: object) -> Any:
    """A quantity of pint as a text with its unit in SI, arrays as lists of such; anything else as it is."""
    dimensions = getattr(value, "dimensionality", None)
    if dimensions is None or not hasattr(value, "magnitude"):
        return value
    powers = {str(name): float(power) for name, power in dict(dimensions).items()}
    quantity: Any = value
    if not set(powers) <= set(_BASE):
        raise ModelError(f"{value}: expected a quantity of mass, length and time")
    mass, length, time = (powers.get(name, 0.0) for name in _BASE)
    unit = _SI.get((mass, length, time), "")
    si = " * ".join(f"{name}**{power}" for name, power in (("kilogram", mass), ("meter", length), ("second", time)))
    magnitude = quantity.to(si if powers else "dimensionless").magnitude
    return with_unit(magnitude, unit) if unit else magnitude


def number(value: object) -> float | int | None:
    """A plain number from anything that is one, NumPy's included; ``None`` for anything else."""
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return float(value)
    return None


def in_si(name: str, value: object, kind: str) -> float:
    """An argument that is a text with a unit or a number in SI."""
    value = without_pint(value)
    plain = number(value)
    if isinstance(value, bool) or (plain is None and not isinstance(value, str)):
        raise TypeError(
            f"{name}: expected a text with a unit or a number in SI, found {type(value).__name__}"
        )
    text = value if isinstance(value, str) else repr(plain)
    try:
        return _jostle.quantity(text, kind)
    except ModelError as error:
        raise ModelError(f"{name}: {error}") from None


def option_text(name: str, value: object) -> str:
    """A value as the text of an option: two entries with a comma.

    Raises:
        TypeError: anything but a text, a number, a quantity, or two of them.
    """
    value = without_pint(value)
    if isinstance(value, str):
        return value
    plain = None if isinstance(value, bool) else number(value)
    if plain is not None:
        return repr(plain)
    if isinstance(value, Sequence) and len(value) == 2:
        return ", ".join(option_text(name, entry) for entry in value)
    raise TypeError(
        f"{name}: expected a text with a unit, a number in SI, or two of them, found {type(value).__name__}"
    )


def split(key: str, bases: Collection[str]) -> tuple[str, str] | None:
    """The keyword and the unit of a name such as ``width_mm``, if it is one of these keywords with a known unit."""
    for unit, text in UNITS.items():
        base = key[: -len(unit) - 1]
        if key.endswith(f"_{unit}") and base in bases:
            return base, text
    return None


def with_unit(value: object, unit: str) -> object:
    """A number, or every number of a list, as a text with its unit; anything else is left for the reader to reject."""
    plain = number(value)
    if plain is not None and not isinstance(value, bool):
        if not math.isfinite(plain):
            return plain
        return f"{plain!r} {unit}"
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable):
        return value
    return [with_unit(entry, unit) for entry in value]


def merge(
    what: str, fields: Mapping[str, object], extra: Mapping[str, object], known: Iterable[str] = ()
) -> dict[str, Any]:
    """The given fields, including those with a unit in the keyword; ``known`` lists such keywords.

    Raises:
        TypeError: an unknown keyword, with the nearest known one.
    """
    merged = {key: value for key, value in fields.items() if value is not None}
    for key, value in extra.items():
        parts = split(key, fields.keys())
        if parts is None:
            refuse(what, (key,), [*(name for name in fields if name != "kind"), *known])
            continue
        if value is None:
            continue
        name, value = parts[0], with_unit(value, parts[1])
        if name in merged:
            raise TypeError(f"{what}: {name} is given twice, the second time as {key}")
        merged[name] = value
    return merged


def argument(
    name: str, value: Quantity | None, kind: str, extra: dict[str, Any]
) -> float | None:
    """A quantity in SI from its keyword or from one with a unit in its name, which is taken from ``extra``."""
    for key in list(extra):
        parts = split(key, (name,))
        if parts:
            if value is not None:
                raise TypeError(f"{name} is given twice, the second time as {key}")
            given = with_unit(extra.pop(key), parts[1])
            if not isinstance(given, str):
                raise TypeError(f"{key}: expected a number, found {type(given).__name__}")
            value = given
    return None if value is None else in_si(name, value, kind)


def refuse(function: str, extra: Iterable[str], known: Iterable[str] = ()) -> None:
    """Raises for unknown keywords; the message names the nearest known one."""
    for key in extra:
        nearest = difflib.get_close_matches(key, list(known), 1)
        hint = f"; did you mean {nearest[0]!r}?" if nearest else ""
        raise TypeError(f"{function}() got an unexpected keyword argument {key!r}{hint}")
