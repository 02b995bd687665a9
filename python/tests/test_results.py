"""Histories, contacts, tables, pictures and pages of a run."""

from __future__ import annotations

import gc
import pickle
from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import TOWERS

import jostle


def test_checks_are_worst_first_and_can_be_silenced() -> None:
    text = TOWERS.replace('pga = "0.3 g"', 'pga = "1.5 g"')
    found = jostle.run(jostle.Model.loads(text)).checks
    grades = [{"remark": 0, "note": 1, "warning": 2}[own["grade"]] for own in found]
    assert grades == sorted(grades, reverse=True) and grades[0] == 2
    assert {"id", "value", "limit", "where", "text"} <= set(found[0])
    silenced = jostle.run(jostle.Model.loads(text + "\n[report]\nsilence = ['A12']\n")).checks
    assert [own for own in found if own["id"] != "A12"] == silenced and len(silenced) < len(found)
    with pytest.raises(jostle.ModelError, match="did you mean"):
        jostle.Model.loads(text + "\n[report]\nsilence = ['A99']\n")


def test_histories_are_views_that_nobody_writes_to(result: jostle.Result) -> None:
    floor = result.floor("soft", 3)
    for values in (result.time, floor.displacement, floor.velocity, result.contacts[0].force):
        assert values.dtype == np.float64 and values.shape == result.time.shape
        assert values.flags.c_contiguous and not values.flags.owndata
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1.0
        with pytest.raises(ValueError, match="WRITEABLE"):
            values.flags.writeable = True
    assert np.shares_memory(floor.displacement, result.floor(0, -1).displacement)
    assert np.shares_memory(floor.displacement, result.history["soft.floor3.displacement_m"])


def test_views_outlive_the_result(towers: jostle.Model, result: jostle.Result) -> None:
    kept = jostle.run(towers).floor("stiff", 1).displacement
    gc.collect()
    assert np.array_equal(kept, result.floor("stiff", 1).displacement)


def test_histories_agree_with_the_summary(result: jostle.Result) -> None:
    summary = result.summary
    roof = summary["buildings"][0]["floors"][-1]
    displacement = result.floor("soft", -1).displacement
    # Peaks lie between recorded instants.
    assert displacement.max() == pytest.approx(roof["displacement_max_m"], rel=5e-3)
    assert displacement.max() <= roof["displacement_max_m"]
    assert np.all(np.diff(result.time) > 0)
    assert sum(contact.impact_count for contact in result.contacts) == len(result.impacts) > 0


def test_impulses_are_the_areas_under_the_forces(towers: jostle.Model) -> None:
    # Trapezia need more points than forces that are parabolas.
    result = jostle.run(towers, record_interval="0.25 ms")
    for contact, told in zip(result.contacts, result.summary["gaps"][0]["contacts"]):
        force, time = contact.force, result.time
        area = np.sum((force[1:] + force[:-1]) / 2 * np.diff(time))
        assert area == pytest.approx(told["impulse_n_s"], rel=2e-3, abs=1.0)
        assert contact.between == ("soft", "stiff") and contact.floors == (contact.floors[0],) * 2


def test_energies_balance(result: jostle.Result) -> None:
    energies = result.energies
    spent = sum(energies[name] for name in energies if name != "input")
    assert np.abs(energies["input"] - spent).max() < 1e-8 * np.abs(energies["input"]).max()


def test_one_storey_moves_as_the_closed_form_says() -> None:
    mass, stiffness, omega = 4e4, 6e7, 2 * np.pi / 0.7
    building = jostle.Shear(
        "one", mass=[mass], stiffness=[stiffness], storey_height=3, damping={"alpha": 0, "beta": 0}
    )
    shaking = jostle.Motion.sine(amplitude="2 m/s2", period="0.7 s", duration="4 s")
    result = jostle.run(
        jostle.Model([building], motion=shaking, analysis={"step": 2e-4}), record_interval=0
    )
    natural = np.sqrt(stiffness / mass)
    t = result.time
    forced = -2.0 / (natural**2 - omega**2)
    exact = forced * (np.sin(omega * t) - omega / natural * np.sin(natural * t))
    error = np.abs(result.floor("one", 1).displacement - exact).max()
    # Newmark lengthens periods by (ω h)²/12 = 5e-6: after 25 periods 8e-4 of the free part.
    assert error < 1e-3 * np.abs(exact).max()
    assert result.contacts == () and result.without_contact is None
    assert len(result.impacts) == 0 and result.impacts["peak_force_n"].shape == (0,)


