"""Keys of results: meaning, SI unit, name and symbol of each number of a summary.

Each package lists the keys that it fills in its module ``keys``. Labels of figures, attributes of NetCDF
files and tables of the documentation are made from these lists.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class ResultKey:
    """Meaning, unit, name and symbol of one key of a summary.

    Attributes
    ----------
    meaning : str
        Meaning of the value, as a phrase for the documentation.
    unit : str
        SI unit as pint writes it, such as "V/m"; empty for a dimensionless number, a text or a choice.
    name : str
        Name in labels, such as "minimum film thickness"; if it is empty, labels show the dotted key.
    symbol : str
        Symbol in labels, in LaTeX; empty if there is none.
    """

    meaning: str
    unit: str = ""
    name: str = ""
    symbol: str = ""


# Keys of a summary, or of one of its tables. An item of a list has the key of the list, if it has none of its
# own; ``*`` stands for any single name.
Keys = Mapping[str, ResultKey]


def under(table: str, keys: Keys) -> dict[str, ResultKey]:
    """Convert the keys of a table to dotted keys of the summary that contains the table.

    Parameters
    ----------
    table : str
        Dotted key of the table.
    keys : mapping of str to ResultKey
        Keys within the table.

    Returns
    -------
    dict of str to ResultKey
        The same keys, each preceded by ``table`` and a dot.

    Examples
    --------
    >>> list(under("film", {"residual": ResultKey("largest residual")}))
    ['film.residual']
    """
    return {f"{table}.{name}": key for name, key in keys.items()}


def key_of(keys: Keys, dotted: str) -> ResultKey | None:
    """Look up a dotted key of a summary.

    Parameters
    ----------
    keys : mapping of str to ResultKey
        Keys of the summary.
    dotted : str
        Dotted key; items of lists are numbered, as in "contacts.0.load".

    Returns
    -------
    ResultKey or None
        Meaning, unit, name and symbol of the key; None if the key is unknown.

    Examples
    --------
    >>> keys = {"contacts.load": ResultKey("load", "N"), "sources.*": ResultKey("source of a number")}
    >>> key_of(keys, "contacts.0.load").unit
    'N'
    >>> key_of(keys, "sources.zone_size").meaning
    'source of a number'
    """
    parts = [part for part in dotted.split(".") if not part.isdigit()]
    entry = keys.get(dotted) or keys.get(".".join(parts))
    for k in range(1, len(parts)):
        entry = entry or keys.get(".".join([*parts[:k], "*", *parts[k + 1 :]]))
    return entry
