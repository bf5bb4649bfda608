"""Oil that a stationary film keeps, or loses in its spots and makes in its valleys: independent balances."""

import numpy as np
import pytest

from ehlectric import solve
from ehlectric.contact.touching import MASS_ERROR, oil_balance
from ehlectric.film import nested
from ehlectric.tables.contact_tables import result_rows
from tests.contact.spots.cases import LINE, solved
from tests.helpers.mixed_films import gaussian, mixed_film, rough_line, rough_point, sinusoid

ROUGH = rough_line(gaussian(0.2e-6, 20e-6, seed=3), nodes=801, speed=0.005)


def flux_behind(result, i):
    """Mass flux per width behind a node over the density at zero pressure [m^2/s]: Couette less Poiseuille.

    The mass at the face is that of a parabola through two nodes upstream and one downstream, and the
    viscosity is an exponential of the position between both nodes of the face.
    """
    film, oil, conditions = result.film, result.case.oil, result.conditions
    pressure = film.pressure if film.contact_pressure is None else film.pressure - film.contact_pressure
    mass = film.density * film.thickness
    carried = conditions.entrainment_speed * (0.375 * mass[i + 1] + 0.75 * mass[i] - 0.125 * mass[i - 1])
    first, last = (oil.viscosity * np.exp(oil.log_viscosity(pressure[k])[0]) for k in (i, i + 1))
    fluidity = 1.0 / first if first == last else (1.0 / last - 1.0 / first) / np.log(first / last)
    gap = 0.5 * (film.thickness[i] + film.thickness[i + 1])
    density = 0.5 * (film.density[i] + film.density[i + 1])
    slope = (pressure[i + 1] - pressure[i]) / (film.x[i + 1] - film.x[i])
    return carried - density * fluidity * gap**3 / 12.0 * slope


@pytest.fixture
def counted_full(monkeypatch):
    """Films whose cavitated gaps count as full, as where no film that carries its oil is found."""
    monkeypatch.setattr(nested, "forms_again", lambda _: False)


def gained(result):
    """Flux through the last full face of the zone less that through one ahead of all spots, over the mean."""
    film, half_width = result.film, result.conditions.half_width
    full = ~film.cavitated & (film.pressure > result.case.oil.ambient_pressure + 1.0)
    before = np.flatnonzero(film.x < -1.2 * half_width)[-1]
    # A face has the order of its formula where the two nodes upstream and the one downstream are full.
    whole = full & np.roll(full, 1) & np.roll(full, 2) & np.roll(full, -1)
    behind = np.flatnonzero(whole & (film.x < half_width))[-1]
    assert full[before]
    inside = np.abs(film.x) < half_width
    flow = result.conditions.entrainment_speed * np.mean((film.density * film.thickness)[inside])
    return (flux_behind(result, behind) - flux_behind(result, before)) / flow


@pytest.mark.slow
def test_what_enters_leaves():
    """Surfaces apart: 35 % of the flow would appear if cavitated gaps counted as full."""
    case = rough_line(gaussian(0.2e-6, 30e-6, seed=3), nodes=801, speed=0.02)
    result = solve(case, beside_smooth=False)
    film = result.film
    assert not np.any(film.contact)
    # Far from cavities the weights of the formula are 1 within 1e-4, and its orders differ by less than 1e-2.
    high = film.pressure > 0.3 * np.max(film.pressure)
    faces = np.flatnonzero(high & np.roll(high, 1) & np.roll(high, -1))
    first, last = faces[0], faces[-1]
    assert np.any(film.cavitated[first:last])
    flow = result.conditions.entrainment_speed * np.mean((film.density * film.thickness)[first:last])
    assert abs(flux_behind(result, last) - flux_behind(result, first)) < 1e-5 * flow
    assert oil_balance(case, result.conditions, result.film).mass_error < 1e-6


