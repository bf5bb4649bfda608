"""Keys of the table ``meter`` in the summary.json of a contact."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

METER_KEYS: Keys = {
    "capacitance": ResultKey(
        "capacitance that a meter at the two bodies reads: film, gap outside its domain, and in parallel",
        "F",
        "capacitance at the meter",
        r"$C_\mathrm{m}$",
    ),
    "capacitance_air": ResultKey(
        "the same where air fills the whole gap outside the domain", "F", "capacitance at the meter, in air"
    ),
    "capacitance_oil": ResultKey(
        "the same where oil fills the whole gap outside the domain", "F", "capacitance at the meter, in oil"
    ),
    "capacitance_domain": ResultKey(
        "part of the film's domain; with `rq` and a coating other than `discharge.capacitance`",
        "F",
        "capacitance of the domain",
    ),
    "capacitance_hertz": ResultKey("part of the Hertz zone", "F", "capacitance of the Hertz zone"),
    "capacitance_outside": ResultKey(
        "part of the gap outside the domain, filled as `fill` or `oil_radius` says",
        "F",
        "capacitance outside the domain",
    ),
    "capacitance_outside_air": ResultKey("part of the gap outside the domain in air", "F"),
    "capacitance_outside_oil": ResultKey("part of the gap outside the domain in oil", "F"),
    "parallel_capacitance": ResultKey("part in parallel, from the case; null if not given", "F"),
    "share_of_hertz": ResultKey("capacitance_hertz / capacitance", "", "share of the Hertz zone"),
    "share_of_domain": ResultKey("capacitance_domain / capacitance", "", "share of the domain"),
    "share_of_outside": ResultKey("capacitance_outside / capacitance", "", "share of the gap outside"),
    "roughness_factor": ResultKey(
        "capacitance_domain over its value with smooth surfaces; null without `meter.rq`",
        "",
        "roughness factor",
    ),
    "film_ratio": ResultKey(
        "film.minimum_thickness / `meter.rq`; null without it", "", "minimum film / composite roughness"
    ),
    "capacitance_uncoated": ResultKey(
        "capacitance of domain and outer gap without the coating; null without one",
        "F",
        "capacitance without the coating",
    ),
    "coating_capacitance": ResultKey(
        "capacitor in series with capacitance_uncoated that has the same effect; null without a coating",
        "F",
        "capacitance of the coating",
    ),
    "coating_voltage_share": ResultKey(
        "part of the voltage on the coating at the minimum film; null without a coating",
        "",
        "share of the voltage on the coating",
    ),
    "film_voltage_share": ResultKey(
        "part of the voltage on the film at its minimum; null without a coating",
        "",
        "share of the voltage on the film",
    ),
    "film_breakdown_voltage": ResultKey(
        "voltage between the bodies at which the film breaks down; null without a strength of the film",
        "V",
        "breakdown voltage of the film in series",
    ),
    "coating_breakdown_voltage": ResultKey(
        "voltage at which the coating alone breaks down, its strength times its thickness; null without a "
        "strength of the coating",
        "V",
        "breakdown voltage of the coating",
    ),
    "breakdown_voltage": ResultKey(
        "voltage between the bodies at which both film and coating have broken down; null if a strength is "
        "missing",
        "V",
        "breakdown voltage between the bodies",
    ),
    "length": ResultKey(
        "length of a line contact, or given width of a point contact; null if not given", "m"
    ),
    "bodies": ResultKey("bodies that face each other outside the domain"),
    "mismatch": ResultKey(
        "largest relative difference between the film and the gap outside, at the edge of the domain"
    ),
}