def test_tables_go_where_users_are(result: jostle.Result) -> None:
    table = result.history
    assert len(table) == len(result.time) and "time_s" in table
    in_polars, in_arrow = pl.DataFrame(table), pa.table(table)
    in_pandas = table.to_pandas()
    # pandas takes Arrow tables itself from version 3 on.
    by_arrow = getattr(pd.DataFrame, "from_arrow", lambda table: pa.table(table).to_pandas())(table)
    assert in_polars.columns == in_arrow.column_names == table.columns == list(in_pandas.columns)
    for name in table.columns:
        ours = table[name]
        assert np.array_equal(in_polars[name].to_numpy(), ours)
        assert np.array_equal(in_arrow[name].to_numpy(), ours)
        assert np.array_equal(in_pandas[name].to_numpy(), ours)
        assert np.array_equal(by_arrow[name].to_numpy(), ours)
    assert pa.schema(table).names == table.columns


def test_impacts_are_in_the_order_of_time() -> None:
    impacts = jostle.run("paper", gap="5 mm", pga="100 cm/s2", record_interval=None).impacts
    starts = impacts["start_s"]
    assert len(set(impacts["left_floor"])) > 1, "several contacts"
    assert np.all(np.diff(starts) >= 0.0)


def test_rows_of_impacts(result: jostle.Result) -> None:
    impacts = result.impacts
    rows = list(impacts)
    assert len(rows) == len(impacts) and rows[-1] == impacts[-1] and rows[0] == impacts[0]
    told = [i for c in result.summary["gaps"][0]["contacts"] for i in c["impacts"]]
    told.sort(key=lambda impact: impact["start_s"])
    for row, impact in zip(rows, told):
        assert {key: row[key] for key in impact} == impact
        assert row["gap"] == "soft-stiff" and isinstance(row["left_floor"], int)
    assert pl.DataFrame(impacts).height == len(rows) == len(impacts.to_pandas())
    with pytest.raises(IndexError):
        impacts[len(impacts)]
    with pytest.raises(KeyError, match="peak_force_n"):
        impacts["peak_force"]


def test_contacts_between_floors_have_no_floor(towers: jostle.Model) -> None:
    tower = {"kind": "frame", "storeys": 2, "storey_height": "3 m", "spans": ["6 m"], "concrete": "C30",
             "column": {"width": "400 mm", "depth": "400 mm"}, "beam": {"width": "300 mm", "depth": "600 mm"},
             "beam_mass": "3600 kg/m"}  # fmt: skip
    other = {"kind": "shear", "storeys": 2, "mass": "90 t", "stiffness": "400 MN/m", "storey_height": "2.25 m"}
    model = jostle.Model([tower, other], jostle.Gap(width_mm=2, floors=["2.25 m"]))
    result = jostle.run(model, motion=jostle.Motion.el_centro().scaled(pga="0.4 g").lasting("6 s"))
    assert len(result.impacts) > 0
    assert result.impacts[0]["left_floor"] is None and result.impacts[0]["right_floor"] == 1
    assert pa.table(result.impacts)["left_floor"].null_count == len(result.impacts)
    assert result.contacts[0].floors == (None, 1)


