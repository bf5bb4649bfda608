"""Assessment of gaps whose discharge has a closed form: plates, a cylinder and a sphere over a plane."""

import math

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import dblquad, quad

from ehlectric import Case
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.discharge.assessment import assess, discharge_warnings
from ehlectric.discharge.film_capacitance import at_columns
from ehlectric.field.zones import areas, line_zone_areas, node_areas, part_widths, point_zone_areas
from tests.cases.test_point_case import point
from tests.conftest import PAPER_CONTACT
from tests.discharge.gap_films import line_gap, line_gap_field, point_gap, point_gap_field
from tests.field.exact_fields import near, sinusoidal_wall
from tests.helpers.each import each

PERMITTIVITY = 2.2
OIL = {"base": "paper", "permittivity_law": "constant", "relative_permittivity": PERMITTIVITY}
LENGTH = 0.01
WEIBULL = {"scale": "10 V/um", "shape": 8.0, "reference_area": "0.01 mm^2"}
COSTS = {
    "external_capacitance": "1 nF",
    "conductivity": "1 pS/m",
    "peak_current": "300 mA",
    "pit": {"efficiency": 0.1, "melting_energy": "10 GJ/m^3"},
}


def line_case(**discharge):
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": OIL, "discharge": discharge})
    return case, resolve(case)


def point_case(contact=None, **discharge):
    case = point(contact, lubricant=OIL, discharge=discharge)
    return case, resolve_point(case)


def assessed(case, conditions, film, field):
    return assess(case.discharge, case.oil, conditions.semi_axes, film, field)


def plates(gap, voltage, **discharge):
    """Over -4 b < x < 2 b, the field solved for abs(x) < 1.25 b."""
    case, conditions = line_case(length=LENGTH, **discharge)
    b = conditions.half_width
    x = np.linspace(-4.0 * b, 2.0 * b, 241)
    film = line_gap(x, np.full_like(x, gap))
    field = line_gap_field(
        film, np.abs(x) < 1.26 * b, voltage=voltage, permittivity=PERMITTIVITY
    )  # the nodes at 1.25 b are the last
    return assessed(case, conditions, film, field), b


def test_plates():
    """1 um apart at 4 V; the strength of 15 V/um is reached at 15 V. Capacitance eps0 eps/h per area."""
    found, b = plates(1e-6, 4.0, dielectric_strength="15 V/um", **COSTS)
    per_width = epsilon_0 * PERMITTIVITY / 1e-6
    assert found.strength_law == "constant"
    assert found.dielectric_strength == 15e6
    assert found.breakdown_voltage == near(15.0, 1e-10)
    assert found.margin == near(15.0 / 4.0, 1e-10)
    assert found.probability == 0.0
    assert found.zone_size == near(2.5 * b, 1e-10)  # all of the field's range
    assert found.zone_area == near(2.5 * b * LENGTH, 1e-10)
    assert found.zone_over_half_width == near(2.5, 1e-10)
    assert found.zone_over_largest_pit == near(2.5 * b / 4e-6, 1e-10)
    assert found.zone_over_mean_pit == near(2.5 * b / 1.7e-6, 1e-10)
    for name, widths in {"": 6.0, "_hertz": 2.0, "_inlet": 3.0, "_outlet": 1.0, "_plate": 2.0}.items():
        assert getattr(found, f"capacitance{name}") == near(widths * b * per_width, 1e-10), name
    assert found.capacitance_ratio == near(3.0, 1e-10)
    assert found.capacitance_sides is None
    capacitance = 6.0 * b * per_width * LENGTH
    assert found.contact_energy == near(8.0 * capacitance, 1e-10)
    assert found.discharge_energy == near(8.0 * (capacitance + 1e-9), 1e-10)
    assert found.breakdown_energy == near(112.5 * (capacitance + 1e-9), 1e-10)
    assert found.pit_volume == near(0.8 * (capacitance + 1e-9) / 10e9, 1e-10)
    assert found.pit_diameter == near(math.cbrt(12.0 * found.pit_volume / math.pi), 1e-12)
    # 0.3 A over 2 b L, A/m^2; the limits in A/mm^2 are 0.1, 0.3 and 0.8.
    assert found.current_density == near(0.3 / (2.0 * b * LENGTH), 1e-12)
    assert [limit * 1e-6 for limit in found.current_density_limits] == pytest.approx([0.1, 0.3, 0.8])
    assert found.relaxation_time == near(epsilon_0 * PERMITTIVITY / 1e-12, 1e-12)
    assert found.corner_frequency == near(1.0 / (2.0 * math.pi * found.relaxation_time), 1e-12)


