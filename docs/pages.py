"""Find the pages of the documentation and the blocks of code in them."""

from __future__ import annotations

import re
from pathlib import Path

DOCS = Path(__file__).parent
_BUILT = {"_build", "_generated", "api", "auto_gallery"}  # folders that a build writes


def written_pages(docs: Path = DOCS) -> list[Path]:
    """Return the files of the pages in a folder that are written by hand, sorted."""
    return [file for file in sorted(docs.rglob("*.md")) if not _BUILT & set(file.relative_to(docs).parts)]


def pages() -> list[Path]:
    """Return the files of all pages that are written by hand, README.md first."""
    return [DOCS.parent / "README.md", *written_pages()]


def page(name: str) -> str:
    """Return the text of the page with a file name, such as ``"oils.md"`` or ``"howto/discharge.md"``.

    Raises LookupError unless exactly one page below docs matches.
    """
    files = [file for file in written_pages() if file.as_posix().endswith(f"/{name}")]
    if len(files) != 1:
        raise LookupError(f"{len(files)} pages are called {name}")
    return files[0].read_text("utf-8")


def blocks(text: str, language: str) -> list[str]:
    """Return the blocks of code in a language, such as ``"python"``, in the order of the text."""
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


def block_with(phrase: str, language: str) -> str:
    """Return the only block in a language that contains a phrase, from all pages.

    Raises LookupError unless exactly one block contains it.
    """
    every = [block for file in pages() for block in blocks(file.read_text("utf-8"), language)]
    matching = [block for block in every if phrase in block]
    if len(matching) != 1:
        raise LookupError(f"{len(matching)} blocks contain {phrase!r}")
    return matching[0]
