"""Natural modes."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._model import Model

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class BuildingModes:
    """Natural modes of one building, longest period first; ``n`` modes, ``f`` floors.

    Attributes:
        name: name of the building.
        periods: periods [s], shape ``(n,)``.
        circular_frequencies: ω [rad/s], shape ``(n,)``.
        effective_mass_ratios_x: fraction of the mass that moves horizontally [–], shape ``(n,)``.
        effective_mass_ratios_y: fraction of the mass that moves vertically [–], shape ``(n,)``.
        effective_mass_ratios_across: with a plan, fraction of the mass that moves across [–], shape ``(n,)``; 0 without a plan.
        effective_mass_ratios_torsion: with a plan, fraction of the polar mass that rotates [–], shape ``(n,)``; 0 without a plan.
        lateral: whether the mode is lateral (at least 1 % of the mass horizontally), shape ``(n,)``.
        floor_shapes: horizontal shapes at the floors from the ground up, the greatest ±1 [–], shape ``(n, f)``.
        lateral_periods: periods of the lateral modes, at most ``count`` [s].

    Examples:
        >>> import jostle
        >>> jostle.modes(jostle.Model.paper_example(), count=3)["J1"].periods.round(3)
        array([0.841, 0.271, 0.155])
    """

    name: str
    periods: npt.NDArray[np.float64]
    circular_frequencies: npt.NDArray[np.float64]
    effective_mass_ratios_x: npt.NDArray[np.float64]
    effective_mass_ratios_y: npt.NDArray[np.float64]
    effective_mass_ratios_across: npt.NDArray[np.float64]
    effective_mass_ratios_torsion: npt.NDArray[np.float64]
    lateral: npt.NDArray[np.bool_]
    floor_shapes: npt.NDArray[np.float64]
    lateral_periods: npt.NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.periods)

    def _repr_html_(self) -> str:
        from ._draw import modes_html

        return modes_html(self)


def modes(model: Model, count: int = 10) -> dict[str, BuildingModes]:
    """Natural modes of every building, by name.

    No mode is missed: frequencies are found by counting negative pivots of the Riccati recursion, shapes by inverse
    iteration.

    Args:
        model: the model.
        count: modes to find for every building, 1 to 10 000.

    Raises:
        AnalysisError: the modes were not found.

    Examples:
        >>> import jostle
        >>> list(jostle.modes(jostle.Model.paper_example(), count=2))
        ['J1', 'J2']
    """
    if not isinstance(model, Model):
        raise TypeError(f"model: expected a Model, found {type(model).__name__}")
    if isinstance(count, bool) or not 1 <= count <= 10_000:
        raise ValueError(f"count: must lie between 1 and 10000, found {count}")
    tree = json.loads(model._core.modes(count))
    return {building["name"]: _building(building) for building in tree["buildings"]}


def _building(building: dict[str, Any]) -> BuildingModes:
    import numpy as np

    listed = building["modes"]

    def column(key: str) -> npt.NDArray[np.float64]:
        return np.array([mode[key] for mode in listed], dtype=np.float64)

    return BuildingModes(
        name=building["name"],
        periods=column("period_s"),
        circular_frequencies=column("circular_frequency_rad_s"),
        effective_mass_ratios_x=column("effective_mass_ratio_x"),
        effective_mass_ratios_y=column("effective_mass_ratio_y"),
        effective_mass_ratios_across=column("effective_mass_ratio_across"),
        effective_mass_ratios_torsion=column("effective_mass_ratio_torsion"),
        lateral=np.array([mode["lateral"] for mode in listed], dtype=np.bool_),
        floor_shapes=column("floor_shape"),
        lateral_periods=np.array(building["periods_s"], dtype=np.float64),
    )
