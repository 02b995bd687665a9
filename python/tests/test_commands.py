"""Python offers what the command line offers: every command has a function, every option a keyword or a stated reason."""

from __future__ import annotations

import inspect
import json
import re
from functools import reduce

import pytest
from conftest import Program

import jostle
from jostle import _jostle


class Why(str):
    """A stated reason why Python needs no keyword."""


OBJECT = Why("the answer is an object; its tree is what --json prints")
PAGE = Why("the answer has report(path)")
FILES = Why("the answer is in memory; its tables and arrays are saved from there")
FORCE = Why("the method that writes a file has force")
OF_FOOTPRINTS = {"INVENTORY": "path", "--column": "columns", "--metres": "metres", "--reach": "reach"}
OF_MODEL = {
    "MODEL": "model",
    "--pga": "Model.changed:pga",
    "--gap": "Model.changed:gap",
    "--record": "Model.changed:motion",
    "--angle": "Model.changed:angle",
    "--accept-unusual": "Model.load:accept_unusual",
}
RECORD = {
    "RECORD": "Motion.read:path",
    "--unit": "Motion.read:unit",
    "--step": "Motion.read:step",
    "--column": "Motion.read:column",
    "--component": "Motion.read:component",
    "--record-scale": "Motion.read:record_scale",
    "--remove-mean": "Motion.read:remove_mean",
    "--format": "Motion.read:format",
    **{option: "Motion.read:read" for option in ("--skip", "--last", "--per-line", "--content", "--pairs", "--widths")},
}
TARGET = {
    "--target": "DesignSpectrum:file",
    **{
        f"--{key}": f"DesignSpectrum:{key}"
        for key in (
            "code", "intensity", "site", "group", "level", "type", "ground", "ag", "sds", "sd1", "tl", "factor",
        )
    },
}  # fmt: skip
IMPORT = {
    "FILES": "files",
    **{
        f"--{key.replace('_', '-')}": key
        for key in (
            "to", "direction", "by", "gap", "case", "diaphragm", "unit_force", "unit_moment", "units", "force",
        )
    },
}  # fmt: skip
WRITTEN = {"--out": "Motion.save:path", "--force": "Motion.save:force"}

