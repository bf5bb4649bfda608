"""The commands oils and oil, as a user types them."""

import csv
import json
import math

import pytest

OWN = """\
title = "My drive"
[bearing]
temperature = "70 degC"
[lubricant]
base = "n100"
"""


def row(text, start):
    """Words of the first line that starts with a text, without this text."""
    return next(line for line in text.splitlines() if line.startswith(start))[len(start) :].split()


@pytest.mark.slow
@pytest.mark.gate
def test_oils_are_listed_with_kinds_and_needs(ehlectric):
    done = ehlectric("oils")
    assert done.returncode == 0, done.stderr
    assert "…" not in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80
    # FVA 3: 84.5 and 9.86 mPa s and 21.6 1/GPa, fitted; density read off a diagram.
    words = row(done.stdout, "fva-3 ")
    assert words == ["20", "to", "110", "84.54", "f", "9.861", "f", "21.61", "f", "863", "r", "2.07", "a"]
    # No value above 80 degC of one oil, no permittivity of another.
    assert row(done.stdout, "mobil-shc-320 ")[4:6] == ["p", "-"]
    assert row(done.stdout, "n100 ")[-1] == "-"
    assert "f fitted" in done.stdout
    listed = {oil["name"]: oil for oil in json.loads(ehlectric("oils", "--json").stdout)}
    assert len(listed) == 11
    assert listed["n100"]["needs"] == ["relative_permittivity"]
    assert listed["n100"]["relative_permittivity_40"] is None
    assert listed["fva-3"]["viscosity_40"] == {
        "value": pytest.approx(0.08454, rel=1e-4),
        "unit": "Pa*s",
        "kind": "fitted",
    }
    assert listed["fva-3"]["weakest"] == "assumed"
    assert listed["paper"]["viscosity_100"] is None


@pytest.mark.slow
@pytest.mark.gate
def test_an_oil_at_a_temperature_and_a_pressure(ehlectric):
    """By hand, with the modulus equation of table A1 in degC and bar, and 1 GPa as 10000 bar."""
    done = ehlectric("oil", "fva-3", "--temperature", "40 degC", "--pressure", "1 GPa")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("fva-3: FVA 3, reference mineral oil")
    assert "20 °C to 110 °C" in done.stdout
    assert row(done.stdout, "viscosity [mPa s]") == ["84.54"]
    exponent = 1e4 / (327.7918 + 2.9862 * 40.0 + (4.419e-3 + 3.0115e-4 * 40.0) * 1e4)
    viscosity, unit = row(done.stdout, "  at 1 GPa [Pa s]")
    assert unit == "million"
    assert 1e6 * float(viscosity) == pytest.approx(0.08454 * math.exp(exponent), rel=1e-3)
    # 863 (0.59 + 1.34)/(0.59 + 1), and Clausius-Mossotti of 2.07 over it.
    assert row(done.stdout, "  at 1 GPa [kg/m³]") == ["1048"]
    assert row(done.stdout, "relative permittivity ") == ["2.07"]
    assert row(done.stdout, "  at 1 GPa     ") == ["2.406"]
    assert row(done.stdout, "conductivity [S/m]") == ["missing"]
    assert "doi:10.3390/lubricants11090369" in done.stdout.replace("\n", "")
    assert "read off a diagram" in done.stdout


@pytest.mark.slow
def test_a_value_beyond_a_cap_has_a_star_and_a_warning(ehlectric):
    done = ehlectric("oil", "n100", "--temperature", "40 degC", "--pressure", "2 GPa")
    assert done.returncode == 0, done.stderr
    (viscosity,) = row(done.stdout, "  at 2 GPa [Pa s]")
    assert viscosity.endswith("*")
    assert "* beyond the range of the law" in done.stdout
    assert "warning: at 40 °C, the pressure is above 1.25 GPa, where viscosity_law 'modulus'" in done.stderr
    assert row(done.stdout, "relative permittivity ") == ["missing"]
    assert "lubricant.relative_permittivity: missing; permittivity_law 'clausius-mossotti'" in done.stdout


@pytest.mark.slow
def test_an_oil_is_written_as_table_and_figures(ehlectric, tmp_path):
    typed = ("oil", "n100", "--pressure", "0.5 GPa", "-o", "out", "--format", "svg")
    done = ehlectric(*typed)
    assert done.returncode == 0, done.stderr
    files = ["oil.csv", "oil_over_pressure.svg", "oil_over_temperature.svg"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == files
    with (tmp_path / "out" / "oil.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    (found,) = (
        row for row in rows
        if (row["property"], row["temperature [K]"], row["pressure [Pa]"]) == ("viscosity", "313.15", "0.0")
    )  # fmt: skip
    assert float(found["value"]) == pytest.approx(0.0867, rel=1e-3)
    assert (found["law"], found["unit"], found["beyond_range"]) == ("ASTM D341", "Pa*s", "False")
    assert "doi:10.1177/1350650118778655" in found["sources"]
    assert {row["value"] for row in rows if row["property"] == "relative_permittivity"} == {"missing"}
    quiet = ehlectric("oil", "n100", "-o", "table", "--no-plots", "-q")
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", "")
    assert [path.name for path in (tmp_path / "table").iterdir()] == ["oil.csv"]


@pytest.mark.slow
def test_the_oil_of_a_file_is_shown_at_its_temperature(ehlectric, tmp_path):
    (tmp_path / "drive.toml").write_text(OWN + "relative_permittivity = 2.2\n")
    summary = json.loads(ehlectric("oil", "drive.toml", "--json").stdout)
    assert (summary["name"], summary["title"]) == ("drive.toml", "My drive")
    assert summary["temperatures"] == [pytest.approx(343.15)]
    (entry,) = (one for one in summary["properties"] if one["name"] == "relative_permittivity")
    assert (entry["values"], entry["kind"]) == ([2.2], "given")
    assert summary["missing"] == summary["needs"] == []
    # Without its permittivity the rest is shown all the same.
    (tmp_path / "drive.toml").write_text(OWN)
    lacking = json.loads(ehlectric("oil", "drive.toml", "--json").stdout)
    assert lacking["needs"] == ["relative_permittivity"]
    assert lacking["properties"][0]["values"][0] > 0.0
