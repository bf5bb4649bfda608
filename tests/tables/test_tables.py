"""Tables that are printed: each label is understood alone, and the inputs that decide come first."""

import re
from dataclasses import replace

import numpy as np
import pytest

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import resolve
from ehlectric.contact.solver import solve
from ehlectric.contact.summary import case_summary
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import read_motion
from ehlectric.motion.summary import summary_of
from ehlectric.tables.contact_tables import case_rows, condition_rows, result_rows
from ehlectric.tables.motion_tables import run_rows, schedule_rows
from ehlectric.tables.surface_tables import surface_table
from ehlectric.tables.sweep_summary import sweep_rows
from tests.conftest import PAPER_CONTACT
from tests.contact.spots.cases import solved
from tests.helpers.each import each
from tests.helpers.moving_cases import moving
from tests.helpers.point_pages import result_of
from tests.helpers.sweep_models import breakdown, grid

# Words that no other text on lubrication or on electric breakdown uses in this sense.
PRIVATE = re.compile(
    r"\b(held still|least|largest|smallest|took|reckon\w*|over|times|first break|through breakdown|by volt)\b"
)


def line(*, contact=None, **tables):
    tables = {"contact": PAPER_CONTACT | (contact or {}), "lubricant": {"base": "paper"}} | tables
    return Case.from_dict(tables)


def rows_of_a_case(case):
    return case_rows(case, case_summary(case, resolve(case)))


def texts(rows):
    return {row.name: row.text for row in rows}


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """Summary of a short run with moving roughness."""
    folder = tmp_path_factory.mktemp("moved")
    run_motion(moving(motion={"passes": 1.0, "steps": 16, "record": 5}), folder)
    return summary_of(read_motion(folder))


PRINTED = ("check line", "check motion", "line", "rough line", "circle", "gaussian", "motion")


@pytest.fixture(scope="module")
def printed(moved):
    """Rows of every table that is printed, by name."""
    contact = TransientContact.of(moving())
    summary = case_summary(contact.case, contact.conditions)
    schedule = schedule_rows(summary | {"motion": contact.schedule.described()})
    rough = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "200 um"}
    return {
        "check line": rows_of_a_case(line()),
        "check motion": [*rows_of_a_case(moving()), *schedule],
        "line": result_rows(solve(line(grid={"nodes": 401}))),
        "rough line": result_rows(solve(line(grid={"nodes": 401}, roughness=[rough]))),
        "circle": result_rows(result_of("circle")),
        "gaussian": result_rows(result_of("gaussian")),
        "motion": run_rows(moved),
    }


@pytest.mark.slow
@each("table", PRINTED)
def test_labels_are_understood_alone(printed, table):
    """No label continues the row above, none is there twice, and none has words of our own."""
    names = [row.name for row in printed[table]]
    assert len(names) > 15
    assert [name for name in names if name != name.strip() or PRIVATE.search(name)] == []
    assert len(set(names)) == len(names)
    assert max(map(len, names)) <= 40


@each("table", PRINTED)
def test_inputs_that_decide_come_first(printed, table):
    rows = printed[table]
    named = texts(rows)
    assert rows[0].heading
    for name in ("entrainment speed", "slide-to-roll ratio", "viscosity at ambient pressure"):
        assert named[name]
    assert named["voltage across the film"].endswith(" V")
    assert any(name.startswith("load") and text.endswith((" N", " MN/m")) for name, text in named.items())


def test_a_radius_of_metres_is_seen():
    """14.1 that was meant as mm: taken as metres, printed as metres."""
    named = texts(rows_of_a_case(line(contact={"reduced_radius": 14.1})))
    assert named["reduced radius"] == "14.1 m"
    assert texts(rows_of_a_case(line()))["reduced radius"] == "14.1 mm"


def test_speeds_of_both_surfaces_are_those_of_the_case():
    speeds = {"entrainment_speed": None, "speed_1": 3.0, "speed_2": 2.0}
    case = line(contact=speeds)
    named = texts(condition_rows(case, resolve(case)))
    assert named["entrainment speed"] == "2.5 m/s"
    assert named["slide-to-roll ratio"] == "0.4, surfaces at 3 and 2 m/s"
    rolling = texts(condition_rows(line(), resolve(line())))
    assert rolling["slide-to-roll ratio"] == "0, pure rolling"
    assert "temperature of the oil" not in rolling


