"""A figure for matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ._result import Result


def figure(result: Result) -> Figure:
    """Roof displacements, contact forces and ground acceleration over time."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("plot() needs matplotlib: pip install 'jostle[plot]'") from None
    from ._draw import colour, contact_name

    struck = sorted(
        (contact for contact in result.contacts if contact.impact_count),
        key=lambda contact: -contact.peak_force,
    )[:7]
    drawn = plt.figure(figsize=(9, 7.5 if struck else 5.5), layout="constrained")
    axes = drawn.subplots(3 if struck else 2, 1, sharex=True)
    time, buildings = result.time, result.summary["buildings"]
    for index, building in enumerate(buildings):
        roof = result.floor(index, -1).displacement
        axes[0].plot(time, 1e3 * roof, color=colour(index), lw=1, label=f"{building['name']} roof")
    axes[0].set_ylabel("displacement [mm]")
    for index, contact in enumerate(struck):
        label = contact_name(contact)
        axes[1].plot(time, 1e-3 * contact.force, color=colour(index), lw=1, label=label)
        axes[1].set_ylabel("contact force [kN]")
    axes[-1].plot(time, result.ground_acceleration, color="0.35", lw=0.8)
    axes[-1].set_ylabel("ground [m/s²]")
    axes[-1].set_xlabel("time [s]")
    for axis in axes[:-1]:
        axis.legend(loc="upper right", fontsize="small", frameon=False)
    for axis in axes:
        axis.grid(alpha=0.25)
        axis.margins(x=0)
    drawn.suptitle(result.summary["title"])
    if "inline" in plt.get_backend():
        plt.close(drawn)  # A notebook shows what a cell returns; it must not show it twice.
    return drawn
