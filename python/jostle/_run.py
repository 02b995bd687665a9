"""One analysis."""

from __future__ import annotations

import contextlib
import os
import time as clock
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import _jostle
from ._errors import AnalysisError, InterruptedWarning, JostleWarning
from ._model import Model
from ._motion import Motion
from ._progress import Observer, ProgressLine
from ._result import Result
from ._units import Quantity, RunUnits, in_si, refuse, split

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: A second Ctrl-C this soon after one that stopped a run is an ordinary one [s].
_SOON = 2.0
_last_interrupt = float("-inf")
#: Keywords of :func:`run`.
_KEYWORDS = (
    "motion",
    "gap",
    "pga",
    "angle",
    "pounding",
    "without_contact",
    "sensitivity",
    "record_interval",
    "progress",
    "force",
)


def run(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    *,
    motion: Motion | str | os.PathLike[str] | None = None,
    gap: Quantity | None = None,
    pga: Quantity | None = None,
    angle: Quantity | None = None,
    pounding: bool = True,
    without_contact: bool = False,
    sensitivity: bool = False,
    record_interval: Quantity | None = 0.005,
    progress: bool | Observer = False,
    force: bool = False,
    **units: Unpack[RunUnits],
) -> Result:
    """Runs a model from rest through its ground motion.

    Other Python threads continue during a run. The result depends only on the arguments and is bit-identical to that of
    the command line. Ctrl-C stops the run: the result then covers the time until then (``result.completed`` is
    false), with an :class:`InterruptedWarning`; a second Ctrl-C within two seconds raises ``KeyboardInterrupt``.

    Args:
        model: the model, a model file, a built-in name such as ``"paper"``, or the tree of a model file.
        motion: another ground motion; a record by name or path keeps the scaling of the model.
        gap: another width of every gap, a length ≥ 0; also ``gap_mm=20``.
        pga: scales the ground motion to this peak, > 0; also ``pga_g=0.2``.
        angle: angle in plan from x to the motion, counter-clockwise, of buildings with a plan: ``"30 deg"``, or radians.
        pounding: false runs the buildings without contact.
        without_contact: adds a second run without contact, as the command line does for its report; the summary
            then includes the gap needed.
        sensitivity: also runs the model with the lowest and the highest advised contact stiffness and with restitution ± 0.15;
            ``result.summary["contact_sensitivity"]`` then contains the range of forces and the greatest changes for every
            building.
        record_interval: minimum time between recorded instants in free vibration, zero for every step (during contact every
            step is recorded); ``None`` records no histories. Modal stepping makes an additional step for every recorded
            instant, so the last digits of its results depend on this interval.
        progress: true shows the progress of a run that takes more than half a second: a line on a terminal (standard error),
            a bar in a Jupyter notebook, nothing elsewhere. A function is called with the current and the final
            time [s] a few times per second.
        force: runs even if ``solver = "product"`` is expected to lose all digits.

    Raises:
        ModelError: model, motion or an argument is wrong; :class:`MissingFileError` if the model file does not exist.
        TypeError: an unknown keyword, with the nearest known one.
        AnalysisError: a step failed; ``error.result`` has the results up to that step.

    Examples:
        >>> import jostle
        >>> result = jostle.run("paper", gap="10 mm", pga="0.1 g")
        >>> result.completed
        True
    """
    for key in units:
        if not any(split(key, (name,)) for name in ("gap", "pga")):
            refuse("run", (key,), [*_KEYWORDS, *RunUnits.__annotations__])
    model = Model.from_any(model)
    if units or not (motion is None and gap is None and pga is None and angle is None):
        model = model.changed(motion=motion, gap=gap, pga=pga, angle=angle, **units)
    interval = None if record_interval is None else in_si("record_interval", record_interval, "time")
    if interval is not None and interval < 0.0:
        raise ValueError(f"record_interval: must not be negative, found {interval} s")
    core = _walk(
        model, bool(pounding), interval, progress, bool(force), "pounding  ", bool(sensitivity), bool(without_contact)
    )
    result = Result._of(model, core, interval)
    if core.warning is not None:
        warnings.warn(core.warning, JostleWarning, stacklevel=2)
    for text in core.doubts if core.completed else ():
        warnings.warn(text, JostleWarning, stacklevel=2)
    if core.failure is not None:
        raise AnalysisError(core.failure, result)
    if core.interrupted:
        _interrupted(result)
    elif without_contact and pounding:
        twin = _walk(model, False, interval, progress, bool(force), "no contact  ")
        if twin.interrupted:
            _interrupted(result)
        result = Result._of(model, core, interval, twin)
    return result


def _walk(
    model: Model,
    pounding: bool,
    interval: float | None,
    progress: Any,
    force: bool,
    label: str,
    sensitivity: bool = False,
    apart: bool = False,
) -> _jostle.Run:
    line = ProgressLine(label) if progress is True else contextlib.nullcontext()
    with line as shown:
        observer = shown or (progress if callable(progress) else None)
        return _jostle.run(model._core, pounding, interval, force, observer, sensitivity, apart)


def _interrupted(result: Result) -> None:
    """Warns that a run was stopped, or raises at the second Ctrl-C."""
    global _last_interrupt
    now = clock.monotonic()
    soon, _last_interrupt = now - _last_interrupt < _SOON, now
    if soon:
        raise KeyboardInterrupt
    reason = result.summary["ended_early"] or "the run without contact was stopped"
    warnings.warn(
        f"{reason}; the result ends there (Ctrl-C again raises KeyboardInterrupt)",
        InterruptedWarning,
        stacklevel=3,
    )
