"""Table ``discharge`` of a bearing file."""

from __future__ import annotations

from ehlectric.cases.discharge import Discharge
from ehlectric.errors import InputError

# Inputs of a discharge that a bearing reads itself, and not at the temperature of its films.
_OF_WHOLE_BEARING = {"external_capacitance", "peak_current", "pit"}


class BearingDischarge(Discharge):
    """Discharge of a bearing; a strength table over temperature is read at the bearing's temperature."""

    def _check_pit(self) -> None:
        """Accept a pit without an external capacitance: a motor may give what is connected to the shaft."""

    def _check_temperature(self) -> None:
        if self.temperature is not None:
            raise InputError(
                "temperature",
                got=f"{self.temperature:g} K for a bearing",
                takes="bearing.temperature in its place, at which the strength is taken",
            )

    def at(self, temperature: float, key: str = "bearing.temperature") -> Discharge:
        """Return the inputs of the discharge at a temperature.

        Parameters
        ----------
        temperature : float
            Absolute temperature [K].
        key : str, optional
            Key of the temperature, for messages.

        Returns
        -------
        Discharge
            Inputs of the discharge, with this temperature for a strength table over temperature.

        Raises
        ------
        InputError
            If the temperature is outside a strength table over temperature.

        Examples
        --------
        >>> table = {"temperature": ["20 degC", "120 degC"], "strength": ["20 V/um", "10 V/um"]}
        >>> BearingDischarge.from_dict({"strength_table": table}).at(343.15).temperature
        343.15
        """
        table = self.model_dump(exclude_none=True, exclude=_OF_WHOLE_BEARING)
        if self.strength_table is not None and self.strength_table.over == "temperature":
            table["temperature"] = temperature
        try:
            return Discharge.from_dict(table)
        except InputError as error:
            whole = key if error.key == "temperature" else f"bearing.{error.key}"
            raise error.retold(whole, error.text) from None
