"""Planes as bodies, with an infinite radius: 1/R = 1/R1 + 1/R2 is then the curvature of the other body."""

import json
import math

import pint
import pytest

import ehlectric
from ehlectric import Case, InputError
from ehlectric.cases.meter_inputs import body_radii
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.report.appendix import input_text
from ehlectric.sweep.run import run_sweep
from ehlectric.sweep.store import read_sweep
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

SHARED = {"reduced_modulus": "226 GPa", "entrainment_speed": "2 m/s"}
LINE = SHARED | {"load_per_length": "400 kN/m", "radius_1": "inf", "radius_2": "14.1 mm"}
POINT = SHARED | {"geometry": "point", "load": "20 N"}
PLANE, BALL = ({"radius_x": radius, "radius_y": radius} for radius in ("inf mm", "10 mm"))
GRID = {"nodes": 129}


def line(**changes):
    return Case.from_dict({"contact": LINE | changes, "lubricant": {"base": "paper"}, "grid": GRID})


def point(body_1, body_2):
    bodies = {"body_1": body_1, "body_2": body_2}
    return Case.from_dict({"contact": POINT | bodies, "lubricant": {"base": "paper"}})


@each(
    "radius",
    [
        *(
            math.inf,
            -math.inf,
            "inf",
            "inf mm",
            "+inf m",
            "-inf",
            "infinity",
            "infinite",
            "∞",
            "∞ mm",
            "plane",
        ),
        *("flat", "Plane", pint.UnitRegistry().Quantity(math.inf, "mm")),
    ],
)
def test_a_plane_and_a_cylinder(radius):
    for plane, other in (("radius_1", "radius_2"), ("radius_2", "radius_1")):
        conditions = resolve(line(**{plane: radius, other: "14.1 mm"}))
        assert conditions.reduced_radius == pytest.approx(14.1e-3, rel=1e-15)
        assert conditions.curvature_share == (1.0 if other == "radius_1" else 0.0)


def test_a_ball_on_a_plane_and_crossed_cylinders():
    for bodies in ((PLANE, BALL), (BALL, PLANE)):
        conditions = resolve_point(point(*bodies))
        assert (conditions.radius_x, conditions.radius_y) == pytest.approx((0.01, 0.01), rel=1e-15)
    along, across = {"radius_x": "10 mm", "radius_y": "inf"}, {"radius_x": math.inf, "radius_y": "30 mm"}
    conditions = resolve_point(point(along, across))
    assert (conditions.radius_x, conditions.radius_y) == pytest.approx((0.01, 0.03), rel=1e-15)


def test_a_plane_is_the_limit_of_a_large_body():
    """Radii of 1 km, the largest finite one, differ from a plane by 14 parts in a million."""
    films = [
        ehlectric.solve(line(radius_1=radius)).summary()["film"]["minimum_thickness"]
        for radius in ("inf", "1 km")
    ]
    assert films[0] == pytest.approx(films[1], rel=2e-5)
    assert list(body_radii(line().contact)) == [(math.inf, math.inf), (0.0141, math.inf)]


@each(
    "make, text",
    [
        (lambda: resolve(line(radius_2="inf")), "two planes"),
        (lambda: resolve_point(point(PLANE, PLANE)), "two planes"),
        (lambda: resolve_point(point(PLANE, {"radius_x": "10 mm", "radius_y": "inf"})), "geometry = 'line'"),
        (lambda: resolve(line(radius_2="-14.1 mm")), "a concave body must be wider"),
        (lambda: line(radius_1="inf N"), "or 'inf' for a plane"),
        (lambda: line(radius_1="nan"), "or 'inf' for a plane"),
        (lambda: line(radius_1=None, radius_2=None, reduced_radius="inf"), "it is not finite"),
        (lambda: line(load_per_length="inf"), "it is not finite"),
    ],
)
def test_what_is_no_contact_is_refused_with_the_reason(make, text):
    with pytest.raises(InputError, match=text):
        make()


def test_a_plane_is_saved_and_loaded(tmp_path):
    case = line(radius_1=-math.inf)
    assert Case.from_dict(case.to_dict()) == case
    path = tmp_path / "case.toml"
    path.write_text(case.to_toml())
    assert Case.from_toml(path) == case
    path.write_text(case.to_toml().replace('"inf"', "-inf"))
    assert Case.from_toml(path) == case
    assert json.loads(json.dumps(case.to_dict(), allow_nan=False))["contact"]["radius_1"] == "inf"
    ehlectric.save(ehlectric.solve(case), tmp_path / "out")
    assert ehlectric.load(tmp_path / "out").case == case
    json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    assert input_text(case, "contact.radius_1", "inf") == "infinite, a plane"


@pytest.mark.slow
def test_a_sweep_from_a_cylinder_to_a_plane(tmp_path):
    """The film grows with the reduced radius. The line ends at the last finite radius, with a warning."""
    radii = ["50 mm", "1 m", "inf"]
    sweep = Sweep.from_dict({"case": line(), "vary": {"contact.radius_1": radii}})
    assert sweep.axes["contact.radius_1"] == (0.05, 1.0, math.inf)
    results = run_sweep(sweep, tmp_path, workers=1)
    films = [one.summary["film"]["minimum_thickness"] for one in results.points]
    assert films == sorted(films)
    again = read_sweep(tmp_path)
    assert again.axes == sweep.axes
    assert [one.inputs for one in again.points] == [one.inputs for one in results.points]
    with pytest.warns(UserWarning, match="1 of 3 points"):
        results.plot(value="film.minimum_thickness", x="contact.radius_1")
    with pytest.raises(InputError, match="finite"):
        Sweep.from_dict(
            {"case": line(), "vary": {"contact.radius_1": {"from": 0.1, "to": "inf", "count": 3}}}
        )
