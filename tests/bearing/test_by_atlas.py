"""Contacts from the atlas against solved contacts, gaps summed otherwise, and what lies outside it."""

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric.bearing.ball_gaps import parts_around_ellipse
from ehlectric.bearing.bearing_discharges import breakdown_of
from ehlectric.bearing.quick_contacts import (
    QUICK_METHODS,
    quick_case,
    quick_curve,
)
from ehlectric.bearing.ring_contacts import BALL_DOMAINS
from ehlectric.bearing.solution import capacitance, film_error
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.defaults import quick_way
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import contact_film, groups_of
from ehlectric.formulas.dry_means import wedge_integral
from ehlectric.formulas.hertz import dry_contact, line_gap, point_deflection
from tests.helpers.bearings import (
    BALLS,
    ROLLERS,
    bearing_case,
    contact_of,
    quick_contact,
    ring_of,
    solve_contact,
)

SPEED = 4.5


def integral(part, middle):
    """Integral of dA/h over a part of the gap, widened by the film in the middle; dimensionless."""
    weights, gap = part
    return float(np.sum(weights / (middle + gap)))


NUMBERS = ("minimum_thickness", "central_thickness", "inside", "outside_oil", "plate", "breakdown_voltage")


def by_atlas(tables, load, *, speed=SPEED, **changes):
    return quick_contact(ring_of(bearing_case(tables, **changes), speed=speed), load, "atlas")


def beside_solved(tables, load):
    """Differences from a solved contact by the name of the number, and the stated error of the film."""
    case = bearing_case(tables)
    ring = ring_of(case, speed=SPEED)
    quick = quick_contact(ring, load, "atlas")
    solved = solve_contact(ring, load, case.solver.model_dump())
    names = (*NUMBERS, "hertz", "strength_per_volt")
    ratios = {name: getattr(quick.values, name) / getattr(solved.values, name) - 1.0 for name in names}
    return ratios, quick.error


@pytest.mark.parametrize("load", [1500.0, 60.0])
def test_a_roller_has_the_numbers_of_its_solution(load):
    ratios, error = beside_solved(ROLLERS, load)
    assert error < 0.06
    for name in NUMBERS:
        assert abs(ratios[name]) < max(0.02, error), name


@pytest.mark.slow
@pytest.mark.parametrize("load", [600.0, 60.0])
def test_a_ball_has_the_numbers_of_its_solution(load):
    """The light one has a domain that is wider than that of the atlas."""
    ratios, error = beside_solved(BALLS, load)
    assert error < 0.06
    for name in NUMBERS:
        assert abs(ratios[name]) < 0.03, name
    assert abs(ratios["hertz"]) < 0.04


@pytest.mark.slow
@pytest.mark.parametrize("speed", ["500 rpm", "15000 rpm"])
def test_a_bearing_has_the_capacitance_and_voltage_of_its_solution(speed):
    case = bearing_case(BALLS, bearing__inner_speed=speed)
    quick, solved = (solution_of(case.replace({"contacts": way})) for way in ("atlas", "solved"))
    for fill in ("oil", "air"):
        assert capacitance(quick, fill) == pytest.approx(capacitance(solved, fill), rel=0.02)
    first = breakdown_of(solved).first_break
    assert breakdown_of(quick).first_break == pytest.approx(first, rel=0.02)


def test_the_capacitance_of_the_hertz_zone_is_that_of_the_film():
    """For an oil that pressure does not compress, eps_r A/h(0) times the mean of h(0)/h."""
    fixed = {"density_law": "incompressible", "permittivity_law": "constant"}
    found = by_atlas(ROLLERS, 1500.0, **{f"lubricant__{key}": value for key, value in fixed.items()})
    ring = ring_of(bearing_case(ROLLERS, **{f"lubricant__{k}": v for k, v in fixed.items()}), speed=SPEED)
    contact = contact_of(ring, 1500.0)
    film = contact_film(contact.conditions.contact, ring.oil)
    area = 2.0 * contact.conditions.half_width * contact.length
    plate = epsilon_0 * ring.oil.relative_permittivity * area / film.central_thickness
    assert found.values.plate == pytest.approx(plate, rel=1e-12)
    assert found.values.hertz == pytest.approx(film.film.zone * plate, rel=1e-3)


