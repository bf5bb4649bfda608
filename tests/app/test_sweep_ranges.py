"""Inputs of the sweep page: a sweep file with its base case inside."""

import tomllib
from dataclasses import replace

from ehlectric.app.page_inputs import (
    Inputs,
    Range,
    case_of_link,
    lists_of,
    ranges_of,
    sweep_file,
    sweep_inputs,
    with_ranges,
)
from ehlectric.app.pages.frame import BEARING, SWEEP
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each


def test_ranges_keep_their_order_in_file_and_address():
    ranges = [
        Range("lubricant.temperature.kinematic_viscosity_40", "10 mm^2/s", "100 mm^2/s", 3, log=True),
        Range("bearing.radial_load", "1 kN", "2 kN", 4),
    ]
    inputs = with_ranges(SWEEP, ranges)
    assert ranges_of(inputs) == ranges
    assert ranges_of(with_ranges(inputs, ranges[::-1])) == ranges[::-1]
    file = Sweep.from_written(tomllib.loads(sweep_file(inputs.changed({"show": "bearing.margin"})).toml()))
    assert list(file.vary) == [one.key for one in ranges]
    assert file.size == 12


@each(
    "vary",
    [
        {"bearing": {"inner_speed": {"from": "1 rpm", "to": "2 rpm", "count": 2}, "elements": [8, 9]}},
        {"bearing": {"coating": {"thickness": ["1 um", "2 um"]}, "elements": [8, 9]}},
        {"lubricant.base": ["fva-3"], "bearing": {"radial_load": {"from": "1 N", "to": "2 N", "count": 3}}},
        {"contacts": ["formula"], "bearing": {"elements": [8]}, "motor": {"rise_time": ["1 us"]}},
    ],
)
def test_varied_inputs_keep_their_order_in_the_file(vary):
    """The order numbers the points: the file must have that of the page."""
    inputs = Inputs({"vary": vary, "case": SWEEP.value("case")})
    file = tomllib.loads(inputs.toml())
    assert file == inputs.table
    assert list(Inputs(file["vary"]).flat()) == list(Inputs(vary).flat())


def test_a_changed_range_keeps_lists_and_places():
    """Keys of a file may stand in quotes, as in the examples."""
    vary = {
        "contact.entrainment_speed": ["1 m/s", "2 m/s"],
        "contact.load_per_length": {"from": "1 MN/m", "to": "2 MN/m", "count": 3},
    }
    inputs = Inputs({"vary": vary})
    assert lists_of(inputs) == {"contact.entrainment_speed": ["1 m/s", "2 m/s"]}
    (one,) = ranges_of(inputs)
    changed = with_ranges(inputs, [replace(one, stop="3 MN/m")])
    assert next(iter(Inputs(changed.value("vary")).flat())) == "contact.entrainment_speed"
    assert changed.value("vary.contact.load_per_length.to") == "3 MN/m"
    assert lists_of(changed) == lists_of(inputs)
    assert ranges_of(with_ranges(inputs, [])) == []


def test_the_case_of_another_page_is_taken_over():
    link = f"http://127.0.0.1:8080/?{BEARING.address()}&token=abc"
    assert case_of_link(link) == dict(BEARING.table)
    assert case_of_link(f"/sweep?{SWEEP.address()}") == dict(SWEEP.value("case"))
    assert case_of_link("https://example.org/") is None
    assert sweep_inputs(BEARING) == Inputs({"case": dict(BEARING.table)})
    assert sweep_inputs(SWEEP) == SWEEP
