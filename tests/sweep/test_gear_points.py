"""Gear pairs at many points of operation, against the command `ehlectric gear` for each point alone."""

import numpy as np
import pytest

from ehlectric import InputError, evaluate
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.table_edits import flattened
from ehlectric.gear import solve_gear
from ehlectric.quantities.results import GEAR_KEYS
from tests.gear.pairs import FZG_C_CASE, case_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

# Speeds and roughness at which the mesh conducts, conducts at times, and insulates.
GIVEN = {
    "gear.operation.pinion_torque": ["20 N m", "120 N m", "300 N m"],
    "gear.operation.pinion_speed": ["12000 rpm", "4000 rpm", "1000 rpm"],
    "gear.flank_ra": ["0.03 um", "0.15 um", "0.4 um"],
    "gear.operation.bulk_temperature": ["60 degC", "80 degC", "110 degC"],
}


def point_of(given, k):
    return {key: values[k] for key, values in given.items()}


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("pair", ["spur", "helical"])
def test_points_are_those_of_each_pair_alone(pair):
    """Each number, text and warning equals the summary of the command for the same input."""
    case = case_of() if pair == "spur" else GearCase.from_toml(EXAMPLES / "gear_pair.toml")
    found = evaluate(case, GIVEN)
    assert found["converged"].values.tolist() == [True] * 3
    assert len(set(found["mesh.state"].values)) > 1
    for k in range(3):
        alone = solve_gear(case.replace(point_of(GIVEN, k))).summary()
        tables = flattened({name: alone[name] for name in ("gear", "mesh", "points")})
        for key, value in tables.items():
            if key in found and key not in GIVEN:
                at = found[key].values[k]
                if isinstance(value, str):
                    assert at == value
                else:
                    assert at == pytest.approx(np.nan if value is None else value, nan_ok=True), key
        codes = filter(None, found["warning_codes"].values[k].split("; "))
        assert sorted(codes) == sorted(alone["warning_codes"])
        assert {"mesh.state", "mesh.capacitance", "points.C.central_thickness"} <= set(found)


def test_a_drawing_that_cannot_run_has_its_reason():
    case = case_of()
    given = {"gear.centre_distance": ["91.5 mm", "80 mm", "91.6 mm"]}
    found = evaluate(case, given)
    assert found["converged"].values.tolist() == [True, False, True]
    assert np.isnan(found["mesh.capacitance"].values).tolist() == [False, True, False]
    assert found["mesh.state"].values[1] == ""
    with pytest.raises(InputError) as caught:
        solve_gear(case.replace(point_of(given, 1)))
    assert found["reason"].values[1] == str(caught.value)


def test_solved_films_are_from_the_atlas():
    given = {"gear.operation.pinion_torque": ["215.6 N m"]}
    case = GearCase.from_dict({**FZG_C_CASE, "contacts": "solved"})
    found, quick = evaluate(case, given), evaluate(case_of(), given)
    assert found["mesh.minimum_thickness"].values == quick["mesh.minimum_thickness"].values


def test_numbers_of_both_gears_and_words_are_inputs():
    """One number holds for both flanks; a word may replace the temperature of the flanks."""
    given = {
        "gear.flank_ra": [1e-7, 2e-7],
        "gear.operation.bulk_temperature": ["iso", "90 degC"],
        "gear.teeth": [[23, 67], [24, 66]],
    }
    found = evaluate(GearCase.from_toml(EXAMPLES / "gear_pair.toml"), given)
    assert found["gear.flank_ra"].attrs["units"] == "m"
    assert found["gear.flank_ra"].values.tolist() == [1e-7, 2e-7]
    assert found["gear.teeth"].values.tolist() == ["[23, 67]", "[24, 66]"]
    assert found["gear.operation.bulk_temperature"].values[0] == "iso"
    assert "flank-temperature-estimated" in found["warning_codes"].values[0]


@each(
    ("given", "text"),
    [
        ({"gear.flank_ra": ["-1 um"]}, "gear.flank_ra.*at index 0"),
        ({"bearing.radial_load": [1.0]}, "bearing.radial_load: unknown"),
        ({"drive.speed": [1.0]}, "drive.speed: unknown"),
        ({"gear.operation": [1.0]}, "is a table"),
        ({"gear.face_widht": [0.02]}, "face_width"),
        ({"gear.face_width": 0.02}, "a value for each point"),
    ],
)
def test_wrong_arrays_are_refused(given, text):
    with pytest.raises(InputError, match=text):
        evaluate(case_of(), given)


@each(
    "changes",
    [
        {"gear.operation.pinion_torque": 44.0, "gear.operation.bulk_temperature": 333.0},
        {"gear.operation.pinion_speed": 200.0, "gear.flank_ra": 1e-7},
        {"gear.operation.load_sharing": "rigid"},
        {
            "gear.face_width": "12 mm",
            "gear.profile_shift": [0.18, 0.17],
            "gear.flank_ra": ["0.1 um", "0.2 um"],
        },
        {"gear.composite_rq": "0.1 um"},
        {"gear.centre_distance": None},
        {"gear.tip_diameter": ["82 mm", "118 mm"], "gear.helix_angle": "1 deg"},
    ],
)
def test_a_changed_pair_is_the_replaced_case(changes):
    assert changed_pair(case_of(), changes) == case_of().replace(changes)


@each(
    "changes",
    [
        {"gear.operation.pinion_torque": 0.0},
        {"gear.face_width": "-1 mm"},
        {"gear.flank_ra": ["0.1 um", "wide"]},
        {"gear.lead_crowning": "5 um", "gear.operation.load_sharing": "iso"},
    ],
)
def test_a_wrong_pair_has_the_error_of_the_replaced_case(changes):
    with pytest.raises(InputError) as replaced:
        case_of().replace(changes)
    with pytest.raises(InputError) as changed:
        changed_pair(case_of(), changes)
    assert str(changed.value) == str(replaced.value)


def test_values_of_each_gear_are_lists_or_keys_of_their_numbers():
    """Both spellings, and the command for each point alone, have the same numbers."""
    case, pairs = GearCase.from_toml(EXAMPLES / "gear_pair.toml"), [[5e-8, 5e-8], [3e-8, 6e-8], [6e-8, 3e-8]]
    lists = evaluate(case, {"gear.flank_ra": pairs})
    keys = evaluate(case, {f"gear.flank_ra.{n + 1}": [pair[n] for pair in pairs] for n in range(2)})
    alone = [solve_gear(case.replace({"gear.flank_ra": pair})).summary()["mesh"]["margin"] for pair in pairs]
    for found in (lists, keys):
        assert found["mesh.margin"].values == pytest.approx(alone, rel=1e-8)


@each("torque", ["30 N m", "1e-6 N m"])
@each("flank_ra", [5e-8, 1e-6])
def test_the_keys_do_not_depend_on_the_values(torque, flank_ra):
    """All keys of the book are there, with films, with touching flanks, and where points are refused."""
    case = GearCase.from_toml(EXAMPLES / "gear_pair.toml").replace({"gear.flank_ra": flank_ra})
    found = evaluate(case, {"gear.operation.pinion_torque": [torque]})
    known = {key for key in GEAR_KEYS if key.partition(".")[0] in ("gear", "mesh", "points")}
    assert {*found} == known | {"converged", "reason", "warning_codes"}
