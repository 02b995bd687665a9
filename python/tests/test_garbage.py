"""Whatever is handed over, there is an answer or a clear exception, and the interpreter lives."""

from __future__ import annotations

import json
import warnings
from typing import Any

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import jostle

#: What a caller may expect of a wrong call.
EXPECTED = (TypeError, ValueError, OverflowError, jostle.JostleError, OSError)

scalars = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=20), st.binary(max_size=8),
    st.complex_numbers(), st.sampled_from(["20 mm", "0.3 g", "40 t", "60 MN/m", "3 s", "shear", "frame", "a", "-1 m"]),
    st.sampled_from([np.float64("nan"), np.int8(3), np.array([1.0, 2.0]), np.array(5), object(), print, int]),
)  # fmt: skip
keys = st.one_of(
    st.text(max_size=8),
    st.sampled_from(
        "title motion building gap analysis record kind pga duration name storeys storey_height mass stiffness "
        "spans column beam width depth EI concrete damping ratio modes between floors law restitution step".split()
    ),
)
trees: Any = st.recursive(
    scalars,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4), st.dictionaries(keys, inner, max_size=5), st.tuples(inner, inner)
    ),
    max_leaves=25,
)
relaxed = settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))

GOOD: dict[str, Any] = {
    "motion": {"record": "el-centro", "pga": "0.3 g", "duration": "0.2 s"},
    "building": [
        {"name": "a", "kind": "shear", "mass": ["40 t"] * 2, "stiffness": ["60 MN/m"] * 2, "storey_height": "3 m"},
        {"name": "b", "kind": "shear", "mass": ["40 t"] * 2, "stiffness": ["90 MN/m"] * 2, "storey_height": "3 m"},
    ],
    "gap": [{"between": ["a", "b"], "width": "2 mm"}],
}  # fmt: skip


def attempt(call: Any) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except EXPECTED as error:
            assert str(error).strip(), "an error says something"
            return None


@relaxed
@given(trees)
def test_any_tree(tree: Any) -> None:
    attempt(lambda: jostle.Model.from_dict(tree))


@relaxed
@given(st.sampled_from(["motion", "building", "gap", "analysis", "title"]), trees)
def test_a_good_tree_with_one_bad_branch(branch: str, value: Any) -> None:
    attempt(lambda: jostle.run(jostle.Model.from_dict({**GOOD, branch: value}), record_interval=None))


@relaxed
@given(st.sampled_from([0, 1]), keys, trees)
def test_a_good_tree_with_one_bad_leaf(building: int, key: str, value: Any) -> None:
    tree = json.loads(json.dumps(GOOD))
    tree["building"][building][key] = value
    attempt(lambda: jostle.run(jostle.Model.from_dict(tree), record_interval=None))


@relaxed
@given(st.one_of(st.text(max_size=200), trees))
def test_any_text(text: Any) -> None:
    attempt(lambda: jostle.Model.loads(text))
    attempt(lambda: jostle.Model.load(text))


@relaxed
@given(st.dictionaries(keys, trees, max_size=4))
def test_any_parts(fields: dict[str, Any]) -> None:
    for part in (jostle.Frame, jostle.Shear, jostle.Gap):
        made = attempt(lambda: part(**fields))
        if made is not None:
            attempt(lambda: jostle.Model([made], made))


@relaxed
@given(trees, trees, trees)
def test_any_motion(values: Any, step: Any, unit: Any) -> None:
    motion = attempt(lambda: jostle.Motion(values, step=step, unit=unit))
    if motion is not None:
        assert np.isfinite(motion.acceleration).all()
    attempt(lambda: jostle.Motion.read(values, unit=unit, step=step))
    attempt(lambda: jostle.Motion.el_centro().scaled(values, pga=step))
    attempt(lambda: jostle.Motion.sine(amplitude=values, period=step, duration=unit))
    attempt(lambda: jostle.Motion.el_centro().at(values))


GOOD_MODEL = jostle.Model.from_dict(GOOD)
GOOD_RESULT = jostle.run(GOOD_MODEL)


@relaxed
@given(trees, trees)
def test_any_arguments_of_runs_and_results(one: Any, other: Any) -> None:
    for keyword in ("motion", "gap", "pga", "record_interval", "progress", "gap_mm", "nonsense"):
        attempt(lambda: jostle.run(GOOD_MODEL, **{keyword: one}))
    attempt(lambda: jostle.run(one))
    attempt(lambda: jostle.modes(GOOD_MODEL, one))
    attempt(lambda: GOOD_RESULT.floor(one, other))
    attempt(lambda: GOOD_MODEL.periods(one))
    attempt(lambda: GOOD_MODEL.changed(gap=one, pga=other))


@relaxed
@given(st.binary(max_size=300))
def test_any_record(content: bytes) -> None:
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "x.at2"
        path.write_bytes(content)
        attempt(lambda: jostle.Motion.read(path))
        attempt(lambda: jostle.Model.load(path))


def test_deep_nesting_does_not_exhaust_the_stack() -> None:
    for text in ("[" * 100_000, '{"building": ' + "[" * 100_000, "a = " + "[" * 100_000, "{a=" * 50_000):
        attempt(lambda: jostle.Model.loads(text))
