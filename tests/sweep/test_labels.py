"""Labels of inputs and results: every key that a summary has is in a table with its unit."""

import csv
import re
from pathlib import Path

import pytest

from ehlectric import Case, solve
from ehlectric.bearing.result import solve_bearing
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import read_motion
from ehlectric.motion.summary import summary_of
from ehlectric.quantities.formats import scale_for
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import CONTACT_KEYS
from ehlectric.quantities.units import to_si
from ehlectric.sweep.axis_labels import label_of, result_keys
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.points import flat
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.drives import small_drive
from tests.helpers.each import each
from tests.helpers.hot_cases import HOT_LINE, HOT_POINT
from tests.helpers.moving_cases import TABLES, moving

ROUGH = {"surface": 1, "generator": "gaussian", "rq": "5 nm", "correlation_length": "40 um", "seed": 1}
EVERYTHING = {
    "dielectric_strength": "15 V/um", "conductivity": "1 pS/m", "external_capacitance": "1 nF",
    "peak_current": "1 A", "pit": {"efficiency": 0.2, "melting_energy": "10 GJ/m^3"},
}  # fmt: skip
LENGTHS = {"line": {"length": "10 mm"}, "point": {}}
METER = {"fill": "oil", "coating": {"thickness": "1 um", "relative_permittivity": 9}}
KINDS = ["line", "point", "balls", "rollers", "drive", "moving line", "moving point"]
# Keys within the table film of a summary of heat and shear; both kinds of contact have the same ones.
FILM = [key for key in CONTACT_KEYS["line"] if key.startswith("film.")]
HEAT = {*FILM[FILM.index("film.rheology") :]}
UNITS = Path(__file__).parent / "units.csv"


def contact(kind):
    """A small rough contact with a discharge and a meter."""
    tables = {name: table for name, table in TABLES[kind].items() if name != "motion"}
    discharge = EVERYTHING | LENGTHS[kind]
    return Case.from_dict(tables | {"roughness": [ROUGH], "discharge": discharge, "meter": METER})


def starved(kind):
    """A small smooth contact with a layer of oil, which takes no meter."""
    tables = {name: table for name, table in TABLES[kind].items() if name not in ("motion", "roughness")}
    return Case.from_dict(tables | {"inlet": {"oil_layer": "50 nm"}})


def hot(kind):
    """A small moving contact with heat."""
    table = HOT_LINE if kind == "moving line" else HOT_POINT
    own = {name: table[name] for name in ("contact", "lubricant")} | {"film": {"thermal": True}}
    return moving(TABLES[kind.removeprefix("moving ")], {"motion.steps": 8}, **own)


def case_of(kind):
    if kind in TABLES:
        return contact(kind)
    if kind in ("balls", "rollers"):
        return bearing_case(BALLS if kind == "balls" else ROLLERS, contacts="formula")
    if kind == "drive":
        return small_drive()
    few = {"motion.steps": 24, "discharge": {"dielectric_strength": "15 V/um"}}
    return moving(TABLES[kind.removeprefix("moving ")], few, inlet={"oil_layer": "200 nm"})


def summary(kind, folder):
    case = case_of(kind)
    if kind in TABLES:
        return solve(case).summary()
    if kind in ("balls", "rollers"):
        return solve_bearing(case).summary()
    if kind == "drive":
        return solve_point(case.to_dict()).summary
    run_motion(case, folder)
    return summary_of(read_motion(folder))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_key_of_a_summary_has_an_entry_and_every_entry_is_a_key(tmp_path, kind):
    """An entry without a number behind it says something about results that is not so.

    A list of the summary has an entry for the documentation. Statistics of a measured profile that is
    extended to a map, voltages of a Weibull law, heat, shear, remedies and duty cycles stand in other
    summaries.
    """
    keys, found = result_keys(case_of(kind)), flat(summary(kind, tmp_path))
    if kind in TABLES:
        found |= flat(solve(starved(kind)).summary())
    elif kind == "drive":
        with_ring = small_drive(**{"circuit.grounding_ring_resistance": "1 ohm"})
        found |= flat(solve_point(with_ring.to_dict()).summary)
    elif kind.startswith("moving"):
        run_motion(hot(kind), tmp_path / "hot")
        found |= flat(summary_of(read_motion(tmp_path / "hot")))
    # Statements of a verdict have values by the names in their texts, see test_verdict.py.
    summarised = [key for key in found if not key.startswith(("inputs.", "verdict_reasons."))]
    assert [key for key in summarised if key_of(keys, key) is None] == []
    parts = {".".join(part for part in key.split(".") if not part.isdigit()) for key in summarised}
    lists = {"discharge", "stationary", "beside_stationary", "contacts", "rough", "inputs", "margin.effects"}
    lists |= {"uncertainty.indices", "verdict_reasons"}
    lists |= {"drive_end.time_above", "non_drive_end.time_above"}
    lists |= {"roughness.surfaces", "roughness.surfaces.steps", "rough.steps", "discharge.sources"} | HEAT
    missing = {key for key in keys if "*" not in key} - parts - {*summarised} - lists
    elsewhere = re.compile(r"\.steps\.|^remedies\.|^duty\.|_end\.duty_|^duty$")
    assert {key for key in missing if not elsewhere.search(key)} == set()


def test_keys_of_heat_and_shear_are_those_of_a_summary():
    """A film with heat and one with shear alone have the same keys, those of an isothermal film null."""
    for film in ({"thermal": True}, {"rheology": "eyring"}):
        found = solve(Case.from_dict(HOT_LINE | {"film": film})).summary()
        keys = {key for key in flat(found) if key.startswith("film.") and key in HEAT}
        assert keys == HEAT
        assert (found["film"]["max_temperature_rise"] is None) == ("rheology" in film)


@each("kind", KINDS)
def test_units_are_those_of_si(kind):
    """Read by pint: a value of 1 in the unit of a key is 1 in SI units, kilograms and the like included."""
    units = {key.unit for key in result_keys(case_of(kind)).values()} - {"", "K"}
    assert {unit: to_si(f"1 {unit}", unit) for unit in units} == dict.fromkeys(units, 1.0)


@pytest.mark.slow
def test_units_are_those_of_the_list():
    """units.csv has the unit of every key of small contacts, bearings, drives and motions, read by hand."""
    with UNITS.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    known = {kind: case_of(kind) for kind in {row["kind"] for row in rows}}
    found = {(row["kind"], row["key"]): label_of(row["key"], known[row["kind"]]).unit for row in rows}
    assert found == {(row["kind"], row["key"]): row["unit"] for row in rows}


def test_lists_of_a_case_have_their_unit():
    case = case_of("line")
    assert label_of("inputs.discharge.strength_table.strength.1", case).unit == "V/m"
    assert label_of("inputs.grid.field_range.0", case).unit == ""


@each(
    ("value", "unit", "shown"),
    [
        (46e-6, "m**2/s", "46 mm²/s"),
        (870.0, "kg/m**3", "870 kg/m³"),
        (6.5e-4, "1/K", "0.00065 1/K"),
        (2.2e-8, "1/Pa", "22 1/GPa"),
    ],
)
def test_a_prefix_belongs_to_a_unit_that_can_have_one(value, unit, shown):
    """A micro before m²/s means (µm)²/s, and kg has a prefix already."""
    assert scale_for(value, unit).text(value) == shown
