"""Viscosity of an oil at any two temperatures, and below 2 mm^2/s, by the equation of ASTM D341."""

import math

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.cases.case_oil import Lubricant
from ehlectric.lubricant.data_sheet import viscosity_index
from ehlectric.lubricant.viscosity_over_temperature import Walther
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each


def z(nu):
    """Z of ASTM D341-09 and later, from a kinematic viscosity [mm^2/s]."""
    return nu + 0.7 + math.exp(-1.47 - 1.84 * nu - 0.51 * nu**2)


def inverse(z):
    """Kinematic viscosity [mm^2/s] by the approximate inverse that the standard prints."""
    x = z - 0.7
    return x - math.exp(-0.7487 - 3.295 * x + 0.6119 * x**2 - 0.3193 * x**3)


def by_standard(first, second, celsius):
    """Kinematic viscosity [mm^2/s] between two points of temperature [degC] and viscosity [mm^2/s]."""
    places = [math.log10(t + 273.15) for t, _ in (first, second)]
    double = [math.log10(math.log10(z(nu))) for _, nu in (first, second)]
    line = np.polynomial.Polynomial.fit(places, double, 1)
    return inverse(10.0**10.0 ** line(math.log10(celsius + 273.15)))


def sheet(**keys):
    table = {"density_15": "870 kg/m^3", **keys}
    return Lubricant.from_dict({"base": "paper", "temperature": table}).temperature


def at(oil, celsius):
    return 1e6 * oil.walther().viscosity(celsius + 273.15)


@each("celsius", [60.0, 100.0, 120.0, 150.0, 180.0, 220.0])
def test_thin_oils_by_the_inverse_of_the_standard(celsius):
    """The inverse of the standard has an error of 0.1 % from 0.3 mm^2/s on."""
    oil = Walther.of(9.5e-6, 2.6e-6)
    expected = by_standard((40.0, 9.5), (100.0, 2.6), celsius)
    assert 1e6 * oil.viscosity(celsius + 273.15) == pytest.approx(expected, rel=2e-3)


@each("nu", [0.9, 1.2, 1.65, 2.0])
def test_the_terms_of_earlier_editions(nu):
    """From 0.9 mm^2/s on, Z of ASTM D341-93 is nu + 0.7 + exp(-1.14883 - 2.65868 nu), and 1e-5 less."""
    assert z(nu) == pytest.approx(nu + 0.7 + math.exp(-1.14883 - 2.65868 * nu), rel=1e-3)


def test_an_e_drive_fluid_at_120_degrees():
    assert at(
        sheet(kinematic_viscosity_40="9.5 mm^2/s", kinematic_viscosity_100="2.6 mm^2/s"), 120
    ) == pytest.approx(1.96, abs=0.005)


def test_the_least_viscosity_of_the_standard():
    oil = Walther.of(1.0e-6, 0.5e-6)
    least = next(t for t in range(373, 900) if 1e6 * oil.viscosity(t) < 0.22)
    assert 1e6 * oil.viscosity(least) > 0.21
    with pytest.raises(InputError, match=r"less than 0\.21 mm\^2/s"):
        oil.viscosity(least + 30)
    assert np.isnan(oil.viscosity(np.array([373.15, least + 30]))).tolist() == [False, True]
    with pytest.raises(InputError, match=r"2\.1e-07 m\^2/s, the least of ASTM D341"):
        Walther.of(1.0e-6, 0.2e-6)


NAMES = {
    **{f"k{n}": f"kinematic_viscosity_{n}" for n in ("1", "2", "40", "100")},
    **{f"d{n}": f"dynamic_viscosity_{n}" for n in ("1", "2")},
    **{f"t{n}": f"temperature_{n}" for n in ("1", "2")},
    "vg": "iso_vg",
    "index": "viscosity_index",
}


def keys(**short):
    """Keys of a data sheet by short names."""
    return {NAMES[name]: value for name, value in short.items()}


FOUR = [
    keys(k1="46 mm^2/s", t1="40 degC", k2="11.5 mm^2/s", t2="80 degC"),
    keys(k40="46 mm^2/s", k2="11.5 mm^2/s", t2="80 degC"),
    keys(vg=46, k2="11.5 cSt", t2="176 degF"),
    keys(k1="11.5 mm^2/s", t1="80 degC", k2="46 mm^2/s", t2="40 degC"),
]


@each("given", FOUR)
def test_the_same_oil_in_four_ways(given):
    oil = sheet(**given)
    for celsius in (20.0, 40.0, 70.0, 100.0, 130.0):
        expected = by_standard((40.0, 46.0), (80.0, 11.5), celsius)
        assert at(oil, celsius) == pytest.approx(expected, rel=1e-3)
    assert 1e6 * oil.at_40() == pytest.approx(46.0)


