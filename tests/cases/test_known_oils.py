"""Oils as far as they are known: what is missing is named, and the rest is what a solution computes with."""

import math

import numpy as np
import pytest

import ehlectric
from ehlectric import InputError
from ehlectric.cases.case_oil import Lubricant, known_oil, named_oil
from ehlectric.cases.library.library_oils import library_oil, library_oils
from ehlectric.cases.oil_inputs import Properties
from ehlectric.cases.oil_report import PROPERTIES, oil_report, usual_temperatures
from tests.helpers.each import each

COMPLETE = [oil.name for oil in library_oils() if not oil.needs]
SHEET = {"kinematic_viscosity_40": "46 mm^2/s", "kinematic_viscosity_100": "6.8 mm^2/s", "density_15": 870.0}
OWN = {
    "viscosity_law": "roelands",
    "roelands_pressure": "0.196 GPa",
    "density_law": "dowson-higginson",
    "density_c1": "0.59 GPa",
    "density_c2": 1.34,
    "relative_permittivity": 2.2,
    "temperature": SHEET | {"base_oil": "mineral-paraffinic"},
}


@each("name", COMPLETE)
def test_an_oil_that_lacks_nothing_is_that_of_a_solution(name):
    """Two ways to the same oil: property by property, and all of them or none."""
    kelvin = 333.15
    known = known_oil(Properties.from_dict({"base": name}), kelvin)
    oil = Lubricant.from_dict({"base": name}).at(kelvin)
    assert not known.missing
    for key in ("viscosity", "density", "relative_permittivity", "conductivity", "alpha", "alpha_star"):
        assert getattr(known, key) == getattr(oil, key), key
    pressure = 1.2e9
    ratio = float(oil.density_ratio(pressure)[0])
    expected = {
        "viscosity": oil.viscosity * math.exp(oil.log_viscosity(pressure)[0]),
        "density": None if oil.density is None else oil.density * ratio,
        "density_ratio": ratio,
        "relative_permittivity": float(oil.permittivity(pressure, ratio)),
        "thermal_conductivity": oil.thermal_conductivity,
        "heat_capacity": None,
    }
    for key, value in expected.items():
        expected_value = value if value is None else pytest.approx(value, rel=1e-12)
        assert PROPERTIES[key].value(known, pressure) == expected_value, key


@each(
    "name, key, unknown",
    [
        ("n100", "lubricant.relative_permittivity", {"relative_permittivity"}),
        ("pao100", "lubricant.relative_permittivity", {"relative_permittivity"}),
        ("shell-t9", "lubricant.relative_permittivity", {"relative_permittivity"}),
        ("squalane", "lubricant.pressure_viscosity_coefficient", {"alpha", "alpha_star"}),
    ],
)
def test_a_missing_value_is_named_and_has_no_substitute(name, key, unknown):
    known = known_oil(Properties.from_dict({"base": name}), 333.15)
    assert list(known.missing) == [key]
    assert library_oil(name).needs[0] in str(known.missing[key])
    for attribute in ("viscosity", "density", "relative_permittivity", "alpha", "alpha_star"):
        assert (getattr(known, attribute) is None) == (attribute in unknown), attribute


def test_the_viscosity_of_squalane_is_not_known_at_pressure():
    lines = {(line.of.name, line.pressure): line for line in oil_report("squalane", (), ["1 GPa"]).lines}
    assert lines["viscosity", 1e9].missing
    assert not lines["viscosity", 0.0].missing
    assert not lines["relative_permittivity", 1e9].missing
    assert lines["viscosity", 1e9].kind == ""


def test_a_measured_table_of_permittivity_works_at_pressure():
    """By hand: the polarisation (e - 1)/(e + 2) of 2.474 times the density ratio 1.2138 at 1 GPa."""
    oil = ehlectric.oil("mobil-shc-320", "40 degC")
    ratio = (0.59 + 1.34) / (0.59 + 1.0)
    polarisation = 1.474 / 4.474 * ratio
    by_hand = (1.0 + 2.0 * polarisation) / (1.0 - polarisation)
    assert float(oil.permittivity(1e9, oil.density_ratio(1e9)[0])) == pytest.approx(by_hand, rel=1e-9)


@each("name", ["n100", "shell-t9", "fva-3"])
def test_a_range_ends_where_the_viscosity_stops_to_rise(name):
    """The law is capped there: its slope is zero above, and not below."""
    known = known_oil(Properties.from_dict({"base": name}), 313.15)
    end = known.range_end("viscosity_law")
    law = known.laws["viscosity_law"]
    below, above = (float(law(np.array([part * end]))[1][0]) for part in (0.999, 1.001))
    assert below > 1e-9
    assert above == 0.0
    assert known.range_end("permittivity_law") == math.inf