def test_plates_with_nothing_given():
    """What the case does not say stays None; capacitances and the zone need nothing."""
    case, conditions = line_case()
    x = np.linspace(-4.0, 2.0, 61) * conditions.half_width
    film = line_gap(x, np.full_like(x, 1e-6))
    found = assessed(case, conditions, film, line_gap_field(film, slice(20, 50)))
    known = {name for name, value in found.summary().items() if value is not None} - {"sources"}
    assert known == {
        "zone_position", "zone_size", "zone_over_half_width", "zone_over_largest_pit", "zone_over_mean_pit",
        "capacitance", "capacitance_beyond", "capacitance_hertz", "capacitance_inlet", "capacitance_outlet",
        "capacitance_plate", "capacitance_ratio", "capacitance_outlet_full", "capacitance_outlet_fingers",
        "capacitance_outlet_layers", "capacitance_full", "capacitance_fingers", "capacitance_layers",
        "outlet",
    }  # fmt: skip


@pytest.mark.parametrize("voltage", [2.0, 9.0, 14.0])
def test_weibull_of_plates(voltage):
    """P = 1 - exp(-(V/(h E0))^m A/A0), A all of the film's domain, V at 63.2 % = h E0 (A0/A)^(1/m)."""
    found, b = plates(1e-6, voltage, weibull=WEIBULL)
    ratio = 6.0 * b * LENGTH / 1e-8
    characteristic = 1e-6 * 10e6 * ratio ** (-1.0 / 8.0)
    assert found.strength_law == "weibull"
    assert found.dielectric_strength is None
    assert found.probability == near(-math.expm1(-ratio * (voltage / 10.0) ** 8), 1e-9)
    assert found.breakdown_voltage == near(characteristic, 1e-10)
    assert found.margin == near(characteristic / voltage, 1e-10)
    low, high = (characteristic * (-math.log(1.0 - p)) ** 0.125 for p in (0.05, 0.95))
    assert found.breakdown_voltage_low == near(low, 1e-10)
    assert found.breakdown_voltage_high == near(high, 1e-10)


@each("kind", ["dielectric_strength", "pressure", "temperature", "weibull"])
def test_twice_the_length(kind):
    """Of a line: twice the energy of the contact, half the current density, the breakdown voltage of a
    constant strength the same, that of Weibull's law lower by 2^(1/m).
    """
    laws = {
        "dielectric_strength": {"dielectric_strength": 15e6},
        "pressure": {"strength_table": {"pressure": [0, 1e9], "strength": [15e6, 30e6]}},
        "temperature": {
            "strength_table": {"temperature": [300, 400], "strength": [15e6, 10e6]},
            "temperature": 320,
        },
        "weibull": {"weibull": WEIBULL},
    }
    case, conditions = line_case(length=LENGTH, peak_current=1, **laws[kind])
    x = np.linspace(-4.0, 2.0, 61) * conditions.half_width
    film = line_gap(x, np.full_like(x, 1e-6))
    field = line_gap_field(film, slice(20, 50))
    one, two = (
        assessed(case.replace({"discharge.length": length}), conditions, film, field)
        for length in (LENGTH, 2.0 * LENGTH)
    )
    assert two.contact_energy == near(2.0 * one.contact_energy, 1e-12)
    assert two.zone_area == near(2.0 * one.zone_area, 1e-12)
    assert two.current_density == near(0.5 * one.current_density, 1e-12)
    assert two.capacitance == one.capacitance
    lower = 2.0 ** (-1.0 / 8.0) if kind == "weibull" else 1.0
    assert two.breakdown_voltage == near(lower * one.breakdown_voltage, 1e-12)
    # 13 V/um at 320 K by linear interpolation; the pressure is 0.
    strength = {"temperature": 14e6, "weibull": None}.get(kind, 15e6)
    assert one.dielectric_strength == (strength and near(strength, 1e-14))


