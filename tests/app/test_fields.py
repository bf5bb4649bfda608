"""Fields of the forms: their keys, units, sliders and texts, against the checks of the input files."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.app.catalogue import choices
from ehlectric.app.form_fields import BEARING_GROUPS, Field
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.amounts import Amount
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.cases.input_keys import input_field
from ehlectric.cases.table import number_of
from ehlectric.lubricant.data_sheet import GRADES
from ehlectric.quantities import units
from ehlectric.quantities.units import in_unit, si_unit
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each

FIELDS = [field for group in BEARING_GROUPS for field in group.fields if field.kind != "alternatives"]
NUMBERS = [field for field in FIELDS if field.kind in ("number", "count")]
EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))


def by_key(found):
    return found.key


@each("field", FIELDS, ids=by_key)
def test_every_key_is_one_of_a_bearing_file(field):
    input_field(field.key)


@each("field", NUMBERS, ids=by_key)
def test_units_are_those_of_the_key(field):
    kind = number_of(input_field(field.key))
    if isinstance(kind, Amount):
        assert bool(field.unit) == bool(kind.unit or kind.fraction)
    if field.unit not in ("", "%", "degC"):
        # The server reads units without the registry: both give the same factor, here in twelve digits.
        expected = units.factor(field.unit, kind.unit)
        assert in_unit(f"1 {field.unit}", si_unit(field.unit)) == pytest.approx(expected, rel=5e-12)
        assert units.factor(si_unit(field.unit), kind.unit) == pytest.approx(1.0)


@each("place", [0.0, 0.37, 1.0])
@each("field", NUMBERS, ids=by_key)
def test_values_of_a_slider_are_allowed(field, place):
    """The check is that of the key of an input file, for what the form writes there."""
    written = field.from_slider(place)
    table = input_field(field.key)
    kind = number_of(table)
    if kind is None:
        case_of_dict(EXAMPLE.changed({field.key: written}).table, written=True)
    elif isinstance(kind, Amount):
        kind.parse(written, written=True)
    else:
        kind.parse(written)


@each("place", [0.0, 1.0])
@each("key", ["bearing.inner_speed", "bearing.temperature", "bearing.composite_rq"])
def test_ends_of_a_slider_make_a_case(key, place):
    field = next(field for field in FIELDS if field.key == key)
    case_of_dict(EXAMPLE.changed({key: field.from_slider(place)}).table, written=True)


@pytest.mark.slow
@given(st.floats(0.0, 1.0), st.sampled_from(NUMBERS))
def test_place_is_the_inverse_of_at(place, field):
    value = field.at(place)
    # A value has three digits, a count is whole.
    size = max(abs(field.low), abs(field.high))
    error = 0.51 if field.kind == "count" else 0.006 * abs(value) + 1e-12 * size
    back = field.place(value)
    far = abs((field.low * (field.high / field.low) ** back if field.log else 0.0) - value)
    far = far if field.log else abs(field.low + (field.high - field.low) * back - value)
    assert far <= error or back in (0.0, 1.0)
    assert field.place(field.low) == 0.0
    assert field.place(field.high) == 1.0


@each(
    "text, unit, number",
    [
        ("1.8 kN", "N", 1800.0),
        ("1800N", "N", 1800.0),
        ("343.15 K", "degC", 70.0),
        ("70 °C", "degC", 70.0),
        ("100 rad/s", "rpm", 954.929658551),
        ("46 cSt", "mm^2/s", 46.0),
        ("15 kV/mm", "V/um", 15.0),
        ("15 MV/m", "V/um", 15.0),
        ("4.5e-8 m", "um", 0.045),
        ("0.87 g/cm^3", "kg/m^3", 870.0),
        ("1.8 kN", "V", None),
        ("1,8 kN", "N", None),
        ("a lot", "N", None),
        ("3 furlong", "mm", None),
        ("1" * 300, "N", None),
    ],
)
def test_texts_as_numbers_of_a_slider(text, unit, number):
    """Expected: definitions of the units. A unit of another quantity leaves the slider where it is."""
    found = in_unit(text, unit)
    assert found == (None if number is None else pytest.approx(number))


def test_typed_texts():
    load = Field("bearing.radial_load", "Load", "N", 0.0, 1e4)
    assert load.from_text(" 1800 ") == "1800 N"
    assert load.from_text("1.8 kN") == "1.8 kN"
    assert load.from_text("1,8 kN") == "1,8 kN"
    assert load.from_text("") is None
    groove = Field("bearing.inner_groove", "Groove", low=0.5, high=0.6)
    assert groove.from_text("0.52") == 0.52
    assert groove.from_text("wide") == "wide"
    balls = Field("bearing.elements", "Balls", low=3, high=40, kind="count")
    assert balls.from_text("9") == 9
    assert isinstance(balls.from_text("9"), int)
    assert balls.from_text("9.5") == 9.5


def test_bare_numbers_of_a_file_are_shown_in_si_units():
    rq = Field("bearing.composite_rq", "Roughness", "um", 0.005, 1.0, log=True)
    assert rq.text(3e-08) == "3e-08 m"
    assert rq.number(3e-08) == pytest.approx(0.03)
    fill = Field("bearing.fill", "Fill", "%", 0.0, 100.0)
    assert fill.text(0.3) == "30 %"


def test_every_choice_of_the_library_is_taken():
    for key, found in choices().items():
        assert found, key
        assert all(choice.label for choice in found)
    listed = {field.key for field in FIELDS if field.kind == "choice" and not field.choices}
    assert listed <= set(choices())


@each("field", [field for field in FIELDS if field.choices], ids=by_key)
def test_words_of_choices_are_those_of_the_key(field):
    if field.key == "lubricant.temperature.iso_vg":
        assert {int(word) for word in field.choices} <= set(GRADES)
    else:
        assert all(repr(word) in str(input_field(field.key).annotation) for word in field.choices)


def test_starts_of_groups_and_ways_have_known_keys():
    for group in BEARING_GROUPS:
        for key in group.start:
            input_field(f"{group.table}.{key}")
        for field in group.fields:
            for way in field.alternatives:
                for key in way.changes:
                    if key != "bearing.fits":
                        input_field(key)