def test_a_law_without_a_cap_ends_where_its_measurements_do():
    """Larsson et al. measured to 1.1 GPa."""
    larsson = {"thermal_conductivity_law": "larsson", "thermal_conductivity": 0.137}
    larsson |= {"larsson_c1": "1.72 1/GPa", "larsson_c2": "0.54 1/GPa"}
    table = {"base": "fva-3"} | larsson
    report = oil_report(table, ["40 degC"], ["1 GPa", "1.2 GPa"])
    (oil,) = report.oils
    assert oil.range_end("thermal_conductivity_law") == pytest.approx(1.1e9, rel=1e-5)
    beyond = {(line.of.name, line.pressure) for line in report.lines if report.beyond(line, oil)}
    assert beyond == {("thermal_conductivity", 1.2e9)}
    assert [warning.code for warning in report.warnings] == ["law-range"]
    assert "Hertz" not in str(report.warnings[0])


@each(
    "name, line, pressure, law, kind",
    [
        ("fva-3", "viscosity", 0.0, "vogel", "fitted"),
        ("fva-3", "viscosity", 1e9, "modulus", "fitted"),
        ("fva-3", "density", 0.0, "linear", "read off a diagram"),
        ("fva-3", "density", 1e9, "dowson-higginson", "assumed"),
        ("mobil-shc-320", "relative_permittivity", 0.0, "table", "measured"),
        ("mobil-shc-320", "density", 0.0, "linear", "published"),
        ("iso-vg-32", "alpha_star", 0.0, "roelands", "estimated"),
        ("shell-t9", "viscosity", 0.0, "yasutomi", "assumed"),
        ("shell-t9", "density", 0.0, "tait", "fitted"),
        # The expansion is the program's own default: the density is no measurement any more.
        ("n100", "density", 0.0, "linear", "assumed"),
    ],
)
def test_kinds_are_those_of_the_weakest_value(name, line, pressure, law, kind):
    lines = {(one.of.name, one.pressure): one for one in oil_report(name, (), ["1 GPa"]).lines}
    assert (lines[line, pressure].law, lines[line, pressure].kind) == (law, kind)


def test_values_of_a_user_are_given_and_estimates_are_estimates():
    lines = {one.of.name: one for one in oil_report(OWN, ["60 degC"]).lines}
    assert lines["relative_permittivity"].kind == "given"
    assert lines["alpha_star"].kind == "estimated"
    (estimate,) = lines["alpha_star"].sources
    assert "So and E. E. Klaus" in estimate.citation
    # A default of the program is an assumption, and is named.
    assert lines["density"].kind == "assumed"
    assert [source.keys for source in lines["density"].sources] == [("temperature.expansion",)]
    expansion = OWN | {"temperature": SHEET | {"expansion": "7e-4 1/K"}, "roelands_z": 0.65}
    given = {one.of.name: one for one in oil_report(expansion, ["60 degC"]).lines}
    assert given["density"].kind == given["alpha_star"].kind == "given"
    assert oil_report(expansion, ["60 degC"]).warnings == ()


def test_values_of_the_base_keep_their_source_beside_those_of_a_user():
    named = named_oil({"base": "mobil-shc-320", "temperature": SHEET})
    assert named.source("temperature.density_15") is None
    assert named.source("density_c1").kind == "assumed"
    assert named.source("temperature.expansion").kind == "published"
    assert named_oil("mobil-shc-320").source("temperature.expansion").kind == "published"


@each(
    "source, celsius",
    [
        ("fva-3", [40.0, 60.0, 80.0, 100.0]),
        ("mobil-shc-320", [40.0, 60.0, 80.0]),
        ({"base": "fva-3", "temperature_range": ["20 degC", "35 degC"]}, [20.0, 35.0]),
        (OWN, [40.0, 60.0, 80.0, 100.0]),
    ],
)
def test_no_temperature_is_assumed_outside_the_range(source, celsius):
    assert np.array(usual_temperatures(named_oil(source))) - 273.15 == pytest.approx(celsius)


def test_an_oil_with_one_viscosity_has_one_column_and_says_so():
    assert usual_temperatures(named_oil("paper")) == (None,)
    assert oil_report("paper").warnings == ()
    (warning,) = oil_report("paper", ["40 degC"]).warnings
    assert "is one number" in warning


def test_temperatures_at_which_a_table_has_no_value_are_left_out():
    """Measured at 40 and 70 degC: 80 and 100 degC are no columns, and are refused if asked for."""
    table = {"temperature": ["40 degC", "70 degC"], "conductivity": ["1e-12 S/m", "5e-12 S/m"]}
    report = oil_report(OWN | {"conductivity_table": table})
    assert [round(kelvin - 273.15) for kelvin in report.temperatures] == [40, 60]
    with pytest.raises(InputError) as caught:
        oil_report(OWN | {"conductivity_table": table}, ["80 degC"])
    assert caught.value.key == "--temperature"


FILE = """
title = "My drive"
[bearing]
temperature = "70 degC"
inner_ring_temperature = "80 degC"
[lubricant]
base = "fva-3"
[discharge]
conductivity = "2e-11 S/m"
"""


