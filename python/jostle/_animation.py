"""The buildings in motion."""

from __future__ import annotations

import html
import os
import tempfile
import webbrowser
from pathlib import Path

from . import _jostle

#: The report without all but its stage and player.
_STAGE_ONLY = (
    "<style>.head,.warnings,.verdict,.tiles,#charts,#impacts,#envelopes,#joints,#model,#guide,footer,"
    "#motion>h2,#motion>.quiet{display:none!important}body,main,#motion,.stage{margin-top:0!important;padding-top:0!important}</style></head>"
)


class Animation:
    """The animation of a report. A notebook displays it, also offline.

    Examples:
        >>> import jostle
        >>> path = jostle.run("paper").animate().save("moving.html")
        >>> open("moving.html").read(15)
        '<!DOCTYPE html>'
    """

    def __init__(self, page: str) -> None:
        self._page = page.replace("</head>", _STAGE_ONLY, 1)

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the animation as one HTML page, which opens offline.

        Args:
            path: file to write; an earlier page of jostle is replaced.
            force: true replaces other files too.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.Run.write(path, self._page, force)
        return Path(path)

    def show(self) -> Path:
        """Opens the animation in the browser, from a temporary file."""
        folder = tempfile.mkdtemp(prefix="jostle-")
        path = self.save(Path(folder) / "animation.html")
        webbrowser.open(path.as_uri())
        return path

    def __repr__(self) -> str:
        return "<Animation: a notebook shows it; .show() opens it in the browser, .save(path) keeps it>"

    def _repr_html_(self) -> str:
        return frame(self._page, 720)


def frame(page: str, height: int) -> str:
    """An isolated page inside a page."""
    return (
        f'<iframe srcdoc="{html.escape(page)}" sandbox="allow-scripts" title="jostle" '
        f'style="width:100%;height:{height}px;border:0;border-radius:8px"></iframe>'
    )
