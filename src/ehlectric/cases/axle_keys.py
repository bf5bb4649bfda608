"""Keys of bearings, meshes and shafts of an axle, and kinds of bearings that are adjusted in pairs."""

from __future__ import annotations

import re
from collections.abc import Sequence

# Name of the node whose potential is 0.
HOUSING = "housing"

# Loads of a bearing.
LOADS = ("radial_load", "axial_load")

# Kinds of bearings of which two on a shaft are adjusted against each other.
ADJUSTED = ("angular-contact ball", "tapered roller")

# Quantities of an element and of a shaft that a calibration compares, with their names for a bearing.
OF_ELEMENTS = {name: name for name in ("capacitance", "breakdown_voltage", "conducting_share")}
OF_SHAFTS = {"voltage": "shaft_voltage"}


def element_keys(bearings: Sequence[str], meshes: int) -> list[str]:
    """Return the keys of all bearings, and then of all meshes.

    ``bearings`` contains the name of the shaft of each bearing. A bearing has the key "SHAFT_NUMBER", and a
    mesh the key "mesh_NUMBER". If two keys would be equal, a bearing has the key "bearing_NUMBER".

    Examples
    --------
    >>> element_keys(["rotor", "hollow shaft", "rotor"], 1)
    ['rotor_1', 'hollow_shaft_1', 'rotor_2', 'mesh_1']
    >>> element_keys(["mesh", "rotor"], 1)
    ['bearing_1', 'bearing_2', 'mesh_1']
    """
    keys = [f"{_plain(shaft)}_{bearings[: n + 1].count(shaft)}" for n, shaft in enumerate(bearings)]
    of_meshes = [f"mesh_{number}" for number in range(1, meshes + 1)]
    if len({*keys, *of_meshes}) < len(bearings) + meshes:
        keys = [f"bearing_{number}" for number in range(1, len(bearings) + 1)]
    return [*keys, *of_meshes]


def shaft_keys(names: Sequence[str]) -> list[str]:
    """Return the keys of the shafts: their names, or "shaft_NUMBER" if two keys would be equal.

    Examples
    --------
    >>> shaft_keys(["rotor", "hollow shaft"]), shaft_keys(["a b", "a-b"])
    (['rotor', 'hollow_shaft'], ['shaft_1', 'shaft_2'])
    """
    keys = [*map(_plain, names)]
    return keys if len({*keys}) == len(keys) else [f"shaft_{number}" for number in range(1, len(names) + 1)]


def name_of_quantity(quantity: str) -> str:
    """Return the name of a measured quantity without its element or shaft, as for a bearing.

    Examples
    --------
    >>> name_of_quantity("elements.rotor_1.capacitance"), name_of_quantity("shafts.rotor.voltage")
    ('capacitance', 'shaft_voltage')
    """
    name = quantity.rpartition(".")[2]
    return OF_SHAFTS.get(name, name)


def _plain(name: str) -> str:
    """Name with letters, digits and underscores only.

    Examples
    --------
    >>> _plain("shaft 2, left")
    'shaft_2_left'
    """
    return re.sub(r"\W+", "_", name)