def test_an_oil_of_a_file_has_its_temperatures_and_its_conductivity(tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text(FILE)
    report = oil_report(path)
    assert [round(kelvin - 273.15) for kelvin in report.temperatures] == [70, 80]
    (line,) = (line for line in report.lines if line.of.name == "conductivity")
    assert (line.values, line.kind) == ((2e-11, 2e-11), "given")
    with pytest.raises(InputError, match="temperature: missing"):
        ehlectric.oil(path)
    path.write_text(FILE.replace("inner_ring", "#"))
    assert ehlectric.oil(path).temperature == pytest.approx(343.15)
    assert ehlectric.oil(str(path), "50 degC").temperature == pytest.approx(323.15)


@each(
    "source, temperature, message",
    [
        ("fva3", None, "oil: got 'fva3'; expected .*; nearest is 'fva-3'"),
        ("n100", "40 degC", "lubricant.relative_permittivity: missing"),
        ("fva-3", None, "temperature: missing"),
        ("fva-3", "120 degC", "temperature: got 120 degC; expected 20 to 110 degC"),
        ("fva-3", 40, "temperature: got 40; expected a temperature with its unit"),
        ({"base": "fva-3", "viscosity": "many"}, None, "lubricant.viscosity: got 'many'"),
        ({"base": "fva-3", "relative_permitivity": 2.0}, None, "lubricant.relative_permitivity: unknown key"),
    ],
)
def test_errors_of_an_oil(source, temperature, message):
    with pytest.raises(InputError, match=message):
        ehlectric.oil(source, temperature)


def test_a_table_that_contradicts_itself_is_refused_also_where_it_lacks_a_value():
    with pytest.raises(InputError, match=r"lubricant.viscosity: got viscosity and temperature together"):
        named_oil(OWN | {"viscosity": "40 mPa s"})
    both = {"temperature": ["40 degC", "70 degC"], "relative_permittivity": [2.1, 2.0]}
    with pytest.raises(
        InputError, match="relative_permittivity: got relative_permittivity and permittivity_table"
    ):
        named_oil(OWN | {"permittivity_table": both})


def test_a_pole_of_the_permittivity_has_no_value_beyond_it():
    """Clausius-Mossotti of a permittivity of 12 has its pole at the density ratio 14/11 = 1.27."""
    report = oil_report({"base": "fva-3", "relative_permittivity": 12.0}, ["40 degC"], ["1 GPa", "3 GPa"])
    values = {line.pressure: line.values for line in report.lines if line.of.name == "relative_permittivity"}
    assert values[1e9][0] > 12.0
    assert values[3e9] == (None,)
    (warning,) = report.warnings
    assert "40 °C" in warning
    assert "lubricant.permittivity_law: 'clausius-mossotti'" in warning


VOGEL = {"atmospheric_law": "vogel", "vogel_viscosity": "0.062 mPa s", "vogel_b": 1021.7, "vogel_c": 171.6}


@pytest.mark.parametrize(
    ("table", "stated"),
    [
        ({"base": "paper", **VOGEL}, "22 1/GPa"),
        (
            {
                "base": "paper",
                "atmospheric_law": "roelands",
                "reference_temperature": "40 degC",
                "roelands_s0": 1.1,
            },
            "reference_temperature",
        ),
    ],
)
def test_a_coefficient_by_the_relation_of_roelands_cites_it(table, stated):
    """A coefficient that is not the given one has the relation as a source, which says what it replaces."""
    lines = {line.of.name: line for line in oil_report(table).lines}
    for name in ("pressure_viscosity_coefficient", "alpha_star"):
        notes = [source.note for source in lines[name].sources if source.kind == "by rule"]
        assert len(notes) == 1
        assert stated in notes[0]


def test_a_thermal_conductivity_of_the_base_keeps_its_source():
    oil = {"base": "e-axle-fluid", "viscosity": "10 mPa s", "pressure_viscosity_coefficient": 15e-9}
    lines = {line.of.name: line for line in oil_report(oil | {"roelands_z": 0.6}).lines}
    assert lines["thermal_conductivity"].values == (0.154,)
    assert "Larsson" in lines["thermal_conductivity"].sources[0].citation


TWO = {"kinematic_viscosity_40": 46e-6, "kinematic_viscosity_100": 6.8e-6, "density_15": 870.0}
DYNAMIC = {
    "dynamic_viscosity_1": 0.04,
    "temperature_1": 313.15,
    "kinematic_viscosity_100": 6.8e-6,
    "density_15": 870.0,
}


@each("sheet", [TWO, DYNAMIC, TWO | {"expansion": 7e-4}])
def test_two_given_viscosities_rest_on_no_assumption(sheet):
    """Only the density rests on the expansion of a default, and the rise with pressure on the named base."""
    lines = {
        (one.of.name, one.pressure): one.kind
        for one in oil_report({"base": "paper", "temperature": sheet}, [353.15], [1e9]).lines
    }
    assert lines["viscosity", 0.0] == "given"
    assert lines["kinematic_viscosity", 0.0] == ("assumed" if sheet is DYNAMIC else "given")
    assert lines["density", 0.0] == ("given" if "expansion" in sheet else "assumed")
    assert lines["viscosity", 1e9] == "assumed"
