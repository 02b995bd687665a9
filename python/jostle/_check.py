"""What is known of a model without running it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, cast

from . import _jostle


class Check:
    """A model, checked without running it: the result of :meth:`Model.check`.

    Examples:
        >>> import jostle
        >>> print(jostle.Model.paper_example().check().findings[0]["id"])
        A12
    """

    tree: dict[str, Any]

    def __init__(self, tree: dict[str, Any]) -> None:
        #: All results: ``text``, ``warnings``, ``notes``, ``findings``, ``records``, ``work``, ``files``, ``site``.
        self.tree = tree

    @property
    def warnings(self) -> list[str]:
        """Warnings about valid but unusual values."""
        return cast("list[str]", self.tree["warnings"])

    @property
    def notes(self) -> list[str]:
        """Assumptions where the model gives no value."""
        return cast("list[str]", self.tree["notes"])

    @property
    def findings(self) -> list[dict[str, Any]]:
        """Checks that the model does not pass, worst first; entries as those of ``result.checks``."""
        return cast("list[dict[str, Any]]", self.tree["findings"])

    @property
    def work(self) -> dict[str, Any] | None:
        """Expected work of a run: ``solver``, ``steps``, ``step_s``, ``seconds``, ``memory_bytes``, ``history_file_bytes``."""
        return cast("dict[str, Any] | None", self.tree["work"])

    @property
    def records(self) -> list[dict[str, Any]]:
        """Records of a model that lists several: ``name``, ``duration_s``, ``pga_m_s2``, ``steps``, ``step_s``."""
        return cast("list[dict[str, Any]]", self.tree["records"])

    @property
    def files(self) -> list[str]:
        """Files that the model names."""
        return cast("list[str]", self.tree["files"])

    @property
    def site(self) -> str | None:
        """The site from above as SVG; ``None`` of models in one plane."""
        return cast("str | None", self.tree["site"])

    def save_site(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the drawing of the site.

        Raises:
            ValueError: the model has no plans.
            FileExistsError: the file exists and jostle did not write it.
        """
        if self.site is None:
            raise ValueError("only models with plans have a drawing of the site")
        _jostle.write_text(os.fspath(path), self.site, "site", force)
        return Path(path)

    def __str__(self) -> str:
        return cast(str, self.tree["text"]).rstrip()

    def __repr__(self) -> str:
        return f"<Check: {len(self.findings)} findings, {len(self.warnings)} warnings>"

    def _repr_html_(self) -> str:
        from ._draw import check_html

        return check_html(self)
