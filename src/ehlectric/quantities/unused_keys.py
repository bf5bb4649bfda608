"""Notes about keys that a file contains, and that have no effect on the result."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ehlectric.quantities.result_warnings import ResultWarning


def given_keys(table: Any, keys: Sequence[str]) -> list[str]:
    """Return the dotted keys that a table and the tables in it contain with another value than the default.

    The values decide, so that a case that was saved and loaded has the same keys.
    """
    return [key for key in keys if _is_given(table, key)]


def _is_given(table: Any, key: str) -> bool:
    name, _, rest = key.partition(".")
    if table is None:
        return False
    inner = getattr(table, name)
    if rest:
        return _is_given(inner, rest)
    return bool(inner != type(table).model_fields[name].get_default(call_default_factory=True))


def unused_note(situation: str, keys: Sequence[str], part: str = "") -> ResultWarning:
    """Note about given keys, of a part such as a bearing, that have no effect.

    Examples
    --------
    >>> print(unused_note("pair_alone", ["ranges", "duty"], "mesh of a and b"))
    mesh of a and b: ranges and duty of the gear file are not used by an axle. No action is needed.
    """
    *others, last = keys
    warning = ResultWarning.of(
        "key-unused",
        situation,
        names=f"{', '.join(others)} and {last}" if others else last,
        are="are" if others else "is",
        them="them" if others else "it",
    )
    return ResultWarning(warning.code, f"{part}: {warning}") if part else warning
