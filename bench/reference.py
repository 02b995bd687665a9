"""What each program converges to, and the cheapest settings with which OpenSees comes close enough."""

import json
from pathlib import Path

import programs

PATH = Path(__file__).resolve().parent / "reference.json"
# Distance from its own converged greatest force at which a program counts as accurate.
MATCHED = 1e-3


def load():
    return json.loads(PATH.read_text()) if PATH.exists() else {}


def store(references):
    text = json.dumps(references, indent=1, ensure_ascii=False, sort_keys=True) + "\n"
    temporary = PATH.with_suffix(".tmp")
    temporary.write_text(text)
    temporary.replace(PATH)


def extrapolated(coarse, fine, ratio=4.0):
    """The limit of a second-order method from two steps, one twice the other."""
    return fine + (fine - coarse) / (ratio - 1.0)


def refine(case, say):
    """Converged greatest forces and the settings for OpenSees."""
    say(f"{case.name}: jostle at tolerances 1e-5 and 1e-6")
    own = {tolerance: programs.jostle(case, case.solvers[0], tolerance, least=0.0) for tolerance in (1e-5, 1e-6)}
    converged = own[1e-6]["peak_force_n"]
    reference = {
        "command": f"bench/run --reference {case.name}",
        "jostle": {
            "peak_force_n": converged,
            "uncertainty": abs(own[1e-5]["peak_force_n"] / converged - 1.0),
        },
    }
    tried = {}

    def opensees(free, parts, axial="stiff"):
        key = f"{free:g}/{parts}/{axial}"
        if key not in tried:
            run = programs.opensees(case, free, parts, axial)
            tried[key] = {name: run[name] for name in ("peak_force_n", "cpu_s", "steps", "short_steps", "impacts", "complete", "failed_steps", "version")}
            say(f"{case.name}: OpenSees {key}: {run['peak_force_n']:.1f} N, {run['cpu_s']:.1f} s")
        return tried[key]

    free, parts = case.free_steps[-1], 10
    coarse, fine = opensees(free, parts), opensees(free / 2, parts)
    limit = extrapolated(coarse["peak_force_n"], fine["peak_force_n"])
    reference["opensees"] = {
        "peak_force_n": limit,
        "uncertainty": abs(fine["peak_force_n"] / limit - 1.0),
        "how": f"extrapolated from free-vibration steps of {free:g} and {free / 2:g} s, a tenth of that near contact",
        "version": fine["version"],
        "tried": tried,
    }
    settings = [(f, p) for f in case.free_steps for p in case.parts]
    good = []
    for free, parts in settings:
        run = opensees(free, parts)
        if run["complete"] and abs(run["peak_force_n"] / limit - 1.0) <= MATCHED:
            good.append((run["cpu_s"], free, parts))
    if good:
        _, free, parts = min(good)
        reference["opensees"]["settings"] = {"free": free, "parts": parts, "axial": "stiff"}
        ties = opensees(free, parts, "ties")
        if abs(ties["peak_force_n"] / limit - 1.0) <= MATCHED and ties["cpu_s"] < min(good)[0]:
            reference["opensees"]["settings"]["axial"] = "ties"
    return reference

