"""Films of the atlas against contacts that are solved here and not in it."""

import json
import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from benchmarks.atlas_nodes import groups_of, measured, record

from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact.conditions import line_conditions, point_conditions
from ehlectric.contact.problems import geometry_of
from ehlectric.contact.solver import solve_contact
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import (
    OilGroups,
    atlas_film,
    contact_film,
    film_coefficient,
    reference_groups,
    reference_laws,
)
from ehlectric.film.atlas.atlas_groups import Groups
from ehlectric.film.atlas.atlas_problem import film_problem
from ehlectric.film.atlas.atlas_table import NAMES, Table, _file
from ehlectric.film.far_field import with_far_field
from ehlectric.film.isothermal_film import solve_film, solve_point_film
from ehlectric.film.nested import nested_iteration
from ehlectric.film.patch import Patch
from ehlectric.formulas.film_line import moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.formulas.tensor_spline import TensorSpline
from ehlectric.lubricant.density import incompressible
from ehlectric.lubricant.viscosity import barus, roelands
from ehlectric.runtime.threads import quiet_solution

PAPER = Lubricant.from_dict({"base": "paper"}).at(None)


def inside(found, solved, error):
    """Whether a number keeps its stated error, with room for the error of the film solved here."""
    return abs(found / solved - 1.0) <= error + 0.004


def test_groups_are_those_of_conditions():
    """Velocity parameter, Hertz pressure and unit of the film follow from M, L and k."""
    line = line_conditions(
        PAPER, reduced_radius=0.01, reduced_modulus=226e9, load_per_length=2e5, entrainment_speed=3.0
    )
    groups = Groups(line.contact.moes_m, line.contact.moes_l)
    alpha = PAPER.alpha_star
    assert groups.velocity_parameter == pytest.approx(line.velocity_parameter)
    assert groups.hertz_number == pytest.approx(alpha * line.max_pressure)
    unit = 0.01 * math.sqrt(2.0 * line.contact._u)
    assert groups.formula * unit == pytest.approx(moes(line.contact).central_thickness)
    point = point_conditions(
        PAPER, radii=(0.008, 0.05), reduced_modulus=226e9, load=100.0, entrainment_speed=3.0
    )
    groups = Groups(point.contact.moes_m, point.contact.moes_l, point.ratio)
    assert groups.velocity_parameter == pytest.approx(point.velocity_parameter)
    assert groups.hertz_number == pytest.approx(alpha * point.max_pressure)
    assert groups.radius_ratio == pytest.approx(0.05 / 0.008)
    unit = point.radius_x * math.sqrt(2.0 * point.contact._u)
    assert groups.thickness_unit * unit == pytest.approx(point.thickness_scale)
    assert groups.formula * unit == pytest.approx(nijenbanning_venner_moes(point.contact).central_thickness)
    again = groups_of(groups.load_group, groups.moes_l, groups.ratio)
    assert again.moes_m == pytest.approx(groups.moes_m)


@pytest.mark.parametrize("ratio", [None, 3.0])
def test_the_inlet_of_thick_films_grows_as_the_root_of_the_film(ratio):
    """sqrt(R h)/b = sqrt(H): the gap at the inlet edge is the same multiple of the film for all loads."""
    groups = Groups(np.array([2.0, 5.0, 15.0]), 5.0, ratio)
    inlet, _ = groups.domain
    assert inlet == pytest.approx(
        inlet[0] * np.sqrt(film := groups.formula / groups.thickness_unit) / film[0] ** 0.5
    )
    assert np.all(inlet[0] > 5.0)


def test_problem_of_a_point_is_that_of_its_conditions():
    point = point_conditions(
        PAPER, radii=(0.008, 0.05), reduced_modulus=226e9, load=100.0, entrainment_speed=3.0
    )
    groups = Groups(point.contact.moes_m, point.contact.moes_l, point.ratio)
    problem = film_problem(groups, (PAPER.log_viscosity, PAPER.density_ratio), PAPER.alpha_star, 65)
    expected = geometry_of(point)
    assert problem.geometry.load == pytest.approx(expected.load)
    influences = [geometry.influence((5, 5), 0.1, 0.1) for geometry in (problem.geometry, expected)]
    np.testing.assert_allclose(*influences, rtol=1e-9)


