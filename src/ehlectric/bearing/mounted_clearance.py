"""Clearance of the bearing of a bearing file: before mounting, mounted, in operation, and its warnings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Numbers
from ehlectric.bearing.fits import Clearance, Mounting, Temperatures, ThickRing, clearance_at
from ehlectric.cases import library
from ehlectric.cases.bearing_inputs import PLAY, Bearing, Fits
from ehlectric.cases.library.bearing_catalogue import clearance_range
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import WarningCondition
from ehlectric.quantities.units import to_si
from ehlectric.readable import readable


@dataclass(frozen=True)
class MountedClearance:
    """Radial clearance of a bearing before mounting, mounted, and in operation."""

    unmounted: Numbers  # clearance before mounting [m]
    mounted: Clearance  # clearance with its fits at the reference temperature
    running: Clearance


def mounted_clearance(bearing: Bearing) -> MountedClearance | None:
    """Clearances of a bearing with fits; None for a bearing whose clearance in operation is given. Raises
    InputError where a housing that presses on the outer ring has no diameter, or the clearance in operation
    is beyond the model; of many points, those have NaN for the clearance in operation.
    """
    fits, unmounted = bearing.fits, bearing.unmounted_clearance
    if fits is None or unmounted is None:
        return None
    mounting, running = _mounting(bearing, fits, unmounted), _temperatures(bearing, fits)
    states = Temperatures.same(fits.reference_temperature), running
    pressing = np.maximum(*(np.asarray(mounting.interferences(at)[1]) for at in states))
    mounted = MountedClearance(unmounted, *(clearance_at(mounting, at) for at in states))
    clearance = mounted.running.clearance
    unknown = np.logical_and(fits.housing_diameter is None, pressing > 0.0)
    beyond = np.logical_not(np.greater_equal(clearance, PLAY.least) & np.less_equal(clearance, PLAY.most))
    if np.ndim(clearance):
        known = np.where(unknown | beyond, np.nan, clearance)
        return replace(mounted, running=replace(mounted.running, clearance=known))
    if unknown:
        overlap = f"whose interference with the outer ring is {readable(float(1e6 * pressing))} um"
        raise InputError.missing("fits.housing_diameter", f"the outer diameter of the housing, {overlap}")
    if beyond:
        got = f"an operating clearance of {readable(float(1e6 * clearance), 4)} um"
        takes = f"fits and temperatures for {1e6 * PLAY.least:g} to {1e6 * PLAY.most:g} um"
        raise InputError("fits", got=got, takes=takes)
    return mounted


def _mounting(bearing: Bearing, fits: Fits, unmounted: float) -> Mounting:
    """Bearing between shaft and housing; half of the clearance belongs to either raceway."""
    assert bearing.bore is not None and bearing.outer_diameter is not None
    across = bearing.element_diameter + 0.5 * unmounted
    inner, outer = bearing.pitch_diameter - across, bearing.pitch_diameter + across
    around = math.inf if fits.housing_diameter is None else fits.housing_diameter
    return Mounting(
        shaft=_ring(fits.shaft_material, fits.shaft_bore, bearing.bore),
        inner_ring=_ring(bearing.ring_material, bearing.bore, inner),
        outer_ring=_ring(bearing.ring_material, outer, bearing.outer_diameter),
        housing=_ring(fits.housing_material, bearing.outer_diameter, around),
        element_diameter=bearing.element_diameter,
        element_expansion=_expansion(bearing.element_material),
        shaft_interference=fits.shaft_interference,
        housing_interference=fits.housing_interference,
        reference_temperature=fits.reference_temperature,
    )


def _ring(material: str, inner: Numbers, outer: Numbers) -> ThickRing:
    """Ring of a material of the library between two diameters [m]."""
    solid = library.solid(material)
    modulus = to_si(solid["youngs_modulus"], "Pa")
    return ThickRing(inner, outer, modulus, solid["poissons_ratio"], _expansion(material))


def _expansion(material: str) -> float:
    return to_si(library.solid(material)["thermal_expansion"], "1/K")


def _temperatures(bearing: Bearing, fits: Fits) -> Temperatures:
    """Temperatures of operation: without their own, shaft and housing have the temperature of their ring."""
    inner, outer = (bearing.ring_temperature(inner=side) for side in (True, False))
    shaft, housing = fits.shaft_temperature, fits.housing_temperature
    return Temperatures(
        inner_ring=inner,
        outer_ring=outer,
        elements=bearing.element_temperature,
        shaft=inner if shaft is None else shaft,
        housing=outer if housing is None else housing,
    )


def class_warning_conditions(bearing: Bearing) -> Iterator[WarningCondition]:
    """Warning of a clearance that is the middle of a class."""
    if bearing.clearance_class is None or bearing.bore is None:
        return
    allowed = clearance_range(bearing.kind, bearing.clearance_class, bearing.bore)
    low, high, middle = (1e6 * value for value in (allowed.least, allowed.most, allowed.middle))
    name, half = bearing.clearance_class, 0.5 * (high - low)
    mounted = bearing.fits is not None
    yield WarningCondition.of(
        not mounted, "clearance-class", "before_mounting", name=name, low=low, high=high, middle=middle
    )
    yield WarningCondition.of(
        mounted, "clearance-class", "in_operation", name=name, low=low, high=high, middle=middle, half=half
    )


def fit_warning_conditions(clearance: MountedClearance | None) -> Iterator[WarningCondition]:
    """Warnings of fits and temperatures that preload a bearing, or loosen one of its rings. ``clearance``,
    clearances of the bearing; None without fits.
    """
    if clearance is None:
        return
    mounted, running = clearance.mounted, clearance.running
    yield WarningCondition.of(
        running.clearance < 0.0,
        "clearance-negative",
        running=1e6 * running.clearance,
        unmounted=1e6 * clearance.unmounted,
    )
    for fit, before, after in (
        ("shaft", mounted.shaft_interference, running.shaft_interference),
        ("housing", mounted.housing_interference, running.housing_interference),
    ):
        loose = (after <= 0.0) & (before > 0.0)
        yield WarningCondition.of(loose, "fit-loose", fit, before=1e6 * before, after=1e6 * after)
