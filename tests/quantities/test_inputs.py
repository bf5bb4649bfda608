"""Book of inputs: one label for errors, forms, axes and descriptions; entries and sliders fit the keys."""

import pint
import pytest

from ehlectric.app.form_fields import BEARING_GROUPS, GEAR_GROUPS
from ehlectric.app.form_fields.axle_fields import AXLE_TEMPLATES
from ehlectric.app.form_fields.contact_fields import groups_of
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.cases.input_keys import input_field, input_of, tables_of_files
from ehlectric.cases.measurements import CYCLE
from ehlectric.cases.oil_inputs import law_parameters
from ehlectric.cases.table import annotation_of, number_of
from ehlectric.quantities.formats import scale_for
from ehlectric.quantities.inputs import (
    REPLACED,
    SPEED,
    TEMPERATURE,
    attributes,
    form,
    input_at,
    inputs,
    key_of_drive,
    key_of_list,
)
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each
from tests.helpers.moving_cases import TABLES as CONTACTS

UNITS = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
MODELS = {**tables_of_files(), "sweep": Sweep}
FORMS = {
    "bearing": BEARING_GROUPS,
    "line": groups_of("line"),
    "point": groups_of("point"),
    "gear": GEAR_GROUPS,
    "drive": [group for group in DRIVE_GROUPS if "end" not in group.title.split(":")[0]],
}
FIELDS = {
    (name, field.key): field
    for name, groups in FORMS.items()
    for group in groups
    for field in group.fields
    if field.kind != "alternatives"
}
KEYS = sorted({key for _, key in FIELDS} - {"title"})
# Keys of the fields of shafts, mounted bearings, meshes and links, of which an axle has several.
OF_AXLES = {key_of_list(field.key) for group in AXLE_TEMPLATES for field in group.fields}
CASE = case_of_dict({name: table for name, table in CONTACTS["line"].items() if name != "motion"})


@each("table", MODELS)
def test_every_key_has_an_entry_and_every_entry_a_key(table):
    laws = law_parameters() if table == "lubricant" else {}
    assert set(inputs()[table]) | set(laws) == set(MODELS[table].known_keys())


@each("unit", sorted({one.unit for table in inputs().values() for one in table.values() if one.unit}))
def test_a_scale_of_an_axis_is_its_unit(unit):
    scale = scale_for(3e-6, unit)
    # Pint reads the printed unit.
    assert UNITS.Quantity(1.0, scale.unit).to(unit).magnitude * scale.factor == pytest.approx(1.0)


def test_every_table_of_the_book_is_one_of_a_file():
    assert set(inputs()) == set(MODELS)


@each("name", law_parameters())
def test_a_parameter_of_a_law_is_described_once(name):
    parameter = law_parameters()[name]
    own = bool(parameter.meaning and parameter.title and parameter.symbol)
    assert own != (name in inputs()["lubricant"])
    assert own or not (parameter.meaning or parameter.title or parameter.symbol)


@each("key", KEYS)
def test_labels_of_forms_errors_and_axes_are_the_same(key):
    label = input_at(key).label
    fields = [field for (_, found), field in FIELDS.items() if found == key]
    assert {field.label for field in fields} == {label[0].upper() + label[1:]}
    assert label_of(f"inputs.{key}", CASE).name == input_of(key).label == label


@each("table", inputs())
def test_every_entry_has_a_label_and_a_meaning(table):
    for entry in inputs()[table].values():
        assert entry.label == entry.label.strip()
        assert entry.meaning


@pytest.mark.parametrize("name", FORMS)
def test_fields_are_the_keys_of_the_form_in_their_order(name):
    listed = [key for keys in form(name).values() for key in keys]
    shown = [field.key for group in FORMS[name] for field in group.fields if field.kind != "alternatives"]
    # A drive has the title of its report in the group of a bearing.
    assert shown == [*listed, *(["title"] if name == "drive" else [])]
    assert len(set(listed)) == len(listed)


def test_an_input_with_a_field_is_in_a_form():
    sliding = {
        f"{table}.{key}" for table, keys in inputs().items() for key, entry in keys.items() if entry.shown
    }
    assert sliding <= {key_of_list(key).replace("body_1", "body") for key in KEYS} | OF_AXLES


@each("name, key", [place for place, field in FIELDS.items() if field.kind in ("number", "count")])
def test_ends_of_a_slider_are_allowed_and_have_the_unit_of_the_key(name, key):
    field = FIELDS[name, key]
    kind = number_of(input_field(key_of_list(key)))
    if (listed := annotation_of(input_field(key_of_list(key)))) is not None and kind is None:
        kind = listed.each
    assert field.low < field.high
    # A share of oil may also be a word, and is no quantity for the checks.
    if kind is not None:
        assert isinstance(kind, Count) == (field.kind == "count")
    for place in (0.0, 0.37, 1.0):
        written = field.from_slider(place)
        if isinstance(kind, Amount):
            kind.parse(written, written=True)
        elif kind is not None:
            kind.parse(written)


@each("key, above", REPLACED.items())
def test_a_key_of_a_drive_replaces_a_key_of_its_bearings_in_the_same_unit(key, above):
    assert input_at(key).unit == input_at(above).unit
    assert key_of_drive(key) == above


def test_columns_of_a_duty_cycle_replace_the_operating_point():
    keys = {name: column.key for name, column in CYCLE.columns.items()}
    assert (keys["speed"], keys["temperature"]) == (SPEED, TEMPERATURE)
    assert all(input_at(key).unit == CYCLE.columns[name].unit for name, key in keys.items() if key)


@each("name", ["default", "field", "help", "lists", "only_given"])
def test_attributes_of_fields_are_of_inputs_with_a_field(name):
    assert attributes(name).keys() <= {key_of_list(key) for _, key in FIELDS} | OF_AXLES
