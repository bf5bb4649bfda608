"""Library of lubricants, solids, bearings and coatings: one TOML file each, with its sources."""

from __future__ import annotations

import csv
from copy import deepcopy
from functools import cache
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any

import tomli

_FOLDER: Traversable = resources.files(__name__)


def _names(kind: str) -> list[str]:
    return list(_listed(str(_FOLDER), kind))


@cache
def _listed(_folder: str, kind: str) -> tuple[str, ...]:
    """Names in the folder of the library, which is looked at once."""
    files = [file.name for file in (_FOLDER / f"{kind}s").iterdir()]
    return tuple(sorted(name.removesuffix(".toml") for name in files if name.endswith(".toml")))


def tables(kind: str, name: str) -> dict[str, Any]:
    """All tables of a file: "lubricant", "solid" or "bearing", with its sources."""
    return deepcopy(_read(kind, name))


@cache
def _read(kind: str, name: str) -> dict[str, Any]:
    path = _FOLDER / f"{kind}s" / f"{name}.toml"
    return tomli.loads(path.read_text(encoding="utf-8"))


def _table(kind: str, name: str) -> dict[str, Any]:
    table: dict[str, Any] = deepcopy(_read(kind, name)[kind])
    return table


@cache
def rows(name: str) -> tuple[dict[str, str], ...]:
    """Rows of a table of the library, such as "clearances.csv", without its comments."""
    lines = (_FOLDER / name).read_text(encoding="utf-8").splitlines()
    return tuple(csv.DictReader(line for line in lines if not line.startswith("#")))


def lubricant_names() -> list[str]:
    """Names of lubricants that a case file can use as ``lubricant.base``."""
    return _names("lubricant")


def lubricant(name: str) -> dict[str, Any]:
    """Table ``lubricant`` of a named lubricant, in the form of a case file."""
    return _table("lubricant", name)


def solid_names(*, rolling: bool = False, thermal: bool = False, conducting: bool = False) -> list[str]:
    """Names of solids that a file can use as materials.

    Only materials of rings and elements if ``rolling``, only materials with known thermal properties if
    ``thermal``, and only materials that conduct if ``conducting``.
    """
    names = [name for name in _names("solid") if not rolling or _read("solid", name)["solid"]["rolling"]]
    names = [name for name in names if not conducting or _read("solid", name)["solid"]["conducting"]]
    return [name for name in names if not thermal or "thermal_conductivity" in _read("solid", name)["solid"]]


def solid(name: str) -> dict[str, Any]:
    """Properties of a named solid: elastic, thermal, and whether it conducts and rolls.

    Quantities are texts with units. A solid rolls if it is hard enough for rings and rolling elements.
    """
    return _table("solid", name)


def bearing_names() -> list[str]:
    """Names of bearings that a bearing file can use as ``bearing.base``."""
    return _names("bearing")


def bearing(name: str) -> dict[str, Any]:
    """Table ``bearing`` of a named bearing, with those dimensions that are published."""
    return _table("bearing", name)


def coating_names() -> list[str]:
    """Names of coated rings that a bearing file can use as ``bearing.coating.base``."""
    return _names("coating")


def coating(name: str) -> dict[str, Any]:
    """Table ``bearing.coating`` of a named coated ring, with those values that its maker states."""
    return _table("coating", name)
