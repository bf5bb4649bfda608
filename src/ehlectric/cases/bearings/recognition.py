"""Recognition of a bearing file that lacks its table ``bearing``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.cases.contact import Contact

# Tables and keys of a bearing file that a case of a contact does not have.
_TABLES = ("motor", "contacts", "ranges")


def bearing_key(table: Mapping[str, Any]) -> str | None:
    """Key at the top of a file that only a bearing file has, or only its table ``bearing``; None without one.

    Parameters
    ----------
    table : mapping
        Nested tables of a file that has no table ``bearing``.

    Examples
    --------
    >>> bearing_key({"lubricant": {}, "motor": {}}), bearing_key({"radial_load": "1 kN"})
    ('motor', 'radial_load')
    >>> bearing_key({"contact": {}, "motor": {}})
    """
    if "contact" in table:
        return None
    own = Bearing.known_keys().keys() - Contact.known_keys().keys()
    return next((key for key in table if key in _TABLES or key in own), None)
