"""Margins, on which the colour of a verdict depends, along lines through the examples: none jumps.

An input that changes by 0.01 % changes a margin by less than 2 % of it, or by less than 0.01. A margin begins
and ends at 0 where summits touch. Discrete choices are exceptions: the names and states of elements, the
number of points of a probability, and bearings without a height of summits, which have no margin below a
lambda ratio of 1.
"""

import numpy as np
import pytest

from ehlectric import AxleCase, BearingCase, DriveCase, GearCase, evaluate, solve_bearing

AXLE = ("first.margin",)
GEARS = ("mesh.margin", "mesh.contact_time_share")
BEARING = ("bearing.margin",)
ENDS = ("drive_end.bearing.margin", "non_drive_end.bearing.margin")

# Kind and example, input with its ends in SI units, and the margins.
LINES = [
    (AxleCase, "e_axle", "drive.torque", 5.0, 80.0, AXLE),
    (AxleCase, "e_axle", "drive.speed", 100.0, 1600.0, AXLE),
    (AxleCase, "e_axle", "drive.temperature", 295.0, 380.0, AXLE),
    (AxleCase, "e_axle", "mesh.1.gear.tip_relief", 1e-7, 2e-5, AXLE),
    (AxleCase, "e_axle", "mesh.2.gear.flank_ra", 1e-8, 6e-7, AXLE),
    (GearCase, "gear_pair", "gear.operation.pinion_torque", 0.1, 300.0, GEARS),
    (GearCase, "gear_pair", "gear.operation.pinion_speed", 30.0, 1500.0, GEARS),
    (GearCase, "gear_pair", "gear.flank_ra", 2e-8, 6e-7, GEARS),
    (GearCase, "gear_pair", "gear.tip_relief", 4e-6, 6e-6, GEARS),
    (GearCase, "gear_spur", "gear.operation.pinion_torque", 0.1, 300.0, GEARS),
    (DriveCase, "drive", "drive.speed", 30.0, 1500.0, ENDS),
    (DriveCase, "drive", "drive.temperature", 300.0, 390.0, ENDS),
    (BearingCase, "bearing_6208", "bearing.radial_load", 100.0, 8000.0, BEARING),
    (BearingCase, "bearing_6208", "bearing.inner_speed", 30.0, 1200.0, BEARING),
    (BearingCase, "bearing_6208", "bearing.composite_rq", 2e-8, 2e-7, BEARING),
    (BearingCase, "bearing_6314", "bearing.temperature", 300.0, 390.0, BEARING),
    (BearingCase, "bearing_needle", "bearing.inner_speed", 30.0, 1200.0, BEARING),
    (BearingCase, "bearing_tapered_pair", "bearing.temperature", 300.0, 390.0, BEARING),
    (BearingCase, "bearing_four_point", "bearing.radial_load", 100.0, 6000.0, BEARING),
    (BearingCase, "bearing_thrust", "bearing.axial_load", 100.0, 6000.0, BEARING),
]

# Points along a line, and points of an interval that is divided until it is 0.01 % wide.
POINTS, PARTS, WIDTH = 25, 6, 1e-4


def margins_at(case, key, values, names):
    """Margins at values of an input by name: 0 without one, as where summits touch."""
    found = evaluate(case, {key: values})
    return {
        name: np.nan_to_num(np.asarray(found[name].values, dtype=float)) for name in names if name in found
    }


def steps_along(case, key, values, names):
    """Largest change of each margin within 0.01 % of an input, with the place and the smaller margin."""
    steps = []
    for name, margins in margins_at(case, key, values, names).items():
        changes = np.abs(np.diff(margins)) / np.maximum(np.minimum(margins[1:], margins[:-1]), 0.5)
        for number in np.argsort(changes)[-3:].tolist():
            low, high, ends = values[number], values[number + 1], margins[number : number + 2]
            while high - low > WIDTH * low:
                inner = np.linspace(low, high, PARTS)
                found = margins_at(case, key, inner, names)[name]
                worst = int(np.argmax(np.abs(np.diff(found))))
                low, high, ends = inner[worst], inner[worst + 1], found[worst : worst + 2]
            steps.append((name, float(low), float(abs(ends[1] - ends[0])), float(min(ends))))
    return steps


def jumps(steps):
    """Steps that are larger than 0.01 and than 2 % of the margin."""
    return [each for each in steps if each[2] > max(0.01, 0.02 * each[3])]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "example", "key", "low", "high", "names"), LINES)
def test_no_margin_jumps_along_a_line(kind, example, key, low, high, names):
    case = kind.from_toml(f"examples/{example}.toml")
    case = case.quick if kind is AxleCase else case
    steps = steps_along(case, key, np.geomspace(low, high, POINTS), names)
    assert {name for name, *_ in steps} == {*names}
    assert jumps(steps) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("example", "low", "high", "change"),
    [("bearing_6314", 7194.0, 7300.0, 0.15), ("bearing_6208", 676.0, 681.0, 0.1)],
)
def test_a_step_of_the_stated_film_error_leaves_the_probability(example, low, high, change):
    """The largest error of all contacts steps as another one counts: a breakdown stays as likely."""
    case = BearingCase.from_toml(f"examples/{example}.toml")
    found = [
        solve_bearing(case.replace({"contacts": "atlas", "bearing.radial_load": load}), workers=1).summary()
        for load in (low, high)
    ]
    errors = [summary["bearing"]["film_error"] for summary in found]
    assert abs(np.log(errors[1] / errors[0])) > change
    chances = [summary["uncertainty"]["breakdown_probability"] for summary in found]
    assert chances[0] == pytest.approx(chances[1], abs=0.01)


def test_a_jump_is_found(monkeypatch):
    """A step from 0 to 0.094 at 12.75 N m, as of a mesh that becomes a conductor at once."""
    module = "tests.discharge.test_margins_do_not_jump.margins_at"

    def stepped(_case, _key, values, _names):
        return {"first.margin": np.where(values < 12.75, 0.0, 0.094)}

    monkeypatch.setattr(module, stepped)
    ((_, place, change, _), *_) = jumps(
        steps_along(None, "drive.torque", np.geomspace(5.0, 80.0, POINTS), AXLE)
    )
    assert place == pytest.approx(12.75, rel=WIDTH)
    assert change == pytest.approx(0.094)
