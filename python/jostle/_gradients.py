"""How peaks change with the numbers of a model."""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from . import _jostle
from ._model import Model
from ._progress import CountLine


@dataclass(frozen=True)
class Gradient:
    """The derivative of a peak with respect to a number of the model, in SI.

    Attributes:
        of: the peak, by its path in ``summary.json``.
        by: the number, by its path in the model file.
        peak: the peak itself.
        at: the number itself.
        value: the derivative.
        error: error estimate of the derivative: difference between the derivatives for two steps.
        valid_within: greatest change of the number, in either direction, for which the peak stays within 1 % of the linear
            approximation. Changes of 0.1 to 50 % are tried.

    Examples:
        >>> import jostle
        >>> model = jostle.Model.paper_example().changed(gap="20 mm")
        >>> found = jostle.gradients(model, ["motion.pga"])
        >>> shear = next(own for own in found if own.of == "buildings[0].base_shear_peak_n")
        >>> isinstance(shear, jostle.Gradient) and shear.elasticity > 0
        True
    """

    of: str
    by: str
    peak: float
    at: float
    value: float
    error: float
    valid_within: float

    @property
    def elasticity(self) -> float:
        """Relative change of the peak divided by the relative change of the number; 0 if the peak is zero."""
        return self.value * self.at / self.peak if self.peak else 0.0


def gradients(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    by: Sequence[str],
    *,
    progress: bool | Callable[[float, float], object] = False,
) -> list[Gradient]:
    """Computes the derivatives of every peak with respect to numbers of a model, like ``jostle run --gradients``.

    The result also states the range in which each derivative is valid.

    The model is run 22 times for each number, with slightly smaller and larger values.

    Args:
        model: the model, its file, the name of a built-in model, or a tree.
        by: paths of numbers of the model, such as ``["gap[0].width", "motion.pga"]``.
        progress: true shows a line on a terminal; or a function called with the numbers of finished runs and of all runs.

    Raises:
        ModelError: a path does not lead to a nonzero number.
        AnalysisError: the model does not run to its end.

    Examples:
        >>> import jostle
        >>> model = jostle.Model.paper_example().changed(gap="20 mm")
        >>> found = {own.of: own for own in jostle.gradients(model, ["gap[0].width"])}
        >>> found["gaps[0].peak_force_n"].at
        0.02
    """
    observer = None if isinstance(progress, bool) else progress
    with CountLine("runs") if progress is True else contextlib.nullcontext() as line:
        observer = observer if line is None else line
        found = _jostle.gradients(Model.from_any(model)._base(), list(by), observer)
    return [Gradient(**own) for own in json.loads(found)]