CYLINDER, LEAST = (
    0.1,
    0.5e-6,
)  # a slope of 0.006 at the end of the field, whose square tells it from a thin gap


@pytest.fixture(scope="module")
def cylinder():
    """A rigid one over a plane at 3 V: gap h0 + x^2/2R, the oil leaving it at the end of the domain."""
    case, conditions = line_case(length=LENGTH, weibull=WEIBULL)
    x = np.linspace(-4.0, 2.0, 3201) * conditions.half_width
    film = line_gap(x, LEAST + 0.5 * x**2 / CYLINDER)
    field = line_gap_field(
        film, np.abs(x) <= 1.25 * conditions.half_width, voltage=3.0, permittivity=PERMITTIVITY
    )
    return assessed(case, conditions, film, field), conditions.half_width


def test_zones_of_a_cylinder(cylinder):
    """Integral of eps0 eps/(h0 + x^2/2R): eps0 eps sqrt(2R/h0) arctan(x/sqrt(2R h0))."""
    found, b = cylinder
    scale = math.sqrt(2.0 * CYLINDER * LEAST)

    def primitive(x):
        return epsilon_0 * PERMITTIVITY * math.sqrt(2.0 * CYLINDER / LEAST) * math.atan(x / scale)

    ends = {"hertz": (-b, b), "inlet": (-4.0 * b, -b), "outlet": (b, 2.0 * b)}
    for zone, (start, stop) in ends.items():
        exact = primitive(stop) - primitive(start)
        assert getattr(found, f"capacitance_{zone}") == near(exact, 2e-5), zone
    assert found.capacitance == near(primitive(2.0 * b) - primitive(-4.0 * b), 2e-5)
    plate = epsilon_0 * PERMITTIVITY * 2.0 * b / LEAST
    assert found.capacitance_plate == near(plate, 1e-5)  # no node lies at x = 0
    assert found.capacitance_ratio == near((primitive(2.0 * b) - primitive(-4.0 * b)) / plate, 2e-5)


def test_weibull_of_a_cylinder(cylinder):
    """Integral of (1 + u^2)^-m from -inf to inf is sqrt(pi) gamma(m - 1/2)/gamma(m); here it ends at 6 and 3
    widths of the gap, where with m = 8 nothing is left. The field is V/h to the square of the slope.
    """
    found, b = cylinder
    scale = math.sqrt(2.0 * CYLINDER * LEAST)
    assert 2.0 * b > 3.0 * scale
    whole = math.sqrt(math.pi) * math.gamma(7.5) / math.gamma(8.0) * scale * LENGTH
    exponent = whole / 1e-8 * (3.0 / (LEAST * 10e6)) ** 8
    assert found.probability == near(-math.expm1(-exponent), 1e-4)
    assert found.breakdown_voltage == near(3.0 * exponent ** (-1.0 / 8.0), 1e-5)


def test_zone_of_a_cylinder(cylinder):
    """h0/0.95 at x^2 = 2 R h0 (1/0.95 - 1)."""
    found, b = cylinder
    half = math.sqrt(2.0 * CYLINDER * LEAST * (1.0 / 0.95 - 1.0))
    assert found.zone_position == pytest.approx(0.0, abs=1e-3 * b)
    assert found.zone_size == near(2.0 * half, 1e-3)
    assert found.zone_area == near(2.0 * half * LENGTH, 1e-3)