#: Command: its function in Python, and for each argument a keyword of it, another function's (``function:keyword``), a
#: key of the model file (``Model.set:KEY``), or a reason.
TABLE: dict[str, tuple[str, dict[str, str]] | Why] = {
    "run": (
        "run",
        {
            **OF_MODEL,
            "--pga": "pga",
            "--gap": "gap",
            "--record": "motion",
            "--angle": "angle",
            "--out": "Result.save:folder",
            "--no-report": "Result.save:report",
            "--method": "Result.report:method",
            "--members": "Model.set:output.members",
            "--floor-spectra": "Model.set:output.floor_spectra",
            "--capacity": "Model.set:output.capacity",
            "--sensitivity": "sensitivity",
            "--gradients": "gradients:by",
            "--solver": "Model.set:analysis.solver",
            "--pdf": "Result.pdf:path",
            "--paper": "Result.pdf:paper",
            "--xlsx": "Result.to_excel:path",
            "--governing": "run_suite:governing",
            "--jobs": "run_suite:jobs",
            "--json": OBJECT,
            "--force": "force",
        },
    ),
    "check": ("Model.check", {**OF_MODEL, "MODEL": "self", "--out": "Check.save_site:path", "--force": "Check.save_site:force"}),
    "modes": ("modes", {"MODEL": "model", "--count": "count", "--json": OBJECT}),
    "collide": (
        "collide",
        {
            "--law": "law",
            "--formula": "formula",
            "--all": Why("collide_all takes no law"),
            "--m1": "m1",
            "--m2": "m2",
            "--speed": "speed",
            "--stiffness": "stiffness",
            "--restitution": "restitution",
            "--restitution-is": "restitution_is",
            "--damping": "damping",
            "--variant": "variant",
            "--yield-share": "yield_share",
            "--design-speed": "design_speed",
            "--thickness": "thickness",
            "--exponent": "exponent",
            "--csv": FILES,
            "--html": Why("a notebook shows the answer"),
            "--json": OBJECT,
            "--force": FILES,
        },
    ),
    "import etabs": ("import_etabs", IMPORT),
    "import sap2000": ("import_sap2000", IMPORT),
    "import opensees": (
        "import_opensees",
        {
            "SCRIPT": "script",
            "--to": "Model.save:path",
            "--name": "name",
            "--direction": "direction",
            "--side": "side",
            "--units": "units",
            "--port": "ports",
            "--force": "Model.save:force",
        },
    ),
    "city check": ("footprints", {**OF_FOOTPRINTS, "--table": Why("City reads the types with the table of the city file")}),
    "city pairs": ("footprints", {**OF_FOOTPRINTS, "--out": "out"}),
    "city run": (
        "City.run",
        {
            "CITY": "City:path",
            "--out": "out",
            "--draws": "City:draws",
            "--tolerance": "City:tolerance",
            "--shard": "shard",
            "--jobs": "jobs",
        },
    ),
    "city report": ("CityResult.report", {"FOLDER": "CityResult.load:folder"}),
    "city model": (
        "CityResult.model",
        {"FOLDER": "CityResult.load:folder", "--pair": "pair", "--draw": "draw", "--motion": "motion"},
    ),
    "city types": ("city_types", {}),
    "city example": (
        "example_city",
        {"FOLDER": "folder", "--buildings": "buildings", "--seed": "seed", "--force": "force"},
    ),
    "classes": (
        "classes",
        {
            "FILE": "path",
            "--out": "out",
            "--jobs": "jobs",
            "--check": Why("a file that is wrong raises ModelError at once"),
            "--force": "force",
        },
    ),
    "mcp": Why("an assistant starts it as a program"),
    "compare": (
        "compare",
        {
            "MODEL": "model",
            "DATA": "data",
            "--map": "map",
            "--out": "out",
            "--accept-unusual": OF_MODEL["--accept-unusual"],
            "--json": OBJECT,
            "--force": "force",
        },
    ),
    "contact-advice": (
        "contact_advice",
        {
            "MODEL": "model",
            "--mass": "mass",
            "--length": "length",
            "--width": "width",
            "--thickness": "thickness",
            "--concrete": "concrete",
            "--modulus": "modulus",
            "--poisson-ratio": "poisson_ratio",
            "--density": "density",
            "--speed": "speed",
            "--json": OBJECT,
        },
    ),
    "export": ("Model.export", {**OF_MODEL, "MODEL": "self", "--to": "to", "--output": "path", "--force": "force"}),
    "method": ("method", {"MODEL": "model", "--out": "MethodSurvey.report:path", "--force": FORCE}),
    "section": (
        "section",
        {
            "MODEL": "model",
            "--width": "width",
            "--depth": "depth",
            "--bars": "bars",
            "--concrete": "concrete",
            "--steel": "steel",
            "--strength": "strength",
            "--cover": "cover",
            "--ties": "ties",
            "--axial-load": "axial_load",
            "--length": "length",
            "--json": OBJECT,
            "--html": "SectionAnswer.report:path",
            "--force": FORCE,
        },
    ),
    "motion list": ("Motion.builtin", {}),
    "motion show": ("Motion.measures", {**RECORD, "--json": OBJECT, "--html": "Motion.report:path", "--force": "Motion.report:force"}),
    "motion spectrum": (
        "Motion.spectrum",
        {
            **RECORD,
            "--damping": "damping",
            "--periods": "periods",
            "--peaks": "between",
            "--ductility": "ductility",
            "--post-yield": "post_yield",
            "--json": OBJECT,
            "--csv": FILES,
            "--parquet": FILES,
            "--force": FILES,
        },
    ),
    "motion convert": (
        "Motion.processed",
        {
            **RECORD,
            "OUT": "Motion.save:path",
            "--out": "Motion.save:path",
            "--from": "start",
            "--to": "stop",
            "--detrend": "detrend",
            "--detrend-velocity": "detrend_velocity",
            "--high-pass": "high_pass",
            "--low-pass": "low_pass",
            "--order": "order",
            "--resample": "resample",
            "--pad-before": "pad_before",
            "--pad-after": "pad_after",
            "--at-rest": "at_rest",
            "--scale": "scale",
            "--pga": "pga",
            "--force": "Motion.save:force",
        },
    ),
    "motion synth spectrum": (
        "Motion.synth",
        {
            **TARGET,
            **WRITTEN,
            "--step": "step",
            "--record": "Motion.match:self",
            "--seed": "seed",
            "--duration": "duration",
            "--pga": "pga",
            "--periods": "periods",
            "--damping": "damping",
            "--tolerance": "tolerance",
        },
    ),
    "motion synth noise": (
        "Motion.noise",
        {
            **WRITTEN,
            "--step": "step",
            "--pga": "pga",
            "--seed": "seed",
            "--duration": "duration",
            "--frequency": "frequency",
            "--ground-damping": "ground_damping",
            "--corner": "corner",
            "--corner-damping": "corner_damping",
        },
    ),
    "motion synth pulse": (
        "Motion.pulse",
        {
            **WRITTEN,
            "--step": "step",
            "--shape": "shape",
            "--velocity": "velocity",
            "--period": "period",
            "--gamma": "gamma",
            "--phase": "phase",
            "--before": "before",
            "--after": "after",
        },
    ),
    "motion synth recipe": ("Motion.recipe", {**WRITTEN, "NAME": "name"}),
    "motion select": (
        "Motion.select",
        {
            **TARGET,
            "--natural": "natural",
            "--artificial": "artificial",
            "--periods": "periods",
            "--mass-ratios": "mass_ratios",
            "--damping": "damping",
            "--pga": "pga",
            "--unscaled": "unscaled",
            "--json": OBJECT,
            "--html": "Selection.report:path",
            "--force": "Selection.report:force",
        },
    ),
    "study": (
        "Study.run",
        {
            "STUDY": "Study.load:path",
            "MODEL": "Study.ready_made:model",
            "--step": "angles:step",
            "--from": "angles:start",
            "--to": "angles:stop",
            "--quantity": "angles:quantities",
            "--base": "Study.load:model",
            "--out": "out",
            "--jobs": "jobs",
            "--shard": "shard",
            "--case": "Study.run_case:case",
            "--no-report": "report",
            "--csv": "csv",
            "--any-build": "Study.load:any_build",
            "--check": Why("a Study is checked when it is made; cases, columns and varied are its attributes"),
        },
    ),
    "gap": (
        "critical_gap",
        {
            "MODEL": "model",
            "--pga": "pga",
            "--record": "motions",
            "--tolerance": "tolerance",
            "--system": "system",
            "--code": "codes",
            "--accept-unusual": OF_MODEL["--accept-unusual"],
            "--no-outcomes": "outcomes",
            "--curve": "curve",
            "--out": FILES,
            "--force": FILES,
            "--json": OBJECT,
        },
    ),
    "size": (
        "size",
        {
            "MODEL": "model",
            "--vary": "vary",
            "--keep": "keep",
            "--minimise": "minimise",
            "--record": "motions",
            "--pga": "pga",
            "--both-signs": "both_signs",
            "--over": "over",
            "--seed": "seed",
            "--trials": "trials",
            "--tolerance": "tolerance",
            "--jobs": "jobs",
            "--out": "out",
            "--json": OBJECT,
            "--force": "force",
        },
    ),
    "live": (
        "Model.live",
        {
            "MODEL": "self",
            "--no-open": Why("the page opens in the notebook"),
            "--port": Why("the page needs no server"),
            "--export": Why("needs the engine as WebAssembly beside the program, which the package does not ship"),
            "--module": Why("as --export"),
            "--force": Why("as --export"),
        },
    ),
    "pushover": (
        "pushover",
        {
            "MODEL": "model",
            "--building": "building",
            "--pattern": "pattern",
            "--drift": "drift",
            "--direction": "direction",
            "--out": FILES,
            "--json": OBJECT,
            "--force": FILES,
        },
    ),
    "new": ("template", {"NAME": "title", "--template": "name"}),
    "schema": (
        "schema",
        {
            "--markdown": Why("the pages are in the documentation"),
            "--results": "what",
            "--checks": "what",
            "--combinations": "what",
        },
    ),
    "completions": Why("of shells"),
    "man": Why("of shells"),
}

