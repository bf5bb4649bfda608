"""Check that a tag and the files of the repository name one version: python tools/check_tag.py v1.2.3.

The workflow that publishes a version runs it first. It prints a line for each file that disagrees.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]

# What names the version, by file; of the changelog the first section.
VERSIONS = {
    "src/ehlectric/version.py": r'^__version__ = "(.*)"$',
    "CITATION.cff": r"^version: (.*)$",
    "packaging/conda/recipe.yaml": r'^  version: "?([^"]*)"?$',
    "CHANGELOG.md": r"^## (.*), \d{4}-\d\d-\d\d$",
}


def disagreements(tag: str, root: Path = ROOT) -> list[str]:
    """Return a line for each file with another version than the tag, and for fragments that are left."""
    lines = []
    for name, pattern in VERSIONS.items():
        match = re.search(pattern, (root / name).read_text(encoding="utf-8"), re.MULTILINE)
        version = match[1] if match else "no version"
        if tag != f"v{version}":
            lines.append(f"{name}: got {version}; expected {tag.removeprefix('v')}, as the tag {tag}")
    if entries := len(list((root / "changes").glob("+*.md"))):
        lines.append(f"changes: {entries} entries are not in CHANGELOG.md; write it with towncrier build")
    return lines


def main(tag: str) -> int:
    """Print what disagrees with the tag, and return the exit status."""
    lines = disagreements(tag)
    print("\n".join(lines) or f"{tag} is the version of all files")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
