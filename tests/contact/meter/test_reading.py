"""Reading of a meter at solved contacts: sums, limits, other domains, files, figure and table."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric import Case, load, save, solve
from ehlectric.contact.capacitance_meter import Metered, meter_profile, meter_warnings
from ehlectric.discharge.film_capacitance import roughness_factor
from ehlectric.figures.contact_figure_files import figure
from ehlectric.tables.contact_tables import result_rows
from tests.cases.test_point_case import point
from tests.conftest import PAPER_CONTACT

STRENGTH = {"dielectric_strength": "30 V/um"}
COATING = {"thickness": "2 um", "relative_permittivity": 8.0, "strength": "1 V/um"}
CASES = {
    "point": point(grid={"nodes": 65}, meter={"fill": "oil"}, discharge=STRENGTH),
    "line": Case.from_dict(
        {
            "contact": PAPER_CONTACT,
            "lubricant": {"base": "paper"},
            "grid": {"nodes": 401},
            "meter": {"fill": "oil"},
            "discharge": STRENGTH | {"length": "10 mm"},
        }
    ),
}
KINDS = pytest.mark.parametrize("kind", CASES)


@pytest.fixture(scope="module")
def results():
    return {kind: solve(case) for kind, case in CASES.items()}


@pytest.fixture
def read(results):
    """Reading of a contact with another table ``meter``; the film stays."""

    def reading(kind, **meter):
        result = results[kind]
        table = result.case.to_dict() | {"meter": meter}
        return replace(result, case=Case.from_dict(table)).meter

    return reading


@pytest.mark.slow
@KINDS
def test_parts_add_up(read, results, kind):
    reading = read(kind, fill=0.3, parallel_capacitance="2 pF")
    length = 0.01 if kind == "line" else 1.0
    assert reading.capacitance_domain == pytest.approx(length * results[kind].discharge.capacitance)
    assert reading.capacitance_hertz == pytest.approx(length * results[kind].discharge.capacitance_hertz)
    outside = 0.3 * reading.capacitance_outside_oil + 0.7 * reading.capacitance_outside_air
    assert reading.capacitance_outside == pytest.approx(outside)
    assert reading.capacitance == pytest.approx(reading.capacitance_domain + outside + 2e-12)
    assert reading.capacitance_oil - reading.capacitance_air == pytest.approx(
        reading.capacitance_outside_oil - reading.capacitance_outside_air
    )
    oil = results[kind].case.oil.relative_permittivity
    assert reading.capacitance_outside_oil == pytest.approx(oil * reading.capacitance_outside_air)
    assert reading.share_of_domain + reading.share_of_outside == pytest.approx(
        1.0 - 2e-12 / reading.capacitance
    )


@pytest.mark.slow
@KINDS
def test_oil_up_to_a_radius_is_between_air_and_oil(read, kind):
    dry, some, wet = (read(kind, oil_radius=radius) for radius in ("1 nm", "2 mm", "1 m"))
    assert dry.capacitance == pytest.approx(dry.capacitance_air)
    assert wet.capacitance == pytest.approx(wet.capacitance_oil)
    assert dry.capacitance < some.capacitance < wet.capacitance


def test_outside_is_that_of_a_cylinder_on_a_plane_that_hertz_pressure_opens(read, results):
    """Charge under a film that continues with the dry contact's gap, (b^2/2R)(X sqrt(X^2 - 1) - arcosh X).

    Where the gap is x^2/(2 R), the charge from d to R of a rigid cylinder is that of the parabola, without a
    correction for its arc. What is left is the arc's effect on the deflection, which is some thousandths.
    """
    reading, film, b = read("line", fill="air"), results["line"].film, results["line"].conditions.half_width

    def gap(x):
        along = x / b
        return 0.5 * b**2 / PAPER_RADIUS * (along * np.sqrt(along**2 - 1.0) - np.arccosh(along))

    expected = 0.0
    for d, thickness in ((abs(film.x[0]), film.thickness[0]), (film.x[-1], film.thickness[-1])):
        offset = thickness - gap(d)
        expected += quad(lambda x, offset=offset: 1.0 / (gap(x) + offset), d, PAPER_RADIUS)[0]
    assert reading.capacitance_outside_air == pytest.approx(0.01 * epsilon_0 * expected, rel=1e-3)


def test_outside_is_that_of_a_ball_on_a_plane(read, results):
    """To leading order the gap is r^2/(2 R): beyond a distance d the charge is a logarithm."""
    reading = read("point", fill="air")
    radius, d = 0.01, np.sqrt(4.5 * 3.0) * results["point"].conditions.semi_axis_x
    estimate = 2.0 * np.pi * epsilon_0 * radius * (2.0 * np.log(radius / d) + np.log(2.0) - 1.0)
    assert reading.capacitance_outside_air == pytest.approx(estimate, rel=0.15)


PAPER_RADIUS = 14.1e-3


@pytest.mark.slow
def test_domain_may_end_anywhere(results):
    """A larger domain moves capacitance from the outside into it; their sum stays."""
    larger = {"grid.inlet": -6.0, "grid.outlet": 3.0, "grid.side": 4.0, "grid.nodes": 97}
    wide, narrow = solve(CASES["point"].replace(larger)), results["point"]
    assert wide.meter.capacitance_outside < narrow.meter.capacitance_outside
    assert wide.meter.capacitance == pytest.approx(narrow.meter.capacitance, rel=0.02)


@pytest.mark.slow
@KINDS
def test_thin_coating_changes_nothing_and_a_thick_one_takes_the_voltage(read, kind):
    bare = read(kind, fill="oil")
    thin, thick = (
        read(kind, fill="oil", coating=COATING | {"thickness": thickness}) for thickness in ("1 nm", "0.1 mm")
    )
    assert thin.capacitance == pytest.approx(bare.capacitance, rel=3e-3)
    assert thin.coating_voltage_share < 0.01
    assert thick.coating_voltage_share > 0.9
    assert thick.capacitance < 0.8 * bare.capacitance
    for reading in (thin, thick):
        series = 1.0 / reading.capacitance_uncoated + 1.0 / reading.coating_capacitance
        assert 1.0 / reading.capacitance == pytest.approx(series)
        assert reading.capacitance_uncoated == pytest.approx(bare.capacitance)
        assert reading.film_voltage_share == pytest.approx(1.0 - reading.coating_voltage_share)


@pytest.mark.slow
def test_breakdown_of_film_and_coating(read, results):
    result, reading = results["point"], read("point", fill="oil", coating=COATING)
    film = result.film.minimum_thickness
    oil = result.case.oil.permittivity(result.film.pressure, result.film.density).flat[
        np.argmin(result.film.thickness)
    ]
    share = (film / oil) / (film / oil + 2e-6 / 8.0)
    alone = result.discharge.breakdown_voltage
    assert reading.film_voltage_share == pytest.approx(share)
    assert reading.film_breakdown_voltage == pytest.approx(alone / share)
    assert reading.coating_breakdown_voltage == pytest.approx(2.0)
    # Whichever breaks down first, the other one has the whole voltage then.
    assert reading.breakdown_voltage == pytest.approx(
        min(max(alone / share, 2.0), max(2.0 / (1.0 - share), alone))
    )
    unknown = read("point", fill="oil", coating={"thickness": "2 um", "relative_permittivity": 8.0})
    assert unknown.breakdown_voltage is None
    assert unknown.film_breakdown_voltage == reading.film_breakdown_voltage


@pytest.mark.slow
@KINDS
def test_roughness_factor_is_that_of_the_films(read, results, kind):
    film = results[kind].film
    rough = read(kind, fill="oil", rq=film.minimum_thickness / 5.0)
    most = float(roughness_factor(5.0))
    assert 1.0 < rough.roughness_factor < most
    assert rough.film_ratio == pytest.approx(5.0)
    smooth = read(kind, fill="oil")
    assert rough.capacitance_domain == pytest.approx(rough.roughness_factor * smooth.capacitance_domain)
    assert rough.capacitance_outside == smooth.capacitance_outside


def test_warnings(results):
    result = results["point"]
    film = result.film
    tables = (
        {"fill": "oil", "rq": film.minimum_thickness},
        {"fill": "oil", "coating": COATING},
        {"fill": "oil"},
    )
    found = [
        [w.code for w in meter_warnings(Case.from_dict(result.case.to_dict() | {"meter": meter}), film)]
        for meter in tables
    ]
    assert found == [["roughness-factor-rough"], ["coating-in-series"], []]


@pytest.mark.slow
@KINDS
def test_profile_ends_at_the_reading(results, kind):
    result = results[kind]
    profile = meter_profile(Metered(result.case, result.conditions, result.film, result.field))
    assert profile.filled[-1] == pytest.approx(result.meter.capacitance)
    assert profile.air[-1] == pytest.approx(result.meter.capacitance_air)
    assert np.all(np.diff(profile.filled) >= 0.0)
    assert np.all(profile.air <= profile.oil)
    within = np.interp(result.conditions.half_width, profile.radius, profile.filled)
    assert within == pytest.approx(result.meter.capacitance_hertz, rel=0.05)


@pytest.mark.slow
@KINDS
def test_file_figure_and_table(results, kind, tmp_path):
    result = results[kind]
    save(result, tmp_path)
    stored = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))["meter"]
    assert stored == result.meter.summary()
    assert load(tmp_path / "result.nc").meter == result.meter
    rows = {row.key: row for row in result_rows(result)}
    assert rows["meter.capacitance"].value == result.meter.capacitance
    title = figure(result, "meter.png")
    assert "distance from the contact" in title.axes[0].get_xlabel()


def test_without_the_table_there_is_no_reading(results):
    table = {key: value for key, value in results["point"].case.to_dict().items() if key != "meter"}
    result = replace(results["point"], case=Case.from_dict(table))
    assert result.meter is None
    assert "meter" not in result.summary()