def test_temperature_and_name_of_the_oil_stand_before_its_viscosity():
    case = line(contact={"temperature": 313.15}, lubricant={"base": "fva-3"})
    named = texts(condition_rows(case, resolve(case)))
    assert named["temperature of the oil"] == "40 °C, fva-3"
    assert named["viscosity at ambient pressure"] == "84.54 mPa s"


def test_a_film_that_is_not_converged_is_said_first():
    rows = result_rows(solve(line(grid={"nodes": 401}, solver={"max_iterations": 1})))
    assert (rows[0].name, rows[0].alarm) == ("NOT CONVERGED", True)
    assert not any("vs. solved" in row.text for row in rows)


def test_formulas_are_compared_with_the_solved_film():
    result = solve(line(grid={"nodes": 401}))
    named = texts(result_rows(result))
    solved, formula = result.film.minimum_thickness, result.formulas()["pan_hamrock"].minimum_thickness
    expected = f"{formula * 1e6:.4g} µm, {100 * (formula / solved - 1):+.0f} % vs. solved film"
    assert named["minimum film (Pan-Hamrock)"] == expected


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point"])
def test_formulas_are_not_compared_with_a_boundary_film(geometry):
    result = solved(geometry)
    named = texts(result_rows(result))
    assert not any("vs. solved film" in text for text in named.values())
    assert "asperities are in contact" in named["usual difference from a solved film"]
    assert "boundary film" in named["lambda ratio"]
    name = "pan_hamrock" if geometry == "line" else "chittenden"
    least = {"line": "minimum film (Pan-Hamrock)", "point": "minimum film (Chittenden et al.)"}[geometry]
    change = 100.0 * (result.formulas()[name].minimum_thickness / result.smooth.minimum_thickness - 1.0)
    assert named[least].endswith(f", {change:+.0f} % vs. film of smooth surfaces")
    assert named[least.replace("minimum", "central")].endswith("µm")


def test_a_run_says_when_film_and_field_are_at_their_worst(moved):
    named = texts(run_rows(moved))
    film, field = moved["film"], moved["field"]
    expected = f"{film['minimum_thickness'] * 1e6:.4g} µm at {film['minimum_time'] * 1e3:.4g} ms"
    assert named["minimum film, moving roughness"] == expected
    expected = f"≥ {field['max_strength'] / 1e6:.4g} V/µm at {field['max_strength_time'] * 1e3:.4g} ms"
    assert named["maximum field, moving roughness"] == expected
    assert "halvings of time steps" not in named
    halved = {**moved, "motion": moved["motion"] | {"halvings": 3}}
    assert texts(run_rows(halved))["halvings of time steps"] == "3"


def test_a_sweep_says_why_points_failed():
    """Reasons that differ in their numbers alone are one, with the number of its points."""
    results = grid({"contact.entrainment_speed": list(np.linspace(1.0, 2.0, 4))}, breakdown)
    reasons = ["", "grid.nodes: got 65", "grid.nodes: got 33", "no memory"]
    points = [
        replace(point, status="failed" if reason else "solved", reason=reason)
        for point, reason in zip(results.points, reasons, strict=True)
    ]
    solved, unconverged, failed, two, one = sweep_rows(replace(results, points=tuple(points)))
    assert [row.text for row in (solved, unconverged, failed)] == ["1 of 4", "0 of 4", "3 of 4"]
    assert "2 points" in two.name
    assert two.text.endswith("grid.nodes: got 65")
    assert "1 point" in one.name
    assert one.text == "no memory"


@pytest.mark.parametrize(
    ("size", "voids", "step", "said"),
    [
        (None, None, None, ("surface 1: generated", "0.5 µm")),
        ([1, 300], 0.0, None, ("surface 1: a.csv", "300 points", "0.5 µm")),
        ([20, 30], 0.02, 1e-9, ("surface 1: a.csv", "20 x 30 points", "0.5 µm", "2 %", "1 nm")),
    ],
)
def test_the_head_of_a_surface(size, voids, step, said):
    numbers = ("rq", "ra", "rsk", "rku", "correlation_length", "largest_slope")
    first = {"step": "as read", "points": 300, "spacing": 5e-7} | dict.fromkeys(numbers, 1e-9)
    surface = {"surface": 1, "source": None if size is None else "a.csv", "size": size, "voids": voids}
    table = surface_table(surface | {"height_step": step, "steps": [first]})
    for text in said:
        assert text in str(table.title)
    assert ("%" in str(table.title)) == bool(voids)