@pytest.mark.filterwarnings("ignore::jostle.ModelWarning")
def test_links_have_forces_and_take_energy() -> None:
    row = [jostle.Shear(n, storeys=2, mass="90 t", stiffness=k, storey_height=3) for n, k in [("a", "40 MN/m"), ("b", "90 MN/m")]]
    gap = jostle.Gap("10 mm", between=["b", "wall"])
    link = jostle.Link(["a", "b"], damping="1 MN.s/m", floors=[[2, 2]])
    model = jostle.Model(row, gap, links=link)
    result = jostle.run(model, motion=jostle.Motion.el_centro().scaled(pga="0.4 g").lasting("6 s"))
    [damper] = result.links
    assert damper.between == ("a", "b") and damper.floors == (2, 2) and damper.height == 6
    assert abs(abs(damper.peak_force) - abs(damper.force).max()) < 1e-3 * abs(damper.peak_force)
    # A dashpot alone: force over damping is the closing rate.
    rate = result.floor("a", 2).velocity - result.floor("b", 2).velocity
    assert abs(damper.force - 1e6 * rate).max() < 1e-6 * abs(damper.force).max()
    energy = result.summary["energy"]
    assert 0 < damper.dissipated == pytest.approx(energy["links_j"], rel=1e-9)
    assert energy["links_j"] < energy["damped_j"] and energy["worst_imbalance"] < 1e-9
    assert result.contacts[0].between == ("b", "wall") and result.contacts[0].floors == (1, None)
    assert "a-b.link2-2.force_n" in result.history.columns


def test_floors_are_found(result: jostle.Result) -> None:
    assert result.floor("stiff", 2).building == result.floor(1, 2).building == "stiff"
    assert result.floor(-1, -1).floor == 3
    with pytest.raises(ValueError, match="'stif'; the buildings are soft, stiff"):
        result.floor("stif", 1)
    with pytest.raises(ValueError, match="has floors 1 to 3"):
        result.floor("stiff", 4)
    with pytest.raises(ValueError, match="has floors 1 to 3"):
        result.floor("stiff", 0)
    with pytest.raises(ValueError, match="there are 2"):
        result.floor(2, 1)


def test_runs_without_histories(towers: jostle.Model, result: jostle.Result) -> None:
    recursion = jostle.Model.loads(TOWERS + '[analysis]\nsolver = "riccati"')
    bare, full = (jostle.run(recursion, record_interval=every) for every in (None, "5 ms"))
    assert bare.summary["gaps"] == full.summary["gaps"]
    assert bare.impacts[0] == full.impacts[0]
    # Rows are steps of modal stepping: they move the last digits.
    bare = jostle.run(towers, record_interval=None)
    few, many = ([c["peak_force_n"] for c in r.summary["gaps"][0]["contacts"]] for r in (bare, result))
    assert few == pytest.approx(many, rel=1e-6) and len(bare.impacts) == len(result.impacts)
    with pytest.raises(ValueError, match="no histories were recorded"):
        _ = bare.time
    assert len(bare.history) == 0 and pa.table(bare.history).num_columns == 0
    assert "svg" not in bare._repr_html_()
    with pytest.raises(ValueError, match="must not be negative"):
        jostle.run(towers, record_interval=-1.0)


def test_pounding_can_be_left_out(towers: jostle.Model, result: jostle.Result) -> None:
    free = jostle.run(towers, pounding=False)
    assert len(free.impacts) == 0
    twin = result.without_contact
    assert twin is not None and twin.summary["buildings"] == free.summary["buildings"]
    with_twin = jostle.run(towers, without_contact=True)
    closing = with_twin.summary["gaps"][0]["closing_without_contact_m"]
    assert closing == max(c["closing_peak_m"] for c in free.summary["gaps"][0]["contacts"])
    # What it says: from that width on they no longer touch, though they miss by less than the error of the run.
    with pytest.warns(jostle.JostleWarning, match="sensitive"):
        assert len(jostle.run(towers, gap=closing * (1 + 1e-9)).impacts) == 0
    # So may a touch be that is hardly one.
    with pytest.warns(jostle.JostleWarning, match="sensitive"):
        assert len(jostle.run(towers, gap=closing * 0.9999).impacts) > 0
    # Further apart than the error, it is decided.
    assert len(jostle.run(towers, gap=closing * 1.001).impacts) == 0


def test_plot(result: jostle.Result, tmp_path: Path) -> None:
    figure = result.plot()
    assert len(figure.axes) == 3
    lines = figure.axes[0].get_lines()
    assert np.array_equal(lines[0].get_ydata(), 1e3 * result.floor("soft", -1).displacement)
    figure.savefig(tmp_path / "x.png")
    import matplotlib.pyplot as plt

    plt.close(figure)


