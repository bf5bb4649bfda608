"""report.html: figures, tables, the three conclusions and the slips of the print, in one file."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib import resources
from pathlib import Path

import numpy as np
from jinja2 import Environment, StrictUndefined

from ehlectric.paper.contacts import ROUGH_NODES, SMOOTH_NODES
from ehlectric.paper.errata import SLIPS
from ehlectric.paper.figures import FIGURES
from ehlectric.paper.sor import ROWS
from ehlectric.paper.study import Study
from ehlectric.paper.tables import TABLES, PaperTable
from ehlectric.version import __version__


def html(study: Study, figures: Mapping[int, Path]) -> str:
    """The report of a whole study as text.

    Parameters
    ----------
    study : Study
        With all its parts.
    figures : mapping
        PNG files by number, to be embedded.

    Returns
    -------
    str
        One HTML page that refers to nothing outside itself.
    """
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    template = (resources.files("ehlectric.paper") / "report.html.jinja").read_text(encoding="utf-8")
    tables = {name: build(study) for name, (build, _) in TABLES.items()}
    return environment.from_string(template).render(
        version=__version__,
        date=datetime.now(UTC).date().isoformat(),
        nodes={"smooth": SMOOTH_NODES, "rough": ROUGH_NODES},
        rows=ROWS,
        converged=study.converged,
        number=_numbers(study, tables),
        rows_within=sum(row[-1] == "yes" for row in tables["table_3"].rows),
        tables=tables,
        figures=[
            {
                "number": number,
                "caption": FIGURES[number].caption,
                "data": base64.b64encode(path.read_bytes()).decode(),
            }
            for number, path in figures.items()
        ],
        slips=[{**vars(slip), "check": slip.check(study)} for slip in SLIPS],
    )


def _column(table: PaperTable, head: str) -> list[float]:
    place = table.heads.index(head)
    return [float(row[place]) for row in table.rows]


def _range(values: list[float], digits: str) -> str:
    low, high = format(min(values), digits), format(max(values), digits)
    return low if low == high else f"{low} to {high}"


def _numbers(study: Study, tables: Mapping[str, PaperTable]) -> dict[str, str]:
    """Numbers that the text of the report quotes."""
    rough, width, constant = (tables[f"conclusion_{k}"] for k in (1, 2, 3))
    fields = {contact: s.result.summary()["field"] for contact, s in study.smooth.items()}
    centre = {
        pressure: [f["central_dimensionless"] for c, f in fields.items() if c.gigapascal == pressure]
        for pressure in (1, 2)
    }
    return {
        "largest": _range([field["max_dimensionless"] for field in fields.values()], ".4f"),
        "centre_1": _range(centre[1], ".3f"),
        "centre_2": _range(centre[2], ".3f"),
        "over_own": _range(_percent(rough, "rough: E_max h_min/V12"), ".1f"),
        "over_smooth": _range(_percent(rough, "rough E_max, smooth h_min/V12"), ".1f"),
        "width": _range(_column(width, "width [µm]"), ".1f"),
        "width_error": format(max(_column(width, "grid error [µm]")), ".2f"),
        "width_share": _range([100.0 * value for value in _column(width, "width/b")], ".1f"),
        "width_pits": _range(_column(width, "width/largest pit 4 µm"), ".1f"),
        "exponent": format(_exponent(study), ".2f"),
        "change": format(max(map(abs, _column(constant, "change of E_max [1e-6]"))), ".2g"),
        "middle_change": format(max(_column(constant, "largest change at mid-film [1e-6]")), ".2g"),
        "capacitance": _range(_column(constant, "capacitance ratio"), ".2f"),
    }


def _percent(table: PaperTable, head: str) -> list[float]:
    return [100.0 * (value - 1.0) for value in _column(table, head)]


def _exponent(study: Study) -> float:
    """Power of the minimum film that the width goes with, mean of both pressures."""
    slopes = []
    for gigapascal in (1, 2):
        results = [s.result for contact, s in study.smooth.items() if contact.gigapascal == gigapascal]
        films = np.log([result.film.minimum_thickness for result in results])
        widths = np.log([result.field.high_field_width for result in results])
        slopes.append(float(np.polyfit(films, widths, 1)[0]))
    return float(np.mean(slopes))
