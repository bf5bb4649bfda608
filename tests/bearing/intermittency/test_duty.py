"""Share of time in which a bearing conducts, its regime, and the load shares of its asperities."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from ehlectric.bearing.bearing_touching import CAPACITIVE, RESISTIVE, behaviour_of, duty_of
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import contact_rows, summary_of
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

# Oil of an axle drive (assumption): 18 and 4.2 mm2/s.
THIN = {
    "lubricant__temperature": {
        "kinematic_viscosity_40": "18 mm^2/s",
        "kinematic_viscosity_100": "4.2 mm^2/s",
        "density_15": "840 kg/m^3",
    },
    "bearing__temperature": "100 degC",
    "bearing__axial_load": None,
    "contacts": "atlas",
}
SUMMITS = {"bearing__summits": {"density": "2e9 1/m^2", "radius": "50 um"}}


def solved(tables=BALLS, **changes):
    return solve_bearing(bearing_case(tables, **(THIN | changes)), workers=1).solution


def totals(solution):
    return summary_of(solution)["bearing"]


@pytest.mark.parametrize(
    ("speed", "ratio", "regime"),
    [("1000 rpm", 1.1, "intermittent"), ("3000 rpm", 2.3, "capacitive"), ("15000 rpm", 6.8, "capacitive")],
)
def test_lambda_ratios_of_a_thin_oil(speed, ratio, regime):
    """Lambda by the formula of Hamrock and Dowson, up to 15 % above solved films; 0.03 um, 6208, 100 degC."""
    found = totals(solved(bearing__inner_speed=speed))
    assert 0.84 * ratio < found["lambda_ratio"] < ratio
    assert found["inner_lambda_ratio"] == found["lambda_ratio"] < found["outer_lambda_ratio"]
    assert found["electrical_behaviour"] == regime


def test_shares_follow_from_clarke_s_fit_by_hand():
    """Product over the elements, written out, at each position of the cage."""
    solution = solved(bearing__inner_speed="1000 rpm")
    shares = []
    for position in solution.positions:
        open_time = 1.0
        for k in range(9):
            both = 1.0
            for ring in position.rings:
                loaded, film = ring.load[k] > 0.0, ring.values.central_thickness[k]
                both *= math.erfc(film / 0.03e-6) if loaded else 0.0
            open_time *= 1.0 - both
        shares.append(1.0 - open_time)
    found = totals(solution)
    assert found["contact_time_share"] == pytest.approx(sum(shares) / len(shares), rel=1e-12, abs=0.0)
    assert found["contact_time_share"] == found["clarke_time_share"] == found["touching_time_share"]
    assert found["insulating_time_share"] == 1.0 - found["touching_time_share"]


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_rows_of_contacts(tables):
    changes = {"bearing__composite_rq": "0.1 um"}
    rows = contact_rows(solved(tables, **changes))
    loaded = [row for row in rows if row["solved"]]
    assert len(loaded) < len(rows)
    for row in loaded:
        ratio = row["central_thickness"] / 1e-7
        assert row["central_lambda_ratio"] == pytest.approx(ratio, rel=1e-12, abs=0.0)
        patir_cheng = math.exp(-1.8 * ratio**1.2)
        assert row["asperity_share"] == pytest.approx(patir_cheng, rel=1e-12, abs=0.0)
        assert row["asperity_share_low"] <= row["asperity_share"] <= row["asperity_share_high"]
        assert row["contact_time_share"] == row["contact_probability"] > 0.0
    for row in rows:
        if not row["solved"]:
            assert row["contact_time_share"] == row["asperity_share"] == 0.0
            assert row["central_lambda_ratio"] is None


def test_the_johnson_fit_is_no_lower_end_beyond_its_range():
    """It ends at 0 near lambda 1.75; the least of the others counts from there on."""
    rows = contact_rows(solved(bearing__composite_rq="0.02 um"))
    beyond = [row for row in rows if row["solved"] and row["central_lambda_ratio"] > 1.8]
    assert beyond
    assert all(row["asperity_share_low"] > 0.0 for row in beyond)


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_spots_in_the_hertz_area(tables):
    """Without a bandwidth n F_0(d/Rq) spots per area, with the mean gap d + Rq F_1(d/Rq) as the film."""
    changes = {"bearing__composite_rq": "0.1 um", **SUMMITS}
    rows = [row for row in contact_rows(solved(tables, **changes)) if row["solved"]]
    for row in rows:
        factor = 4.0 if tables is ROLLERS else math.pi
        area = factor * row["semi_axis_x"] * row["semi_axis_y"]
        # Level l of the number of spots, from F_0(l) = erfc(l/sqrt 2)/2 by bisection.
        low, high = -8.0, 37.0
        for _ in range(200):
            level = 0.5 * (low + high)
            more = 0.5 * math.erfc(level / math.sqrt(2.0)) * 2e9 * area > row["expected_spots"]
            low, high = (level, high) if more else (low, level)
        density = math.exp(-0.5 * level**2) / math.sqrt(2.0 * math.pi)
        above = density - level * 0.5 * math.erfc(level / math.sqrt(2.0))
        assert 1e-7 * (level + above) == pytest.approx(row["central_thickness"], rel=1e-6, abs=0.0)
        share = -math.expm1(-row["expected_spots"])
        assert row["contact_time_share"] == pytest.approx(share, rel=1e-12, abs=0.0)


def test_summits_are_named_beside_clarke_s_fit():
    found, plain = totals(solved(**SUMMITS)), totals(solved())
    assert (found["contact_model"], plain["contact_model"]) == ("greenwood_williamson", "clarke")
    assert found["clarke_time_share"] == plain["contact_time_share"]
    assert found["expected_spots"] > 1.0
    assert plain["expected_spots"] is None
    # Summits of unloaded Gaussian roughness touch far above the lambda at which contacts are measured.
    assert found["contact_time_share"] > 1e3 * plain["contact_time_share"]


def test_the_real_area_is_proportional_to_the_radius_of_the_summits():
    """A share pi n beta sigma_s F_1 of the Hertz area, which is a factor beta, while F_0 counts the spots."""
    once, twice = (
        totals(solved(bearing__summits=SUMMITS["bearing__summits"] | {"radius": radius}))
        for radius in ("50 um", "100 um")
    )
    assert twice["real_area"] == pytest.approx(2.0 * once["real_area"], rel=1e-12, abs=0.0)
    assert twice["expected_spots"] == once["expected_spots"]
    assert totals(solved())["real_area"] is None


def test_a_bandwidth_lifts_the_summits():
    """They lie 4 Rq/sqrt(pi alpha) above the surface, and their heights scatter less."""
    keys = SUMMITS["bearing__summits"]
    spots = [
        totals(solved(bearing__summits=keys | {"bandwidth": alpha} if alpha else keys))["expected_spots"]
        for alpha in (None, 1e6, 100.0, 3.0)
    ]
    assert spots[1] == pytest.approx(spots[0], rel=0.02, abs=0.0)
    assert spots[1] < spots[2] < spots[3]


def test_summits_of_one_height_all_touch():
    keys = SUMMITS["bearing__summits"] | {"height_deviation": "0.1 nm"}
    rows = contact_rows(solved(bearing__summits=keys, bearing__composite_rq="1 um"))
    row = rows[0]
    whole = 2e9 * math.pi * row["semi_axis_x"] * row["semi_axis_y"]
    assert row["expected_spots"] == pytest.approx(whole, rel=1e-9, abs=0.0)
    assert row["contact_time_share"] == 1.0


def test_worn_summits_touch_less():
    """Worn to two deviations nothing touches beyond two; spots of thinner films stay."""
    keys = SUMMITS["bearing__summits"] | {"highest": 2.0}
    changes = {"bearing__composite_rq": "0.04 um"}
    whole, worn = (
        contact_rows(solved(bearing__summits=one, **changes)) for one in (SUMMITS["bearing__summits"], keys)
    )
    loaded = [(a, b) for a, b in zip(whole, worn, strict=True) if a["solved"]]
    thin = [pair for pair in loaded if pair[0]["central_lambda_ratio"] < 1.9]
    thick = [pair for pair in loaded if pair[0]["central_lambda_ratio"] > 2.1]
    assert thin
    assert thick
    assert all(b["expected_spots"] == pytest.approx(a["expected_spots"], rel=1e-12) for a, b in thin)
    assert all(b["expected_spots"] == 0.0 < a["expected_spots"] for a, b in thick)


def test_ceramic_elements_and_coatings_insulate():
    coating = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "45 cm^2"}
    rough = {"bearing__composite_rq": "0.3 um"}
    plain = totals(solved(**rough))
    assert plain["electrical_behaviour"] != "capacitive"
    for changes in ({"bearing__element_material": "silicon-nitride"}, {"bearing__coating": coating}):
        found = totals(solved(**rough, **changes))
        assert found["contact_time_share"] == 0.0
        assert found["touching_time_share"] > 0.1
        assert found["electrical_behaviour"] == "capacitive"


def test_regimes_by_their_limits():
    assert behaviour_of(CAPACITIVE) == "capacitive"
    assert behaviour_of(np.nextafter(CAPACITIVE, 1.0)) == "intermittent"
    assert behaviour_of(RESISTIVE) == "intermittent"
    assert behaviour_of(np.nextafter(RESISTIVE, 1.0)) == "resistive"
    rough = [
        totals(solved(bearing__composite_rq=rq))["electrical_behaviour"]
        for rq in ("0.01 um", "0.1 um", "10 um")
    ]
    assert rough == ["capacitive", "intermittent", "resistive"]


def test_a_bearing_without_voltages_is_not_called_capacitive():
    """Lambda just below 1: the share of time is a few per cent, and less where one element is loaded."""
    solution = solved(bearing__inner_speed="1000 rpm")
    scale = 0.999 / totals(solution)["lambda_ratio"]
    assert duty_of(solution, film_scale=scale).behaviour == "intermittent"
    assert behaviour_of(1e-6, touching=True) == "intermittent"


def test_thicker_films_touch_less():
    solution = solved()
    shares = [duty_of(solution, film_scale=scale).contact_time_share for scale in (0.1, 0.5, 1.0, 2.0)]
    assert shares == sorted(shares, reverse=True)
    assert shares[0] > 0.5 > shares[-1]


def test_either_deviation_or_bandwidth():
    keys = SUMMITS["bearing__summits"] | {"height_deviation": "0.1 um", "bandwidth": 5.0}
    with pytest.raises(InputError, match=r"summits\.height_deviation: "):
        bearing_case(BALLS, bearing__summits=keys)
    case = bearing_case(BALLS, bearing__summits=SUMMITS["bearing__summits"] | {"bandwidth": 5.0})
    changed = case.replace({"bearing.summits.height_deviation": 1e-7})
    assert changed.bearing.summits.bandwidth is None


@pytest.mark.slow
def test_summits_that_touch_a_full_film_leave_no_green_verdict():
    """Above lambda 3 without a warning by lambda alone; the summits say that contacts short it at times."""
    keys = {"bearing__inner_speed": "5500 rpm", "discharge__dielectric_strength": "100 V/um"}
    dense = {"bearing__summits": {"density": "2e10 1/m^2", "radius": "10 um"}}
    plain, touched = (
        solve_bearing(bearing_case(BALLS, **(THIN | keys | more)), workers=1) for more in ({}, dense)
    )
    found = touched.summary()
    assert found["bearing"]["lubrication_state"] == "full film"
    assert found["bearing"]["electrical_behaviour"] != "capacitive"
    assert "partial-film" in found["warning_codes"]
    assert "partial-film" not in plain.summary()["warning_codes"]
    assert (plain.verdict.level, touched.verdict.level) == ("green", "yellow")


def test_real_area_of_elements_that_touch():
    """Hertz area times pi n beta Rq F_1(l), while at least one spot is there, of the smaller contact.

    Mean over time of the sum over the elements that touch both rings, over the time in which any does.
    """
    solution = solved(bearing__composite_rq="0.1 um", **SUMMITS)
    duty, areas, numbers, times = duty_of(solution), [], [], []
    for position, rings in zip(solution.positions, duty.rings, strict=True):
        pairs, loaded = [], position.inner.solved & position.outer.solved
        for ring, found in zip(position.rings, rings, strict=True):
            hertz = math.pi * (ring.values.semi_axis_x * ring.values.semi_axis_y)[loaded]
            spots = found.expected_spots[loaded]
            level = norm.isf(spots / (2e9 * hertz))
            overlap = norm.pdf(level) - level * norm.sf(level)
            share = -np.expm1(-spots)
            pairs.append((share, hertz * math.pi * 2e9 * 50e-6 * 1e-7 * overlap / share))
        (inner, first), (outer, second) = pairs
        numbers.append(np.sum(inner * outer))
        areas.append(np.sum(inner * outer * np.minimum(first, second)))
        times.append(1.0 - np.prod(1.0 - inner * outer))
    assert duty.real_area == pytest.approx(np.sum(areas) / np.sum(times), rel=1e-6, abs=0.0)
    assert duty.closed == pytest.approx(np.sum(numbers) / np.sum(times), rel=1e-6)
    assert 1.0 < duty.closed < len(hertz)
    assert 0.0 < duty.real_area < 0.1 * np.sum(hertz)


def test_rare_spots_are_met_one_at_a_time():
    """Far apart, spots have the mean area pi beta Rq F_1/F_0, whatever their number."""
    few, fewer = (
        duty_of(
            solved(
                bearing__composite_rq="0.02 um",
                bearing__summits={"density": density, "radius": "50 um"},
            )
        )
        for density in ("1e7 1/m^2", "1e6 1/m^2")
    )
    assert 0.0 < few.rings[0][0].expected_spots[0] < 2e-3
    assert few.real_area == pytest.approx(fewer.real_area, rel=1e-3, abs=0.0)
    assert few.closed == pytest.approx(1.0, rel=1e-3)
    assert duty_of(solved()).real_area is None
