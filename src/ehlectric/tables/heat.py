"""Rows of the heat and the shear in the film of a contact."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.case import Case
from ehlectric.cases.input_keys import unit_of
from ehlectric.contact.results import PointResult, Result
from ehlectric.film.thermal.result import HeatedFilm
from ehlectric.quantities.rows import Row, amount, amount_row

# Names of the laws between shear stress and shear rate.
RHEOLOGIES = {
    "newtonian": "Newtonian",
    "eyring": "Ree-Eyring",
    "carreau": "Carreau",
    "limiting": "limiting shear stress",
}


def heat_rows(result: Result | PointResult) -> Iterator[Row]:
    """Rows of the heat and the shear in a solved film; none of an isothermal Newtonian one."""
    heated, film = result.film.heated, result.film
    if heated is None:
        return
    yield Row("heat and shear in the film")
    yield Row("rheology", RHEOLOGIES[heated.rheology], note=_constants(result.case))
    yield Row("temperature", "computed" if heated.thermal else "that of the inlet", note=_inlet(result.case))
    effect = "heat and shear" if heated.thermal else "shear"
    for name in ("minimum", "central"):
        simple, now = getattr(heated, f"isothermal_{name}_thickness"), getattr(film, f"{name}_thickness")
        label = f"{name} film, isothermal and Newtonian"
        if simple is None:
            yield Row(label, "not converged")
            continue
        note = f", {100.0 * (now / simple - 1.0):+.2g} % by {effect}" if result.converged else ""
        yield Row(label, simple, "µm", note)
    yield from _temperatures(heated)
    if heated.traction_coefficient is None or heated.power_loss is None:
        yield Row("friction", "not converged")
        return
    yield Row("traction coefficient", heated.traction_coefficient, digits=".3g")
    rolling = heated.rolling_coefficient
    yield Row("coefficient of rolling friction", rolling, note=", of each surface", digits=".2g")
    yield amount_row("power loss", heated.power_loss, "W/m" if isinstance(result, Result) else "W")


def _constants(case: object) -> str:
    """Note with the constants of the rheology of a case."""
    if not isinstance(case, Case) or case.film is None:
        return ""
    given = case.film.constants(case.lubricant).items()
    texts = (f"{key} {amount(value, unit_of(f'lubricant.{key}'))}".rstrip() for key, value in given)
    return "".join(f", {text}" for text in texts)


def _inlet(case: object) -> str:
    """Note with the temperatures of the oil in the inlet and of the bodies."""
    if not isinstance(case, Case) or case.contact.temperature is None:
        return ""
    contact = case.contact
    found = {"oil": contact.temperature, "body 1": contact.temperature_1, "body 2": contact.temperature_2}
    known = {name: value for name, value in found.items() if value is not None}
    return "".join(f", {name} at {value - 273.15:.4g} °C" for name, value in known.items())


def _temperatures(heated: HeatedFilm) -> Iterator[Row]:
    """Rows of the temperatures in a thermal film."""
    rise, surfaces = heated.max_temperature_rise, heated.surface_temperatures
    if rise is None or surfaces is None:
        return
    error = heated.temperature_rise_error
    note = "" if error is None else f", error {error:.1g} K"
    yield Row("largest temperature rise at mid-film", f"{rise:.4g}", "K", note)
    for number, surface in enumerate(surfaces, 1):
        yield Row(f"highest temperature of surface {number}", f"{surface.max() - 273.15:.4g}", "°C")
