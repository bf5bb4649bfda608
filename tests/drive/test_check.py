"""Drives are checked without being simulated."""

import pytest

from ehlectric import DriveCase, InputError, solve_drive
from ehlectric.drive.solver import solve
from ehlectric.drive.summary import drive_summary
from ehlectric.quantities.inputs import ENDS
from ehlectric.runs.preview import preview_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES


@pytest.fixture(scope="module")
def drive():
    """The example, for a time in which hardly anything happens."""
    return DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"drive.duration": "1 ms"})


@pytest.mark.slow
def test_numbers_before_the_simulation_are_those_of_the_simulation(drive):
    meaning, solved = preview_of(drive), drive_summary(solve(drive))
    for end in ENDS:
        told = meaning.summary[end]
        for key in ("capacitance", "conductance", "breakdown_voltage", "renewal_time", "voltage_ratio"):
            assert told[key] == solved[end][key]
        assert told["voltage_at_peak"] == pytest.approx(280.0 * solved[end]["voltage_ratio"])
    # The span of the source is that of the simulated time: of the two zero states, the whole DC link.
    assert solved["source"].pop("peak_to_peak") == pytest.approx(560.0)
    assert meaning.summary["source"] == solved["source"]
    names = [row.name for row in meaning.rows]
    assert names.count("breakdown voltage, weakest position") == 2


@pytest.mark.slow
@pytest.mark.gate
def test_a_source_that_follows_the_speed_is_the_same_source(drive):
    """At the speed at which the frequency and the index are those of the example."""
    quick = drive.replace({"drive.contacts": "formula", "remedies": []})
    follows = quick.replace(
        {"source.pole_pairs": 4, "source.base_frequency": "250 Hz", "source.modulation_index": 1.125}
    )
    own = {
        f"source.{key}": getattr(follows.running_source, key)
        for key in ("fundamental_frequency", "modulation_index")
    }
    assert list(own.values()) == pytest.approx([200.0, 0.9], rel=1e-12)
    given = quick.replace(own)
    assert drive_summary(solve(follows)) == drive_summary(solve(given))


def test_contacts_that_would_be_solved_are_from_the_atlas(drive):
    assert preview_of(drive.replace({"drive.contacts": "solved"})).summary["drive_end"]["films"] == "atlas"


def test_what_the_simulation_refuses_is_refused(drive):
    with pytest.raises(InputError, match=r"^breakdown\.extinction_voltage: .* 100 V"):
        preview_of(drive.replace({"breakdown.extinction_voltage": "100 V"}))


def test_a_strength_that_needs_the_field_is_told(drive):
    """Its films are solved by the simulation alone; with films of the atlas, both refuse the drive."""
    oil = drive.replace({"bearings.lubricant.viscosity_law": "constant"})
    (row,) = preview_of(oil.replace({"drive.contacts": "solved"})).rows
    assert "drive_end.lubricant.viscosity_law: " in row.note
    for look in (preview_of, solve_drive):
        with pytest.raises(InputError) as error:
            look(oil)
        assert error.value.key == "drive_end.lubricant.viscosity_law"


@each("look", [preview_of, solve_drive])
@each(
    "changes, message",
    [
        ({"circuit.grounding_rng": 1.0}, r"^remedies\.2\.changes\.circuit\.grounding_rng: "),
        ({"source.rise_time": "-1 ns"}, r"^remedies\.2\.changes\.source\.rise_time: .*'-1 ns'"),
    ],
)
def test_a_wrong_remedy_is_refused_before_anything_is_solved(drive, look, changes, message, monkeypatch):
    monkeypatch.setattr("ehlectric.drive.solver.solve", lambda *_, **__: pytest.fail("was solved"))
    fine, *_ = drive.remedies
    remedies = [{"title": fine.title, "changes": fine.changes}, {"title": "wrong", "changes": changes}]
    with pytest.raises(InputError, match=message):
        look(drive.replace({"remedies": remedies}))


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("conductivity", "told"), [("1 pS/m", False), ("1 uS/m", True), ("1 mS/m", False)])
def test_an_oil_slower_than_the_edges_is_noted(drive, conductivity, told):
    """2.4 eps0 over 1 uS/m is 21 us: a fifth of a period of 100 us, and 200 edges of 100 ns."""
    conducting = drive.replace({"bearings.discharge.conductivity": conductivity, "drive.contacts": "formula"})
    texts = [one.text for one in preview_of(conducting).warnings if one.code == "edges-faster-than-oil"]
    assert bool(texts) is told
    assert all("21" in text and "100 ns" in text for text in texts)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"drive.temperature": "320 degC"}, "drive.temperature"),
        ({"drive.temperature": None, "non_drive_end.bearing.temperature": "320 degC"}, None),
        ({"drive_end.bearing.radial_load": "5 MN"}, "drive_end.bearing"),
    ],
)
def test_a_bearing_that_is_refused_names_its_end_before_and_in_the_simulation(drive, changes, key):
    """The laws of FVA 3 do not hold at 320 degC; no bearing of the example carries 5 MN."""
    table = drive.replace({"drive.contacts": "formula", "remedies": []}).to_dict()
    for end in ENDS:
        table[end]["lubricant"] = {"base": "fva-3"}
    case = DriveCase.from_dict(table).replace(changes)
    keys = []
    for way in (preview_of, solve_drive):
        with pytest.raises(InputError) as error:
            way(case)
        keys.append(error.value.key)
    assert keys == 2 * [key or "non_drive_end.bearing.temperature"]
