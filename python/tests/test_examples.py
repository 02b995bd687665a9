"""Every exported name has an example in its docstring, and all examples run."""

from __future__ import annotations

import ast
import doctest
import importlib
import inspect
import shutil
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

import jostle

ROOT = Path(__file__).resolve().parents[2]
NAMES = [name for name in jostle.__all__ if name != "__version__"]


@pytest.mark.parametrize("name", NAMES)
def test_every_name_has_an_example_that_runs(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in ("etabs", "sap2000"):
        shutil.copytree(ROOT / "examples" / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    text = inspect.getdoc(getattr(jostle, name)) or ""
    test = doctest.DocTestParser().get_doctest(text, {}, name, None, 0)
    assert test.examples, f"{name} has no example"
    assert name in "".join(example.source for example in test.examples) or inspect.isclass(getattr(jostle, name))
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    said: list[str] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        runner.run(test, out=said.append)
    assert runner.failures == 0, "".join(said)


def test_messages_speak_of_python() -> None:
    """No message of the package itself names an option of the command line."""
    package = Path(importlib.import_module("jostle").__file__ or "").parent
    for file in sorted(package.glob("*.py")):
        # What `jostle import opensees` runs.
        if file.name == "_opensees_file.py":
            continue
        tree = ast.parse(file.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.Raise) and node.exc is not None:
                for part in ast.walk(node.exc):
                    if isinstance(part, ast.Constant) and isinstance(part.value, str):
                        assert "--" not in part.value, f"{file.name}: {part.value}"


def test_errors_of_the_library_speak_of_python(tmp_path: Path) -> None:
    """What the command line reports with its options is raised with keywords."""
    paper = jostle.Model.paper_example()
    target = jostle.DesignSpectrum("en1998", type=1, ground="B", ag="0.2 g")
    several = paper.changed(motion=["el-centro-1940-ns", "nanjing-artificial"])
    (tmp_path / "report.html").write_text("mine")
    result = jostle.run(paper)
    wrong: list[Callable[[], object]] = [
        lambda: jostle.contact_advice(),
        lambda: jostle.contact_advice(mass="40 t", length=3),
        lambda: jostle.contact_advice(mass="40 t", poisson_ratio=0.7),
        lambda: jostle.collide(m1="40 t", m2="x", speed=1),
        lambda: jostle.collide("kelvin", m1="40 t", m2="40 t", speed=-1),
        lambda: jostle.pushover(paper, building="Z"),
        lambda: jostle.pushover(paper, drift=2.0),
        lambda: jostle.run(several),
        lambda: jostle.run(paper, motion="lost.at2"),
        lambda: jostle.run("lost.toml"),
        lambda: jostle.run(paper.set("analysis.solver", "product")),
        lambda: jostle.size(paper, vary=[], minimise="gap.width"),
        lambda: jostle.size(paper, vary="gap.width", minimise="gap.width", trials=1),
        lambda: jostle.size(paper, vary="gap.width=1 mm..2", minimise="nothing"),
        lambda: jostle.size(paper, vary="gap.width", keep="x", minimise="gap.width"),
        lambda: jostle.size(paper, vary="gap.width", minimise="gap.width", tolerance=3),
        lambda: jostle.section(width=0.5, depth=0.5, bars="many"),
        lambda: jostle.section(width=0.5, depth=0.5, bars="12 d20", cover="1 m"),
        lambda: jostle.section(width=0.5, depth=0.5, bars="12 d20", length=0),
        lambda: jostle.Motion.pulse(shape="x", velocity=1, period=1),
        lambda: jostle.Motion.select(target, periods=[1.0]),
        lambda: jostle.Motion.synth(target, periods=(3, 1)),
        lambda: jostle.Motion.el_centro().processed(pga=-1),
        lambda: jostle.DesignSpectrum("en1998", ground="Z"),
        lambda: jostle.DesignSpectrum("gb50011"),
        lambda: paper.export(tmp_path / "report.html"),
        lambda: result.report(tmp_path / "report.html"),
        lambda: jostle.critical_gap(paper, tolerance=0),
        lambda: jostle.Study.ready_made("odd"),
    ]  # fmt: skip
    for number, action in enumerate(wrong):
        with pytest.raises((jostle.JostleError, FileExistsError, ValueError)) as caught:
            action()
        assert "--" not in str(caught.value), f"{number}: {caught.value}"
        assert "jostle run" not in str(caught.value), f"{number}: {caught.value}"
    found = paper.check()
    assert "--" not in str(found) + "".join(found.warnings + found.notes)
    assert "--" not in str(several.check())
