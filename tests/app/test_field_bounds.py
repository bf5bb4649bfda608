"""Bounds of the fields of all pages, as the page states them in the unit of the field."""

import math
import re
import tomllib

import pytest

from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.axle_fields import axle_groups
from ehlectric.app.form_fields.contact_fields import groups_of
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS
from ehlectric.app.form_fields.field import in_field_unit
from ehlectric.app.form_fields.gear_fields import GEAR_GROUPS
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.amounts import amount_at
from ehlectric.cases.input_keys import kind_of
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.units import printed, to_si
from ehlectric.runs.example_files import example_text

PAGES = {
    "bearing": BEARING_GROUPS,
    "drive": DRIVE_GROUPS,
    "gear": GEAR_GROUPS,
    "axle": axle_groups(Inputs(tomllib.loads(example_text("e_axle")))),
    **{name: groups_of(name) for name in ("line", "point")},
}
WORDS = {"above": "above", "at least": "least", "below": "below", "at most": "most"}


def numbers(groups):
    fields = [field for group in groups for field in group.fields if field.kind == "number"]
    return [field for field in fields if input_at(field.key) is not None and input_at(field.key).unit]


@pytest.mark.parametrize("page", PAGES)
def test_every_bound_is_in_the_unit_of_its_field(page):
    """The stated bound, read back as a text with its unit, is the bound of the check in SI units."""
    stated = 0
    for field in numbers(PAGES[page]):
        amount = kind_of(field.key)
        amount = amount_at(field.key) if amount is None else amount
        if not field.unit or field.unit == "%":
            continue
        with pytest.raises(InputError) as caught:
            amount.parse("no number")
        text = in_field_unit(field, caught.value.text)
        unit = printed(field.unit)
        assert f"{unit} {unit}" not in text
        for words, name in WORDS.items():
            bound = getattr(amount, name)
            found = re.search(rf"\b{words} (\S+) {re.escape(unit)}(?:,| and|:|$)", text)
            assert (found is not None) == math.isfinite(bound), (field.key, words, text)
            if found is not None:
                stated += 1
                assert to_si(f"{found[1]} {field.unit}", amount.unit) == pytest.approx(
                    bound, rel=1e-4, abs=1e-12
                )
        # A second error with other numbers does not change what is stated.
        twice = in_field_unit(field, f"{caught.value.text}; also other: {caught.value.text}")
        assert twice.count(text.partition("expected ")[2]) == 2
    assert stated > 20
