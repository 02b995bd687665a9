"""The command line, as the program ``jostle`` and as ``python -m jostle``."""

from __future__ import annotations

import signal
import sys

from . import _jostle


def main() -> int:
    """Runs the command line and returns its exit code."""
    # Ctrl-C is the program's own affair: commands that keep results catch it, the others end at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _jostle.command_line(["jostle", *sys.argv[1:]])
