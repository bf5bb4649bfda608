"""Cases of point contacts: alternatives, bounds, messages, replacement, round trips and what they mean."""

import re

import numpy as np
import pytest
from hypothesis import given, settings

from ehlectric import Case, InputError
from ehlectric.cases.amounts import Amount
from ehlectric.contact.conditions import default_side, resolve, resolve_point
from ehlectric.contact.contact_memory import check_memory
from ehlectric.contact.warnings import case_warnings
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each
from tests.helpers.strategies import point_tables

POINT = {
    "geometry": "point",
    "radius_x": "10 mm",
    "radius_y": "10 mm",
    "reduced_modulus": "226 GPa",
    "load": "20 N",
    "entrainment_speed": "2 m/s",
}
STEEL = {"youngs_modulus": 206e9, "poissons_ratio": 0.3}
RING = {"radius_x": 24e-3, "radius_y": -6.191e-3}
BALL = {"radius_x": 5.953e-3, "radius_y": 5.953e-3}


def table(contact=None, **tables):
    """The 20 N circle with keys of its contact changed, or dropped where they are None, and other tables."""
    changed = {key: value for key, value in (POINT | (contact or {})).items() if value is not None}
    return {"contact": changed, "lubricant": {"base": "paper"}, **tables}


def point(contact=None, **tables):
    return Case.from_dict(table(contact, **tables))


NO_RADII = {"radius_x": None, "radius_y": None}
NO_MODULUS = {"reduced_modulus": None}


def test_grid_of_a_point_has_its_own_defaults():
    grid = point().grid
    assert (grid.nodes, grid.ends) == (None, (-4.5, 1.5))
    assert (grid.field_range, grid.field_side) == ((-1.25, 1.25), 1.25)
    assert (grid.nodes_y, grid.side, grid.field_nodes, grid.field_nodes_y) == (None, None, None, None)
    part = point(grid={"nodes": 129}).grid
    assert (part.nodes, part.ends[0]) == (129, -4.5)
    line = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}}).grid
    assert (line.nodes, line.ends[0], line.field_side) == (None, -4.0, None)


def test_parts_make_a_case_as_tables_do():
    case = point(grid={"nodes": 129})
    again = Case(contact=case.contact, lubricant=case.lubricant, grid=type(case.grid)(nodes=129))
    assert again == case


@each("given, value", [("3 %", 0.03), ("3%", 0.03), (0.03, 0.03), ("0.01 percent", 1e-4)])
def test_refine_takes_percent(given, value):
    assert point(grid={"refine": given}).grid.refine == value
    line = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"refine": given}}
    assert Case.from_dict(line).grid.refine == value


@each("given", ["3", "3 % %", "3 rad", "3 m/m", "3 kg", "%"])
def test_a_fraction_takes_no_other_text(given):
    with pytest.raises(ValueError, match="it is not a number in percent"):
        Amount("", least=0.0, most=1.0, fraction=True).parse(given)


def test_other_numbers_without_unit_take_no_percent():
    with pytest.raises(InputError, match=r"slide_to_roll_ratio: got '3 %' \(it is not a number\)"):
        point({"slide_to_roll_ratio": "3 %"})


# Radii and elastic constants, each of the pair or reduced, in every combination.
COMBINATIONS = {
    "reduced": {},
    "radii of bodies": {**NO_RADII, "body_1": RING, "body_2": BALL},
    "moduli of bodies": {**NO_MODULUS, "body_1": STEEL, "body_2": STEEL},
    "all of bodies": {**NO_RADII, **NO_MODULUS, "body_1": RING | STEEL, "body_2": BALL | STEEL},
}


@each("name", COMBINATIONS)
def test_alternatives_combine(name):
    """By hand: 1/Rx = 1/24 + 1/5.953, 1/Ry = 1/5.953 - 1/6.191 per mm; E' = 206 GPa/0.91."""
    conditions = resolve_point(point(COMBINATIONS[name]))
    radii = (
        (4.7699e-3, 154.85e-3) if ("bodies" in name and "radii" in name) or "all" in name else (0.01, 0.01)
    )
    modulus = 226.374e9 if "moduli" in name or "all" in name else 226e9
    assert (conditions.radius_x, conditions.radius_y) == pytest.approx(radii, rel=1e-4, abs=0.0)
    assert conditions.reduced_modulus == pytest.approx(modulus, rel=1e-5, abs=0.0)


