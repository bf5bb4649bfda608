"""Bounds: which numbers of a result are upper or lower bounds, as an ideal film is better than a real one.

The book says what an ideal film makes of each quantity. Whether that holds for a result follows from what its
film neglects: starvation, heat, or roughness. A real film is thinner, so that its field is higher, and it
breaks down at a lower voltage. The films of a bearing with heat are best estimates, and no bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.quantity import Bound, Keys
from ehlectric.quantities.rows import Summary, value_at


def left_out(summary: Summary) -> tuple[str, ...]:
    """Idealisations of the film of a contact: some of "isothermal", "fully flooded" and "smooth".

    Examples
    --------
    >>> left_out({"film": {"thermal": True}})
    ('fully flooded', 'smooth')
    """
    film = summary.get("film", {})
    ideal = {
        "isothermal": not film.get("thermal"),
        "fully flooded": "oil_layer" not in film,
        "smooth": "roughness" not in summary,
    }
    return tuple(name for name, holds in ideal.items() if holds)


def bound_words(summary: Summary) -> str:
    """Why the breakdown voltage of a contact is an upper bound; empty where its film neglects nothing.

    Examples
    --------
    >>> bound_words({"film": {"thermal": True}})
    'upper bound: fully flooded, smooth film'
    """
    ideal = left_out(summary)
    return f"upper bound: {', '.join(ideal)} film" if ideal else ""


def contact_bounds(book: Keys, summary: Summary) -> dict[str, Bound]:
    """Bounds of the numbers of a contact, by dotted key.

    Where surfaces touch, the maximum field occurs in the boundary film, which its thickness gives. The
    resistance of spots that are ridges is an upper bound in any film.
    """
    always = {"asperities.resistance"}
    never = {"field.max_strength"} if value_at(summary, "asperities.spots") else set()
    ideal = bool(left_out(summary))
    return _holding(book, lambda key: key not in never and (ideal or key in always))


def moving_bounds(book: Keys) -> dict[str, Bound]:
    """Bounds of the numbers of a contact over time, by dotted key; its films are isothermal in any case."""
    return _holding(book, lambda _: True)


def drive_bounds(book: Keys, summary: Summary) -> dict[str, Bound]:
    """Bounds of the numbers of a drive, by dotted key, where the films of a bearing are upper bounds.

    The capacitance of ceramic elements is one, too, so that the voltages that it divides are lower bounds.
    The numbers of a remedy, whose summary has no inputs, have none.
    """
    inputs = {
        end: summary.get("inputs", {})[end]["bearing"] for end in ENDS if end in summary.get("inputs", {})
    }
    ideal = any(_isothermal(end) or _smooth(end) for end in inputs.values()) or _parting(summary)
    # Ceramic elements do not break down.
    unknown = [
        value_at(summary, f"{end}.breakdown_voltage") is None and bearing.get("element_capacitance") is None
        for end, bearing in inputs.items()
    ]
    divided = dict.fromkeys(_DIVIDED, any(unknown)) | {"capacitance": bool(unknown) and all(unknown)}
    lives: dict[str, bool] = {}
    for end in ENDS:
        of_cycle = {key.removeprefix("duty_"): value for key, value in (summary.get(end) or {}).items()}
        for key, holds in cycle_life_bounds(of_cycle, "duty_").items():
            lives[key] = lives.get(key, False) or holds
    divided |= lives
    return _holding(book, lambda key: divided.get(key.rpartition(".")[2], ideal))


# Voltages of a drive that the capacitance of its bearings divides.
_DIVIDED = ("voltage_at_peak", "voltage_ratio", "peak_voltage", "rms_voltage")


def _holding(book: Keys, holds: Callable[[str], bool]) -> dict[str, Bound]:
    """Bounds of the book that hold, by dotted key."""
    return {key: about.bound for key, about in book.items() if about.bound and holds(key)}


def _isothermal(bearing: Mapping[str, Any]) -> bool:
    """Whether the films of a table ``bearing`` are upper bounds: they have no heat, not even by a number."""
    return bearing.get("film_factor") in ("none", 1.0)


def _smooth(bearing: Mapping[str, Any]) -> bool:
    """Whether films of a table ``bearing`` break down as smooth ones; so do all of a file without the key."""
    return not bearing.get("summit_height")


def _parting(summary: Summary) -> bool:
    """Whether surfaces may touch, and break down below the voltage of their films as they part."""
    return "partial-film" in summary.get("warning_codes", ())


def breakdown_words(summary: Summary) -> str:
    """Films of the breakdown voltages of a bearing, and whether these are upper bounds or best estimates.

    Examples
    --------
    >>> inputs = {"bearing": {"film_factor": "inlet-shear", "summit_height": 2.0}}
    >>> breakdown_words({"inputs": inputs, "warning_codes": ["smooth-film"]})
    'best estimate: rough film'
    >>> breakdown_words({"inputs": inputs, "warning_codes": ["partial-film"]})
    'upper bound: rough film with asperity contact'
    """
    codes, parting, bearing = summary["warning_codes"], _parting(summary), summary["inputs"]["bearing"]
    film = f"{'smooth' if _smooth(bearing) else 'rough'} film"
    films = f"isothermal, fully flooded, {film}" if "isothermal-film" in codes else film
    touch = " with asperity contact" if parting else ""
    scatter = ", at a probability of 63.2 %" if "weibull-voltage" in codes else ""
    bound = parting or _isothermal(bearing) or _smooth(bearing)
    return f"{'upper bound' if bound else 'best estimate'}: {films}{touch}{scatter}"


# Numbers of a bearing that are bounds only where a condition holds: capacitances of ceramic elements whose
# own capacitance is not given, voltages where the oil discharges the shaft, and ideal films. The field in
# ceramic elements is always one.
_CERAMIC = tuple(
    f"bearing.{name}"
    for name in ("capacitance", "capacitance_oil", "capacitance_air", "shaft_capacitance", "element_voltage")
)
_OF_ELEMENTS = tuple(f"bearing.element_{name}" for name in ("field", "breakdown", "margin"))
_DISCHARGED = ("bearing.shaft_voltage", "bearing.film_voltage")
_FILMS = (
    *("bearing.lambda_ratio", "bearing.minimum_thickness", "duty.stretches.lambda_ratio"),
    *("rings.inner.minimum_thickness", "rings.outer.minimum_thickness"),
    *("margin.asperity_contact_speed", "margin.capacitive_speed"),
)
# Numbers that a lower shaft voltage changes the other way than a thinner film.
_OF_SHAFT = (
    *("bearing.max_strength", "contacts.max_strength", "bearing.breakdown_probability"),
    *("margin.critical_speed", "margin.upper_critical_speed"),
)


# Lives of a duty cycle by the share of its revolutions that makes an upper bound of them.
_OF_CYCLE = {
    "low_viscosity_share": ("modified_life", "reference_modified_life"),
    "low_film_share": ("film_modified_life", "film_reference_modified_life", "roughened_life"),
}


def cycle_life_bounds(duty: Mapping[str, Any], prefix: str) -> dict[str, bool]:
    """Whether the lives of a duty cycle are upper bounds, by their keys with a prefix."""
    missing = bool(duty.get("unsolved_share"))
    of_rows = {
        f"{prefix}{key}": missing or bool(duty.get(share))
        for share, keys in _OF_CYCLE.items()
        for key in keys
    }
    of_loads = {f"{prefix}{key}": missing for key in ("reference_life", "reliable_reference_life")}
    return {**of_loads, **of_rows}


def bearing_bounds(book: Keys, summary: Summary) -> dict[str, Bound]:
    """Bounds of the numbers of a bearing, by dotted key.

    Isothermal films are bounds: real films are thinner, break down at lower voltages and higher speeds, and
    have higher fields. Smooth films, and films whose surfaces may touch, are also bounds. All others are best
    estimates. The shaft voltage falls with the film, but less than it. The energy of a breakdown voltage that
    is an upper bound is one too, although a thinner film has a higher capacitance: it grows as 1/h at most,
    and the square of the voltage falls as h^2.
    """
    codes = summary["warning_codes"]
    leaks, isothermal = "shaft-leaks" in codes, _isothermal(summary["inputs"]["bearing"])
    ideal = isothermal or _smooth(summary["inputs"]["bearing"]) or _parting(summary)
    holds = {
        **dict.fromkeys(_CERAMIC, "capacitance-bound" in codes),
        **dict.fromkeys(_OF_ELEMENTS, True),
        **dict.fromkeys(_DISCHARGED, leaks),
        **dict.fromkeys(_FILMS, isothermal and summary["bearing"]["film_factor"] == 1.0),
        **dict.fromkeys(_OF_SHAFT, ideal and not leaks),
        **cycle_life_bounds(summary.get("duty") or {}, "duty."),
    }
    # Words instead of a number are no bound.
    worded = [
        key for key in ("bearing.first_break", "margin.critical_speed") if value_at(summary, key) is None
    ]
    return _holding(book, lambda key: holds.get(key, ideal) and key not in worded)
