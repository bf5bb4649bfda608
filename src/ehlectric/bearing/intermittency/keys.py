"""Keys of summary.json for the asperities of a bearing: regime, shares of time, and load shares."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

DUTY_KEYS: Keys = {
    "regime": ResultKey(
        'what the bearing is electrically, in one word: "capacitive" up to a contact_time_share of 1 %, '
        '"resistive" above 99 %, else "intermittent"; with a lambda_ratio below 1 it is not called '
        "capacitive, but for ceramic elements and a coating, which insulate",
        "",
        "electrical regime",
    ),
    "contact_time_share": ResultKey(
        "share of time in which metallic contacts short the bearing: elements in parallel, both contacts of "
        "an element in series, mean over the positions; 0 for ceramic elements and with a coating",
        "",
        "share of time with contact",
    ),
    "insulating_time_share": ResultKey(
        "share of time in which no element touches both rings, and the breakdown voltages can be reached at "
        "all: 1 - touching_time_share",
        "",
        "share of time without contact",
    ),
    "touching_time_share": ResultKey(
        "share of time in which at least one element touches both rings, whether or not it conducts",
        "",
        "share of time in which an element touches both rings",
    ),
    "clarke_time_share": ResultKey(
        "touching_time_share with Clarke's 1 - erf(λ) for each contact; with `[bearing.summits]` beside the "
        "one from the number of spots",
        "",
        "share of time with contact, after Clarke",
    ),
    "contact_model": ResultKey(
        'what contact_time_share of each contact is from: "clarke", or "greenwood_williamson" with '
        "`[bearing.summits]`"
    ),
    "inner_lambda_ratio": ResultKey(
        "minimum film of the loaded contacts with the inner ring / composite_rq",
        "",
        "minimum film / roughness, inner ring",
        r"$\lambda_\mathrm{i}$",
    ),
    "outer_lambda_ratio": ResultKey(
        "minimum film of the loaded contacts with the outer ring / composite_rq",
        "",
        "minimum film / roughness, outer ring",
        r"$\lambda_\mathrm{o}$",
    ),
    "inner_contact_time_share": ResultKey(
        "maximum share of time with metallic contact of a contact with the inner ring",
        "",
        "share of time with contact, inner ring",
    ),
    "outer_contact_time_share": ResultKey(
        "maximum share of time with metallic contact of a contact with the outer ring",
        "",
        "share of time with contact, outer ring",
    ),
    "asperity_share": ResultKey(
        "maximum share of a contact's load that asperities carry, after Patir and Cheng's exp(-1.8 λ^1.2) "
        "with the λ of the central film",
        "",
        "asperity load share",
    ),
    "asperity_share_low": ResultKey(
        "least share of that contact by the published laws, each within its range", "", "asperity load share"
    ),
    "asperity_share_high": ResultKey(
        "largest share of that contact by the published laws", "", "asperity load share"
    ),
    "expected_spots": ResultKey(
        "maximum expected number of simultaneous spots in a contact; null without `[bearing.summits]`",
        "",
        "expected spots in a contact",
    ),
}

# Keys of a row of ``contacts``.
CONTACT_DUTY_KEYS: Keys = {
    "central_lambda_ratio": ResultKey("central_thickness / composite_rq; null without load"),
    "asperity_share": ResultKey(
        "share of the load on asperities, after Patir and Cheng; of the central film"
    ),
    "asperity_share_low": ResultKey("least of the published laws, each within its range"),
    "asperity_share_high": ResultKey("largest of the published laws"),
    "contact_probability": ResultKey(
        "share of time with metallic contact by Clarke's 1 - erf(central_lambda_ratio)"
    ),
    "expected_spots": ResultKey(
        "expected number of simultaneous spots in the Hertz area; null without `[bearing.summits]`"
    ),
    "contact_time_share": ResultKey(
        "share of time with metallic contact: 1 - exp(-expected_spots), or contact_probability without them"
    ),
}
