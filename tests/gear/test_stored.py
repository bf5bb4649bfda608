"""File of a gear pair: what is saved comes back, with the same numbers."""

import json
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import InputError, load, save, solve, solve_gear
from ehlectric.gear import run as of_gears
from ehlectric.gear import solving
from tests.helpers.each import each
from tests.helpers.gears import RELIEVED, helical_case, spur_case


@pytest.fixture(scope="module")
def spur():
    return solve_gear(spur_case())


@pytest.fixture(scope="module")
def helical():
    return solve_gear(helical_case())


@each("changes", [{}, RELIEVED, {"contacts": "formula"}])
def test_a_loaded_result_equals_the_saved_one(changes, tmp_path, monkeypatch):
    result = solve_gear(spur_case(**changes), probable=False)
    files = save(result, tmp_path)
    assert [file.name for file in files] == ["summary.json", "path.csv", "mesh.csv", "gear.nc"]
    with monkeypatch.context() as patched:
        # Nothing is solved again.
        patched.setattr(solving, "loads_at_points", None)
        patched.setattr(solving, "flank_films", None)
        for path in (tmp_path, tmp_path / "gear.nc", tmp_path / "mesh.csv"):
            again = load(path)
            assert again == result
            assert again.seconds == result.seconds
            assert json.dumps(again.summary()) == json.dumps(result.summary())
            assert list(map(str, again.warnings)) == list(map(str, result.warnings))
            assert again.verdict == result.verdict


def test_a_helical_pair_is_loaded_too(helical, tmp_path):
    save(helical, tmp_path)
    again = load(tmp_path)
    assert again == helical
    assert again.over_phase()["capacitance"].tolist() == helical.over_phase()["capacitance"].tolist()
    assert not again.solution.films.minimum.flags.writeable


def test_solved_films_are_loaded_and_not_solved_again(tmp_path):
    result = solve_gear(spur_case(contacts="solved"))
    atlas = solve_gear(spur_case())
    save(result, tmp_path)
    assert load(tmp_path) == result
    minimum = result.summary()["mesh"]["minimum_thickness"]
    # The atlas states an error of about a per cent.
    assert minimum == pytest.approx(atlas.summary()["mesh"]["minimum_thickness"], rel=0.02)
    assert minimum != atlas.summary()["mesh"]["minimum_thickness"]


def test_a_result_is_pickled(spur):
    again = pickle.loads(pickle.dumps(spur))
    assert again == spur
    assert again.summary() == spur.summary()


def test_numbers_that_differ_make_another_result(spur):
    solution = spur.solution
    minimum = solution.films.minimum.copy()
    place = np.unravel_index(np.nanargmin(minimum), minimum.shape)
    minimum[place] = np.nextafter(minimum[place], 0.0)
    assert replace(spur, solution=replace(solution, films=replace(solution.films, minimum=minimum))) != spur


def test_the_file_describes_its_variables(helical):
    """Lines of contact are where their phase and their helix put them, as in section A of ISO 21771."""
    dataset = helical.to_xarray()
    loads = helical.solution.loads
    assert dict(dataset.sizes) == {"phase": loads.phases.size, "node": loads.load.size, "point": 5}
    assert list(dataset["point"].values) == list("ABCDE")
    assert dataset["load"].attrs["units"] == "N/m"
    assert dataset["film_minimum"].attrs["units"] == "m"
    assert float(dataset["phase_weight"].sum()) == pytest.approx(1.0)
    path, number = helical.solution.path, dataset["node_phase"].values
    begin = (dataset["phase"].values[number] + dataset["node_line"].values) * path.base_pitch
    x = begin + math.tan(path.base_helix_angle) * dataset["across"].values
    assert dataset["place"].values == pytest.approx(path.start + x, abs=1e-9)
    lengths = [helical.solution.plane.length(phase) for phase in dataset["phase"].values]
    assert np.bincount(number, dataset["length"].values) == pytest.approx(lengths, rel=1e-12)


