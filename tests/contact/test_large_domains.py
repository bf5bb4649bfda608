"""Films of light contacts, whose domain is made larger until it costs less than the error asked for."""

import pytest

from ehlectric import Case, load, run_sweep, save, solve
from ehlectric.sweep.warnings import sweep_warnings

pytestmark = pytest.mark.convergence

OIL = {"base": "paper", "ambient_pressure": 0.0}
BODIES = {"reduced_radius": "10 mm", "reduced_modulus": "226 GPa"}
BALL = {"geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa"}


def line(load, speed, oil=OIL, **grid):
    contact = BODIES | {"load_per_length": load, "entrainment_speed": speed}
    return Case.from_dict({"contact": contact, "lubricant": oil, "grid": grid})


def ball(load, speed, **grid):
    contact = BALL | {"load": load, "entrainment_speed": speed}
    return Case.from_dict({"contact": contact, "lubricant": OIL, "grid": grid})


def far(film):
    return film.x[0] / film.scales.length


@pytest.mark.slow
@pytest.mark.parametrize(("load", "speed"), [(3e5, 4.0), (5e4, 4.0), (1e4, 4.0), (3e3, 2.0)])
def test_the_error_asked_for_has_the_domain_in_it(load, speed):
    """Beside an inlet of 240 half-widths, which costs 0.2 % at most; the default one costs up to 75 %."""
    result = solve(line(load, speed))
    far_away = solve(line(load, speed, inlet=-240.0, outlet=20.0, nodes=16641))
    assert result.field.capacitance == pytest.approx(far_away.field.capacitance, rel=0.012, abs=0.0)
    found, reference = result.film, far_away.film
    assert found.central_thickness == pytest.approx(reference.central_thickness, rel=0.012)
    assert found.domain_loss <= 0.01
    default = solve(line(load, speed, nodes=1601)).film
    assert default.domain_loss > 0.01
    lost = 1.0 - default.central_thickness / reference.central_thickness
    assert 0.9 * lost < default.domain_loss < 2.0 * lost + 0.01


INCOMPRESSIBLE = {
    "viscosity": 0.315,
    "ambient_pressure": 0.0,
    "density_law": "incompressible",
    "base": "paper",
}
ROELANDS = {"viscosity_law": "roelands", "roelands_z": 0.443, "roelands_pressure": "203 MPa"}
BARUS = {"viscosity_law": "barus", "pressure_viscosity_coefficient": "18.6 1/GPa"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("load", "speed", "law"),
    [(1.149e6, 86.3, ROELANDS), (8.6e5, 161.0, ROELANDS), (2.4e6, 94.0, ROELANDS), (1.0e6, 100.0, BARUS)],
)
def test_a_film_that_converges_on_a_large_domain_only(load, speed, law):
    """Light contacts with an incompressible oil of high L: M of 0.6 to 2, L of 29 to 35.

    The inlet of the reference, 240 half-widths, costs 0.1 % of the film at most.
    """
    oil = INCOMPRESSIBLE | law
    contact = {"reduced_radius": "100 mm", "load_per_length": load, "entrainment_speed": speed}
    case = line(load, speed, oil, error=0.002).replace({"contact": BODIES | contact})
    result = solve(case)
    assert result.converged
    assert result.film.domain_loss <= 0.002
    assert not [warning.code for warning in result.warnings if warning.code.startswith("inlet")]
    far_away = case.replace({"grid": {"inlet": -240.0, "outlet": 20.0, "nodes": 16641}})
    reference = solve(far_away, require_convergence=True).film
    assert result.film.central_thickness == pytest.approx(reference.central_thickness, rel=0.005)
    assert result.film.minimum_thickness == pytest.approx(reference.minimum_thickness, rel=0.005)


def test_a_given_inlet_stays_and_is_warned_of():
    result = solve(line(1e4, 4.0, inlet=-4.0))
    assert far(result.film) == pytest.approx(-4.0)
    assert "inlet-far-too-short" in [warning.code for warning in result.warnings]


def test_the_ambient_pressure_carries_no_more_on_a_larger_domain():
    """On 67 half-widths it would carry 2 % of the load more than on the default ones."""
    films = [solve(line(1e4, 4.0, oil)).film for oil in (OIL, {"base": "paper"})]
    assert films[1].central_thickness == pytest.approx(films[0].central_thickness, rel=5e-3)


