"""Numbers of a contact whose surfaces touch: what its spots carry and conduct, and the film around them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ehlectric.app.answers.contact import Number
from ehlectric.app.compute.numbers import number_of, short_text
from ehlectric.bearing.intermittency.words import time_text
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.spots.asperities import Asperities
from ehlectric.contact.spots.electrical import BREAKING_SHARES
from ehlectric.contact.spots.warnings import share_text

# Words of a number that needs an input; a form has it among the further inputs of that group.
_UNKNOWN = "not known"
_NO_RESISTIVITY = "give the resistivity of the bodies, in More of Voltage and breakdown"
_NO_LENGTH = "give the length of the contact, in More of Voltage and breakdown"


def spot_numbers(result: Result | PointResult) -> tuple[Number, ...]:
    """Numbers of the spots of a contact; none where its surfaces do not touch, or it is not converged.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.

    Returns
    -------
    tuple of Number
        Behaviour in one word, load share, real area, spots, resistance, capacitance and breakdown around
        them.
    """
    found = result.spots
    if found is None:
        return ()
    line = isinstance(result, Result)
    return (*_mechanics(found, line=line), *_electrical(result, found, line=line))


def _mechanics(found: Asperities, *, line: bool) -> Iterator[Number]:
    touching, behaviour = found.touching, found.electrical.behaviour
    there = f"at 10 kHz; a spot is there {time_text(found.electrical.time_share)}"
    yield Number("behaviour", "Electrical behaviour", behaviour, note=there)
    yield _load_share(found)
    error = touching.contact_area_error
    within = "" if error is None else f", ± {min(100.0 * error, 100.0):.0f} % of it by the grid"
    part = (
        f"{short_text(100.0 * touching.contact_area_share, 2)} % of the Hertz {'width' if line else 'area'}"
    )
    area = _size(touching.contact_area, line=line)
    yield Number("contact-area", f"Real contact {'width' if line else 'area'}", *area, part + within)
    yield Number("spots", "Spots", str(touching.spots), note=_spot_note(found, line=line))
    if touching.boundary_friction is not None:
        friction = short_text(touching.boundary_friction, 2)
        yield Number("friction", "Friction of the asperities", friction, note="coefficient where they slide")


def _load_share(found: Asperities) -> Number:
    """Load share with no more digits than its change from a coarser grid leaves."""
    share, change = found.touching.load_share, found.share_change
    if found.coarser is None or change is None:
        note = "error unknown: no coarser grid was solved"
    else:
        before = share_text(found.coarser.load_share, share)
        error = short_text(100.0 * abs(change), 2)
        note = f"± {error} percentage points by the grid: {before} % on half the nodes"
    text = share_text(share, None if found.coarser is None else found.coarser.load_share)
    return Number("load-share", "Load share of asperities", text, "%", note)


def _size(value: float, *, line: bool) -> tuple[str, str]:
    """Number and unit of a width [m] of a line contact, or of an area [m^2] of a point contact."""
    return (short_text(1e6 * value, 2), "µm") if line else (short_text(1e12 * value, 2), "µm²")


def _spot_note(found: Asperities, *, line: bool) -> str:
    touching, notes = found.touching, []
    if touching.mean_spot is not None and touching.largest_spot is not None:
        mean, largest = (
            " ".join(_size(size, line=line)) for size in (touching.mean_spot, touching.largest_spot)
        )
        what = "strips along the contact, width" if line else "area"
        notes.append(f"{what} {mean} on average, {largest} at most")
    if touching.spots_of_one_node:
        notes.append(f"{touching.spots_of_one_node} of a single node")
    return "; ".join(notes)


def _electrical(result: Result | PointResult, found: Asperities, *, line: bool) -> Iterator[Number]:
    answer, electric = found.electrical, result.case.electric
    name, label = "spot-resistance", "Resistance of the spots"
    if answer.resistance is not None:
        layer = "with their tribofilm" if electric.tribofilm_resistance else "of metal"
        note = f"{layer}; ridges along the whole length" if line else layer
        number = number_of(name, label, answer.resistance, "Ω", note, digits=2)
        yield replace(number, bound="≤" if line else "")
    else:
        missing = _NO_RESISTIVITY if electric.resistivity is None else _NO_LENGTH
        yield Number(name, label, _UNKNOWN, note=missing)
    around = "outside of the spots, over the film"
    factor, unit = (1e9, "nF/m") if line else (1e12, "pF")
    capacitance = short_text(factor * answer.capacitance_outside, 3)
    yield Number("capacitance-outside", "Capacitance around the spots", capacitance, unit, around)
    yield from _breakdown(found)


def _breakdown(found: Asperities) -> Iterator[Number]:
    answer = found.electrical
    for share in BREAKING_SHARES:
        part = f"{100.0 * share:g}"
        voltage: float | None = getattr(answer, f"breakdown_{part}")
        if voltage is not None:
            note = f"{part} % of the Hertz zone outside of the spots reach the dielectric strength"
            label = f"Breakdown voltage, {part} % of the film"
            yield number_of(f"breakdown-{part}", label, voltage, "V", note, digits=2)
    if answer.breakdown_voltage is not None and answer.breakdown_probability is not None:
        note = "outside of the spots, at a probability of 63.2 %"
        label = "Breakdown voltage of the film"
        yield number_of("breakdown-outside", label, answer.breakdown_voltage, "V", note, digits=2)
        chance, note = short_text(100.0 * answer.breakdown_probability, 2), "of the film outside of the spots"
        yield Number("breakdown-probability", "Probability of breakdown", chance, "%", note)
