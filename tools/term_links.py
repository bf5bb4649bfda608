"""Find terms of the glossary that a page uses in its running text without a link.

Running text is text without headings, code, formulas, links, bold text, quotations, captions, heads of tables
and their first column. A link, with any target, counts as a link of the terms in its text.
"""

import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from typing import NamedTuple

# Folders whose pages link terms. Pages called index.md only list pages.
FOLDERS = ("tutorials", "howto", "reference", "theory")
# Pages that use the word of a term in another sense.
OTHER_SENSES = {
    "arc": {"howto/bearing_kinds.md", "reference/bearing_output.md", "theory/bearing_loads.md"},
    "drive": {"theory/gears.md", "theory/together.md"},
    "full film": {"theory/motion.md", "theory/starvation.md"},
    "half-width": {"howto/measured.md", "theory/mixed.md"},
    "stationary": {"howto/bearing_kinds.md", "theory/bearing_loads.md"},
    "transient": {"howto/spice.md"},
}

_LINK = r"!?\[((?:`[^`]*`|[^\[\]])*)\]\([^()]*\)"
_ROLE = r"\{[a-z:]+\}`([^`]*)`"
_NOT_RUNNING = re.compile(
    rf"<!--.*?-->|{_ROLE}|{_LINK}|`[^`]*`|\$[^$]*\$|\*\*[^*]+\*\*|\*[^*\s][^*]*\*|\"[^\"]*\"|<[^>]*>",
    re.DOTALL,
)
_LINKED = re.compile(rf"{_ROLE}|{_LINK}")
_NO_TEXT = re.compile(r"#|% |\||:|\([\w-]+\)=$|\Z")
_ITEM = re.compile(r"\s*(?:[-*+] |\d+\. |>)")


class Use(NamedTuple):
    """The first use of a term on a page without a link: the term, and the place of its words in the text."""

    term: str
    start: int
    end: int


class Glossary:
    """Terms of the text of the glossary, with the pages to which their entries link."""

    def __init__(self, text: str) -> None:
        self.terms: dict[str, str] = {}  # by their names, of which an entry may have several
        self.pages: dict[str, set[str]] = {}
        block = text.partition("```{glossary}")[2].partition("\n```")[0]
        for entry in re.findall(r"^(?:[^\s:`].*\n)+(?:  .*\n?)+", block, re.MULTILINE):
            names = re.findall(r"^\S.*$", entry, re.MULTILINE)
            links = re.findall(r"\]\(([\w./]+\.md)", entry)
            self.terms |= dict.fromkeys(names, names[-1])
            self.pages[names[-1]] = {
                link.removeprefix("../") if "/" in link else f"reference/{link}" for link in links
            }

    def explained_on(self, page: str) -> set[str]:
        """Return the terms that a page explains, and the terms whose words it uses in another sense."""
        every = (*self.pages.items(), *OTHER_SENSES.items())
        return {term for term, pages in every if page in pages}

    def uses(self, text: str) -> Iterator[Use]:
        """Yield the terms in a text with their places, the longest words of each place only."""
        matches = [(name, match) for name in self.terms for match in _pattern(name).finditer(text)]
        taken: list[range] = []
        for name, match in sorted(matches, key=lambda pair: pair[1].start() - pair[1].end()):
            if not any(match.start() < place.stop and place.start < match.end() for place in taken):
                taken.append(range(*match.span()))
                yield Use(self.terms[name], *match.span())


@cache
def _pattern(name: str) -> re.Pattern[str]:
    """Return the pattern of a term in the singular and the plural."""
    words = r"\s+".join(map(re.escape, name.split()))
    words = re.sub(r"radius$", "radi(?:us|i)", re.sub(r"life$", "li(?:fe|ves)", words))
    return re.compile(rf"(?<![\w-])(?<!ring\s)(?<!first\s){words}s?(?![\w-])", re.IGNORECASE)


def _blocks(text: str) -> Iterator[tuple[int, int]]:
    """Yield start and end of paragraphs, items of lists, and cells of tables except head and first column."""
    fence, formula, place, start, previous = "", False, 0, -1, ""
    for line in [*text.splitlines(keepends=True), ""]:
        stripped = line.strip()
        mark = re.match(r"(`{3,}|:{3,})", stripped)
        shown = not fence and not formula and not mark and not stripped.startswith("$$")
        if fence:
            fence = "" if stripped == fence else fence
        elif mark:
            # A box of colons contains running text, a box of backquotes code or a figure.
            fence = mark[1] if mark[1].startswith("`") else ""
        elif stripped.count("$$") % 2:
            formula = not formula
        continues = shown and not _NO_TEXT.match(stripped)
        if start >= 0 and (not continues or _ITEM.match(line)):
            yield start, place
            start = -1
        if continues and start < 0:
            start = place
        if shown and stripped.startswith("|") and previous.startswith("|"):
            bars = [place + match.start() for match in re.finditer(r"(?<!\\)\|", line)]
            yield from pairwise(bars[1:])
        previous = stripped if shown else ""
        place += len(line)


def unlinked(text: str, page: str, glossary: Glossary) -> Iterator[Use]:
    """Yield the terms that a page uses in its running text before it links them.

    A link in the same paragraph, item or cell counts also if it follows the term. The page is the name of its
    file relative to the folder of the documentation.
    """
    known = glossary.explained_on(page)
    for start, end in _blocks(text):
        block = text[start:end]
        for link in _LINKED.finditer(block):
            known |= {use.term for use in glossary.uses((link[1] or link[2] or "").replace("<", " "))}
        running = _NOT_RUNNING.sub(lambda match: "\0" * len(match[0]), block)
        for use in sorted(glossary.uses(running), key=lambda use: use.start):
            if use.term not in known:
                known.add(use.term)
                yield Use(use.term, start + use.start, start + use.end)


def links_terms(page: str) -> bool:
    """Return whether a page links terms."""
    folder, _, name = page.rpartition("/")
    return folder in FOLDERS and name not in ("index.md", "glossary.md")
