"""Places of the flank at which a mesh breaks down, by a Weibull law."""

import numpy as np
import pytest

import ehlectric
from ehlectric.cases.gear_case import GearCase
from ehlectric.figures.gear_panels import over_flank
from ehlectric.gear import discharge_places
from tests.gear.pairs import case_of
from tests.helpers.places import EXAMPLES

RA = "gear.flank_ra"
SHAPE = "gear.contact.weibull_shape"
HELICAL = GearCase.from_toml(EXAMPLES / "gear_pair.toml")


def places_of(case):
    result = ehlectric.solve_gear(case, probable=False)
    return result, discharge_places(result.solution)


@pytest.mark.parametrize("case", [HELICAL, case_of(flank_ra="0.03 um")], ids=["helical", "spur"])
def test_shares_are_integrals_over_the_plane_of_action(case):
    """Against the film on a grid of equal cells of the flank, where it carries load."""
    result, where = places_of(case)
    g, _, film = over_flank(result, result.solution.films.minimum)
    gap = film - result.solution.summits
    weight = np.where(gap > 0.0, np.where(gap > 0.0, gap, 1.0) ** -10.0, 0.0)
    root = np.sum(weight[g <= result.solution.path.pitch_point]) / np.sum(weight)
    assert where.before(result.solution.path.pitch_point) == pytest.approx(root, abs=0.02)
    inside = film <= where.film_around(0.9)
    assert np.sum(weight[inside]) / np.sum(weight) == pytest.approx(0.9, abs=0.04)


def test_a_strength_that_scatters_widely_breaks_down_everywhere():
    """The shape 0 distributes breakdowns over the area; a large shape takes them to the thinnest film."""
    (_, even), (_, sharp) = (places_of(HELICAL.replace({SHAPE: shape})) for shape in (1e-9, 100.0))
    assert even.area_share(0.9) == pytest.approx(0.9, abs=0.01)
    assert sharp.area_share(0.9) < 0.2
    assert sharp.film_around(0.9) < even.film_around(0.1)
    assert np.sum(even.areas) == pytest.approx(1.0)


def test_summits_that_touch_have_no_place_of_breakdown():
    result, where = places_of(HELICAL.replace({RA: "0.2 um"}))
    assert where is None
    assert result.summary()["mesh"]["discharge_root_share"] is None


def test_exchanged_gears_break_down_on_the_other_side():
    """With the opposite torque the gears exchange their parts: A to C of one is C to E of the other."""
    case = case_of(flank_ra="0.03 um", teeth=[20, 20], centre_distance="92 mm", profile_shift=[0.22, 0.22])
    case = case.replace({"gear.tip_diameter": None})
    shares = []
    for torque in (200.0, -200.0):
        result, where = places_of(case.replace({"gear.operation.pinion_torque": torque}))
        shares.append(where.before(result.solution.path.pitch_point))
    assert shares[0] == pytest.approx(shares[1])
    assert shares[0] == pytest.approx(0.5, abs=0.03)
