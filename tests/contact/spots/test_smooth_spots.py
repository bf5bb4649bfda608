"""Smooth surfaces that touch on a grid that is too coarse for their film are not to be used."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.bearing.ring_contacts import without_regime
from ehlectric.bearing.warnings import contact_warnings
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.touching import _smooth_spots

LINE = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
BALL = {"geometry": "point", "radius_x": "12.7 mm", "radius_y": "12.7 mm", "reduced_modulus": "117 GPa"}
BALL |= {"load": "30 N"}
CODE = "smooth-surfaces-touch"


def solved(contact, oil="paper", **grid):
    lubricant = {"base": oil} if isinstance(oil, str) else oil
    return solve(Case.from_dict({"contact": contact, "lubricant": lubricant, "grid": grid}))


def severe(result):
    return [warning.code for warning in result.warnings if warning.severity == "severe"]


def test_a_line_whose_film_two_coarse_grids_do_not_show():
    """Its film on 6401 nodes is 3.5 nm. On 101 and on 51 nodes contact carries nearly all of the load."""
    result = solved(LINE | {"entrainment_speed": "2 mm/s"}, nodes=101)
    assert result.film.minimum_thickness == pytest.approx(1e-9)
    assert severe(result) == [CODE]


@pytest.mark.slow
def test_the_same_line_on_a_grid_that_resolves_it():
    result = solved(LINE | {"entrainment_speed": "2 mm/s"})
    assert result.film.minimum_thickness == pytest.approx(3.5e-9, rel=0.05)
    assert severe(result) == []


@pytest.mark.slow
def test_a_line_that_is_nearly_at_rest_does_touch():
    """The formula expects a tenth of the boundary film, and all grids agree."""
    result = solved(LINE | {"entrainment_speed": "0.01 mm/s"}, nodes=401)
    assert result.film.contact.any()
    assert severe(result) == []


@pytest.mark.slow
@pytest.mark.parametrize("film", [None, {"rheology": "eyring"}])
def test_a_ball_whose_film_touches_on_a_coarse_grid_only(film):
    """The central film is 11 nm. On 65 x 65 nodes the side lobes touch."""
    oil = {"base": "iso-vg-46", "eyring_stress": "5 MPa"}
    contact = BALL | {"entrainment_speed": "0.02 m/s", "temperature": "60 degC"}
    tables = {"contact": contact, "lubricant": oil, "grid": {"nodes": 65}}
    coarse = solve(Case.from_dict(tables if film is None else tables | {"film": film}))
    assert coarse.film.contact.any()
    assert CODE in severe(coarse)


def test_a_bearing_has_the_warning_of_its_contacts():
    result = solved(LINE | {"entrainment_speed": "2 mm/s"}, nodes=101)

    class Contact:
        load = 100.0
        warnings = without_regime(result.warnings)

    found = contact_warnings({"inner": [Contact], "outer": []})
    assert [warning.code for warning in found if warning.severity == "severe"] == [CODE]


@pytest.mark.parametrize(("number", "text"), [(1, "1 spot"), (2, "2 spots"), (11, "11 spots")])
def test_the_number_of_spots_is_stated(number, text):
    film = SimpleNamespace(discretisation_error=0.2, axes=(np.zeros(9), np.zeros(5)))
    case = Case.from_dict({"contact": BALL | {"entrainment_speed": "1 m/s"}, "lubricant": {"base": "paper"}})
    (warning,) = _smooth_spots(case, resolve_point(case), film, number, known=False)
    assert re.search(rf"\b{text}\b", warning.text)
