"""Results in files of other programs, read back by the libraries of those programs."""

import math
import subprocess
import sys

import numpy as np
import openpyxl
import pytest
from scipy.io import loadmat
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOHDF import vtkHDFReader

from ehlectric import (
    BearingCase,
    Case,
    InputError,
    Sweep,
    export,
    run_sweep,
    save,
    solve,
    solve_bearing,
    solve_drive,
    solve_motion,
)
from ehlectric.quantities.results import BEARING_KEYS, CONTACT_KEYS, DRIVE_KEYS, MOTION_KEYS
from ehlectric.runs.exports import cells, matlab_names
from ehlectric.runs.workbooks import scale_of_values
from ehlectric.sweep.axis_labels import label_of
from tests.helpers.drives import small_drive
from tests.helpers.moving_cases import TABLES, moving
from tests.helpers.places import EXAMPLES
from tests.helpers.programs import program
from tests.helpers.sweep_models import SPEED
from tests.helpers.sweep_models import case as contact

LINE = {"grid.nodes": 401}
POINT = {"grid.nodes": 65}


@pytest.fixture(scope="module")
def line():
    return _solved("line_contact", LINE)


@pytest.fixture(scope="module")
def point():
    return _solved("ball_contact", POINT)


@pytest.fixture(scope="module")
def bearing():
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    return solve_bearing(case.replace({"title": "=1+1"}), workers=1)


@pytest.fixture(scope="module")
def drive():
    return solve_drive(small_drive(**{"drive.duration": "1 ms"}), workers=1)


def _solved(name, changes):
    return solve(Case.from_toml(EXAMPLES / f"{name}.toml").replace(changes))


def blocks(path):
    """Grids of a VTKHDF file by their names."""
    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutputDataObject(0)
    tree = found.GetDataAssembly()
    return {
        tree.GetNodeName(node): found.GetPartition(tree.GetDataSetIndices(node)[0], 0)
        for node in tree.GetChildNodes(tree.GetRootNode(), False)
    }


