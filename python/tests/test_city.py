"""Cities in Python: the numbers of the command line, shares, and a cluster that loses a worker."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import jostle


def parts(folder: Path) -> dict[str, bytes]:
    return {own.name: own.read_bytes() for own in sorted((folder / "runs").glob("*.parquet"))}


def test_a_city_is_that_of_the_command_line(program: Callable[..., Any], tmp_path: Path) -> None:
    file = jostle.example_city(tmp_path / "demo", buildings=120, seed=3)
    with pytest.raises(FileExistsError, match="force=True"):
        jostle.example_city(tmp_path / "demo")
    city = jostle.City(file, draws=2)
    seen: list[tuple[float, float]] = []
    result = city.run(tmp_path / "own", progress=lambda done, of: seen.append((done, of)))
    assert result.complete and city.cases == 2 * city.pairs
    found = result.report()
    done = program("city", "run", str(file), "--draws", "2", "--out", str(tmp_path / "command"))
    assert done.returncode == 0, done.stderr
    assert parts(tmp_path / "own") == parts(tmp_path / "command")
    assert f"struck by a neighbour: {100 * found.struck:.1f} %" in done.stdout
    assert f"{100 * found.moderate_alone:.1f} % alone, {100 * found.moderate:.1f} % with neighbours" in done.stdout
    loaded = jostle.CityResult.load(tmp_path / "own")
    shown = program("city", "model", str(tmp_path / "own"), "--pair", "1", "--draw", "1").stdout
    own, other = loaded.model(1, draw=1), jostle.Model.loads(shown)
    assert jostle.run(own).summary["gaps"] == jostle.run(other).summary["gaps"]
    with pytest.raises(jostle.ModelError, match="pair 100000: there are"):
        loaded.model(100000)
    with pytest.raises(jostle.ModelError, match="another city file"):
        jostle.City(file, draws=3).run(tmp_path / "own")


def test_footprints_are_counted_and_columns_named(tmp_path: Path) -> None:
    square = "POLYGON(({0} 0,{1} 0,{1} 10,{0} 10,{0} 0))"
    rows = ["name,FLOORS,wkt"]
    rows += [f'{name},{storeys},"{square.format(x, x + 10)}"' for name, storeys, x in [("a", 2, 0), ("b", 3, 10.1)]]
    table = tmp_path / "a.csv"
    table.write_text("\n".join(rows) + "\n")
    found = jostle.footprints(table, columns={"storeys": "FLOORS"}, metres=True, out=tmp_path / "out")
    assert (found.buildings, found.storeys_known, found.pairs, found.largest_block) == (2, 2, 1, 2)
    assert (tmp_path / "out" / "pairs.parquet").is_file()
    assert jostle.footprints(table, columns={"storeys": "FLOORS"}, metres=True, reach="5 cm").pairs == 0
    with pytest.raises(jostle.ModelError, match='"floors" is none of id, footprint'):
        jostle.footprints(table, columns={"floors": "FLOORS"}, metres=True)
    with pytest.raises(jostle.ModelError, match="reach: must be greater than 0"):
        jostle.footprints(table, reach=-1)


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_makes_the_same_bits_though_a_worker_is_killed(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    import dask

    file = jostle.example_city(tmp_path / "demo", buildings=900)
    # Several parts of 65,536 cases would take long: draws make them, and a short motion makes them quick.
    text = file.read_text().replace("[run]", "duration = \"1 s\"\n[run]\nsample = 0")
    file.write_text(text)
    city = jostle.City(file, draws=1000)
    assert city._core.parts > 4
    city.run(tmp_path / "alone")
    folder = tmp_path / "cluster"
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 10}),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        killed: list[int] = []

        def kill() -> None:
            while not list(folder.glob("runs/*.parquet")):
                time.sleep(0.01)
            victim = next(iter(client.run(os.getpid).values()))
            os.kill(victim, signal.SIGKILL)
            killed.append(victim)

        thread = threading.Thread(target=kill)
        thread.start()
        result = city.run(folder, client=client)
        thread.join()
    assert len(killed) == 1 and result.complete
    assert parts(folder) == parts(tmp_path / "alone")
