"""Rough surfaces in the app: numbers are those of ``ehlectric surface --json`` for the same file."""

import json
import zipfile

import numpy as np
import pytest
from typer.testing import CliRunner

from ehlectric import Case, solve
from ehlectric.app.charts.plotly_panels import coarser
from ehlectric.app.charts.surface_charts import line_figure, map_figure
from ehlectric.app.compute.surface_answers import look
from ehlectric.app.roughness_keys import (
    FILE_KEYS,
    FIRST_VALUES,
    GENERATOR_KEYS,
    GENERATOR_NAMES,
    PLACE_KEYS,
    STEP_KEYS,
)
from ehlectric.app.session import new_file, session_file, shown_name, stored_name
from ehlectric.cases.roughness_inputs import GENERATORS, Roughness
from ehlectric.commands.command_line import app
from ehlectric.errors import InputError
from ehlectric.surfaces.maps import Map
from tests.helpers.each import each
from tests.helpers.places import DEKTAK, SURFACES

LINE = {
    "contact": {
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "0.5 GPa",
        "entrainment_speed": "4 m/s",
    },
    "lubricant": {"base": "paper"},
    "grid": {"nodes": 129},
}
POINT = {
    "contact": {
        "geometry": "point",
        "radius_x": "10 mm",
        "radius_y": "10 mm",
        "reduced_modulus": "226 GPa",
        "load": "20 N",
        "entrainment_speed": "2 m/s",
    },
    "lubricant": {"base": "paper"},
}
FILES = {
    "dektak": DEKTAK,
    "hfm": SURFACES / "hfm-1.hfm",
    "x3p": SURFACES / "x3p-2-half.x3p",
    "al3d": SURFACES / "al3d-1.al3d",
}
STEPS = {"form": "parabola", "cutoff_long": "30 um"}
OPTIONS = ["--form", "parabola", "--cutoff-long", "30 um"]


def command(file, *options):
    return CliRunner().invoke(app, ["surface", str(file), "--json", *options])


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("steps", [({}, []), (STEPS, OPTIONS)])
def test_parameters_of_a_line_are_those_of_the_command(name, steps):
    file, (keys, options) = FILES[name], steps
    answer = look({"surface": 1, "file": str(file), **keys}, LINE, str(file.parent))
    assert answer.described == json.loads(command(file, *options).stdout)
    assert len(answer.rows) == len(answer.figures) == len(answer.described["steps"])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["x3p", "al3d"])
def test_parameters_of_a_map_are_those_of_the_command(name):
    answer = look({"surface": 1, "file": str(FILES[name]), **STEPS}, POINT, str(FILES[name].parent))
    assert answer.kind == "map"
    assert answer.described == json.loads(command(FILES[name], "--map", *OPTIONS).stdout)


@pytest.mark.parametrize(("case", "options"), [(LINE, []), (POINT, ["--map"])])
def test_table_of_summits_has_the_words_of_the_command(case, options):
    file = FILES["x3p"]
    table = look({"surface": 1, "file": str(file)}, case, str(file.parent)).summits
    assert all(len(row) == len(table.heads) for row in table.rows)
    printed = CliRunner().invoke(app, ["surface", str(file), *options]).stdout
    for row in table.rows:
        assert list(row) in [line.split() for line in printed.splitlines()]
    assert " ".join(table.note.split()) in " ".join(printed.split())


def test_an_exact_shape_has_no_summits():
    waves = {"surface": 2, "generator": "sinusoid", **FIRST_VALUES["sinusoid"]}
    assert look(waves, LINE, "").summits is None


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("case", [LINE, POINT])
def test_figures_are_json_of_a_bounded_size(name, case):
    answer = look({"surface": 1, "file": str(FILES[name])}, case, str(FILES[name].parent))
    for step in answer.figures:
        assert len(json.dumps(step.figure, allow_nan=False)) < 400_000


def test_used_surface_has_the_same_rq_in_the_contact():
    rough = {"surface": 1, "file": str(DEKTAK), "form": "parabola", "cutoff_long": "80 um"}
    solved = solve(Case.from_dict(LINE | {"roughness": [rough]}))
    expected = json.loads(command(DEKTAK, "--form", "parabola", "--cutoff-long", "80 um").stdout)
    used = look(rough, LINE, str(DEKTAK.parent)).described["steps"][-1]["rq"]
    assert used == expected["steps"][-1]["rq"] == solved.rough[0]["steps"][-1]["rq"]


