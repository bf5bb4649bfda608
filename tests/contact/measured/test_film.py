"""Film factors of a contact from a log of its film thickness."""

import numpy as np
import pandas as pd
import pytest

import ehlectric
from ehlectric import Case
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import contact_film
from ehlectric.formulas.film_point import PointContact, nijenbanning_venner_moes

BALL = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
SPEEDS = np.array([0.25, 0.5, 1.0, 2.0])


@pytest.fixture(scope="module")
def case():
    return Case.point(**BALL, entrainment_speed="1 m/s", lubricant="paper", grid={"nodes": 65})


def log(films, **more):
    return pd.DataFrame({"entrainment speed [m/s]": SPEEDS[: len(films)], "film [nm]": 1e9 * films, **more})


def formula(case, speed):
    from ehlectric.contact.conditions import resolve_point

    return nijenbanning_venner_moes(
        resolve_point(case.replace({"contact.entrainment_speed": speed})).contact
    ).central_thickness


def test_the_factor_is_measured_over_computed(case):
    films = np.array([formula(case, speed) for speed in SPEEDS.tolist()])
    found = ehlectric.film_factors(case, log(0.9 * films), contacts="formula", uncertainty="4 %")
    assert found.columns["film_factor"] == pytest.approx([0.9] * 4)
    assert found.columns["computed"] == pytest.approx(films)
    assert found.mean.value == pytest.approx(0.9)
    assert found.mean.statistical == pytest.approx(0.02)
    assert [warning.code for warning in found.warnings] == ["formula-films"]


@pytest.mark.slow
def test_solved_films_are_those_of_solve(case):
    """Three solved films, and the one between them from the ratio to the formula."""
    films = [
        ehlectric.solve(case.replace({"contact.entrainment_speed": speed})).film.central_thickness
        for speed in SPEEDS[1:].tolist()
    ]
    found = ehlectric.film_factors(case, log(np.ones(4) * 1e-7))
    assert found.solves in (3, 4)
    assert found.columns["computed"][1:] == pytest.approx(films, rel=0.02)
    assert found.columns["computed"][-1] == pytest.approx(films[-1], rel=1e-9)
    assert found.contacts == "solved"


def test_films_of_the_atlas_are_those_of_its_contacts(case):
    """At 1 mm/s the film is outside the atlas, and that of the formula."""
    speeds = np.array([0.001, 0.5, 1.0])
    frame = pd.DataFrame({"entrainment speed [m/s]": speeds, "film [nm]": [10.0, 100.0, 100.0]})
    found = ehlectric.film_factors(case, frame, contacts="atlas", uncertainty="4 %")
    slow, *others = found.columns["computed"]
    assert slow == pytest.approx(formula(case, 0.001))
    oil = case.lubricant.at(None)
    for speed, film in zip(speeds[1:].tolist(), others, strict=True):
        ball = PointContact(
            radius_x=10e-3,
            radius_y=10e-3,
            reduced_modulus=226e9,
            load=20.0,
            entrainment_speed=speed,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=0.0,
        )
        assert film == pytest.approx(contact_film(ball, oil).central_thickness)
    assert found.formula_error == 0.4
    inside = ehlectric.film_factors(case, frame[1:], contacts="atlas", uncertainty="4 %")
    assert inside.formula_error < 0.03
    assert "atlas-contacts" in [warning.code for warning in inside.warnings]


def test_starvation_over_the_speed_is_told(case):
    films = np.array([formula(case, speed) for speed in SPEEDS.tolist()]) * SPEEDS**-0.15
    found = ehlectric.film_factors(case, log(films), contacts="formula")
    assert found.slope[0] == pytest.approx(-0.15)
    assert "factor-varies" in [warning.code for warning in found.warnings]


def test_speeds_of_both_bodies_keep_their_ratio():
    sliding = Case.point(**BALL, speed_1="1.5 m/s", speed_2="0.5 m/s", lubricant="paper", grid={"nodes": 65})
    rolling = Case.point(**BALL, entrainment_speed="1 m/s", lubricant="paper", grid={"nodes": 65})
    found = [
        ehlectric.film_factors(one, log(np.array([1e-7])), contacts="formula").mean.value
        for one in (sliding, rolling)
    ]
    assert found[0] == pytest.approx(found[1])


def test_measured_temperatures_without_effect_are_told(case):
    """The oil of the paper has one viscosity, whatever temperature the rig logged."""
    frame = log(np.full(2, 1e-7), **{"temperature [degC]": [30.0, 40.0]})
    found = ehlectric.film_factors(case, frame, contacts="formula", uncertainty="4 %")
    assert "temperature-unused" in [warning.code for warning in found.warnings]


def test_a_measured_temperature_is_that_of_its_row():
    oil = {
        "base": "paper",
        "temperature": {"kinematic_viscosity_40": "46 mm^2/s", "density_15": "870 kg/m^3"},
    }
    oil["temperature"]["kinematic_viscosity_100"] = "6.8 mm^2/s"
    case = Case.point(**BALL, entrainment_speed="1 m/s", lubricant=oil, temperature="40 degC")
    warm = formula(case.replace({"contact.temperature": "60 degC"}), 1.0)
    frame = log(np.array([warm]) * 0.8, **{"temperature [degC]": [60.0]})
    frame["entrainment speed [m/s]"] = 1.0
    found = ehlectric.film_factors(case, frame, contacts="formula")
    assert found.mean.value == pytest.approx(0.8)


@pytest.mark.parametrize(
    ("columns", "options", "words"),
    [
        ({"entrainment speed [m/s]": [1.0]}, {}, "film: "),
        ({"speed [rpm]": [1.0], "film [nm]": [1.0]}, {}, "'entrainment speed"),
        ({"film [nm]": [100.0]}, {"background": "1 pF"}, "background: "),
    ],
)
def test_what_does_not_belong_to_a_contact_is_refused(case, columns, options, words):
    with pytest.raises(InputError, match=words):
        ehlectric.film_factors(case, pd.DataFrame(columns), **options)


def test_a_temperature_without_data_of_the_oil_is_told_with_its_line():
    """FVA 3 has data from 20 to 110 degC."""
    case = Case.point(
        **BALL,
        entrainment_speed="1 m/s",
        temperature="40 degC",
        lubricant={"base": "fva-3"},
        grid={"nodes": 65},
    )
    columns = log(np.ones(2) * 1e-7, **{"temperature [degC]": [40.0, 150.0]})
    with pytest.raises(InputError, match=r"line 2: contact\.temperature: .*150 degC.* 20 to 110"):
        ehlectric.film_factors(case, columns, contacts="formula")
