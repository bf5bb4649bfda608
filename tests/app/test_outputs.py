"""Downloads: the command gives the same numbers for the downloaded case, and every file has its numbers."""

import csv
import io
import json
import tomllib
import zipfile

import h5py
import numpy as np
import openpyxl
import pytest
from scipy.io import loadmat

from ehlectric.quantities.formats import amount
from tests.app.driving import type_into, wait_for_number
from tests.app.outputs import address_of, command, downloaded
from tests.app.test_contact_page import example, solve, upload, wait_until_solved
from tests.app.test_first_page import LOAD, capacitance
from tests.helpers.places import DEKTAK

pytestmark = pytest.mark.browser

# Options with which the command solves what each page shows.
_OPTIONS = {"bearing": ("bearing", "--contacts", "atlas"), "contact": ("run",)}

# Keys of a summary that differ between two runs of one case.
_OWN = ("computing_time", "solution_time", "seconds", "created", "date", "elapsed")


def open_changed(open_page, app_server, kind):
    """Page of a bearing or a contact with an input that is not that of its start."""
    if kind == "bearing":
        page = open_page(app_server)
        wait_for_number(page, "bearing.capacitance", capacitance())
        type_into(page, LOAD, "1234.5 N")
        wait_for_number(page, "bearing.capacitance", capacitance("1234.5 N"), digits=4)
        return page
    page = open_page(app_server, address_of("/contact", example("discharge", grid__nodes=801)))
    wait_until_solved(page)
    return page


def numbers_of(text):
    """Summary without the times of its run."""
    return _without_times(json.loads(text))


def _without_times(value):
    if isinstance(value, dict):
        return {key: _without_times(item) for key, item in value.items() if not key.endswith(_OWN)}
    return [_without_times(item) for item in value] if isinstance(value, list) else value


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["bearing", "contact"])
def test_every_output_has_the_numbers_of_the_command(open_page, app_server, tmp_path, kind):
    page = open_changed(open_page, app_server, kind)
    case = downloaded(page, "download-toml", tmp_path)
    name, *options = _OPTIONS[kind]
    command(name, case, *options, "-o", "by_command", "--quiet", folder=tmp_path)
    own = tmp_path / "by_command"
    expected = numbers_of((own / "summary.json").read_text("utf-8"))

    summary = downloaded(page, "download-summary", tmp_path)
    assert numbers_of(summary.read_text("utf-8")) == expected
    page_tables = files_of(downloaded(page, "download-csv", tmp_path), "csv")
    assert page_tables
    for title, content in page_tables.items():
        assert rows_of(content) == rows_of((own / title).read_bytes()), title
    assert_same_netcdf(files_of(downloaded(page, "download-netcdf", tmp_path), "nc"), own)
    assert_exports(page, tmp_path, own, kind)
    figures = files_of(downloaded(page, "download-figures", tmp_path), "")
    drawn = {path.stem for path in own.glob("*.png")}
    assert {
        title.rpartition(".")[0].rpartition("/")[2] for title in figures if title.endswith(".svg")
    } == drawn
    assert all(content[:4] == b"\x89PNG" for title, content in figures.items() if title.endswith(".png"))

    everything = files_of(downloaded(page, "download-all", tmp_path), "")
    names = {title.rpartition("/")[2] for title in everything}
    assert {path.name for path in own.iterdir() if path.is_file()} <= names
    (toml,) = (content for title, content in everything.items() if title.endswith(".toml"))
    assert tomllib.loads(toml.decode()) == tomllib.loads(case.read_text("utf-8"))
    assert_reports(page, tmp_path, kind, expected)


def assert_exports(page, folder, own, kind):
    """Files for other programs have the values that the command exports; ParaView takes contacts alone."""
    assert page.get_by_test_id("download-vtkhdf").count() == (kind == "contact")
    for ending, values in _EXPORTED.items():
        if ending == "vtkhdf" and kind != "contact":
            continue
        theirs = folder / f"by_command.{ending}"
        command("export", own, "-o", theirs, "--quiet", folder=folder)
        assert values(downloaded(page, f"download-{ending}", folder)) == values(theirs) != {}


def _arrays(path):
    """Arrays of a .mat file by name, without its summary, which has computing times."""
    return {
        name: array.tobytes()
        for name, array in loadmat(path).items()
        if isinstance(array, np.ndarray) and array.dtype.kind in "fiu"
    }


def _rows(path):
    table = openpyxl.load_workbook(path)["table"]
    return dict(enumerate(table.values))


def _points(path):
    found = {}
    with h5py.File(path) as file:
        for name in ("film", "field"):
            found[name] = file[f"VTKHDF/{name}/Points"][:].tobytes()
    return found


_EXPORTED = {"mat": _arrays, "xlsx": _rows, "vtkhdf": _points}


