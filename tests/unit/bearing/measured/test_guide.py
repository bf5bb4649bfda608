"""Script and numbers of the guide to measurements."""

import re

import pytest

import ehlectric
from tests.helpers.places import ROOT
from tests.reference.synthetic_capacitance import FILE

GUIDE = ROOT / "docs" / "guide" / "measured.md"


@pytest.mark.slow
def test_the_script_of_the_guide_gives_its_numbers(tmp_path, monkeypatch, capsys):
    page = GUIDE.read_text(encoding="utf-8")
    (script,) = re.findall(r"^```python\n(.*?)^```", page, flags=re.S | re.M)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(script, names)
    mean = names["found"].mean
    assert capsys.readouterr().out == f"{round(mean.value, 2)} 8\n"
    assert f"mean film factor | {mean.value:.3f} for this example" in page
    assert f"95 % interval | {mean.low:.3f} to {mean.high:.3f}:" in page
    assert isinstance(names["found"], ehlectric.FilmFactors)
    head = re.findall(r"^```text\n(.*?)^```", page, flags=re.S | re.M)[0]
    assert head in FILE.read_text(encoding="utf-8")
