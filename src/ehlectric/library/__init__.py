"""Named lubricants, one TOML file each, with the source of its numbers."""

from __future__ import annotations

import tomllib
from importlib import resources
from typing import Any


def lubricant_names() -> list[str]:
    """Names a case file can use as ``lubricant.base``."""
    folder = resources.files(__name__) / "lubricants"
    return sorted(f.name.removesuffix(".toml") for f in folder.iterdir())


def lubricant(name: str) -> dict[str, Any]:
    """The ``[lubricant]`` table of a named lubricant, as a case file would give it."""
    path = resources.files(__name__) / "lubricants" / f"{name}.toml"
    table: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))["lubricant"]
    return table
