"""Flow of a shear-thinning oil through the faces: derivatives in the Jacobian, and limits."""

from dataclasses import replace

import hypothesis.strategies as st
import numpy as np
from hypothesis import given

from ehlectric.film import reynolds
from ehlectric.film.across_film import Across
from ehlectric.film.face_flow import Undrifted, flow, mean_fluidity
from ehlectric.film.mesh import Mesh, Width, on_mesh
from ehlectric.film.shear_flow import ShearedFlow
from ehlectric.film.shear_laws import Rheology
from tests.film.sheared.contacts import Warm, fluid_of
from tests.helpers.each import each

LAWS = [
    Rheology(),
    Rheology("eyring", {"eyring_stress": 5e6}),
    Rheology("carreau", {"carreau_stress": 6e6, "carreau_exponent": 0.45}),
    Rheology("limiting", {"limiting_coefficient": 0.05}),
]


def sheared(rheology, mesh, *, warm=False, ratio=0.4):
    """Fluid at 0.5 GPa with slip, and optionally with a temperature profile on the mesh."""
    fluid = fluid_of(5e8, 1e-4, 2.0, "newtonian")
    law = ShearedFlow(rheology, 5e6, 5e8, ratio)
    if warm:
        across = Across.of(6)
        shape = np.random.default_rng(5).random((1, *mesh.shape))
        zeta = across.zeta[:, np.newaxis, np.newaxis]
        temperature = shape * (0.2 + zeta + 2.0 * zeta * (1.0 - zeta))
        law = replace(law, profile=Warm(across, temperature, mesh, fluid))
    return replace(fluid, flow=law)


def state(mesh, seed):
    """Random pressure, thickness and change of both."""
    rng = np.random.default_rng(seed)
    return tuple(low + 0.1 * rng.random(mesh.shape) for low in (0.3, 0.2, 0.5))


def residual(fluid, mesh, pressure, thickness):
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=2)
    return reynolds.residual(flow(fluid, pressure, thickness, mesh), wedge, thickness, mesh)


def check_jacobian(fluid, mesh, seed=3):
    """Both stencils of the Jacobian against central differences of the residual."""
    pressure, thickness, change = state(mesh, seed)
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=2)
    by_p, by_h = reynolds.linearise(flow(fluid, pressure, thickness, mesh), wedge, thickness, mesh)
    step = 1e-6 * change
    for stencil, p, h in ((by_p, step, 0.0), (by_h, 0.0, step)):
        forward = residual(fluid, mesh, pressure + p, thickness + h)
        back = residual(fluid, mesh, pressure - p, thickness - h)
        expected = (forward - back) / 2e-6
        np.testing.assert_allclose(stencil(change), expected, rtol=1e-6, atol=1e-6 * np.max(np.abs(expected)))


@each("warm", [False, True])
@each("rheology", LAWS, ids=lambda law: law.name)
def test_derivatives_of_a_line(rheology, warm):
    """The Jacobian is the derivative of the residual, through P, H, the properties and the shear."""
    mesh = Mesh.over(20, -2.0, 1.0)
    check_jacobian(sheared(rheology, mesh, warm=warm), mesh)


@each("warm", [False, True])
@each("rheology", [LAWS[0], LAWS[3]], ids=lambda law: law.name)
def test_derivatives_of_a_point(rheology, warm):
    """Laws whose flux does not depend on the gradient along the other axis have the exact Jacobian."""
    mesh = Mesh.over(12, -2.0, 1.0, Width(11, 2.0))
    assert mesh.symmetric
    check_jacobian(sheared(rheology, mesh, warm=warm), mesh)


@each("warm", [False, True])
@each("symmetric", [False, True])
def test_derivatives_of_a_point_with_the_gradients_along_the_other_axis(symmetric, warm):
    """The stencils and the derivatives beyond them are the Jacobian, and the latter are one percent of it."""
    mesh = Mesh.over(12, -2.0, 1.0, Width(11, 2.0, symmetric=symmetric))
    fluid = sheared(Rheology("eyring", {"eyring_stress": 1e4}), mesh, warm=warm)
    pressure, thickness, change = state(mesh, 4)
    at_faces = flow(fluid, pressure, thickness, mesh)
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=2)
    by_p, by_h = reynolds.linearise(at_faces, wedge, thickness, mesh)
    beyond = reynolds.lateral_change(at_faces, change, mesh)
    step = 1e-6 * change
    for found, p, h in ((by_p(change) + beyond, step, 0.0), (by_h(change), 0.0, step)):
        forward = residual(fluid, mesh, pressure + p, thickness + h)
        back = residual(fluid, mesh, pressure - p, thickness - h)
        expected = (forward - back) / 2e-6
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6 * np.max(np.abs(expected)))
    assert np.max(np.abs(beyond)) > 1e-2 * np.max(np.abs(by_p(change)))