def test_shares_of_unequal_bodies():
    """Compliances 1/200 and 1/300: three to two."""
    body_1 = {"radius_x": 0.01, "radius_y": 0.01, "youngs_modulus": 200e9, "poissons_ratio": 0.0}
    body_2 = {"radius_x": 0.02, "radius_y": -0.02, "youngs_modulus": 300e9, "poissons_ratio": 0.0}
    conditions = resolve_point(point(NO_RADII | NO_MODULUS | {"body_1": body_1, "body_2": body_2}))
    assert conditions.compliance_share == pytest.approx(0.6)
    assert resolve_point(point()).compliance_share == 0.5


def test_circle_by_hand():
    """b = (3 F R/(2 E'))^(1/3) = 109.9 um, p_h = 3 F/(2 pi b^2), lambda = 12 eta0 u R^2/(b^3 p_h)."""
    conditions = resolve_point(point())
    b = (3 * 20 * 0.01 / (2 * 226e9)) ** (1 / 3)
    p_h = 3 * 20 / (2 * np.pi * b**2)
    assert conditions.half_width == pytest.approx(b)
    assert conditions.ratio == 1.0
    assert conditions.thickness_scale == pytest.approx(b**2 / 0.01)
    assert conditions.velocity_parameter == pytest.approx(12 * 0.04 * 2 * 0.01**2 / (b**3 * p_h))
    assert conditions.side == 3.0
    again = resolve_point(point({"load": None, "max_hertz_pressure": p_h}))
    assert again.load == pytest.approx(20.0, rel=1e-12, abs=0.0)


def test_ratios_of_the_6208():
    """The two contacts of its balls have ratios of 9.3 and 7.3; grooves of 0.52 ball diameters."""
    inner = resolve_point(point(NO_RADII | {"load": 600, "body_1": RING, "body_2": BALL}))
    assert inner.ratio == pytest.approx(9.3, abs=0.05)
    outer = {"radius_x": -36e-3, "radius_y": -6.191e-3}
    conditions = resolve_point(point(NO_RADII | {"load": 600, "body_1": outer, "body_2": BALL}))
    assert conditions.ratio == pytest.approx(7.3, abs=0.05)


def test_entrainment_may_run_along_the_major_axis():
    across = resolve_point(point({"radius_x": 0.005, "radius_y": 0.05}))
    along = resolve_point(point({"radius_x": 0.05, "radius_y": 0.005}))
    assert along.semi_axis_x == pytest.approx(across.semi_axis_y, rel=1e-12, abs=0.0)
    assert along.max_pressure == pytest.approx(across.max_pressure, rel=1e-12, abs=0.0)
    assert along.ratio < 1.0 < across.ratio


def test_sides_shrink_with_the_ratio():
    sides = [default_side(k) for k in (0.1, 0.5, 1.0, 4.0, 1e6)]
    assert sides == sorted(sides, reverse=True)
    assert (sides[2], sides[-1]) == (3.0, pytest.approx(1.6, rel=1e-5, abs=0.0))
    assert resolve_point(point(grid={"side": 2.5})).side == 2.5


def test_semi_axes_are_compared_with_the_radii_of_their_plane():
    """A narrow long ellipse, wider across than the ball is along, is no contradiction."""
    case = point({"radius_x": 1e-3, "radius_y": 10.0, "load": 10.0})
    conditions = resolve_point(case)
    assert conditions.semi_axis_y > 0.5 * conditions.radius_x
    assert conditions.semi_axis_x < 0.1 * conditions.radius_x


WARNINGS = [
    ({"load": "1 N", "reduced_modulus": "2 MPa"}, {"ambient_pressure": 0.0}, "isoviscous-elastic"),
    (
        {"load": "5 mN"},
        {"ambient_pressure": 0.0},
        r"isoviscous-rigid .*grid\.inlet",
    ),
    ({"max_hertz_pressure": "20 MPa", "load": None}, {}, r"ambient .* 8\.6 %"),
    ({"max_hertz_pressure": "4.3 GPa", "load": None}, {}, r"4\.2 GPa"),
    ({}, {"viscosity_law": "barus"}, "Barus"),
    ({}, {"roelands_z": 0.4}, r"0\.675"),
]


