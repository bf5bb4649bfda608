"""The paper's eight contacts with a measured profile, and its conclusion about them."""

from itertools import product

import numpy as np
import pytest

from ehlectric import Case, solve
from tests.conftest import PAPER_CONTACT
from tests.helpers.films import film_alone
from tests.helpers.gate import gated
from tests.helpers.places import DEKTAK

pytestmark = pytest.mark.published

PROFILE = {"file": str(DEKTAK), "form": "parabola", "cutoff_long": 80e-6, "truncate": 0.05e-6}


def rough_case(surface=1, nodes=3201, load=1.57e6, speed=4.0, **changes):
    contact = PAPER_CONTACT | {"load_per_length": load, "entrainment_speed": speed} | changes
    return Case.from_dict(
        {
            "contact": {key: value for key, value in contact.items() if value is not None},
            "lubricant": {"base": "paper"},
            "roughness": [{"surface": surface} | PROFILE],
            "grid": {"nodes": nodes},
        }
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("load", "speed", "nodes"),
    gated(product([1.57e6, 3.925e5], [4.0, 2.0, 1.0, 0.5], [3201, 12_801]), (1.57e6, 2.0, 12_801)),
)
def test_v12_over_h_min_is_the_largest_field(load, speed, nodes):
    """The paper's first conclusion, for a profile like its own: within four per cent, and from above."""
    result = solve(rough_case(load=load, speed=speed, nodes=nodes))
    assert result.film.converged
    assert result.film.load_residual < 1e-10
    field = result.summary()["field"]
    assert 1.0 < field["max_dimensionless"] < 1.04
    assert result.smooth is not None
    assert result.film.minimum_thickness < 1.01 * result.smooth.minimum_thickness


@pytest.mark.slow
@pytest.mark.gate
def test_film_does_not_tell_which_surface_is_rough():
    first, second = (solve(rough_case(surface)) for surface in (1, 2))
    np.testing.assert_allclose(second.film.thickness, first.film.thickness, rtol=1e-10)
    # Equal bodies: the field is the mirror image.
    # The peak of a rough wall is where the field is largest, and it is that wall.
    walls = (first.field.max_strength_wall, second.field.max_strength_wall)
    assert walls == ("surface 1", "surface 2")
    assert second.field.max_strength == pytest.approx(first.field.max_strength, rel=1e-8, abs=0.0)
    np.testing.assert_allclose(second.field.strength[:, ::-1], first.field.strength, rtol=1e-6)


@pytest.mark.slow
@pytest.mark.gate
def test_field_of_unequal_bodies_tells():
    # A small body in a tight ring: the walls slope, and so it matters which of them is rough.
    radii = {"reduced_radius": None, "radius_1": 14.1e-3 / 3, "radius_2": -14.1e-3 / 2}
    first, second = (solve(rough_case(surface, **radii)) for surface in (1, 2))
    assert abs(second.field.max_strength / first.field.max_strength - 1.0) > 1e-6


RESOLVED = [
    {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "40 um"},
    {"surface": 1, "generator": "gaussian", "rq": "10 nm", "correlation_length": "10 um", "seed": 3},
    {"surface": 1, "cutoff_short": "10 um"} | PROFILE,
]


@pytest.mark.slow
@pytest.mark.parametrize("load", [1.57e6, 3.925e5])
@pytest.mark.parametrize("table", RESOLVED, ids=["sinusoid", "gaussian", "measured"])
def test_error_estimate_of_roughness_the_grid_resolves(table, load):
    """Within a factor 3 of the true error, against sixteen times as many nodes."""
    case = rough_case(load=load, speed=1.0).replace({"roughness": (table,), "grid.wedge": "second-order"})
    film, fine = (film_alone(case.replace({"grid.nodes": n})) for n in (3201, 51_201))
    true = max(
        abs(film.minimum_thickness / fine.minimum_thickness - 1.0),
        abs(film.central_thickness / fine.central_thickness - 1.0),
    )
    assert true / 3.0 < film.discretisation_error < 3.0 * true


