"""Adds to the site what lies outside docs/: examples, the pages for developers, and the scripts that pages load."""

import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parents[2]
FETCHED = ROOT / "target" / "docs"

# Page in the site → file of the repository.
DEVELOPERS = {
    "developers/contributing.md": "CONTRIBUTING.md",
    "developers/architecture.md": "ARCHITECTURE.md",
    "developers/changelog.md": "CHANGELOG.md",
}


def on_files(files, config):
    """Adds files of the repository and of npm packages."""
    for page, source in DEVELOPERS.items():
        files.append(File.generated(config, page, abs_src_path=str(ROOT / source)))
    for path in sorted((ROOT / "examples").rglob("*")):
        if path.suffix in {".toml", ".py"}:
            name = path.relative_to(ROOT).as_posix()
            # A script is downloaded, not executed as a page.
            files.append(File.generated(config, name + ".txt", content=path.read_text(encoding="utf-8")))
    fetched = [(FETCHED / "katex" / "dist", "assets/katex"), (FETCHED / "iframe-worker", "assets/iframe-worker")]
    for folder, where in fetched:
        for path in sorted(folder.rglob("*")):
            if path.suffix in {".js", ".css", ".woff2"} and not path.name.endswith((".mjs", "katex.js", "katex.css")):
                uri = f"{where}/{path.relative_to(folder).as_posix()}"
                files.append(File.generated(config, uri, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown, page, config, files):
    """Points links that are right in the repository at the pages of the site."""
    uri = page.file.src_uri
    if uri.startswith("validation/"):
        # Thousands of rows of numbers would hide the pages that explain.
        page.meta["search"] = {"exclude": True}
    if uri.startswith("validation/") or uri == "combinations.md":
        page.meta["hide"] = ["toc"]  # the tables need the room
    if uri in DEVELOPERS:
        markdown = re.sub(r"\]\(docs/", "](../", markdown)
        markdown = re.sub(
            r"\]\((CONTRIBUTING|ARCHITECTURE|CHANGELOG)\.md", lambda match: f"]({match[1].lower()}.md", markdown
        )
        markdown = markdown.replace("](README.md", "](../index.md")
    if uri == "combinations.md":
        markdown = with_reasons_below(markdown)
    up = "../" * uri.count("/")
    for target, source in DEVELOPERS.items():
        markdown = re.sub(rf"\]\((?:\.\./)+{re.escape(source)}", f"]({up}{target}", markdown)
    # docs/page.md names ../examples, docs/how-to/page.md names ../../examples.
    markdown = re.sub(
        r"\]\((?:\.\./)+(examples/[\w./-]+\.(?:toml|py))\)", lambda match: f"]({up}{match[1]}.txt)", markdown
    )
    return re.sub(r"\[(`[^`]*`|[^\]]*)\]\((?:\.\./)+(?:examples|crates|CITATION|Cargo)[\w./-]*\)", r"\1", markdown)


def with_reasons_below(markdown):
    """Puts the refusals of the table of combinations below it, with numbers: in the cells they would be too wide to read."""
    markdown = markdown.replace("or what the program says instead", "or `no` with the number of what the program says instead")
    reasons = []

    def row(line):
        cells = line.strip().strip("|").split(" | ")
        for place, text in enumerate(cells[1:], 1):
            text = text.strip()
            if text != "yes":
                if text not in reasons:
                    reasons.append(text)
                cells[place] = f"no [{reasons.index(text) + 1}](#why-not)"
        return "| " + " | ".join(cell.strip() for cell in cells) + " |"

    lines = markdown.split("\n")
    rule = next(number for number, line in enumerate(lines) if line.startswith("|---"))
    lines = [row(line) if number > rule and line.startswith("|") else line for number, line in enumerate(lines)]
    return "\n".join([*lines, "", "## Why not", "", *(f"{number}. {text}" for number, text in enumerate(reasons, 1)), ""])


def on_page_content(html, page, config, files):
    """Shows an escaped bar in the code of a table as GitHub does: without the backslash."""
    return re.sub(r"<td[^>]*>.*?</td>", lambda cell: cell[0].replace("\\|", "|"), html, flags=re.S)
