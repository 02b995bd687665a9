"""Studies from Python: the table of the command line, resumed, pickled, shared and spread over workers."""

from __future__ import annotations

import json
import os
import pickle
import signal
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import TOWERS

import jostle

VARY: list[dict[str, Any]] = [
    {"name": "gap", "path": "gap[0].width", "range": {"from": "2 mm", "to": "60 mm", "count": 10}},
    {"name": "pga", "path": "motion.pga", "values": ["1 m/s2", "0.2 g", 3.0, "4 m/s2"]},
    {"path": "motion.duration", "values": ["5 s"]},
]


def towers() -> jostle.Model:
    return jostle.Model.loads(TOWERS)


def study(**more: Any) -> jostle.Study:
    return jostle.Study(towers(), VARY, title="Towers", **more)


def table(folder: Path) -> dict[str, bytes]:
    assert not (folder / "under-way").exists()
    return {path.name: path.read_bytes() for path in (folder / "cases").glob("*.parquet")}


def test_rows_are_the_numbers_of_runs(tmp_path: Path) -> None:
    result = study().run(tmp_path / "out", jobs=2)
    assert result.complete and result.study.cases == 40
    assert result.report.is_file()
    gap, pga, force = result["gap_m"], result["input.pga_m_s2"], result["peak_force_n"]
    assert set(result["status"]) == {"completed"}
    for case in (0, 7, 22):
        # The duration of the study is part of the model; a run by hand needs the same.
        text = TOWERS.replace('duration = "12 s"', 'duration = "5 s"')
        one = jostle.run(jostle.Model.loads(text), gap=float(gap[case]), pga=float(pga[case]))
        assert one.summary["gaps"][0]["peak_force_n"] == pytest.approx(force[case], rel=1e-6)
        assert one.summary["gaps"][0]["impact_count"] == result["impact_count"][case]
    with pytest.raises(KeyError, match="peak_force_n"):
        result["force"]


def test_one_line_reads_the_table(tmp_path: Path) -> None:
    import pandas
    import polars

    result = study().run(tmp_path / "out")
    frame = polars.read_parquet(result.parts)
    assert frame.shape[0] == 40 and frame["case"].to_list() == list(range(40))
    assert result.to_polars().equals(frame)
    other = pandas.read_parquet(result.folder / "cases")
    np.testing.assert_array_equal(other["peak_force_n"], result["peak_force_n"])
    assert list(other.columns) == result.study.columns == list(result.to_pandas().columns)


def test_shares_of_a_study_make_the_whole_table(tmp_path: Path) -> None:
    whole = study()
    whole.run(tmp_path / "whole", jobs=1)
    shared = tmp_path / "shared"
    first = whole.run(shared, shard=(1, 3), report=False)
    assert not first.complete
    again = pickle.loads(pickle.dumps(whole))
    assert again.run(shared, shard=(3, 3), report=False).complete is False
    assert again.run(shared).complete
    assert table(shared) == table(tmp_path / "whole")


def test_studies_from_files_and_trees(tmp_path: Path) -> None:
    (tmp_path / "towers.toml").write_text(TOWERS, encoding="utf-8")
    path = tmp_path / "study.toml"
    path.write_text(
        'base = "towers.toml"\n[[vary]]\npath = "gap[0].width"\nvalues = ["20 mm", "40 mm"]\n',
        encoding="utf-8",
    )
    assert jostle.Study.load(path).cases == 2
    assert jostle.Study.load(path, model=jostle.Model.paper_example()).cases == 2
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(path.read_text().replace("width", "widht"), encoding="utf-8")
    with pytest.raises(jostle.ModelError, match=r"did you mean \"width\"") as caught:
        jostle.Study.load(wrong)
    assert caught.value.faults[0].line == 4
    assert jostle.Study(towers().changed(gap="3 mm"), VARY).cases == jostle.Study(towers(), VARY).cases
    drawn = jostle.Study(
        "paper",
        [{"name": "k", "path": "building[0].stiffness_factor", "distribution": {"kind": "uniform", "from": 0.3, "to": 0.7}}],
        design={"kind": "sobol", "samples": 8, "seed": 3},
    )
    assert (drawn.cases, drawn.seed) == (8, 3)


