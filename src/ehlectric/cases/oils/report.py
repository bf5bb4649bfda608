"""Report on an oil: its properties at temperatures and pressures, what is missing, and warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ehlectric.cases.amounts import Amount
from ehlectric.cases.library.sources import Source
from ehlectric.cases.oils.known import KnownOil, known_oil
from ehlectric.cases.oils.named import NamedOil, kelvin_of, named_oil
from ehlectric.cases.oils.resolution import CELSIUS
from ehlectric.cases.oils.survey import (
    PROPERTIES,
    SurveyLine,
    depends_on_temperature,
    survey,
    usual_temperatures,
)
from ehlectric.errors import InputError, ResultWarning

PRESSURE = Amount("Pa", least=0.0, most=2e10, reason="in the oil; contacts of steel reach 4 GPa")


@dataclass(frozen=True, eq=False)
class OilReport:
    """Properties of an oil at temperatures and pressures.

    Attributes
    ----------
    named : NamedOil
        Oil with the sources of its values.
    oils : tuple of KnownOil
        The oil at each temperature.
    pressures : tuple of float
        Pressures beside ambient pressure [Pa].
    lines : tuple of SurveyLine
        Every property at every pressure, with the values at all temperatures.
    warnings : tuple of ResultWarning or str
        Warnings about laws and estimates, with the temperature at which they hold.
    """

    named: NamedOil
    oils: tuple[KnownOil, ...]
    pressures: tuple[float, ...]
    lines: tuple[SurveyLine, ...]
    warnings: tuple[ResultWarning | str, ...]

    @property
    def temperatures(self) -> tuple[float | None, ...]:
        """Temperatures [K]; None for values that hold at the temperature of a contact."""
        return tuple(oil.temperature for oil in self.oils)

    @property
    def sources(self) -> tuple[Source, ...]:
        """Sources behind all lines, each once, in the order of the lines."""
        return tuple(dict.fromkeys(source for line in self.lines for source in line.sources))

    @property
    def missing(self) -> tuple[str, ...]:
        """Lines that say which keys are missing, and for what."""
        return tuple(dict.fromkeys(str(error) for oil in self.oils for error in oil.missing.values()))

    def beyond(self, line: SurveyLine, oil: KnownOil) -> bool:
        """Whether a line lies beyond the range of its law, at the temperature of an oil."""
        return line.pressure > 0.0 and line.pressure > line.of.range_end(oil)

    def summary(self) -> dict[str, Any]:
        """Content of the report as nested tables and lists, SI units, for JSON."""
        number = {source: k for k, source in enumerate(self.sources)}
        return {
            "name": self.named.name,
            "title": self.named.title,
            "temperature_range": self.named.table.temperature_range,
            "temperatures": self.temperatures,
            "properties": [
                {
                    "name": line.of.name,
                    "unit": line.of.unit,
                    "pressure": line.pressure,
                    "values": line.values,
                    "beyond_range": [self.beyond(line, oil) for oil in self.oils],
                    "law": line.law,
                    "kind": line.kind,
                    "sources": [number[source] for source in line.sources],
                }
                for line in self.lines
            ],
            "sources": [
                {"kind": s.kind, "citation": s.citation, "doi": s.doi, "note": s.note} for s in self.sources
            ],
            "missing": self.missing,
            "needs": self.named.needs,
            "warnings": [{"code": getattr(one, "code", None), "text": str(one)} for one in self.warnings],
        }


def oil_report(
    source: str | Path | Mapping[str, Any],
    temperatures: Sequence[str | float] = (),
    pressures: Sequence[str | float] = (),
) -> OilReport:
    """Report on an oil of the library, of a file or of a table.

    Parameters
    ----------
    source : str, Path or mapping
        Name of the library, file with a table ``[lubricant]``, or such a table.
    temperatures : sequence of str or float, optional
        Temperatures with their units, or in kelvin; by default those of ``usual_temperatures``.
    pressures : sequence of str or float, optional
        Pressures with their units, or in pascal, beside ambient pressure.

    Returns
    -------
    OilReport
        Every property of the oil; those of which a value is missing are marked.

    Raises
    ------
    InputError
        If there is no such oil, or a temperature is outside the range of the oil.

    Examples
    --------
    >>> report = oil_report("fva-3", ["40 degC"], ["1 GPa"])
    >>> line = report.lines[0]
    >>> line.of.name, round(line.values[0], 4), line.law, line.kind
    ('viscosity', 0.0845, 'vogel', 'fitted')
    """
    named = named_oil(source)
    kelvins = [kelvin_of(one, "--temperature") for one in temperatures]
    pascals = sorted({_pascal(one) for one in pressures} - {0.0})
    if kelvins:
        oils = tuple(known_oil(named.table, kelvin, "--temperature") for kelvin in kelvins)
    else:
        oils = tuple(_usual(named))
    lines = tuple(survey(named, oils, pascals))
    return OilReport(named, oils, tuple(pascals), lines, tuple(_warnings(oils, max(pascals, default=0.0))))


def _usual(named: NamedOil) -> Iterator[KnownOil]:
    """Oil at those of its usual temperatures at which all its laws have a value."""
    refused: list[InputError] = []
    kelvins = usual_temperatures(named)
    for kelvin in kelvins:
        try:
            yield known_oil(named.table, kelvin, "--temperature")
        except InputError as error:
            refused.append(error)
    if len(refused) == len(kelvins):
        raise refused[0]


def celsius(temperature: float | None) -> str:
    """Temperature [K] as text in degrees Celsius; empty without one.

    Examples
    --------
    >>> celsius(313.15)
    '40 °C'
    """
    return "" if temperature is None else f"{round(temperature - CELSIUS, 6):g} °C"


def _pascal(pressure: str | float) -> float:
    try:
        return PRESSURE.parse(pressure)
    except InputError as error:
        raise error.retold("--pressure", error.text) from None


def _warnings(oils: Sequence[KnownOil], pressure: float) -> Iterator[ResultWarning | str]:
    """Warnings of the oil at its temperatures: ends of ranges of all, and each other warning once."""
    told: set[str] = set()
    for oil in oils:
        at = "" if oil.temperature is None else f"at {celsius(oil.temperature)}, "
        for warning in oil.warnings(pressure):
            if warning.code == "law-range" or warning.code not in told:
                told.add(warning.code)
                # The laws warn of the Hertz pressure of a contact. Here is none, but a pressure in the oil.
                text = warning.text.replace("the Hertz pressure", "the pressure")
                yield replace(warning, text=at + text.removesuffix(" in this contact"))
        try:
            PROPERTIES["relative_permittivity"].value(oil, pressure)
        except InputError as error:
            yield f"{at}{error}"
    if not depends_on_temperature(oils[0].table) and oils[0].temperature is not None:
        yield "the viscosity of this oil is one number: it is shown as it is given, whatever the temperature"
