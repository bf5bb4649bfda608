"""Changes that a form sends: a page that puts them into its inputs has what the form shows."""

import tomllib

from ehlectric.app.form_fields.field_rules import changed, custom_values
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.form import _sent
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each

EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))


@each(
    "changes",
    [
        {"bearing.radial_load": "2 kN"},
        {"bearing.axial_load": None},
        {"bearing.base": "nu-208"},
        {"bearing.film_factor": "inlet-shear"},
        {"lubricant.base": "fva-3"},
        {"motor": None},
        {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}},
        custom_values(EXAMPLE, "bearing.base"),
    ],
)
def test_what_is_sent_makes_the_inputs_of_the_form(changes):
    after = changed(EXAMPLE, changes)
    page = EXAMPLE
    for key, value in _sent(EXAMPLE, after, changes).items():
        page = page.changed({key: value})
    assert page == after


def test_one_key_is_sent_as_it_is():
    changes = {"bearing.radial_load": "2 kN"}
    assert _sent(EXAMPLE, changed(EXAMPLE, changes), changes) == changes
    assert _sent(EXAMPLE, EXAMPLE, {"bearing.radial_load": "1800 N"}) == {}