def assert_reports(page, folder, kind, summary):
    """The report has the main number of the command, its version, its warnings, and asks no other host."""
    html = downloaded(page, "download-report-html", folder).read_text("utf-8")
    main = (
        amount(summary["bearing"]["capacitance"], "F")
        if kind == "bearing"
        else f"{1e6 * summary['film']['minimum_thickness']:.4g}"
    )
    # Spaces between a number and its unit do not break.
    plain = " ".join(
        html.replace("\N{NARROW NO-BREAK SPACE}", " ").replace("\N{NO-BREAK SPACE}", " ").split()
    )
    assert main in plain
    assert summary["version"] in plain
    assert '<img src="http' not in html
    assert "<script src=" not in html
    pdf = downloaded(page, "download-report-pdf", folder).read_bytes()
    assert pdf[:5] == b"%PDF-"
    assert pdf.rstrip().endswith(b"%%EOF")
    assert len(pdf) > 10_000


def files_of(path, ending):
    """Contents by name of a downloaded file, which is a ZIP where there are several."""
    if path.suffix == ".zip":
        with zipfile.ZipFile(path) as archive:
            return {
                name.rpartition("/")[2] if ending else name: archive.read(name)
                for name in archive.namelist()
                if not name.endswith("/") and name.endswith(ending)
            }
    return {path.name: path.read_bytes()}


def rows_of(content):
    return list(csv.reader(io.StringIO(content.decode("utf-8"))))


def assert_same_netcdf(files, folder):
    """All values of NetCDF files are those of the files of the same names in a folder, to the last digit."""
    import xarray as xr

    assert files
    for title, content in files.items():
        theirs = folder / f"page-{title}"
        theirs.write_bytes(content)
        names = [path for path in folder.glob("*.nc") if not path.name.startswith("page-")]
        own = folder / title if (folder / title).exists() else names[0]
        for group in (None,):
            with xr.open_dataset(theirs, group=group) as one, xr.open_dataset(own, group=group) as other:
                xr.testing.assert_equal(one, other)
        theirs.unlink()


@pytest.mark.slow
def test_a_case_with_a_measured_surface_is_downloaded_with_its_file_and_runs(open_page, app_server, tmp_path):
    table = example("rough_contact", roughness=None, grid__nodes=801)
    page = open_page(app_server, address_of("/contact", table))
    wait_until_solved(page)
    upload(page, DEKTAK)
    page.get_by_test_id("surface-statistics").wait_for()
    page.get_by_test_id("field-roughness-form").select_option("line")
    page.locator("[data-testid=surface-statistics]", has_text="form: line").wait_for()
    page.get_by_test_id("field-roughness-rescale_rq").fill("20 nm")
    page.get_by_test_id("field-roughness-rescale_rq").press("Tab")
    page.locator("[data-testid=surface-statistics]", has_text="Rq").filter(has_text="20.0").wait_for()
    page.get_by_test_id("use-surface").click()
    page.locator("[data-testid=answer][data-solved=false]").wait_for()
    # A film over a rough surface takes longer and is solved on demand.
    solve(page)
    packed = downloaded(page, "download-all", tmp_path)
    with zipfile.ZipFile(packed) as archive:
        archive.extractall(tmp_path / "out")
    (case,) = (tmp_path / "out").rglob("*.toml")
    (summary,) = (tmp_path / "out").rglob("summary.json")
    output, _ = command("run", case, "--json", "--no-plots", "-o", "again", folder=case.parent)
    again, shown = numbers_of(output), numbers_of(summary.read_text("utf-8"))
    assert again["film"] == shown["film"]


@pytest.mark.slow
def test_a_downloaded_case_is_opened_again(page, open_page, app_server, tmp_path):
    wait_for_number(page, "bearing.capacitance", capacitance())
    type_into(page, LOAD, "900 N")
    wait_for_number(page, "bearing.capacitance", capacitance("900 N"))
    case = downloaded(page, "download-toml", tmp_path)
    other = open_page(app_server)
    wait_for_number(other, "bearing.capacitance", capacitance())
    other.get_by_test_id("upload-case").locator("input[type=file]").set_input_files(case)
    wait_for_number(other, "bearing.capacitance", capacitance("900 N"))
    bad = tmp_path / "bad.toml"
    bad.write_text("[bearing]\nradial_load = \n", encoding="utf-8")
    other.get_by_test_id("upload-case").locator("input[type=file]").set_input_files(bad)
    other.get_by_test_id("error-file").filter(has_text="bad.toml").wait_for()
    _, told = command("bearing", bad, folder=tmp_path, status=2)
    words = " ".join(other.get_by_test_id("error-file").inner_text().split())
    assert words.partition("bad.toml")[2] in " ".join(told.split())
    wait_for_number(other, "bearing.capacitance", capacitance("900 N"))
