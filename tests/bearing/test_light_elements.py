"""Films of light and of unloaded elements: rigid limits, the room of an element, and no jump between both."""

import numpy as np
import pytest

from ehlectric import BearingCase, InputError, evaluate, solve_bearing
from ehlectric.bearing.bearing_kinds import KINDS
from ehlectric.bearing.solution import ring_state
from ehlectric.bearing.solving import solution_of
from ehlectric.formulas.hertz import dry_contact, line_half_width, line_max_pressure
from tests.helpers.bearings import OTHERS
from tests.helpers.each import each
from tests.helpers.kinds_of_bearings import OIL

PLAY = {"arrangement": "O", "axial_clearance": "20 um"}
PRELOAD = {"arrangement": "O", "preload": "500 N"}
NU = {"base": "NU 208", "radial_clearance": "30 um", "profile": "logarithmic", "radial_load": "330.4 N"}
BALL = {"base": "6208", "radial_clearance": "10 um", "radial_load": "1800 N"}
TAPERED = {"base": "32208", "radial_load": "4 kN", "axial_load": "1 kN"}


def case_of(**bearing):
    """Bearing at 3000 rpm and 70 degC with films of the atlas and its motor."""
    table = {"inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.03 um"}
    return BearingCase.from_dict(
        {
            "contacts": "atlas",
            "bearing": table | bearing,
            "lubricant": OIL,
            "discharge": {"dielectric_strength": "15 V/um"},
            "motor": OTHERS["motor"],
        }
    )


def martin(ring, load):
    """Minimum film of a rigid roller, h = 4.9 eta u R/w; its coefficient is 4.896."""
    per_length = load / ring.conditions.geometry.roller_length
    return 4.896 * ring.oil.viscosity * ring.entrainment_speed * ring.radii.radius_x / per_length


def brewe_hamrock_taylor(ring, load):
    """Minimum film of a rigid ball, 128 a (phi U (0.131 atan(a/2) + 1.683)/W)^2.

    D. E. Brewe, B. J. Hamrock and C. M. Taylor, J. Lubr. Technol. 101 (1979) 231.
    """
    rx, ratio = ring.radii.radius_x, ring.radii.radius_y / ring.radii.radius_x
    side = 1.0 / (1.0 + 2.0 / (3.0 * ratio))
    speed = ring.oil.viscosity * ring.entrainment_speed * rx / load
    return rx * 128.0 * ratio * (side * speed * (0.131 * np.arctan(0.5 * ratio) + 1.683)) ** 2


@each(
    "bearing, law, contacts, error",
    [
        (NU, martin, "atlas", 0.005),
        (NU, martin, "formula", 0.01),
        (BALL, brewe_hamrock_taylor, "atlas", 0.025),
        (BALL, brewe_hamrock_taylor, "formula", 0.1),
    ],
)
def test_light_films_are_those_of_rigid_bodies(bearing, law, contacts, error):
    """Below the least load of the curve, with room for these films."""
    solution = solution_of(case_of(**bearing, film_factor="none").replace({"contacts": contacts}))
    load = np.array([0.05, 0.2, 1.0])
    for ring, curve in ((solution.inner, solution.inner_curve), (solution.outer, solution.outer_curve)):
        state = ring_state(ring, curve, load=load, gap=np.zeros(3), room=np.full(3, 1e-2))
        films = state.values.minimum_thickness
        assert films == pytest.approx(law(ring, load), rel=error)


def test_rollers_that_carry_their_centrifugal_force():
    """3.72 N at the outer ring: Martin's 4.90 um, or the gap where it is narrower, next to the load zone."""
    solution = solution_of(case_of(**NU, film_factor="none"))
    narrow = 0
    for position in solution.positions:
        at, films = position.equilibrium, position.outer.values.minimum_thickness
        free = at.inner_load == 0.0
        assert at.outer_load[free] == pytest.approx(3.718, rel=1e-3)
        wide = at.inner_gap > 6.2e-6
        assert films[wide] == pytest.approx(4.902e-6, rel=0.005)
        close = free & (at.inner_gap < 4.0e-6) & (at.inner_gap > 1.5e-6)
        assert films[close] == pytest.approx(at.inner_gap[close], rel=1e-3)
        narrow += np.count_nonzero(close)
    assert narrow > 0


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("bearing", "key", "values"),
    [
        (NU, "radial_load", [330.465, 330.466]),
        (TAPERED | {"pair": PLAY}, "radial_load", [2963.338, 2963.339, 2965.070, 2965.071]),
        (TAPERED | {"pair": PLAY}, "temperature", [321.622, 321.6221]),
        (TAPERED | {"pair": PRELOAD}, "axial_load", [64.7195, 64.7196]),
        (BALL, "radial_load", [28.255, 28.256]),
    ],
)
def test_a_thousandth_of_a_newton_changes_nothing(bearing, key, values):
    """These inputs, which differ by up to 4e-5, had capacitances that differed by 3 to 11 %."""
    found = evaluate(case_of(**bearing), {f"bearing.{key}": np.array(values)})
    for name in ("capacitance", "margin", "lambda_ratio", "first_break", "ring_to_ring_breakdown"):
        numbers = found[f"bearing.{name}"].values.reshape(-1, 2)
        assert np.all(np.abs(numbers[:, 1] / numbers[:, 0] - 1.0) < 1e-4), name