@pytest.mark.slow
def test_a_ball():
    """A ball of 3 N, beside a domain of 32 semi-axes ahead and 16 beside with ambient edges."""
    found = solve(ball(3.0, 2.0)).film
    reference = solve(ball(3.0, 2.0, inlet=-32.0, outlet=4.0, side=16.0, nodes=577, nodes_y=513)).film
    assert found.central_thickness == pytest.approx(reference.central_thickness, rel=0.015)
    assert found.domain_loss <= 0.02


@pytest.mark.slow
def test_a_ball_that_hardly_presses():
    """A ball of 1 N, whose oil carries half of its load more than 20 semi-axes away.

    On given domains of 24 and 48 semi-axes with ambient edges the film still grows by a fifth, and the loss
    falls with their size: its logarithm extrapolates to 0.925 um. With the oil around it the film is found.
    """
    given = {"outlet": 4.0, "nodes": 449, "nodes_y": 449}
    near, far_off = (
        solve(ball(1.0, 2.0, inlet=-size, side=0.5 * size, **given)).film for size in (24.0, 48.0)
    )
    result = solve(ball(1.0, 2.0))
    extrapolated = far_off.central_thickness**2 / near.central_thickness
    assert result.film.central_thickness == pytest.approx(extrapolated, rel=0.06)
    assert result.film.domain_loss < 0.02
    for film in (near, far_off):
        lost = 1.0 - film.central_thickness / result.film.central_thickness
        assert 0.7 * lost < film.domain_loss < 1.5 * lost


@pytest.mark.slow
def test_a_ball_that_presses_even_less_is_warned_of():
    """A ball of 0.3 N: a twelfth of its load stays unknown even on the largest domain."""
    result = solve(ball(0.3, 2.0))
    assert result.converged
    assert result.film.domain_loss > 0.3
    assert "domain-far-too-small" in [warning.code for warning in result.warnings]


@pytest.mark.slow
def test_a_film_on_a_larger_domain_survives_the_disk(tmp_path):
    for case in (line(1e4, 4.0), ball(3.0, 2.0)):
        result = solve(case)
        back = load(save(result, tmp_path / case.contact.geometry)[1])
        assert far(back.film) == far(result.film) < -10.0
        assert back.summary() == result.summary()
        assert back.case == case


def test_the_summary_has_the_domain_of_the_film(tmp_path):
    """The ends of the grid on which the film was solved, also after loading; given ends stay as given."""
    result = solve(line(3e3, 2.0))
    ends = [float(result.film.x[k]) / result.conditions.half_width for k in (0, -1)]
    assert ends[0] < -4.5
    save(result, tmp_path)
    for summary in (result.summary(), load(tmp_path).summary()):
        grid = summary["inputs"]["grid"]
        assert [grid["inlet"], grid["outlet"]] == pytest.approx(ends, rel=1e-8)
    given = solve(line(3e5, 4.0, inlet=-5.3, outlet=2.0, nodes=401)).summary()["inputs"]["grid"]
    assert (given["inlet"], given["outlet"]) == (-5.3, 2.0)


@pytest.mark.slow
def test_the_summary_of_a_ball_has_the_sides_of_the_domain():
    result = solve(ball(2.0, 2.0))
    grid, film = result.summary()["inputs"]["grid"], result.film
    assert grid["side"] > 3.0
    assert grid["side"] == pytest.approx(film.y[-1] / result.conditions.semi_axes[1], rel=1e-8)


@pytest.mark.slow
def test_a_sweep_over_domains_of_several_sizes_has_a_note(tmp_path):
    """Light points have larger domains, and the capacitance of the whole film grows with the domain."""
    case = line(3e5, 4.0).replace({"discharge": {"dielectric_strength": "15 V/um"}})
    vary = {"contact.load_per_length": [3e3, 3e5]}
    results = run_sweep({"case": case.to_dict(), "vary": vary}, tmp_path / "own", workers=1)
    assert [one.code for one in sweep_warnings(results)].count("domains-differ") == 1
    inlets = results.numbers["inputs.grid.inlet"]
    assert inlets[0] < inlets[1] < -4.0
    assert not any(key.startswith("verdict") for key in results.numbers)
    same = case.replace({"grid.inlet": -6.0, "grid.outlet": 2.0})
    results = run_sweep({"case": same.to_dict(), "vary": vary}, tmp_path / "same", workers=1)
    assert "domains-differ" not in [one.code for one in sweep_warnings(results)]
