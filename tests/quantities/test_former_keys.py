"""Former keys of summaries: the values of their successors, and a warning to whoever reads them."""

import copy
import json
import pickle
import warnings

import pytest

from ehlectric import solve
from ehlectric.quantities.former_keys import successors, warning_tables, with_successors
from ehlectric.quantities.results import BEARING_KEYS, CONTACT_KEYS, DRIVE_KEYS
from ehlectric.quantities.rows import value_at
from ehlectric.sweep import Sweep, evaluate, run_sweep
from ehlectric.sweep.slices import select_slice
from tests.helpers.bearings import BALLS, bearing_case

# Former keys whose words differ from those of their successors.
WORDS = {"bearing.lubrication", "contacts.regime", "asperities.behaviour"}


@pytest.fixture(scope="module")
def case():
    return bearing_case(BALLS, contacts="formula")


@pytest.fixture(scope="module")
def summary(case):
    return solve(case).summary()


def test_each_former_key_has_a_successor_that_is_in_use():
    for keys in (BEARING_KEYS, DRIVE_KEYS, CONTACT_KEYS["line"], CONTACT_KEYS["point"]):
        found = successors(keys)
        assert found
        for former, successor in found.items():
            assert not keys[successor].successor
            assert keys[former].unit == keys[successor].unit
            assert keys[former].meaning.startswith("deprecated; use ")


def test_a_bearing_has_both_keys_with_one_value(summary):
    plain = json.loads(json.dumps(summary))
    for former, successor in successors(BEARING_KEYS).items():
        if former.partition(".")[0] not in ("duty", "contacts"):
            table, _, name = former.rpartition(".")
            assert name in plain[table]
            if former not in WORDS:
                assert plain[table][name] == value_at(plain, successor)
    for row in plain["contacts"]:
        assert {"gap": "gap", "full film": "full film"}.get(row["lubrication_state"]) == row["regime"]


def test_a_reader_of_a_former_key_gets_its_value_and_a_warning(summary):
    table = summary["bearing"]
    for copied in (table, copy.deepcopy(table), pickle.loads(pickle.dumps(table))):
        with pytest.warns(DeprecationWarning, match=r"use bearing\.ring_to_ring_margin"):
            assert copied["through_margin"] == copied["ring_to_ring_margin"]
        with pytest.warns(DeprecationWarning, match=r"use bearing\.electrical_behaviour"):
            assert copied.get("regime") == copied["electrical_behaviour"]
    with pytest.warns(DeprecationWarning, match=r"use contacts\.lubrication_state"):
        assert summary["contacts"][0]["regime"]


def test_reading_everything_warns_of_nothing(summary):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert dict(summary["bearing"]) == summary["bearing"]
        assert json.loads(json.dumps(summary)) == summary
        assert list(summary["bearing"].items())


def test_a_stored_summary_of_an_earlier_version_gets_the_successors():
    stored = {"bearing": {"through_breakdown": 3.0, "margin": 1.0}, "drive_end": {}}
    found = with_successors(stored, BEARING_KEYS)
    assert found["bearing"] == {"ring_to_ring_breakdown": 3.0, "through_breakdown": 3.0, "margin": 1.0}
    assert stored == {"bearing": {"through_breakdown": 3.0, "margin": 1.0}, "drive_end": {}}


def test_remedies_of_a_drive_have_tables_that_warn():
    """A table in a list of tables."""
    end = {"touching_time_share": 0.5, "contact_time_share": 0.5}
    found = warning_tables({"drive_end": end, "remedies": [{"drive_end": end}]}, DRIVE_KEYS)
    for table in (found["drive_end"], found["remedies"][0]["drive_end"]):
        with pytest.warns(DeprecationWarning, match="contact_time_share"):
            assert table["touching_time_share"] == 0.5


def test_a_sweep_and_evaluate_have_both_keys(case, tmp_path):
    sweep = Sweep.from_dict(
        {"case": case.to_dict(), "vary": {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]}}
    )
    results = run_sweep(sweep, tmp_path / "sweep", workers=1)
    with pytest.warns(DeprecationWarning, match=r"use bearing\.ring_to_ring_breakdown"):
        former = results.values("bearing.through_breakdown")
    assert former.tolist() == results.values("bearing.ring_to_ring_breakdown").tolist()
    with pytest.warns(DeprecationWarning, match=r"use bearing\.ring_to_ring_breakdown"):
        selection = select_slice(results, "bearing.inner_speed", None, "bearing.through_breakdown")
    assert selection.value == "bearing.ring_to_ring_breakdown"
    points = evaluate(case, {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]})
    assert (
        points["bearing.through_margin"].values.tolist()
        == points["bearing.ring_to_ring_margin"].values.tolist()
    )
    assert points["bearing.through_margin"].attrs["deprecated"] == "use bearing.ring_to_ring_margin"
