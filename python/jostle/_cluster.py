"""The parts of a run on the workers of a ``dask.distributed.Client``."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from ._errors import AnalysisError


def run_parts(
    client: Any,
    core: Any,
    folder: str,
    task: Callable[..., object],
    share: object,
    key: str,
    progress: Callable[[int, int], object],
) -> None:
    """Submits every part that a folder lacks as ``task(share, folder, part)``, and hears how many parts of how many are there."""
    distributed: Any = import_module("distributed")
    core.settle(folder)
    missing, parts = core.missing(folder), core.parts
    # With every task its share: what is scattered dies with the worker that holds its last copy.
    futures = [
        client.submit(task, share, folder, part, pure=False, retries=10, key=f"{key}-{part}") for part in missing
    ]
    try:
        done = parts - len(missing)
        for future in distributed.as_completed(futures):
            future.result()
            done += 1
            progress(done, parts)
    except BaseException:
        client.cancel(futures)
        raise
    left = core.missing(folder)
    if left:
        raise AnalysisError(
            f"{len(left)} of {parts} parts did not arrive in {folder}: the workers must share this folder"
        )
