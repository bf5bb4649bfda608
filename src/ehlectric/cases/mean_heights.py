"""Roughness given as Ra, the mean height, with the factor that converts it to Rq, the rms height."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from pydantic import SerializerFunctionWrapHandler, model_serializer, model_validator

from ehlectric.arrays import Numbers
from ehlectric.cases.amounts import amount_at
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, within

# Rq/Ra of heights with a Gaussian distribution, sqrt(pi/2).
GAUSSIAN = math.sqrt(0.5 * math.pi)

FACTOR = "rq_over_ra"

# Relative difference of a stored Rq from its Ra.
_ROUNDING = 1e-9


def rq_of(ra: Numbers, factor: Numbers | None) -> Numbers:
    """Rq [m] of an Ra [m] with a factor Rq/Ra; without a factor, of Gaussian heights.

    Examples
    --------
    >>> round(rq_of(1.0, None), 4), rq_of(1.0, 1.11)
    (1.2533, 1.11)
    """
    return ra * (GAUSSIAN if factor is None else factor)


def with_rq(table: Any, book: str, rq: str, ra: str) -> Any:
    """Table with the Rq that follows from its Ra.

    ``book``, name of the table in the book of inputs; ``rq`` and ``ra``, keys of both heights. Raises
    InputError for two different heights, and for a factor without an Ra.
    """
    if not isinstance(table, Mapping):
        return table
    if table.get(ra) is None:
        if table.get(FACTOR) is not None:
            raise InputError(FACTOR, got=f"it without {ra}", takes=f"{ra}, which it converts to {rq}")
        return table
    mean, factor = (_parsed(table, book, key) for key in (ra, FACTOR))
    assert mean is not None
    height = float(rq_of(mean, factor))
    given = _parsed(table, book, rq)
    if given is not None and not math.isclose(given, height, rel_tol=_ROUNDING):
        raise InputError(rq, got=f"{rq} and {ra} together", takes="one of them")
    return {**table, rq: height}


def _parsed(table: Mapping[str, Any], book: str, key: str) -> float | None:
    """Number of a key in SI units; None if the table lacks it."""
    value = table.get(key)
    with within(key):
        return None if value is None else amount_at(f"{book}.{key}").parse(value)


def without_rq(tables: dict[str, Any], rq: str, ra: str) -> dict[str, Any]:
    """Values of a table for a file, which states the Ra and not the Rq that follows from it."""
    return {key: value for key, value in tables.items() if key != rq or tables.get(ra) is None}


class StatedRa(Table):
    """Table whose ``rq`` may be stated as ``ra``, with or without ``rq_over_ra``."""

    @model_serializer(mode="wrap")
    def _of_ra(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        return without_rq(handler(self), "rq", "ra")

    @model_validator(mode="before")
    @classmethod
    def _with_rq(cls, table: Any) -> Any:
        """Rq that follows from a given Ra."""
        return with_rq(table, cls.BOOK, "rq", "ra")