def test_the_smallest_gap(tmp_path: Path) -> None:
    (gap,) = jostle.critical_gap(towers())
    assert gap.pounding_at is not None and gap.gap - gap.pounding_at <= 1.001e-4
    assert gap.between == ("soft", "stiff")
    # Elastic towers under the other sign close as those under this one open.
    turned = jostle.Model.loads(TOWERS.replace('pga = "0.3 g"', 'pga = "0.3 g"\nreverse = true'))
    (other,) = jostle.critical_gap(turned, outcomes=False)
    assert gap.reversed_gap == pytest.approx(other.closing_without_contact, rel=1e-9)
    assert other.reversed_gap == pytest.approx(gap.closing_without_contact, rel=1e-9)
    assert jostle.run(towers(), gap=gap.gap).summary["gaps"][0]["impact_count"] == 0
    # The force of a touch that is hardly one hangs on the last digits of the gap.
    with pytest.warns(jostle.JostleWarning, match="sensitive"):
        assert jostle.run(towers(), gap=gap.pounding_at).summary["gaps"][0]["impact_count"] > 0
    widths = {rule.rule: rule.gap for rule in gap.rules}
    assert widths["SRSS"] <= widths["ABS"] and widths["ABS"] >= gap.gap
    (curve,) = jostle.critical_gap(towers(), outcomes=False, curve=5)
    # Both curves end where neither sign leads to an impact.
    assert gap.reversed_gap is not None
    end = max(gap.gap, gap.reversed_gap + 0.5e-4)
    for points in (curve.curve, curve.reversed_curve):
        assert [point.width for point in points] == pytest.approx([0.25 * n * end for n in range(5)])
        assert points[-1].impact_count == 0
    assert curve.curve[0].impact_count > 0 and curve.curve[0].peak_force > 0
    assert (curve.curve[-1].impact_count, curve.curve[-1].first_impact) == (0, None)
    with pytest.raises(jostle.ModelError, match="curve: must be"):
        jostle.critical_gap(towers(), curve=1)
    stronger = jostle.critical_gap(
        towers(), motions=["el-centro-1940-ns", "nanjing-artificial"], pga="0.6 g", outcomes=False
    )
    assert [one.motion for one in stronger] == ["el-centro-1940-ns", "nanjing-artificial"]
    # Elastic towers: twice the motion closes twice the gap.
    assert stronger[0].gap == pytest.approx(2 * gap.gap, abs=2e-4)
    with pytest.raises(jostle.ModelError, match="tolerance"):
        jostle.critical_gap(towers(), tolerance=0.0)
    with pytest.raises(jostle.ModelError, match="system"):
        jostle.critical_gap(towers(), system="timber")
    with pytest.raises(jostle.ModelError, match="codes: expected some of"):
        jostle.critical_gap(towers(), codes=["eurocode"])


def test_codes_and_their_inputs_can_be_chosen() -> None:
    (bare,) = jostle.critical_gap(towers(), codes=["asce7"], outcomes=False)
    assert bare.left_out[0][0] == "ASCE 7-16" and "response_modification" in bare.left_out[0][1]
    stated = jostle.Model.loads(TOWERS + "\n[codes]\ndeflection_amplification = 5.5\nresponse_modification = 8\n")
    (gap,) = jostle.critical_gap(stated, codes=["en1998", "asce7"], outcomes=False)
    rules = {rule.rule: rule for rule in gap.rules}
    codes = {rule.code for rule in gap.rules}
    assert codes == {None, "en1998", "asce7"} and gap.left_out == ()
    asce = rules["ASCE 7-16"]
    assert asce.gap == pytest.approx(5.5 / 8 * rules["SRSS"].gap)
    assert asce.inputs[0].endswith("C_d = 5.5, R = 8") and asce.setbacks is None
    line = rules["ASCE 7-16, line"]
    assert line.setbacks is not None and sum(line.setbacks) == pytest.approx(line.gap)
    reduced = jostle.Model.loads(TOWERS + '\n[codes]\nshow = "en1998"\nmotion = "reduced"\n')
    (gap,) = jostle.critical_gap(reduced, outcomes=False)
    assert [rule for rule, _ in gap.left_out] == ["EN 1998-1"]
    assert gap.left_out[0][1].startswith('behaviour_factor of "soft"')


def test_records_of_a_model_vary_by_themselves(tmp_path: Path) -> None:
    names = ["el-centro-1940-ns", "nanjing-artificial"]
    listed = ", ".join(f'"{name}"' for name in names)
    model = jostle.Model.loads(TOWERS.replace('"el-centro-1940-ns"', f"[{listed}]"))
    assert model.records == names and towers().records == []
    with pytest.raises(jostle.ModelError, match="list of 2 records") as caught:
        jostle.run(model)
    assert 'motion="el-centro-1940-ns"' in str(caught.value)
    assert jostle.run(model, motion=names[1], record_interval=None).summary["motion"]["name"] == names[1]
    assert "2 records" in model._repr_html_()
    assert [gap.motion for gap in jostle.critical_gap(model, outcomes=False)] == names
    spectrum = {"code": "gb50011", "intensity": 7, "site": "II", "group": 1}
    result = jostle.Study(model, selection={"spectrum": spectrum}).run(tmp_path)
    assert list(result["motion"]) == names
    checked = json.loads((tmp_path / "selection.json").read_text(encoding="utf-8"))
    assert checked["passes"] is False
    assert [one["structure"] for one in checked["structures"]] == ["soft", "stiff"]