@each("width", [None, Width(9, 2.0)])
@each(
    "rheology",
    [
        Rheology(),
        Rheology("eyring", {"eyring_stress": 1e14}),
        Rheology("carreau", {"carreau_stress": 1e14, "carreau_exponent": 0.4}),
    ],
    ids=lambda law: law.name,
)
def test_large_stresses_give_the_newtonian_flux(rheology, width):
    """The flux and its derivatives are those of the Newtonian law, whatever the slip is."""
    mesh = Mesh.over(15, -2.0, 1.0, width)
    fluid = sheared(rheology, mesh)
    pressure, thickness, _ = state(mesh, 1)
    found, expected = flow(fluid, pressure, thickness, mesh), mean_fluidity(fluid, pressure, thickness, mesh)
    pairs = [(found.along, expected.along)]
    if width is not None:
        pairs.append((found.across, expected.across))
    for face, newtonian in pairs:
        for name in ("flux", "conductance"):
            np.testing.assert_allclose(getattr(face, name), getattr(newtonian, name), rtol=1e-10)
        for sides, others in (
            (face.by_gap, newtonian.by_gap),
            (face.by_properties, newtonian.by_properties),
        ):
            scale = np.max(np.abs(others.before))
            np.testing.assert_allclose(sides.before, others.before, rtol=1e-9, atol=1e-10 * scale)
            np.testing.assert_allclose(sides.after, others.after, rtol=1e-9, atol=1e-10 * scale)


@each("width", [None, Width(9, 2.0)])
@each("rheology", LAWS, ids=lambda law: law.name)
def test_uniform_profile_is_no_profile(rheology, width):
    """At the reference temperature across the film the flux is that without a profile."""
    mesh = Mesh.over(15, -2.0, 1.0, width)
    fluid = sheared(rheology, mesh)
    cold = Warm(Across.of(6), np.zeros((7, *mesh.shape)), mesh, fluid)
    profiled = replace(fluid, flow=replace(fluid.flow, profile=cold))
    pressure, thickness, _ = state(mesh, 2)
    with_it, without = (flow(oil, pressure, thickness, mesh) for oil in (profiled, fluid))
    np.testing.assert_allclose(with_it.coefficients.density, without.coefficients.density, rtol=1e-14)
    scale = np.max(np.abs(without.along.flux))
    np.testing.assert_allclose(with_it.along.flux, without.along.flux, rtol=1e-9, atol=1e-12 * scale)
    np.testing.assert_allclose(with_it.along.conductance, without.along.conductance, rtol=1e-9)