BALL, BALL_GAP = 0.05, 50e-9


@pytest.fixture(scope="module", params=[1.0, 3.0], ids=["sphere", "ellipsoid"])
def ball(request):
    """h0 + x^2/2R + y^2/2Ry over a plane at 2 V, the field solved in a part of the domain."""
    case, conditions = point_case({"radius_y": f"{10.0 * request.param} mm"}, weibull=WEIBULL)
    b, a, across = conditions.semi_axis_x, conditions.semi_axis_y, request.param * BALL
    x, y = np.linspace(-4.5 * b, 1.5 * b, 241), np.linspace(-2.5 * a, 2.5 * a, 201)

    def gap(at_x, at_y):
        return BALL_GAP + 0.5 * at_x**2 / BALL + 0.5 * at_y**2 / across

    film = point_gap(x, y, gap(x[:, np.newaxis], y))
    field = point_gap_field(
        film, np.abs(x) < 1.3 * b, np.abs(y) < 1.3 * a, voltage=2.0, permittivity=PERMITTIVITY
    )
    return assessed(case, conditions, film, field), (b, a, across), gap


@pytest.mark.slow
@pytest.mark.gate
def test_capacitance_of_a_ball(ball):
    """Over the whole domain by adaptive quadrature, and over the disc of a circle in closed form,
    2 pi R eps0 eps ln(1 + a^2/(2 R h0)).
    """
    found, (b, a, across), gap = ball
    dense = epsilon_0 * PERMITTIVITY

    def within(x_start, x_stop, y_start, y_stop):
        return dblquad(
            lambda y, x: dense / gap(x, y), x_start, x_stop, y_start, y_stop, epsabs=0.0, epsrel=1e-6
        )[0]

    assert found.capacitance == near(within(-4.5 * b, 1.5 * b, -2.5 * a, 2.5 * a), 1e-3)
    strip = within(-4.5 * b, 1.5 * b, -a, a)
    assert found.capacitance - found.capacitance_sides == near(strip, 2e-3)
    before = within(-4.5 * b, 0.0, -a, a)
    half = 0.5 * found.capacitance_hertz
    assert found.capacitance_inlet + half == near(before, 2e-3)
    assert found.capacitance_outlet + half == near(strip - before, 2e-3)
    if across == BALL:
        disc = 2.0 * math.pi * BALL * dense * math.log1p(b * a / (2.0 * BALL * BALL_GAP))
        assert found.capacitance_hertz == near(disc, 2e-3)
    assert found.capacitance_plate == near(dense * math.pi * a * b / BALL_GAP, 1e-9)


def test_weibull_of_a_ball(ball):
    """Integral of (h0/h)^m over the plane: 2 pi sqrt(R Ry) h0/(m - 1)."""
    found, (_, _, across), _ = ball
    area = 2.0 * math.pi * math.sqrt(BALL * across) * BALL_GAP / 7.0
    exponent = area / 1e-8 * (2.0 / (BALL_GAP * 10e6)) ** 8
    assert found.breakdown_voltage == near(2.0 * exponent ** (-1.0 / 8.0), 2e-3 / 8.0)


def test_zone_of_a_ball(ball):
    """An ellipse of the area 2 pi sqrt(R Ry) h0 (1/0.95 - 1)."""
    found, (b, a, across), _ = ball
    area = 2.0 * math.pi * math.sqrt(BALL * across) * BALL_GAP * (1.0 / 0.95 - 1.0)
    assert found.zone_position == pytest.approx((0.0, 0.0), abs=1e-9 * a)
    assert found.zone_area == near(area, 0.02)
    assert found.zone_size == near(math.sqrt(4.0 * found.zone_area / math.pi), 1e-12)
    assert found.zone_over_half_width == near(found.zone_size / b, 1e-12)


