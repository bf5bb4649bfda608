"""Named lubricants, solids and bearings, one TOML file each, with the source of its numbers."""

from __future__ import annotations

import tomllib
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any

_FOLDER: Traversable = resources.files(__name__)


def _names(kind: str) -> list[str]:
    return sorted(file.name.removesuffix(".toml") for file in (_FOLDER / f"{kind}s").iterdir())


def _table(kind: str, name: str) -> dict[str, Any]:
    path = _FOLDER / f"{kind}s" / f"{name}.toml"
    table: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))[kind]
    return table


def lubricant_names() -> list[str]:
    """Names a case file can use as ``lubricant.base``."""
    return _names("lubricant")


def lubricant(name: str) -> dict[str, Any]:
    """The ``[lubricant]`` table of a named lubricant, as a case file would give it."""
    return _table("lubricant", name)


def solid_names() -> list[str]:
    """Names a bearing file can use as materials."""
    return _names("solid")


def solid(name: str) -> dict[str, Any]:
    """Elastic constants and density of a named solid, with their units, and whether it conducts."""
    return _table("solid", name)


def bearing_names() -> list[str]:
    """Names a bearing file can use as ``bearing.base``."""
    return _names("bearing")


def bearing(name: str) -> dict[str, Any]:
    """The ``[bearing]`` table of a named bearing, as far as its geometry is published."""
    return _table("bearing", name)
