"""A progress line for terminals and notebooks."""

from __future__ import annotations

import sys
import time as clock
from collections.abc import Callable
from types import TracebackType

#: Called with the time reached and the time to reach [s].
Observer = Callable[[float, float], object]


class ProgressLine:
    """Shows how far a run has come, once it takes a while and where somebody watches; leaves no trace."""

    #: Runs shorter than this need none, and the line is written no more often than this apart [s].
    PATIENCE, APART = 0.5, 0.1

    def __init__(self, label: str = "") -> None:
        self._label = label
        self._started = self._written = clock.monotonic()
        self._width = 0
        self._watched = _watched()

    def __call__(self, time: float, duration: float) -> None:
        now = clock.monotonic()
        hasty = now - self._started < self.PATIENCE or now - self._written < self.APART
        if hasty or not self._watched:
            return
        self._written = now
        part = min(max(time / duration, 0.0), 1.0)
        left = (now - self._started) * (1 - part) / max(part, 1e-6)
        bar = "█" * round(24 * part)
        text = f"{self._label}{bar:░<24} {100 * part:3.0f} %  {time:.1f} of {duration:.1f} s, {left:.0f} s left"
        self._show(text)

    def _show(self, text: str) -> None:
        try:
            sys.stderr.write("\r" + text.ljust(self._width))
            sys.stderr.flush()
        except (OSError, ValueError, AttributeError, UnicodeError):
            pass  # No progress line is worth a run.
        self._width = len(text)

    def __enter__(self) -> ProgressLine:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._width:
            self._show("")
            self._show("\r")


def _watched() -> bool:
    """Whether standard error is a terminal or a notebook."""
    stream = sys.stderr
    if type(stream).__module__.startswith("ipykernel"):
        return True
    try:
        return stream.isatty()
    except (AttributeError, ValueError):
        return False
