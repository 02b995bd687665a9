"""Python values as the text of a model file."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping

from ._errors import ModelError
from ._units import number, without_pint

#: Deeper nesting has no place in a model.
_DEEPEST = 32
#: More values than any model file may hold.
_MOST = 2_000_000


def text_of(tree: object, name: str = "model") -> str:
    """JSON text of a tree of dicts, lists, texts, numbers and flags, NumPy's arrays and scalars included.

    Raises:
        ModelError: a value that a model file cannot contain, with its location.
    """
    if not isinstance(tree, Mapping):
        raise TypeError(f"{name}: expected a dict, found {type(tree).__name__}")
    left = [_MOST]
    return json.dumps(_plain(tree, "", name, _DEEPEST, left), allow_nan=False)


def value_text(value: object, path: str) -> str:
    """JSON text of one value of a model file.

    Raises:
        ModelError: a value that a model file cannot contain.
    """
    return json.dumps(_plain(value, path, "model", _DEEPEST, [_MOST]), allow_nan=False)


def _plain(value: object, path: str, name: str, depth: int, left: list[int]) -> object:
    left[0] -= 1
    if left[0] < 0:
        raise _fault(name, path, "the model has too many values")
    value = without_pint(value)
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        # Halves of surrogate pairs are in no text file.
        return value.encode("utf-8", "replace").decode("utf-8")
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    plain = number(value)
    if plain is not None:
        if isinstance(plain, float) and not math.isfinite(plain):
            raise _fault(name, path, f"expected a finite number, found {plain}")
        if isinstance(plain, int) and abs(plain) >= 1 << 63:
            try:
                return float(plain)
            except OverflowError:
                raise _fault(name, path, "expected a number of usable size") from None
        return plain
    if depth == 0:
        raise _fault(name, path[:100], "the model is nested too deeply")
    if isinstance(value, Mapping):
        table: dict[str, object] = {}
        for key, entry in value.items():
            if not isinstance(key, str):
                raise _fault(name, path, f"keys are texts, found {type(key).__name__}")
            key = key.encode("utf-8", "replace").decode("utf-8")
            table[key] = _plain(entry, f"{path}.{key}" if path else key, name, depth - 1, left)
        return table
    if isinstance(value, Iterable) and not isinstance(value, (bytes, bytearray, memoryview)):
        entries = enumerate(value)
        return [_plain(entry, f"{path}[{i}]", name, depth - 1, left) for i, entry in entries]
    to_list = getattr(value, "tolist", None)
    if callable(to_list):  # an array of no dimension
        return _plain(to_list(), path, name, depth - 1, left)
    raise _fault(name, path, f"a model cannot hold a {type(value).__name__}")


def _fault(name: str, path: str, problem: str) -> ModelError:
    place = f"{name}: {path}" if path else name
    return ModelError(f"{place}: {problem}", [(path, problem, None, None, None)])
