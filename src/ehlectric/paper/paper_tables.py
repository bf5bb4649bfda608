"""Tables of the study: Table 3 compared with the printed one, and tests of the paper's conclusions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import astuple, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.contact import Result
from ehlectric.paper.paper_contacts import PaperContact, of_paper, table_3
from ehlectric.paper.study import Study
from ehlectric.runtime.files import csv_of, write

if TYPE_CHECKING:
    from rich.table import Table


MICRO = 1e6

# Mean and largest lateral size of discharge pits that the paper quotes from its reference 46 [m].
PITS = (1.7e-6, 4e-6)

# A film agrees with the print within this relative deviation and half of the last printed digit [m].
TOLERANCE, HALF_PRINT = 0.04, 0.005e-6
WITHIN = f"within {100 * TOLERANCE:.0f} %"

# Part of the half-width over which the deformed roughness is compared with the original one.
INNER = 0.9


@dataclass(frozen=True)
class PaperTable:
    """Table of the study."""

    title: str
    heads: tuple[str, ...]
    # Format of the numbers of each column as shown; the saved table has six significant digits.
    formats: tuple[str, ...]
    rows: tuple[tuple[str | float, ...], ...]

    @property
    def shown(self) -> list[list[str]]:
        """Rows as formatted text without line breaks inside a cell."""
        return [
            [_shown(value, form) for value, form in zip(row, self.formats, strict=True)] for row in self.rows
        ]

    def save(self, path: Path) -> None:
        """Write the table as a CSV file, numbers with six significant digits."""
        rows = (
            [format(value, ".6g") if isinstance(value, float) else value for value in row]
            for row in self.rows
        )
        write(path, csv_of(self.heads, rows))


def _shown(value: str | float, form: str) -> str:
    """Formatted text of one cell."""
    text = format(value, form)
    # A value that rounds to zero is shown without a minus sign.
    if not isinstance(value, str) and float(text) == 0.0:
        text = text.removeprefix("-")
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def _table(
    title: str, columns: Sequence[tuple[str, str]], rows: Sequence[tuple[str | float, ...]]
) -> PaperTable:
    """Table from its columns, each a head and a format, and its rows."""
    heads, formats = zip(*columns, strict=True)
    return PaperTable(title, heads, formats, tuple(rows))


def agrees(computed: float, printed: float) -> bool:
    """Whether a computed film thickness [m] agrees with the printed one [m].

    The two agree if they differ by at most 4 % and half of the last printed digit.

    Examples
    --------
    >>> agrees(0.142e-6, 0.15e-6), agrees(0.2e-6, 0.15e-6)
    (True, False)
    """
    return abs(computed - printed) <= TOLERANCE * printed + HALF_PRINT


# Films of a contact in Table 3, by their names in its heads, and who printed or computed them.
_FILMS = {"h_min": "minimum film", "h_av": "mean film in the Hertzian zone"}
_SOURCES = ("Venner & Napel", "paper", "first order", "second order")


def printed_table(study: Study) -> PaperTable:
    """Table 3 of the paper: films of the 2 GPa contacts, as printed and as computed with both wedges."""
    rows: list[tuple[str | float, ...]] = []
    contacts = {contact.u_s: contact for contact in study.smooth if contact.gigapascal == 2}
    for printed in table_3():
        contact = contacts[printed["u_s"]]
        second, first = study.smooth[contact], study.first_order[contact]
        films = [printed[f"{author}_{key}"] for author in ("venner", "paper") for key in _FILMS]
        computed = [
            thickness
            for result in (first, second)
            for thickness in (result.film.minimum_thickness, result.film.mean_thickness)
        ]
        pairs = [
            pair
            for of_wedge in (computed[:2], computed[2:])
            for pair in zip(2 * of_wedge, [film / MICRO for film in films], strict=True)
        ]
        rows.append(
            (
                contact.u_s,
                "yes" if all(agrees(*pair) for pair in pairs) else "no",
                printed["moes_m"],
                float(second.conditions.contact.moes_m),
                printed["moes_l"],
                float(of_paper(second).moes_l),
                *films,
                *(thickness * MICRO for thickness in computed),
                100.0 * (second.film.discretisation_error or np.nan),
            )
        )
    heads = [f"{source}, {quantity} [µm]" for source in _SOURCES for quantity in _FILMS]
    columns = [("u_s [m/s]", "g"), (WITHIN, ""), ("M printed", "g"), ("M", ".1f")]
    columns += [("L printed", "g"), ("L", ".2f")]
    columns += [(head, ".2f") for head in heads[:4]] + [(head, ".4f") for head in heads[4:]]
    columns += [("grid error [%]", ".2f")]
    return _table("Table 3: films at 2 GPa", columns, rows)


def _row_head(contact: PaperContact, result: Result) -> tuple[str | float, ...]:
    """First cells of a row: name of the contact, M and L."""
    groups = of_paper(result)
    return (contact.name, float(groups.moes_m), float(groups.moes_l))


_HEAD = [("contact", ""), ("M", ".1f"), ("L", ".2f")]


def rough_table(study: Study) -> PaperTable:
    """Table of the largest field of rough contacts, divided by V12/h_min of the rough and smooth films."""
    rows = []
    for contact, rough in study.rough.items():
        smooth, (same, *moved) = study.smooth[contact], study.placed[contact]
        h_smooth, h_rough = smooth.film.minimum_thickness, rough.film.minimum_thickness
        per_volt = rough.field.max_strength / rough.field.voltage
        by_smooth = [placed.largest / placed.minimum_thickness * h_smooth for placed in moved]
        rows.append(
            (
                *_row_head(contact, rough),
                h_smooth * MICRO,
                h_rough * MICRO,
                rough.max_dimensionless,
                same.largest,
                min(placed.largest for placed in moved),
                max(placed.largest for placed in moved),
                per_volt * h_smooth,
                min(by_smooth),
                max(by_smooth),
                amplitude(rough),
            )
        )
    columns = [
        *_HEAD,
        ("h_min smooth [µm]", ".3f"),
        ("h_min rough [µm]", ".3f"),
        (REDUCED_STRENGTH, ".3f"),
        ("on half of the nodes", ".3f"),
        ("shifted, minimum", ".3f"),
        ("shifted, maximum", ".3f"),
        (BY_SMOOTH, ".3f"),
        ("the same shifted, minimum", ".3f"),
        ("the same shifted, maximum", ".3f"),
        (AMPLITUDE, ".2f"),
    ]
    return _table("Largest field of the rough contacts", columns, rows)


REDUCED_STRENGTH = "E_max h_min/V12"
BY_SMOOTH = "E_max smooth h_min/V12"
AMPLITUDE = "film over roughness, rms"


def amplitude(rough: Result) -> float:
    """Amplitude ratio of the roughness in the contact: deformed divided by original roughness.

    The deformed roughness is the rough film minus the smooth film. Both are rms values about their means over
    abs(x) < 0.9 b. The ratio is below 1 if the contact flattens the roughness (amplitude reduction).
    """
    assert rough.smooth is not None
    inner = np.abs(rough.film.x) < INNER * rough.conditions.half_width
    deviation = (rough.film.thickness - rough.smooth.thickness)[inner]
    return float(np.std(deviation) / np.std(rough.roughness[0][inner]))


def width_table(study: Study) -> PaperTable:
    """Table of the width of the zone above 95 % of the largest mid-film field, with b and pit sizes."""
    rows = []
    for contact, result in study.smooth.items():
        width, fine = result.field.high_field_width, study.fine[contact].field.high_field_width
        b = result.conditions.half_width
        rows.append(
            (
                *_row_head(contact, result),
                width * MICRO,
                # Richardson's estimate of the error of the coarser grid, at second order.
                abs(width - fine) * 4.0 / 3.0 * MICRO,
                b * MICRO,
                width / b,
                *(width / pit for pit in PITS),
            )
        )
    columns = [
        *_HEAD,
        ("width [µm]", ".2f"),
        ("grid error [µm]", ".3f"),
        ("half-width b [µm]", ".1f"),
        ("width/b", ".4f"),
        ("width/mean pit 1.7 µm", ".1f"),
        ("width/largest pit 4 µm", ".1f"),
    ]
    return _table("Width of the zone of high field", columns, rows)


def permittivity_table(study: Study) -> PaperTable:
    """Table of the changes in field and capacitance if the permittivity is constant."""
    rows = []
    for contact, constant in study.constant.items():
        result = study.smooth[contact]
        p_h = np.array([result.conditions.max_pressure])
        oil = result.case.oil
        density, _ = oil.density_ratio(p_h)
        at_hertz = float(oil.permittivity(p_h, density)[0])
        inner = result.field.inner
        change = constant.field.middle_strength / result.field.middle_strength - 1.0
        rows.append(
            (
                *_row_head(contact, result),
                float(oil.relative_permittivity),
                at_hertz,
                1e6 * (constant.field.max_strength / result.field.max_strength - 1.0),
                1e6 * float(np.max(np.abs(change[inner]))),
                constant.field.capacitance / result.field.capacitance,
            )
        )
    columns = [
        *_HEAD,
        ("eps ambient", ".2f"),
        ("eps at p_h", ".3f"),
        ("change of E_max [1e-6]", ".2f"),
        ("largest change at mid-film [1e-6]", ".0f"),
        ("capacitance ratio", ".3f"),
    ]
    return _table("The eight contacts with a constant permittivity", columns, rows)


def methods_table(study: Study) -> PaperTable:
    """Table of the convergence of the paper's own methods, and of their differences from ehlectric's."""
    rows = [(contact.name, *astuple(methods)) for contact, methods in study.methods.items()]
    columns = [
        ("contact", ""),
        ("V-cycles to 1e-6", "d"),
        ("factor of a cycle", ".3f"),
        ("film, largest difference", ".0e"),
        ("nodes of the field", "d"),
        ("sweeps", "d"),
        ("best damping factor", ".3f"),
        ("capacitance, difference", ".0e"),
        ("E_max, difference", ".0e"),
    ]
    return _table("The paper's own methods next to ours", columns, rows)


TABLES: dict[str, tuple[Callable[[Study], PaperTable], tuple[str, ...]]] = {
    "table_3": (printed_table, ("smooth", "first_order")),
    "conclusion_1": (rough_table, ("smooth", "rough", "placed")),
    "conclusion_2": (width_table, ("smooth", "fine")),
    "conclusion_3": (permittivity_table, ("smooth", "constant")),
    "methods": (methods_table, ("methods",)),
}


def films_tables(films: PaperTable) -> Iterator[Table]:
    """Tables of the films at 2 GPa for the terminal: printed by two authors, computed with both wedges.
    Yields minimum films, then mean films; one row for each contact, film thicknesses [µm].
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
