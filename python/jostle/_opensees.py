"""Buildings from OpenSees: of a model in memory or of a script; ``python -m jostle._opensees`` writes a model file."""

from __future__ import annotations

import contextlib
import io
import os
import runpy
import sys
import warnings
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ._builders import Given, Table
from ._errors import JostleError, MissingFileError, ModelError, ModelWarning
from ._opensees_matrices import CondensedModel, read_model, unit_factors


def from_opensees(
    ops: Any,
    *,
    direction: int | str = 1,
    side: str = "right",
    units: str = "N, m",
    name: str | None = None,
    ports: Sequence[int] | None = None,
    plan: Sequence[Any] | None = None,
    damping: Table | None = None,
) -> Given:
    """Returns the building that OpenSees holds in memory, elastic, by its matrices.

    Takes mass, damping and tangent stiffness at the current state and condenses displacements without mass, which is exact.
    A model in the plane, or one in space without rigid diaphragms, becomes a building of one direction: floors are the levels
    with horizontal mass, and a floor is hit at its outermost node. A model in space with a rigid diaphragm at every level
    with mass becomes a building with a plan, which moves in both directions and turns. Analysis objects of the model
    are removed; nodes, elements and loads stay as they are. OpenSees' message that a factorization failed is harmless: the mass
    matrix alone is singular. It is not shown.

    Args:
        ops: the module ``openseespy.opensees``, with a model.
        direction: 1 or ``"x"``, 2 or ``"y"`` (in space only): the horizontal direction along which buildings stand.
            A building with a plan is turned so that this direction points along the row.
        side: ``"right"`` or ``"left"``, where the neighbour stands; not used by buildings with a plan.
        units: force and length of the model, which OpenSees does not know: ``"kip, in"``; mass is force·s²/length.
        name: name of the building.
        ports: the nodes that are hit, one for each floor, instead of the outermost ones.
        plan: of a building with a plan, as in :class:`Given`, in metres; by default the rectangle around the nodes
            of each diaphragm.
        damping: as in :class:`Given`, instead of that of the model.

    Raises:
        ModelError: the model is empty, has no floors with mass, or its matrices cannot be those of a building; the message
            names nodes and remedy.
        ModelWarning: (a warning) what is not carried over, and what it means.
    """
    read = read_model(ops, direction, side, units, ports, plan, damping)
    for text in read.remarks:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return read.given(name)


def import_opensees(
    script: str | os.PathLike[str],
    *,
    direction: int | str = 1,
    side: str = "right",
    units: str = "N, m",
    name: str | None = None,
    ports: Sequence[int] | None = None,
    plan: Sequence[Any] | None = None,
    damping: Table | None = None,
) -> Given:
    """Runs an OpenSeesPy script and returns the building that it leaves in memory, as :func:`from_opensees` does.

    The script runs as a program of its own folder. If it ends with ``wipe()``, the model is taken before. The script is a
    program: it can do what you can do on this computer.

    Args:
        script: the script.
        direction: as in :func:`from_opensees`; so are all others.
        side: where the neighbour stands.
        units: force and length of the model.
        name: name of the building; by default that of the script.
        ports: the nodes that are hit.
        plan: of a building with a plan.
        damping: instead of that of the model.

    Raises:
        ImportError: OpenSeesPy is missing; ``pip install openseespy`` installs it.
        MissingFileError: there is no such script.
        ModelError: the script fails, or as in :func:`from_opensees`.
    """
    read = _run_script(script, direction, side, units, ports, plan, damping)
    for text in read.remarks:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return read.given(name or Path(script).stem)


def _run_script(
    script: str | os.PathLike[str],
    direction: int | str,
    side: str,
    units: str,
    ports: Sequence[int] | None,
    plan: Sequence[Any] | None,
    damping: Table | None,
) -> CondensedModel:
    path = Path(script)
    if not path.is_file():
        raise MissingFileError(f"{path}: there is no such script", os.fspath(path))
    if path.suffix.lower() == ".tcl":
        raise ModelError(
            f"{path}: scripts in Tcl are not read; write them for OpenSeesPy, or print the matrices there "
            "(integrator GimmeMCK, printA -file) and use kind = \"given\""
        )
    unit_factors(units)
    try:
        import openseespy.opensees as ops
    except Exception as error:  # its own loader raises RuntimeError where a library is missing
        raise ImportError(
            f"OpenSeesPy cannot be imported ({error}); install it: pip install openseespy (on Debian with Python below 3.12: "
            "pip install openseespy==3.7.1.2 and apt-get install libblas3 liblapack3 libgfortran5)"
        ) from error

    def read() -> CondensedModel:
        return read_model(ops, direction, side, units, ports, plan, damping)

    before: list[CondensedModel | ModelError] = []
    wipe = ops.wipe

    def wipe_after_reading(*arguments: Any) -> Any:
        if ops.getNodeTags() and ops.getEleTags():
            try:
                before.append(read())
            except ModelError as error:
                before.append(error)
        return wipe(*arguments)

    folder, argv, paths, backend = os.getcwd(), sys.argv, sys.path[:], os.environ.get("MPLBACKEND")
    where = path.resolve()
    wipe()
    try:
        ops.wipe = wipe_after_reading
        os.environ.setdefault("MPLBACKEND", "Agg")
        os.chdir(where.parent)
        sys.argv, sys.path = [str(where)], [str(where.parent), *paths]
        try:
            runpy.run_path(str(where), run_name="__main__")
        except SystemExit as end:
            if end.code not in (None, 0):
                raise ModelError(f"{path}: the script ended with exit code {end.code!r}") from None
        except JostleError:
            raise
        except Exception as error:
            raise ModelError(f"{path}{_line_of(error, where)}: {type(error).__name__}: {error}") from error
        if ops.getNodeTags():
            return read()
    finally:
        ops.wipe = wipe
        os.chdir(folder)
        sys.argv, sys.path[:] = argv, paths
        if backend is None:
            os.environ.pop("MPLBACKEND", None)
    if not before:
        raise ModelError(
            f"{path}: the script leaves no model in memory",
            [],
        )
    last = before[-1]
    if isinstance(last, ModelError):
        raise last
    return last


def _line_of(error: Exception, script: Path) -> str:
    trace, line = error.__traceback__, None
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(script):
            line = trace.tb_lineno
        trace = trace.tb_next
    return "" if line is None else f":{line}"


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


def _main(arguments: Sequence[str] | None = None) -> int:
    """``python -m jostle._opensees``: what ``jostle import opensees`` runs."""
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
            read = _run_script(asked.script, asked.direction, asked.side, asked.units, asked.port, None, None)
        name = asked.name or asked.script.stem
        for text in read.remarks:
            print(f"warning: {text}", file=sys.stderr)
        path, archive = _write(read, name, asked.script, to, asked.force)
    except (JostleError, ImportError) as error:
        print(f"error: {error}", file=sys.stderr)
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
    sys.exit(_main())