def values_of(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def points_of(grid):
    return vtk_to_numpy(grid.GetPoints().GetData())


def sizes_of(grid, name):
    """Sizes of all cells, negative for one whose corners are in the wrong order."""
    size = vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    return vtk_to_numpy(size.GetOutput().GetCellData().GetArray(name))


def test_paraview_reads_film_and_field_of_a_point_contact(point, tmp_path):
    """All points and values; the cells of the field fill the gap, whose volume is that of its mean height."""
    grids = blocks(export(point, tmp_path / "ball.vtkhdf"))
    dataset = point.to_xarray()
    film, field = grids["film"], grids["field"]
    x, y = np.meshgrid(dataset["x"], dataset["y"], indexing="ij")
    expected = np.column_stack([x.ravel(), y.ravel(), dataset["thickness"].values.ravel()])
    assert np.array_equal(points_of(film), expected)
    assert np.array_equal(values_of(film, "pressure"), dataset["pressure"].values.ravel())
    assert np.array_equal(values_of(field, "strength"), dataset["strength"].values.ravel())
    assert np.array_equal(points_of(field)[:, 2], dataset["z"].values.ravel())
    volumes = sizes_of(field, "Volume")
    assert np.all(volumes > 0.0)
    z = dataset["z"].values
    heights = z[..., -1] - z[..., 0]
    over = np.trapezoid(np.trapezoid(heights, dataset["y_field"], axis=1), dataset["x_field"])
    assert np.sum(volumes) == pytest.approx(over, rel=1e-6)


def test_paraview_reads_film_and_field_of_a_line_contact(line, tmp_path):
    grids = blocks(export(line, tmp_path / "line.vtkhdf"))
    dataset = line.to_xarray()
    points = points_of(grids["film"])
    assert np.array_equal(points[:, 0], dataset["x"])
    assert np.array_equal(points[:, 1], dataset["thickness"])
    assert np.array_equal(values_of(grids["field"], "potential"), dataset["potential"].values.ravel())
    heights = dataset["y"].values[:, -1] - dataset["y"].values[:, 0]
    area = np.sum(sizes_of(grids["field"], "Area"))
    assert area == pytest.approx(np.trapezoid(heights, dataset["x_field"]), rel=1e-6)


def test_cells_of_a_cube_are_those_of_vtk():
    """Corners of a hexahedron: around the bottom, then around the top."""
    (cube,) = cells((2, 2, 2))
    corners = np.array([[k // 4, k // 2 % 2, k % 2] for k in cube])
    assert corners.tolist() == [
        [0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1],
    ]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", [pytest.param("line", marks=pytest.mark.gate), "point", "bearing", "drive"])
def test_a_mat_file_has_all_arrays_and_the_summary(name, request, tmp_path):
    result = request.getfixturevalue(name)
    found = loadmat(export(result, tmp_path / "result.mat"), squeeze_me=True, simplify_cells=True)
    dataset = result.to_xarray()
    variables = {key: variable for variable, key in found["keys"].items()}
    assert set(variables) == set(map(str, dataset.variables))
    for key, values in dataset.variables.items():
        if values.dtype.kind in "biuf":
            np.testing.assert_array_equal(found[variables[key]], np.squeeze(values.values))
        # An empty text is an empty array.
        unit = found["units"][variables[key]]
        assert (unit if isinstance(unit, str) else "") == values.attrs.get("units", "")
    assert found["summary"]["version"] == result.summary()["version"]


def test_octave_reads_a_mat_file(line, tmp_path):
    """Sizes, a value of the summary and a unit, as a user types them."""
    octave = program("octave-cli")
    export(line, tmp_path / "line.mat")
    typed = (
        "load line.mat; printf('%d %d\\n', size(strength)); printf('%.17g\\n', min(thickness)); "
        "printf('%.17g\\n', summary.film.minimum_thickness); printf('%s\\n', units.pressure)"
    )
    done = subprocess.run(
        [octave, "--norc", "--eval", typed], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    size, least, told, unit = done.stdout.split("\n")[:4]
    dataset = line.to_xarray()
    assert size == "{} {}".format(*dataset["strength"].shape)
    assert float(least) == float(dataset["thickness"].min())
    assert float(told) == line.summary()["film"]["minimum_thickness"]
    assert unit == "Pa"


def test_names_of_matlab_are_valid_and_different():
    long = "a" * 70
    names = matlab_names([long, long + "b", "1.x", "_y", "while", "µ", "units"], taken=["units"])
    assert all(len(name) <= 63 for name in names.values())
    assert len(set(names.values())) == 7
    assert names["1.x"] == "x1_x"
    assert names["while"] == "xWhile"
    assert names["units"] == "units_2"


@pytest.mark.slow
@pytest.mark.gate
def test_a_workbook_has_summary_inputs_and_table(bearing, tmp_path):
    """Numbers are numbers with their units, and a title that begins like a formula is a text."""
    book = openpyxl.load_workbook(export(bearing, tmp_path / "bearing.xlsx"))
    assert book.sheetnames == ["summary", "inputs", "table", "over speed"]
    rows = {row[0].value: row for row in book["summary"].iter_rows(min_row=2)}
    name, shown, shown_unit, value, unit = (cell.value for cell in rows["bearing.capacitance"][1:])
    # Workbooks have numbers with 16 digits.
    assert value == pytest.approx(bearing.summary()["bearing"]["capacitance"], rel=1e-15, abs=0.0)
    assert unit == "F"
    assert (shown, shown_unit) == (pytest.approx(1e12 * value, rel=1e-13), "pF")
    assert "capacitance" in name
    title = rows["title"][2]
    assert (title.value, title.data_type) == ("=1+1", "s")
    inputs = {row[0].value: row[2:] for row in book["inputs"].iter_rows(min_row=2)}
    load, unit, *_ = inputs["bearing.radial_load"]
    assert (load.value, unit.value) == (1800.0, "N")
    speed, unit, si, _ = (cell.value for cell in inputs["bearing.inner_speed"])
    assert (speed, unit) == (pytest.approx(30.0 / math.pi * si, rel=1e-13), "rpm")
    temperature, unit, si, _ = (cell.value for cell in inputs["bearing.temperature"])
    assert (temperature, unit) == (pytest.approx(si - 273.15, rel=1e-13), "°C")
    assert [key for key, row in rows.items() if not row[1].value] == []
    assert (rows["mechanics.cage_speed"][1].value, rows["mechanics.cage_speed"][3].value) == (
        "speed of the cage",
        "rpm",
    )
    of_input = next(key for key, row in rows.items() if row[2].value == "bearing.temperature")
    low = rows[of_input.replace(".key", ".low_input")]
    assert (low[2].value, low[3].value) == (pytest.approx(60.0), "°C")
    frame = bearing.to_dataframe()
    table = list(book["table"].iter_rows(values_only=True))
    assert len(table) == len(frame) + 1
    assert [head.partition(" [")[0] for head in table[0]] == list(map(str, frame.columns))
    column = list(frame.columns).index("load")
    assert [row[column] for row in table[1:]] == pytest.approx(list(frame["load"]), rel=1e-13)
    column = table[0].index("max_pressure [MPa]")
    known = [(row[column], value) for row, value in zip(table[1:], frame["max_pressure"], strict=True)]
    assert all(shown == pytest.approx(1e-6 * value, rel=1e-13) for shown, value in known if value == value)
    share = rows["contacts.0.voltage_share"]
    assert share[3].value == "%"
    assert table[1][table[0].index("voltage_share [%]")] == share[2].value
    heads, *curve = book["over speed"].iter_rows(values_only=True)
    own = bearing.summary()["bearing"]["capacitance"]
    place = min(curve, key=lambda row: abs(row[0] - speed))
    assert heads[0] == "bearing.inner_speed [rpm]"
    assert place[0] == pytest.approx(speed, rel=1e-9)
    assert place[heads.index("bearing.capacitance [pF]")] == pytest.approx(1e12 * own, rel=1e-6)
    margin = bearing.summary()["bearing"]["margin"]
    assert place[heads.index("bearing.margin [-]")] == pytest.approx(margin, rel=1e-6)


def test_temperatures_are_in_degrees_unless_they_are_differences():
    """Each temperature of the books of results, and temperatures of inputs, lists of them as well."""
    books = [BEARING_KEYS, DRIVE_KEYS, *CONTACT_KEYS.values(), *MOTION_KEYS.values()]
    results = {key: one for book in books for key, one in book.items() if one.unit == "K"}
    assert len(results) > 10
    for key, one in results.items():
        differs = any(word in key for word in ("rise", "error"))
        assert scale_of_values("K", one.shown, np.array([300.0])).unit == ("K" if differs else "°C"), key
    expected = {
        "lubricant.temperature_range.0": "°C",
        "drive_end.lubricant.temperature_range.1": "°C",
        "bearing.fits.shaft_temperature": "°C",
        "lubricant.vogel_c": "°C",
        "lubricant.vogel_b": "K",
        "lubricant.yasutomi_a1": "K",
    }
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    assert {key: label_of(key, case).scaled(np.array([300.0])).unit for key in expected} == expected


def test_results_have_names_that_are_not_keys():
    books = [BEARING_KEYS, DRIVE_KEYS, *CONTACT_KEYS.values(), *MOTION_KEYS.values()]
    assert [
        key
        for book in books
        for key, one in book.items()
        if not one.label or "_" in one.label.replace("h_min", "")
    ] == []


@pytest.mark.slow
def test_a_sweep_and_a_folder_are_exported(tmp_path):
    sweep = Sweep.from_dict({"case": contact().replace({"grid.nodes": 401}), "vary": {SPEED: [1.0, 2.0]}})
    assert run_sweep(sweep, tmp_path / "sweep", workers=1).summary()["solved"] == 2
    book = openpyxl.load_workbook(export(tmp_path / "sweep", tmp_path / "sweep.xlsx"))
    heads, *rows = book["table"].iter_rows(values_only=True)
    assert [row[heads.index("contact.entrainment_speed [m/s]")] for row in rows] == [1.0, 2.0]
    found = loadmat(export(str(tmp_path / "sweep"), tmp_path / "sweep.mat"), squeeze_me=True)
    assert found["contact_entrainment_speed"].tolist() == [1.0, 2.0]


def test_a_stored_result_is_exported_as_the_one_that_was_saved(line, tmp_path):
    save(line, tmp_path / "out")
    first = export(tmp_path / "out", tmp_path / "a.vtkhdf")
    second = export(line, tmp_path / "b.vtkhdf")
    assert np.array_equal(points_of(blocks(first)["field"]), points_of(blocks(second)["field"]))


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point"])
def test_paraview_reads_a_moving_film(geometry, tmp_path):
    """Points and values of every recorded instant, at its time."""
    run = solve_motion(moving(TABLES[geometry]))
    reader = vtkHDFReader()
    reader.SetFileName(str(export(run, tmp_path / "moving.vtkhdf")))
    reader.UpdateInformation()
    film = run.dataset["thickness"]
    plane = [run.dataset[name].values for name in film.dims[1:]]
    assert reader.GetNumberOfSteps() == film.sizes["frame"] > 3
    for step in (0, 2, film.sizes["frame"] - 1):
        reader.SetStep(step)
        reader.Update()
        grid = reader.GetOutputDataObject(0)
        assert reader.GetTimeValue() == run.frame_time[step]
        positions = [axis.ravel() for axis in np.meshgrid(*plane, indexing="ij")]
        height = film.values[step].ravel()
        assert np.array_equal(points_of(grid)[:, : len(plane) + 1], np.column_stack([*positions, height]))
        assert np.array_equal(values_of(grid, "pressure"), run.dataset["pressure"].values[step].ravel())
        sizes = sizes_of(grid, "Length" if len(plane) == 1 else "Area")
        assert len(sizes) == np.prod([len(axis) - 1 for axis in plane])
        assert np.all(sizes > 0.0)


def test_a_workbook_without_its_package_names_the_extra(bearing, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(InputError, match=r"pip install 'ehlectric\[excel\]'"):
        export(bearing, tmp_path / "bearing.xlsx")
    assert not (tmp_path / "bearing.xlsx").exists()


def test_what_cannot_be_exported_is_refused(bearing, tmp_path):
    with pytest.raises(InputError, match=r"got '\.csv'; expected a name that ends in \.mat, "):
        export(bearing, tmp_path / "a.csv")
    with pytest.raises(InputError, match="holds film and field of a contact"):
        export(bearing, tmp_path / "a.vtkhdf")
    with pytest.raises(InputError, match="its folder does not exist"):
        export(bearing, tmp_path / "none" / "a.mat")
    with pytest.raises(InputError, match="nothing"):
        export(tmp_path / "nothing", tmp_path / "a.mat")
    assert not list(tmp_path.iterdir())
