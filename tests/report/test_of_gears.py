"""Report of a gear pair: its parts, and what they are taken from."""

from pathlib import Path

import pytest

from ehlectric import InputError, save, solve_gear, write_report
from ehlectric.report.build import report_of
from ehlectric.report.report_content import Light, Numbers, Picture, Table
from tests.helpers.gears import helical_case, spur_case


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gear")
    save(solve_gear(spur_case()), folder)
    return folder


@pytest.fixture(scope="module")
def report(folder):
    return report_of(folder)


def tables(report):
    return {block.caption: block for block in report.blocks() if isinstance(block, Table)}


def rows_of(table):
    return {getattr(row[0], "text", row[0]): row[1:] for row in table.rows}


def test_the_first_page_has_verdict_numbers_and_the_map(report):
    assert (report.title, report.kind) == ("FZG type C", "spur gear pair 16/24, films from the atlas")
    first = report.sections[0].blocks
    (light,) = (block for block in first if isinstance(block, Light))
    assert light.level == "red"
    (numbers,) = (block for block in first if isinstance(block, Numbers))
    known = {label: value.replace("\xa0", " ") for label, value, _ in numbers.numbers}
    assert known["Margin"] == "0.37"
    assert known["Breakdown voltage of the mesh"] == "1.12 V"
    (picture,) = (block for block in first if isinstance(block, Picture))
    assert picture.name == "gear_flank"


def test_all_figures_are_drawn_once(report):
    names = [block.name for block in report.blocks() if isinstance(block, Picture)]
    assert sorted(names) == ["gear_film", "gear_flank", "gear_mesh", "gear_path"]
    assert all(block.caption for block in report.blocks() if isinstance(block, Picture))


def test_the_table_of_points_has_the_published_radii(report):
    """At C, FZG type C has g_C = d_w1/2 sin alpha_wt = 36.6 mm sin 22.44 deg."""
    table = tables(report)["Points of the path of contact"]
    assert table.heads[1:6] == tuple("ABCDE")
    assert rows_of(table)["radius of curvature, gear 1"][2] == "13.97"
    assert rows_of(table)["slide-to-roll ratio"][2] == "0"


def test_inputs_have_usual_units(report):
    inputs = rows_of(tables(report)["Inputs: gear"])
    text = {name: cells[0].replace("\xa0", " ") for name, cells in inputs.items()}
    assert text["normal pressure angle"] == "20 deg"
    assert text["tip diameters"] == "82.46, 118.36 mm"
    assert text["roughness Ra of the flanks"] == "20 nm"
    assert text["temperature of the flanks"] == "90 °C"
    assert text["speed of gear 1"] == "2250 rpm"
    assert inputs["application factor"][1] == "default"


def test_limits_and_sources_are_those_of_gears(report):
    limits = [topic for topic, _ in tables(report)["Limits of the model"].rows]
    assert "load of the flanks" in limits
    assert "mechanics of the bearing" not in limits
    assert "temperature of the flanks" not in limits
    cited = rows_of(tables(report)["Literature behind the equations"])
    assert cited["geometry of gears"][0].startswith("ISO 21771-1")
    assert "steel" in rows_of(tables(report)["Sources of the materials"])


def test_an_estimated_temperature_is_a_limit(tmp_path):
    changes = {"gear.operation.bulk_temperature": "iso", "gear.operation.friction_coefficient": 0.05}
    save(solve_gear(helical_case(**changes), probable=False), tmp_path)
    report = report_of(tmp_path)
    limits = [topic for topic, _ in tables(report)["Limits of the model"].rows]
    assert "temperature of the flanks" in limits


@pytest.mark.slow
def test_files_are_written(folder, tmp_path):
    files = write_report(folder, tmp_path / "report.html", tmp_path / "report.pdf")
    html = files[0].read_text(encoding="utf-8")
    assert "Does the film between these gears insulate" in html
    assert files[1].read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize("target", ["/proc/report.html", "/proc/report.pdf"])
@pytest.mark.skipif(not Path("/proc/self").exists(), reason="a folder into which nobody may write")
def test_a_folder_that_cannot_be_written_to_is_refused_before_the_report_is_made(folder, monkeypatch, target):
    monkeypatch.setattr("ehlectric.report.build.report_of", None)
    with pytest.raises(InputError, match=r"^/proc: cannot be written to"):
        write_report(folder, target)
