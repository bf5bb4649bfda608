"""Values of a contact that no machine has, and that were probably given in the wrong unit."""

from __future__ import annotations

import warnings
from collections.abc import Iterator

from ehlectric.cases.contact import Contact

# Radius of contact above which a unit is probably wrong: the largest rolls and gears are near it [m].
_LARGEST = 1.0

# Reduced modulus below which a unit is probably wrong [Pa]: plastics have 1 to 20 GPa, and rubber, which is
# softer, does not carry a bearing or a gear.
_SOFTEST = 1e9


def radius_doubt(key: str, radius: float) -> Iterator[str]:
    """Doubt about a reduced radius [m], with its key, that no machine part has.

    Examples
    --------
    >>> print(*radius_doubt("reduced_radius", 14.1))
    reduced_radius is 14.1 m, more than machine parts have: is the unit of the radii right?
    """
    if radius > _LARGEST:
        yield f"{key} is {radius:.4g} m, more than machine parts have: is the unit of the radii right?"


def modulus_doubt(modulus: float) -> Iterator[str]:
    """Doubt about a reduced modulus [Pa] of rubber.

    Examples
    --------
    >>> print(*modulus_doubt(226e6))
    the reduced modulus is 226 MPa, that of rubber; steel has 226 GPa: is the unit of the moduli right?
    """
    if modulus < _SOFTEST:
        yield (
            f"the reduced modulus is {modulus / 1e6:.4g} MPa, that of rubber; steel has 226 GPa: is the unit "
            "of the moduli right?"
        )


def warn_of(contact: Contact, *, level: int) -> None:
    """Warn in Python of doubtful radii and moduli of a contact; ``level`` counts calls up to the user's."""
    found: list[str] = []
    for key in ("reduced_radius", "radius_x"):
        radius = contact.value(key)
        found += [] if radius is None else radius_doubt(f"contact.{key}", radius)
    if contact.reduced_modulus is not None:
        found += modulus_doubt(contact.reduced_modulus)
    for text in found:
        warnings.warn(text, stacklevel=level + 1)
