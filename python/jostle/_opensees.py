"""Buildings from OpenSees: of a model in memory or of a script."""

from __future__ import annotations

import importlib
import os
import runpy
import sys
import warnings
from collections.abc import Sequence
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
    A plane model, or a model in space without rigid diaphragms, becomes a building that moves in one direction: floors are the
    levels
    with horizontal mass, and a floor is in contact at its outermost node. A model in space with a rigid diaphragm at every level
    with mass becomes a building with a plan, which translates in both directions and rotates. Analysis objects of the model
    are removed; nodes, elements and loads stay as they are. OpenSees' message that a factorization failed is harmless: the mass
    matrix alone is singular. It is not shown.

    Args:
        ops: the module ``openseespy.opensees``, with a model.
        direction: 1 or ``"x"``, 2 or ``"y"`` (in space only): the horizontal direction along which buildings stand.
            A building with a plan is rotated so that this direction points along the row.
        side: ``"right"`` or ``"left"``, where the neighbour stands; not used by buildings with a plan.
        units: force and length of the model, which OpenSees does not know: ``"kip, in"``; mass is force·s²/length.
        name: name of the building.
        ports: the nodes in contact, one for each floor, instead of the outermost nodes.
        plan: of a building with a plan, as in :class:`Given`, in metres; by default the rectangle around the nodes
            of each diaphragm.
        damping: as in :class:`Given`, instead of that of the model.

    Raises:
        ModelError: the model is empty, has no floors with mass, or its matrices cannot be those of a building; the message
            names nodes and remedy.
        ModelWarning: (a warning) what is not imported, and the consequences.

    Examples:
        >>> import jostle
        >>> def pair(ops):  # openseespy.opensees, with a model in memory
        ...     left = jostle.from_opensees(ops, units="kN, m", name="A")
        ...     right = jostle.import_opensees("neighbour.py", side="left", name="B")
        ...     return jostle.Model([left, right], jostle.Gap("50 mm"))
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

    The script runs in its folder. If it ends with ``wipe()``, the model is read before. The script is a program and runs
    with your permissions.

    Args:
        script: the script.
        direction: as in :func:`from_opensees`; this applies to all other arguments as well.
        side: where the neighbour stands.
        units: force and length of the model.
        name: name of the building; by default that of the script.
        ports: the nodes in contact.
        plan: of a building with a plan.
        damping: instead of that of the model.

    Raises:
        ImportError: OpenSeesPy is missing; ``pip install openseespy`` installs it.
        MissingFileError: there is no such script.
        ModelError: the script fails, or as in :func:`from_opensees`.

    Examples:
        >>> import jostle
        >>> def pair(ops):  # openseespy.opensees, with a model in memory
        ...     left = jostle.from_opensees(ops, units="kN, m", name="A")
        ...     right = jostle.import_opensees("neighbour.py", side="left", name="B")
        ...     return jostle.Model([left, right], jostle.Gap("50 mm"))
    """
    read = run_script(script, direction, side, units, ports, plan, damping)
    for text in read.remarks:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return read.given(name or Path(script).stem)


def run_script(
    script: str | os.PathLike[str],
    direction: int | str,
    side: str,
    units: str,
    ports: Sequence[int] | None,
    plan: Sequence[Any] | None,
    damping: Table | None,
) -> CondensedModel:
    """Runs a script and returns its building; arguments are those of :func:`import_opensees`."""
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
        ops: Any = importlib.import_module("openseespy.opensees")
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
