"""The page "Bring your measurement": its commands run on the files of the examples, and give its numbers."""

import json
import re
import shlex

import pytest

from ehlectric.axle.axle_duty import check_axle_duty
from ehlectric.bearing.duty_cycle import check_duty
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.duty_inputs import read_cycle
from ehlectric.drive.waveform.waveform_file import read_waveform
from tests.axle.axles import two_stages
from tests.helpers.places import EXAMPLES, ROOT

PAGE = (ROOT / "docs" / "howto" / "bring_measurement.md").read_text(encoding="utf-8")
COMMANDS = [shlex.split(block) for block in re.findall(r"```sh\nehlectric (.*)\n```", PAGE)]
SNIPPETS = re.findall(r"```toml\n(.*?)```", PAGE, flags=re.DOTALL)


def test_the_page_contains_each_kind():
    names = ["examples", "calibrate", "surface", "bearing", "run", "check", "calibrate"]
    assert [words[0] for words in COMMANDS] == names
    tables = [snippet.split("\n", 1)[0] for snippet in SNIPPETS]
    assert tables == ["[source]", "[measured.shaft_record]", "[[roughness]]", "[lubricant]", "[duty]"]


@pytest.mark.slow
@pytest.mark.gate
def test_the_commands_of_the_page(typed, tmp_path, monkeypatch):
    assert typed(*COMMANDS[0]).returncode == 0
    monkeypatch.chdir(tmp_path / "bring")
    # The command with a record of the shaft voltage simulates drives; test_calibrate_command.py runs it.
    for words in COMMANDS[2:]:
        done = typed(*words, *(["--no-plots"] if words[0] in ("bearing", "run") else []))
        assert done.returncode == 0, done.stderr
    for folder, low, true, high in (("meter", 0.684, 0.7, 0.711), ("film", 0.886, 0.9, 0.905)):
        mean = json.loads((tmp_path / "bring" / folder / "measured.json").read_text("utf-8"))["film_factor"]
        assert mean["low"] == pytest.approx(low, abs=6e-4)
        assert mean["high"] == pytest.approx(high, abs=6e-4)
        assert mean["low"] < true < mean["high"]
        assert f"{mean['mean']:.3f}" in PAGE
    assert (tmp_path / "bring" / "calibrated" / "calibration.png").is_file()


def snippet_of(table):
    return next(snippet for snippet in SNIPPETS if snippet.startswith(f"[{table}]"))


def test_the_record_of_an_oscilloscope(tmp_path):
    """The record has steps of 12.5 us between -280, -93.3, 93.3 and 280 V."""
    text = (EXAMPLES / "drive.toml").read_text(encoding="utf-8")
    start, end = text.index("[source]"), text.index("[circuit]")
    text = text[:start] + snippet_of("source") + text[end:]
    text = text.replace('"bearing_6208.toml"', f'"{EXAMPLES / "bearing_6208.toml"}"')
    text = text.replace("measurements/", f"{EXAMPLES}/measurements/")
    (tmp_path / "drive.toml").write_text(text, encoding="utf-8")
    case = DriveCase.from_toml(tmp_path / "drive.toml")
    waveform, _ = read_waveform(case.source.file)
    assert sorted(set(waveform.values.round(1).tolist())) == [-280.0, -93.3, 93.3, 280.0]


def test_the_driving_cycle(tmp_path):
    """The low part of the cycle has at most 56.5 km/h; wheels of 317 mm, ratio 9."""
    text = (EXAMPLES / "duty_wltc.toml").read_text(encoding="utf-8")
    file = f'"{EXAMPLES}/measurements/wltc_low_km_h.csv"'
    snippet = snippet_of("duty").replace('"measurements/wltc_low_km_h.csv"', file)
    text = re.sub(r"\[duty\].*?\n\n", f"{snippet}\n", text, flags=re.DOTALL)
    (tmp_path / "duty.toml").write_text(text, encoding="utf-8")
    case = BearingCase.from_toml(tmp_path / "duty.toml")
    check_duty(case)
    assert read_cycle(case.duty).values["speed"].max() == pytest.approx(56.5 / 3.6 / 0.317 * 9.0)
    duty = {"file": case.duty.file, "vehicle": {"wheel_radius": "317 mm"}}
    check_axle_duty(two_stages(remedies=[], duty=duty))
