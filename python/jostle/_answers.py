"""Lists of answers that a notebook shows one below the other."""

from __future__ import annotations

from typing import TypeVar

_Answer = TypeVar("_Answer")


class Answers(list[_Answer]):
    """A list of results; a notebook shows all of them.

    Examples:
        >>> import jostle
        >>> gaps = jostle.critical_gap("paper", outcomes=False, tolerance="1 mm")
        >>> len(gaps), "svg" in gaps._repr_html_()
        (1, True)
    """

    def _repr_html_(self) -> str:
        return "".join(entry._repr_html_() for entry in self if hasattr(entry, "_repr_html_"))
