"""The package as installed."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from importlib import metadata, resources
from pathlib import Path

import pytest
from conftest import Program

import jostle

ROOT = Path(__file__).resolve().parents[2]


def test_versions_agree(program: Program) -> None:
    assert jostle.__version__ == metadata.version("jostle")
    assert program("--version").stdout.strip() == f"jostle {jostle.__version__}"


def test_exit_codes(program: Program, tmp_path: Path) -> None:
    assert program("--help").returncode == 0
    assert program("nonsense").returncode == 2
    missing = program("check", "missing.toml")
    assert missing.returncode == 2 and "missing.toml: cannot be read" in missing.stderr
    done = subprocess.run(
        [sys.executable, "-m", "jostle", "schema"], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0 and '"jostle model file"' in done.stdout


def test_types_are_shipped() -> None:
    files = resources.files("jostle")
    assert files.joinpath("py.typed").is_file() and files.joinpath("_jostle.pyi").is_file()


def test_importing_is_light() -> None:
    code = "import sys, jostle; print([m for m in ('numpy', 'matplotlib', 'pandas') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", [name for name in jostle.__all__ if name != "__version__"])
def test_everything_public_is_explained(name: str) -> None:
    thing = getattr(jostle, name)
    assert inspect.getdoc(thing), name
    if inspect.isclass(thing):
        for part, value in vars(thing).items():
            if not part.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                assert inspect.getdoc(getattr(thing, part)), f"{name}.{part}"


def test_the_documentation_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every Python listing of docs/python.md, one after the other, in an empty folder."""
    page = ROOT / "docs" / "python.md"
    listings = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S)
    assert len(listings) >= 6
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    for number, listing in enumerate(listings, 1):
        exec(compile(listing, f"{page.name}, listing {number}", "exec"), names)
