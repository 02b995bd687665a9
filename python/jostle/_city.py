"""Which neighbours of a city collide, and the fragility of classes of buildings."""

from __future__ import annotations

import contextlib
import json
import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _jostle
from ._cluster import run_parts
from ._errors import ModelError, ModelWarning
from ._model import Model
from ._progress import CountLine
from ._units import Quantity, in_si

#: Receives the numbers of finished cases and of all cases.
Observer = Callable[[float, float], object]


@dataclass(frozen=True)
class Footprints:
    """Contents of a footprint file: the result of :func:`footprints`.

    Attributes:
        rows: rows of the file.
        buildings: buildings that are kept.
        columns: attribute and name of the column that holds it.
        storeys_known: buildings whose storeys are given.
        heights_known: buildings whose height is given.
        years_known: buildings whose year of construction is given.
        types_known: buildings whose structural type is given.
        mends: what was repaired, omitted or assumed, and how often.
        pairs: pairs of neighbours.
        overlaps: pairs of outlines that overlap by more than a fifth of the smaller one; they do not count as neighbours.
        with_neighbours: buildings that have a neighbour.
        inside: pairs inside a row of buildings.
        at_end: pairs at the end of a row.
        at_corner: pairs around a corner of a block.
        blocks: blocks of neighbours.
        largest_block: buildings of the largest block.

    Examples:
        >>> import jostle
        >>> file = jostle.example_city("demo", buildings=60)
        >>> jostle.footprints(file.parent / "city.geojson").pairs
        22
    """

    rows: int
    buildings: int
    columns: Mapping[str, str]
    storeys_known: int
    heights_known: int
    years_known: int
    types_known: int
    mends: Mapping[str, int]
    pairs: int
    overlaps: int
    with_neighbours: int
    inside: int
    at_end: int
    at_corner: int
    blocks: int
    largest_block: int


def footprints(
    path: str | os.PathLike[str],
    *,
    columns: Mapping[str, str] | None = None,
    metres: bool = False,
    reach: Quantity = 0.5,
    out: str | os.PathLike[str] | None = None,
) -> Footprints:
    """Reads footprints and finds pairs of neighbours, like ``jostle city check`` and ``jostle city pairs``.

    Args:
        path: GeoJSON, GeoParquet, or CSV with outlines as WKT or GeoJSON.
        columns: names of columns that differ from the usual ones, such as ``{"storeys": "FLOORS"}``; attributes are
            id, footprint, storeys, height, year and type.
        metres: whether coordinates are in metres instead of degrees of longitude and latitude.
        reach: greatest distance between neighbours on the map; 0 to 100 m.
        out: folder for ``buildings.parquet``, ``pairs.parquet``, ``blocks.parquet`` and ``mended.csv``.

    Raises:
        ModelError: the file cannot be used; the message names row and column.

    Examples:
        >>> import jostle
        >>> file = jostle.example_city("demo", buildings=60)
        >>> jostle.footprints(file.parent / "city.geojson", reach="0.2 m").largest_block
        4
    """
    meters = in_si("reach", reach, "length")
    if not 0 < meters <= 100:
        raise ModelError(f"reach: must be greater than 0 and at most 100 m, found {meters} m")
    folder = None if out is None else os.fspath(out)
    found = _jostle.footprints(os.fspath(path), dict(columns or {}), metres, meters, folder)
    return Footprints(**json.loads(found))


def city_types() -> str:
    """Returns the default table of structural types of cities and classes, as the text of a CSV file.

    Write it to a file, replace rows, and name the file in ``[buildings] table`` of a city file or a classes file.

    Examples:
        >>> import jostle
        >>> [row.split(",")[0] for row in jostle.city_types().splitlines() if row.startswith("C1L,high")]
        ['C1L']
    """
    return _jostle.city_types()


def example_city(
    folder: str | os.PathLike[str], *, buildings: int = 2000, seed: int = 1, force: bool = False
) -> Path:
    """Writes an invented city as an example, ``city.geojson`` and ``city.toml``, and returns the path of ``city.toml``.

    Args:
        folder: where to write.
        buildings: number of buildings, up to 2 000 000.
        seed: random seed.
        force: true replaces existing files.

    Raises:
        FileExistsError: a file already exists.

    Examples:
        >>> import jostle
        >>> jostle.example_city("demo", buildings=60).name
        'city.toml'
    """
    if seed < 0:
        raise ModelError(f"seed: must not be negative, found {seed}")
    target = Path(folder)
    texts = dict(zip(("city.geojson", "city.toml"), _jostle.example_city(buildings, seed), strict=True))
    for name in texts:
        if (target / name).exists() and not force:
            raise FileExistsError(f"{target / name} exists; choose another folder, or pass force=True")
    target.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (target / name).write_text(text, encoding="utf-8")
    return target / "city.toml"


