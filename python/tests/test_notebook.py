"""What a notebook shows: complete, offline, and nobody's script."""

from __future__ import annotations

import html.parser
import re
import sys
import types
from pathlib import Path
from typing import Any

import pytest

import jostle
from jostle import _jostle


class Reader(html.parser.HTMLParser):
    """Collects elements and complains about those left open."""

    VOID = {"meta", "link", "input", "path", "br"}

    def __init__(self, page: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []
        self.feed(page)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open.pop() == tag, tag


def shown(thing: object) -> str:
    page = thing._repr_html_()  # type: ignore[attr-defined]
    assert isinstance(page, str)
    reader = Reader(page)
    assert not re.search(r"(?:src|href)\s*=\s*[\"']?(?:https?:)?//", page), "nothing from elsewhere"
    for tag, attributes in reader.seen:
        assert tag != "script", "scripts only inside the frame"
        if tag == "iframe":
            assert attributes["sandbox"] == "allow-scripts"
            assert "default-src 'none'" in (attributes["srcdoc"] or "")
    return page


def test_everything_shows_itself(towers: jostle.Model, result: jostle.Result) -> None:
    assert shown(towers).count("<svg") == 1
    assert "20 mm" in shown(towers) and "storeys" in shown(towers)
    page = shown(result)
    assert "Contact force [kN]" in page and "<iframe" in page and result.summary["title"] in page
    assert len(page) < 1_500_000
    assert "<polyline" in shown(jostle.Motion.el_centro())
    assert "+1.00" in shown(jostle.modes(towers)["soft"])
    assert "more rows" in shown(result.history)
    assert "<iframe" in shown(result.animate())


def test_every_answer_shows_a_table_and_a_picture(
    towers: jostle.Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    vary = [{"name": "gap", "path": "gap[0].width", "values": ["8 mm", "12 mm"]}]
    target = jostle.DesignSpectrum("gb50011", intensity=8, site="II", group=1)
    motions = [jostle.Motion.el_centro().lasting("6 s"), jostle.Motion.sine(amplitude=2, period=0.6, duration=4)]
    both = [
        *jostle.critical_gap(towers, tolerance="1 mm", outcomes=False),
        *jostle.critical_gap(towers, tolerance="1 mm", outcomes=False, curve=4),
        jostle.run_suite(towers, motions=motions, report=False),
        jostle.Study(towers, vary).run("out", report=False),
        jostle.Motion.el_centro().spectrum(damping=[0.02, 0.05]),
        jostle.section(width=0.5, depth=0.5, bars="12 d20"),
        jostle.size(towers, vary={"gap.width": ("5 mm", "90 mm")}, keep="impact_count <= 2", minimise="gap.width", trials=40),
        *jostle.contact_advice(mass="40 t", length=12, width=10, thickness="150 mm"),
        jostle.Motion.select(target, periods=[0.8], natural=motions[:1]),
    ]
    for thing in both:
        page = shown(thing)
        assert "<table>" in page and "<svg" in page, type(thing).__name__
        assert "nan" not in page and "None" not in page, type(thing).__name__
    for thing in (jostle.Study(towers, vary), towers.check(), jostle.method(towers), target):
        assert shown(thing)
    assert "<svg" in shown(jostle.critical_gap(towers, tolerance="1 mm", outcomes=False)), "a list of answers"
    assert shown(jostle.pushover(jostle.Model.example("paper-inelastic"), drift=0.01)).count("<svg") == 2


def test_names_are_only_names() -> None:
    evil = '<script>alert("&")</script>'
    building = jostle.Shear(evil, mass="40 t", stiffness="60 MN/m", storeys=2, storey_height=3)
    model = jostle.Model([building], title=evil, motion=jostle.Motion([0, 1, 0], step=0.1, name=evil))
    result = jostle.run(model)
    for thing in (model, model.motion, result, jostle.modes(model)[evil], result.history):
        shown(thing)


def test_a_model_without_motion_still_draws_itself() -> None:
    tree = {"building": [{"kind": "shear", "storeys": 2, "mass": "4 t", "stiffness": "6 MN/m", "storey_height": 3}]}
    assert "no ground motion" in shown(jostle.Model.from_dict(tree))
    lost = jostle.Model.from_dict({**tree, "motion": {"record": "lost.at2"}})
    assert "there is no record" in shown(lost)


@pytest.mark.parametrize("thing", ["Model", "Motion", "Result", "Table", "Animation"])
def test_reprs_are_one_line(thing: str, towers: jostle.Model, result: jostle.Result) -> None:
    things = {
        "Model": towers,
        "Motion": towers.motion,
        "Result": result,
        "Table": result.impacts,
        "Animation": result.animate(),
    }
    text = repr(things[thing])
    assert text.startswith(f"<{thing}") and "\n" not in text


def test_a_result_shows_itself_without_another_run(
    towers: jostle.Model, monkeypatch: pytest.MonkeyPatch
) -> None:
    result = jostle.run(towers)

    def refuse(*arguments: object, **keywords: object) -> None:
        raise AssertionError("it ran again")

    monkeypatch.setattr(_jostle, "run", refuse)
    assert "<iframe" in shown(result) and "<iframe" in shown(result.animate())


class Notebook:
    """Stands in for IPython in a notebook, and keeps what it shows."""

    def __init__(self) -> None:
        self.pages: list[str] = []

    def display(self, page: str, display_id: bool) -> Notebook:
        assert display_id
        self.pages.append(page)
        return self

    def update(self, page: str) -> None:
        self.pages.append(page)

    def HTML(self, page: str) -> str:
        return page


def test_progress_in_a_notebook_is_a_bar_and_no_error_text(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    notebook = Notebook()
    module: Any = types.ModuleType("IPython")
    module.get_ipython = lambda: types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", module)
    monkeypatch.setitem(sys.modules, "IPython.display", notebook)
    model = jostle.Model.paper_example()
    assert model.motion is not None
    jostle.run(model, motion=model.motion.lasting("10000 s"), record_interval=None, progress=True)
    assert "<progress" in notebook.pages[0] and "of 10000.0 s" in notebook.pages[0]
    assert notebook.pages[-1] == "", "leaves no trace"
    told = capsys.readouterr()
    assert told.err == told.out == ""
