"""Table 3 of the paper on the terminal: printed films beside computed ones."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ehlectric.paper.tables import WITHIN

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.paper.tables import PaperTable

# Films of a contact, by their names in the heads of the table of the study.
_FILMS = {"h_min": "minimum film", "h_av": "mean film in the Hertz zone"}
_SOURCES = ("Venner & Napel", "paper", "first order", "second order")


def films_tables(films: PaperTable) -> Iterator[Table]:
    """Tables of the films at 2 GPa for the terminal: printed by two authors, computed with both wedges.

    Parameters
    ----------
    films : PaperTable
        Table that ``ehlectric.paper.tables.printed_table`` returned.

    Yields
    ------
    rich.table.Table
        Minimum films, then mean films; one row for each contact, film thicknesses [µm].
    """
    from rich.table import Table
    from rich.text import Text

    for key, name in _FILMS.items():
        title = Text(f"Table 3, {name} [µm], printed and computed")
        table = Table(title=title, title_justify="left", box=None, padding=(0, 2, 0, 0))
        for head in ("u1 + u2 [m/s]", *_SOURCES, WITHIN):
            table.add_column(Text(head), justify="right", no_wrap=True)
        for row in films.rows:
            cells = dict(zip(films.heads, row, strict=True))
            thicknesses = (f"{cells[f'{source}, {key} [µm]']:.3g}" for source in _SOURCES)
            table.add_row(f"{cells['u_s [m/s]']:g}", *thicknesses, str(cells[WITHIN]))
        yield table
