"""Warnings as the pages tell them: beside the numbers that they concern."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Told:
    """Warning of a result.

    Attributes
    ----------
    code, severity, text : str
        As of ``ehlectric.errors.ResultWarning``.
    beside : tuple of str
        Names of the numbers that it concerns, of which a page shows it beside those that it has; empty for a
        warning that concerns the whole result.
    meaning : str
        Meaning of the code in one sentence, without numbers.
    """

    code: str
    severity: str
    text: str
    beside: tuple[str, ...] = ()
    meaning: str = ""


# Order in which warnings are told.
SEVERITIES = ("severe", "warning", "note")

_FIRST = ("first-break", "margin")
# A breakdown voltage is proportional to the film.
_FILM = ("lambda", *_FIRST)
_SPARK = ("shaft-voltage", "margin")
_ALL = ("capacitance", "lambda", "first-break", "shaft-voltage", "margin")

# Codes of sweeps, of measurements, of measured waveforms, and of no kind: they concern no number of a bearing
# or of a contact.
WITHOUT_PLACE = (
    "points-with-warnings",
    "points-with-notes",
    "points-not-usable",
    "points-of-another-version",
    "rows-dropped",
    "rows-not-usable",
    "intervals-wide",
    "columns-ignored",
    "rows-without-factor",
    "scatter-only",
    "scatter-large",
    "factor-varies",
    "range-left-out",
    "units-assumed",
    "samples-missing",
    "waveform-clipped",
    "waveform-coarse",
    "edges-unresolved",
    "record-repeated",
    "circuit-undamped",
    "capacitances-estimated",
    "edges-faster-than-oil",
    "both-ends-discharge",
    "threshold-constant",
    "arc-burns-on",
    "few-discharges",
    "unclassified",
)

# Numbers that a warning concerns, by its code; empty for those that concern the whole result or none of the
# numbers of a bearing. A new code must be given its place here: a test compares this table with all codes.
PLACES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        # Contact
        "regime": _FILM,
        "radius-large": (),
        "modulus-low": (),
        "ambient-pressure": (),
        "plastic-deformation": _FILM,
        "hardness-low": _FILM,
        "law-range": _FILM,
        "roelands-z": _FILM,
        "estimated-alpha": _FILM,
        # Rough surfaces
        "spacing-irregular": (),
        "voids-filled": (),
        "heights-cut": (),
        "roughness-continued": (),
        "roughness-unresolved": _FILM,
        "variance-missed": _FILM,
        "seed-repeated": (),
        # Film
        "not-converged": _ALL,
        "surfaces-touch": _FILM,
        "asperities-touch": _FILM,
        "load-share-unresolved": (),
        "oil-not-conserved": _FILM,
        "thinner-than-atom": _FILM,
        "error-out-of-reach": _FILM,
        "refine-not-reached": _FILM,
        "error-unknown": _FILM,
        "coarser-grid-unsolved": _FILM,
        "grid-too-coarse": _FILM,
        "grid-far-too-coarse": _ALL,
        "local-plastic-deformation": _FILM,
        "outlet-too-short": _FILM,
        "inlet-too-short": _FILM,
        "inlet-far-too-short": _ALL,
        "domain-too-small": _FILM,
        "domain-far-too-small": _ALL,
        "oil-layer-thick": _FILM,
        "meniscus-at-edge": _FILM,
        "film-ratio-missed": _FILM,
        "layer-table-short": _FILM,
        "flooded-film-wrong": (),
        "shear-constant-unused": (),
        "newtonian-traction": (),
        "film-temperature-range": _FILM,
        "film-very-hot": _FILM,
        "isothermal-unsolved": (),
        "heat-unresolved": _FILM,
        "slow-body": _FILM,
        # Electric field and discharge
        "field-grid-too-coarse": _FIRST,
        "field-unresolved": _FIRST,
        "field-range-too-narrow": _FIRST,
        "field-above-insulators": _SPARK,
        "breakdown-expected": ("margin",),
        "strength-above-liquids": _FIRST,
        "tunnelling": _FIRST,
        "strength-table-exceeded": _FIRST,
        "roughness-factor-rough": ("capacitance",),
        "coating-in-series": ("first-break",),
        # Transient contacts
        "stationary-differs": (),
        "stationary-not-converged": (),
        "stationary-error": (),
        "steps-too-long": (),
        "steps-halved": (),
        # Bearings
        "formula-contacts": ("capacitance", *_FILM),
        "atlas-contacts": ("capacitance", *_FILM),
        "atlas-left": ("capacitance", *_FILM),
        "atlas-left-light": (),
        "isothermal-film": (*_FILM, "regime"),
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
        "clearance-taken-up": _FILM,
        "shoulder-reached": ("capacitance", *_FIRST),
        "touching": ("capacitance", "regime", *_FILM),
        "partial-film": ("regime", *_FILM),
        "smooth-film": _FILM,
        "supply-rule": _FILM,
        "film-factor-low": _FILM,
        "supply-low": _FILM,
        "film-decays": _FILM,
        "shaft-leaks": _SPARK,
        "coating-assumed": ("shaft-voltage",),
        "coating-breakdown": ("shaft-voltage",),
        "current-density-high": (),
        "capacitance-bound": ("capacitance", "shaft-voltage"),
        "weibull-voltage": _FIRST,
        "speed-left-out": (),
        # Measurements
        "formula-films": _FILM,
        # Files of other versions
        "not-usable": _ALL,
    }
    | dict.fromkeys(WITHOUT_PLACE, ())
)

# Numbers of a drive that a warning concerns, where they are others than those of a bearing.
DRIVE_PLACES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    dict(PLACES)
    | {
        "units-assumed": ("source",),
        "samples-missing": ("source",),
        "waveform-clipped": ("source",),
        "waveform-coarse": ("source",),
        "edges-unresolved": ("source",),
        "record-repeated": ("source",),
        "circuit-undamped": ("at-peak", "peak"),
        "capacitances-estimated": ("machine", "at-peak"),
        "edges-faster-than-oil": ("at-peak", "discharges"),
        "both-ends-discharge": ("discharges",),
        "threshold-constant": ("first-break", "discharges"),
        "arc-burns-on": ("discharges",),
        "few-discharges": ("discharges",),
        "current-density-high": ("current-density",),
        "coating-assumed": ("at-peak", "peak"),
        "coating-breakdown": ("at-peak", "peak"),
    }
)


def beside(told: Iterable[Told], number: str) -> tuple[Told, ...]:
    """Warnings that concern a number."""
    return tuple(one for one in told if number in one.beside)


def elsewhere(told: Iterable[Told]) -> tuple[Told, ...]:
    """Warnings that concern no single number, which a list below the numbers tells."""
    return tuple(one for one in told if not one.beside)


def counts(told: Iterable[Told]) -> str:
    """Numbers of warnings by their severity.

    Examples
    --------
    >>> counts([Told("partial-film", "warning", "thin"), Told("speed-high", "warning", "fast")])
    '2 warnings'
    >>> counts([])
    'no warnings'
    """
    severities = [one.severity for one in told]
    names = {"severe": "severe warning", "warning": "warning", "note": "note"}
    found = [(severities.count(one), names[one]) for one in SEVERITIES if one in severities]
    return ", ".join(f"{n} {name}{'' if n == 1 else 's'}" for n, name in found) or "no warnings"