@pytest.mark.slow
@pytest.mark.parametrize("generator", GENERATORS)
@pytest.mark.parametrize("case", [LINE, POINT])
def test_made_surfaces_begin_with_valid_values(generator, case):
    answer = look({"surface": 2, "generator": generator, **FIRST_VALUES[generator]}, case, "")
    assert answer.figures
    json.dumps(answer.figures[0].figure, allow_nan=False)
    assert not answer.rows or answer.rows[0][0] == "as made"


def test_fields_are_the_keys_of_the_table():
    assert set(GENERATOR_NAMES) == set(GENERATORS) == set(GENERATOR_KEYS) == set(FIRST_VALUES)
    for generator, keys in GENERATOR_KEYS.items():
        needed, optional = GENERATORS[generator]
        assert {key.key for key in keys} == {*needed, *optional}
        assert set(FIRST_VALUES[generator]) == set(needed)
    known = {*Roughness.model_fields}
    assert {key.key for key in (*FILE_KEYS, *STEP_KEYS, *PLACE_KEYS)} <= known


def bad_files(folder):
    """Files that are no surface, by what is wrong with them."""
    contents = {
        "empty.csv": b"",
        "words.csv": b"these are words\nand no numbers\n",
        "noise.dat": np.random.default_rng(1).bytes(5000),
        "text.x3p": b"0 1\n1 2\n",
        "units.txt": "\n".join(f"{k} {k % 7}" for k in range(100)).encode(),
    }
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    with zipfile.ZipFile(folder / "bomb.x3p", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", b" " * 50_000_000)
    return [*contents, "bomb.x3p"]


@pytest.mark.slow
def test_bad_files_give_the_line_of_the_command(tmp_path):
    for name in bad_files(tmp_path):
        done = command(tmp_path / name)
        assert done.exit_code == 2
        with pytest.raises(InputError) as raised:
            look({"surface": 1, "file": str(tmp_path / name)}, LINE, str(tmp_path))
        line = f"error: {raised.value}".replace("roughness.", "")
        assert line == done.stderr.strip().replace("\n", " "), name
        assert "\n" not in line


def test_an_error_names_the_file_as_it_was_uploaded(tmp_path):
    (tmp_path / "surface-1.csv").write_bytes(b"words only")
    with pytest.raises(InputError) as raised:
        look({"surface": 1, "file": "surface-1.csv"}, LINE, str(tmp_path), "my scan.csv")
    assert str(raised.value).startswith("my scan.csv: ")
    assert str(tmp_path) not in str(raised.value)


@pytest.mark.slow
@each(
    "keys, key",
    [
        ({"cutoff_long": "5 mm", "cutoff_short": "40 um"}, "roughness.cutoff_long"),
        ({"cutoff_long": "80 um", "cutoff_short": "1 nm"}, "roughness.cutoff_short"),
        ({"form": "cube"}, "roughness.form"),
        ({"trim": "1 mm"}, "roughness.trim"),
        ({"line": 3}, "roughness.line"),
        ({"direction": "y"}, "roughness.direction"),
    ],
)
def test_errors_belong_to_the_field_that_is_wrong(keys, key):
    with pytest.raises(InputError) as raised:
        look({"surface": 1, "file": str(DEKTAK), **keys}, LINE, str(DEKTAK.parent))
    assert raised.value.key == key


def test_a_wrong_contact_is_told_and_the_surface_shown():
    wrong = {"contact": {"entrainment_speed": "4 m/s"}}
    answer = look({"surface": 1, "file": str(DEKTAK)}, wrong, str(DEKTAK.parent))
    assert answer.rows
    assert "wrong" in answer.warnings[-1].text


def written(folder, heights, *, step=1.0):
    """Name of a file of a profile with heights [nm] at a spacing [um]."""
    lines = (f"{step * k:g},{height:g}" for k, height in enumerate(heights))
    (folder / "profile.csv").write_text("x_um,z_nm\n" + "\n".join(lines) + "\n")
    return "profile.csv"


@pytest.mark.parametrize("case", [LINE, POINT])
def test_heights_above_the_film_are_told_with_both_lengths(case, tmp_path):
    # A tilted line of 1000 points from -8 um to 8 um: its Rq is 16 um over the root of 12.
    table = {"surface": 1, "file": written(tmp_path, np.linspace(-8e3, 8e3, 1000))}
    answer = look(table, case, str(tmp_path))
    (told,) = (one.text for one in answer.warnings if "times the film thickness" in one.text)
    assert "4.62 µm" in told
    level = look({**table, "form": "line"}, case, str(tmp_path))
    assert not [one for one in level.warnings if "film thickness" in one.text]


def test_short_profile_is_told_with_its_length_and_that_of_the_domain(tmp_path):
    table = {"surface": 1, "file": written(tmp_path, np.sin(np.arange(88.0)))}
    answer = look(table, LINE, str(tmp_path))
    # Half-width of LINE by Hertz: b = 4 p R / E', and the domain is 6 b.
    domain = 6.0 * 4.0 * 0.5e9 * 14.1e-3 / 226e9
    (told,) = (one for one in answer.warnings if one.code == "roughness-continued")
    assert "87 µm" in told.text
    assert f"{1e6 * domain:.3g} µm" in told.text
    assert f"{domain / 87e-6:.2g} copies" in told.text


def test_lines_keep_their_extremes():
    heights = np.random.default_rng(3).standard_normal(100_000)
    (trace,) = line_figure(np.linspace(-1e-3, 1e-3, heights.size), 1e-9 * heights)["data"]
    assert len(trace["x"]) < 2500
    assert max(trace["y"]) == pytest.approx(heights.max(), rel=1e-4)
    assert min(trace["y"]) == pytest.approx(heights.min(), rel=1e-4)


def test_maps_keep_their_extremes_and_places():
    heights = np.random.default_rng(4).standard_normal((700, 450))
    pixels, block = coarser(heights)
    assert (pixels.max(), pixels.min()) == (heights.max(), heights.min())
    place = np.unravel_index(np.argmax(pixels), pixels.shape)
    assert tuple(np.unravel_index(np.argmax(heights), heights.shape)) == pytest.approx(
        [block[k] * place[k] + 0.5 * (block[k] - 1) for k in (0, 1)], abs=block[0]
    )
    (trace,) = map_figure(Map(1e-6, 1e-6, 1e-9 * heights))["data"]
    assert np.shape(trace["z"]) == pixels.T.shape


def test_voids_are_left_blank():
    heights = np.ones((20, 30))
    voids = np.zeros((20, 30), dtype=bool)
    voids[3, 4] = True
    (trace,) = map_figure(Map(1e-6, 1e-6, heights), voids)["data"]
    assert trace["z"][4][3] is None


@each(
    "given",
    ["../../etc/passwd", "..\\..\\boot.ini", "/abs/x.csv", "a\x00b.csv", "x.csv\n", "", ".", "..", "a" * 500],
)
def test_names_of_uploads_stay_in_their_folder(given, tmp_path):
    stored = stored_name(given, 7)
    assert (tmp_path / stored).resolve().parent == tmp_path.resolve()
    assert stored.startswith("surface-7.")
    assert len(shown_name(given)) <= 80
    assert shown_name(given).isprintable()


def test_a_file_of_another_folder_is_not_read(tmp_path):
    with pytest.raises(InputError, match="uploaded"):
        look({"surface": 1, "file": str(DEKTAK)}, LINE, str(tmp_path))


def test_uploads_have_new_names_in_the_folder_of_the_session(tmp_path):
    # A case that was downloaded before and is opened again brings a file of such a name.
    (tmp_path / "surfaces").mkdir()
    (tmp_path / "surfaces" / "surface-1.csv").touch()
    name = new_file("a scan.x3p", tmp_path)
    assert name == "surfaces/surface-2.x3p"
    assert session_file(name, tmp_path) == tmp_path / name
    # The next upload of the same request comes before the first one is stored.
    assert new_file("a scan.x3p", tmp_path) == "surfaces/surface-3.x3p"
    assert session_file("../surfaces/surface-2.x3p", tmp_path / "surfaces") is not None
    assert session_file("../surface-2.x3p", tmp_path / "surfaces") is None