@pytest.mark.slow
@pytest.mark.parametrize("bearing", [NU, BALL])
def test_a_bearing_is_the_limit_of_its_loads(bearing):
    """Along 400 loads, 0.4 % apart, the capacitance changes by less than 0.4 % from one to the next."""
    loads = np.geomspace(200.0, 1000.0, 400)
    found = evaluate(case_of(**bearing), {"bearing.radial_load": loads})
    assert np.max(np.abs(np.diff(np.log(found["bearing.capacitance"].values)))) < 0.004


B_7208 = {"base": "7208 B"}
C3_6314 = {"base": "6314-C3"}
QJ = {"base": "QJ 208", "radial_clearance": "20 um"}


def same_or_refused(bearing, radial, axial, number):
    """Check of light loads [N]: every point has a capacitance or a reason, as have the first single ones."""
    case = case_of(**bearing, radial_load=float(radial[0]), axial_load=float(axial[0]))
    given = {"bearing.radial_load": np.array(radial), "bearing.axial_load": np.array(axial)}
    found = evaluate(case, given)
    capacitance, solved = found["bearing.capacitance"].values, found["converged"].values
    assert np.all(np.isfinite(capacitance) == solved)
    assert all(bool(reason) != good for reason, good in zip(found["reason"].values, solved, strict=True))
    for k in range(number):
        single = case.replace({key: float(values[k]) for key, values in given.items()})
        if solved[k]:
            assert solve_bearing(single, workers=1).capacitance() == pytest.approx(capacitance[k], rel=1e-7)
        else:
            with pytest.raises(InputError):
                solve_bearing(single, workers=1)
    return found


@each(
    "bearing, radial, axial",
    [
        (B_7208, [1.0, 0.8, 1.5, 2.0, 3.0], [1.0] * 5),
        (C3_6314, [4.8], [3.0]),
        (QJ, [3.0], [3.0]),
    ],
)
def test_films_thicker_than_the_room_at_some_elements(bearing, radial, axial):
    """Elements with 2 % of the largest load had films of 0.1 to 43 mm by their load, and no capacitance."""
    found = same_or_refused(bearing, radial, axial, 1)
    assert found["converged"].values[0]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    "bearing",
    [
        {"base": "6208", "radial_clearance": "10 um"},
        C3_6314,
        {"base": "7208-c"},
        B_7208,
        QJ,
        {"base": "7208-c", "pair": {"arrangement": "X", "axial_clearance": "10 um"}},
    ],
)
def test_light_loads_have_a_capacitance_or_a_reason(bearing):
    rng = np.random.default_rng(6)
    radial, axial = 10.0 ** rng.uniform(-0.5, 1.5, (2, 12))
    same_or_refused(bearing, radial, axial, 2)


def test_the_refusal_of_a_thick_film_names_the_room_and_the_remedies():
    """There is room for a tenth of (f - 1/2) D, here of 0.02 times 11.906 mm."""
    case = case_of(**B_7208, radial_load=0.5, axial_load=1.0)
    with pytest.raises(
        InputError, match=r"room for at most 23\.8 um; expected a thinner film; raise the load"
    ):
        solve_bearing(case, workers=1)


def test_light_contacts_change_as_dry_ones():
    """Exponents of pressure, width along and width across over the load, by Hertz' formulas of two loads."""
    balls = (dry_contact(load, 4e-3, 50e-3, 220e9) for load in (1.0, 2.0))
    values = [(one.max_pressure, one.semi_axis_x, one.semi_axis_y) for one in balls]
    line = {"radius": 4e-3, "modulus": 220e9}
    rollers = [
        (
            line_max_pressure(load_per_length=load, **line),
            line_half_width(load_per_length=load, **line),
            1.0,  # the length of a roller
        )
        for load in (1e3, 2e3)
    ]
    for name, (one, twice) in {"deep-groove ball": values, "cylindrical roller": rollers}.items():
        assert KINDS[name].dry_exponents == pytest.approx(np.log2(np.divide(twice, one)), abs=1e-9)
