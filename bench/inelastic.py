"""OpenSees' answer for the yielding frames, stored as reference data of the validation."""

import json
from pathlib import Path

import programs
from cases import CASES

PATH = Path(__file__).resolve().parent.parent / "crates/jostle-validation/data/opensees/inelastic.json"
# Steps in free flight; a tenth of that near contact [s].
FREE = 5e-4


def main(say):
    case = next(case for case in CASES if case.name == "inelastic")
    own = programs.jostle(case, tolerance=1e-4, least=0.0)["summary"]
    say(f"OpenSees with steps of {1e3 * FREE:g} ms: this takes minutes")
    run = programs.opensees(case, FREE, 10, "ties")
    answer = run["result"]
    for contact in answer["contacts"]:
        contact.pop("first_impact_s", None) if not contact["impact_count"] else None
    stored = {
        "how": "OpenSeesPy on the script that jostle exports of inelastic.toml beside this file; made by: bench/run --inelastic",
        "version": answer["version"],
        "free_step_s": FREE,
        "contact_step_s": FREE / 10,
        "failed_steps": answer["work"]["failed_steps"],
        "buildings": answer["buildings"],
        "contacts": answer["contacts"],
    }
    PATH.parent.mkdir(parents=True, exist_ok=True)
    PATH.write_text(json.dumps(stored, indent=1) + "\n")
    (PATH.parent / "inelastic.toml").write_text(Path(programs.model_of(case)).read_text())
    worst = 0.0
    for ours, theirs in zip(own["buildings"], answer["buildings"]):
        for a, b in zip(ours["floors"], theirs["floors"]):
            worst = max(worst, *(abs(a[key] / b[key] - 1.0) for key in ("displacement_max_m", "displacement_min_m")))
    print(f"peak displacements: at most {worst:.2e} apart")
    contacts = [contact for gap in own["gaps"] for contact in gap["contacts"]]
    for ours, theirs in zip(contacts, answer["contacts"]):
        if theirs["impact_count"]:
            apart = ours["peak_force_n"] / theirs["peak_force_n"] - 1.0
            print(f"floors {theirs['floors']}: {ours['peak_force_n']:.0f} N, OpenSees {theirs['peak_force_n']:.0f} N, {apart:+.2e}; impacts {ours['impact_count']}, {theirs['impact_count']}")
    return 0
