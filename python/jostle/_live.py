"""The live page of a model as a widget of a notebook."""

from __future__ import annotations

import json
from collections.abc import Iterator, MutableMapping
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

from . import _jostle
from ._model import Base, Model
from ._run import run

try:
    import anywidget
    import traitlets
except ImportError:
    raise ImportError(
        "model.live() needs the package anywidget; install it with: pip install \"jostle[live]\""
    ) from None

if TYPE_CHECKING:
    from ._result import Result

#: Short names of paths.
_NAMES = {"gap": "gap[*].width", "pga": "motion.pga", "record": "motion.record"}

#: Puts the page into a frame and carries its messages.
_SCRIPT = """
function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.title = "jostle live";
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  frame.style = "width: 100%; height: 820px; border: 1px solid #8888; border-radius: 8px;";
  frame.srcdoc = model.get("_page");
  const ask = ({ data, source }) => {
    if (source === frame.contentWindow && typeof data?.jostle === "string") model.send({ request: data.jostle });
  };
  const answer = ({ answer }, buffers) => {
    if (answer !== undefined) return frame.contentWindow?.postMessage({ answer }, "*");
    const { buffer, byteOffset, byteLength } = buffers[0];
    const bytes = buffer ? buffer.slice(byteOffset, byteOffset + byteLength) : buffers[0].slice(0);
    frame.contentWindow?.postMessage({ answer: bytes }, "*", [bytes]);
  };
  addEventListener("message", ask);
  model.on("msg:custom", answer);
  el.append(frame);
  return () => {
    removeEventListener("message", ask);
    model.off("msg:custom", answer);
  };
}
export default { render };
"""


class Values(MutableMapping[str, "str | None"]):
    """Values of the model by path, as texts of the model file; ``None`` for a key that the file does not state.

    ``gap`` (every gap), ``pga`` and ``record`` are short names.
    """

    def __init__(self, widget: LiveWidget) -> None:
        self._widget = widget

    def __getitem__(self, name: str) -> str | None:
        path = _NAMES.get(name, name).replace("[*]", "[0]")
        values = dict(self._widget._engine.values())
        if path not in values:
            raise KeyError(name)
        return values[path]

    def __setitem__(self, name: str, value: object) -> None:
        typed = "" if value is None else value if isinstance(value, str) else json.dumps(value)
        self._widget._set(_NAMES.get(name, name), typed)

    def __delitem__(self, name: str) -> None:
        self[name] = None

    def __iter__(self) -> Iterator[str]:
        return iter([path for path, _ in self._widget._engine.values()])

    def __len__(self) -> int:
        return len(self._widget._engine.values())

    def __repr__(self) -> str:
        return repr({path: value for path, value in self.items() if value is not None})


class LiveWidget(anywidget.AnyWidget, metaclass=traitlets.MetaHasTraits):
    """The live page of a model, created by :meth:`Model.live`."""

    _esm = _SCRIPT
    _page = traitlets.Unicode().tag(sync=True)

    def __init__(self, engine: _jostle.Live, base: Base, title: str) -> None:
        self._engine = engine
        self._base = base
        #: Values of the model by path, to read and to set.
        self.values = Values(self)
        self._found: tuple[str, Result] | None = None
        # One thread each, so that neither waits for the other and the notebook waits for none.
        self._runs = ThreadPoolExecutor(1, "jostle-run")
        self._curves = ThreadPoolExecutor(1, "jostle-curve")
        self._curve = 0
        self._run = 0
        super().__init__(_page=_jostle.live_page(title))
        self.on_msg(self._take)

    @property
    def model(self) -> Model:
        """The current model."""
        name, _, is_json, folder, files = self._base
        return Model._read((name, self._engine.text, is_json, folder, files))

    @property
    def result(self) -> Result:
        """Result of the current model, as returned by :func:`run`; computed on access."""
        text = self._engine.text
        if self._found is None or self._found[0] != text:
            self._found = (text, run(self.model))
        return self._found[1]

    def close(self) -> None:
        """Removes the page and stops its computations."""
        self._engine.stop()
        self._run += 1
        self._curve += 1
        self._runs.shutdown(wait=False)
        self._curves.shutdown(wait=False)
        super().close()

    def _set(self, path: str, typed: str) -> None:
        self._engine.set(path, typed)
        self._say(json.dumps({"op": "model", "text": self._engine.text}))

    def _say(self, answer: str | bytes | None) -> None:
        """Sends an answer to the page; numbers travel as they are."""
        if isinstance(answer, bytes):
            self.send({}, buffers=[answer])
        elif answer is not None:
            self.send({"answer": answer})

    def _take(self, _widget: object, content: dict[str, Any], _buffers: object) -> None:
        """A request of the page."""
        request = content["request"]
        op = json.loads(request)["op"]
        if op == "hello":
            hello = json.loads(self._engine.hello())
            self._say(json.dumps({**hello, "text": self._engine.text}))
        elif op in ("run", "report", "stop"):
            if op != "report":
                self._run += 1
                self._engine.stop()
            if op != "stop":
                self._runs.submit(self._solve, request, op, self._run)
        else:
            self._curve += op != "study"
            number = self._curve
            self._curves.submit(self._compute, request, op, number)

    def _solve(self, request: str, op: str, number: int) -> None:
        self._say(self._engine.answer(request))
        # Takes another run; a newer request stops it.
        if op == "run" and number == self._run:
            self._say(self._engine.accuracy())

    def _compute(self, request: str, op: str, number: int) -> None:
        if number != self._curve and op != "study":
            return
        self._say(self._engine.answer(request))
        while op == "curve" and number == self._curve:
            answer = self._engine.more()
            if answer is None:
                return
            self._say(answer)


def widget(model: Model) -> LiveWidget:
    """The widget of a model."""
    base = model._base()
    return LiveWidget(_jostle.Live(base), base, model.title or "model")
