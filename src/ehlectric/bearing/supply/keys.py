"""Keys of summary.json for the parts of the film factor of a bearing."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

SUPPLY_KEYS: Keys = {
    "heat_factor": ResultKey(
        "part of the film factor by the heat, of the inlet by formula or of the solved film; 1 for an "
        "isothermal film; of the ring whose films it reduces more; null where `bearing.film_factor` is a "
        "number, which may stand for more",
        "",
        "film factor of the heat",
    ),
    "inlet_shear_factor": ResultKey(
        "part of the film factor by the heat in the inlet after Wilson and Sheu, also beside that of the "
        "solved film; of the ring where it is smaller; null unless `bearing.film_factor` is "
        '"inlet-shear" or "solved"',
        "",
        "film factor of the heat, by formula",
    ),
    "supply_factor": ResultKey(
        "part of the film factor by the supply of oil: film over the fully flooded one, 1 for "
        '"flooded"; of the ring whose films it reduces more',
        "",
        "film factor of the supply",
    ),
    "film_half_time": ResultKey(
        "time in which the film of the most loaded contact would halve if no oil returned to its track "
        "(van Zoelen, Venner and Lugt); null for a flooded bearing and for rollers",
        "s",
        "half time of the film without supply",
    ),
}
