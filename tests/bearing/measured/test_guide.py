"""Script and numbers of the guide to measurements."""

import pytest
from docs import pages

import ehlectric
from tests.bearing.measured.synthetic_capacitance import FILE
from tests.helpers.places import ROOT


@pytest.mark.slow
def test_the_script_of_the_guide_gives_its_numbers(tmp_path, monkeypatch, capsys):
    page = pages.page("measured.md")
    (script,) = pages.blocks(page, "python")
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(script, names)
    mean = names["found"].mean
    assert capsys.readouterr().out == f"{round(mean.value, 2)} 8\n"
    assert f"mean film factor | {mean.value:.3f} for this example" in page
    assert f"95 % interval | {mean.low:.3f} to {mean.high:.3f}:" in page
    assert isinstance(names["found"], ehlectric.FilmFactors)
    head = pages.blocks(page, "text")[0]
    assert head in FILE.read_text(encoding="utf-8")
