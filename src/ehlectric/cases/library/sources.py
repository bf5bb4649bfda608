"""Sources of the numbers in the files of the library, and how good each of them is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

from ehlectric.errors import InputError, shown

Kind = Literal["measured", "read off a diagram", "fitted", "published", "by rule", "estimated", "assumed"]

# Kinds of a source, the best first.
KINDS: tuple[Kind, ...] = get_args(Kind)


@dataclass(frozen=True)
class Source:
    """Source of some values of a file of the library.

    Attributes
    ----------
    keys : tuple of str
        Keys of the values.
    kind : str
        One of ``KINDS``; "by rule" follows from published values by a rule that the note states.
    citation : str
        Where the values were read; empty where they are assumed.
    doi : str
        DOI of the citation, or empty.
    note : str
        What else has to be known, such as the rule or the reason for an assumption.
    """

    keys: tuple[str, ...]
    kind: Kind
    citation: str = ""
    doi: str = ""
    note: str = ""


def sources_of(table: Mapping[str, Any]) -> tuple[Source, ...]:
    """Sources of a file of the library, in the order of its ``[[source]]`` tables.

    Parameters
    ----------
    table : mapping
        All tables of the file.

    Returns
    -------
    tuple of Source
        One source for each table.

    Raises
    ------
    InputError
        If a source has a kind that does not exist, or no citation; an assumed value needs a note at least.
    """
    return tuple(_source(entry) for entry in table.get("source", ()))


def _source(entry: Mapping[str, Any]) -> Source:
    source = Source(**{**entry, "keys": tuple(entry["keys"])})
    if source.kind not in KINDS:
        raise InputError("source.kind", got=shown(source.kind), takes=f"one of {', '.join(KINDS)}")
    if not (source.citation or (source.kind == "assumed" and source.note)):
        raise InputError.missing("source", f"a citation for {', '.join(source.keys)}, or a note if assumed")
    return source


def weakest(sources: Iterable[Source], keys: Iterable[str]) -> Kind | None:
    """Kind of the weakest source among those of some keys; none where the keys have no source."""
    wanted = set(keys)
    kinds = [source.kind for source in sources if wanted & set(source.keys)]
    return max(kinds, key=KINDS.index, default=None)
