"""Numbers of a contact that its warnings concern."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ehlectric.app.answers.told import WITHOUT_PLACE

_HERTZ = ("hertz-pressure",)
_FILM = ("minimum-film", "central-film")
_PRESSURE = ("max-pressure",)
_FIELD = ("max-field", "breakdown-voltage")
_BREAKDOWN = ("breakdown-voltage",)
_SOLVED = (*_FILM, *_PRESSURE, "max-field", "capacitance", *_BREAKDOWN)

# Numbers that a warning concerns, by its code; empty for those that concern the whole result or none of the
# numbers of a contact. A severe warning stands beside every number of a solved contact. A new code must be
# given its place here: a test compares this table with all codes.
CONTACT_PLACES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        # Contact
        "regime": _FILM,
        "radius-large": (),
        "modulus-low": (),
        "ambient-pressure": _HERTZ,
        "plastic-deformation": _HERTZ,
        "hardness-low": _HERTZ,
        "law-range": _HERTZ,
        "roelands-z": _FILM,
        "estimated-alpha": _FILM,
        # Rough surfaces
        "spacing-irregular": (),
        "voids-filled": (),
        "heights-cut": (),
        "roughness-continued": (),
        "roughness-unresolved": (*_FILM, *_PRESSURE, *_FIELD),
        "variance-missed": (*_FILM, *_PRESSURE, *_FIELD),
        "seed-repeated": (),
        # Film
        "not-converged": _SOLVED,
        "surfaces-touch": ("minimum-film", *_BREAKDOWN),
        "asperities-touch": ("minimum-film", "capacitance", *_FIELD),
        "load-share-unresolved": ("load-share",),
        "oil-not-conserved": _FILM,
        "thinner-than-atom": ("minimum-film", *_FIELD),
        "error-out-of-reach": _FILM,
        "refine-not-reached": _FILM,
        "error-unknown": ("minimum-film",),
        "coarser-grid-unsolved": _SOLVED,
        "grid-too-coarse": _FILM,
        "grid-far-too-coarse": _SOLVED,
        "local-plastic-deformation": _PRESSURE,
        "outlet-too-short": (),
        "inlet-too-short": _FILM,
        "inlet-far-too-short": _SOLVED,
        "domain-too-small": _FILM,
        "domain-far-too-small": _SOLVED,
        "oil-layer-thick": _FILM,
        "meniscus-at-edge": _FILM,
        "film-ratio-missed": _FILM,
        "layer-table-short": _FILM,
        "flooded-film-wrong": (),
        "shear-constant-unused": (),
        "newtonian-traction": ("traction", "temperature-rise", "power-loss"),
        "film-temperature-range": (*_FILM, "temperature-rise"),
        "film-very-hot": (*_FILM, "temperature-rise"),
        "isothermal-unsolved": (),
        "heat-unresolved": (*_FILM, "temperature-rise"),
        "slow-body": (*_FILM, "temperature-rise"),
        # Electric field and discharge
        "field-grid-too-coarse": ("max-field", "capacitance", *_BREAKDOWN),
        "field-unresolved": _FIELD,
        "field-range-too-narrow": _FIELD,
        "field-above-insulators": ("max-field",),
        "breakdown-expected": _BREAKDOWN,
        "strength-above-liquids": _BREAKDOWN,
        "tunnelling": _FIELD,
        "strength-table-exceeded": _BREAKDOWN,
        "roughness-factor-rough": ("capacitance",),
        "coating-in-series": _FIELD,
        # Transient contacts
        "stationary-differs": (),
        "stationary-not-converged": (),
        "stationary-error": (),
        "steps-too-long": (),
        "steps-halved": (),
        # Bearings
        "formula-contacts": (),
        "atlas-contacts": (),
        "atlas-left": (),
        "atlas-left-light": (),
        "isothermal-film": _BREAKDOWN,
        "temperature-unused": _FILM,
        "viscosity-of-base": _FILM,
        "temperature-low": _FILM,
        "speed-high": (),
        "load-low": (),
        "temperature-extreme": (),
        "viscosity-high": _FILM,
        "clearance-class": (),
        "clearance-negative": (),
        "fit-loose": (),
        "viscosity-grade": _FILM,
        "clearance-taken-up": (),
        "shoulder-reached": (),
        "touching": _FILM,
        "partial-film": _FILM,
        "smooth-film": _BREAKDOWN,
        "supply-rule": _FILM,
        "film-factor-low": _FILM,
        "supply-low": _FILM,
        "film-decays": _FILM,
        "shaft-leaks": (),
        "coating-assumed": (),
        "coating-breakdown": (),
        "current-density-high": (),
        "capacitance-bound": ("capacitance",),
        "weibull-voltage": _BREAKDOWN,
        "speed-left-out": (),
        # Measurements
        "formula-films": _FILM,
        # Files of other versions
        "not-usable": _SOLVED,
    }
    | dict.fromkeys(WITHOUT_PLACE, ())
)