@pytest.mark.slow
@pytest.mark.usefixtures("counted_full")
@pytest.mark.parametrize("case", [LINE, ROUGH], ids=["sinusoid", "gaussian"])
def test_what_leaves_the_zone_in_excess_is_the_error(case):
    """Flux through two full faces, one ahead of all spots and one behind the last full node of the zone."""
    result = solve(case, beside_smooth=False)
    film, half_width = result.film, result.conditions.half_width
    full = ~film.cavitated & (film.pressure - film.contact_pressure > result.case.oil.ambient_pressure + 1.0)
    before = np.flatnonzero(film.x < -1.2 * half_width)[-1]
    behind = np.flatnonzero(full & (film.x < half_width))[-1]
    assert full[before]
    inside = np.abs(film.x) < half_width
    flow = result.conditions.entrainment_speed * np.mean((film.density * film.thickness)[inside])
    excess = flux_behind(result, behind) - flux_behind(result, before)
    found = oil_balance(case, result.conditions, film)
    assert found.oil_made > 0.01
    assert excess / flow == pytest.approx(found.oil_made - found.oil_lost, rel=1e-3)


@pytest.mark.slow
@pytest.mark.usefixtures("counted_full")
@pytest.mark.parametrize(
    "case",
    [ROUGH, rough_point(gaussian(0.1e-6, 30e-6), speed=0.01)],
    ids=["line", "point"],
)
def test_the_residual_of_the_solver_gives_the_same(case):
    """Nodes with a full film are those of the solver; each line is summed up from its outlet on."""
    solution = mixed_film(case)
    final, zone, touching = solution.last.final, solution.zone, solution.touching
    weights, r = solution.last.level.weights, final.reynolds
    lost = made = 0.0
    for j in range(r.shape[1]):
        filled = False
        for i in reversed(range(r.shape[0])):
            filled = filled or bool(final.full_film[i, j] and zone[i, j])
            if filled and (zone[i, j] or touching[i, j]):
                made += weights[i, j] * max(r[i, j], 0.0)
            if touching[i, j]:
                lost -= weights[i, j] * min(r[i, j], 0.0)
    mass = np.mean((final.coefficients.density * solution.gap)[zone])
    flow = mass * (2.0 if r.shape[1] > 1 else 1.0)  # the ball's contact is a circle of the radius 1
    result = solve(case, beside_smooth=False)
    found = oil_balance(case, result.conditions, result.film)
    assert found.oil_made == pytest.approx(made / flow, rel=1e-6)
    assert found.oil_lost == pytest.approx(lost / flow, abs=1e-9)
    assert found.mass_error == found.oil_lost + found.oil_made


def test_a_full_film_keeps_its_oil():
    case = rough_line(sinusoid(0.02e-6, 40e-6), nodes=401, speed=4.0)
    result = solve(case, beside_smooth=False)
    assert not np.any(result.film.cavitated[1:200])
    assert oil_balance(case, result.conditions, result.film).mass_error < 1e-5


@pytest.mark.slow
@pytest.mark.usefixtures("counted_full")
def test_a_film_that_makes_oil_is_told():
    result = solve(LINE, beside_smooth=False)
    balance = result.asperities.balance
    assert balance.mass_error > MASS_ERROR
    assert "oil-not-conserved" in [warning.code for warning in result.warnings]
    (text,) = (w.text for w in result.warnings if w.code == "oil-not-conserved")
    assert f"{100.0 * balance.oil_made:.2g} % of the mean flow" in text
    (row,) = (row for row in result_rows(result) if row.name == "error of the oil balance")
    assert row.value == balance.mass_error


@pytest.mark.slow
def test_a_film_that_makes_much_oil_is_not_converged():
    """A nearly dry line, of which no film that conserves its oil is found."""
    case = rough_line(sinusoid("140 nm", "60 um"), speed=1e-4, nodes=401)
    result = solve(case, beside_smooth=False)
    balance = oil_balance(case, result.conditions, result.film)
    assert balance.mass_error > 0.1
    assert result.film.residual < 1e-6
    assert not result.converged
    assert {"not-converged", "oil-not-conserved"} <= {warning.code for warning in result.warnings}
    assert result_rows(result)[0].name == "NOT CONVERGED"


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point"])
def test_of_a_film_that_keeps_its_oil_nothing_is_told(geometry):
    kept = solved(geometry)
    assert kept.asperities.balance.mass_error < MASS_ERROR
    assert "oil-not-conserved" not in [warning.code for warning in kept.warnings]


@pytest.mark.slow
def test_unequal_spacings_have_no_balance():
    result = solved("line")
    film = result.film
    bent = type(film)(**vars(film) | {"x": film.x + 1e-3 * film.x**2 / film.x[-1], "mass_residual": None})
    assert oil_balance(LINE, result.conditions, bent) is None
