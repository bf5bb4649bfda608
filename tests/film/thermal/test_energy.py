"""March of the energy equation against exact solutions and against one system of all columns."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.film.energy_equation import (
    Heat,
    HeatColumns,
    _March,
    energy_imbalance,
    moving_surface,
    solve_energy,
)
from ehlectric.film.newton import State
from tests.helpers.hot import channel, cold_surface, steel


def at_rest(stream, temperature):
    shape = stream.u.shape
    return Heat(np.full(shape, temperature), np.zeros((2, *shape[1:])), np.zeros(shape))


def solved(stream, surfaces, inlet=300.0, **options):
    last = at_rest(stream, inlet)
    columns = HeatColumns.of(stream, last.temperature)
    for _ in range(8):  # the history of the surfaces in reverse flow is that of the last march
        last = solve_energy(columns, surfaces, last, inlet_temperature=inlet, enough=1e-3, **options)
    return last


def test_uniform_heating_between_cold_surfaces_is_a_parabola():
    stream = channel(1.0, length=1e-3)
    heat = 1e14
    stream = replace(stream, heating=np.full(stream.u.shape, heat))
    found = solved(stream, (cold_surface(300.0, 41), cold_surface(300.0, 41)))
    zeta = stream.across.zeta
    exact = 300.0 + heat * 1e-12 / (2.0 * 0.14) * zeta * (1.0 - zeta)
    np.testing.assert_allclose(found.temperature[:, -1, 0], exact, rtol=1e-8)
    # Half of the heat flows into each body.
    np.testing.assert_allclose(found.flux[:, -1, 0], 0.5 * heat * 1e-6, rtol=1e-6)


@pytest.mark.parametrize("filling", [1.0, 1e-3])
def test_heat_of_rubbing_flows_into_the_bodies_however_little_oil_there_is(filling):
    """Half of it into each, and the oil between equal surfaces stays as hot as they are."""
    stream = channel(1.0, nodes=21)
    shape = stream.thickness.shape
    stream = replace(stream, filling=np.full(shape, filling), rubbed=np.full(shape, 3e8))
    found = solved(stream, (cold_surface(300.0, 21), cold_surface(300.0, 21)))
    np.testing.assert_allclose(found.flux, 1.5e8, rtol=1e-6)
    np.testing.assert_allclose(found.temperature, 300.0, atol=1e-4)
    assert energy_imbalance(stream, found, 300.0) < 1e-6


def test_a_solution_leaves_the_last_iterate_as_it_is():
    stream = channel(1.0, nodes=21)
    stream = replace(stream, heating=np.full(stream.u.shape, 1e14))
    last = at_rest(stream, 300.0)
    surfaces = (cold_surface(300.0, 21), cold_surface(300.0, 21))
    found = solve_energy(HeatColumns.of(stream, last.temperature), surfaces, last, inlet_temperature=300.0)
    assert np.all(found.flux[:, -1] > 0.0)
    assert np.all(last.flux == 0.0)
    assert np.all(last.temperature == 300.0)


def plug_flow(nodes, degree=16):
    """Temperature at mid-film of oil at 0 K that enters between surfaces at 1 K, and the exact one."""
    speed, length = 2.0, 1e-5
    stream = channel(speed, nodes=nodes, length=length, degree=degree)
    found = solved(stream, (cold_surface(1.0, nodes), cold_surface(1.0, nodes)), inlet=0.0)
    # The balance of the first columns with T_inlet before them begins half a cell before the first one.
    x = np.linspace(0.0, length, nodes) + 0.5 * stream.dx
    odd = np.arange(1, 200, 2)[:, np.newaxis] * np.pi
    decay = np.exp(-(odd**2) * 0.14 / 1.74e6 * x / (speed * 1e-12))
    middle = stream.across.at(np.array([0.5]))[0] @ found.temperature[:, :, 0]
    exact = 1.0 - np.sum(4.0 / odd * np.sin(0.5 * odd) * decay, axis=0)
    return middle, exact


def test_entry_of_a_plug_flow_has_second_order_along_x():
    # Series for the slab, Carslaw and Jaeger, section 3.3. The first columns, where the surfaces jump, are
    # left out.
    errors = []
    for nodes in (81, 161, 321):
        found, exact = plug_flow(nodes)
        errors.append(np.max(np.abs(found - exact)[nodes // 4 :]))
    assert errors[2] < 2e-4
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.3)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.3)


def test_march_solves_the_system_of_all_columns():
    rng = np.random.default_rng(4)
    nodes = 24
    stream = channel(1.0, nodes=nodes, degree=5, length=2e-5)
    shape = stream.u.shape
    u = 1.0 + rng.uniform(-0.5, 0.5, shape)
    u[2:4, :9] = -0.7 * rng.uniform(size=(2, 9, 1))
    stream = replace(stream, u=u, heating=1e12 * rng.uniform(size=shape))
    surfaces = tuple(
        moving_surface(steel(310.0), speed, nodes=nodes, spacing=stream.dx, half_width=1e-5)
        for speed in (0.4, 8.0)
    )
    found = solved(stream, surfaces)
    columns = HeatColumns.of(stream, np.full(shape, 300.0))
    nz = shape[0]
    # Unknowns: temperatures of all columns, then the fluxes into both bodies.
    size = nodes * nz
    matrix, right = np.zeros((size + 2 * nodes, size + 2 * nodes)), np.zeros(size + 2 * nodes)
    for i in range(nodes):
        rows = slice(i * nz, (i + 1) * nz)
        matrix[rows, rows] = columns.matrix[i, 0]
        right[rows] = columns.right[i, 0]
        for part, step in ((columns.before, -1), (columns.second, -2), (columns.after, 1)):
            j = i + step
            if 0 <= j < nodes:
                matrix[rows, j * nz : (j + 1) * nz] -= np.diag(part[i, 0])
            elif j < 0:
                right[rows] += part[i, 0] * 300.0
        for body, row in ((0, 0), (1, nz - 1)):
            flux = size + body * nodes + i
            matrix[i * nz + row, flux] = 1.0
            matrix[flux, i * nz + row] = 1.0
            right[flux] = 310.0
            for j in range(nodes):
                surface = surfaces[body]
                matrix[flux, size + body * nodes + j] -= (
                    surface.downstream[i - j] if j <= i else surface.upstream[j - i]
                )
    exact = np.linalg.solve(matrix, right)
    np.testing.assert_allclose(found.temperature[:, :, 0].T.ravel(), exact[:size], atol=2e-3)


def test_heat_into_surfaces_and_oil_balances():
    nodes = 61
    stream = channel(lambda zeta: 1.0 + zeta, nodes=nodes, length=5e-5)
    heating = np.full(stream.u.shape, 1e14)
    stream = replace(stream, heating=heating)
    surfaces = tuple(
        moving_surface(steel(300.0), speed, nodes=nodes, spacing=stream.dx, half_width=2e-5)
        for speed in (1.0, 2.0)
    )
    found = solved(stream, surfaces)
    made = 1e14 * 1e-6 * nodes * stream.dx
    into = found.flux.sum() * stream.dx
    enthalpy = 1.74e6 * 1e-6 * stream.across.weights @ (stream.u * (found.temperature - 300.0))[:, :, 0]
    # The second-order upstream difference sums to 1.5 times the last column less half of the one before.
    assert into + 1.5 * enthalpy[-1] - 0.5 * enthalpy[-2] == pytest.approx(made, rel=1e-9)


def test_temperature_follows_the_pressure_at_its_own_node():
    # The pressure of a node enters only the heat of compression of its own column in this stream.
    nodes, column = 31, 20
    stream = channel(1.0, nodes=nodes, length=2e-5)
    stream = replace(stream, compression=np.full(stream.u.shape, 1e9), compression_p=1e3 + 0.0 * stream.u)
    # Fast surfaces, which heat nothing upstream
    surfaces = tuple(
        moving_surface(steel(310.0), speed, nodes=nodes, spacing=stream.dx, half_width=1e-2)
        for speed in (5.0, 8.0)
    )
    pressed = replace(stream, compression=stream.compression.copy())
    pressed.compression[:, column] += 1e6 * stream.compression_p[:, column]
    last = at_rest(stream, 300.0)
    before, after = (
        solve_energy(HeatColumns.of(each, last.temperature), surfaces, last, inlet_temperature=300.0)
        for each in (stream, pressed)
    )
    change = after.temperature[:, column, 0] - before.temperature[:, column, 0]
    assert np.max(change) > 1e-2
    np.testing.assert_allclose(1e6 * before.by_pressure[:, column, 0], change, rtol=1e-6, atol=1e-12)


def test_temperature_follows_no_pressure_in_reverse_flow():
    stream = channel(1.0, nodes=12, degree=5)
    u = stream.u.copy()
    u[2:4, :5] = -0.5
    stream = replace(stream, u=u, compression_p=np.ones_like(u))
    last = at_rest(stream, 300.0)
    surfaces = (cold_surface(300.0, 12), cold_surface(300.0, 12))
    found = solve_energy(HeatColumns.of(stream, last.temperature), surfaces, last, inlet_temperature=300.0)
    follows = np.any(found.by_pressure, axis=(0, 2))
    assert not follows[:5].any()
    assert follows[6:].all()


def test_columns_are_the_same_from_both_surfaces():
    """Also where a wide gap adds conduction: exchanged surfaces turn the columns over, to rounding."""
    stream = channel(lambda zeta: 0.1 + 1.8 * zeta, nodes=21, thickness=1e-4)
    faster = np.linspace(1.0, 1.5, 21)[:, np.newaxis]
    stream = replace(stream, u=stream.u * faster, heating=1e12 * stream.u)
    fields = {key: value for key, value in vars(stream).items() if np.shape(value) == stream.u.shape}
    other = replace(stream, **{key: value[::-1] for key, value in fields.items()})
    temperature = 300.0 + 10.0 * stream.u
    columns = HeatColumns.of(stream, temperature)
    mirrored = HeatColumns.of(other, temperature[::-1])
    for key in ("right", "before", "second", "after"):
        np.testing.assert_allclose(getattr(columns, key), getattr(mirrored, key)[..., ::-1], rtol=1e-12)
    turned = mirrored.matrix[..., ::-1, ::-1]
    np.testing.assert_allclose(columns.matrix, turned, atol=1e-12 * columns.matrix.max())


def test_share_of_the_oil_in_the_pressure_of_a_node():
    """All of it where the surfaces do not touch, none where asperities have all of the load."""
    pressure, contact = np.array([[1.0, 1.0, 0.5, 0.0]]), np.array([[0.0, 0.25, 0.5, 0.0]])
    state = State(pressure, 0.0, np.ones((1, 4)), contact)
    np.testing.assert_array_equal(state.oil_share, [[1.0, 0.75, 0.0, 1.0]])


def test_heat_is_in_balance_where_the_speeds_of_the_nodes_do_not_conserve_mass():
    # The mass flow of the channel is the same through all faces. The speeds of the nodes, as from differences
    # of the pressure over rough surfaces, miss it by up to 30 %. What is heated flows out or into the
    # surfaces, whatever the speeds: a law of conservation.
    stream = channel(20.0, nodes=201, conductivity=0.02)
    missed = 1.0 + 0.3 * np.sin(np.linspace(0.0, np.pi, 201))
    stream = replace(
        stream, u=stream.u * missed[np.newaxis, :, np.newaxis], heating=np.full(stream.u.shape, 1e13)
    )
    surfaces = cold_surface(300.0, 201), cold_surface(300.0, 201)
    total = 20.0 * 870.0 * 1e-6 * np.ones((200, 1))
    kept = replace(stream, through=(total, np.zeros((201, 0))))
    assert energy_imbalance(stream, solved(stream, surfaces), 300.0) > 0.01
    assert energy_imbalance(kept, solved(kept, surfaces), 300.0) < 0.001


@pytest.mark.parametrize("symmetric", [False, True])
def test_neighbouring_lines_bring_their_heat(symmetric):
    """By hand: twice the left and three times the right line; oil of the inlet beyond the edges, or the
    mirror image of the second line.
    """
    old = np.random.default_rng(2).uniform(300.0, 400.0, (2, 4, 3))
    columns = SimpleNamespace(from_left=np.full(old.shape, 2.0), from_right=np.full(old.shape, 3.0))
    found = _March._from_sides(SimpleNamespace(columns=columns), old, 290.0, symmetric=symmetric)
    for line in range(4):
        left = old[:, line - 1] if line else old[:, 1] if symmetric else 290.0
        right = old[:, line + 1] if line < 3 else 290.0
        assert found[:, line] == pytest.approx(2.0 * left + 3.0 * right, rel=1e-12)