def test_grid_that_does_not_resolve_the_profile_is_said():
    assert any(
        "does not resolve the profile" in text for text in map(str, solve(rough_case(nodes=801)).warnings)
    )


@pytest.mark.slow
@pytest.mark.gate
def test_roughness_is_in_the_summary():
    summary = solve(rough_case(nodes=1601)).summary()
    steps = summary["roughness"]["surfaces"][0]["steps"]
    assert [step["step"].split(":")[0] for step in steps] == [
        "as read",
        "form",
        "cutoff_long",
        "trim",
        "truncate",
    ]
    assert steps[3]["rq"] == pytest.approx(9.0e-9, rel=0.02, abs=0.0)
    assert summary["roughness"]["rq_2"] == 0.0
    # Only one surface is rough: combined is its own.
    assert summary["roughness"]["rq_combined"] == pytest.approx(summary["roughness"]["rq_1"])
    assert summary["roughness"]["combined"]["rq"] == pytest.approx(summary["roughness"]["rq_1"])
    expected = summary["film"]["minimum_thickness"] / summary["roughness"]["rq_1"]
    assert summary["roughness"]["lambda_ratio"] == pytest.approx(expected)
    expected = summary["roughness"]["smooth_minimum_thickness"] / summary["roughness"]["rq_1"]
    assert summary["roughness"]["lambda_ratio_smooth"] == pytest.approx(expected)