def test_coefficient_of_an_incompressible_barus_oil_is_its_alpha():
    def law(pressure):
        return barus(pressure, pressure_viscosity_coefficient=1.7e-8)

    assert film_coefficient(law, incompressible) == pytest.approx(1.7e-8, rel=1e-9)
    oil = OilGroups.of(law, incompressible)
    assert (oil.shape, oil.compressibility) == (pytest.approx(0.0, abs=1e-9), 0.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "temperature", "load", "speed"),
    [("fva-3", 343.15, 1e5, 4.0), ("iso-vg-32", 313.15, 3e5, 1.0), ("e-axle-fluid", 353.15, 5e4, 10.0)],
)
def test_line_contacts_of_library_oils(name, temperature, load, speed):
    oil = Lubricant.from_dict({"base": name}).at(temperature)
    conditions = line_conditions(
        oil, reduced_radius=8e-3, reduced_modulus=226e9, load_per_length=load, entrainment_speed=speed
    )
    found = contact_film(conditions.contact, oil)
    # The default domain, from -4 half-widths, takes 2 % off the films of these light contacts.
    film = solve_contact(conditions, oil, grid=Grid(nodes=9601, inlet=-18.0)).film
    assert inside(found.central_thickness, film.central_thickness, found.errors["central"])
    assert inside(found.minimum_thickness, film.minimum_thickness, found.errors["minimum"])
    assert inside(found.mean_thickness, film.mean_thickness, found.errors["mean"])
    assert found.errors["central"] < 0.03


STIFF = [
    {"pressure_viscosity_coefficient": alpha, "roelands_z": z, "roelands_pressure": p0}
    for alpha, z, p0 in ((20e-9, 0.67, 0.196e9), (15e-9, 0.5, 0.25e9), (28e-9, 0.75, 0.15e9))
]


@pytest.mark.slow
@pytest.mark.parametrize(
    "numbers", [(10.0, 10.0), (50.0, 8.0), (200.0, 12.0), (100.0, 5.0), (200.0, 0.7), (100.0, 0.8)]
)
def test_lines_with_incompressible_oils(numbers):
    """Beside films solved here, also of nearly constant viscosity, with no room for another error."""
    groups = Groups(*numbers)
    for oil in STIFF:
        laws = partial(roelands, **oil), incompressible
        found = atlas_film(groups, laws)
        film = solve_film(film_problem(groups, laws, OilGroups.of(*laws).alpha, 1601))
        for name in ("central", "minimum", "mean"):
            solved = groups.thickness_unit * getattr(film, f"{name}_thickness")
            assert abs(solved / getattr(found, name) - 1.0) <= 1.05 * found.errors[name]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("load", "lubricant", "ratio"), [(50.0, 8.0, 1.0), (200.0, 10.0, 3.0), (500.0, 6.0, 1.0)]
)
def test_points_with_an_incompressible_oil(load, lubricant, ratio):
    """The mean film was up to 4 % off, where 1.7 to 2.4 % were stated."""
    laws = partial(roelands, **STIFF[0]), incompressible
    groups = groups_of(load, lubricant, ratio)
    found = atlas_film(groups, laws)
    problem = film_problem(groups, laws, OilGroups.of(*laws).alpha, 129)
    film = solve_point_film(replace(problem, target_error=0.005, most_nodes=513))
    for name in ("central", "minimum", "mean"):
        solved = groups.thickness_unit * getattr(film, f"{name}_thickness")
        assert abs(solved / getattr(found, name) - 1.0) <= found.errors[name]


@pytest.mark.slow
@pytest.mark.parametrize(("load", "lubricant"), [(3.0, 3.0), (5.5, 1.0)])
def test_light_points_do_not_depend_on_the_domain_of_the_atlas(load, lubricant):
    """A tenth of the load lies outside of the domain; on one of twice the size the film is the same."""
    groups = groups_of(load, lubricant, 1.0)
    found = atlas_film(groups)
    own = film_problem(groups, reference_laws(), reference_groups().alpha, 257)
    assert own.outside_load > 0.07 * own.geometry.load
    wide = replace(own, inlet=2.0 * own.inlet, width=replace(own.width, side=2.0 * own.width.side))
    film = solve_point_film(with_far_field(replace(wide, nodes=513, width=replace(wide.width, nodes=513))))
    solved = groups.thickness_unit * film.central_thickness
    assert found.central == pytest.approx(solved, rel=min(0.02, found.errors["central"]))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "temperature", "load", "lubricant", "ratio"),
    [
        ("fva-3", 343.15, 60.0, 30.0, 6.0),
        ("iso-vg-32", 313.15, 8.5, 18.0, 1.3),
        ("m100", 313.15, 160.0, 60.0, 8.0),
    ],
)
def test_point_contacts_of_library_oils(name, temperature, load, lubricant, ratio):
    oil = Lubricant.from_dict({"base": name}).at(temperature)
    laws = (oil.log_viscosity, oil.density_ratio)
    groups = groups_of(load, lubricant / load ** (1.0 / 6.0), ratio)
    row = record(groups, laws, OilGroups.of(*laws).alpha)
    solved = dict(zip(NAMES, (4.0 * np.array(row["fine"]) - np.array(row["coarse"])) / 3.0, strict=True))
    found = atlas_film(groups, laws)
    assert inside(found.mass, solved["central"], found.errors["central"])
    assert inside(found.minimum, solved["minimum"], found.errors["minimum"])
    assert inside(found.mean, solved["mean"], found.errors["mean"])
    assert found.errors["minimum"] < 0.08


