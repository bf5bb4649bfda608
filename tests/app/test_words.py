"""Texts of fields: bounds of errors in the unit of the field, signs of units, and long numbers."""

import re
import tomllib

import pytest

from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import in_field_unit, shown_text, written_text
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.amounts import Amount
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.cases.input_keys import input_field
from ehlectric.cases.table import number_of
from ehlectric.errors import InputError
from ehlectric.quantities.units import in_unit, printed, si_unit
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each

EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))
NUMBERS = [field for group in BEARING_GROUPS for field in group.fields if field.kind == "number"]
WITH_UNIT = [field for field in NUMBERS if field.unit not in ("", "%")]


def by_key(found):
    return found.key


def bounds(text):
    """Numbers of the bounds in a text, before the reason."""
    return re.findall(r"(?:above|at least|below|at most) (\S+) (mPa s|\S+?)(?=,| |$|:)", text)


@each("field", WITH_UNIT, ids=by_key)
def test_bounds_of_an_error_are_in_the_unit_of_the_field(field):
    """Expected: the bounds of the checks, which are in SI units."""
    kind = number_of(input_field(field.key))
    assert isinstance(kind, Amount)
    with pytest.raises(InputError) as error:
        kind.parse("fast", written=True)
    told = bounds(in_field_unit(field, error.value.text))
    known = [end for end in (kind.above, kind.least, kind.below, kind.most) if abs(end) < float("inf")]
    assert len(told) == len(known)
    for (number, unit), end in zip(told, known, strict=True):
        assert unit == printed(field.unit)
        expected = in_unit(f"{end:.15g} {si_unit(field.unit)}", field.unit)
        assert float(number) == pytest.approx(expected, rel=1e-4, abs=1e-9)
    assert "string" not in in_field_unit(field, error.value.text)


@each("field", WITH_UNIT, ids=by_key)
def test_a_text_in_a_box_is_written_back_as_it_was(field):
    for place in (0.0, 0.4, 1.0):
        written = field.from_slider(place)
        assert written_text(field, shown_text(field, written)) == written


@each("field", WITH_UNIT, ids=by_key)
def test_units_printed_are_taken(field):
    kind = number_of(input_field(field.key))
    assert isinstance(kind, Amount)
    text = field.from_slider(0.6)
    assert kind.parse(text.replace(field.unit, printed(field.unit))) == kind.parse(text)


@each(
    "key, written, expected",
    [
        ("bearing.inner_speed", "181.37993642342187 rad/s", "1732.0508 rpm"),
        ("bearing.inner_speed", "3000 rpm", "3000 rpm"),
        ("bearing.radial_load", "3 kN", "3 kN"),
        ("bearing.radial_load", "3 furlong", "3 furlong"),
        ("bearing.temperature", "343.1500000000001 K", "70 °C"),
        ("bearing.temperature", "warm", "warm"),
        ("lubricant.temperature.kinematic_viscosity_40", "46 mm^2/s", "46 mm²/s"),
    ],
)
def test_texts_in_boxes(key, written, expected):
    (field,) = [field for field in NUMBERS if field.key == key]
    assert shown_text(field, written) == expected


def test_an_error_of_a_whole_case_keeps_its_other_words():
    (field,) = [field for field in NUMBERS if field.key == "bearing.inner_speed"]
    with pytest.raises(InputError) as error:
        case_of_dict(EXAMPLE.changed({field.key: "-5 rpm"}).table, written=True)
    told = in_field_unit(field, error.value.text)
    assert "'-5 rpm'" in told
    assert "inner ring" in told
