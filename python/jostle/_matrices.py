"""Full matrices of a building, for further calculations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._model import Model


@dataclass(frozen=True, eq=False)
class Matrices:
    """M ü + C u̇ + K u = −driven_mass · a_g + contact forces, for one building of ``n`` degrees of freedom.

    Displacements are relative to the ground; massless degrees of freedom have zeros in ``mass``.

    Attributes:
        mass: diagonal of M [kg, kg·m²], shape ``(n,)``.
        damping: C, shape ``(n, n)``.
        stiffness: K, P-Delta and base springs included, shape ``(n, n)``.
        driven_mass: mass on which the horizontal ground acceleration acts [kg], shape ``(n,)``.
        floors: degree of freedom of the horizontal displacement of every floor from the ground up.

    Examples:
        >>> import jostle
        >>> tower = jostle.Shear("A", mass="40 t", stiffness="60 MN/m", storeys=2, storey_height="3 m")
        >>> jostle.Model([tower]).matrices("A").stiffness.shape
        (2, 2)
    """

    mass: npt.NDArray[np.float64]
    damping: npt.NDArray[np.float64]
    stiffness: npt.NDArray[np.float64]
    driven_mass: npt.NDArray[np.float64]
    floors: list[int]


def of_model(model: Model, building: str | int) -> Matrices:
    names = model.buildings
    if isinstance(building, str):
        if building not in names:
            raise KeyError(f"there is no building {building!r}; the model has {', '.join(names)}")
        index = names.index(building)
    else:
        index = range(len(names))[building]
    mass, stiffness, damping, driven, floors = model._core.matrices(index)
    return Matrices(mass, damping, stiffness, driven, floors)
