"""Codes of the warnings that a result may carry, each with its meaning and severity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

# "severe": the numbers must not be used. "note": the numbers are valid, and the text tells how they were
# obtained.
Severity = Literal["note", "warning", "severe"]


@dataclass(frozen=True)
class Cause:
    """Meaning of a warning code, in one sentence, and severity of its warnings."""

    meaning: str
    severity: Severity = "warning"


CODES: Mapping[str, Cause] = MappingProxyType(
    {
        # Contact, known before its film is computed
        "regime": Cause("The lubrication regime is outside the validity of most film formulas."),
        "radius-large": Cause("A radius above 1 m was probably given in the wrong unit."),
        "ambient-pressure": Cause("The ambient pressure carries more than 1 % of the load."),
        "plastic-deformation": Cause("The Hertz pressure deforms bearing steel permanently."),
        "hardness-low": Cause("The hardness of the surfaces is below the Hertz pressure."),
        "law-range": Cause("A law of the lubricant is not reliable at this Hertz pressure."),
        "roelands-z": Cause("The exponent roelands_z does not fit the viscosity and its coefficient."),
        "estimated-alpha": Cause("The pressure-viscosity coefficient is estimated from the base oil."),
        # Rough surfaces
        "spacing-irregular": Cause("Samples may be missing in a file of heights."),
        "voids-filled": Cause("Voids in a measured surface were filled.", "note"),
        "heights-cut": Cause("The key truncate cuts a large share of the heights."),
        "roughness-continued": Cause("A rough surface is shorter than the domain and was continued."),
        "roughness-unresolved": Cause("The grid does not resolve a rough surface."),
        "variance-missed": Cause("Some of the variance of a rough surface is too fine for the grid."),
        "seed-repeated": Cause("Rough surfaces have the same seed and depend on each other."),
        # Film
        "not-converged": Cause("The iteration of the film did not converge.", "severe"),
        "surfaces-touch": Cause("The surfaces of the computed film would touch in places."),
        "asperities-touch": Cause("Asperities touch, carry a part of the load and conduct."),
        "load-share-unresolved": Cause("The load share of asperities changes with the grid."),
        "oil-not-conserved": Cause("The film makes or loses above 10 % of the oil that flows through it."),
        "thinner-than-atom": Cause("The film is thinner than an atom in places."),
        "refine-not-reached": Cause("The error of the film that was asked for was not reached."),
        "error-unknown": Cause("The discretisation error of a rough contact's film is unknown."),
        "coarser-grid-unsolved": Cause("The discretisation error is unknown and probably large.", "severe"),
        "grid-too-coarse": Cause("The estimated discretisation error of the film is large."),
        "grid-far-too-coarse": Cause("The discretisation error of the film is above 10 %.", "severe"),
        "local-plastic-deformation": Cause("The local pressure deforms bearing steel permanently."),
        "outlet-too-short": Cause("The film does not cavitate within the domain."),
        "inlet-too-short": Cause("Some of the inlet pressure builds up upstream of the domain."),
        "inlet-far-too-short": Cause("Above 20 % of the inlet pressure builds up upstream.", "severe"),
        "domain-too-small": Cause("The domain is too small for the contact."),
        "domain-far-too-small": Cause("The domain of a point contact is far too small.", "severe"),
        "oil-layer-thick": Cause("The layer of oil is thicker than what the contact takes.", "note"),
        "meniscus-at-edge": Cause("The meniscus is at the edge of the domain or of the Hertz zone."),
        "film-ratio-missed": Cause("No layer of oil was found that gives the ratio of films asked for."),
        "layer-table-short": Cause("The layer of oil over y does not reach the sides of the contact."),
        "flooded-film-wrong": Cause("The flooded film beside a starved one is wrong or not known."),
        "shear-constant-unused": Cause("Constants of another law of shear are given.", "note"),
        "newtonian-traction": Cause("The law between stress and shear rate has no limit at high pressure."),
        "film-temperature-range": Cause("The film is hotter or colder than the laws of the oil are known."),
        "film-very-hot": Cause("The film is hotter than oils stand."),
        "isothermal-unsolved": Cause("The isothermal film beside that with heat or shear did not converge."),
        "heat-unresolved": Cause("The grid does not resolve the heat in the film."),
        "slow-body": Cause("A surface moves too slowly for the model of its temperature."),
        # Electric field and discharge
        "field-grid-too-coarse": Cause("The grid of the field is coarser than that of the film."),
        "field-unresolved": Cause("The estimated error of the maximum field is above 2 %, or unknown."),
        "field-range-too-narrow": Cause("The maximum field is at an edge of the field range."),
        "field-above-insulators": Cause("The maximum field is higher than any insulator withstands."),
        "breakdown-expected": Cause("The margin is below 1: breakdown is expected."),
        "strength-above-liquids": Cause("No liquid has a dielectric strength as high as the given one."),
        "tunnelling": Cause("The film is so thin that electrons tunnel through it."),
        "strength-table-exceeded": Cause("The film pressure exceeds the range of discharge.strength_table."),
        "roughness-factor-rough": Cause("The film is too thin for a roughness factor of its capacitance."),
        "coating-in-series": Cause("Field and discharge are those of the film, without its coating.", "note"),
        # Transient contacts
        "stationary-differs": Cause("The moving roughness differs from the stationary one."),
        "stationary-not-converged": Cause("The film with stationary roughness did not converge."),
        "stationary-error": Cause("The stationary film has a discretisation error above 1 %."),
        "steps-too-long": Cause("The time steps of a motion do not resolve the waves that pass the oil."),
        "steps-halved": Cause("Some time steps had to be halved.", "note"),
        # Bearings
        "formula-contacts": Cause("The contacts of the bearing are computed by formulas."),
        "atlas-contacts": Cause("Contacts have the films of the atlas.", "note"),
        "atlas-left": Cause("The atlas has no film of a contact, which is computed by formula."),
        "atlas-left-light": Cause("A light contact beyond the atlas is computed by formula.", "note"),
        "isothermal-film": Cause("The films are isothermal and fully flooded.", "note"),
        "temperature-unused": Cause("The films use a given viscosity at any temperature.", "note"),
        "viscosity-of-base": Cause("The viscosity is that of a lubricant of the library at any temperature."),
        "temperature-low": Cause("The viscosity is extrapolated to below 0 °C."),
        "speed-high": Cause("The speed is above that of ordinary bearings of this size."),
        "load-low": Cause("The load is tiny for a bearing of this size."),
        "temperature-extreme": Cause("Bearing steel or oil do not stand this temperature."),
        "viscosity-high": Cause("The oil is so viscous that it hardly flows."),
        "clearance-class": Cause("The clearance is that of a class, before the bearing is mounted."),
        "clearance-negative": Cause("Fits and temperatures preload the bearing.", "note"),
        "fit-loose": Cause("A ring that is fitted tight is loose at the temperatures of operation."),
        "viscosity-grade": Cause("The viscosity is the middle of a grade, 10 % either way.", "note"),
        "clearance-taken-up": Cause("The films are not small compared with the clearance."),
        "shoulder-reached": Cause("A contact ellipse extends beyond the shoulder of its groove."),
        "touching": Cause("The lambda ratio is below 1: contacts touch, and discharge as they open."),
        "partial-film": Cause("The lambda ratio is below 3: surfaces may touch, and discharge then."),
        "smooth-film": Cause("The films are smooth, with the film factor of the case.", "note"),
        "supply-rule": Cause("A rule for the rolling friction gives the supply of oil to the films."),
        "film-factor-low": Cause("The film factor is so low that films differ from it by its exponent."),
        "supply-low": Cause("The supply of oil leaves less than half of the flooded film."),
        "film-decays": Cause("The film halves soon if no oil returns to its track.", "note"),
        "shaft-leaks": Cause("The oil discharges the shaft within a period of the inverter."),
        "coating-breakdown": Cause("The shaft voltage is above the breakdown voltage of the coating."),
        "current-density-high": Cause("The apparent current density is above published limits."),
        "capacitance-bound": Cause("The capacitance of a bearing with ceramic elements is an upper bound."),
        "weibull-voltage": Cause("Breakdown voltages are those at a probability of 63.2 %.", "note"),
        "speed-left-out": Cause("The figures over speed leave out a speed that cannot be computed."),
        # Sweeps
        "points-with-warnings": Cause("Solved points of a sweep have warnings."),
        "points-with-notes": Cause("Solved points of a sweep have notes.", "note"),
        "points-not-usable": Cause("Solved points of a sweep have films that must not be used."),
        "points-of-another-version": Cause("Another version of the program solved points.", "note"),
        "rows-dropped": Cause("Rows of a Sobol design were left out of its sensitivity indices."),
        "rows-not-usable": Cause("Rows of a Sobol design use films that must not be used."),
        "intervals-wide": Cause("The confidence intervals of sensitivity indices are wide."),
        # Measurements beside a case
        "formula-films": Cause("The films beside a measurement are those of a formula."),
        "columns-ignored": Cause("Columns of a measurement are not known and were ignored.", "note"),
        "rows-without-factor": Cause("Rows of a measurement have no film factor."),
        "scatter-only": Cause("The interval of a film factor is from the scatter of the rows only."),
        "scatter-large": Cause("Film factors scatter more than the measurement states."),
        "factor-varies": Cause("The film factor changes with the speed."),
        "range-left-out": Cause("The uncertainty of a film factor leaves out the range of an input."),
        # Files of other versions
        "not-usable": Cause("Another version of the program says not to use the numbers.", "severe"),
        "unclassified": Cause("Another version of the program gave this warning."),
    }
)
