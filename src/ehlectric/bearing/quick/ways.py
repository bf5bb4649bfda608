"""Quick ways to the contacts of a bearing: which case has them, and what they cannot compute."""

from __future__ import annotations

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.ways import OF_CONTACTS, QUICK, quick_way
from ehlectric.cases.discharge import Discharge
from ehlectric.errors import InputError
from ehlectric.lubricant.oil import Oil


def is_quick(case: object) -> bool:
    """Whether a case is a bearing whose contacts are not solved."""
    return isinstance(case, BearingCase) and case.contacts in QUICK


def check_quick(contacts: str, discharge: Discharge, oil: Oil) -> None:
    """Refuse an oil or a dielectric strength for which contacts that are not solved have no result.

    Parameters
    ----------
    contacts : str
        "atlas" or "formula".
    discharge : Discharge
        Dielectric strength at the temperature of the bearing.
    oil : Oil
        Oil at this temperature.

    Raises
    ------
    InputError
        For a Weibull law and for a strength over pressure, which need the field in the whole film; for a
        viscosity that does not grow with pressure.
    """
    name = OF_CONTACTS[contacts]
    if oil.alpha == 0.0:
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{oil.laws['viscosity']!r} with {name}, which are for piezoviscous oils;",
            takes="another law, or solved contacts",
        )
    table = discharge.strength_table
    if discharge.weibull is not None or (table is not None and table.over == "pressure"):
        key = "weibull" if discharge.weibull is not None else "strength_table"
        raise InputError(
            f"discharge.{key}",
            got=f"a strength that needs the field, with {name}, which have none",
            takes="dielectric_strength, a table over temperature, or solved contacts",
        )


def heat_by_formula(case: BearingCase) -> BearingCase:
    """Case whose heat in the films is that of "inlet-shear" where it would be solved, which takes seconds."""
    solved = case.bearing.film_factor == "solved"
    return case.replace({"bearing.film_factor": "inlet-shear"}) if solved else case


def quick_case(case: BearingCase, *, constant: bool = False) -> tuple[BearingCase | None, InputError | None]:
    """Case of a bearing with contacts that are not solved, and what cannot be computed without that.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing. With contacts by formula it keeps them; others are from the atlas.
    constant : bool
        Whether a constant strength takes the place of one that needs the field: the scale of a Weibull law,
        or the first strength of a table over pressure. It cancels in ratios of voltages.

    Returns
    -------
    case : BearingCase or None
        Case with contacts from the atlas or by formula, and with the heat of its films by formula where it
        is solved; without a dielectric strength where it needs the field, unless ``constant``. None for an
        oil that neither describes.
    refused : InputError or None
        Key that cannot be used, and why.
    """
    contacts = quick_way(case.contacts)
    changed = heat_by_formula(case).replace({"contacts": contacts})
    discharge, bearing = case.discharge, case.bearing
    try:
        oil = case.lubricant.at(bearing.oil_temperature, bearing.temperature_key())
        check_quick(contacts, discharge, oil)
    except InputError as error:
        if not (error.key or "").startswith("discharge"):
            return None, error
        strength = None
        if constant and discharge.weibull is not None:
            strength = discharge.weibull.scale
        elif constant and discharge.strength_table is not None:
            strength = discharge.strength_table.strength[0]
        update = {"weibull": None, "strength_table": None, "dielectric_strength": strength}
        return changed.model_copy(update={"discharge": discharge.model_copy(update=update)}), error
    return changed, None
