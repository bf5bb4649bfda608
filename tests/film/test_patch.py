"""A film on a fine patch of a coarse grid is that on a fine grid over the whole domain."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import Case, load, save, solve
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.patch import Patch
from ehlectric.runtime.threads import quiet_solution

pytestmark = pytest.mark.convergence


def contact(load, speed, ratio=1.0):
    radii = {"radius_x": "10 mm", "radius_y": f"{10 * ratio} mm", "reduced_modulus": "226 GPa"}
    table = {"geometry": "point", "load": load, "entrainment_speed": speed} | radii
    return Case.from_dict({"contact": table, "lubricant": {"base": "paper"}})


# Contact with its nodes on the coarse grid, and the largest difference of h(0) and h_min from the film on the
# whole domain: thin, medium and thick films, and wide and narrow ellipses.
CONTACTS = {
    "circle": (contact("160 N", "0.8 m/s"), 129, 1e-4),
    "medium": (contact("20 N", "2 m/s"), 65, 3e-4),
    "thick": (contact("20 N", "8 m/s"), 65, 5e-4),
    "wide": (contact("160 N", "2 m/s", 12.0), 129, 3e-4),
    "narrow": (contact("50 N", "4 m/s", 0.4), 129, 5e-4),
}


def problem_of(case, nodes):
    case = case.replace({"grid.nodes": nodes})
    return replace(point_film_problem(case, resolve_point(case)), tolerance=1e-7)


def solutions(problem, known=()):
    with quiet_solution():
        return nested_iteration(problem, None, known)


def key_thicknesses(solution):
    film = solution.state.thickness
    return np.array([at_centre(solution.level.mesh, film), np.min(film)])


@pytest.mark.slow
@pytest.mark.parametrize("name", CONTACTS)
def test_patch_with_the_spacing_of_the_coarse_grid_has_its_film(name):
    """Nothing is refined: pressure outside, load and edges alone must give the same film again."""
    case, nodes, _ = CONTACTS[name]
    coarse = solutions(problem_of(case, nodes))[-1]
    patch = Patch.around(problem_of(case, nodes), coarse)
    same = solutions(patch.refined(1), [coarse])[-1]
    assert same.status == "converged"
    np.testing.assert_allclose(key_thicknesses(same), key_thicknesses(coarse), rtol=1.5e-3)


def test_a_film_as_wide_as_the_domain_has_no_patch():
    """The pressure of a hardly loaded ball builds up over four semi-axes."""
    problem = problem_of(contact("0.5 N", "8 m/s"), 65)
    assert Patch.around(problem, solutions(problem)[-1]) is None


def test_the_excess_at_the_edges_is_that_above_ambient_pressure():
    """None where the pressure is ambient, and nothing inside."""
    problem = problem_of(CONTACTS["medium"][0], 65)
    ambient, mesh = problem.fluid.ambient_pressure, Mesh(np.linspace(-2.0, 2.0, 9), np.linspace(-1.0, 1.0, 5))
    for above in (0.0, 0.3):
        edged = replace(
            problem, edge_pressure=lambda x, y, above=above: ambient + above + 0.0 * x[:, None] * y
        )
        expected = np.full(mesh.shape, above)
        expected[1:-1, 1:-1] = 0.0
        assert ambient > 0.0
        assert edged.edge_excess(mesh) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("times", [1, 2, 4])
def test_cells_of_the_patch_and_cells_outside_fill_the_domain(times):
    """Cells of the nodes of a patch reach half a fine spacing beyond its 4 x 3 coarse cells: the pressure of
    all other 9 x 7 cells deforms the patch from outside.
    """
    mesh = Mesh(np.linspace(-2.0, 2.0, 9), np.linspace(-1.0, 1.0, 7))
    level = SimpleNamespace(mesh=mesh, deflection=lambda pressure: pressure)
    state = SimpleNamespace(pressure=np.ones(mesh.shape))
    patch = Patch(None, SimpleNamespace(level=level, state=state), rows=(2, 6), lines=(1, 4))
    outside = patch.outer_deflection(times)(mesh.x, mesh.y)
    assert np.sum(outside) == pytest.approx(63.0 - (4.0 + 1.0 / times) * (3.0 + 1.0 / times), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", [pytest.param("medium", marks=pytest.mark.gate), "thick"])
def test_patch_has_the_film_of_the_whole_domain(name):
    check_patch(name)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["circle", "wide", "narrow"])
def test_patch_has_the_film_of_the_whole_domain_where_it_is_thin(name):
    check_patch(name)


def check_patch(name):
    case, nodes, largest = CONTACTS[name]
    found = solutions(problem_of(case, nodes))
    patch = Patch.around(problem_of(case, nodes), found[-1])
    for times in (2, 4):
        found = solutions(patch.refined(times), found)
    whole = solutions(problem_of(case, 4 * nodes - 3))[-1]
    assert found[-1].status == whole.status == "converged"
    assert found[-1].level.mesh.weights.size < 0.6 * whole.level.mesh.weights.size
    np.testing.assert_allclose(key_thicknesses(found[-1]), key_thicknesses(whole), rtol=largest)


@pytest.mark.slow
@pytest.mark.gate
def test_film_on_a_patch_covers_the_whole_domain(tmp_path):
    """Nodes from inlet to outlet and from side to side, the whole load, and results that survive the disk."""
    case = CONTACTS["medium"][0].replace({"grid.nodes": 65, "grid.refine": 0.003, "grid.inlet": -4.25})
    result = solve(case)
    film, b = result.film, result.conditions.semi_axis_x
    assert film.converged
    assert film.discretisation_error <= 0.003
    steps = np.diff(film.x)
    assert np.max(steps) > 1.9 * np.min(steps)
    # A given inlet stays; the default one costs more than this error.
    assert film.x[[0, -1]] == pytest.approx([-4.25 * b, 1.5 * b], rel=1e-12)
    np.testing.assert_allclose(film.y, -film.y[::-1], rtol=1e-12)
    np.testing.assert_array_equal(film.thickness, film.thickness[:, ::-1])
    carried = np.trapezoid(np.trapezoid(film.pressure, film.y, axis=1), film.x)
    assert carried == pytest.approx(20.0, rel=2e-3)
    # The film has no step at the edges of the patch: its second difference there is that of its neighbours.
    middle = film.thickness[:, film.y.size // 2]
    edge = int(np.argmax(np.abs(np.diff(steps)) > 0.1 * np.min(steps))) + 1
    slopes = np.diff(middle) / steps
    assert abs(slopes[edge] - slopes[edge - 1]) < 0.2 * abs(slopes[edge])
    assert result.film.minimum_thickness == pytest.approx(
        solve_point_film(problem_of(case, 257)).minimum_thickness, rel=5e-3
    )
    save(result, tmp_path)
    again = load(tmp_path / "result.nc")
    np.testing.assert_array_equal(again.film.x, film.x)
    assert again.film.discretisation_error == film.discretisation_error


# Rough contacts: a wave at an angle, and random roughness on the moving ball.
ROUGH = {
    "wave": {"generator": "sinusoid", "amplitude": "30 nm", "wavelength": "40 um", "orientation": "30 deg"},
    "random": {"generator": "gaussian", "rq": "20 nm", "correlation_length": "25 um", "seed": 3},
}


def nearest(fine, nodes):
    """Indices of nodes among those of a finer grid that has them all."""
    found = np.argmin(np.abs(fine[:, np.newaxis] - nodes), axis=0)
    np.testing.assert_allclose(fine[found], nodes, atol=1e-6 * fine[-1])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", ROUGH)
def test_rough_film_on_a_patch_is_that_of_the_whole_domain(name):
    """Roughness is on the fine nodes inside the patch, and on the coarse ones for the pressure outside."""
    rough = contact("20 N", "2 m/s").replace({"roughness": [{"surface": 1, **ROUGH[name]}]})
    whole = solve(rough.replace({"grid.nodes": 257}), beside_smooth=False)
    first = rough.replace({"grid.nodes": 129, "grid.refine": 1e-4})
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("ehlectric.contact.contact_refinement._MOST_DOUBLED_ROUGH", {"point": 1})
        result = solve(first)
    film = result.film
    assert film.converged
    assert max(np.diff(film.x)) > 1.9 * min(np.diff(film.x))
    assert film.central_thickness == pytest.approx(whole.film.central_thickness, rel=3e-4)
    assert film.minimum_thickness == pytest.approx(whole.film.minimum_thickness, rel=3e-4)
    # Outside the patch the film has the roughness of its own nodes, not of the coarse ones.
    rows, lines = (nearest(fine, axis) for fine, axis in zip(whole.film.axes, film.axes, strict=True))
    expected = whole.film.thickness[np.ix_(rows, lines)]
    assert np.max(np.abs(film.thickness - expected)) < 5e-3 * film.central_thickness
    # The film with smooth surfaces has the same nodes.
    assert result.smooth.thickness.shape == film.thickness.shape
    smooth = solve(contact("20 N", "2 m/s").replace({"grid.nodes": 257})).film.thickness
    assert (
        np.max(np.abs(result.smooth.thickness - smooth[np.ix_(rows, lines)])) < 2e-3 * film.central_thickness
    )


@pytest.mark.slow
def test_load_cut_off_is_that_of_the_whole_domain():
    """A film refined inside a patch has the domain of the coarse film, and the load of the contact."""
    case = contact("20 N", "8 m/s")
    grid = {"grid.nodes": 65, "grid.inlet": -6.0, "grid.outlet": 2.0, "grid.side": 4.0}
    whole = solve(case.replace(grid)).film
    patched = solve(case.replace(grid | {"grid.refine": 2e-3})).film
    assert patched.x.size > whole.x.size
    assert len(set(np.round(np.diff(patched.x) / np.diff(patched.x).min()))) > 1  # fine nodes in a part only
    assert patched.load_deficit == pytest.approx(whole.load_deficit, rel=1e-6)