class City:
    """A city file with its footprints, neighbours and motions.

    Args:
        path: the city file.
        draws: number of random draws of gaps and buildings for every motion, instead of that in the file.
        tolerance: relative error of peaks, 0.001 to 0.1, instead of that of the file.

    Raises:
        ModelError: the city file, its footprints or its motions cannot be used.

    Attributes:
        title: title of the pages.
        buildings: buildings of the inventory.
        pairs: pairs of neighbours.
        cases: pairs times draws times motions.
        motions: names of the motions.
        notes: how motions that differ between sites were obtained.

    Examples:
        >>> import jostle
        >>> city = jostle.City(jostle.example_city("demo", buildings=60))
        >>> city.pairs
        22
        >>> found = city.run("city-results").report()
        >>> 0 < found.struck_double_gaps < found.struck < found.struck_half_gaps < 1
        True
    """

    def __init__(
        self, path: str | os.PathLike[str], *, draws: int | None = None, tolerance: float | None = None
    ) -> None:
        self._recipe = (os.path.abspath(os.fspath(path)), draws, tolerance)
        self._take(_jostle.City.read(*self._recipe))
        if not self._facts["gap_is_given"]:
            text = "gap.median is not given: gaps have a median of 25 mm, which nobody has measured; look at half and double of it"
            warnings.warn(text, ModelWarning, stacklevel=2)
        for text in self._facts["warnings"]:
            warnings.warn(text, ModelWarning, stacklevel=2)

    def _take(self, core: _jostle.City) -> None:
        self._core = core
        self._facts: dict[str, Any] = json.loads(core.facts())
        self.title: str = self._facts["title"]
        self.buildings: int = self._facts["buildings"]
        self.pairs: int = self._facts["pairs"]
        self.cases: int = self._facts["cases"]
        self.motions: list[str] = self._facts["motions"]
        self.notes: list[str] = self._facts["notes"]

    def run(
        self,
        out: str | os.PathLike[str],
        *,
        jobs: int | None = None,
        shard: tuple[int, int] | None = None,
        client: Any = None,
        progress: bool | Observer = False,
    ) -> CityResult:
        """Runs the missing parts of a folder, with and without contact.

        After any interruption, the same call continues and gives bit-identical results.

        Args:
            out: folder of the results; with a client, one that all workers can access.
            jobs: threads; by default one per core. No effect with a client.
            shard: ``(i, n)`` computes the i-th of n shares of the parts, i from 1; all may use one folder.
            client: a ``dask.distributed.Client``: its workers compute the parts. If one dies, another computes its part again.
                Workers read the city file by its path.
            progress: true shows a line on a terminal; or a function called with the numbers of finished cases and of all cases.

        Raises:
            ModelError: the folder holds the run of another city, or an argument is wrong.
            OSError: a file cannot be written; finished parts are kept.
        """
        folder = os.path.abspath(os.fspath(out))
        if jobs is not None and jobs < 1:
            raise ModelError(f"jobs: must be at least 1, found {jobs}")
        if shard is not None and not 1 <= shard[0] <= shard[1]:
            raise ModelError(f"shard: expected (i, n) with i from 1 to n, found {shard}")
        observer = None if isinstance(progress, bool) else progress
        with CountLine("cases") if progress is True else contextlib.nullcontext() as line:
            observer = observer if line is None else line
            if client is None:
                self._core.run(folder, jobs, shard, observer)
            elif shard is not None:
                raise ModelError("shard: does not go with a client, which shares the work by itself")
            else:
                self._run_on(client, folder, observer)
        return CityResult(self, Path(folder))

    def _run_on(self, client: Any, folder: str, observer: Observer | None) -> None:
        """Submits every missing part to the workers of a client."""

        def told(done: int, parts: int) -> None:
            if observer is not None:
                observer(self.cases * done / parts, float(self.cases))

        run_parts(client, self._core, folder, _compute, self._recipe, f"jostle-city-{id(self)}", told)

    def __repr__(self) -> str:
        return f"<City {self.title!r}: {self.buildings} buildings, {self.pairs} pairs>"


#: The city that this worker has read.
_held: dict[tuple[str, int | None, float | None], _jostle.City] = {}


def _compute(recipe: tuple[str, int | None, float | None], folder: str, part: int) -> None:
    """Computes a part in a worker, which reads a city once."""
    if recipe not in _held:
        _held.clear()
        _held[recipe] = _jostle.City.read(*recipe)
    _held[recipe].run_part(folder, part)


@dataclass(frozen=True)
class CitySummary:
    """Means over the buildings with a neighbour, from 0 to 1: the result of :meth:`CityResult.report`.

    Attributes:
        buildings: buildings with a neighbour.
        struck_half_gaps: probability of being struck if gaps have half the median.
        struck: the same at the median.
        struck_double_gaps: the same at twice the median.
        column_strike: probability that a slab strikes columns.
        moderate_alone: probability of moderate or worse damage without neighbours.
        moderate: the same with neighbours.
        worse: fraction of samples in which contact worsens the damage state.
        better: fraction of samples in which contact improves the damage state.
        sample_rows: rows that were repeated with the standard solvers.
        sample_within: fraction of the peaks of these rows within the tolerance; ``None`` if there are none.
        sample_worst: greatest deviation; ``None`` if there are none.

    Examples:
        >>> import jostle
        >>> city = jostle.City(jostle.example_city("demo", buildings=60))
        >>> city.run("city-results").report().buildings
        28
    """

    buildings: int
    struck_half_gaps: float
    struck: float
    struck_double_gaps: float
    column_strike: float
    moderate_alone: float
    moderate: float
    worse: float
    better: float
    sample_rows: int
    sample_within: float | None
    sample_worst: float | None


