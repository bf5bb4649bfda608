"""Keys of results: what each number of a summary means, and its SI unit.

Every package has a table of the keys that it fills, in its module ``keys``. Labels of figures, attributes of
NetCDF files and the tables of the documentation are made from these tables.
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
        Meaning of the value, a phrase as the documentation shows it.
    unit : str
        SI unit as pint writes it, such as "V/m"; empty for a dimensionless number, a text or a choice.
    name : str
        Name in labels, such as "minimum film thickness"; empty where a label shows the dotted key.
    symbol : str
        Symbol in labels, in LaTeX; empty for none.
    """

    meaning: str
    unit: str = ""
    name: str = ""
    symbol: str = ""


# Keys of a summary, or of one of its tables. Items of a list have the key of their list, and ``*`` stands for
# any one name.
Keys = Mapping[str, ResultKey]


def under(table: str, keys: Keys) -> dict[str, ResultKey]:
    """Keys of a table of a summary, as dotted keys of the summary.

    Parameters
    ----------
    table : str
        Dotted key of the table.
    keys : mapping of str to ResultKey
        Keys within that table.

    Examples
    --------
    >>> list(under("film", {"residual": ResultKey("largest residual")}))
    ['film.residual']
    """
    return {f"{table}.{name}": key for name, key in keys.items()}


def key_of(keys: Keys, dotted: str) -> ResultKey | None:
    """Entry of a dotted key of a flat summary.

    Parameters
    ----------
    keys : mapping of str to ResultKey
        Keys of the summary.
    dotted : str
        Dotted key, with the numbers of items of lists.

    Returns
    -------
    ResultKey or None
        None where the tables do not have the key.

    Examples
    --------
    >>> keys = {"contacts.load": ResultKey("load", "N"), "sources.*": ResultKey("source of a number")}
    >>> key_of(keys, "contacts.0.load").unit
    'N'
    >>> key_of(keys, "sources.zone_size").meaning
    'source of a number'
    """
    parts = [part for part in dotted.split(".") if not part.isdigit()]
    found = keys.get(".".join(parts))
    for k in range(1, len(parts)):
        found = found or keys.get(".".join([*parts[:k], "*", *parts[k + 1 :]]))
    return found
