"""Warnings about the operating conditions of a contact, known before it is solved."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases import library
from ehlectric.cases.case import Case
from ehlectric.cases.doubts import modulus_doubt, radius_doubt
from ehlectric.cases.films.physics import CONSTANTS
from ehlectric.cases.oils.resolution import viscosity_over_temperature
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas
from ehlectric.lubricant.oil import Oil

# Hertz pressure at which bearing steel deforms permanently in line contacts (ISO 76) [Pa].
LINE_PERMANENT = 4e9

# The film between rigid bodies builds up over a length of about 10 sqrt(2 R h). In half-widths of a line
# contact, this length is the following number divided by Moes' M.
_RIGID_INLET = 14.0

# Hertz pressure at which bearing steel deforms permanently in point contacts (ISO 76) [Pa].
POINT_PERMANENT = 4.2e9


def line_case_warnings(setup: Case | Setup, conditions: Conditions) -> Iterator[ResultWarning]:
    """Warnings about the operating conditions of a line contact, known before it is solved."""
    yield from unit_warnings("reduced_radius", conditions.reduced_radius, conditions.reduced_modulus)
    yield from temperature_warnings(setup)
    yield from rheology_warnings(setup)
    yield from regime_warnings(conditions)
    width = setup.grid.length / (0.5 * np.pi)
    yield from pressure_warnings(setup.oil, conditions.max_pressure, width, "line", LINE_PERMANENT)
    yield from hardness_warnings(conditions)


def temperature_warnings(setup: Case | Setup) -> Iterator[ResultWarning]:
    """Note about a temperature of the contact on which the oil of its case does not depend."""
    if not isinstance(setup, Case) or setup.contact.temperature is None:
        return
    if viscosity_over_temperature(setup.lubricant) is None:
        celsius = f"{setup.contact.temperature - 273.15:.4g} °C"
        yield ResultWarning(
            "temperature-unused",
            f"the viscosity of {1e3 * setup.oil.viscosity:.4g} mPa s is a given one, and contact.temperature "
            f"does not change it: it must be that at {celsius}; give [lubricant.temperature] or "
            "lubricant.atmospheric_law for a viscosity that follows the temperature",
        )


def rheology_warnings(setup: Case | Setup) -> Iterator[ResultWarning]:
    """Note about constants of another law between shear stress and shear rate than that of the film.

    Constants of the library's oil are no choice of the case, and a Newtonian film may stand for comparison.
    """
    if not isinstance(setup, Case) or setup.film is None or setup.film.rheology == "newtonian":
        return
    oil, rheology = setup.lubricant, setup.film.rheology
    base = library.tables("lubricant", oil.base)["lubricant"] if oil.base else {}
    for other, keys in CONSTANTS.items():
        given = [key for key in keys if getattr(oil, key) is not None and key not in base]
        if other != rheology and given:
            names = " and ".join(f"lubricant.{key}" for key in given)
            yield ResultWarning(
                "shear-constant-unused",
                f"{names} {'are' if len(given) > 1 else 'is'} not used: film.rheology is {rheology!r}, not "
                f"{other!r}; change it or leave them out",
            )


def hardness_warnings(conditions: Conditions | PointConditions) -> Iterator[ResultWarning]:
    """Warning about a hardness below the Hertz pressure: bodies would yield, not only asperities."""
    hardness, pressure = conditions.hardness, conditions.max_pressure
    if hardness is not None and hardness < pressure:
        yield ResultWarning(
            "hardness-low",
            f"contact.hardness is {hardness / 1e9:.3g} GPa, below the Hertz pressure of "
            f"{pressure / 1e9:.3g} GPa: smooth surfaces alone would yield where they touch, and the film "
            "will probably not converge; hardened bearing steel has about 7 GPa",
        )


def unit_warnings(key: str, radius: float, modulus: float) -> Iterator[ResultWarning]:
    """Warnings about a reduced radius [m], with its key, or modulus [Pa] that no machine part has."""
    yield from (ResultWarning("radius-large", text) for text in radius_doubt(key, radius))
    yield from (ResultWarning("modulus-low", text) for text in modulus_doubt(modulus))


def regime_warnings(conditions: Conditions) -> Iterator[ResultWarning]:
    """Warning about a line contact in a regime for which the film formulas were not made."""
    regime = film_formulas.regime(conditions.contact)
    if regime == "isoviscous-rigid":
        yield rigid_warning("half-width", "half-widths", _RIGID_INLET / conditions.contact.moes_m)
    elif regime != "piezoviscous-elastic":
        yield ResultWarning(
            "regime",
            f"the contact is in the {regime} regime, outside the range of all film formulas but that of "
            "Moes; use the solved film",
        )


def rigid_warning(length: str, lengths: str, reach: float) -> ResultWarning:
    """Warning about a contact in the isoviscous-rigid regime.

    The film builds up over ``reach`` half-widths or semi-axes; ``length`` and ``lengths`` are the name of
    this unit in singular and plural.
    """
    return ResultWarning(
        "regime",
        f"the contact is in the isoviscous-rigid regime: the bodies hardly deform, and {length} and Hertz "
        f"pressure are not meaningful scales; the film builds up over about {reach:.2g} {lengths}: "
        f"where grid.inlet is given it should be at most {-reach:.2g}",
    )


def pressure_warnings(
    oil: Oil, pressure: float, domain: float, kind: str, permanent: float
) -> Iterator[ResultWarning]:
    """Warnings that follow from the Hertz pressure of a contact and from its oil.

    ``pressure`` is the Hertz pressure [Pa]. ``domain`` is the load that the Hertz pressure would
    carry if it acted on the whole domain, divided by the load of the contact. ``permanent`` is the Hertz
    pressure above which bearing steel deforms permanently in contacts of this ``kind`` [Pa].
    """
    ambient_load = oil.ambient_pressure / pressure * domain
    if ambient_load > 0.01:
        yield ResultWarning(
            "ambient-pressure",
            f"the ambient pressure carries {100 * ambient_load:.1f} % of the load on this domain; set "
            "lubricant.ambient_pressure to 0 to leave it out",
        )
    if pressure > permanent:
        yield ResultWarning(
            "plastic-deformation",
            f"the Hertz pressure is {pressure / 1e9:.3g} GPa, but bearing steel deforms permanently above "
            f"{permanent / 1e9:g} GPa in {kind} contacts, and the model is elastic; check load and radii",
        )
    yield from oil.warnings(pressure)


def point_case_warnings(setup: Case | Setup, conditions: PointConditions) -> Iterator[ResultWarning]:
    """Warnings about the operating conditions of a point contact, known before it is solved."""
    yield from unit_warnings("radius_x", conditions.radius_x, conditions.reduced_modulus)
    yield from temperature_warnings(setup)
    yield from rheology_warnings(setup)
    yield from point_regime_warnings(conditions)
    area = setup.grid.length * 2.0 * conditions.side
    domain = area / (2.0 * np.pi / 3.0)
    yield from pressure_warnings(setup.oil, conditions.max_pressure, domain, "point", POINT_PERMANENT)
    yield from hardness_warnings(conditions)


def point_regime_warnings(conditions: PointConditions) -> Iterator[ResultWarning]:
    """Warning about a point contact in a regime for which the film formulas were not made."""
    contact = conditions.contact
    regime = point_formulas.regime(contact)
    if regime == "isoviscous-rigid":
        film = point_formulas.nijenbanning_venner_moes(contact).central_thickness
        # The film between rigid bodies builds up over about 10 sqrt(2 R h).
        reach = 10.0 * float(np.sqrt(2.0 * contact.radius_x * film)) / conditions.semi_axis_x
        yield rigid_warning("semi-axis", "semi-axes", reach)
    elif regime == "isoviscous-elastic":
        yield ResultWarning(
            "regime",
            f"the contact is in the {regime} regime, outside the range of all film formulas but that of "
            "Nijenbanning, Venner and Moes; use the solved film",
        )