def test_lambda_ratio_is_of_what_the_film_feels():
    """Two equal waves on both surfaces add up to twice one, and opposite ones to nothing."""
    wave = {"generator": "sinusoid", "amplitude": "10 nm", "wavelength": "50 um"}
    case = rough_case(nodes=801)
    for phase, rq in ((0.0, 2 * 10e-9 / np.sqrt(2)), (np.pi, None)):
        pair = ({"surface": 1} | wave, {"surface": 2, "phase": phase} | wave)
        roughness = solve(case.replace(roughness=pair)).summary()["roughness"]
        assert roughness["rq_1"] == pytest.approx(roughness["rq_2"], rel=1e-9, abs=0.0)
        if rq is None:
            assert roughness["rq_combined"] < 1e-20
            assert (roughness["lambda_ratio"], roughness["lambda_ratio_smooth"]) == (None, None)
        else:
            assert roughness["rq_combined"] == pytest.approx(rq, rel=0.02, abs=0.0)
            smooth = roughness["smooth_minimum_thickness"]
            assert roughness["lambda_ratio_smooth"] == pytest.approx(smooth / rq, rel=0.02, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
def test_smooth_contact_is_beside_the_rough_one():
    result = solve(rough_case(nodes=1601))
    alone = solve(result.case.replace(roughness=()))
    np.testing.assert_array_equal(result.smooth.thickness, alone.film.thickness)
    assert alone.smooth is None
    assert solve(result.case, beside_smooth=False).smooth is None
    expected = result.summary()["roughness"]["smooth_minimum_thickness"]
    assert expected == alone.film.minimum_thickness
    at = np.isin(result.field.x, alone.field.x)
    assert at.sum() == alone.field.x.size
    np.testing.assert_allclose(result.smooth.middle_strength[at], alone.field.middle_strength, rtol=1e-12)


def test_profile_shorter_than_the_domain_is_said():
    assert any(
        "continued by extend = 'mirror'" in text for text in map(str, solve(rough_case(nodes=801)).warnings)
    )


def test_sinusoid_lies_where_it_should():
    table = {"surface": 2, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "40 um", "phase": 0.3}
    case = rough_case(nodes=1601).replace(roughness=(table,))
    result = solve(case)
    assert result.film.converged
    expected = 20e-9 * np.sin(2 * np.pi * result.film.x / 40e-6 + 0.3)
    np.testing.assert_allclose(result.roughness[1], expected, atol=1e-20)
    assert np.all(result.roughness[0] == 0.0)


@pytest.mark.slow
def test_film_of_the_order_of_its_roughness():
    """Roughness as high as the film leaves a full film; one higher than the film pierces it."""
    table = {"surface": 1, "generator": "gaussian", "rq": 2.5e-7, "correlation_length": 5e-6, "seed": 4}
    solved = solve(rough_case(nodes=801, speed=4.0).replace(roughness=(table,)))
    assert solved.film.converged
    assert not solved.film.contact.any()
    touching = solve(rough_case(nodes=801, speed=0.05).replace(roughness=(table,))).film
    assert touching.converged
    assert touching.contact.any()
    assert touching.minimum_thickness == pytest.approx(1e-9, rel=1e-6)


@pytest.mark.slow
def test_waves_in_the_outlet_do_not_fill_it():
    """Waves of 4 µm narrow the gap behind the exit, where there is too little oil to fill it."""
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": 20e-9, "wavelength": 4e-6, "phase": 1.0}
    case = rough_case(nodes=6401, load=3.925e5, speed=1.0).replace(roughness=(wave,))
    case = case.replace({"grid.wedge": "second-order"})
    film = film_alone(case)
    assert film.cavitates
    assert np.all(film.cavitated[film.x > 1.3 * film.scales.length])


@pytest.mark.slow
def test_estimate_of_a_minimum_that_jumps_between_valleys():
    """The minima on 801 and 1601 nodes agree to 0.2 % by chance; the true error is 5 %."""
    case = rough_case(load=3.925e5, speed=0.5).replace({"grid.wedge": "second-order"})
    films = {n: film_alone(case.replace({"grid.nodes": n})) for n in (801, 1601, 12_801)}
    minima = {n: film.minimum_thickness for n, film in films.items()}
    assert minima[801] == pytest.approx(minima[1601], rel=3e-3, abs=0.0)
    true = minima[1601] / minima[12_801] - 1.0
    assert 0.04 < true < films[1601].discretisation_error < 2.0 * true


@pytest.mark.slow
@pytest.mark.gate
def test_estimate_of_the_maximum_pressure():
    """It moves from 4.6 to 5.3 GPa where the film is known to 1 %."""
    case = rough_case(speed=1.0).replace({"grid.wedge": "second-order"})
    coarse, fine = (film_alone(case.replace({"grid.nodes": n})) for n in (3201, 12_801))
    assert coarse.discretisation_error < 0.01
    true = fine.max_pressure / coarse.max_pressure - 1.0
    assert 0.1 < true < coarse.max_pressure_error
    assert fine.max_pressure_error < coarse.max_pressure_error


@pytest.mark.slow
@pytest.mark.gate
def test_steel_yields_under_the_asperities():
    """At a Hertz pressure of 2 GPa, half of what steel bears; a spike of a smooth contact does not matter."""
    result = solve(rough_case(speed=1.0, nodes=1601), beside_smooth=False)
    (warning,) = [w for w in result.warnings if w.code == "local-plastic-deformation"]
    assert warning.text.startswith(
        "the local pressure of the rough film is 3.44 GPa, or several times more, "
    )
    assert "above about 4 GPa" in warning.text
    mild = solve(rough_case(load=1e5, nodes=1601), beside_smooth=False)
    assert mild.film.max_pressure < 2e9
    assert "local-plastic-deformation" not in [w.code for w in mild.warnings]


@pytest.mark.slow
@pytest.mark.gate
def test_each_rough_contact_is_beside_its_own_smooth_one():
    """To the last bit, also if a contact before it differed only in its roughness, or in its speed."""
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "60 um"}
    cases = [
        rough_case(nodes=401, speed=speed).replace(roughness=[wave | {"phase": phase}])
        for speed, phase in ((4.0, 0.0), (4.0, 1.0), (2.0, 1.0), (4.0, 1.0))
    ]
    for case in cases:
        result = solve(case)
        alone = solve(case.replace(roughness=()))
        np.testing.assert_array_equal(result.smooth.pressure, alone.film.pressure)
        np.testing.assert_array_equal(result.smooth.thickness, alone.film.thickness)