@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.usefixtures("ctrl_c")
def test_ctrl_c_stops_a_study_and_the_rest_goes_on(tmp_path: Path) -> None:
    vary = [{**VARY[0], "range": {"from": "2 mm", "to": "60 mm", "count": 4000}}]
    long = jostle.Study(towers(), vary)
    timer = threading.Timer(0.5, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long.run(tmp_path / "out")
    timer.join()
    left = list((tmp_path / "out").rglob("part-*"))
    assert left, "finished cases stay"


@pytest.mark.filterwarnings("ignore")
def test_workers_of_a_cluster_one_of_which_is_killed(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    vary = [{**VARY[0], "range": {"from": "2 mm", "to": "60 mm", "count": 60}}, VARY[1]]
    big = jostle.Study(towers(), vary)
    big.run(tmp_path / "alone", report=False)
    folder = tmp_path / "cluster"
    settings = {"distributed.scheduler.allowed-failures": 10}
    import dask

    with (
        dask.config.set(settings),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        killed: list[int] = []

        def kill() -> None:
            # Midway: when some parts are there and others are not.
            while len(list(folder.glob("cases/*.parquet"))) < 3:
                time.sleep(0.01)
            victim = next(iter(client.run(os.getpid).values()))
            os.kill(victim, signal.SIGKILL)
            killed.append(victim)

        thread = threading.Thread(target=kill)
        thread.start()
        result = big.run(folder, client=client)
        thread.join()
    assert len(killed) == 1
    assert result.complete and result.report.is_file()
    assert table(folder) == table(tmp_path / "alone")


@pytest.mark.filterwarnings("ignore")
def test_the_only_busy_worker_is_killed(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    # One part, so that one of two workers is idle.
    vary = [{**VARY[0], "range": {"from": "2 mm", "to": "60 mm", "count": 16}}]
    model = jostle.Model.loads(TOWERS.replace('duration = "12 s"', 'duration = "2000 s"'))
    small = jostle.Study(model, vary)
    folder = tmp_path / "cluster"
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        processes = client.run(os.getpid)
        killed: list[int] = []

        def kill() -> None:
            # While the part is under way.
            while not list(folder.glob("under-way/*.journal")):
                time.sleep(0.01)
            with distributed.Client(cluster.scheduler_address) as other:
                busy = [worker for worker, tasks in other.processing().items() if tasks]
            for worker in busy[:1]:
                os.kill(processes[worker], signal.SIGKILL)
                killed.append(processes[worker])

        thread = threading.Thread(target=kill)
        thread.start()
        result = small.run(folder, client=client, report=False)
        thread.join()
    assert len(killed) == 1
    assert result.complete


@pytest.mark.filterwarnings("ignore")
def test_workers_that_pause_and_a_client_that_comes_back(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    vary = [{**VARY[0], "range": {"from": "2 mm", "to": "60 mm", "count": 60}}, VARY[1]]
    big = jostle.Study(towers(), vary)
    big.run(tmp_path / "alone", report=False)
    folder = tmp_path / "cluster"

    def parts() -> int:
        return len(list(folder.glob("cases/*.parquet")))

    class Enough(Exception):
        """The client goes away."""

    def leave(finished: float, cases: float) -> None:
        if finished >= 2:
            raise Enough

    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        with pytest.raises(Enough):
            big.run(folder, client=client, progress=leave)
        before = parts()
        assert before > 0
        # One of two workers stands still for a while; the same call goes on with what is left.
        paused = next(iter(client.run(os.getpid).values()))
        os.kill(paused, signal.SIGSTOP)
        timer = threading.Timer(3.0, os.kill, (paused, signal.SIGCONT))
        timer.start()
        result = big.run(folder, client=client)
        timer.join()
    assert result.complete and result.report.is_file()
    assert table(folder) == table(tmp_path / "alone")


def test_inputs_come_from_a_table(tmp_path: Path) -> None:
    polars = pytest.importorskip("polars")
    rows = polars.DataFrame({"gap[0].width": [0.01, 0.02, 0.03], "motion.pga": ["1 m/s2", "2 m/s2", "3 m/s2"]})
    rows.write_parquet(tmp_path / "rows.parquet", compression="snappy")
    many = jostle.Study(towers(), [{"table": str(tmp_path / "rows.parquet")}])
    assert many.cases == 3
    result = many.run(tmp_path / "out", csv=True)
    assert (tmp_path / "out" / "cases.csv").is_file()
    np.testing.assert_array_equal(result["gap0.width"], [0.01, 0.02, 0.03])
    np.testing.assert_allclose(result["pga_m_s2"], [1.0, 2.0, 3.0], rtol=1e-9)
