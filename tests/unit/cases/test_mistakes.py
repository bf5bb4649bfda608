"""Mistakes in cases: names that mean another key, one mistake of a drive, and doubtful values in Python."""

import tomllib

import pytest

from ehlectric import Case, DriveCase, InputError
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.key_names import ALIASES
from ehlectric.cases.table import nearest_key
from tests.helpers.places import EXAMPLES

CONTACT = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
CONTACT |= {"entrainment_speed": "4 m/s", "lubricant": "paper"}


@pytest.mark.slow
def test_every_alias_leads_to_keys_that_exist():
    """A key whose name changes would otherwise stay in messages; an alias that became a key is none."""
    for name, keys in ALIASES.items():
        models = [m for m in (Case, BearingCase, DriveCase) if all(k in nearest_key(name, m) for k in keys)]
        assert models, name


@pytest.mark.parametrize(
    ("changes", "key", "number"),
    [
        ({"reduced_radius": "14.1 m"}, "contact.reduced_radius", "14.1 m"),
        ({"reduced_modulus": "226 MPa"}, "reduced modulus", "226 MPa"),
    ],
)
def test_a_doubtful_unit_is_a_warning_in_python(changes, key, number):
    with pytest.warns(UserWarning, match=key) as told:
        Case.line(**CONTACT | changes)
    assert number in str(told[0].message)
    # The warning names the line of the user.
    assert told[0].filename == __file__


def test_a_usual_contact_has_no_doubts():
    Case.line(**CONTACT)


def test_one_mistake_of_a_drive_is_told_once():
    """The bearing of the drive end stands at both ends, so that its mistake was that of both."""
    table = tomllib.loads((EXAMPLES / "drive.toml").read_text(encoding="utf-8"))
    table["drive_end"] = tomllib.loads((EXAMPLES / "bearing_thin_oil.toml").read_text(encoding="utf-8"))
    table["drive_end"]["contacts"] = "solvd"
    with pytest.raises(InputError) as told:
        DriveCase.from_dict(table)
    assert told.value.key == "drive_end.contacts"
    assert told.value.several == ()