def test_100_and_210_degrees_fahrenheit():
    """37.78 and 98.89 degC."""
    oil = sheet(**keys(k1="50 cSt", t1="100 degF", k2="7 cSt", t2="210 degF"))
    first, second = (340.0 / 9.0, 50.0), (890.0 / 9.0, 7.0)
    assert at(oil, 70.0) == pytest.approx(by_standard(first, second, 70.0), rel=1e-4)
    assert viscosity_index(oil.at_40(), oil.at_100()) == pytest.approx(
        viscosity_index(*(1e-6 * by_standard(first, second, t) for t in (40.0, 100.0))), abs=0.1
    )


def test_dynamic_viscosities():
    """Each over its density, 870 (1 - 6.5e-4 (T - 15)) kg/m^3."""
    table = keys(d1="40 mPas", t1="40 degC", d2="10 cP", t2="80 ℃") | {"density_15": 870.0}
    oil = Lubricant.from_dict({"base": "paper", "temperature": table})
    assert [oil.at(273.15 + t).viscosity for t in (40, 80)] == pytest.approx([0.04, 0.01], rel=1e-9)


@each(
    "given, text",
    [
        (keys(k40=46e-6), "either kinematic_viscosity_100 or viscosity_index.*temperature_2"),
        (keys(k40=46e-6, k2=8e-6), "temperature_2: missing"),
        (keys(k40=46e-6, k100=7e-6, t2=353.15), "temperature_2: got a temperature without"),
        (keys(k40=46e-6, k100=7e-6, k2=8e-6, t2=353.15), "kinematic_viscosity_100 and kinematic_viscosity_2"),
        (keys(k1=46e-6, t1=323.15, index=100), "the index needs 40 °C"),
        (keys(k1=46e-6, t1=353.15, k2=40e-6, t2=355.15), "differs by 5 K or more"),
        (keys(k40=46e-6, k2=60e-6, t2=353.15), "kinematic_viscosity_2: .* falls with temperature"),
        (keys(k40=46e-6, k2=40e-6, t2=300.0), "kinematic_viscosity_2: .* falls with temperature"),
    ],
)
def test_what_is_missing_or_given_twice(given, text):
    with pytest.raises(InputError, match=text):
        sheet(**given)


def test_a_new_way_replaces_the_old_one():
    case = bearing_case(BALLS)

    def changed(case, **short):
        return case.replace({f"lubricant.temperature.{key}": value for key, value in keys(**short).items()})

    other = changed(case, k2="11.5 mm^2/s", t2="80 degC")
    oil = other.lubricant.temperature
    assert (oil.kinematic_viscosity_100, oil.temperature_2) == (None, 353.15)
    assert changed(other, t2="90 degC").lubricant.temperature.kinematic_viscosity_2 == 11.5e-6
    dynamic = changed(other, d2="9 mPa s").lubricant.temperature
    assert (dynamic.kinematic_viscosity_2, dynamic.temperature_2) == (None, 353.15)
    back = changed(other, k100="6.8 mm^2/s").lubricant.temperature
    assert (back.kinematic_viscosity_2, back.temperature_2) == (None, None)
    assert type(case).from_dict(other.to_dict()) == other
    density = 870.0 * (1.0 - 6.5e-4 * 55.0)
    nu = by_standard((40.0, 1e6 * oil.at_40()), (80.0, 11.5), 70.0)
    assert other.lubricant.at(343.15).viscosity == pytest.approx(1e-6 * nu * density, rel=1e-4)


@each("base_oil", ["pao", "mineral-paraffinic"])
def test_the_estimated_coefficient_of_a_thin_oil_is_extrapolated(base_oil):
    """1.96 mm^2/s at 120 degC: 7.382 nu^0.1335 of Gold for a PAO; refused below 1 mm^2/s."""
    table = keys(k40="9.5 mm^2/s", k100="2.6 mm^2/s") | {"density_15": 830.0, "base_oil": base_oil}
    oil = Lubricant.from_dict({"base": "paper", "temperature": table})
    codes = [warning.code for check in oil.at(393.15).checks for warning in check(1e9)]
    assert codes.count("alpha-extrapolated") == codes.count("estimated-alpha") == 1
    if base_oil == "pao":
        assert oil.at(393.15).alpha == pytest.approx(7.382e-9 * 1.9618**0.1335, rel=1e-3)
    warm = [warning.code for check in oil.at(373.15).checks for warning in check(1e9)]
    assert "alpha-extrapolated" not in warm
    with pytest.raises(InputError, match="expected 1 to 2500"):
        oil.at(473.15)
