"""Exceptions and warnings; their texts are those of the command line."""

from __future__ import annotations

import errno
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Result

FaultParts = tuple[str, str, "str | None", "int | None", "int | None"]


@dataclass(frozen=True)
class Fault:
    """One fault of a model.

    Attributes:
        path: the field, as in ``building[0].storey_height``; empty for the model as a whole.
        problem: what is wrong.
        remedy: what to do about it, where that is known.
        line: line of the model file, from 1; ``None`` for models made in Python.
        column: column on that line, from 1.
    """

    path: str
    problem: str
    remedy: str | None = None
    line: int | None = None
    column: int | None = None


class JostleError(Exception):
    """Whatever jostle raises on purpose."""


class ModelError(JostleError, ValueError):
    """The model, its ground motion or an argument is wrong (exit code 2 of the command line).

    Attributes:
        faults: every fault of the model; empty if the error is about a single argument.
    """

    faults: tuple[Fault, ...]

    def __init__(self, message: str = "", faults: Sequence[FaultParts] = ()) -> None:
        super().__init__(message, faults)
        self.faults = tuple(Fault(*parts) for parts in faults)

    def __str__(self) -> str:
        return str(self.args[0])


class MissingFileError(ModelError, FileNotFoundError):
    """A model file or a record does not exist.

    Attributes:
        filename: the path, as it was given.
    """

    def __init__(self, message: str = "", filename: str = "", faults: Sequence[FaultParts] = ()) -> None:
        super().__init__(message, faults)
        self.errno, self.strerror, self.filename = errno.ENOENT, message, filename
        self._parts = (message, filename, faults)

    def __reduce__(self) -> tuple[type[MissingFileError], tuple[str, str, Sequence[FaultParts]]]:
        return type(self), self._parts


class AnalysisError(JostleError, RuntimeError):
    """The analysis could not be carried through (exit code 1 of the command line).

    Attributes:
        result: what was computed until then; ``None`` if there is nothing.
    """

    result: Result | None

    def __init__(self, message: str = "", result: Result | None = None) -> None:
        super().__init__(message)
        self.result = result


class JostleWarning(UserWarning):
    """A result may not be what was meant."""


class ModelWarning(JostleWarning):
    """A model is valid but may not be meant."""


class StudyWarning(JostleWarning):
    """A folder of results held a file that is damaged or belongs elsewhere; it was set aside, as the text says."""


class InterruptedWarning(JostleWarning):
    """Ctrl-C stopped a run; the result holds what was computed until then."""
