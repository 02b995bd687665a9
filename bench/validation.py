"""OpenSees' answers for the models in the validation's data, stored beside them."""

import json
from pathlib import Path

import programs
from cases import Case

FOLDER = Path(__file__).resolve().parent.parent / "crates/jostle-validation/data/opensees"
# Steps in free vibration; a tenth of that near contact [s]. Corners in plan slide off at ends of steps.
FREE = 5e-4
FREE_IN_PLAN = 1e-4
# Half of that where the force of a blow moves by more than 3e-4.
HALVED = {"damping_tangent", "fibres", "grounds"}
# So many times as long for models of many equations; panels fall at ends of steps.
LONGER = {
    "continuous": 0.2,
    "falling": 0.2,
    "pendulums": 0.2,
    "plan_askew": 4,
    "plan_base": 5,
    "plan_failing": 2,
    "plan_falling": 2,
    "plan_frames": 2,
    "plan_links": 2,
    "plan_space_frames": 4,
    "plan_uplift": 5,
    "uplift": 2,
}


def stored(answer, free):
    """What the validation compares."""
    return {
        "how": "OpenSeesPy on the script that jostle exports of the model beside this file; made by: bench/run --validation",
        "version": answer["version"],
        "free_step_s": free,
        "contact_step_s": free / 10,
        "failed_steps": answer["work"]["failed_steps"],
        "buildings": answer["buildings"],
        **({"faces": answer["faces"]} if "faces" in answer else {"contacts": answer["contacts"]}),
        **({"links": answer["links"]} if answer["links"] else {}),
    }


def compare(own, answer):
    worst = 0.0
    in_plan = "faces" in answer
    keys = ["displacement_max_m", "displacement_min_m"]
    if in_plan:
        keys += ["displacement_across_max_m", "displacement_across_min_m", "rotation_max_rad", "rotation_min_rad"]
    for ours, theirs in zip(own["buildings"], answer["buildings"]):
        known = {floor["floor"]: floor for floor in ours["floors"]}
        for b in theirs["floors"]:
            a = known[b["floor"]]
            worst = max(worst, *(abs(a[key] / b[key] - 1.0) for key in keys if abs(b[key]) > 1e-9))
    print(f"peak displacements: at most {worst:.2e} apart")
    contacts = [contact for gap in own["gaps"] for contact in gap["contacts"]]
    for ours, theirs in zip(contacts, answer["faces" if in_plan else "contacts"]):
        if theirs["impact_count"]:
            apart = ours["peak_force_n"] / theirs["peak_force_n"] - 1.0
            print(f"floors {theirs['floors']}: {ours['peak_force_n']:.0f} N, OpenSees {theirs['peak_force_n']:.0f} N, {apart:+.2e}; impacts {ours['impact_count']}, {theirs['impact_count']}")


def main(say):
    # Cases with a script of their own are made by it.
    for path in sorted(path for path in FOLDER.glob("*.toml") if not path.with_suffix(".py").exists()):
        case = Case(path.stem, path.stem, path.name)
        free = FREE_IN_PLAN if path.stem.startswith("plan") else FREE
        free *= 0.5 if path.stem in HALVED else LONGER.get(path.stem, 1)
        say(f"{path.stem}: OpenSees with steps of {1e3 * free:g} ms; this takes minutes")
        answer = programs.opensees(case, free, 10, "ties")["result"]
        target = path.with_suffix(".json")
        target.with_suffix(".tmp").write_text(json.dumps(stored(answer, free), indent=1) + "\n")
        target.with_suffix(".tmp").replace(target)
        compare(programs.jostle(case, tolerance=1e-4, least=0.0)["summary"], answer)
    return 0
