"""Opens every page of the built site in headless Chromium and fails on whatever a reader would stumble over.

A page fails when a link or its anchor leads nowhere, a formula is not set, a script reports an error, or anything is
requested that is no file of the site. `docs/check --built --screens DIR` also keeps a picture of every page.
"""

import re
import shutil
import sys
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlparse

from playwright.sync_api import Page, sync_playwright

SITE = Path(__file__).resolve().parents[2] / "target" / "docs" / "site"

LOOK = r"""() => ({
    links: [...document.querySelectorAll("a[href]")].map(a => a.href),
    images: [...document.images].filter(i => i.complete && !i.naturalWidth).map(i => i.src),
    unset: [...document.querySelectorAll(".arithmatex")].filter(f => !f.querySelector(".katex")).map(f => f.textContent.slice(0, 60)),
    wrong: [...document.querySelectorAll(".katex-error")].map(f => f.title.slice(0, 160)),
    ids: [...document.querySelectorAll("[id],a[name]")].map(e => e.id || e.name),
    text: (() => {
        const copy = document.querySelector("article")?.cloneNode(true);
        copy?.querySelectorAll("pre,code,.katex,script,style").forEach(e => e.remove());
        return copy?.textContent ?? "";
    })(),
})"""


def main() -> int:
    browser_path = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)
    if browser_path is None:
        print("no Chromium found: install the package chromium")
        return 1
    pages = sorted(path for path in SITE.rglob("*.html") if path.name != "404.html")
    if not pages:
        print(f"{SITE} is empty: docs/build builds it")
        return 1
    faults: list[str] = []
    ids: dict[Path, set[str]] = {}
    links: list[tuple[str, str]] = []
    formulas = 0
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=browser_path, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        here = [""]
        page.on("request", lambda request: requested(request.url, here[0], faults))
        page.on("pageerror", lambda error: faults.append(f"{here[0]}: script: {error}"))
        page.on("console", lambda line: line.type == "error" and faults.append(f"{here[0]}: console: {line.text}"))
        for path in pages:
            here[0] = path.relative_to(SITE).as_posix()
            found = opened(page, path)
            ids[path] = set(found["ids"])
            links += [(here[0], link) for link in found["links"]]
            faults += [f"{here[0]}: no image: {source}" for source in found["images"]]
            faults += [f"{here[0]}: formula not set: {text}" for text in found["unset"]]
            faults += [f"{here[0]}: formula: {text}" for text in found["wrong"]]
            # Dollars around a command of TeX: a formula that Markdown did not see.
            faults += [f"{here[0]}: raw formula: {raw}" for raw in re.findall(r"\${1,2}[^$\n]*\\[a-z]+[^$\n]*\$", found["text"])]
            faults += [f"{here[0]}: table not set: {raw[:60]}" for raw in re.findall(r"(?m)^\s*\|[^|\n]+\|[^|\n]+\|", found["text"])]
            formulas += page.locator(".katex").count()
            if "--screens" in sys.argv:
                folder = Path(sys.argv[sys.argv.index("--screens") + 1])
                folder.mkdir(parents=True, exist_ok=True)
                page.screenshot(path=folder / (here[0].replace("/", "-") + ".png"), full_page=True)
        browser.close()
    faults += [fault for where, link in links for fault in dead(where, link, ids)]
    for fault in dict.fromkeys(faults):
        print(fault)
    print(f"{len(pages)} pages, {len(links)} links, {formulas} formulas, {len(set(faults))} faults")
    return 1 if faults else 0


def opened(page: Page, path: Path) -> dict[str, list[str]]:
    """What a page shows once its scripts have run."""
    page.goto(path.as_uri())
    page.wait_for_load_state("load")
    return page.evaluate(LOOK)


def requested(url: str, where: str, faults: list[str]) -> None:
    """Notes a request that leaves the site."""
    scheme = urlparse(url).scheme
    if scheme not in {"file", "data", "blob", "about"}:
        faults.append(f"{where}: asks the network for {url}")
    elif scheme == "file" and not Path(unquote(urlparse(url).path)).exists():
        faults.append(f"{where}: asks for a file that is not there: {url}")


def dead(where: str, link: str, ids: dict[Path, set[str]]) -> list[str]:
    """A fault for a link of the site that leads nowhere; links to other sites are not followed."""
    address, anchor = urldefrag(link)
    if urlparse(address).scheme != "file":
        return []
    target = Path(unquote(urlparse(address).path))
    if not target.is_file():
        return [f"{where}: dead link: {link}"]
    if anchor and target in ids and unquote(anchor) not in ids[target]:
        return [f"{where}: no such place: {link}"]
    return []


if __name__ == "__main__":
    sys.exit(main())
