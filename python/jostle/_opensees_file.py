"""``python -m jostle._opensees_file``: the building of an OpenSees script as a model file, for ``jostle import opensees``."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ._errors import JostleError, ModelError
from ._opensees import run_script
from ._opensees_matrices import CondensedModel


def _toml(read: CondensedModel, name: str, archive: str, script: str) -> str:
    """The model file: what was read and what not as comments, and the building."""
    import json

    def listed(values: Iterable[Any]) -> str:
        return "[" + ", ".join(repr(float(value)) for value in values) + "]"

    lines = [f"# Building read from the OpenSees script {script} by jostle."]
    assert read.periods is not None
    periods = ", ".join(f"{value:.4g}" for value in read.periods[:3])
    lines.append(
        f"# {read.equations} equations, condensed to {len(read.stiffness)}; longest periods {periods} s."
    )
    lines.append(f"# Floors are nodes {', '.join(map(str, read.nodes))}.")
    lines += [f"# Note: {text}." for text in read.remarks]
    lines += [
        "# Add [motion], a neighbour and [[gap]].",
        "",
        "[[building]]",
        f"name = {json.dumps(name)}",
        'kind = "given"',
        f"matrices = {json.dumps(archive)}",
    ]
    if read.plan is not None:
        plans = [
            own if isinstance(own, str) else "{ corners = [" + ", ".join(listed(c) for c in own["corners"]) + "] }"
            for own in read.plan
        ]
        lines.append(f"plan = [{', '.join(plans)}]")
    if read.angle is not None:
        lines.append(f'angle = "{read.angle:g} deg"')
    if read.elevation:
        lines.append(f'elevation = "{read.elevation!r} m"  # of the lowest node, as in the script')
    if read.stated is not None:
        stated = ", ".join(f"{key} = {json.dumps(value)}" for key, value in read.stated.items())
        lines.append(f"damping = {{ {stated} }}")
    lines.append("[building.ports]")
    for key, port in read.ports.items():
        place = (
            f"dof = {port['dof']}"
            if "dof" in port
            else f"dofs = {port['dofs']}, at = {listed(port['at'])}"
        )
        lines.append(f"{key} = {{ {place}, height = {float(port['height'])!r} }}")
    return "\n".join(lines) + "\n"


#: First words of model files that may be replaced.
_MARK = "# Building read from the OpenSees script "


def _write(read: CondensedModel, name: str, script: Path, to: Path, force: bool) -> tuple[Path, Path]:
    """Writes the model file and its matrices beside it, both or none."""
    import numpy as np

    archive = to.with_suffix(".npz")
    if to.suffix.lower() != ".toml":
        raise ModelError(f"--to: expected a model file that ends with .toml, found {to}")
    if not force:
        if to.exists() and not to.read_text("utf-8", "replace").startswith(_MARK):
            raise ModelError(f"{to} exists already and was not written by jostle import; --force replaces it")
        if archive.exists() and not to.exists():
            raise ModelError(f"{archive} exists already; --force replaces it")
    arrays = {"K": read.stiffness, "M": read.mass, "C": read.damping, "r": read.influence, "h": read.heights}
    packed = io.BytesIO()
    given: dict[str, Any] = {key: value for key, value in arrays.items() if value is not None}
    np.savez(packed, **given)
    text = _toml(read, name, archive.name, script.name)
    parts = [(archive, packed.getvalue()), (to, text.encode())]
    written: list[tuple[Path, Path]] = []
    try:
        for path, content in parts:
            aside = path.with_name(f".{path.name}.{os.getpid()}.part")
            written.append((aside, path))
            aside.write_bytes(content)
        for aside, path in written:
            os.replace(aside, path)
    except OSError as error:
        for aside, _ in written:
            with contextlib.suppress(OSError):
                aside.unlink()
        raise ModelError(f"{to} cannot be written: {error}") from None
    return to, archive


def main(arguments: Sequence[str] | None = None) -> int:
    """Reads and writes; returns the exit code."""
    import argparse

    parser = argparse.ArgumentParser("jostle import opensees")
    parser.add_argument("script", type=Path)
    parser.add_argument("--to", type=Path, required=True)
    parser.add_argument("--name")
    parser.add_argument("--direction", default="x")
    parser.add_argument("--side", default="right")
    parser.add_argument("--units", default="N, m")
    parser.add_argument("--port", type=int, action="append")
    parser.add_argument("--force", action="store_true")
    asked = parser.parse_args(arguments)
    try:
        # What the script prints is not an answer of this program.
        to = asked.to.absolute()
        with contextlib.redirect_stdout(sys.stderr):
            read = run_script(asked.script, asked.direction, asked.side, asked.units, asked.port, None, None)
        name = asked.name or asked.script.stem
        for text in read.remarks:
            print(f"warning: {text}", file=sys.stderr)
        path, archive = _write(read, name, asked.script, to, asked.force)
    except (JostleError, ImportError) as error:
        # The option of the command, not the argument of the function.
        text = str(error).replace("ports=[…]", "--port NODE")
        print(f"error: {text}", file=sys.stderr)
        return 2
    assert read.periods is not None
    periods = ", ".join(f"{value:.5g}" for value in read.periods[:3])
    print(
        f"{name}: {len(read.ports)} floors, {read.equations} equations condensed to {len(read.stiffness)}, "
        f"longest periods {periods} s"
    )
    print(f"written: {path}\nwritten: {archive}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
