"""Table ``lubricant`` of a case: properties of an oil and its laws, over pressure and temperature."""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from ehlectric.cases.oils.checks import refuse_missing
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.oils.resolution import oil_at
from ehlectric.errors import InputError
from ehlectric.lubricant.oil import Oil


class Lubricant(Properties):
    """Properties of a lubricant, and its laws over pressure and temperature.

    Examples
    --------
    >>> oil = Lubricant.from_dict({"base": "paper", "viscosity_law": "barus"})
    >>> oil.parameter("pressure_viscosity_coefficient")
    2.2e-08
    """

    @model_validator(mode="after")
    def _check(self) -> Self:
        """Check that values are given in one way, and that no parameter of a law is missing."""
        refuse_missing(self)
        if self.relative_permittivity is not None and self.permittivity_table is not None:
            raise InputError(
                "relative_permittivity",
                got="it and permittivity_table together",
                takes="either relative_permittivity or permittivity_table",
            )
        ends = self.temperature_range
        if ends is not None and not (len(ends) == 2 and ends[0] < ends[1]):
            raise InputError(
                "temperature_range", got=list(ends), takes="the lowest and the highest temperature"
            )
        return self

    def at(self, temperature: float | None, key: str = "contact.temperature") -> Oil:
        """Return the oil at a temperature.

        Parameters
        ----------
        temperature : float or None
            Absolute temperature [K]. Without one, the values of the table are those at the temperature of
            the contact.
        key : str, optional
            Key of the temperature, for messages.

        Returns
        -------
        Oil
            Numbers and laws of the oil at this temperature.

        Raises
        ------
        InputError
            If the oil needs a temperature and gets none, or has no value at this temperature.

        Examples
        --------
        >>> table = {"kinematic_viscosity_40": "46 mm^2/s", "kinematic_viscosity_100": "6.8 mm^2/s"}
        >>> table |= {"density_15": "870 kg/m^3"}
        >>> oil = Lubricant.from_dict({"base": "paper", "temperature": table}).at(343.15)
        >>> round(oil.viscosity * 1e3, 2), round(oil.alpha * 1e9, 1)
        (12.46, 17.9)
        """
        latest = _latest[-1] if _latest else None
        if latest is None or latest[0] is not self or latest[1] != temperature:
            # Tables are frozen, so that the oil of the same table at the same temperature is the same.
            latest = (self, temperature, oil_at(self, temperature, key))
            _latest[:] = [latest]
        return latest[2]


# Oil that was made last, with its table and its temperature; a solution asks for its oil many times.
_latest: list[tuple[Lubricant, float | None, Oil]] = []
