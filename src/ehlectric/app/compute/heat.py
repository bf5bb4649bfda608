"""Numbers of the heat and the shear in the film of a contact."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.app.answers.contact import Number
from ehlectric.app.compute.numbers import number_of, short_text
from ehlectric.contact.results import PointResult, Result


def heat_numbers(result: Result | PointResult) -> Iterator[Number]:
    """Numbers of the heat and the shear in a film; none of an isothermal Newtonian one.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.

    Yields
    ------
    Number
        Temperature rise, and traction coefficient and power loss of a film that converged.
    """
    heated = result.film.heated
    if heated is None:
        return
    beside, simple = "the isothermal film did not converge", heated.isothermal_minimum_thickness
    if simple is not None:
        change = 100.0 * (result.film.minimum_thickness / simple - 1.0)
        beside = f"minimum film {change:+.2g} % against isothermal and Newtonian".replace("-", "−")
    if heated.max_temperature_rise is not None:
        error = heated.temperature_rise_error
        note = beside if error is None else f"error {short_text(error, 1)} K; {beside}"
        rise = short_text(heated.max_temperature_rise, 3)
        yield Number("temperature-rise", "Temperature rise at mid-film", rise, "K", note)
        beside = ""
    if heated.traction_coefficient is None or heated.power_loss is None:
        return
    traction = f"{heated.traction_coefficient:.3g}".replace("-", "−")
    yield Number("traction", "Traction coefficient", traction, note=beside)
    unit = "W/m" if isinstance(result, Result) else "W"
    yield number_of("power-loss", "Power loss", heated.power_loss, unit, "by sliding and rolling")


def bound_of(result: Result | PointResult) -> str:
    """Note of a breakdown voltage that is an upper bound: the film that the contact may have at most."""
    return "fully flooded film" if result.film.temperature is not None else "isothermal, fully flooded film"
