"""Field strengths that no film carries, and warnings of fields and strengths above them."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.discharge import Discharge
from ehlectric.errors import ResultWarning

# Field strength that no film of a liquid between rough metals carries [V/m]. By Fowler and Nordheim's law of
# field emission, in the form of Proc. R. Soc. A 124 (1929) 699, a metal with a work function of 4.5 eV emits
# 0.003 A/mm^2 at 3000 V/um, and 40 A/mm^2 at 5000 V/um. Asperities raise a field at least threefold.
MOST_OF_LIQUIDS = 1e9


def field_warnings(max_strength: float | None, check: str) -> Iterator[ResultWarning]:
    """Warning of a maximum field strength that no film of a liquid carries.

    Parameters
    ----------
    max_strength : float or None
        Maximum field strength at the applied voltage [V/m]; None where there is none.
    check : str
        Inputs to check, which give this voltage.
    """
    if max_strength is not None and max_strength > MOST_OF_LIQUIDS:
        yield ResultWarning(
            "field-above-insulators",
            f"the maximum field is {max_strength / 1e6:.3g} V/µm, but no insulator withstands more than "
            f"about {MOST_OF_LIQUIDS / 1e6:g} V/µm, above which metals emit electrons: the film breaks down "
            f"at a lower voltage; check {check}",
        )


def strength_warnings(discharge: Discharge | None) -> Iterator[ResultWarning]:
    """Warning of a dielectric strength above the field that any film of a liquid carries."""
    if discharge is None:
        return
    table, law = discharge.strength_table, discharge.weibull
    strengths = [discharge.dielectric_strength, None if law is None else law.scale]
    most = max([value for value in strengths if value is not None], default=0.0)
    if table is not None:
        most = max(table.strength)
    if most > MOST_OF_LIQUIDS:
        yield ResultWarning(
            "strength-above-liquids",
            f"the dielectric strength is {most / 1e6:.3g} V/µm, but no film of a liquid carries more than "
            f"about {MOST_OF_LIQUIDS / 1e6:g} V/µm, above which metals emit electrons: breakdown voltages "
            "are far too high; check the unit of the strength",
        )
