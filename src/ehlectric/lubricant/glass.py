"""Glass transition: the end of viscosity laws that rise without bound, and the warning about it."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.errors import ResultWarning

# Viscosity at the glass transition [Pa s], by its usual definition. An oil that is as viscous does not flow
# in the time that it spends in a contact.
GLASS_VISCOSITY = 1e12

# Largest ln(eta/eta0) of a law that does not know the viscosity eta0 at zero pressure. An oil of 1 mPa s
# reaches the glass transition at ln(1e12/1e-3) = 34.5; a thicker oil reaches it earlier.
LARGEST_EXPONENT = 35.0


def glass_warnings(law: str, max_pressure: float, cap: float, limit: str) -> Iterator[ResultWarning]:
    """Warning that the Hertz pressure of a contact exceeds the pressure at which a law is capped.

    Parameters
    ----------
    law : str
        Name of the viscosity law.
    max_pressure : float
        Hertz pressure [Pa].
    cap : float
        Pressure at which the cap of the law begins [Pa]; infinite if the law has none.
    limit : str
        Viscosity of the cap, for the text.

    Examples
    --------
    >>> [warning.code for warning in glass_warnings("yasutomi", 2e9, 1.08e9, "1e12 Pa s")]
    ['law-range']
    """
    if max_pressure > cap:
        yield ResultWarning(
            "law-range",
            f"the Hertz pressure is above {cap / 1e9:.3g} GPa, where viscosity_law {law!r} reaches {limit} "
            "and is held there: the oil is a glass, films hardly notice, tractions do",
        )
