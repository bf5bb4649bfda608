"""Table of the licences of all packages that ehlectric needs, from what is installed."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

# Extras that users install, in the order of the table.
EXTRAS = ("", "app", "excel", "parquet", "cluster")
_PREFIX = "License :: OSI Approved :: "

# Longest text of a licence that is its name.
_LONGEST = 60


def needed(root: Path) -> dict[str, str]:
    """Names of all packages that ehlectric or one of its extras needs, each with the first extra."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    found: dict[str, str] = {}
    for extra in EXTRAS:
        own = project["optional-dependencies"][extra] if extra else project["dependencies"]
        for text in own:
            _add(Requirement(text), extra, found)
    return found


def _add(requirement: Requirement, extra: str, found: dict[str, str]) -> None:
    """Add a requirement with all that it needs, where it is installed."""
    name = canonicalize_name(requirement.name)
    if name in found or (requirement.marker and not requirement.marker.evaluate({"extra": ""})):
        return
    try:
        package = distribution(name)
    except PackageNotFoundError as error:
        raise ExtensionError(f"{name} is not installed, so that its licence is not known") from error
    found[name] = extra
    for text in package.requires or ():
        own = Requirement(text)
        extras = requirement.extras or {""}
        if own.marker is None or any(own.marker.evaluate({"extra": one}) for one in extras):
            _add(own, extra, found)


def licence(package: Distribution) -> str:
    """Licence of a package as its metadata name it."""
    about = package.metadata
    named = about.get("License-Expression") or ""
    kinds = [
        text.removeprefix(_PREFIX) for text in about.get_all("Classifier") or () if text.startswith(_PREFIX)
    ]
    text = (about.get("License") or "").strip()
    short = text if text and len(text) <= _LONGEST and "\n" not in text else ""
    return named or "; ".join(kinds) or short or "see its files"


def rows(root: Path) -> Iterator[str]:
    """Lines of the table, in Markdown."""
    yield "| package | version | licence | needed by |"
    yield "| --- | --- | --- | --- |"
    for name, extra in sorted(needed(root).items()):
        package = distribution(name)
        by = f"`ehlectric[{extra}]`" if extra else "ehlectric"
        yield f"| {package.metadata['Name']} | {package.version} | {licence(package)} | {by} |"


def write(app: Sphinx) -> None:
    """Write the table for the page that includes it."""
    folder = Path(app.srcdir) / "_generated"
    folder.mkdir(exist_ok=True)
    lines = rows(Path(app.srcdir).parent)
    (folder / "licences.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Write the table before anything is read."""
    app.connect("builder-inited", write)
    return {"parallel_read_safe": True}
