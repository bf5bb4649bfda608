"""Contacts of many points of operation at once, against those of each point alone."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from ehlectric.bearing.preparation import films_too_thick, least_load, loads_to_solve, prepare_bearing
from ehlectric.bearing.quick_contacts import QUICK_METHODS, quick_curve
from ehlectric.bearing.ring_contacts import ContactCurve, beyond_model, left_out
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import atlas_film, in_atlas
from ehlectric.film.atlas.atlas_groups import Groups
from ehlectric.formulas.film_line import LineContact, moes, pan_hamrock
from ehlectric.formulas.film_point import PointContact, chittenden, hamrock_dowson, nijenbanning_venner_moes
from ehlectric.formulas.monotone_cubic import MonotoneCubic
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, contact_of
from tests.helpers.each import each
from tests.helpers.points import prepared_of_points, ring_of_points

NAMES = ("loads", "error", "moes_m", "moes_l")
# Capacitances of many balls come from polynomials through integrals of some of them: error over the
# capacitance of the whole contact, with the same filling around it.
TABLES = ("inside", "outside_oil", "outside_air")
OF_TABLES = 1e-8


def allowed_of_tables(values, name):
    """Error of a capacitance from a table: around a light contact there is more oil than in it."""
    return OF_TABLES * (values.inside + (values.outside_oil if name == "outside_oil" else values.outside_air))


def cases(tables, number, seed):
    """Bearings at random speeds, temperatures and loads: with light contacts, and some outside the atlas."""
    rng = np.random.default_rng(seed)
    made = []
    for _ in range(number):
        axial = {} if tables is ROLLERS else {"bearing__axial_load": rng.uniform(0.0, 500.0)}
        made.append(
            bearing_case(
                tables,
                bearing__inner_speed=rng.uniform(20.0, 1600.0),
                bearing__temperature=rng.uniform(290.0, 380.0),
                bearing__radial_load=10.0 ** rng.uniform(2.0, 3.6),
                **axial,
            )
        )
    return made


@pytest.fixture(scope="module", params=[BALLS, ROLLERS], ids=["balls", "rollers"])
def bearings(request):
    """Prepared bearings, alone and together."""
    alone = [prepare_bearing(case, 2) for case in cases(request.param, 12, 4)]
    return alone, prepared_of_points(alone)


@each("inner", [True, False])
def test_loads_of_points_are_those_of_each(bearings, inner):
    alone, together = bearings
    k = 0 if inner else 1
    loads, used = loads_to_solve(together, together.rings[k], quick=True)
    numbers = set()
    for point, prepared in enumerate(alone):
        own, all_used = loads_to_solve(prepared, prepared.rings[k], quick=True)
        assert all_used.all()
        numbers.add(own.size)
        np.testing.assert_allclose(loads[point][used[point]], own, rtol=1e-12)
        # Places that are not in use come first, and have the least load.
        np.testing.assert_allclose(loads[point][~used[point]], own[0], rtol=1e-12)
        assert np.all(np.diff(used[point].astype(int)) >= 0)
    assert len(numbers) > 1


@pytest.mark.slow
@pytest.mark.parametrize("inner", [True, False])
@pytest.mark.parametrize("way", ["atlas", "formula"])
def test_contacts_of_points_are_those_of_each(bearings, inner, way):
    alone, together = bearings
    k = 0 if inner else 1
    ring = together.rings[k]
    loads, used = loads_to_solve(together, ring, quick=True)
    curve = quick_curve(QUICK_METHODS[way](contact_of(ring, loads.T)), used)
    assert not np.any(curve.refused)
    left = 0
    for point, prepared in enumerate(alone):
        one = prepared.rings[k]
        own = quick_curve(QUICK_METHODS[way](contact_of(one, loads_to_solve(prepared, one, quick=True)[0])))
        mask = used[point]
        for name in NAMES:
            np.testing.assert_allclose(
                getattr(curve, name)[point][mask], getattr(own, name), rtol=1e-9, atol=1e-14, err_msg=name
            )
        for field in dataclasses.fields(own.values):
            found, expected = getattr(curve.values, field.name)[point][mask], getattr(own.values, field.name)
            allowed = allowed_of_tables(own.values, field.name) if field.name in TABLES else 1e-11 * expected
            assert np.all(np.abs(found - expected) <= allowed), field.name
        np.testing.assert_array_equal(curve.left[point][mask], own.left)
        left += np.count_nonzero(own.left)
        at = np.geomspace(0.5 * own.loads[0], 1.5 * own.loads[-1], 9)
        between, expected = curve.at(np.broadcast_to(at, (len(alone), 9))), own.at(at)
        for field in dataclasses.fields(expected):
            found, one = getattr(between, field.name)[point], getattr(expected, field.name)
            tables = field.name in TABLES
            allowed = 3.0 * allowed_of_tables(expected, field.name) if tables else 3e-8 * one
            assert np.all(np.abs(found - one) <= allowed), field.name
        for name in ("largest_error", "interpolation_error", "least_load", "thickest_film"):
            for found, expected in ((curve, own), (curve.counted, own.counted)):
                assert getattr(found, name)[point] == pytest.approx(
                    getattr(expected, name), rel=1e-9, abs=3e-8 if name == "interpolation_error" else 0.0
                ), name
    assert (left > 0) == (way == "atlas")


@each("tables", [BALLS, ROLLERS])
def test_a_point_that_is_refused_does_not_disturb_the_others(tables):
    """One ring stands still, and the ball of another one is wider than its groove takes."""
    rings = [prepare_bearing(case, 1).rings[0] for case in cases(tables, 5, 7)]
    loads = np.geomspace(20.0, 800.0, 6)[:, np.newaxis] * np.ones(5)
    good = quick_curve(QUICK_METHODS["atlas"](contact_of(ring_of_points(rings), loads)))
    wrong = [*rings]
    wrong[1] = dataclasses.replace(rings[1], speed=0.0)
    heavy = loads.copy()
    heavy[-1, 3] = 1e9
    contact = contact_of(ring_of_points(wrong), heavy)
    masks = beyond_model(contact)
    assert masks[:, 1].all()
    assert masks[:, 3].tolist() == [False] * 5 + [True]
    around = np.ones(loads.shape), np.zeros(loads.shape)
    curve = quick_curve(QUICK_METHODS["atlas"](contact), around=around)
    assert curve.refused.tolist() == [False, True, False, True, False]
    for name in ("central_thickness", "minimum_thickness", "inside", "hertz", "max_pressure"):
        found, expected = getattr(curve.values, name), getattr(good.values, name)
        np.testing.assert_allclose(found[[0, 2, 4]], expected[[0, 2, 4]], rtol=1e-13)
    # Alone, each of them is refused with its reason.
    with pytest.raises(InputError, match="entrainment speed"):
        QUICK_METHODS["atlas"](contact_of(wrong[1], loads[:, 1]))
    with pytest.raises(InputError, match="half of the smallest radius"):
        QUICK_METHODS["atlas"](contact_of(wrong[3], heavy[:, 3]))


def test_a_point_without_an_equilibrium_has_no_numbers():
    """Its angle and speed are NaN, as those of an angular-contact bearing without an axial load."""
    rings = [prepare_bearing(case, 1).rings[0] for case in cases(BALLS, 3, 9)]
    ring = ring_of_points(rings)
    lost = dataclasses.replace(
        ring,
        speed=np.where([False, True, False], np.nan, ring.speed),
        angle=ring.angle * [1.0, math.nan, 1.0],
    )
    loads = np.geomspace(20.0, 800.0, 4)[:, np.newaxis] * [1.0, math.nan, 1.0]
    around = np.ones(loads.shape), np.zeros(loads.shape)
    for way in ("atlas", "formula"):
        curve = quick_curve(QUICK_METHODS[way](contact_of(lost, loads)), around=around)
        assert curve.refused.tolist() == [False, True, False]
        assert np.isfinite(curve.values.inside[[0, 2]]).all()
        assert np.isnan(curve.values.central_thickness[1]).all()


@each("tables", [BALLS, ROLLERS])
def test_the_least_loads_of_points_are_those_of_each(tables):
    rings = [prepare_bearing(case, 1).rings[1] for case in cases(tables, 6, 3)]
    found = least_load(ring_of_points(rings))
    np.testing.assert_allclose(found, [least_load(ring) for ring in rings], rtol=1e-12)


def test_films_that_are_too_thick_are_those_of_each_point():
    """A roller of 30 N in thick oil leaves its raceway no room, as its single bearing says."""
    given = [prepare_bearing(case, 1) for case in cases(ROLLERS, 3, 5)]
    together = prepared_of_points(given)
    assert films_too_thick(together).tolist() == [False] * 3
    thick = dataclasses.replace(together.rings[0], speed=together.rings[0].speed * [1.0, 1e6, 1.0])
    together.rings = (thick, together.rings[1])
    assert films_too_thick(together).tolist() == [False, True, False]


def test_groups_outside_the_atlas_do_not_disturb_the_others():
    m = np.array([[20.0, 1e9, math.nan], [200.0, 2e3, 1e-12]])
    groups = Groups(m, np.array([8.0, 10.0, 8.0]), np.array([1.0, 3.0, 40.0]))
    film = atlas_film(groups)
    np.testing.assert_array_equal(film.known, [[True, False, False], [True, True, False]])
    np.testing.assert_array_equal(film.known, in_atlas(groups))
    np.testing.assert_array_equal(np.isfinite(film.central), film.known)
    for place in zip(*np.nonzero(film.known), strict=True):
        alone = atlas_film(
            Groups(float(m[place]), float(groups.moes_l[place[1]]), float(groups.ratio[place[1]]))
        )
        for name in ("central", "minimum", "mean", "mass", "zone", "inlet", "outlet", "central_pressure"):
            assert getattr(film, name)[place] == pytest.approx(getattr(alone, name), rel=1e-13), name
        for name, error in alone.errors.items():
            assert film.errors[name][place] == pytest.approx(error, rel=1e-12), name


POINT_FORMULAS = (hamrock_dowson, chittenden, nijenbanning_venner_moes)


@each("formula", [moes, pan_hamrock, *POINT_FORMULAS])
def test_formulas_of_many_contacts_are_those_of_each(formula):
    """Loads over twelve powers of ten, and oils of which one does not stiffen under pressure."""
    rng = np.random.default_rng(2)
    load, alpha = 10.0 ** rng.uniform(-6.0, 6.0, (4, 5)), np.array([0.0, 1e-12, 1e-9, 2e-8, 3e-8])
    shared = {
        "reduced_modulus": 226e9,
        "entrainment_speed": rng.uniform(0.1, 20.0, 5),
        "viscosity": 10.0 ** rng.uniform(-3.0, 0.0, 5),
        "pressure_viscosity_coefficient": alpha,
    }
    if formula in POINT_FORMULAS:
        radii = {"radius_x": rng.uniform(1e-3, 1e-2, 5), "radius_y": rng.uniform(1e-2, 1e-1, 5)}
        kind, names = PointContact, radii | {"load": load} | shared
    else:
        kind, names = (
            LineContact,
            {"reduced_radius": rng.uniform(1e-3, 1e-2, 5), "load_per_length": load} | shared,
        )
    found = formula(kind(**names))
    for index in np.ndindex(load.shape):
        one = kind(
            **{name: float(np.broadcast_to(value, load.shape)[index]) for name, value in names.items()}
        )
        for name, value in vars(formula(one)).items():
            if value is not None:
                assert getattr(found, name)[index] == pytest.approx(value, rel=1e-12, abs=0.0)


def test_curves_are_those_of_scipy_without_the_nodes_that_are_not_in_use():
    rng = np.random.default_rng(5)
    for size in range(1, 8):
        x = np.cumsum(rng.uniform(0.1, 2.0, (20, size)), axis=-1)
        y = rng.normal(size=(3, 20, size)) * rng.integers(0, 2, (3, 20, size))
        first = rng.integers(0, size, 20)
        for point, place in enumerate(first):
            x[point, :place] = x[point, place]
            y[:, point, :place] = rng.uniform(-9.0, 9.0, (3, place))
        at = rng.uniform(-1.0, 1.0 + x.max(), (20, 9))
        curves = MonotoneCubic(x, y, first)(at)
        left = left_out(x, y, first) if size > 2 else None
        for point, place in enumerate(first):
            own = x[point, place:]
            for number in range(3):
                values = y[number, point, place:]
                within = np.clip(at[point], own[0], own[-1])
                expected = PchipInterpolator(own, values)(within) if own.size > 1 else np.full(9, values[0])
                np.testing.assert_allclose(curves[number, point], expected, rtol=1e-12, atol=1e-14)
                for node in range(1, own.size - 1):
                    law = PchipInterpolator(np.delete(own, node), np.delete(values, node))
                    found = left[number, point, place + node - 1]
                    assert found == pytest.approx(float(law(own[node])), rel=1e-12, abs=1e-14)


def test_a_quantity_that_is_infinite_at_one_load_is_infinite(bearings):
    alone, _ = bearings
    ring = alone[0].rings[0]
    curve = quick_curve(QUICK_METHODS["formula"](contact_of(ring, np.geomspace(20.0, 800.0, 5))))
    first, *others = curve.solutions
    values = dataclasses.replace(first.values, breakdown_voltage=math.inf)
    changed = ContactCurve.of([dataclasses.replace(first, values=values), *others])
    at = changed.at(np.array([100.0]))
    assert at.breakdown_voltage.tolist() == [math.inf]
    assert at.inside == pytest.approx(curve.at(np.array([100.0])).inside, rel=1e-12)
    assert changed.interpolation_error == math.inf
