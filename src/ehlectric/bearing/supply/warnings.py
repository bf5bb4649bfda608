"""Warnings of what the film factor of a bearing leaves out, and of the supply of oil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.supply.decay import half_time
from ehlectric.errors import ResultWarning

# Supply factor below which the layer of oil on the tracks sets the film rather than speed and viscosity: the
# flooded film is then about twice as thick as the layer, or more.
_LOW = 0.5

# Film factor below which films differ from it by more than some per cent, as the speed at which they are
# computed is reduced with one exponent for all contacts: for balls from the atlas 5 % here, 16 % at 0.1.
_FAR = 0.5

# Half time of a film without supply [s] below which a bearing runs for long without it: all but slow ones.
_SOON = 3600.0

# Heat of a film factor in words.
_HEAT: Mapping[object, str] = {
    "inlet-shear": "the heat in the inlet",
    "solved": "the solved heat in the film in pure rolling",
}

# Ways of supply that bring little or no oil to the track at each passage.
_SPARSE = ("grease", "oil-air")


def film_note(solution: BearingSolution) -> ResultWarning:
    """Note about the effects that the films neglect, so that breakdown voltages are upper bounds."""
    bearing = solution.case.bearing
    factor, supply = bearing.film_factor, bearing.supply
    name = factor if isinstance(factor, str) else f"{factor:g}"
    if solution.conditions.film_factor == 1.0:
        return ResultWarning(
            "isothermal-film",
            f"bearing.film_factor is {name}: the films are isothermal, fully flooded, smooth, so "
            'breakdown voltages are upper bounds; "inlet-shear", "solved" or a number below 1 gives thinner '
            "films",
        )
    left, found = "any starvation and heat beyond this factor", f"{solution.conditions.film_factor:.3g}"
    if supply != "flooded":
        given = isinstance(factor, float) and factor != 1.0
        other = f"a given factor of {factor:.3g}" if given else _HEAT.get(factor)
        found += f", of {other} and the supply of oil" if other else ", of the supply of oil"
    elif factor in _HEAT:
        left, found = "starvation and grease", f"{found}, of {_HEAT[factor]}"
    if factor == "solved":
        left = f"{left}, spin and sliding"
    return ResultWarning(
        "smooth-film",
        f"the film factor is {found}: the films are smooth, and {left} are neglected as well as roughness, "
        "so breakdown voltages are upper bounds",
    )


def supply_words(solution: BearingSolution) -> str:
    """Parts of the film factor with a supply, as "0.939 of the flooded thickness by grease"."""
    supply, found = solution.case.bearing.supply, solution.conditions.supply_factor
    by = f" by {supply}" if solution.case.bearing.by_supply_rule else ""
    heat = solution.case.bearing.film_factor
    more = f" and a given factor of {heat:.3g}" if isinstance(heat, float) else ""
    more = {"inlet-shear": " and inlet shear heating", "solved": " and solved heat"}.get(str(heat), more)
    return f"{found:.3g} of the flooded thickness{by}{more}"


def supply_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of a film factor by rule, of a starved film, and of a film that supply has to maintain."""
    total = solution.conditions.film_factor
    if total < _FAR:
        yield ResultWarning(
            "film-factor-low",
            f"the film factor of {total:.3g} acts by a lower entrainment speed, with one exponent for all "
            "contacts: films may come out thinner than this share, by up to 5 % at 0.5 and 16 % at 0.1",
        )
    supply, found = solution.case.bearing.supply, solution.conditions.supply_factor
    if supply == "flooded" or found is None:
        return
    if solution.case.bearing.by_supply_rule:
        yield ResultWarning(
            "supply-rule",
            f"supply {supply!r} leaves {found:.3g} of the flooded film by SKF's replenishment factor, "
            "published for the rolling friction at steady speed, load and temperature, and not for films; "
            "give a measured share as bearing.supply",
        )
    if found < _LOW:
        yield ResultWarning(
            "supply-low",
            f"the supply leaves {found:.3g} of the flooded film: such a film is about as thick as the layer "
            "of oil on the tracks, and hardly follows speed and viscosity; measure the film",
        )
    time = half_time(solution)
    if supply in _SPARSE and time is not None and time < _SOON:
        yield ResultWarning(
            "film-decays",
            f"without oil that returns to the track, the film of the most loaded contact halves within "
            f"{time:.2g} s: the film of supply {supply!r} is set by what returns, and no formula predicts "
            "it over time",
        )