@each(
    "name, change",
    [
        ("load", lambda values: -values),
        ("film_minimum", lambda values: -values),
        ("place", lambda values: values + 1e-6),
        ("node_phase", lambda values: values[::-1]),
        ("across", lambda values: 3.0 * values),
        ("length", lambda values: 0.5 * values),
        ("phase_weight", lambda values: 0.5 * values),
        ("phase", lambda values: 0.0 * values),
        ("load", lambda values: np.nan * values),
        ("film_known", lambda values: values + 2),
        ("point_central", None),
        ("capacitance_of_lines", None),
    ],
)
def test_what_is_wrong_is_named(spur, tmp_path, name, change):
    dataset = spur.to_xarray()
    variable = dataset[name]
    dataset = dataset.drop_vars(name)
    if change is not None:
        values = change(variable.values)
        dataset = dataset.assign({name: (variable.dims, values, variable.attrs)})
    with pytest.raises(InputError, match=rf"gear\.nc: .*{name}"):
        of_gears.result_of(dataset, tmp_path / "gear.nc")


def test_the_case_of_other_gears_is_refused(spur, tmp_path):
    """Its films would belong to another path of contact."""
    other = spur_case(**{"gear.centre_distance": "91.6 mm"}).to_toml()
    with pytest.raises(InputError, match=r"gear\.nc: .*place does not belong to the gear pair"):
        of_gears.result_of(spur.to_xarray().assign_attrs(case=other), tmp_path / "gear.nc")


@each(
    "attributes, message",
    [
        ({"schema": "ehlectric.drive.result/1"}, "is not the result of a gear pair"),
        ({"schema": "ehlectric.gear.result/2"}, "later version"),
        ({"case": "gear = 1"}, "its case is not valid"),
        ({"case": "]"}, "its case is no TOML"),
        ({"seconds": "long"}, "seconds"),
    ],
)
def test_the_file_of_another_result_is_refused(spur, tmp_path, attributes, message):
    with pytest.raises(InputError, match=rf"gear\.nc: .*{message}"):
        of_gears.result_of(spur.to_xarray().assign_attrs(attributes), tmp_path / "gear.nc")


def test_a_damaged_file_is_refused(spur, tmp_path):
    save(spur, tmp_path)
    file = tmp_path / "gear.nc"
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 0xFF
    file.write_bytes(bytes(content))
    with pytest.raises(InputError, match=r"gear\.nc"):
        load(tmp_path)
    file.write_bytes(b"no result")
    with pytest.raises(InputError, match=r"gear\.nc"):
        load(tmp_path)


def test_a_gear_file_is_solved_as_other_files(spur, tmp_path):
    path = tmp_path / "gear.toml"
    path.write_text(spur_case().to_toml(), encoding="utf-8")
    for given in (spur_case(), spur_case().to_dict(), path, str(path)):
        assert solve(given) == spur


@each("changes", [{}, {"gear.contact.conduction": "always"}, {"gear.contact.voltage": "1 mV"}])
def test_the_probability_is_loaded_and_not_computed_again(changes, tmp_path, monkeypatch):
    """Also the reason for which a mesh that conducts at all points has none."""
    result = solve_gear(spur_case(**changes))
    save(result, tmp_path)
    with monkeypatch.context() as patched:
        patched.setattr("ehlectric.gear.uncertainty.uncertainty_of", None)
        again = load(tmp_path)
        assert again.summary() == result.summary()
        assert again.verdict == result.verdict
        assert again.spread.missing == result.spread.missing
        if result.uncertainty is not None:
            assert again.uncertainty.margins.tolist() == result.uncertainty.margins.tolist()
            assert again.uncertainty.inputs == result.uncertainty.inputs


def test_a_file_without_points_of_the_probability_is_read(tmp_path):
    """A result of an earlier version computes its probability again."""
    result = solve_gear(spur_case())
    dataset = result.to_xarray()
    names = [name for name in dataset.variables if str(name).startswith("uncertainty_")]
    older = dataset.drop_vars(names)
    older.attrs = {key: value for key, value in dataset.attrs.items() if not key.startswith("uncertainty")}
    again = of_gears.result_of(older, tmp_path / "gear.nc")
    assert again.summary()["uncertainty"] == result.summary()["uncertainty"]
