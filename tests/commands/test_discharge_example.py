"""The example of a discharge and the tables of the templates, as a user runs them."""

import json

import pytest

from ehlectric import Case
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES


@pytest.mark.slow
@pytest.mark.gate
def test_discharge_example(ehlectric, tmp_path):
    done = ehlectric("run", EXAMPLES / "discharge.toml", "-o", "out", "--no-plots")
    assert (done.returncode, done.stderr) == (0, "")
    for text in ("breakdown voltage", "at 15 V/µm", "outlet filling", "diameter of the pit", "A/mm²"):
        assert text in done.stdout
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(), parse_constant=pytest.fail)
    found = summary["discharge"]
    # It names every key, so that no number is missing but those of a Weibull law and of the sides of a point
    # contact.
    missing = {key for key, value in found.items() if value is None}
    assert missing == {"breakdown_voltage_low", "breakdown_voltage_high", "capacitance_sides"}
    # By hand, of the printed film: tests/data/published/line_contact_films.csv, 0.6390 um, converged.
    assert found["breakdown_voltage"] == pytest.approx(15e6 * 0.6390e-6, rel=1e-3, abs=0.0)
    assert found["margin"] == pytest.approx(found["breakdown_voltage"] / 8.0)
    # The ratio to the plate value of this contact, reckoned for DESIGN's table of films.
    assert found["capacitance_ratio"] == pytest.approx(1.43, abs=0.005)
    assert found["discharge_energy"] == pytest.approx(
        0.5 * (found["capacitance"] * 0.01 + 1e-9) * 64.0, rel=1e-12, abs=0.0
    )


@each("geometry", ["line", "point"])
def test_templates_show_a_discharge_that_can_be_taken(typed, tmp_path, geometry):
    path = tmp_path / f"{geometry}.toml"
    assert typed("init", path, "--geometry", geometry).returncode == 0
    before, start, after = path.read_text().partition("# [discharge]")
    table, stop, rest = after.partition("\n[grid]")
    assert start
    assert stop
    path.write_text(before + start[2:] + table.replace("\n# ", "\n") + stop + rest)
    given = Case.from_toml(path).discharge
    assert (given.dielectric_strength, given.pit.efficiency) == (15e6, 0.183)
    assert given.length == (None if geometry == "point" else 0.01)
