"""Keys of the table ``asperities`` of a contact's summary."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey


def _mechanics(area: str, what: str) -> Keys:
    """Keys of what the spots carry, with the unit of an area and what a spot is."""
    return {
        "boundary_film": ResultKey("gap at which the surfaces touch", "m"),
        "load_share": ResultKey(
            "share of asperities in the load", "", "load share of asperities", r"$L_\mathrm{a}$"
        ),
        "load_share_coarser": ResultKey(
            "load_share on a grid with half the nodes; null if this grid was not solved"
        ),
        "contact_area": ResultKey(
            f"real area of contact, {what}", area, "real area of contact", r"$A_\mathrm{c}$"
        ),
        "contact_area_share": ResultKey(
            "part of the Hertz zone in which the surfaces touch",
            "",
            "real contact area / Hertz area",
            r"$A_\mathrm{c}/A$",
        ),
        "contact_area_error": ResultKey(
            "error of contact_area by the grid, the larger of two: edges of spots lie between nodes, "
            "and contact_area_share changed from a grid with half the nodes; null without spots"
        ),
        "contact_area_share_coarser": ResultKey("contact_area_share on a grid with half the nodes"),
        "spots": ResultKey(
            "number of spots; nodes that are neighbours along a diagonal only are two spots",
            "",
            "number of spots",
        ),
        "spots_of_one_node": ResultKey("spots that are a single node of the grid, and so are not resolved"),
        "mean_spot": ResultKey(f"mean size of a spot, {what}; null without spots", area),
        "largest_spot": ResultKey(f"largest size of a spot, {what}; null without spots", area),
    }


_OIL: Keys = {
    "mass_error": ResultKey(
        "oil that the film loses and makes, oil_lost + oil_made, over the mean flow through the Hertz zone; "
        "null where the nodes are not equidistant",
        "",
        "error of the oil balance",
    ),
    "oil_lost": ResultKey("part of mass_error that enters spots and does not leave them"),
    "oil_made": ResultKey(
        "part of mass_error that appears where cavitated gaps fill again; where they count as full, each "
        "refilling along a streamline counts, so that it may be above 1"
    ),
}
_FILM: Keys = {
    "mean_film": ResultKey(
        "mean film thickness in the Hertz zone outside of the spots", "m", "mean film around the spots"
    ),
    "least_film": ResultKey("least film thickness in the Hertz zone outside of the spots", "m"),
    **{
        f"film_{k}": ResultKey(
            f"film thickness below which {k} % of the Hertz zone outside of the spots lies", "m"
        )
        for k in (1, 5, 50)
    },
    "rq_deformed": ResultKey(
        "root mean square of the film thickness less that of smooth surfaces, about its mean over the "
        "Hertz zone; null if the smooth contact was not solved",
        "m",
        "deformed composite roughness",
    ),
    "lambda_undeformed": ResultKey(
        "mean film thickness in the Hertz zone, spots included, over rq_combined",
        "",
        "lambda ratio of the mean film",
    ),
    "lambda_deformed": ResultKey("the same film over rq_deformed", "", "lambda ratio, deformed roughness"),
    "boundary_friction": ResultKey(
        "share of asperities in the friction coefficient of sliding, load_share times "
        "contact.boundary_friction; null without that key",
        "",
        "friction coefficient of the asperities",
    ),
}


def _electrical(capacitance: str) -> Keys:
    """Keys of what the spots conduct, with the unit of a capacitance."""
    return {
        "behaviour": ResultKey(
            '"capacitive": no spots, or the film takes ten times their current at 10 kHz; "resistive": the '
            'spots take ten times that of the film, and time_share is at least 0.95; "mixed": all between, '
            "and where contact_area_error is 1 or more and spots carry less than 90 % of the load, as a "
            "finer grid may have no spots"
        ),
        "time_share": ResultKey(
            "share of the time with at least one spot, 1 − (1 − f)^(spots/f) with contact_area_share f",
            "",
            "share of time with a spot",
        ),
        "resistance": ResultKey(
            "resistance of all spots with their tribofilm; null without spots or electric.resistivity, and "
            "for a line contact without discharge.length",
            "ohm",
            "resistance of the spots",
        ),
        "constriction_resistance": ResultKey("part of resistance in the bodies", "ohm"),
        "tribofilm_resistance": ResultKey("part of resistance in the tribofilm", "ohm"),
        "capacitance_outside": ResultKey(
            "capacitance of the film outside of the spots over the domain of the film, by a thin gap",
            capacitance,
            "capacitance around the spots",
        ),
        "impedance_ratio": ResultKey("impedance of capacitance_outside at 10 kHz over resistance"),
        "corner_frequency": ResultKey(
            "frequency above which the film takes more current than the spots", "Hz"
        ),
        **{
            f"breakdown_{k}": ResultKey(
                f"voltage at which {k} % of the Hertz zone outside of the spots reach the dielectric "
                "strength; null without a strength",
                "V",
            )
            for k in (1, 5, 50)
        },
        "breakdown_voltage": ResultKey(
            "voltage at which the film outside of the spots breaks down with a probability of 63.2 %; null "
            "without a Weibull law",
            "V",
        ),
        "breakdown_probability": ResultKey(
            "probability that the film outside of the spots breaks down at the voltage of the case"
        ),
    }


def _keys(area: str, what: str, capacitance: str) -> Keys:
    """Keys with the unit of an area, what a spot is, and the unit of a capacitance."""
    return {**_mechanics(area, what), **_OIL, **_FILM, **_electrical(capacitance)}


LINE_KEYS: Keys = _keys("m", "as a width: a spot is a strip that is as long as the contact", "F/m")
POINT_KEYS: Keys = _keys("m**2", "of the nodes that touch", "F")