def test_pages(result: jostle.Result, tmp_path: Path) -> None:
    path = result.report(tmp_path / "x.html")
    page = path.read_text(encoding="utf-8")
    assert page.startswith("<!DOCTYPE html>") and "also without contact" in page
    assert "src=" not in page.split("<body")[0]
    animation = result.animate()
    assert "display:none" in animation.save(tmp_path / "a.html").read_text(encoding="utf-8")
    with pytest.raises(OSError, match="cannot be written"):
        result.report(tmp_path / "no" / "such" / "x.html")


def test_files_of_others_are_kept(result: jostle.Result, tmp_path: Path) -> None:
    mine = tmp_path / "report.html"
    mine.write_text("mine", encoding="utf-8")
    for write in (result.report, result.animate().save):
        with pytest.raises(FileExistsError, match="pass force=True"):
            write(mine)
    with pytest.raises(FileExistsError, match="report.html"):
        result.save(tmp_path)
    assert mine.read_text(encoding="utf-8") == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]
    result.report(mine, force=True)
    result.report(mine)


def test_results_stay_where_they_are(result: jostle.Result) -> None:
    with pytest.raises(TypeError, match="cannot be pickled; send result.summary"):
        pickle.dumps(result)


def test_the_published_form_runs_where_it_keeps_its_digits() -> None:
    building = {"kind": "shear", "storeys": 1, "mass": "40 t", "stiffness": "60 MN/m", "storey_height": 3}
    model = jostle.Model([building], motion="el-centro", analysis={"solver": "product"})
    assert jostle.run(model).completed


def test_lost_digits_are_refused_unless_forced() -> None:
    tree = {
        "building": [{"kind": "frame", "storeys": 30, "storey_height": "3.2 m", "spans": ["6 m"], "concrete": "C30",
                      "column": {"width": "500 mm", "depth": "500 mm"}, "beam": {"width": "300 mm", "depth": "600 mm"},
                      "beam_mass": "3600 kg/m"}],
        "analysis": {"solver": "product", "step": "0.5 ms"},
        "motion": {"record": "el-centro", "duration": "0.05 s"},
    }  # fmt: skip
    model = jostle.Model.from_dict(tree)
    with pytest.raises(jostle.ModelError, match="force=True runs it anyway") as caught:
        jostle.run(model)
    assert caught.value.faults[0].path == "analysis.solver"
    with pytest.warns(jostle.JostleWarning):
        try:
            jostle.run(model, force=True)
        except jostle.AnalysisError as error:
            assert error.result is not None


def test_forces_of_columns_and_beams() -> None:
    frame = jostle.Frame(
        "A",
        storeys=2,
        storey_height="3.2 m",
        spans=["6 m"],
        column={"width": "500 mm", "depth": "500 mm"},
        beam={"width": "300 mm", "depth": "600 mm"},
        elastic_modulus="30 GPa",
        beam_mass="3600 kg/m",
    )
    motion = {"kind": "sine", "amplitude": "1 m/s2", "period": "0.6 s", "duration": "3 s"}
    result = jostle.run(jostle.Model([frame], motion=motion, output={"members": ["A.column.1.1"]}))
    greatest, history = result.members("A"), result.member_history
    assert history is not None and set(history["member"]) == {"A.column.1.1"}
    # Two columns in each of two storeys, two beams, both ends of each.
    assert len(greatest) == 12
    own = [row for row, name in enumerate(greatest["member"]) if name == "A.column.1.1"]
    peak = max(greatest["shear_peak_n"][row] for row in own)
    assert np.abs(history["shear_n"]).max() == pytest.approx(peak, rel=1e-2)

    with pytest.raises(ValueError, match=r'output=\{"members": True\}'):
        jostle.run(jostle.Model([frame], motion=motion)).members()


