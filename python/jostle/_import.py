"""Buildings from the files of ETABS and SAP2000."""

from __future__ import annotations

import os
from pathlib import Path

from . import _jostle
from ._model import Model
from ._units import Quantity, option_text


class Imported:
    """A model that was imported, and what was read: the result of :func:`import_etabs` and :func:`import_sap2000`.

    Attributes:
        model: the model, as loaded from its file.
        path: the model file.

    Examples:
        >>> import jostle
        >>> hotel = jostle.import_etabs("etabs/hotel.xlsx", to="hotel.toml")
        >>> isinstance(hotel, jostle.Imported)
        True
        >>> print(str(hotel).splitlines()[0])
        Read
    """

    def __init__(self, model: Model, path: Path, text: str) -> None:
        self.model, self.path, self._text = model, path, text

    def __str__(self) -> str:
        return self._text.rstrip()

    def __repr__(self) -> str:
        return f"<Imported: {self.path}>"

    def _repr_html_(self) -> str:
        from ._draw import text_html

        return text_html(str(self))


def import_etabs(
    *files: str | os.PathLike[str],
    to: str | os.PathLike[str],
    direction: str | None = None,
    by: str | None = None,
    gap: Quantity | None = None,
    case: str | None = None,
    diaphragm: str | None = None,
    unit_force: Quantity | None = None,
    unit_moment: Quantity | None = None,
    units: str | None = None,
    force: bool = False,
) -> Imported:
    """Writes a model file from files of ETABS, as ``jostle import etabs`` does, and loads it.

    The result shows what was read, the limits of the model, what was not imported, and a comparison of periods with those of
    the source.

    Args:
        files: result tables (.xlsx), text models (.e2k, $et), and .OUT and .LOG files, of one building or of several; those of
            one building have the same name, such as ``A.xlsx`` and ``A.OUT``.
        to: model file to write.
        direction: ``"x"``, ``"y"`` or ``"both"``; by default with a plan if the files suffice.
        by: ``"flexibility"``, ``"modes"``, ``"stiffness"``, ``"frame"`` or ``"members"``; by default the first one that the
            files allow.
        gap: width of the gaps between neighbours.
        case: load case of Story Stiffness, or modal case.
        diaphragm: diaphragm of this building, if storeys have several.
        unit_force: force of load cases named ``FX STORY`` and ``FY STORY``.
        unit_moment: moment of load cases named ``MZ STORY``.
        units: units of tables without a row of units, such as ``"kN, m"``.
        force: replace files even if jostle did not write them.

    Raises:
        ModelError: what is wrong with the files; the message names the table that would help.

    Examples:
        >>> import jostle
        >>> pair = jostle.import_etabs("etabs/hotel.xlsx", "etabs/annexe.xlsx", to="pair.toml", gap="60 mm")
        >>> print(len(pair.model.buildings), pair.path)
        2 pair.toml
    """
    return _imported("etabs", files, to, direction, by, gap, case, diaphragm, unit_force, unit_moment, units, force)


def import_sap2000(
    *files: str | os.PathLike[str],
    to: str | os.PathLike[str],
    direction: str | None = None,
    by: str | None = None,
    gap: Quantity | None = None,
    case: str | None = None,
    diaphragm: str | None = None,
    unit_force: Quantity | None = None,
    unit_moment: Quantity | None = None,
    units: str | None = None,
    force: bool = False,
) -> Imported:
    """Writes a model file from text models (.s2k, $2k) and .OUT and .LOG files of SAP2000, and loads it.

    Args:
        files: as for :func:`import_etabs`; this applies to all other arguments as well.
        to: model file to write.
        direction: ``"x"``, ``"y"`` or ``"both"``.
        by: source of the stiffness.
        gap: width of the gaps between neighbours.
        case: load case of storey stiffnesses, or modal case.
        diaphragm: diaphragm of this building.
        unit_force: force of unit load cases.
        unit_moment: moment of unit load cases.
        units: units of tables without a row of units.
        force: replace files even if jostle did not write them.

    Raises:
        ModelError: what is wrong with the files.

    Examples:
        >>> import jostle
        >>> print(jostle.import_sap2000("sap2000/frame.s2k", to="frame.toml").model.buildings)
        ['frame']
    """
    return _imported("sap2000", files, to, direction, by, gap, case, diaphragm, unit_force, unit_moment, units, force)


def _imported(
    program: str,
    files: tuple[str | os.PathLike[str], ...],
    to: str | os.PathLike[str],
    direction: str | None,
    by: str | None,
    gap: Quantity | None,
    case: str | None,
    diaphragm: str | None,
    unit_force: Quantity | None,
    unit_moment: Quantity | None,
    units: str | None,
    force: bool,
) -> Imported:
    options = {
        "direction": direction,
        "by": by,
        "gap": gap if gap is None else option_text("gap", gap),
        "case": case,
        "diaphragm": diaphragm,
        "unit-force": unit_force if unit_force is None else option_text("unit_force", unit_force),
        "unit-moment": unit_moment if unit_moment is None else option_text("unit_moment", unit_moment),
        "units": units,
    }
    arguments = [f"--{key}={value}" for key, value in options.items() if value is not None]
    if force:
        arguments.append("--force")
    arguments += [f"--to={os.fspath(to)}", "--", *(os.fspath(file) for file in files)]
    text = _jostle.import_tables([program, *arguments])
    return Imported(Model.load(to), Path(to), text)
