"""Descriptions of the fields of a form."""

from __future__ import annotations

from collections.abc import Iterable

from ehlectric.cases.input_keys import describe
from ehlectric.errors import InputError


def field_help(keys: Iterable[str]) -> dict[str, str]:
    """Descriptions of dotted keys, as the reference of the input files has them.

    Keys without a description, such as ``title``, are left out.
    """
    found = {}
    for key in keys:
        try:
            found[key] = describe(key)
        except InputError:
            continue
    return found