def test_buildings_and_floors_are_compared_with_the_run_without_contact(result: jostle.Result) -> None:
    without = result.without_contact
    assert without is not None
    for table, rows, alone in (
        (result.buildings, result.summary["buildings"], without.summary["buildings"]),
        (
            result.floors,
            [floor for building in result.summary["buildings"] for floor in building["floors"]],
            [floor for building in without.summary["buildings"] for floor in building["floors"]],
        ),
    ):
        assert len(table) == len(rows)
        stems = [name.removesuffix("_amplification") for name in table.columns if name.endswith("_amplification")]
        assert len(stems) >= 6
        for stem in stems:
            other = next(name for name in table.columns if name.startswith(f"{stem}_without_contact"))
            name = other.replace("_without_contact", "")
            for at, (row, single) in enumerate(zip(rows, alone)):
                if name not in row or row[name] is None:
                    continue
                assert table[name][at] == row[name]
                assert table[other][at] == pytest.approx(single[name], rel=1e-12)
                if single[name]:
                    ratio = abs(row[name] / single[name])
                    assert table[f"{stem}_amplification"][at] == pytest.approx(ratio, rel=1e-12)
    assert pl.DataFrame(result.floors).height == len(result.floors)
    assert result.floors["building"][0] == "soft"


def test_heights_of_struck_points_are_not_rounded() -> None:
    frame = jostle.Frame(
        "A",
        storeys=2,
        storey_height="3.5 m",
        spans=["6 m"],
        column={"width": "500 mm", "depth": "500 mm"},
        beam={"width": "300 mm", "depth": "600 mm"},
        elastic_modulus="30 GPa",
        beam_mass="3600 kg/m",
    )
    low = jostle.Shear("B", mass=["40 t"], stiffness="60 MN/m", storey_height="1.75 m")
    gap = jostle.Gap(between=("A", "B"), width="5 mm", floors="all")
    motion = {"kind": "sine", "amplitude": "2 m/s2", "period": "0.4 s", "duration": "2 s"}
    model = jostle.Model([frame, low], gaps=[gap], motion=motion, output={"members": True})
    heights = jostle.run(model).members("A")["struck_height_m"]
    assert sorted(set(np.ma.compressed(heights))) == [1.75]


def test_demand_over_capacity() -> None:
    def frame(ties: bool) -> jostle.Frame:
        bars = {"concrete": "C30", "steel": "HRB400"} | ({"ties": "d10 @ 150 mm"} if ties else {})
        return jostle.Frame(
            "A",
            storeys=2,
            storey_height="3.2 m",
            spans=["6 m"],
            column={"width": "500 mm", "depth": "500 mm", "bars": "12 d20"} | bars,
            beam={"width": "300 mm", "depth": "600 mm", "bars": "4 d20 top, 4 d20 bottom"} | bars,
            beam_mass="3600 kg/m",
        )

    motion = {"kind": "sine", "amplitude": "4 m/s2", "period": "0.6 s", "duration": "3 s"}
    model = jostle.Model([frame(True)], motion=motion, output={"capacity": ["en1998-3", "gb50010"]})
    result = jostle.run(model)
    table = result.capacity("A")
    # Four columns, two beams and four joints by two rules.
    assert len(table) == 20 and list(table["rule"][:2]) == ["en1998-3", "gb50010"]
    joints = [".joint." in name for name in table["member"]]
    assert sum(joints) == 8
    worst = result.summary["buildings"][0]["capacity"]["worst"]
    own = [row for row, rule in enumerate(table["rule"]) if rule == "en1998-3" and not joints[row]]
    greatest = max(max(table["shear_ratio"][row], table["bending_ratio"][row]) for row in own)
    assert greatest == pytest.approx(worst["ratio"])
    # The same shear over the capacity of the same instant.
    peaks = result.members("A")
    for row in own:
        name = table["member"][row]
        shear = max(peaks["shear_peak_n"][k] for k, other in enumerate(peaks["member"]) if other == name)
        assert table["shear_ratio"][row] * table["shear_capacity_n"][row] <= shear * (1 + 1e-6)

    with pytest.raises(ValueError, match="bars and ties"):
        jostle.run(jostle.Model([frame(False)], motion=motion, output={"members": True})).capacity()
