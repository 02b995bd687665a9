"""Models for other programs."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from . import _jostle
from ._errors import ModelError

if TYPE_CHECKING:
    from ._model import Model


@dataclass(frozen=True)
class Script:
    """A model written for another program: the result of :meth:`Model.export`.

    Attributes:
        text: the script, or the list of buildings of exported matrices.
        differences: how the other program differs.
        files: files written.

    Examples:
        >>> import jostle
        >>> script = jostle.Model.paper_example().export()
        >>> script.text.splitlines()[0]
        '#!/usr/bin/env python3'
    """

    text: str
    differences: tuple[str, ...]
    files: tuple[Path, ...]

    def __str__(self) -> str:
        return self.text


def export(model: Model, path: str | os.PathLike[str] | None, to: str, force: bool) -> Script:
    """See :meth:`Model.export`."""
    if to == "matrices":
        if path is None:
            raise ModelError("path: matrices are several files; name a folder")
        written = tuple(Path(own) for own in model._core.export_matrices(os.fspath(path), force))
        return Script(written[-1].read_text(encoding="utf-8"), (), written)
    if to != "openseespy":
        raise ModelError(f"to: expected openseespy or matrices, found {to!r}")
    text, differences = model._core.script()
    if path is not None:
        _jostle.write_text(os.fspath(path), text, "script", force)
    return Script(text, tuple(differences), () if path is None else (Path(path),))
