"""Kinds of rolling bearings: their elements, the keys of ``[bearing]`` that each needs, and its loads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal


@dataclass(frozen=True)
class KindOfBearing:
    """Elements, keys and loads of the bearings of one kind."""

    elements: Literal["ball", "roller"]  # rollers have line contacts
    needed: tuple[str, ...]  # keys of its own that it needs
    # Static load rating of a row by ISO 76 over Z D^2, or over Z D L of rollers, for typical ratios of
    # diameters [N/mm^2].
    static: float
    # Largest speed factor n d_m, rotational speed times pitch diameter, of ordinary bearings [mm/min].
    most_speed: float
    also: tuple[str, ...] = ()  # keys of its own that it may have
    radial: bool = True  # whether it carries radial loads
    axial: bool = True  # whether its raceways carry axial loads

    @property
    def rollers(self) -> bool:
        """Whether its elements are rollers."""
        return self.elements == "roller"

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of its own that it needs or may have."""
        return self.needed + self.also


_GROOVES = ("inner_groove", "outer_groove", "shoulder_height")
_ROLLERS = ("roller_length", "profile")

# By ``bearing.kind``. The speed factors are the maxima, with solid cages and oil, of M. J. Neale (ed.), The
# Tribology Handbook, Butterworth-Heinemann, 2nd ed. 1995, tables 20.2 and 20.3. Of thrust balls the handbook
# has 2e5 of n (D H)^0.5, and d_m is 1.5 (D H)^0.5 of the series 512. Needle rollers and thrust needle rollers
# are not in the handbook: unverified source. The factor f0 of radial balls, 12.4 to 15.7 for diameters up to
# 0.35 of the pitch diameter, counts as 13, and the factor of radial rollers, 44 (1 - D/d_m), as 40.
KINDS_OF_BEARINGS: Mapping[str, KindOfBearing] = MappingProxyType(
    {
        "deep-groove ball": KindOfBearing("ball", (*_GROOVES, "radial_clearance"), 13.0, 1e6),
        "angular-contact ball": KindOfBearing("ball", (*_GROOVES, "contact_angle"), 13.0, 1e6, ("pair",)),
        "four-point contact ball": KindOfBearing(
            "ball", (*_GROOVES, "contact_angle", "radial_clearance"), 13.0, 1e6
        ),
        "thrust ball": KindOfBearing("ball", _GROOVES, 60.0, 3e5, radial=False),
        "cylindrical roller": KindOfBearing(
            "roller", (*_ROLLERS, "radial_clearance"), 40.0, 8e5, axial=False
        ),
        "needle roller": KindOfBearing(
            "roller", (*_ROLLERS, "radial_clearance"), 40.0, 5e5, ("inner_ring",), axial=False
        ),
        "tapered roller": KindOfBearing("roller", (*_ROLLERS, "contact_angle"), 40.0, 4e5, ("pair",)),
        "thrust needle roller": KindOfBearing("roller", _ROLLERS, 220.0, 3e5, radial=False),
    }
)

# Keys that bearings of some kinds have, and others have not.
KEYS_OF_KINDS = tuple(dict.fromkeys(key for kind in KINDS_OF_BEARINGS.values() for key in kind.keys))


def has_rollers(kind: str) -> bool:
    """Whether the elements of bearings of a kind are rollers.

    Examples
    --------
    >>> has_rollers("thrust needle roller"), has_rollers("four-point contact ball")
    (True, False)
    """
    return KINDS_OF_BEARINGS[kind].rollers
