"""Warnings of a contact that are known before it is solved."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.lubricant import Lubricant, law_warnings
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.errors import ResultWarning
from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas

# Hertz pressure at which bearing steel deforms permanently, of line contacts (ISO 76) [Pa].
_LINE_PERMANENT = 4e9

# A rigid film builds up over some ten sqrt(2 R h), which is this over M in half-widths.
_RIGID_INLET = 14.0

# Hertz pressure at which bearing steel deforms permanently, of point contacts (ISO 76) [Pa].
_POINT_PERMANENT = 4.2e9


def line_case_warnings(case: Case, conditions: Conditions) -> Iterator[ResultWarning]:
    """Warnings of a line contact that are known before it is solved."""
    yield from regime_warnings(conditions)
    width = (case.grid.outlet - case.grid.inlet) / (0.5 * np.pi)
    yield from pressure_warnings(case.lubricant, conditions.max_pressure, width, "line", _LINE_PERMANENT)


def regime_warnings(conditions: Conditions) -> Iterator[ResultWarning]:
    """Warning of a line contact in a regime that the film formulas were not made for."""
    regime = film_formulas.regime(conditions.formulas)
    if regime == "isoviscous-rigid":
        yield rigid_warning("half-width", "half-widths", _RIGID_INLET / conditions.formulas.moes_m)
    elif regime != "piezoviscous-elastic":
        yield ResultWarning(
            "regime", f"{regime} regime: the film formulas but Moes' are for piezoviscous-elastic contacts"
        )


def rigid_warning(length: str, lengths: str, reach: float) -> ResultWarning:
    """Warning of a film between rigid bodies, which builds up over ``reach`` of those lengths."""
    return ResultWarning(
        "regime",
        f"isoviscous-rigid regime: the bodies hardly deform, and {length} and Hertz pressure scale "
        f"nothing; the film builds up over about {reach:.2g} {lengths}, which grid.inlet must hold",
    )


def pressure_warnings(
    lubricant: Lubricant, pressure: float, domain: float, kind: str, permanent: float
) -> Iterator[ResultWarning]:
    """Warnings of a contact that follow from its Hertz pressure [Pa] and its lubricant.

    ``domain`` is the load of a unit pressure over the whole domain, in that of the dry contact at a unit
    Hertz pressure; ``permanent`` the Hertz pressure above which bearing steel deforms permanently in contacts
    of that ``kind`` [Pa].
    """
    ambient_load = lubricant.ambient_pressure / pressure * domain
    if ambient_load > 0.01:
        yield ResultWarning(
            "ambient-pressure",
            f"the ambient pressure carries {100 * ambient_load:.1f} % of the load over this domain; "
            "lubricant.ambient_pressure = 0 leaves it out",
        )
    if pressure > permanent:
        yield ResultWarning(
            "plastic-deformation",
            f"the Hertz pressure is {pressure / 1e9:.3g} GPa: bearing steel deforms "
            f"permanently above {permanent / 1e9:g} GPa in {kind} contacts, and the bodies are elastic here; "
            "are load and radii right?",
        )
    yield from law_warnings(lubricant, pressure)


def point_case_warnings(case: Case, conditions: PointConditions) -> Iterator[ResultWarning]:
    """Warnings of a point contact that are known before it is solved."""
    yield from point_regime_warnings(conditions)
    area = (case.grid.outlet - case.grid.inlet) * 2.0 * conditions.side
    domain = area / (2.0 * np.pi / 3.0)
    yield from pressure_warnings(case.lubricant, conditions.max_pressure, domain, "point", _POINT_PERMANENT)


def point_regime_warnings(conditions: PointConditions) -> Iterator[ResultWarning]:
    """Warning of a point contact in a regime that the film formulas were not made for."""
    formulas = conditions.formulas
    regime = point_formulas.regime(formulas)
    if regime == "isoviscous-rigid":
        film = point_formulas.nijenbanning_venner_moes(formulas).central_thickness
        # A rigid film builds up over some ten sqrt(2 R h).
        reach = 10.0 * float(np.sqrt(2.0 * formulas.radius_x * film)) / conditions.semi_axis_x
        yield rigid_warning("semi-axis", "semi-axes", reach)
    elif regime == "isoviscous-elastic":
        yield ResultWarning(
            "regime",
            f"{regime} regime: the film formulas but that of Nijenbanning, Venner and Moes are for "
            "piezoviscous contacts",
        )
