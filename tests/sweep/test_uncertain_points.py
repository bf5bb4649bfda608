"""Probability of breakdown of the points of a sweep of bearings: that of each bearing alone."""

import numpy as np
import pytest
from typer.testing import CliRunner

from ehlectric import BearingCase, InputError, read_sweep, solve_bearing
from ehlectric.bearing import many_uncertainties
from ehlectric.bearing.uncertainty import SEED, spread_of_result, uncertainty_of_result
from ehlectric.commands.command_line import app
from ehlectric.sweep.batches import batches_of, solve_batch
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.point_groups import plan_together
from ehlectric.sweep.result import columns_of
from ehlectric.sweep.run import run_sweep
from ehlectric.sweep.slices import select_slice
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import ROLLERS, bearing_case
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

SPEED, TEMPERATURE = "bearing.inner_speed", "bearing.temperature"
VOLTAGE, PROBABILITY = "motor.common_mode_voltage", "uncertainty.breakdown_probability"
MOTOR = {
    "common_mode_voltage": "300 V",
    "winding_rotor_capacitance": "20 pF",
    "rotor_frame_capacitance": "1 nF",
}

# An oil that reaches the least viscosity of ASTM D341, 0.21 mm^2/s, near 290 degC.
THIN = {
    "lubricant.temperature.kinematic_viscosity_40": "12 mm^2/s",
    "lubricant.temperature.kinematic_viscosity_100": "1.6 mm^2/s",
}


