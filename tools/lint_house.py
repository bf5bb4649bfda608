"""Check rules of this repository that ruff, mypy and import-linter do not know.

`make lint` runs `python tools/lint_house.py`. Each broken rule is a line "file:line: what is wrong". If
there is one, the exit status is 1.
"""

import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
MOST_WORDS = 30  # of one entry of the changelog


class Fault(NamedTuple):
    """A place, relative to the root of the repository, and what is wrong there."""

    file: Path
    line: int
    message: str

    def __str__(self) -> str:
        return f"{self.file.as_posix()}:{self.line}: {self.message}"


def change_kinds(root: Path) -> list[str]:
    """Return the kinds of changes that towncrier is configured for."""
    config = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["towncrier"]
    return [kind["directory"] for kind in config["type"]]


def fragments_of_the_changelog(root: Path) -> Iterator[Fault]:
    """Yield fragments in changes/ whose name, kind, length or form is wrong."""
    kinds = change_kinds(root)
    name = re.compile(rf"\+[a-z0-9-]+\.({'|'.join(kinds)})\.md")
    for file in sorted((root / "changes").iterdir()):
        place = file.relative_to(root)
        if not name.fullmatch(file.name):
            expected = f"+name.KIND.md, with small letters, digits and hyphens; KIND is {', '.join(kinds)}"
            yield Fault(place, 1, f"the name of a fragment is {expected}")
            continue
        text = file.read_text(encoding="utf-8")
        count = len(text.split())
        if count > MOST_WORDS:
            yield Fault(place, 1, f"{count} words; an entry has at most {MOST_WORDS}")
        if text.count("\n") != 1 or not text.endswith(".\n"):
            yield Fault(place, 1, "an entry is one line that ends with a full stop")
        if text.startswith(("- ", "* ")):
            yield Fault(place, 1, "an entry begins without a bullet; towncrier writes it")


def actions_of_the_workflows(root: Path) -> Iterator[Fault]:
    """Yield actions that are not pinned by the hash of a commit, with the version as a comment."""
    pinned = re.compile(r"uses: [\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+")
    for file in sorted((root / ".github/workflows").glob("*.yml")):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            if "uses: " in line and not pinned.search(line):
                message = "pin the action by the hash of its commit, and add the version: @HASH # v1.2.3"
                yield Fault(file.relative_to(root), number, message)


RULES = (fragments_of_the_changelog, actions_of_the_workflows)


def faults(root: Path = ROOT) -> list[Fault]:
    """Return what breaks a rule, in the order of the rules."""
    return [fault for rule in RULES for fault in rule(root)]


def main() -> int:
    """Print the faults, and return the exit status."""
    broken = faults()
    for fault in broken:
        print(fault)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
