"""One collision under every contact law, and under one of your own.

Two floors of 40 t and 60 t meet at 0.4 m/s; every law is asked to rebound with 0.65 really, not only in its formula.
"""

# %%
from typing import Any

import matplotlib.pyplot as plt

import jostle

floors: dict[str, Any] = {"m1": "40 t", "m2": "60 t", "speed": "0.4 m/s"}

# %% The published laws, calibrated.
met = jostle.collide_all(**floors, stiffness="2e9 N/m^1.5", restitution=0.65, restitution_is="realised")
print(f"{'law':36} {'rebound':>8} {'peak [kN]':>10} {'lasts [ms]':>11}")
for one in met:
    peak = "–" if one.peak_force is None else f"{1e-3 * one.peak_force:.0f}"
    print(f"{one.law:36} {one.realised_restitution:8.3f} {peak:>10} {1e3 * one.duration:11.2f}")


# %% One of your own: a stiffness that grows with the indentation, and some friction.
def hardening(indentation: float, rate: float, impact_speed: float) -> float:
    """Force [N] of indentation [m], its rate [m/s] and the speed at the touch [m/s]."""
    spring = 80e6 * indentation * (1 + (indentation / 4e-3) ** 2)
    return spring * (1 + 0.3 * rate / impact_speed)


own = jostle.collide(jostle.ContactLaw(hardening, name="hardening"), **floors)
print(f"{own.law:36} {own.realised_restitution:8.3f} {1e-3 * (own.peak_force or 0):10.0f}")

# %% Force against indentation: the area inside a loop is what the law dissipates.
figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
for one in [*met, own]:
    axes.plot(1e3 * one.indentation, 1e-3 * one.force, label=one.law)
axes.set(xlabel="indentation [mm]", ylabel="force [kN]")
axes.legend(fontsize="small")
figure.savefig("contact_laws.png", dpi=150)
print("contact_laws.png written")
