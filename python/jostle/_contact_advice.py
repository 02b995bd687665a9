"""Contact stiffness and restitution estimated from slabs, material and colliding masses."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from . import _jostle
from ._answers import Answers
from ._model import Model
from ._units import Quantity, option_text


@dataclass(frozen=True)
class StiffnessRange:
    """A recommended value and the range in which it may lie.

    Attributes:
        value: recommended value.
        low: lowest plausible value.
        high: highest plausible value.

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice(mass="40 t")
        >>> advice.hertz.low <= advice.hertz.value <= advice.hertz.high
        True
    """

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class StiffnessEstimate:
    """One estimate of a contact stiffness.

    Attributes:
        name: its name.
        family: ``"hertz"`` or ``"linear"``.
        stiffness: in N/m^1.5 of the Hertz family, in N/m of the linear one.
        peak_force: peak force of an elastic collision of the masses with this stiffness [N].
        duration: time in contact of that collision [s].
        is_valid: whether its assumptions are satisfied in this case.
        source: where it comes from.
        validity: what it assumes.

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice(mass="40 t")
        >>> advice.estimates[0].family
        'hertz'
    """

    name: str
    family: str
    stiffness: float
    peak_force: float
    duration: float
    is_valid: bool
    source: str
    validity: str


@dataclass(frozen=True)
class WaveEstimate:
    """The collision of two floors as elastic rods with distributed mass.

    Attributes:
        transit: travel times of a wave along the left and the right floor [s].
        peak_force: greatest force [N].
        duration: time in contact [s].
        restitution: apparent restitution of the centres of mass [–].

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice(mass="40 t", length=12, width=10, thickness="150 mm")
        >>> advice.wave.duration > 0
        True
    """

    transit: tuple[float, float]
    peak_force: float
    duration: float
    restitution: float


@dataclass(frozen=True)
class LateralRule:
    """A rule used in many studies: contact stiffness as a multiple of the lateral stiffness of the stiffer neighbour.

    Attributes:
        of: name of the stiffer neighbour.
        lateral: force on its struck floor ÷ displacement of that floor [N/m].
        low: ten times that [N/m].
        high: a hundred times that [N/m].

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice("paper")
        >>> advice.lateral.low < advice.lateral.high
        True
    """

    of: str
    lateral: float
    low: float
    high: float


@dataclass(frozen=True)
class ContactAdvice:
    """Advice on the contacts of one gap.

    Attributes:
        between: names of the neighbours.
        height: height of the contact [m]; ``None`` without a model.
        masses: colliding masses [kg]; ``None`` is a rigid wall.
        speed: impact speed [m/s].
        moduli: Young's moduli of the floors [Pa].
        wave: collision of the floors as rods; ``None`` if their size is unknown.
        estimates: estimates of stiffness.
        hertz: recommended stiffness of the Hertz laws [N/m^1.5].
        linear: recommended stiffness of the linear laws [N/m]; ``None`` if the size of the slabs is unknown.
        lateral: stiffness by a rule of many studies for linear laws; ``None`` without a model.
        restitution: recommended restitution [–].
        notes: assumptions and warnings.

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice(mass="40 t")
        >>> advice.restitution.value
        0.65
    """

    between: tuple[str, str]
    height: float | None
    masses: tuple[float | None, float | None]
    speed: float
    moduli: tuple[float, float]
    wave: WaveEstimate | None
    estimates: tuple[StiffnessEstimate, ...]
    hertz: StiffnessRange
    linear: StiffnessRange | None
    lateral: LateralRule | None
    restitution: StiffnessRange
    notes: tuple[str, ...]

    def _repr_html_(self) -> str:
        from ._draw import advice_html

        return advice_html(self)


def contact_advice(
    model: Model | str | os.PathLike[str] | None = None,
    *,
    mass: Quantity | Sequence[Quantity] | None = None,
    length: Quantity | Sequence[Quantity] | None = None,
    width: Quantity | Sequence[Quantity] | None = None,
    thickness: Quantity | Sequence[Quantity] | None = None,
    concrete: str | None = None,
    modulus: Quantity | Sequence[Quantity] | None = None,
    poisson_ratio: float = 0.2,
    density: Quantity | Sequence[Quantity] = 2500.0,
    speed: Quantity = 0.4,
) -> Answers[ContactAdvice]:
    """Returns stiffness and restitution for the contacts of a model, or of two floors: ``jostle contact-advice``.

    If a value has two entries, they are for the left and the right floor.

    Args:
        model: model that gives the colliding masses: for every gap, those of the pair of floors with the greatest effective mass.
        mass: colliding masses > 0, in place of those of the model; needed without a model [kg].
        length: length of the slabs in the direction of the impact, > 0 [m].
        width: width of the slabs perpendicular to the impact, > 0 [m].
        thickness: thickness of the slabs, > 0 [m]; give all three sizes, or none.
        concrete: grade that gives the modulus: ``"C30"``, ``"C30/37"`` or ``"f'c = 4 ksi"``.
        modulus: modulus of elasticity instead of ``concrete``, > 0; 30 GPa by default [Pa].
        poisson_ratio: Poisson's ratio, 0 to 0.5.
        density: density, > 0 [kg/m³].
        speed: impact speed, > 0 [m/s].

    Raises:
        ModelError: a value is missing or outside its range; the model is wrong.

    Examples:
        >>> import jostle
        >>> (advice,) = jostle.contact_advice(mass=["40 t", "60 t"], length=12, width=10, thickness="150 mm")
        >>> advice.linear.low < advice.linear.high
        True
    """
    if model is not None:
        model = Model.from_any(model)
    options: dict[str, str] = {}
    given: dict[str, Any] = {
        "mass": mass,
        "length": length,
        "width": width,
        "thickness": thickness,
        "concrete": concrete,
        "modulus": modulus,
        "poisson_ratio": poisson_ratio,
        "density": density,
        "speed": speed,
    }
    for name, value in given.items():
        if value is not None:
            options[name] = option_text(name, value)
    found = _jostle.contact_advice(None if model is None else model._core, options)
    return Answers(_advice(one) for one in json.loads(found))


def _advice(one: dict[str, Any]) -> ContactAdvice:
    wave = one["wave"]
    return ContactAdvice(
        between=(one["between"][0], one["between"][1]),
        height=one["height_m"],
        masses=(one["masses_kg"][0], one["masses_kg"][1]),
        speed=one["speed_m_s"],
        moduli=(one["moduli_pa"][0], one["moduli_pa"][1]),
        wave=None
        if wave is None
        else WaveEstimate(
            (wave["transit_s"][0], wave["transit_s"][1]),
            wave["peak_force_n"],
            wave["duration_s"],
            wave["restitution"],
        ),
        estimates=tuple(
            StiffnessEstimate(
                entry["name"],
                entry["family"],
                entry["stiffness"],
                entry["peak_force_n"],
                entry["duration_s"],
                entry["is_valid"],
                entry["source"],
                entry["validity"],
            )
            for entry in one["estimates"]
        ),
        hertz=StiffnessRange(**one["hertz"]),
        linear=None if one["linear"] is None else StiffnessRange(**one["linear"]),
        lateral=None
        if one["lateral"] is None
        else LateralRule(
            one["lateral"]["of"],
            one["lateral"]["lateral_n_m"],
            one["lateral"]["low_n_m"],
            one["lateral"]["high_n_m"],
        ),
        restitution=StiffnessRange(**one["restitution"]),
        notes=tuple(one["notes"]),
    )
