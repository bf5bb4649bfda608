"""Results of the discharge of a contact; capacitances of a line contact are per length."""

from __future__ import annotations

from ehlectric.quantities.quantity import Keys, Quantity


def _keys(capacitance: str) -> Keys:
    """Keys of the discharge of a contact; ``capacitance`` is the unit of its capacitances."""
    return {**_BREAKDOWN, **_ZONE, **_capacitances(capacitance), **_COSTS}


_BREAKDOWN: Keys = {
    "strength_law": Quantity(
        'law of the dielectric strength: "constant", "table over pressure", "table over temperature" or '
        '"weibull"; null without a strength'
    ),
    "dielectric_strength": Quantity(
        "dielectric strength in the zone that breaks down first; null for a Weibull law",
        "V/m",
        "dielectric strength",
    ),
    "breakdown_voltage": Quantity(
        "voltage at which the dielectric strength is reached; of a Weibull law at a probability of 63.2 %",
        "V",
        "breakdown voltage",
        r"$V_\mathrm{b}$",
        bound="≤",
    ),
    "breakdown_voltage_low": Quantity(
        "breakdown voltage at a probability of 5 %; null without a Weibull law",
        "V",
        "breakdown voltage at 5 %",
        bound="≤",
    ),
    "breakdown_voltage_high": Quantity(
        "breakdown voltage at a probability of 95 %; null without a Weibull law",
        "V",
        "breakdown voltage at 95 %",
        bound="≤",
    ),
    "margin": Quantity(
        "breakdown_voltage / voltage of the case",
        "",
        "margin (breakdown / applied voltage)",
        r"$V_\mathrm{b}/V_{12}$",
        digits=".3g",
        bound="≤",
    ),
    "probability": Quantity(
        "probability of breakdown at the voltage of the case; 0 or 1 without a Weibull law",
        "",
        "probability of breakdown",
        digits=".3g",
    ),
    "breakdown_field_error": Quantity(
        "relative error of breakdown_voltage that is due to the field, `field.max_strength_error`; the error "
        "of the film comes on top; null if unknown",
        "",
        "error of the breakdown voltage, field",
        shown="%",
        digits=".1g",
    ),
}
_ZONE: Keys = {
    "zone_position": Quantity(
        "position at which the field uses most of the strength, x, or [x, y] of a point contact",
        "m",
        "place of the zone that breaks down first",
    ),
    "zone_size": Quantity(
        "width of the zone around zone_position that uses at least 95 % of that; of a point contact the "
        "diameter of a circle of the same area",
        "m",
        "size of the zone that breaks down first",
    ),
    "zone_area": Quantity(
        "area of that zone; of a line contact its width times the length",
        "m**2",
        "area of the zone that breaks down first",
    ),
    "zone_over_half_width": Quantity("zone_size / half-width b", "", "size of the zone / half-width"),
    "zone_over_largest_pit": Quantity(
        "zone_size / largest published pit, 4 µm", "", "size of the zone / largest pit"
    ),
    "zone_over_mean_pit": Quantity(
        "zone_size / mean published pit, 1.7 µm", "", "size of the zone / mean pit"
    ),
}


def _capacitances(unit: str) -> Keys:
    """Keys of capacitances in a unit."""
    return {
        "capacitance": Quantity(
            "capacitance over the whole domain of the film, the outlet filled as `outlet` says",
            unit,
            "capacitance of the whole film",
            "$C$",
        ),
        "capacitance_beyond": Quantity(
            "what `capacitance` would have more on a domain twice as large, were its gap full of oil",
            unit,
            "capacitance beyond the domain",
        ),
        "capacitance_hertz": Quantity(
            "part of the Hertz zone", unit, "capacitance of the Hertz zone", r"$C_\mathrm{H}$"
        ),
        "capacitance_inlet": Quantity("part before the Hertz zone", unit, "capacitance of the inlet"),
        "capacitance_outlet": Quantity("part behind the Hertz zone", unit, "capacitance of the outlet"),
        "capacitance_sides": Quantity(
            "part beside the Hertz zone of a point contact; null for a line contact",
            unit,
            "capacitance of the sides",
        ),
        "capacitance_plate": Quantity(
            "capacitance of parallel plates, ε0 ε_r A_H/h(0) with ε_r at ambient pressure",
            unit,
            "capacitance of parallel plates",
            r"$\varepsilon_0 \varepsilon_\mathrm{r} A_\mathrm{H}/h(0)$",
        ),
        "capacitance_ratio": Quantity("capacitance / capacitance_plate", "", "capacitance / parallel plates"),
        "capacitance_outlet_full": Quantity(
            "capacitance of the outlet where oil alone fills the gap behind the exit",
            unit,
            "capacitance of the outlet, full of oil",
        ),
        "capacitance_outlet_fingers": Quantity(
            "capacitance of the outlet where oil reaches from wall to wall beside gas",
            unit,
            "capacitance of the outlet, oil in fingers",
        ),
        "capacitance_outlet_layers": Quantity(
            "capacitance of the outlet where oil lies on both walls with gas between",
            unit,
            "capacitance of the outlet, oil in layers",
        ),
        "capacitance_full": Quantity("capacitance over the whole domain, full of oil", unit),
        "capacitance_fingers": Quantity("capacitance over the whole domain, oil in fingers", unit),
        "capacitance_layers": Quantity("capacitance over the whole domain, oil in layers", unit),
        "outlet": Quantity(
            'filling of the outlet that `capacitance` and the energies count with: "full", "fingers" or '
            '"layers"',
            "",
            "filling of the outlet",
        ),
    }


_COSTS: Keys = {
    "contact_energy": Quantity(
        "energy C V²/2 of the contact at the voltage of the case",
        "J",
        "energy stored in the contact",
        "$C V_{12}^2/2$",
    ),
    "discharge_energy": Quantity(
        "the same energy with the external capacitance", "J", "energy of a discharge", "$W$"
    ),
    "breakdown_energy": Quantity(
        "discharge_energy at the breakdown voltage",
        "J",
        "energy of a discharge at breakdown",
        r"$W_\mathrm{b}$",
        bound="≤",
    ),
    "pit_volume": Quantity("volume that discharge_energy melts of one surface", "m**3", "volume of the pit"),
    "pit_diameter": Quantity("diameter of a hemisphere of pit_volume", "m", "diameter of the pit"),
    "current_density": Quantity(
        "peak current / area of the dry contact",
        "A/m**2",
        "apparent current density",
        "$J$",
        digits=".3g",
    ),
    "current_density_limits": Quantity(
        "published limits of the current density", "A/m**2", "published limit of the current density"
    ),
    "relaxation_time": Quantity(
        "charge relaxation time ε0 ε_r/σ at ambient pressure; in a film with heat, with the mean "
        "conductivity of its Hertz zone",
        "s",
        "charge relaxation time",
        r"$\varepsilon/\sigma$",
        digits=".3g",
    ),
    "corner_frequency": Quantity(
        "frequency above which the film is capacitive",
        "Hz",
        "the film is capacitive above",
        r"$f_\mathrm{c}$",
        digits=".3g",
    ),
    "sources": Quantity("sources and assumptions of the keys that need one, by the name of the key"),
    "sources.*": Quantity("source or assumption of the key of that name"),
}

LINE_KEYS: Keys = _keys("F/m")
POINT_KEYS: Keys = _keys("F")
