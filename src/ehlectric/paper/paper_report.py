"""Report of the study as one HTML file: figures, tables, the three conclusions and the slips of the paper."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib import resources
from itertools import pairwise

import numpy as np
from jinja2 import Environment, StrictUndefined

from ehlectric.paper.errata import SLIPS
from ehlectric.paper.paper_contacts import CONTACTS, ROUGH_NODES, SMOOTH_NODES, of_paper
from ehlectric.paper.paper_figures import FIGURES
from ehlectric.paper.paper_tables import AMPLITUDE, BY_SMOOTH, REDUCED_STRENGTH, WITHIN, PaperTable
from ehlectric.paper.sor import ROWS
from ehlectric.paper.study import Study
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.version import __version__

# Criteria by which the three conclusions hold. Conclusion 1: in every placement of the profile, E_max differs
# from V12/h_min by at most this many per cent. Conclusion 2: the width divided by b falls with rising M at
# both pressures, and the largest is at least this many times the smallest. Conclusion 3: E_max changes by at
# most this many per cent.
LARGEST_EXCESS = 5.0
LEAST_WIDTHS = 2.0
LARGEST_CHANGE = 1.0


def html(study: Study, tables: Mapping[str, PaperTable], figures: Mapping[int, bytes]) -> str:
    """Report of a complete study as an HTML page. Returns HTML page that needs no other files."""
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    template = (resources.files("ehlectric.paper") / "report.html.jinja").read_text(encoding="utf-8")
    return environment.from_string(template).render(
        version=__version__,
        date=datetime.now(UTC).date().isoformat(),
        nodes={"smooth": SMOOTH_NODES, "rough": ROUGH_NODES},
        rows=ROWS,
        converged=study.converged,
        number=numbers(study, tables),
        verdict=verdicts(tables),
        largest_excess=LARGEST_EXCESS,
        warnings=_warnings(study),
        tables=tables,
        figures=[
            {
                "number": number,
                "caption": FIGURES[number].caption,
                "data": base64.b64encode(content).decode(),
            }
            for number, content in figures.items()
        ],
        slips=[{**vars(slip), "check": slip.check(study)} for slip in SLIPS],
    )


def verdicts(tables: Mapping[str, PaperTable]) -> dict[str, str]:
    """Verdicts on Table 3 and on the three conclusions of the paper, by their criteria. Returns "table_3" has
    a text with the number of rows that agree; "conclusion_1" to "conclusion_3" are "holds" or "does not
    hold".
    """
    printed, rough, width, constant = (
        tables[name] for name in ("table_3", "conclusion_1", "conclusion_2", "conclusion_3")
    )
    excess = max(
        abs(v)
        for head in (REDUCED_STRENGTH, "shifted, minimum", "shifted, maximum")
        for v in _percent(rough, head)
    )
    shares = _column(width, "width/b")
    narrower = all(later < earlier for part in (shares[:4], shares[4:]) for earlier, later in pairwise(part))
    changes = [abs(value) / 1e4 for value in _column(constant, "change of E_max [1e-6]")]
    within = [row[printed.heads.index(WITHIN)] for row in printed.rows]
    return {
        "table_3": f"{within.count('yes')} of {len(within)} rows {WITHIN} and the rounding of the print",
        "conclusion_1": _word(excess <= LARGEST_EXCESS),
        "conclusion_2": _word(narrower and max(shares) >= LEAST_WIDTHS * min(shares)),
        "conclusion_3": _word(max(changes) <= LARGEST_CHANGE),
    }


def _word(holds: bool) -> str:  # noqa: FBT001
    """Verdict as text."""
    return "holds" if holds else "does not hold"


def numbers(study: Study, tables: Mapping[str, PaperTable]) -> dict[str, str]:
    """Numbers quoted in the text of the report, formatted, by their names in the template."""
    rough, width, constant = (tables[f"conclusion_{k}"] for k in (1, 2, 3))
    fields = {contact: result.summary()["field"] for contact, result in study.smooth.items()}
    centre = {
        pressure: [f["central_dimensionless"] for c, f in fields.items() if c.gigapascal == pressure]
        for pressure in (1, 2)
    }
    films = list(zip(_column(rough, "h_min smooth [µm]"), _column(rough, "h_min rough [µm]"), strict=True))
    exponents, scatter = _width_law(study)
    steps = next(iter(study.rough.values())).rough[0]["steps"]
    widths, shares = _column(width, "width [µm]"), _column(width, "width/b")
    mean_pits = _column(width, "width/mean pit 1.7 µm")
    return {
        "fine_2": format(1e6 * study.fine[CONTACTS[6]].film.minimum_thickness, ".3f"),
        "fine_1": format(1e6 * study.fine[CONTACTS[7]].film.minimum_thickness, ".3f"),
        "largest": _range([field["max_dimensionless"] for field in fields.values()], ".4f"),
        "centre_1": _range(centre[1], ".3f"),
        "centre_2": _range(centre[2], ".3f"),
        "own": _range(_percent(rough, REDUCED_STRENGTH), ".1f"),
        "own_moved": _range(_percent(rough, "shifted, minimum") + _percent(rough, "shifted, maximum"), ".1f"),
        "grid": format(
            100.0
            * max(
                abs(a / b - 1.0)
                for a, b in zip(
                    _column(rough, "on half of the nodes"), _column(rough, REDUCED_STRENGTH), strict=True
                )
            ),
            ".1f",
        ),
        "by_smooth": _range(_percent(rough, BY_SMOOTH), ".1f"),
        "by_smooth_moved": _range(
            _percent(rough, "the same shifted, minimum") + _percent(rough, "the same shifted, maximum"), ".1f"
        ),
        "lowered": str(sum(b < a for a, b in films)),
        "amplitude_1": _range(_column(rough, AMPLITUDE)[:4], ".2f"),
        "amplitude_2": _range(_column(rough, AMPLITUDE)[4:], ".2f"),
        "rq_before": format(1e9 * steps[-2]["rq"], ".1f"),
        "rq_after": format(1e9 * steps[-1]["rq"], ".1f"),
        "width": _range(widths, ".1f"),
        "width_error": format(max(_column(width, "grid error [µm]")), ".2f"),
        "width_share": _range([100.0 * value for value in shares], ".1f"),
        "width_pits": _range(_column(width, "width/largest pit 4 µm"), ".1f"),
        "width_mean_pits": _range(mean_pits, ".1f"),
        "nearer": str(sum(pits < 1.0 / share for pits, share in zip(mean_pits, shares, strict=True))),
        "width_m": format(exponents[0], ".2f"),
        "width_l": format(exponents[1], ".2f"),
        "width_scatter": format(100.0 * scatter, ".1f"),
        "change": format(max(map(abs, _column(constant, "change of E_max [1e-6]"))), ".2g"),
        "middle_change": format(max(_column(constant, "largest change at mid-film [1e-6]")), ".2g"),
        "capacitance": _range(_column(constant, "capacitance ratio"), ".2f"),
    }


def _column(table: PaperTable, head: str) -> list[float]:
    place = table.heads.index(head)
    return [float(row[place]) for row in table.rows]


def _percent(table: PaperTable, head: str) -> list[float]:
    """Relative excess over 1 of the numbers of a column [%]."""
    return [100.0 * (value - 1.0) for value in _column(table, head)]


def _range(values: list[float], digits: str) -> str:
    """Text of the range of values, a single number if both ends are the same in these digits."""
    low, high = format(min(values), digits), format(max(values), digits)
    return low if low == high else f"{low} to {high}"


def _width_law(study: Study) -> tuple[tuple[float, float], float]:
    """Exponents of M and L in a power law fitted to width/b, and the largest relative deviation."""
    results = list(study.smooth.values())
    groups = [of_paper(result) for result in results]
    logs = np.column_stack([np.ones(len(groups)), np.log(np.array([[g.moes_m, g.moes_l] for g in groups]))])
    shares = np.log([r.field.high_field_width / r.conditions.half_width for r in results])
    law, *_ = np.linalg.lstsq(logs, shares, rcond=None)
    return (float(law[1]), float(law[2])), float(np.max(np.abs(np.expm1(shares - logs @ law))))


def _warnings(study: Study) -> list[str]:
    """Warnings of the results, each text once, after the names of the contacts that have it."""
    contacts: dict[ResultWarning, list[str]] = {}
    for part, kind in ((study.smooth, "smooth"), (study.rough, "rough")):
        for contact, result in part.items():
            for warning in result.warnings:
                contacts.setdefault(warning, []).append(f"{contact.name} {kind}")
    return [f"{'; '.join(names)}: {warning}" for warning, names in contacts.items()]
