"""The live page in a notebook, without a browser: messages in, messages out."""

from __future__ import annotations

import builtins
import json
import struct
import sys
import time
from typing import Any

import pytest

import jostle

pytest.importorskip("anywidget")


class Page:
    """A widget and what it sent to its page."""

    def __init__(self, model: jostle.Model) -> None:
        self.widget = model.live()
        self.sent: list[tuple[dict[str, Any], list[bytes]]] = []
        self.widget.send = lambda content, buffers=None: self.sent.append((content, buffers or []))

    def ask(self, **request: Any) -> None:
        self.widget._take(self.widget, {"request": json.dumps(request)}, [])

    def wait(self, what: str) -> Any:
        end = time.monotonic() + 60
        while time.monotonic() < end:
            for content, buffers in list(self.sent):
                if what == "frame" and buffers:
                    return buffers[0]
                if "answer" in content and json.loads(content["answer"])["op"] == what:
                    return json.loads(content["answer"])
            time.sleep(0.005)
        raise AssertionError(f"no {what} in {self.sent}")


def head(frame: bytes) -> Any:
    (length,) = struct.unpack_from("<I", frame)
    return json.loads(frame[4 : 4 + length])[0]


def test_a_frame_has_the_numbers_of_a_run() -> None:
    page = Page(jostle.Model.paper_example())
    page.ask(op="hello")
    text = page.wait("hello")["text"]
    page.ask(op="run", id=1, text=text, edits=[["gap[0].width", "30 mm"]], record=0)
    found = {number["name"]: number["value"] for number in head(page.wait("frame"))["numbers"]}
    expected = jostle.run(jostle.Model.paper_example(), gap="30 mm")
    assert found["Peak force"] == pytest.approx(1e-3 * expected.summary["gaps"][0]["peak_force_n"], rel=1e-9)
    assert page.widget.values["gap"] == "30 mm"
    result = page.widget.result
    assert result.summary["gaps"] == expected.summary["gaps"]
    assert page.widget.result is result
    page.widget.close()


def test_sensitive_results_are_found_after_the_frame() -> None:
    page = Page(jostle.Model.paper_example())
    model = jostle.Model.paper_example()
    # A gap that the buildings just graze.
    width = f"{1e3 * jostle.run(model, without_contact=True).summary['gaps'][0]['closing_without_contact_m'] - 1e-4:.4f} mm"
    text = page.widget._engine.text
    page.ask(op="run", id=7, text=text, edits=[["gap[0].width", width]], record=0)
    first = head(page.wait("frame"))["accuracy"]
    found = page.wait("accuracy")
    assert found["id"] == 7
    assert "sensitive" in found["text"] and "sensitive" not in first
    with pytest.warns(jostle.JostleWarning, match="sensitive"):
        checked = jostle.run(model, gap=width)
    assert checked.summary["promise"]["sensitive_from_s"] is not None
    page.widget.close()


def test_values_are_set_from_python() -> None:
    page = Page(jostle.Model.paper_example())
    assert page.widget.values["gap"] == "100 mm"
    page.widget.values["gap"] = "35 mm"
    assert 'width = "35 mm"' in page.wait("model")["text"]
    assert page.widget.values["gap[0].width"] == "35 mm"
    page.widget.values["building[0].storeys"] = 4
    assert page.widget.model.description["buildings"][0]["name"] == "J1"
    with pytest.raises(jostle.ModelError, match="expected a length"):
        page.widget.values["gap"] = "3 kg"
    assert page.widget.values["gap"] == "35 mm"
    with pytest.raises(KeyError):
        page.widget.values["no such key"]
    page.widget.close()


def test_a_curve_comes_whole_and_a_newer_one_replaces_it() -> None:
    page = Page(jostle.Model.paper_example())
    ends = {"path": "motion.pga", "unit": "cm/s2", "from": 100, "to": 200, "points": 5}
    text = page.widget._engine.text
    page.ask(op="curve", id=3, text=text, **{**ends, "points": 500})
    page.ask(op="curve", id=4, text=text, **ends)
    end = time.monotonic() + 60
    values: list[float] = []
    while len(values) < 5 and time.monotonic() < end:
        answers = [json.loads(content["answer"]) for content, _ in list(page.sent) if content]
        values = [point["x"] for answer in answers if answer["id"] == 4 for point in answer["points"]]
        time.sleep(0.01)
    assert sorted(values) == [100, 125, 150, 175, 200]
    assert len([1 for content, _ in page.sent if content and json.loads(content["answer"])["id"] == 3]) < 500
    page.widget.close()


def test_changed_models_keep_their_changes() -> None:
    model = jostle.Model.paper_example().changed(gap="20 mm").changed(pga="0.1 g")
    widget = model.live()
    assert jostle.run(widget.model).summary["gaps"] == jostle.run(model).summary["gaps"]
    widget.close()
    sine = jostle.Motion.sine(amplitude="1 m/s2", period="0.6 s", duration="4 s")
    for motion in (jostle.Motion.el_centro().scaled(pga="0.1 g").lasting("6 s"), sine):
        given = jostle.Model.paper_example().changed(motion=motion)
        widget = given.live()
        assert jostle.run(widget.model).summary["gaps"] == jostle.run(given).summary["gaps"]
        widget.close()


def test_without_anywidget_the_error_names_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    load = builtins.__import__

    def refuse(name: str, *arguments: Any, **more: Any) -> Any:
        if name == "anywidget":
            raise ImportError(name)
        return load(name, *arguments, **more)

    monkeypatch.delitem(sys.modules, "jostle._live", raising=False)
    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(ImportError, match=r"pip install \"jostle\[live\]\""):
        jostle.Model.paper_example().live()
