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
        problem: description of the problem.
        remedy: the remedy, if known.
        line: line of the model file, from 1; ``None`` for models created in Python.
        column: column in that line, from 1.

    Examples:
        >>> import jostle
        >>> try:
        ...     jostle.Model([jostle.Shear("a", mass="40 kg/m", storeys=2, storey_height=3)])
        ... except jostle.ModelError as error:
        ...     print(error.faults[0].path)
        building[0].stiffness
    """

    path: str
    problem: str
    remedy: str | None = None
    line: int | None = None
    column: int | None = None


class JostleError(Exception):
    """Base class of all errors of jostle.

    Examples:
        >>> import jostle
        >>> issubclass(jostle.ModelError, jostle.JostleError)
        True
    """


class ModelError(JostleError, ValueError):
    """The model, its ground motion or an argument is wrong (exit code 2 of the command line).

    Attributes:
        faults: all faults of the model; empty if the error concerns a single argument.

    Examples:
        >>> import jostle
        >>> try:
        ...     jostle.run("paper", gap="3 kg")
        ... except jostle.ModelError as error:
        ...     print(error)
        gap: expected a length (such as "3.2 m"), found "3 kg"
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
        filename: the path as given.

    Examples:
        >>> import jostle
        >>> try:
        ...     jostle.Model.load("lost.toml")
        ... except jostle.MissingFileError as error:
        ...     print(error.filename)
        lost.toml
    """

    def __init__(self, message: str = "", filename: str = "", faults: Sequence[FaultParts] = ()) -> None:
        super().__init__(message, faults)
        self.errno, self.strerror, self.filename = errno.ENOENT, message, filename
        self._parts = (message, filename, faults)

    def __reduce__(self) -> tuple[type[MissingFileError], tuple[str, str, Sequence[FaultParts]]]:
        return type(self), self._parts


class AnalysisError(JostleError, RuntimeError):
    """The analysis failed (exit code 1 of the command line).

    Attributes:
        result: the results up to the failure; ``None`` if there are none.

    Examples:
        >>> import jostle
        >>> issubclass(jostle.AnalysisError, RuntimeError)
        True
    """

    result: Result | None

    def __init__(self, message: str = "", result: Result | None = None) -> None:
        super().__init__(message)
        self.result = result


class JostleWarning(UserWarning):
    """Base class of all warnings: a result may not be as intended.

    Examples:
        >>> import jostle
        >>> issubclass(jostle.ModelWarning, jostle.JostleWarning)
        True
    """


class ModelWarning(JostleWarning):
    """A model is valid but unusual.

    Examples:
        >>> import jostle
        >>> import warnings
        >>> with warnings.catch_warnings(record=True) as caught:
        ...     warnings.simplefilter("always")
        ...     model = jostle.Model.paper_example().set("gap[0].width", "3 m")
        >>> issubclass(caught[0].category, jostle.ModelWarning)
        True
    """


class StudyWarning(JostleWarning):
    """The folder of a study contained a damaged file, or a file of another study; it was moved to ``set-aside``.

    Examples:
        >>> import jostle
        >>> issubclass(jostle.StudyWarning, jostle.JostleWarning)
        True
    """


class InterruptedWarning(JostleWarning):
    """Ctrl-C stopped a run; the result covers the time until then.

    Examples:
        >>> import jostle
        >>> issubclass(jostle.InterruptedWarning, UserWarning)
        True
    """