@dataclass(frozen=True)
class CityResult:
    """The folder of a run of a city.

    ``polars.read_parquet(result.cases)`` and DuckDB's ``FROM 'folder/runs/*.parquet'`` read every pair, draw and motion.

    Attributes:
        city: the city.
        folder: its folder.

    Examples:
        >>> import jostle
        >>> city = jostle.City(jostle.example_city("demo", buildings=60))
        >>> result = city.run("city-results")
        >>> result.complete
        True
        >>> len(jostle.run(result.model(3, draw=1)).summary["gaps"])  # in the whole row
        3
    """

    city: City
    folder: Path

    @classmethod
    def load(cls, folder: str | os.PathLike[str]) -> CityResult:
        """Loads the run in a folder; the city file must still have the same path.

        Raises:
            ModelError: the folder holds no run, or its city file, footprints or motions have changed.
        """
        city = City.__new__(City)
        city._take(_jostle.City.of_folder(os.fspath(folder)))
        return cls(city, Path(folder))

    @property
    def complete(self) -> bool:
        """Whether every part is finished."""
        return not self.city._core.missing(os.fspath(self.folder))

    @property
    def cases(self) -> str:
        """The files of the cases as a pattern."""
        return os.fspath(self.folder / "runs" / "*.parquet")

    def report(self) -> CitySummary:
        """Writes the map ``index.html``, ``worst-pairs.csv``, ``buildings.parquet`` and ``buildings.geojson``.

        Raises:
            ModelError: parts are missing.
        """
        return CitySummary(**json.loads(self.city._core.report(os.fspath(self.folder))))

    def model(self, pair: int, draw: int = 0, motion: int = 0) -> Model:
        """Returns a pair as a model, with the other buildings of the row in which the city ran it; numbers count from 0.

        Raises:
            ModelError: there is no such pair, or it shares a wall in this draw.
        """
        return Model.loads(self.city._core.model(pair, draw, motion))


@dataclass(frozen=True)
class ClassesResult:
    """The folder of ``jostle classes``.

    Attributes:
        folder: the folder: ``index.html``, ``cases.parquet``, ``fragility.parquet``, ``fragility.xml`` for OpenQuake, ``pelicun.csv``.
        left_out: what the fragility models of OpenQuake and Pelicun omit, and why.

    Examples:
        >>> from pathlib import Path
        >>> import jostle
        >>> lines = ["class = { types = ['C1'], storeys = [2] }", "neighbour = { types = ['W1'], storeys = [1] }"]
        >>> lines += ["pair = { gaps = ['5 mm'] }", "motion = { record = 'el-centro-1940-ns' }"]
        >>> _ = Path("classes.toml").write_text("\\n".join(lines))
        >>> result = jostle.classes("classes.toml", "classes-results")
        >>> (result.folder / "fragility.xml").is_file()
        True
    """

    folder: Path
    left_out: list[str]


def classes(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    jobs: int | None = None,
    progress: bool | Observer = False,
    force: bool = False,
) -> ClassesResult:
    """Computes the fragility of building classes with and without pounding, like ``jostle classes``.

    Args:
        path: the classes file.
        out: folder of the results.
        jobs: threads; by default one per core.
        progress: true shows a line on a terminal; or a function called with the numbers of finished pairs and of all pairs.
        force: true replaces files that jostle did not write.

    Raises:
        ModelError: the file is wrong.
        FileExistsError: a file of that name is not one that jostle wrote.

    Examples:
        >>> from pathlib import Path
        >>> import jostle
        >>> lines = ["class = { types = ['C1'], storeys = [2] }", "neighbour = { types = ['W1'], storeys = [1] }"]
        >>> lines += ["pair = { gaps = ['5 mm'] }", "motion = { record = 'el-centro-1940-ns' }"]
        >>> _ = Path("classes.toml").write_text("\\n".join(lines))
        >>> jostle.classes("classes.toml", "classes-results").folder.name
        'classes-results'
    """
    folder = Path(out)
    if jobs is not None and jobs < 1:
        raise ModelError(f"jobs: must be at least 1, found {jobs}")
    observer = None if isinstance(progress, bool) else progress
    with CountLine("pairs") if progress is True else contextlib.nullcontext() as line:
        observer = observer if line is None else line
        texts, left_out = _jostle.classes(os.fspath(path), os.fspath(folder), force, jobs, observer)
    for text in texts:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return ClassesResult(folder, left_out)