@each("rheology", LAWS, ids=lambda law: law.name)
def test_reversed_slip_mirrors_the_stress(rheology):
    """The film of equal surfaces does not change; stress and speed are those of the other surface."""
    mesh = Mesh.over(15, -2.0, 1.0, Width(9, 2.0))
    pressure, thickness, _ = state(mesh, 6)
    one, other = (sheared(rheology, mesh, ratio=ratio) for ratio in (0.4, -0.4))
    fluxes = [flow(oil, pressure, thickness, mesh) for oil in (one, other)]
    np.testing.assert_allclose(fluxes[1].along.flux, fluxes[0].along.flux, rtol=1e-10)
    first, second = (oil.flow.columns(oil, pressure, thickness, mesh) for oil in (one, other))
    np.testing.assert_allclose(second.middle[0], -first.middle[0], rtol=1e-10)
    np.testing.assert_allclose(second.speed[0], first.speed[0, ::-1], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(second.heating, first.heating[::-1], rtol=1e-9, atol=1e-15)


@each("rheology", LAWS, ids=lambda law: law.name)
def test_columns_carry_the_flux_between_the_surfaces(rheology):
    """Both surfaces have their speeds, and Int rho u dz is rho_e H less the flux of a uniform gradient."""
    mesh = Mesh.over(9, -2.0, 1.0)
    fluid = sheared(rheology, mesh, warm=True)
    temperature = np.repeat(fluid.flow.profile.temperature[:, 4:5], 9, axis=1)
    profile = replace(fluid.flow.profile, temperature=temperature)
    fluid = replace(fluid, flow=replace(fluid.flow, profile=profile))
    fluid = replace(
        fluid, log_viscosity=lambda p: (0.0 * p, 0.0 * p), density=lambda p: (1.0 + 0.0 * p, 0.0 * p)
    )
    pressure = 0.4 + 1e-6 * mesh.x[:, np.newaxis]
    thickness = np.full(mesh.shape, 0.2)
    columns = fluid.flow.columns(fluid, pressure, thickness, mesh)
    np.testing.assert_allclose(columns.speed[0, 0], 0.8, rtol=1e-13)
    np.testing.assert_allclose(columns.speed[0, -1], 1.2, rtol=1e-13)
    weights = columns.across.weights[:, np.newaxis, np.newaxis]
    carried = thickness * np.sum(weights * columns.density * columns.speed[0], axis=0)
    found = flow(fluid, pressure, thickness, mesh)
    expected = found.coefficients.density * thickness
    expected[1:-1] -= 0.5 * mesh.dx * (found.along.flux[1:] + found.along.flux[:-1])
    np.testing.assert_allclose(carried[1:-1], expected[1:-1], rtol=1e-6)


@given(st.lists(st.floats(0.0, 2.0), min_size=9, max_size=9), st.floats(1.0, 30.0))
def test_no_column_is_much_faster_than_the_flow_of_the_film(pressures, slope):
    """However much the viscosity changes from node to node: ln(eta) = slope P, between parallel surfaces.

    The mean of the columns at the faces is not faster. What remains of an error e of the mean speed at the
    node is e/(1 + ((e - 0.01)/0.1)^2), at most 0.056.
    """
    mesh = Mesh.over(9, -2.0, 1.0)
    fluid = replace(
        sheared(Rheology(), mesh),
        log_viscosity=lambda p: (slope * p, slope + 0.0 * p),
        density=lambda p: (1.0 + 0.0 * p, 0.0 * p),
    )
    pressure, gap = np.array(pressures)[:, np.newaxis], 0.2
    thickness = np.full(mesh.shape, gap)
    driven = -mesh.dx / gap * flow(fluid, pressure, thickness, mesh).along.flux
    speed = 1.0 + 0.5 * (np.concatenate([driven[:1], driven]) + np.concatenate([driven, driven[-1:]]))
    columns = fluid.flow.columns_that_pass(fluid, pressure, thickness, mesh, speed)
    largest = 0.5 * (np.abs(driven[1:]) + np.abs(driven[:-1]))
    assert np.all(np.abs(columns.mean_speed - 1.0)[1:-1] <= largest + 0.056)


def test_columns_keep_the_nodes_whose_speed_the_mass_balance_confirms():
    mesh = Mesh.over(9, -2.0, 1.0)
    fluid = sheared(Rheology("eyring", {"eyring_stress": 5e6}), mesh)
    pressure, thickness, _ = state(mesh, 4)
    nodes = fluid.flow.columns(fluid, pressure, thickness, mesh)
    for speed in (nodes.mean_speed, np.full(mesh.shape, np.nan)):
        columns = fluid.flow.columns_that_pass(fluid, pressure, thickness, mesh, speed)
        np.testing.assert_array_equal(columns.heating, nodes.heating)
    wrong = nodes.mean_speed.copy()
    wrong[4] += 1e6
    columns = fluid.flow.columns_that_pass(fluid, pressure, thickness, mesh, wrong)
    changed = np.any(columns.heating != nodes.heating, axis=(0, 2))
    assert np.flatnonzero(changed).tolist() == [4]


@each("rheology", LAWS)
def test_a_film_that_is_uniform_across_has_the_columns_of_a_line_contact(rheology):
    """With a temperature that changes across the film and along it; the speeds of one line are corrected."""
    line = Mesh.over(9, -2.0, 1.0)
    ball = Mesh.over(9, -2.0, 1.0, Width(5, 2.0))
    pressure, thickness, _ = state(line, 4)
    columns = []
    for mesh in (line, ball):
        fluid = sheared(rheology, mesh)
        across = Across.of(6)
        zeta = across.zeta[:, np.newaxis, np.newaxis]
        temperature = np.broadcast_to(zeta * (1.0 + 0.5 * mesh.x[:, np.newaxis]), (7, *mesh.shape))
        fluid = replace(fluid, flow=replace(fluid.flow, profile=Warm(across, temperature, mesh, fluid)))
        uniform = [np.broadcast_to(values, mesh.shape) for values in (pressure, thickness)]
        nodes = fluid.flow.columns(fluid, *uniform, mesh)
        wrong = nodes.mean_speed + np.where(np.arange(9)[:, np.newaxis] == 4, 0.3, 0.0)
        columns.append(fluid.flow.columns_that_pass(fluid, *uniform, mesh, wrong))
    of_line, of_ball = columns
    assert np.any(of_line.heating[:, 4] > 0.0)
    for name in ("heating", "softening", "density"):
        expected = np.broadcast_to(getattr(of_line, name), getattr(of_ball, name).shape)
        np.testing.assert_allclose(getattr(of_ball, name), expected, rtol=1e-12)
    along = np.broadcast_to(of_line.speed[0], of_ball.speed[0].shape)
    np.testing.assert_allclose(of_ball.speed[0], along, rtol=1e-12)
    np.testing.assert_allclose(of_ball.speed[1], 0.0, atol=1e-15)


def test_profiles_are_moved_to_other_meshes():
    """A temperature linear in x and y is the same on a coarser grid and on a strip of the grid."""
    width = Width(9, 2.0)
    fine, coarse = Mesh.over(17, -2.0, 2.0, width), Mesh.over(9, -2.0, 2.0, width.coarser())
    strip = Mesh(fine.x[3:8], fine.y[:1])

    def linear(mesh):
        return (mesh.x[:, np.newaxis] + 0.5 * mesh.y)[np.newaxis]

    np.testing.assert_allclose(on_mesh(linear(fine), fine, coarse), linear(coarse), atol=1e-14)
    line = Mesh.over(17, -2.0, 2.0)
    np.testing.assert_allclose(on_mesh(linear(line), line, strip), linear(strip), atol=1e-14)
    assert on_mesh(linear(fine), fine, fine) is not None


@each("rheology", LAWS)
def test_drift_is_the_flow_without_a_gradient(rheology):
    """At a uniform pressure nothing else flows; behind cavitated nodes it is taken away, and only once."""
    mesh = Mesh.over(9, -1.0, 1.0)
    fluid = sheared(rheology, mesh, warm=True)
    _, thickness, _ = state(mesh, 3)
    found = flow(fluid, np.full(mesh.shape, 0.3), thickness, mesh)
    assert np.all(np.abs(found.along.drift) > 0.0)
    np.testing.assert_allclose(found.along.drift, found.along.flux, rtol=1e-6)
    cavitated = (mesh.x < 0.0)[:, np.newaxis]
    taken = found.undrifted(cavitated)
    np.testing.assert_allclose(taken.along.flux[:4], 0.0, atol=1e-6 * np.abs(found.along.flux).max())
    np.testing.assert_array_equal(taken.along.flux[4:], found.along.flux[4:])
    np.testing.assert_array_equal(taken.undrifted(cavitated).along.flux, taken.along.flux)


def test_drift_is_left_out_on_coarser_grids_and_halves_too():
    """Each of their nodes is cavitated as that of the grid that has the mask."""
    mesh = Mesh.over(9, -1.0, 1.0, Width(9, 1.0, symmetric=True))
    coarse = Mesh.over(5, -1.0, 1.0, Width(5, 1.0, symmetric=True))
    fluid = sheared(LAWS[1], mesh, warm=True)
    cavitated = np.broadcast_to((mesh.x < 0.0)[:, np.newaxis], mesh.shape)
    pressure, thickness = np.full(coarse.shape, 0.3), np.full(coarse.shape, 0.2)
    found = Undrifted(fluid.flow, mesh, cavitated)(fluid, pressure, thickness, coarse).along.flux
    whole = fluid.flow(fluid, pressure, thickness, coarse).along.flux
    np.testing.assert_allclose(found[:2], 0.0, atol=1e-6 * np.abs(whole).max())
    np.testing.assert_array_equal(found[2:], whole[2:])
