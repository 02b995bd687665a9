"""Results as an Excel workbook, read back by openpyxl."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import openpyxl
import pytest

import jostle


def table(book: Any, name: str) -> list[dict[str, Any]]:
    rows = list(book[name].iter_rows(values_only=True))
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def test_a_workbook_holds_the_numbers_of_the_summary(tmp_path: Path, towers: jostle.Model) -> None:
    result = jostle.run(towers, without_contact=True)
    path = result.to_excel(tmp_path / "numbers.xlsx")
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["Summary", "Buildings", "Floors", "Contacts", "Impacts", "Quantities"]
    summary = result.summary
    floors = [(own["name"], floor) for own in summary["buildings"] for floor in own["floors"]]
    rows = table(book, "Floors")
    assert len(rows) == len(floors)
    for row, (building, floor) in zip(rows, floors):
        assert row["building"] == building
        for name in ("floor", "height_m", "displacement_max_m", "storey_drift_peak", "total_acceleration_peak_m_s2"):
            assert row[name] == floor[name], name
        assert row["displacement_max_without_contact_m"] == floor["without_contact"]["displacement_max_m"]
    contacts = [contact for gap in summary["gaps"] for contact in gap["contacts"]]
    for row, contact in zip(table(book, "Contacts"), contacts):
        assert [row["left_floor"], row["right_floor"]] == contact["floors"]
        assert row["peak_force_n"] == contact["peak_force_n"]
    impacts = [impact for contact in contacts for impact in contact["impacts"]]
    rows = table(book, "Impacts")
    assert len(rows) == len(impacts)
    assert sorted(row["impulse_n_s"] for row in rows) == sorted(own["impulse_n_s"] for own in impacts)
    # Units are those of the names.
    names, units = (list(row) for row in book["Floors"].iter_rows(max_row=2, values_only=True))
    suffixes = {"_m": "m", "_s": "s", "_m_s2": "m/s²", "_n": "N", "_n_m": "N·m", "_rad": "rad"}
    for name, unit in zip(names, units):
        longest = max((own for own in suffixes if name.endswith(own)), key=len, default=None)
        if longest is not None:
            assert unit == suffixes[longest], name
    values = {row[0]: row[1] for row in book["Summary"].iter_rows(values_only=True)}
    assert values["peak_force_n"] == max(gap["peak_force_n"] for gap in summary["gaps"])
    assert values["energy.input_j"] == summary["energy"]["input_j"]
    meanings = {(row[0], row[1]): row[3] for row in book["Quantities"].iter_rows(values_only=True)}
    assert "closing rate" in meanings["Impacts", "impact_speed_m_s"]


def test_members_are_a_sheet_if_they_are_asked_for(tmp_path: Path) -> None:
    tree = {"record": "el-centro-1940-ns", "duration": "3 s"}
    frame = jostle.Frame("A", storeys=2, storey_height="3 m", spans=["5 m"], column={"width": "0.4 m", "depth": "0.4 m"},
                         beam={"width": "0.3 m", "depth": "0.5 m"}, elastic_modulus="30 GPa", beam_mass="3 t/m")  # fmt: skip
    result = jostle.run(jostle.Model(frame, motion=tree, output={"members": True}))
    book = openpyxl.load_workbook(result.to_excel(tmp_path / "a.xlsx"))
    assert [row[2] for row in book["Members"].iter_rows(max_row=2, values_only=True)] == ["struck_height_m", "m"]
    rows = table(book, "Members")
    ends = [end for own in result.summary["buildings"][0]["members"] for end in own["ends"]]
    assert [row["moment_peak_n_m"] for row in rows] == [end["moment_peak_n_m"] for end in ends]


def test_a_file_of_somebody_else_stays(tmp_path: Path, towers: jostle.Model) -> None:
    result = jostle.run(towers)
    path = tmp_path / "mine.xlsx"
    book = openpyxl.Workbook()
    book.save(path)
    before = path.read_bytes()
    with pytest.raises(FileExistsError, match="no workbook of jostle"):
        result.to_excel(path)
    assert path.read_bytes() == before
    result.to_excel(path, force=True)
    # Its own is replaced.
    assert result.to_excel(path) == path