def with_motor(**changes):
    """A 6208 with a margin near 1, whose oil follows the temperature."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    return case.replace({"contacts": "atlas", **changes})


def swept(vary, case=None, samples=32, **keys):
    case = with_motor() if case is None else case
    return Sweep.from_dict({"case": case, "vary": vary, "uncertainty_samples": samples} | keys)


def outcomes(sweep):
    """Outcomes of the points of the only batch of a sweep, with the tables of their cases."""
    points = [(point.key, point.inputs) for point in plan_together(sweep)]
    (batch,), others = batches_of(sweep, points)
    assert not others
    return [*zip(solve_batch(batch), (table for _, table in batch.tasks()), strict=True)]


def check_alone(outcome, table, samples=32):
    """Compare the probability of a point of a batch with that of its bearing alone."""
    found, solution = outcome.summary["uncertainty"], solve_bearing(BearingCase.from_dict(table)).solution
    alone = spread_of_result(solution, samples)
    if alone is None:
        assert found is None
        return
    assert (found["samples"], found["seed"]) == (samples, SEED)
    check_tables(found, alone.summary(), 1e-6)
    check_tables(solve_point(table, samples).summary["uncertainty"], alone.summary(), 1e-12)


def check_tables(one, other, rel):
    assert list(one) == list(other)
    for key, value in other.items():
        assert one[key] == (pytest.approx(value, rel=rel) if isinstance(value, float) else value), key


@pytest.mark.slow
def test_points_have_the_probability_of_their_bearing_alone():
    """From touching surfaces, which count as breakdown, to full films; ranges follow the temperature."""
    vary = {
        SPEED: {"from": "20 rpm", "to": "10000 rpm", "count": 3, "spacing": "log"},
        TEMPERATURE: ["40 degC", "110 degC"],
    }
    found = outcomes(swept(vary))
    for outcome, table in found:
        check_alone(outcome, table)
    known = [one.summary["uncertainty"] for one, _ in found]
    states = [one.summary["bearing"]["lubrication"] for one, _ in found]
    touching = [one for one, state in zip(known, states, strict=True) if state == "conducting"]
    assert touching
    assert all(one["breakdown_probability"] == 1.0 for one in touching)
    assert {one["breakdown_probability"] for one in known} > {0.0}


@pytest.mark.slow
def test_samples_are_those_of_the_bearing_with_shares_of_its_inputs():
    """Without the shares, which points do not have, nothing else differs."""
    solution = solve_bearing(with_motor()).solution
    whole = uncertainty_of_result(solution)
    spread = spread_of_result(solution, whole.samples)
    assert np.array_equal(whole.margins, spread.margins)
    shares = {"indices", "predicted"}
    assert spread.summary() == {k: v for k, v in whole.summary().items() if k not in shares}


@pytest.mark.slow
@pytest.mark.parametrize(
    "changes",
    [
        {"ranges": {"bearing.radial_load": ["1500 N", "2500 N"], TEMPERATURE: ["60 degC", "75 degC"]}},
        {"ranges": {TEMPERATURE: ["60 degC", "320 degC"]}, **THIN},
        {"contacts": "formula"},
        {"lubricant.temperature": {"iso_vg": 46, "viscosity_index": 100, "density_15": 870.0}},
    ],
)
def test_ranges_laws_and_ways_are_those_of_the_bearing_alone(changes):
    for outcome, table in outcomes(swept({SPEED: ["1500 rpm", "6000 rpm"]}, with_motor(**changes))):
        check_alone(outcome, table)


@pytest.mark.slow
def test_a_point_without_samples_says_why(monkeypatch):
    def refused(*_):
        raise InputError.worded(None, "no sample has a result")

    monkeypatch.setattr(many_uncertainties, "spread_at", refused)
    for outcome, _ in outcomes(swept({SPEED: ["1500 rpm", "6000 rpm"]})):
        assert outcome.status == "solved"
        assert outcome.summary["uncertainty"] is None
        assert outcome.summary["margin"]["left_out"] == ["probability of breakdown: no sample has a result"]


@pytest.mark.slow
def test_rollers_have_probabilities_too():
    case = bearing_case(ROLLERS, contacts="atlas").replace(
        {"motor": MOTOR, "discharge.dielectric_strength": 15e6}
    )
    for outcome, table in outcomes(swept({SPEED: ["1500 rpm", "6000 rpm"]}, case)):
        check_alone(outcome, table)


@pytest.mark.slow
def test_the_larger_load_changes_where_components_cross():
    """The load that is uncertain is the radial one below 1800 N of axial load, and the axial one above."""
    found = outcomes(swept({"bearing.axial_load": ["1 kN", "1.7 kN", "2.5 kN"]}, with_motor()))
    for outcome, table in found:
        check_alone(outcome, table)


@pytest.mark.slow
@pytest.mark.gate
def test_the_probability_rises_with_the_voltage():
    """The same samples at all points: their margins are in proportion to 1 / voltage."""
    voltages = [100.0, 200.0, 300.0, 400.0, 800.0]
    found = outcomes(swept({VOLTAGE: voltages}, samples=64))
    by_voltage = {table["motor"]["common_mode_voltage"]: one.summary["uncertainty"] for one, table in found}
    rows = [by_voltage[voltage] for voltage in voltages]
    probabilities = [row["breakdown_probability"] for row in rows]
    assert probabilities == sorted(probabilities)
    assert probabilities[0] < 0.05
    assert probabilities[-1] > 0.9
    scaled = [row["margin_median"] * voltage for row, voltage in zip(rows, voltages, strict=True)]
    assert scaled == pytest.approx([scaled[0]] * len(scaled), rel=1e-6)


@pytest.mark.slow
def test_a_sweep_has_columns_only_where_it_is_asked_for_them(tmp_path):
    """Points without the probability are others, so that none is taken for one with it."""
    vary = {SPEED: ["1500 rpm", "6000 rpm"]}
    plain = run_sweep(swept(vary, samples=None), tmp_path, workers=1)
    assert plain.uncertainty_samples == 0
    assert not [key for key in columns_of(plain) if key.startswith("uncertainty.")]
    asked = run_sweep(swept(vary), tmp_path, workers=1)
    assert asked.uncertainty_samples == 32
    assert asked == read_sweep(tmp_path)
    data = asked.to_xarray()
    assert data.attrs["uncertainty_samples"] == 32
    assert data[PROBABILITY].attrs["long_name"] == "probability of breakdown"
    assert set(data["uncertainty.seed"].values) == {SEED}
    assert np.all(data["uncertainty.breakdown_probability_error"] > 0.0)
    for key in ("bearing.margin", "bearing.capacitance"):
        assert np.array_equal(plain.values(key), asked.values(key))
    assert plain.verdict == asked.verdict
    again = run_sweep(swept(vary, samples=None), tmp_path, workers=1)
    assert again.numbers == plain.numbers


@pytest.mark.slow
@pytest.mark.gate
def test_a_sweep_of_an_earlier_version_has_no_samples(tmp_path):
    """Its database lacks the setting."""
    import sqlite3

    run_sweep(swept({SPEED: ["1500 rpm", "6000 rpm"]}, samples=None), tmp_path, workers=1)
    with sqlite3.connect(tmp_path / "sweep.sqlite") as file:
        file.execute("DELETE FROM sweep WHERE name = 'uncertainty_samples'")
    file.close()
    assert read_sweep(tmp_path).uncertainty_samples == 0


def test_batches_are_smaller_with_more_samples():
    """Their points are saved every few seconds, and cores share them."""
    vary = {SPEED: {"from": "1000 rpm", "to": "9000 rpm", "count": 100}}
    for samples, count in ((None, 1), (256, 4), (1024, 13)):
        sweep = swept(vary, samples=samples)
        points = [(point.key, point.inputs) for point in plan_together(sweep)]
        batches, _ = batches_of(sweep, points)
        assert len(batches) == count
        assert sorted(key for batch in batches for key in batch.keys) == sorted(key for key, _ in points)


@each(
    ("changes", "told"),
    [
        ({"motor": None}, "uncertainty_samples: needs a margin, and the bearing has no [motor]"),
        (
            {"discharge": {}},
            "uncertainty_samples: needs a margin, and the bearing has no dielectric strength in [discharge]",
        ),
    ],
)
def test_a_bearing_without_a_margin_is_refused(changes, told):
    table = with_motor().to_dict()
    table = {key: value for key, value in (table | changes).items() if value is not None}
    with pytest.raises(InputError) as error:
        swept({SPEED: [100.0, 200.0]}, BearingCase.from_dict(table))
    assert str(error.value) == told


@each(
    ("samples", "told"),
    [
        (100, "uncertainty_samples: got 100; expected a power of two, such as 256"),
        (16, "from 32 to 4096"),
        (8192, "from 32 to 4096"),
    ],
)
def test_wrong_numbers_of_samples_are_refused(samples, told):
    with pytest.raises(InputError) as error:
        swept({SPEED: [100.0, 200.0]}, samples=samples)
    assert told in str(error.value)


def test_contacts_have_no_probability():
    with pytest.raises(InputError, match=r"^uncertainty_samples: is only for the sweep of a bearing"):
        Sweep.from_dict(
            {
                "case": str(EXAMPLES / "discharge.toml"),
                "vary": {"contact.entrainment_speed": [1.0, 2.0]},
                "uncertainty_samples": 256,
            }
        )


@pytest.mark.slow
def test_a_wrong_key_names_the_nearest(tmp_path):
    found = run_sweep(swept({SPEED: ["1500 rpm", "6000 rpm"]}), tmp_path, workers=1)
    with pytest.raises(InputError, match=rf"nearest is {PROBABILITY}$"):
        select_slice(found, SPEED, None, "uncertainty.breakdown_probabilty")
    assert np.isfinite(select_slice(found, SPEED, None, PROBABILITY).values).all()


@pytest.mark.slow
def test_the_example_is_mapped_by_the_command(tmp_path):
    """With fewer points than the file has, for the time; the words are those of its head."""
    text = (EXAMPLES / "breakdown_probability_map.toml").read_text(encoding="utf-8")
    text = text.replace("count = 8", "count = 3").replace("count = 6", "count = 2")
    text = text.replace('"duty_wltc.toml"', f'"{(EXAMPLES / "duty_wltc.toml").as_posix()}"')
    (tmp_path / "sweep.toml").write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["sweep", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1"])
    assert done.exit_code == 0, done.output
    words = ["map", str(out), "--x", SPEED, "--y", TEMPERATURE, "--value", PROBABILITY]
    drawn = CliRunner().invoke(app, words)
    assert drawn.exit_code == 0, drawn.output
    assert {path.name for path in out.glob("*.png")} == {f"map_{PROBABILITY}.png", f"lines_{PROBABILITY}.png"}
    values = read_sweep(out).values(PROBABILITY).reshape(3, 2)
    known = values[:, 0]
    # A faster bearing has thicker films.
    assert np.all(np.diff(known[np.isfinite(known)]) < 0.0)


@pytest.mark.slow
def test_a_point_with_samples_without_a_result_has_the_warning_and_the_bounds():
    """Near 320 degC the oil is thinner than the least viscosity of ASTM D341: the point alone and the point
    of a batch warn.
    """
    case = with_motor(ranges={"bearing.temperature": ["60 degC", "320 degC"]}, **THIN)
    for outcome, table in outcomes(swept({SPEED: ["1500 rpm", "6000 rpm"]}, case)):
        found = outcome.summary["uncertainty"]
        part = found["failed"] / found["samples"]
        assert 0.0 < part < 1.0
        low, high = found["breakdown_probability_low"], found["breakdown_probability_high"]
        assert high - low == pytest.approx(part)
        assert "probability-bounded" in outcome.summary["warning_codes"]
        assert "probability-bounded" in solve_point(table, 32).summary["warning_codes"]
