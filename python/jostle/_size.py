"""The least of something that keeps conditions."""

from __future__ import annotations

import contextlib
import json
import os
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, cast

from . import _jostle
from ._errors import ModelWarning
from ._model import Model
from ._motion import Motion
from ._progress import Observer, ProgressLine
from ._table import Table
from ._units import Quantity, option_text


class _TrialLine(ProgressLine):
    """Shows the number of trials."""

    def __call__(self, time: float, duration: float) -> None:
        if self._is_due():
            self._draw(min(time / max(duration, 1.0), 1.0), f"{time:.0f} of {duration:.0f} trials")


class SizeAnswer:
    """A search for the smallest input that meets given conditions: the result of :func:`size`.

    Examples:
        >>> import jostle
        >>> answer = jostle.size(
        ...     "paper", vary={"gap.width": ("20 mm", "300 mm")}, keep="impact_count == 0", minimise="gap.width", trials=10
        ... )
        >>> list(answer.best)
        ['gap.width']
    """

    _core: _jostle.Sized

    @classmethod
    def _of(cls, core: _jostle.Sized) -> SizeAnswer:
        answer = cls.__new__(cls)
        answer._core = core
        return answer

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The best trial and the trade-off between objective and conditions: the tree of ``size.json``."""
        return cast("dict[str, Any]", json.loads(self._core.json()))

    @property
    def best(self) -> dict[str, str] | None:
        """Values of the varied keys of the best trial, as texts with units; ``None`` if no trial meets the conditions."""
        best = self.summary["best"]
        return None if best is None else {own["key"]: own["text"] for own in best["inputs"]}

    @property
    def objective(self) -> float | None:
        """The smallest value found, in SI; ``None`` if no trial meets the conditions."""
        best = self.summary["best"]
        return None if best is None else cast("float | None", best["objective"])

    @property
    def converged(self) -> bool:
        """Whether the search converged."""
        return cast(bool, self.summary["converged"])

    @cached_property
    def trials(self) -> Table:
        """One row per trial; columns as in ``trials.parquet``."""
        return Table._of(self._core.table())

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes a page with the trials and the trade-off.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.write_text(os.fspath(path), self._core.page(), "size", force)
        return Path(path)

    def __str__(self) -> str:
        return self._core.text().rstrip()

    def __repr__(self) -> str:
        return f"<SizeAnswer: {self.summary['minimise']} = {self.objective}, {len(self.trials)} trials>"

    def _repr_html_(self) -> str:
        from ._draw import size_html

        return size_html(self)


def size(
    model: Model | str | os.PathLike[str] | Mapping[str, Any],
    *,
    vary: str | Sequence[str] | Mapping[str, tuple[Quantity, Quantity] | None],
    minimise: str,
    keep: str | Sequence[str] = (),
    motions: Sequence[Motion | str | os.PathLike[str]] | None = None,
    pga: Quantity | None = None,
    over: str = "worst",
    both_signs: bool = False,
    seed: int = 0,
    trials: int = 600,
    tolerance: float = 1e-4,
    jobs: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: bool | Observer = False,
    force: bool = False,
) -> SizeAnswer:
    """Finds the smallest damper, gap or other input that meets given conditions, such as no impact.

    Args:
        model: the model, its file, the name of a built-in model, or a tree.
        vary: keys and their bounds: ``{"gap.width": ("5 mm", "300 mm")}``, or texts ``"gap.width=5 mm..300 mm"``; without
            bounds (``None``) a key varies between a tenth and ten times its value in the model.
        minimise: a key, a result, or a sum such as ``"2 * link.force_peak_n + gap.peak_force_n"``.
        keep: conditions such as ``"impact_count == 0"``.
        motions: other ground motions: objects or names; by default those of the model.
        pga: scales the motions to this peak.
        over: ``"worst"`` or ``"mean"`` of several records.
        both_signs: runs every motion with both signs; each counts as two records.
        seed: seed of the search.
        trials: maximum number of trials, at least 10.
        tolerance: relative convergence tolerance.
        jobs: number of runs at the same time; by default one per core.
        out: folder for the results; the same call continues there. ``None`` writes nothing.
        progress: true shows a line or a bar; or a function called with the number of finished trials and the maximum.
        force: replaces files in the folder that jostle did not write.

    Raises:
        ModelError: a key, a condition or the model is wrong.
        FileExistsError: the folder contains a file of such a name that jostle did not write.

    Examples:
        >>> import jostle
        >>> answer = jostle.size(
        ...     "paper", vary={"gap.width": ("20 mm", "300 mm")}, keep="impact_count == 0", minimise="gap.width", trials=10
        ... )
        >>> answer.objective < 0.3
        True
    """
    model = Model.from_any(model)
    if motions is not None:
        given = list(motions)
        model = model.changed(motion=given[0] if len(given) == 1 else given)
    varied: list[str] = []
    if isinstance(vary, str):
        varied = [vary]
    elif isinstance(vary, Mapping):
        for key, bounds in vary.items():
            low_high = "" if bounds is None else "=" + "..".join(option_text(key, bound) for bound in bounds)
            varied.append(f"{key}{low_high}")
    else:
        varied = list(vary)
    kept = [keep] if isinstance(keep, str) else list(keep)
    if jobs is not None and jobs < 1:
        raise ValueError(f"jobs: must be at least 1, found {jobs}")
    folder = None if out is None else os.path.abspath(out)
    if folder is not None:
        os.makedirs(folder, exist_ok=True)
    line = _TrialLine("trials  ") if progress is True else contextlib.nullcontext()
    with line as shown:
        observer = shown or (progress if callable(progress) else None)
        core, notes = _jostle.size(
            model._base(),
            varied,
            kept,
            minimise,
            [],
            None if pga is None else option_text("pga", pga),
            over,
            both_signs,
            (seed, trials, float(tolerance)),
            folder,
            jobs,
            bool(force),
            observer,
        )
    for text in notes:
        warnings.warn(text, ModelWarning, stacklevel=2)
    return SizeAnswer._of(core)
