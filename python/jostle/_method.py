"""How accurate each solver formulation is on a model, starter files, and the lists of keys, results and checks."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from . import _jostle
from ._errors import ModelError
from ._model import Model


class MethodSurvey:
    """Accuracy of each solver formulation for the buildings of a model: the result of :func:`method`.

    Examples:
        >>> import jostle
        >>> print(str(jostle.method("paper")).splitlines()[0])
        J1
    """

    def __init__(self, text: str, page: str) -> None:
        self._text, self._page = text, page

    def report(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes a page with tables and plots.

        Raises:
            FileExistsError: the file exists and jostle did not write it.
        """
        _jostle.write_text(os.fspath(path), self._page, "method", force)
        return Path(path)

    def __str__(self) -> str:
        return self._text.rstrip()

    def __repr__(self) -> str:
        return f"<MethodSurvey: {len(self._text.splitlines())} lines>"

    def _repr_html_(self) -> str:
        from ._draw import text_html

        return text_html(str(self))


def method(model: Model | str | os.PathLike[str] | Mapping[str, Any]) -> MethodSurvey:
    """Computes how accurate each solver formulation is for the buildings of a model.

    Args:
        model: the model, its file, the name of a built-in model, or a tree.

    Raises:
        AnalysisError: a reference solution failed.

    Examples:
        >>> import jostle
        >>> print(str(jostle.method("paper")).splitlines()[0])
        J1
    """
    return MethodSurvey(*Model.from_any(model)._core.methods())


def template(name: str = "frames", title: str = "Untitled") -> str:
    """The text of a commented model file to start from, as ``jostle new`` writes it; ``Model.loads`` reads it.

    Args:
        name: ``"frames"``, ``"towers"``, ``"single"``, ``"row"``, …; an unknown name lists all.
        title: title of the model.

    Raises:
        ModelError: there is no such template.

    Examples:
        >>> import jostle
        >>> model = jostle.Model.loads(jostle.template("towers", "Two towers"))
        >>> model.title
        'Two towers'
    """
    text = _jostle.template(name, title)
    if text is None:
        raise ModelError(f"name: there is no template {name!r}; there are {', '.join(_jostle.template_names())}")
    return text


def schema(what: str = "model") -> Any:
    """Lists of keys and quantities as ``jostle schema`` prints them.

    Args:
        what: ``"model"``, the JSON Schema of model files; ``"results"``, every quantity of the results; ``"checks"``, every
            check; ``"combinations"``, the features that each kind of building supports, a text in Markdown.

    Raises:
        ModelError: an unknown word.

    Examples:
        >>> import jostle
        >>> "properties" in jostle.schema()
        True
    """
    text = _jostle.schema(what, False)
    return text if what == "combinations" else cast(Any, json.loads(text))
