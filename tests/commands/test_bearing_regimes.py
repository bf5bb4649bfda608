"""The example of a bearing with a thin oil: its regimes, and the map of a sweep over them."""

import csv
import json

import pytest

from tests.helpers.places import EXAMPLES

SWEEP = f"""
case = "{EXAMPLES / "bearing_thin_oil.toml"}"
design = "grid"

[vary]
"bearing.inner_speed" = ["200 rpm", "1500 rpm", "12000 rpm"]
"bearing.temperature" = ["60 degC", "110 degC"]
"""


@pytest.mark.slow
def test_the_example_conducts_at_times(ehlectric, tmp_path):
    done = ehlectric("bearing", str(EXAMPLES / "bearing_thin_oil.toml"), "--no-plots", "-o", "out")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    totals, speed = summary["bearing"], summary["margin"]["capacitive_speed"]
    assert totals["electrical_behaviour"] == "intermittent"
    assert 0.01 < totals["contact_time_share"] < 0.03
    assert summary["inputs"]["bearing"]["inner_speed"] < speed
    printed = " ".join(done.stdout.split())
    assert (
        f"electrical behaviour intermittent, contacts short it {100 * totals['contact_time_share']:.3g} %"
        in printed
    )
    assert "by Clarke's fit over lambda" in printed


@pytest.mark.slow
def test_map_of_the_regimes(ehlectric, tmp_path):
    (tmp_path / "sweep.toml").write_text(SWEEP)
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "-q").returncode == 0
    keys = ("--x", "bearing.inner_speed", "--y", "bearing.temperature")
    done = ehlectric("map", "out", *keys, "--value", "bearing.contact_time_share")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "map_bearing.contact_time_share.png").is_file()
    with (tmp_path / "out" / "sweep.csv").open() as file:
        rows = list(csv.DictReader(file))
    regimes = {row["bearing.electrical_behaviour"] for row in rows}
    assert regimes == {"capacitive", "intermittent"}
