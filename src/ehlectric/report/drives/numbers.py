"""Tables of a drive in a report: what was simulated, and both bearings side by side."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.discharge.laws import CURRENT_DENSITY_LIMITS
from ehlectric.quantities.drive_results import NAMES_OF_ENDS
from ehlectric.quantities.rows import Summary
from ehlectric.report.content import Table, Text
from ehlectric.report.facts import BOUNDS, row_tables, unbroken
from ehlectric.tables.drive import end_cells, whole_rows

# Published limits of the current density [A/mm²].
_LIMITS = f"{1e-6 * CURRENT_DENSITY_LIMITS[0]:g} to {1e-6 * CURRENT_DENSITY_LIMITS[-1]:g}"

_SHARES = (0.44, 0.22, 0.22, 0.12)
_BOUND = (
    f"{BOUNDS['≤']} The interval of 95 % counts the scatter within the simulated time, and not the errors of "
    "the inputs. A dash stands where there is no such number, as without discharges or for ceramic elements. "
    f"Published limits are {_LIMITS} A/mm² for the current density of all elements."
)


def number_tables(summary: Summary) -> Iterator[Table | Text]:
    """Tables of what was simulated, and of both bearings side by side."""
    yield from row_tables(whole_rows(summary), "simulation")
    heads = ("quantity", *NAMES_OF_ENDS.values(), "unit")
    for caption, rows in end_cells(summary):
        cells = tuple(tuple(map(unbroken, row)) for row in rows)
        yield Table(caption, heads, cells, (1, 2), shares=_SHARES)
    yield Text(_BOUND)