@pytest.mark.slow
def test_film_on_a_patch_is_that_on_the_whole_grid():
    """A patch with half of the spacings gives the numbers of the whole domain on the finer grid."""
    laws = reference_laws()
    groups = groups_of(300.0, 8.0, 2.0)
    problem = film_problem(groups, laws, OilGroups.of(*laws).alpha, 129)
    with quiet_solution():
        solutions = nested_iteration(problem, None)
        patch = Patch.around(problem, solutions[-1])
        inner = nested_iteration(patch.refined(2), None, solutions)[-1]
        whole = nested_iteration(problem.doubled(), None, solutions)[-1]
    numbers = measured(groups, problem, inner, patch)
    expected = measured(groups, problem, whole)
    coarse = measured(groups, problem, solutions[-1])
    np.testing.assert_allclose(numbers[:5], expected[:5], rtol=1e-3)
    np.testing.assert_allclose(numbers[5:7], expected[5:7], rtol=5e-3)
    assert np.all(np.abs(coarse - expected)[:2] > 4.0 * np.abs(numbers - expected)[:2])


def test_hertz_pressures_beyond_the_solved_ones_are_refused():
    with pytest.raises(InputError, match="alpha p_h"):
        atlas_film(groups_of(2000.0, 32.0, 6.0))


def test_outside_the_atlas_the_range_is_named():
    with pytest.raises(InputError, match="the range of the atlas"):
        atlas_film(Groups(1e6, 10.0))
    with pytest.raises(InputError, match="to 20, the range"):
        atlas_film(groups_of(100.0, 10.0, 30.0))


GROWTH = ((0.1, 0.1), (0.1, 0.1))


def test_a_cell_without_a_film_is_refused():
    axes = (np.array([1.0, 2.0, 4.0]), np.array([1.0, 2.0, 4.0]))
    solved = np.ones((3, 3), dtype=bool)
    solved[2, 2] = False
    made = Table(("a", "b"), axes, np.ones((3, 3, 2)), np.zeros((3, 3, 2)), solved, GROWTH)
    assert made(1.5, 3.0)[0] == pytest.approx([1.0, 1.0])
    with pytest.raises(InputError, match="solve it"):
        made(3.0, 3.0)
    assert made(2.0, 3.0)[0] == pytest.approx([1.0, 1.0])
    with pytest.raises(InputError, match="solve it"):
        made(4.0, 3.0)


def test_stated_error_of_interpolation_holds_between_nodes():
    """A smooth function on a coarse grid: the estimate is above the error at most points."""
    axes = [np.linspace(0.0, 3.0, 9), np.linspace(0.0, 2.0, 7)]
    x, y = np.meshgrid(*axes, indexing="ij")
    values = np.sin(2.0 * x + y)[..., np.newaxis]
    made = Table(
        ("a", "b"),
        tuple(np.exp(axis) for axis in axes),
        values,
        np.zeros_like(values),
        np.ones(x.shape, dtype=bool),
        GROWTH,
    )
    rng = np.random.default_rng(1)
    kept = 0
    for at in rng.uniform(0.0, [3.0, 2.0], (50, 2)):
        value, error = made(*np.exp(at))
        kept += abs(value[0] - math.sin(2.0 * at[0] + at[1])) <= error[0]
    assert kept >= 47


def test_spline_reproduces_cubics():
    axes = [np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 6)]
    x, y = np.meshgrid(*axes, indexing="ij")
    spline = TensorSpline.through(axes, (x**3 * y**2)[..., np.newaxis])
    assert spline(np.array([[0.3, 0.7]]))[0, 0] == pytest.approx(0.3**3 * 0.7**2)


def test_the_file_names_its_version_and_oil():
    made = json.loads(str(_file()["provenance"]))
    assert made["version"]
    assert made["oil"]["viscosity"]["roelands_z"] == 0.67
    assert made["lines"]["solved"] > 400
    density = reference_laws()[1]
    assert float(density(np.array([1e9]))[0][0]) == pytest.approx((0.59 + 1.34) / 1.59)