COMMANDS: dict[str, list[str]] = {own["command"]: own["arguments"] for own in json.loads(_jostle.command_list())}


def find(name: str) -> object:
    return reduce(getattr, name.split("."), jostle)


def test_every_command_is_in_the_table() -> None:
    assert set(COMMANDS) == set(TABLE), "a command without a function or a reason, or one that is gone"


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_every_option_has_a_keyword_or_a_reason(command: str) -> None:
    entry = TABLE[command]
    if isinstance(entry, Why):
        return
    function, table = entry
    assert set(COMMANDS[command]) == set(table), f"{command}: an option without a keyword or a reason, or one that is gone"
    for argument, place in table.items():
        if isinstance(place, Why):
            continue
        owner, _, keyword = place.rpartition(":")
        if owner == "Model.set":
            assert jostle.Model.paper_example().set(keyword, None), argument
            continue
        thing = find(owner or function)
        assert callable(thing)
        assert keyword in inspect.signature(thing).parameters or keyword == "self", f"{command} {argument}: {place}"


def test_the_list_is_that_of_the_program(program: Program) -> None:
    """An independent reading of the list: the help of the program."""
    text = program("--help").stdout.split("Commands:")[1].split("Options:")[0]
    shown = set(re.findall(r"^  ([a-z][a-z-]*)", text, re.M)) - {"help"}
    assert shown == {command.split()[0] for command in COMMANDS}
    for command, arguments in COMMANDS.items():
        options = set(re.findall(r"^ +(?:-\w, )?(--[a-z][a-z0-9-]*)", program(*command.split(), "--help").stdout, re.M))
        options -= {"--help"}
        # Of all commands; a model says it by its output.
        options -= {"--units"} - set(arguments)
        assert options == {name for name in arguments if name.startswith("--")}, command
