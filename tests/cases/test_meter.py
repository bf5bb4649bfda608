"""Table meter of a case: what it needs, what it refuses, and how it is changed."""

from __future__ import annotations

import pytest

from ehlectric import Case
from tests.cases.test_point_case import BALL, NO_RADII, point
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each

COATING = {"thickness": "100 um", "relative_permittivity": 9, "strength": "20 V/um"}
PLANE = {"radius_x": 1e3, "radius_y": 1e3}
CROWNED = {"radius_x": 6e-3, "radius_y": 0.5}
BEFORE_OUTLET = [{"surface": 2, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "40 um"}]


def line(meter, **tables):
    table = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "meter": meter}
    return Case.from_dict(table | tables)


@each("fill, share", [("oil", 1.0), ("air", 0.0), (0.4, 0.4), ("40 %", 0.4)])
def test_fill_is_a_share(fill, share):
    case = point(meter={"fill": fill, "coating": COATING})
    assert case.meter.fill == share
    assert case.meter.coating.thickness_in_vacuum == pytest.approx(100e-6 / 9)
    assert Case.from_dict(case.to_dict()) == case


@each("bodies", [(PLANE, BALL), (BALL, BALL), (BALL, CROWNED)])
def test_a_ball_on_an_open_body_needs_no_width(bodies):
    first, second = bodies
    assert point(NO_RADII | {"body_1": first, "body_2": second}, meter={"fill": "air"}).meter.length is None


def test_the_length_of_a_line_may_be_that_of_its_discharge():
    assert line({"fill": "oil"}, discharge={"length": "12 mm"}).meter.length is None


def test_alternatives_and_geometry_are_replaced():
    case = line({"fill": "oil", "length": "10 mm"})
    assert case.replace({"meter.oil_radius": "2 mm"}).meter.fill is None
    changed = {"contact.geometry": "point", "contact.radius_x": 0.01, "contact.radius_y": 0.01}
    assert case.replace(changed | {"contact.load": 20.0}).meter.length is None


def test_keywords_make_the_table():
    contact = {"radius_x": 0.01, "radius_y": 0.01, "reduced_modulus": 2e11, "load": 20.0}
    case = Case.point(**contact, entrainment_speed=1.0, lubricant="paper", meter={"fill": "air"})
    assert case.meter.fill == 0.0
