"""Film formulas outside their ranges are marked, and within them differ from the atlas by up to 40 %."""

import math

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.cases.case_oil import Lubricant
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.warnings import case_warnings
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import contact_film
from ehlectric.formulas import film_line, film_point
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz import axis_ratio
from ehlectric.runs.preview import preview_of
from tests.helpers.each import each

STATED = 0.4

BALL = {"geometry": "point", "radius_x": "15 mm", "radius_y": "15 mm", "reduced_modulus": "230 GPa"}
BALL |= {"load": "0.8 N", "entrainment_speed": "3 m/s"}
OIL = {"base": "paper", "viscosity": "50 mPa s", "viscosity_law": "barus"}
OIL |= {"pressure_viscosity_coefficient": "22 1/GPa"}


def case(**contact):
    return Case.from_dict({"contact": BALL | contact, "lubricant": OIL})


def test_formulas_of_hard_contacts_are_marked_in_a_rigid_contact():
    """The rigid isoviscous film of a ball, 140 (U/W)^2 R, is 17 times the film of Hamrock and Dowson."""
    conditions = resolve_point(case())
    rigid = 140.0 * (0.05 * 3.0 / 0.8) ** 2 * 0.015**3
    assert rigid == pytest.approx(16.6e-6, rel=3e-3)
    films = {name: f(conditions.contact).central_thickness for name, f in film_point.FORMULAS.items()}
    assert films["nijenbanning_venner_moes"] == pytest.approx(rigid, rel=0.25)
    ranges = preview_of(case()).summary["film_formula_ranges"]
    for name in ("hamrock_dowson", "chittenden"):
        assert films[name] < 0.1 * rigid
        assert set(ranges[name].values()) == {"isoviscous-rigid regime"}
    assert set(ranges["nijenbanning_venner_moes"].values()) == {None}


def test_rows_mark_formulas_and_limit_their_accuracy():
    rows = [(row.name, row.note) for row in preview_of(case()).rows]
    marked = {name for name, note in rows if "outside its range: isoviscous-rigid regime" in note}
    assert marked == {
        f"{film} film ({name})"
        for film in ("minimum", "central")
        for name in ("Hamrock-Dowson", "Chittenden et al.")
    }
    assert "formulas within their range" in dict(rows)["usual difference from a solved film"]
    hard = [(row.name, row.note) for row in preview_of(case(load="100 N")).rows]
    assert not any("outside" in note for _, note in hard)


@each(
    "contact, holds",
    [
        ({}, "Nijenbanning, Venner and Moes"),
        (
            {"reduced_modulus": "10 MPa", "load": "60 N", "entrainment_speed": "0.1 m/s"},
            "Nijenbanning, Venner and Moes",
        ),
    ],
)
def test_every_regime_says_that_formulas_do_not_hold(contact, holds):
    one = case(**contact)
    (text,) = [w.text for w in case_warnings(one, resolve_point(one)) if w.code == "regime"]
    assert f"where only the film-thickness formula of {holds} holds" in text


def test_a_rigid_line_says_that_formulas_do_not_hold():
    contact = {"reduced_radius": "15 mm", "reduced_modulus": "230 GPa", "load_per_length": "500 N/m"}
    one = Case.from_dict({"contact": contact | {"entrainment_speed": "8 m/s"}, "lubricant": OIL})
    (text,) = [w.text for w in case_warnings(one, resolve(one)) if w.code == "regime"]
    assert "where only the film-thickness formula of Moes holds" in text


@each(
    "changes, name, key, word",
    [
        ({"radius_y": 5e-3}, "hamrock_dowson", "central_thickness", "semi-axes"),
        ({"radius_y": 5e-3}, "nijenbanning_venner_moes", "central_thickness", "Rx/Ry = 2"),
        ({"radius_y": 1.0, "load": 2e3}, "hamrock_dowson", "central_thickness", "range 1 to 8"),
        ({"load": 2e4}, "hamrock_dowson", "minimum_thickness", "heavy load"),
        ({"load": 2e4}, "chittenden", "minimum_thickness", "heavy load"),
        ({"load": 2e4}, "chittenden", "central_thickness", ""),
        ({}, "hamrock_dowson", "minimum_thickness", ""),
    ],
)
def test_ranges_of_points(changes, name, key, word):
    """Ry = 100 Rx has a/b = 18, and 20 kN on a ball of 10 mm are above M = 250."""
    numbers = {"radius_x": 10e-3, "radius_y": 10e-3, "reduced_modulus": 226e9, "load": 20.0}
    contact = PointContact(
        **(numbers | changes), entrainment_speed=2.0, viscosity=0.04, pressure_viscosity_coefficient=22e-9
    )
    reason = film_point.FORMULAS[name].ranges(contact)[key]
    assert (word in reason) if word else reason is None


def drawn(rng, kind, oil):
    """Random contact of an oil, of which the atlas may have no film."""

    def between(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    modulus, speed, radius = between(20e9, 300e9), between(0.01, 30.0), between(2e-3, 5e-2)
    common = {
        "reduced_modulus": modulus,
        "entrainment_speed": speed,
        "viscosity": oil.viscosity,
        "pressure_viscosity_coefficient": oil.alpha_star,
    }
    if kind == "line":
        return LineContact(reduced_radius=radius, load_per_length=between(1e2, 3e6), **common)
    radii = {"radius_x": radius, "radius_y": radius * between(0.3, 30.0)}
    return PointContact(**radii, load=between(1e-2, 3e3), **common)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("kind", "module", "number"), [("line", film_line, 120), ("point", film_point, 240)])
def test_stated_differences_are_kept_within_the_ranges(kind, module, number):
    """Random contacts of the atlas, in all regimes; its own error is up to some per cent."""
    rng, found, tried = np.random.default_rng(5), 0, 0
    worst = dict.fromkeys(("within", "outside"), 0.0)
    while found < number:
        tried += 1
        assert tried < 20 * number
        law = [{}, {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}][tried % 2]
        oil = Lubricant.from_dict(
            {"base": "paper", **law, "viscosity": float(10 ** rng.uniform(-2.7, 0))}
        ).at(None)
        contact = drawn(rng, kind, oil)
        try:
            film = contact_film(contact, oil)
        except InputError:
            continue
        found += 1
        for name, formula in module.FORMULAS.items():
            ranges, films = formula.ranges(contact), vars(formula(contact))
            for key, value in films.items():
                if value is None:
                    continue
                off = abs(float(value) / float(getattr(film, key)) - 1.0)
                where = "within" if ranges[key] is None else "outside"
                worst[where] = max(worst[where], off)
                if where == "within":
                    error = float(film.errors[key.removesuffix("_thickness")])
                    ratio = axis_ratio(contact.radius_x, contact.radius_y) if kind == "point" else 0.0
                    assert off <= STATED + error, (name, key, off, contact.moes_m, contact.moes_l, ratio)
    assert worst["outside"] > STATED
