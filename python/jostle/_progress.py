"""Progress of a run: a line on a terminal, a bar in a notebook."""

from __future__ import annotations

import html
import sys
import time as clock
from collections.abc import Callable
from importlib import import_module
from types import TracebackType
from typing import Any

#: Called with the time reached and the time to reach [s].
Observer = Callable[[float, float], object]


class ProgressLine:
    """Shows the progress of a run that takes some time, on a terminal or in a notebook, and removes it afterwards.

    On a terminal it is a line on standard error. A Jupyter notebook shows it as HTML, since it shows standard
    error like an error message. Elsewhere nothing is shown.
    """

    #: Runs shorter than this need none, and it is written no more often than this apart [s].
    PATIENCE, APART = 0.5, 0.1

    def __init__(self, label: str = "") -> None:
        self._label = label
        self._started = self._written = clock.monotonic()
        self._width = 0
        self._notebook = _notebook()
        self._handle: Any = None
        self._watched = self._notebook is not None or _watched()

    def __call__(self, time: float, duration: float) -> None:
        if self._is_due():
            part = min(max(time / duration, 0.0), 1.0)
            left = (clock.monotonic() - self._started) * (1 - part) / max(part, 1e-6)
            self._draw(part, f"{100 * part:3.0f} %  {time:.1f} of {duration:.1f} s, {left:.0f} s left")

    def _is_due(self) -> bool:
        """Whether the display is due."""
        now = clock.monotonic()
        hasty = now - self._started < self.PATIENCE or now - self._written < self.APART
        if hasty or not self._watched:
            return False
        self._written = now
        return True

    def _draw(self, part: float, text: str) -> None:
        """Shows a fraction from 0 to 1 and its text."""
        if self._notebook is None:
            bar = "█" * round(24 * part)
            self._show(f"{self._label}{bar:░<24} {text}")
        else:
            self._display(
                f'<progress max="1" value="{part:.4f}" style="width:20em"></progress> '
                f"{html.escape(f'{self._label}{text}')}"
            )

    def _display(self, page: str) -> None:
        try:
            shown = self._notebook.HTML(page)
            if self._handle is None:
                self._handle = self._notebook.display(shown, display_id=True)
            else:
                self._handle.update(shown)
        except Exception:  # No progress bar is worth a run.
            self._watched = False

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
        if self._handle is not None:
            self._display("")
        if self._width:
            self._show("")
            self._show("\r")


class CountLine(ProgressLine):
    """Shows how many of something are finished."""

    def __init__(self, word: str) -> None:
        super().__init__()
        self._word = word

    def __call__(self, time: float, duration: float) -> None:
        if self._is_due():
            part = min(max(time / max(duration, 1.0), 0.0), 1.0)
            self._draw(part, f"{time:.0f} of {duration:.0f} {self._word}")


def _notebook() -> Any:
    """``IPython.display`` in a Jupyter notebook, otherwise ``None``."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    if getattr(shell, "kernel", None) is None:
        return None
    try:
        return import_module("IPython.display")
    except ImportError:
        return None


def _watched() -> bool:
    """Whether standard error is a terminal."""
    try:
        return sys.stderr.isatty()
    except (AttributeError, ValueError):
        return False
