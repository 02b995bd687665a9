"""Capacity curves."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._answers import Answers
from ._model import Model
from ._units import Quantity, in_si

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class CapacityCurve:
    """The capacity curve of a building; ``p`` points, ``f`` floors.

    Attributes:
        building: name.
        direction: ``"right"`` or ``"left"``.
        roof_displacement: in the direction of the load [m], shape ``(p,)``.
        roof_drift: roof displacement over height [–], shape ``(p,)``.
        base_shear: base shear [N], shape ``(p,)``.
        base_shear_coefficient: base shear over weight [–], shape ``(p,)``.
        storey_drifts: drift ratios from the ground up [–], shape ``(p, f)``.
        events: at each point, hinges that crack or yield.
        end: reason for the end of the curve.
        tree: all results, as in ``jostle pushover --json``.

    Examples:
        >>> import jostle
        >>> (curve,) = jostle.pushover(jostle.Model.example("paper-inelastic"), building="J1")
        >>> curve.base_shear.shape == curve.roof_drift.shape
        True
    """

    building: str
    direction: str
    roof_displacement: npt.NDArray[np.float64]
    roof_drift: npt.NDArray[np.float64]
    base_shear: npt.NDArray[np.float64]
    base_shear_coefficient: npt.NDArray[np.float64]
    storey_drifts: npt.NDArray[np.float64]
    events: list[list[dict[str, str]]]
    end: str
    tree: dict[str, Any]

    def __repr__(self) -> str:
        peak = max(self.base_shear)
        return f"<CapacityCurve {self.building!r} to the {self.direction}, peak {peak:.4g} N>"

    def _repr_html_(self) -> str:
        from ._draw import history_svg

        title = f"{self.building}: base shear over roof drift"
        curve = (self.direction, 1e2 * self.roof_drift, self.base_shear)
        return history_svg(title, "N", [curve], abscissa=" %")


def pushover(
    model: Model,
    *,
    building: str | None = None,
    pattern: str = "first-mode",
    direction: str = "right",
    drift: Quantity = 0.02,
) -> Answers[CapacityCurve]:
    """Computes capacity curves of buildings, from corner to corner of their hinges.

    Args:
        model: the model.
        building: one building by name; by default all.
        pattern: distribution of the load: ``"first-mode"``, ``"uniform"`` or ``"triangular"``.
        direction: ``"right"``, ``"left"`` or ``"both"``.
        drift: roof displacement over height at which to stop, above 0 and up to 0.5.

    Raises:
        ModelError: an invalid argument.

    Examples:
        >>> import jostle
        >>> curves = jostle.pushover(jostle.Model.example("paper-inelastic"), drift=0.01)
        >>> [curve.building for curve in curves]
        ['J1', 'J2']
    """
    if not isinstance(model, Model):
        raise TypeError(f"model: expected a Model, found {type(model).__name__}")
    for name, value in (("pattern", pattern), ("direction", direction)):
        if not isinstance(value, str):
            raise TypeError(f"{name}: expected a text, found {type(value).__name__}")
    ratio = in_si("drift", drift, "number")
    text = model._core.pushover(building, pattern, direction, ratio)
    return Answers(_curve(tree) for tree in json.loads(text)["curves"])


def _curve(tree: dict[str, Any]) -> CapacityCurve:
    import numpy as np

    points = tree["points"]

    def column(key: str) -> npt.NDArray[np.float64]:
        return np.array([point[key] for point in points], dtype=np.float64)

    return CapacityCurve(
        building=tree["building"],
        direction=tree["direction"],
        roof_displacement=column("roof_displacement_m"),
        roof_drift=column("roof_drift"),
        base_shear=column("base_shear_n"),
        base_shear_coefficient=column("base_shear_coefficient"),
        storey_drifts=column("storey_drifts"),
        events=[point["events"] for point in points],
        end=tree["end"]["reason"],
        tree=tree,
    )
