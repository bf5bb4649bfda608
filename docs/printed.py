"""Take the rows and the numbers of a page from the output of a command."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable

_NUMBER = re.compile(r"(<!--(\w+): ([^>]+)-->)(.*?)(<!--/-->)", re.DOTALL)
_ROW = re.compile(r"(\s*)(\S.*?\S)(\s{2,})\S.*")


def renewed_numbers(page: str, printed: Callable[[str, int], list[str]]) -> str:
    """Return a page with the numbers of its sentences from outputs: of a command by its name, and a line.

    Raises LookupError if all outputs lack a label of the page.
    """

    def number(found: re.Match[str]) -> str:
        outputs = printed(found[2], page.count("\n", 0, found.start()) + 1)
        return found[1] + _after(found[3], found[4], outputs) + found[5]

    return _NUMBER.sub(number, page)


def renewed_block(block: str, printed: str) -> str:
    """Return a block with the rows that it has, and its verdict, as the output contains them.

    Raises LookupError if the output lacks a label or a line of the block, or has another order. Numbers of a
    line may differ.
    """
    known, at = _rows(printed), 0
    rows, verdict = _split(block.splitlines())
    made = []
    for line in rows:
        row = _ROW.fullmatch(line)
        label = row[2] if row else line.strip()
        # Rows have the order of the output, and several rows may have one label.
        places = [k for k in range(at, len(known)) if bool(known[k][1]) == bool(row)]
        place = next((k for k in places if known[k][0] == label), None)
        if place is None and not row:
            place = next(
                (k for k in places if _without_numbers(known[k][0]) == _without_numbers(label)), None
            )
        if place is None:
            raise LookupError(label)
        at = place + 1
        made.append(line[: row.end(3)] + known[place][1] if row else line.replace(label, known[place][0]))
    if verdict:
        width = max(_WIDTH, *map(len, rows), 0)
        new = _verdict(verdict, printed.splitlines())
        made += [part for line in new for part in textwrap.wrap(line, width, subsequent_indent=_INDENT)]
    return "".join(f"{line}\n" for line in made)


def _without_numbers(line: str) -> str:
    """Line with a sign for each of its numbers."""
    return re.sub(r"\d[\d.]*", "#", line)


# Width of the lines of a verdict, and the indent of what follows their first lines, below the texts.
_WIDTH, _INDENT = 100, " " * 15


def _begins_verdict(lines: list[str], place: int) -> str:
    """Label of the first line of a verdict whose heading is at a place, empty if none is there."""
    heading, first = lines[place], re.match(r"  (\w+) {2,}\S", lines[place + 1])
    return first[1] if first and heading[:1].strip() and not _ROW.fullmatch(heading) else ""


def _split(lines: list[str]) -> tuple[list[str], list[str]]:
    """Lines of a table, and of the verdict at its end: a heading, and labels with two spaces before them."""
    for place in reversed(range(len(lines) - 1)):
        if _begins_verdict(lines, place):
            return lines[:place], lines[place:]
    return lines, []


def _verdict(verdict: list[str], printed: list[str]) -> list[str]:
    """Verdict of an output whose first label is the first label of another verdict."""
    label = _begins_verdict(verdict, 0)
    for place in reversed(range(len(printed) - 1)):
        if _begins_verdict(printed, place) == label:
            count = next(
                (k for k, line in enumerate(printed[place + 1 :]) if not line.startswith("  ")), None
            )
            return printed[place:][: None if count is None else count + 1]
    raise LookupError(verdict[0])


def _rows(printed: str) -> list[tuple[str, str]]:
    """Labels and texts of the rows of an output, with texts that are broken into lines as one; headings
    without a text.
    """
    rows: list[tuple[str, str]] = []
    column = 0
    for line in printed.splitlines():
        found = _ROW.fullmatch(line.rstrip())
        if found:
            column = found.end(3)
            rows.append((found[2], line[column:].rstrip()))
        elif rows and column and not line[:column].strip() and line.strip():
            rows[-1] = rows[-1][0], f"{rows[-1][1]} {line.strip()}"
        elif line.strip():
            rows.append((line.strip(), ""))
    return rows


def _after(label: str, shown: str, outputs: list[str]) -> str:
    """Words of an output after a label, as many as are shown, without punctuation at their end."""
    count = len(shown.split())
    for printed in outputs:
        words = " ".join(printed.split())
        if found := re.search(re.escape(label) + " " + " ".join([r"(\S+)"] * count), words):
            return " ".join(found.groups()).rstrip(".,;:)")
    raise LookupError(label)