@each("contact, lubricant, message", WARNINGS)
def test_warnings_before_solving(contact, lubricant, message):
    """The ambient share by hand: 1e5/20e6 6 6/(2 pi/3) = 0.086."""
    case = Case.from_dict(table(contact) | {"lubricant": {"base": "paper"} | lubricant})
    texts = list(map(str, case_warnings(case, resolve_point(case))))
    assert any(re.search(message, text) for text in texts), texts


def test_common_contacts_need_no_warning():
    assert not list(case_warnings(point(), resolve_point(point())))
    bearing = point(NO_RADII | {"load": 600, "body_1": RING, "body_2": BALL})
    assert not list(case_warnings(bearing, resolve_point(bearing)))


def test_each_geometry_is_resolved_by_its_own():
    line = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}})
    with pytest.raises(InputError, match="got 'point'; expected 'line'"):
        resolve(point())
    with pytest.raises(InputError, match="got 'line'; expected 'point'"):
        resolve_point(line)


def test_replace_displaces_alternatives():
    case = point()
    other = case.replace(
        {"contact.max_hertz_pressure": "1 GPa", "contact.body_1": STEEL, "contact.body_2": STEEL}
    )
    assert (other.contact.load, other.contact.reduced_modulus) == (None, None)
    bodies = other.replace(contact={"body_1": RING, "body_2": BALL})
    assert bodies.contact.radius_x is None
    assert bodies.contact.body_1.youngs_modulus == 206e9
    reduced = bodies.replace({"contact.radius_x": 0.01, "contact.radius_y": 0.01})
    assert reduced == other
    back = reduced.replace({"contact.load": 20.0, "contact.reduced_modulus": 226e9})
    assert back == case


def test_replace_changes_the_geometry():
    line = Case.from_dict(
        {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"wedge": "first-order"}}
    )
    round_one = {
        "contact.geometry": "point",
        "contact.load": 20.0,
        "contact.radius_x": 0.01,
        "contact.radius_y": 0.01,
    }
    case = line.replace(round_one)
    assert (case.first_grid.nodes, case.grid.wedge) == (129, "first-order")
    assert case.contact.reduced_modulus == line.contact.reduced_modulus
    again = case.replace(
        {f"contact.{key}": value for key, value in PAPER_CONTACT.items()}, contact={"geometry": "line"}
    )
    assert again == line
    with pytest.raises(InputError, match=r"contact\.radius_x: missing"):
        line.replace({"contact.geometry": "point", "contact.load": 20.0})
    with pytest.raises(InputError, match=r"contact\.geometry: got 'ball'"):
        line.replace({"contact.geometry": "ball"})


def test_replace_takes_parts_of_another_case():
    case, other = point(), point({"load": None, "max_hertz_pressure": 1e9}, grid={"nodes": 129, "side": 2.0})
    assert case.replace(contact=other.contact, grid=other.grid) == other


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(table=point_tables)
def test_cases_of_all_kinds_survive_tables_and_files(table, tmp_path_factory):
    case = Case.from_dict(table)
    assert Case.from_dict(case.to_dict()) == case
    path = tmp_path_factory.getbasetemp() / "point.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert Case.from_toml(path) == case
    assert case.replace() == case


@settings(deadline=None, max_examples=60)
@given(table=point_tables)
def test_any_case_means_something_or_is_refused_in_words(table):
    case = Case.from_dict(table)
    try:
        conditions = resolve_point(case)
    except InputError as error:
        message = str(error)
        assert message.startswith(("contact", "grid.", "lubricant."))
        assert "\n" not in message
        return
    list(case_warnings(case, conditions))
    numbers = [value for value in vars(conditions).values() if isinstance(value, float)]
    assert np.isfinite(numbers).all()


def test_grids_that_do_not_fit_into_memory(monkeypatch):
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 1e9)
    check_memory(point())
    with pytest.raises(InputError, match=r"grid\.nodes: .*2049 x 2049 .* 1 GB"):
        check_memory(point(grid={"nodes": 2049}))
    with pytest.raises(InputError, match=r"grid\.field_nodes: .*4001 x 4001 .*field_degree 20"):
        check_memory(point(grid={"field_nodes": 4001, "field_nodes_y": 4001, "field_degree": 20}))
