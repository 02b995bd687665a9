"""Pounding with a contact law written in Python."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._collide import ContactLaw
from ._errors import AnalysisError, ModelError
from ._model import Model
from ._units import Quantity, in_si

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

#: More degrees of freedom than this make full matrices unreasonable.
_MOST = 3000
#: Corrections of the contact forces within a step.
_CORRECTIONS = 60


@dataclass(frozen=True, eq=False)
class Experiment:
    """Results of a run with a user-defined contact law; ``t`` instants, ``c`` contacts.

    Attributes:
        time: instants [s], shape ``(t,)``.
        displacement: floors by building, from the ground up [m], each of shape ``(t, floors)``.
        contact_force: forces of the contacts, gap by gap, from the lowest up [N], shape ``(t, c)``.
        closing: closing of each contact [m], shape ``(t, c)``; contact starts when it exceeds the width of the gap.

    Examples:
        >>> import jostle
        >>> law = jostle.ContactLaw(lambda indentation, rate, speed: 8e7 * indentation)
        >>> soft = jostle.Shear("soft", mass=["40 t"], stiffness=["8 MN/m"], storey_height="3 m")
        >>> stiff = jostle.Shear("stiff", mass=["60 t"], stiffness=["60 MN/m"], storey_height="3 m")
        >>> pulse = jostle.Motion.ricker(amplitude="3 m/s2", period="0.6 s", duration="1 s")
        >>> pair = jostle.Model([soft, stiff], jostle.Gap("5 mm"), motion=pulse)
        >>> jostle.experiment(pair, law, step="1 ms").peak_force > 0
        True
    """

    time: npt.NDArray[np.float64]
    displacement: dict[str, npt.NDArray[np.float64]]
    contact_force: npt.NDArray[np.float64]
    closing: npt.NDArray[np.float64]

    @property
    def peak_force(self) -> float:
        """Greatest contact force [N]."""
        return float(self.contact_force.max(initial=0.0))


def experiment(model: Model, law: ContactLaw, *, step: Quantity = 1e-4) -> Experiment:
    """Runs a small elastic model with a contact law written in Python at every contact.

    It uses average acceleration in equal steps with full matrices, and Newton's method for the forces of closed contacts. It
    is slow and intended for testing laws. Ten to a hundred steps per contact are needed; halve the step to estimate the
    error.

    Args:
        model: the model; its contact laws are not used.
        law: the law.
        step: time step.

    Raises:
        ModelError: a building that may yield, or is too large.
        AnalysisError: the contact forces do not converge.

    Examples:
        >>> import jostle
        >>> law = jostle.ContactLaw(lambda indentation, rate, speed: 8e7 * indentation)
        >>> soft = jostle.Shear("soft", mass=["40 t"], stiffness=["8 MN/m"], storey_height="3 m")
        >>> stiff = jostle.Shear("stiff", mass=["60 t"], stiffness=["60 MN/m"], storey_height="3 m")
        >>> pulse = jostle.Motion.ricker(amplitude="3 m/s2", period="0.6 s", duration="1 s")
        >>> pair = jostle.Model([soft, stiff], jostle.Gap("5 mm"), motion=pulse)
        >>> jostle.experiment(pair, law, step="1 ms").peak_force > 0
        True
    """
    import numpy as np

    if not isinstance(law, ContactLaw):
        raise TypeError(f"law: expected a ContactLaw, found {type(law).__name__}")
    h = in_si("step", step, "time")
    if not h > 0.0:
        raise ModelError(f"step: must be greater than zero, found {h} s")
    motion = model.motion
    if motion is None:
        raise ModelError("the model has no ground motion")
    if motion._core.has_own_grounds:
        raise ModelError(
            "motion: a law of your own needs one ground under all buildings; leave out arrival, position, "
            "the motion of buildings and vertical"
        )
    parts = [model.matrices(name) for name in model.buildings]
    offsets = np.cumsum([0] + [len(part.mass) for part in parts])
    if offsets[-1] > _MOST:
        raise ModelError(f"the model has {offsets[-1]} degrees of freedom; at most {_MOST} here")
    n = int(offsets[-1])
    mass, driven = (
        np.concatenate([getattr(part, key) for part in parts]) for key in ("mass", "driven_mass")
    )
    damping, stiffness, compliance = (np.zeros((n, n)) for _ in range(3))
    for part, start in zip(parts, offsets):
        own = slice(start, start + len(part.mass))
        damping[own, own], stiffness[own, own] = part.damping, part.stiffness
        effective = part.stiffness + 2.0 / h * part.damping + np.diag(4.0 / h**2 * part.mass)
        compliance[own, own] = np.linalg.inv(effective)
    links = model._core.links()
    for one, other, spring, dashpot in links:
        apart = np.zeros(n)
        for dof, sign in ((one, -1.0), (other, 1.0)):
            if dof is not None:
                apart[dof] = sign
        stiffness += spring * np.outer(apart, apart)
        damping += dashpot * np.outer(apart, apart)
    if links:
        compliance[:] = np.linalg.inv(stiffness + 2.0 / h * damping + np.diag(4.0 / h**2 * mass))
    contacts = model._core.contacts()
    widths = np.array([width for *_, width in contacts])
    # Column c: where a unit force of contact c pushes.
    pushes = np.zeros((n, len(contacts)))
    for c, (_, left, right, _) in enumerate(contacts):
        # A wall stands still relative to the ground.
        for dof, sign in ((left, -1.0), (right, 1.0)):
            if dof is not None:
                pushes[dof, c] = sign
    answers = compliance @ pushes
    steps = int(round(motion.duration / h))
    time = h * np.arange(steps + 1, dtype=np.float64)
    ground = motion.at(time)
    u, v, a = np.zeros(n), np.zeros(n), np.zeros(n)
    moving = mass > 0.0
    a[moving] = -driven[moving] * ground[0] / mass[moving]
    forces, speeds = np.zeros(len(contacts)), np.zeros(len(contacts))
    floors = [np.array(part.floors) + start for part, start in zip(parts, offsets)]
    shown = [np.zeros((steps + 1, len(floor))) for floor in floors]
    pressed, closed = np.zeros((steps + 1, len(contacts))), np.zeros((steps + 1, len(contacts)))
    for k in range(1, steps + 1):
        load = -driven * ground[k] + mass * (4.0 / h**2 * u + 4.0 / h * v + a)
        load += damping @ (2.0 / h * u + v)
        free = compliance @ load
        forces = _forces(law, forces, speeds, pushes, answers, widths, (u, v, free), h)
        new = free + answers @ forces
        rate = 2.0 / h * (new - u) - v
        a = 4.0 / h**2 * (new - u) - 4.0 / h * v - a
        u, v = new, rate
        pressed[k], closed[k] = forces, -(pushes.T @ u)
        for row, floor in zip(shown, floors):
            row[k] = u[floor]
    return Experiment(time, dict(zip(model.buildings, shown)), pressed, closed)


def _forces(
    law: ContactLaw,
    forces: npt.NDArray[np.float64],
    speeds: npt.NDArray[np.float64],
    pushes: npt.NDArray[np.float64],
    answers: npt.NDArray[np.float64],
    widths: npt.NDArray[np.float64],
    state: tuple[npt.NDArray[np.float64], ...],
    h: float,
) -> npt.NDArray[np.float64]:
    """Contact forces at the end of a step; ``speeds`` stores the impact speeds."""
    import numpy as np

    u, v, free = state
    before, rate_before = -(pushes.T @ u) - widths, -(pushes.T @ v)
    unpressed = -(pushes.T @ free) - widths
    if np.all(unpressed <= 0.0) and np.all(before <= 0.0):
        speeds[:] = 0.0
        return np.zeros_like(forces)
    softness = pushes.T @ answers
    found = forces.copy()
    for _ in range(_CORRECTIONS):
        indentation = unpressed - softness @ found
        rate = 2.0 / h * (indentation - before) - rate_before
        for c in range(len(found)):
            if indentation[c] <= 0.0:
                speeds[c] = 0.0
            elif speeds[c] == 0.0:
                speeds[c] = max(rate_before[c] if before[c] <= 0.0 else rate[c], 1e-9)
        wanted, slope = np.zeros_like(found), np.zeros_like(found)
        for c in map(int, np.flatnonzero(indentation > 0.0)):
            d, r, s = float(indentation[c]), float(rate[c]), float(speeds[c])
            wanted[c] = law.force(d, r, s)
            tiny = 1e-6 * max(d, 1e-9)
            slope[c] = (law.force(d + tiny, r + 2.0 / h * tiny, s) - wanted[c]) / tiny
        missing = wanted - found
        if not np.all(np.isfinite(missing)):
            raise AnalysisError(f"{law.name}: the force is not a finite number")
        if np.all(np.abs(missing) <= 1e-9 * (1.0 + np.abs(wanted))):
            return found
        found = found + np.linalg.solve(np.eye(len(found)) + slope[:, None] * softness, missing)
    raise AnalysisError(f"{law.name}: the contact forces are not found; take a shorter step")
