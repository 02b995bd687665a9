"""Two free masses under published and user-defined contact laws."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _jostle
from ._answers import Answers
from ._errors import AnalysisError, ModelError
from ._units import Quantity, in_si, option_text

if TYPE_CHECKING:
    from ._builders import _Law
    import numpy as np
    import numpy.typing as npt


@dataclass(frozen=True)
class ContactLaw:
    """A user-defined contact law for experiments. It is slow, because every force is a call into Python.

    Attributes:
        force: ``force(indentation, rate, impact_speed)`` [N] of the indentation [m] > 0, its rate [m/s] (positive while
            closing) and the impact speed [m/s]; a positive force pushes the masses apart.
        name: name in tables.

    Examples:
        >>> import jostle
        >>> law = jostle.ContactLaw(lambda indentation, rate, speed: 8e7 * indentation, name="spring")
        >>> round(jostle.collide(law, m1="40 t", m2="60 t", speed="0.4 m/s").realised_restitution, 3)
        1.0
    """

    force: Callable[[float, float, float], float]
    name: str = "custom"


@dataclass(frozen=True, eq=False)
class Collision:
    """The collision of two free masses.

    Attributes:
        law: name of the law, with its variant if it has several.
        stiffness: stiffness of the law [N/m or N/m^1.5]; ``None`` for user-defined laws.
        restitution: input coefficient [–]; ``None`` for user-defined laws.
        impact_speed: closing speed at first contact [m/s].
        separation_speed: opening speed at the end [m/s].
        realised_restitution: their ratio [–].
        peak_force: peak force [N]; ``None`` for the momentum law, which has none.
        peak_indentation: greatest indentation [m].
        duration: from first contact to the last instant of force [s].
        impulse: time integral of the force [N·s].
        dissipated: dissipated kinetic energy [J].
        time: instants [s], shape ``(points,)``.
        indentation: indentation at these instants [m].
        rate: its rate [m/s].
        force: force [N].

    Examples:
        >>> import jostle
        >>> collision = jostle.collide(m1="40 t", m2="60 t", speed="0.4 m/s")
        >>> bool(collision.force.max() <= collision.peak_force)
        True
    """

    law: str
    stiffness: float | None
    restitution: float | None
    impact_speed: float
    separation_speed: float
    realised_restitution: float
    peak_force: float | None
    peak_indentation: float
    duration: float
    impulse: float
    dissipated: float
    time: npt.NDArray[np.float64]
    indentation: npt.NDArray[np.float64]
    rate: npt.NDArray[np.float64]
    force: npt.NDArray[np.float64]

    def __repr__(self) -> str:
        peak = "no force" if self.peak_force is None else f"peak {self.peak_force:.4g} N"
        return f"<Collision {self.law!r}: {peak}, rebound {self.realised_restitution:.4f}>"

    def _repr_html_(self) -> str:
        from ._draw import history_svg

        return history_svg(f"Contact force, {self.law}", "N", [(self.law, self.time, self.force)])


def contact_laws() -> list[dict[str, Any]]:
    """The contact laws: ``law``, ``variant``, ``stiffness_unit`` and whether it is ``dissipative``.

    Examples:
        >>> import jostle
        >>> "hertz-damp" in str(jostle.contact_laws())
        True
    """
    laws: list[dict[str, Any]] = json.loads(_jostle.contact_laws())
    return laws


def collide(
    law: _Law | ContactLaw = "hertz-damp",
    *,
    m1: Quantity,
    m2: Quantity,
    speed: Quantity,
    formula: str | None = None,
    stiffness: Quantity | None = None,
    restitution: float | None = None,
    restitution_is: str = "input",
    damping: Quantity | None = None,
    variant: str | None = None,
    yield_share: float | None = None,
    design_speed: Quantity | None = None,
    thickness: Quantity | None = None,
    exponent: float | None = None,
) -> Collision:
    """Returns the collision of two free masses: the results of ``jostle collide`` and the histories.

    Args:
        law: a name of :func:`contact_laws`, or a user-defined law; for the latter only masses and speed are used.
        m1: mass [kg].
        m2: the other mass [kg]; for a wall use a large mass, as ``float("inf")`` is not accepted.
        speed: closing speed at first contact, > 0 [m/s].
        formula: instead of a law, the force as in :class:`Gap`: ``"k * d^1.5 * (1 + 0.6 * v / v0)"``.
        stiffness: in N/m^1.5 for the Hertz family, in N/m for the others; 2e9 N/m^1.5 by default.
        restitution: coefficient of restitution, 0 to 1; 0.65 by default.
        restitution_is: ``"input"``: it is used in the published formula; ``"realised"``: free masses rebound with it.
        damping: of ``kelvin``, ``kelvin-no-tension`` and ``modified-kelvin`` after Mahmoud and Jankowski: dashpot instead
            of ``restitution``, ≥ 0 [N·s/m].
        variant: of ``modified-kelvin``: ``"ye"`` or ``"mahmoud-jankowski"``.
        yield_share: of ``bilinear``: yield indentation ÷ greatest indentation.
        design_speed: of ``bilinear``: speed for which its stiffnesses are computed.
        thickness: of ``rubber``: thickness of the bumper.
        exponent: of ``rubber``: exponent of the compression.

    Raises:
        ModelError: a value outside its range; the message gives the range. Both ``damping`` and ``restitution``.
        AnalysisError: a user-defined law whose contact does not end.

    Examples:
        >>> import jostle
        >>> round(jostle.collide("hertz", m1="40 t", m2="60 t", speed="0.4 m/s").realised_restitution, 3)
        1.0
    """
    if isinstance(law, ContactLaw):
        masses = [in_si(name, value, "mass") for name, value in (("m1", m1), ("m2", m2))]
        return _of_own(law, masses, in_si("speed", speed, "speed"))
    if damping is not None and restitution is not None:
        raise ModelError("damping: cannot be combined with restitution; leave one of them out")
    found = _collide(
        law,
        m1=m1,
        m2=m2,
        speed=speed,
        formula=formula,
        stiffness=stiffness,
        restitution=restitution,
        restitution_is=restitution_is,
        damping=damping,
        variant=variant,
        yield_share=yield_share,
        design_speed=design_speed,
        thickness=thickness,
        exponent=exponent,
    )
    return found[0]


def collide_all(
    *,
    m1: Quantity,
    m2: Quantity,
    speed: Quantity,
    stiffness: Quantity | None = None,
    restitution: float = 0.65,
    restitution_is: str = "input",
) -> Answers[Collision]:
    """Returns the same collision under every law, with equal secant stiffness at the greatest elastic Hertz indentation.

    Laws that cannot realise the restitution are omitted. Arguments as for :func:`collide`.

    Examples:
        >>> import jostle
        >>> len(jostle.collide_all(m1="40 t", m2="60 t", speed="0.4 m/s")) > 5
        True
    """
    return Answers(_collide(
        None,
        m1=m1,
        m2=m2,
        speed=speed,
        stiffness=stiffness,
        restitution=restitution,
        restitution_is=restitution_is,
    ))


def _collide(law: str | None, **given: object) -> list[Collision]:
    options: dict[str, str] = {}
    for name, value in given.items():
        if value is None:
            continue
        if isinstance(value, (list, tuple)):
            raise TypeError(f"{name}: expected a text with a unit or a number in SI, found {type(value).__name__}")
        options[name] = option_text(name, value)
    found = _jostle.collide(law, options)
    return [_collision(json.loads(numbers), curve) for numbers, curve in found]


def _collision(numbers: dict[str, Any], curve: npt.NDArray[np.float64]) -> Collision:
    variant = numbers["variant"]
    return Collision(
        law=numbers["law"] if variant is None else f"{numbers['law']} ({variant})",
        stiffness=numbers["stiffness"],
        restitution=numbers["restitution"],
        impact_speed=numbers["impact_speed_m_s"],
        separation_speed=numbers["separation_speed_m_s"],
        realised_restitution=numbers["realised_restitution"],
        peak_force=numbers["peak_force_n"],
        peak_indentation=numbers["peak_indentation_m"],
        duration=numbers["duration_s"],
        impulse=numbers["impulse_n_s"],
        dissipated=numbers["dissipated_j"],
        time=curve[0],
        indentation=curve[1],
        rate=curve[2],
        force=curve[3],
    )


def _of_own(law: ContactLaw, masses: list[float], speed: float) -> Collision:
    """Runge-Kutta steps of order four, halved until the course of the collision no longer changes by 1e-9."""
    import numpy as np

    if not (min(masses) > 0.0 and speed > 0.0):
        raise ModelError("m1, m2 and speed must be greater than zero")
    mass = masses[0] * masses[1] / (masses[0] + masses[1])

    def force(indentation: float, rate: float) -> float:
        # A step that overshoots the end of the contact is cut back later.
        value = float(law.force(max(indentation, 0.0), rate, speed))
        if not np.isfinite(value):
            raise AnalysisError(
                f"{law.name}: the force is {value} at an indentation of {indentation} m and a rate of {rate} m/s"
            )
        return value

    # A first step from the stiffness at an indentation that is surely small.
    small = 1e-6 * speed
    scale = max(abs(force(small, speed)) / small, 1e-12)
    step = 1e-2 * float(np.sqrt(mass / scale))
    course = _walk(force, mass, speed, step)
    for _ in range(30):
        finer = _walk(force, mass, speed, 0.5 * step)
        change = abs(finer[2][-1] - course[2][-1]) / speed
        change += abs(np.max(finer[1]) / np.max(course[1]) - 1.0)
        course, step = finer, 0.5 * step
        if change < 1e-9 or len(course[0]) > 200_000:
            break
    time, indentation, rate, forces = (np.array(row) for row in course)
    separation = -rate[-1]
    return Collision(
        law=law.name,
        stiffness=None,
        restitution=None,
        impact_speed=speed,
        separation_speed=float(separation),
        realised_restitution=float(separation / speed),
        peak_force=float(np.max(forces)),
        peak_indentation=float(np.max(indentation)),
        duration=float(time[-1]),
        impulse=mass * (speed + float(separation)),
        dissipated=0.5 * mass * (speed**2 - float(separation) ** 2),
        time=time,
        indentation=indentation,
        rate=rate,
        force=forces,
    )


def _walk(
    force: Callable[[float, float], float], mass: float, speed: float, step: float
) -> tuple[list[float], list[float], list[float], list[float]]:
    """The course in equal steps; the last is shortened so that it ends at an indentation of zero."""

    def stepped(x: float, v: float, h: float) -> tuple[float, float]:
        a1 = -force(x, v) / mass
        x2, v2 = x + 0.5 * h * v, v + 0.5 * h * a1
        a2 = -force(x2, v2) / mass
        x3, v3 = x + 0.5 * h * v2, v + 0.5 * h * a2
        a3 = -force(x3, v3) / mass
        x4, v4 = x + h * v3, v + h * a3
        a4 = -force(x4, v4) / mass
        return x + h * (v + 2 * v2 + 2 * v3 + v4) / 6, v + h * (a1 + 2 * a2 + 2 * a3 + a4) / 6

    x, v, t = 0.0, speed, 0.0
    rows: tuple[list[float], list[float], list[float], list[float]] = ([t], [x], [v], [force(x, v)])
    for _ in range(4_000_000):
        following = stepped(x, v, step)
        length = step
        if following[0] <= 0.0:
            low, high = 0.0, step
            while high - low > 1e-15 * step and 0.5 * (low + high) not in (low, high):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if stepped(x, v, middle)[0] > 0.0 else (low, middle)
            length = high
            following = stepped(x, v, length)
        x, v, t = *following, t + length
        for row, value in zip(rows, (t, max(x, 0.0), v, force(max(x, 0.0), v))):
            row.append(value)
        if x <= 1e-15 * speed and v <= 0.0:
            return rows
    raise AnalysisError("the masses do not come apart: does the force press them apart?")