@pytest.mark.parametrize("middle", [1e-3, 0.1])
def test_the_gap_around_a_roller_is_that_of_quadrature(middle):
    for end in ((-4.0, -1.0), (1.0, 2.0)):
        expected = quad(lambda x: 1.0 / (middle + float(line_gap(x))), *end, points=[], limit=400)[0]
        found = wedge_integral(np.array(middle), max(end, key=abs))
        assert float(found) == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("ratio", [1.1, 30.0])
def test_the_gap_around_a_ball_is_that_of_a_fine_grid(ratio):
    """Cells of a four-hundredth of the domain; those that the ellipse cuts cost less than a per cent."""
    dry, middle = dry_contact(1.0, 1.0, ratio, 1.0), 0.05
    b, a = dry.semi_axis_x, dry.semi_axis_y
    side = min(4.5, 1.6 + 1.4 * b / a)
    for part, end in zip(parts_around_ellipse(ratio, BALL_DOMAINS), (-4.5, 1.5), strict=True):
        x = b * end * (np.arange(400) + 0.5)[:, None] / 400
        y = a * side * (np.arange(400) + 0.5) / 400
        bodies = 0.5 * (x**2 + y**2 / ratio) + point_deflection(x, y, dry, 1.0) - dry.approach
        free = (x / b) ** 2 + (y / a) ** 2 > 1.0
        density = np.where(free, 1.0 / (middle + np.maximum(0.0, bodies) / b**2), 0.0)
        expected = 2.0 * abs(end) * side * a / b * float(density.mean())
        assert integral(part, middle) == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(("tables", "load"), [(BALLS, 2.0), (ROLLERS, 0.2)])
def test_outside_the_atlas_the_film_is_by_formula_and_says_so(tables, load):
    ring = ring_of(bearing_case(tables), speed=SPEED)
    contact = contact_of(ring, load)
    with pytest.raises(InputError, match="atlas"):
        contact_film(contact.conditions.contact, ring.oil)
    found = quick_contact(ring, load, "atlas")
    (warning,) = (one for one in found.warnings if one.code == "atlas-left")
    assert f"may be wrong by {100.0 * found.error:.0f} %" in str(warning)
    # The error grows from the error at the edge with the distance from it.
    edge = edge_of(ring, load)
    parts = (1.0, 0.99, 0.9, 0.7, 0.1, 0.05)
    errors = [quick_contact(ring, edge * part, "atlas").error for part in parts]
    assert np.all(np.diff(errors[:5]) > 0.0)
    assert errors[1] == pytest.approx(errors[0], abs=0.01)
    # Lighter films are known: they are the films of rigid bodies.
    assert errors[-1] < errors[0] + 0.41


def edge_of(ring, load):
    """Load with the least load group of the atlas: N of 3, or M of 0.2; both are proportional to the load."""
    groups = groups_of(contact_of(ring, load).conditions.contact, ring.oil)
    return load * (0.2 if groups.ratio is None else 3.0) / groups.load_group


@pytest.mark.parametrize("tables", [BALLS, ROLLERS])
def test_numbers_have_no_step_at_the_edge_of_the_atlas(tables):
    ring = ring_of(bearing_case(tables), speed=SPEED)
    edge = edge_of(ring, 0.5)
    parts = (1.03, 1.001, 0.98)
    before, inside, outside = (quick_contact(ring, edge * part, "atlas") for part in parts)
    codes = [[one.code for one in found.warnings] for found in (inside, outside)]
    assert ["atlas-left" in found for found in codes] == [False, True]
    for name in (*NUMBERS, "hertz"):
        # The numbers go on by the power of the load that they have inside.
        above, one, other = (getattr(found.values, name) for found in (before, inside, outside))
        power = np.log(one / above) / np.log(parts[1] / parts[0])
        assert other == pytest.approx(one * (parts[2] / parts[1]) ** power, rel=0.02), name