def test_current_of_a_point_contact():
    """0.3 A over pi a b, in A/m^2."""
    case, conditions = point_case(peak_current="300 mA")
    a = conditions.semi_axis_x
    x, y = np.linspace(-4.5 * a, 1.5 * a, 25), np.linspace(-3.0 * a, 3.0 * a, 25)
    film = point_gap(x, y, np.full((25, 25), 1e-7))
    found = assessed(case, conditions, film, point_gap_field(film, slice(8, 24), slice(6, 19)))
    assert found.current_density == near(0.3 / (math.pi * a**2), 1e-12)
    assert found.zone_area == near(float(np.ptp(x[8:24]) * np.ptp(y[6:19])), 1e-9)


def test_each_line_of_a_point_contact_has_its_outlet():
    """Fingers of oil between plates that part with x, where the exits of two halves differ: quadrature."""
    case, conditions = point_case(outlet="fingers")
    a = conditions.semi_axis_x
    x, y = np.linspace(-4.5 * a, 1.5 * a, 481), np.linspace(-3.0 * a, 3.0 * a, 121)
    thickness = np.repeat((1e-7 * np.exp(x / a))[:, np.newaxis], y.size, axis=1)
    film = point_gap(x, y, thickness, exit_node=-1)
    for side, ends in ((y < 0.0, 0.5), (y >= 0.0, 1.0)):
        film.cavitated[np.ix_(x > ends * a - 1e-9 * a, side)] = True
    field = point_gap_field(film, slice(300, 420), slice(50, 71), permittivity=PERMITTIVITY)
    found = assessed(case, conditions, film, field)

    def outlet(exit_at):
        def strip(x):
            fraction = min(1.0, math.exp(exit_at - x))
            width = 1.0 - math.sqrt(max(0.0, 1.0 - x**2))
            return width * (1.0 + (PERMITTIVITY - 1.0) * fraction) * math.exp(-x)

        return quad(strip, 0.0, 1.5, points=[0.5, 1.0], epsabs=0.0, epsrel=1e-9)[0] * a**2 / 1e-7

    assert found.outlet == "fingers"
    # The row between the halves is of one of them: a hundred and twentieth of the width.
    assert found.capacitance_outlet == near(epsilon_0 * (outlet(0.5) + outlet(1.0)), 5e-3)
    assert found.capacitance_outlet == found.capacitance_outlet_fingers


@pytest.mark.parametrize("kind", ["line", "point"])
def test_crests_break_first(kind):
    """Of a wave h - A cos(q x) above a plane: the field on its crest by perturbation, to third order in A/h;
    V/h_min is 0.6 % less.
    """
    gap, amplitude = 1e-6, 0.02e-6
    crest, _, _ = sinusoidal_wall(amplitude, 1.0 / gap, gap)
    assert crest > 1.005 / (1.0 - amplitude / gap)
    x = np.linspace(-np.pi, np.pi, 401) * gap
    wave = gap - amplitude * np.cos(x / gap)
    if kind == "line":
        case, conditions = line_case(dielectric_strength="15 V/um")
        film = line_gap(x, wave)
        field = line_gap_field(film, slice(None), voltage=3.0)
    else:
        case, conditions = point_case(dielectric_strength="15 V/um")
        y = np.linspace(-gap, gap, 5)
        film = point_gap(x, y, np.repeat(wave[:, np.newaxis], 5, axis=1))
        field = point_gap_field(film, slice(None), slice(None), voltage=3.0)
    found = assessed(case, conditions, film, field)
    assert found.breakdown_voltage == near(15e6 * gap / crest, 3e-4)


def warnings_of(film, **discharge):
    case, _ = line_case(**discharge)
    return list(map(str, discharge_warnings(case.discharge, film)))


