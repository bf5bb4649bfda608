"""Rows of the table of a contact whose surfaces touch: its spots, what they carry and conduct."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.spots.asperities import Asperities
from ehlectric.contact.spots.warnings import share_text
from ehlectric.quantities.rows import Row

# Error of the oil balance below which it is not stated.
_LEAST_ERROR = 1e-4


def asperity_rows(result: Result | PointResult) -> list[Row]:
    """Rows of the asperities of a contact; none where the surfaces do not touch.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.

    Returns
    -------
    list of Row
        Values in SI units.
    """
    found = result.spots
    if found is None:
        return []
    line = isinstance(result, Result)
    return [Row("asperities that touch"), *_mechanics(found, line=line), *_electrical(found, line=line)]


def _mechanics(found: Asperities, *, line: bool) -> Iterator[Row]:
    touching, coarser = found.touching, found.coarser
    before = None if coarser is None else coarser.load_share
    unresolved = ", not known on a coarser grid"
    if before is not None:
        unresolved = f", {share_text(before, touching.load_share)} % on half the nodes"
    yield Row("load share of the asperities", share_text(touching.load_share, before), "%", unresolved)
    error = touching.contact_area_error
    assert error is not None
    within = f", ± {min(100.0 * error, 100.0):.0f} % of it by the grid"
    of = ", of the Hertz width" if line else ", of the Hertz area"
    unit, what = ("µm", "width of a spot") if line else ("µm²", "area of a spot")
    yield Row("real contact", touching.contact_area_share, "%", of + within, digits=".2g")
    single = touching.spots_of_one_node
    alone = f", {single} of a single node" if single else ""
    strips = ", strips along the contact" if line else ""
    yield Row("spots", str(touching.spots), note=strips + alone)
    yield Row(f"mean {what}", touching.mean_spot, unit, digits=".2g")
    yield Row(f"largest {what}", touching.largest_spot, unit, digits=".2g")
    if found.balance is not None:
        error = found.balance.mass_error
        value = error if error >= _LEAST_ERROR else f"< {100.0 * _LEAST_ERROR:g}"
        yield Row("error of the oil balance", value, "%", ", of the mean flow", digits=".2g")
    yield Row(
        "boundary film", touching.boundary_film, "nm", ", gap at which the surfaces touch", digits=".3g"
    )
    if touching.mean_film is None or touching.film_5 is None:
        return
    yield Row("mean film outside of the spots", touching.mean_film, "nm", ", in the Hertz zone", digits=".3g")
    yield Row(
        "film outside of the spots", touching.film_5, "nm", ", 5 % of the Hertz zone is thinner", digits=".2g"
    )
    if touching.rq_deformed is not None:
        yield Row("combined Rq, deformed", touching.rq_deformed, "nm", ", in the Hertz zone", digits=".3g")
    for name, ratio in (("", touching.lambda_undeformed), (", deformed", touching.lambda_deformed)):
        if ratio is not None:
            yield Row(f"mean film / combined Rq{name}", ratio, digits=".3g")
    if touching.boundary_friction is not None:
        about = ", of the asperities where they slide"
        yield Row("friction coefficient", touching.boundary_friction, note=about, digits=".2g")


def _electrical(found: Asperities, *, line: bool) -> Iterator[Row]:
    answer = found.electrical
    yield Row("electrical behaviour", answer.behaviour, note=", at 10 kHz")
    if answer.resistance is not None:
        upper = ", ridges along the whole length" if line else ""
        yield Row(
            "resistance of the spots", answer.resistance, "Ω", upper, bound="≤" if line else "", digits=".2g"
        )
    unit = "nF/m" if line else "pF"
    yield Row("capacitance outside of the spots", answer.capacitance_outside, unit, digits=".3g")
    if answer.corner_frequency is not None:
        above = ", above it the film takes more current than the spots"
        unit = "GHz" if answer.corner_frequency >= 1e9 else "kHz"
        yield Row("corner frequency", answer.corner_frequency, unit, above, digits=".2g")
    if answer.breakdown_5 is not None:
        of = ", reached by 5 % of the Hertz zone"
        yield Row("breakdown voltage outside of the spots", answer.breakdown_5, "V", of, digits=".2g")
    if answer.breakdown_voltage is not None:
        of = ", at a probability of 63.2 %"
        yield Row("breakdown voltage outside of the spots", answer.breakdown_voltage, "V", of, digits=".2g")
        of = ", at the applied voltage"
        yield Row("probability outside of the spots", answer.breakdown_probability, "%", of, digits=".2g")