def test_light_contacts_outside_the_atlas_are_a_note_and_do_not_count():
    """At 3000 rpm balls without radial load are pressed outward by 3 N, against 900 N of the others."""
    solution = solution_of(bearing_case(BALLS, contacts="atlas"))
    found = bearing_warnings(solution)
    warnings = {one.code: one for one in found}
    assert "atlas-left" not in warnings
    notes = [one for one in found if one.code == "atlas-left-light"]
    assert {one.severity for one in notes} == {"note"}
    # One note for both rings, with the largest error of their light contacts.
    (note,) = notes
    error = max(max(curve.error[curve.left]) for curve in solution.curves)
    for curve, name in zip(solution.curves, ("inner", "outer"), strict=True):
        loads = curve.loads[curve.left & curve.used]
        assert f"{len(loads)} {name} contacts at {loads[0]:.4g} to {loads[-1]:.4g} N" in str(note)
    assert f"may be wrong by {100.0 * error:.0f} %" in str(note)
    largest = max(contact.error for curve in solution.curves for contact in curve.counted.solutions)
    assert largest <= film_error(solution) < 0.15
    assert f"{100.0 * film_error(solution):.2g} %" in str(warnings["atlas-contacts"])


def test_a_loaded_contact_outside_the_atlas_is_a_warning_and_counts():
    """Thick oil at a high speed: hardly any pressure rises above that of rigid bodies."""
    table = {"kinematic_viscosity_40": "460 mm^2/s", "kinematic_viscosity_100": "31 mm^2/s"}
    changes = {f"lubricant__temperature__{key}": value for key, value in table.items()}
    case = bearing_case(
        BALLS, **changes, contacts="atlas", bearing__radial_load="25 N", bearing__axial_load="5 N"
    )
    solution = solution_of(case)
    left = [one for one in bearing_warnings(solution) if one.code == "atlas-left"]
    assert {one.severity for one in left} == {"warning"}
    error = max(np.max(curve.error[curve.left & curve.counted.used]) for curve in solution.curves)
    assert any(f"may be wrong by {100.0 * error:.0f} %" in str(one) for one in left)
    assert film_error(solution) >= error > 0.1


def test_the_quick_way_is_the_atlas_unless_the_case_is_by_formula():
    assert [quick_way(way) for way in ("solved", "atlas", "formula", None)] == [
        "atlas",
        "atlas",
        "formula",
        "atlas",
    ]
    for way, quick in (("solved", "atlas"), ("formula", "formula")):
        case, refused = quick_case(bearing_case(BALLS, contacts=way))
        assert (case.contacts, refused) == (quick, None)


@pytest.mark.parametrize("way", ["atlas", "formula"])
def test_a_strength_that_needs_the_field_is_refused_by_the_name_of_the_way(way):
    weibull = {"scale": "15 V/um", "shape": 8.0, "reference_area": "1 mm^2"}
    case = bearing_case(BALLS, contacts=way, discharge__dielectric_strength=None, discharge__weibull=weibull)
    with pytest.raises(InputError, match=way):
        solution_of(case)


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
@pytest.mark.parametrize("inner", [True, False])
def test_contacts_of_several_loads_are_those_of_each_alone(tables, inner):
    """From loads with a domain and a film of their own to those that share the default domain."""
    ring, loads = ring_of(bearing_case(tables), inner=inner, speed=SPEED), (2.0, 20.0, 200.0, 900.0)
    together = quick_curve(QUICK_METHODS["atlas"](contact_of(ring, np.array(loads)))).solutions
    for load, found in zip(loads, together, strict=True):
        alone = quick_contact(ring, load, "atlas")
        assert found.load == load
        assert found.warnings == alone.warnings
        assert found.mismatch == pytest.approx(alone.mismatch, rel=1e-9, abs=1e-15)
        for one, other in zip(found.values.columns(), alone.values.columns(), strict=True):
            assert one == pytest.approx(other, rel=1e-12, abs=0.0)