def test_films_through_which_electrons_tunnel():
    x = np.linspace(-1.0, 1.0, 5)
    (text,) = warnings_of(line_gap(x, np.array([9e-9, 9e-9, 1.9e-9, 9e-9, 9e-9])))
    assert "1.9 nm" in text
    assert " 2 nm" in text
    assert warnings_of(line_gap(x, np.full(5, 2.1e-9))) == []
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": OIL})
    assert list(discharge_warnings(case.discharge, line_gap(x, np.full(5, 1e-9)))) == []


@pytest.mark.parametrize(("pressure", "said"), [([0.0, 1.0], False), ([0.01, 1.0], True), ([0.0, 0.8], True)])
def test_pressures_beyond_the_table(pressure, said):
    x = np.linspace(-1.0, 1.0, 3)
    film = line_gap(x, np.full(3, 1e-7), pressure=np.array([1e5, 0.9e9, 1e5]))
    table = {"pressure": [p * 1e9 for p in pressure], "strength": [1e7, 2e7]}
    texts = warnings_of(film, strength_table=table)
    assert len(texts) == said
    for text in texts:
        assert "0.0001 to 0.9 GPa" in text
        assert "discharge.strength_table" in text


def test_areas_inside_and_outside_add_up():
    x, y = np.array([0.0, 1.0, 3.0, 4.0]), np.array([-1.0, 0.0, 2.0])
    inner = np.array([0.5, 3.5]), np.array([-0.5, 1.0])
    assert np.sum(areas((x, y))) == near(12.0, 1e-14)
    np.testing.assert_allclose(areas((x, y)), node_areas(x, y), rtol=1e-14)
    assert np.sum(areas((x, y), inner)) == near(4.5, 1e-14)
    # Times nodal values of x y they integrate it over the inner part: (3.5^2 - 0.5^2)/2 (1 - 0.25)/2.
    moment = np.vdot(areas((x, y), inner), np.outer(x, y))
    assert moment == near(6.0 * 0.375, 1e-13)


def test_widths_of_a_part_integrate_linear_values():
    x = np.array([-1.0, 0.0, 0.5, 2.0, 2.5])
    for start, stop in ((-0.7, 1.1), (0.1, 0.2), (0.5, 2.0), (-9.0, 9.0), (2.2, np.inf)):
        left, right = max(start, -1.0), min(stop, 2.5)
        widths = part_widths(x, start, stop)
        assert np.sum(widths) == near(right - left, 1e-13)
        assert widths @ (3.0 - x) == near(3.0 * (right - left) - 0.5 * (right**2 - left**2), 1e-13)


def test_zones_share_out_the_domain():
    x, y = np.linspace(-4.0, 2.0, 97), np.linspace(-3.0, 3.0, 73)
    line = line_zone_areas((x,), 1.0)
    assert {name: float(np.sum(part)) for name, part in line.items()} == pytest.approx(
        {"hertz": 2.0, "inlet": 3.0, "outlet": 1.0}
    )
    ellipse = point_zone_areas((x, y), 1.0, 2.0)
    # Of the strip abs(y) < 2 the ellipse, and what is before and behind its middle.
    exact = {"hertz": 2 * math.pi, "inlet": 16 - math.pi, "outlet": 8 - math.pi, "sides": 12.0}
    assert {name: float(np.sum(part)) for name, part in ellipse.items()} == pytest.approx(exact, rel=2e-3)
    np.testing.assert_allclose(sum(ellipse.values()), node_areas(x, y), rtol=1e-12)


def test_values_at_columns_are_linear_in_between():
    x = np.linspace(-1.0, 1.0, 5)
    film = line_gap(x, np.full(5, 1e-6))
    field = line_gap_field(line_gap(np.linspace(-0.8, 1.0, 7), np.full(7, 1e-6)), slice(None))
    np.testing.assert_allclose(at_columns(film, field, 2.0 - x), 2.0 - field.x, rtol=1e-13)
