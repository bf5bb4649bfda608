"""Remedies of a drive whose source is measured: those that change a described source are not computed."""

import pytest

from ehlectric import DriveCase, InputError, load, save, solve_drive, write_report
from ehlectric.app.compute.drive_answers import quick_answer
from ehlectric.app.form_fields.drive_fields import HALF, is_applicable, remedies_of
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.pages.frame import DRIVE
from ehlectric.app.session import SURFACES
from ehlectric.runs.preview import preview_of
from tests.helpers.places import EXAMPLES

CODE = "remedy-not-applicable"


@pytest.fixture(scope="module")
def scope(tmp_path_factory):
    """Record of a square wave."""
    path = tmp_path_factory.mktemp("scope") / "scope.csv"
    volts = "\n".join(f"{2e-7 * k:.8e},{140 if k // 100 % 2 else -140}" for k in range(2000))
    path.write_text(f"time [s],voltage [V]\n{volts}\n", encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def drive(scope):
    """The drive of the example with the record as its source, and with all of its remedies."""
    table = DriveCase.from_toml(EXAMPLES / "drive.toml").to_dict()
    table["drive"] |= {"duration": 4e-4, "contacts": "formula"}
    return DriveCase.from_dict({**table, "source": {"file": str(scope)}})


def notes(warnings):
    return [str(warning) for warning in warnings if warning.code == CODE]


def test_remedies_that_apply_keep_their_numbers_in_the_file(drive):
    described, *rest = drive.remedies[::-1]
    turned = drive.replace({"remedies": [remedy.model_dump() for remedy in (described, *rest)]})
    assert [number for number, _ in turned.numbered_remedies] == [2, 3]
    assert len(turned.variants()) == 2
    wrong = {"title": "wrong", "changes": {"circuit.grounding_ring_resistance": "-1 ohm"}}
    with pytest.raises(InputError, match=r"^remedies\.2\.changes"):
        drive.replace({"remedies": [described.model_dump(), wrong]}).variants()


def test_a_remedy_with_another_record_applies(drive, scope):
    other = {"title": "other record", "changes": {"source.file": str(scope), "source.scale": 0.5}}
    (variant,) = drive.replace({"remedies": [other]}).variants()
    assert variant.source.scale == 0.5


@pytest.mark.slow
def test_a_drive_with_a_record_is_solved_stored_and_reported(drive, tmp_path):
    assert len(notes(preview_of(drive).warnings)) == 1
    result = solve_drive(drive, workers=1)
    titles = ["Grounding ring", "Ceramic balls"]
    assert [title for title, *_ in result.remedies] == titles
    assert [remedy["title"] for remedy in result.summary()["remedies"]] == titles
    (note,) = notes(result.warnings)
    assert "Half the switching frequency" in note
    assert "source.switching_frequency" in note
    save(result, tmp_path / "out")
    again = load(tmp_path / "out")
    assert [title for title, *_ in again.remedies] == titles
    write_report(tmp_path / "out", tmp_path / "report.html")
    assert "Half the switching frequency" in (tmp_path / "report.html").read_text("utf-8")


@pytest.mark.slow
def test_the_page_answers_as_soon_as_the_record_is_given(scope, tmp_path):
    (tmp_path / SURFACES).mkdir()
    (tmp_path / SURFACES / scope.name).write_bytes(scope.read_bytes())
    taken = changed(DRIVE, {"source.file": f"{SURFACES}/{scope.name}"})
    frequency = {"source.switching_frequency": "5 kHz"}
    assert remedies_of(taken)[HALF] == frequency
    assert not is_applicable(taken, frequency)
    assert CODE in [warning.code for warning in quick_answer(taken.table, tmp_path).warnings]
    assert changed(taken, {"source.file": None}).value("source.file") is None
