"""Cases from keywords: every wrong input is an InputError, and keywords are the keys of the tables."""
# ruff: noqa: E501

import inspect
import pickle
import pydoc
import re
import warnings

import pint
import pytest

from ehlectric import BearingCase, Case, DriveCase, InputError, LineCase, PointCase
from ehlectric.cases.bearing_inputs import Bearing, BearingKeys
from ehlectric.cases.contact_inputs import Contact, LineKeys, PointKeys
from ehlectric.cases.keywords import keys_of
from ehlectric.quantities.alternatives import ONLY
from tests.helpers.each import each

LINE = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": 226e9,
    "max_hertz_pressure": "1 GPa",
    "entrainment_speed": 4.0,
}
BALL = {"radius_x": 0.01, "radius_y": "10 mm", "reduced_modulus": 226e9, "load": 20, "entrainment_speed": 2.0}
DUTY = {
    "base": "6208",
    "radial_clearance": "10 um",
    "radial_load": "1 kN",
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": 3e-8,
}


@pytest.fixture
def line():
    return Case.line(**LINE, lubricant="paper")


@pytest.mark.parametrize(("keys", "other"), [(LineKeys, "point"), (PointKeys, "line")])
def test_keywords_are_the_keys_of_a_contact(keys, other):
    assert set(keys_of(keys)) == set(Contact.known_keys()) - {"geometry"} - set(ONLY[other])


def test_keywords_are_the_keys_of_a_bearing():
    assert set(keys_of(BearingKeys)) == set(Bearing.known_keys())


@each(
    "constructor, keys",
    [(Case.line, LineKeys), (Case.point, PointKeys), (BearingCase.of, BearingKeys)],
)
def test_editors_see_the_keywords(constructor, keys):
    parameters = inspect.signature(constructor).parameters
    assert {"lubricant", "title", *keys_of(keys)} <= set(parameters)
    assert not any(p.kind is inspect.Parameter.VAR_KEYWORD for p in parameters.values())


@each(
    "constructor, entries",
    [
        (Case.line, ["load_per_length : number [N/m], load per length", "temperature : number [K], temperature of the oil"]),
        (Case.point, ["radius_x : number [m]", "load : number [N], load", "lubricant : mapping or name,"]),
        (BearingCase.of, ["inner_speed : number [rad/s], speed of the inner ring", "elements : int, number of rolling elements Z", "coating : mapping or name table"]),
    ],
)  # fmt: skip
def test_help_shows_type_unit_and_meaning_of_every_keyword(constructor, entries):
    text = pydoc.render_doc(constructor, renderer=pydoc.plaintext)
    shown = re.findall(r"^ {4}(\w+) : \S", text, re.MULTILINE)
    assert sorted(shown) == sorted(inspect.signature(constructor).parameters)
    assert all(entry in " ".join(text.split()) for entry in entries), text
    listed = text.partition("Parameters")[2].splitlines()
    assert len(listed) <= 110
    assert max(map(len, listed)) <= 110


def test_help_shows_the_keys_and_units_of_a_drive():
    text = " ".join(pydoc.render_doc(DriveCase, renderer=pydoc.plaintext).replace("|", " ").split())
    for entry in ("dc_link [V]", "ground_inductance [H]", "arc_resistance [Ω]", "speed [rad/s]"):
        assert entry in text, entry


def test_a_line_contact(line):
    table = {"contact": {"geometry": "line", **LINE}, "lubricant": {"base": "paper"}}
    assert line == Case.from_dict(table) == Case(**table)
    assert Case.from_dict(table) == line
    assert isinstance(line, LineCase)
    assert hash(line) == hash(Case.from_dict(table))
    assert pickle.loads(pickle.dumps(line)) == line
    assert line.contact.reduced_radius == 0.0141


def test_a_point_contact():
    ball = Case.point(**BALL, lubricant="paper", grid={"nodes": 65}, title="Ball")
    assert isinstance(ball, PointCase)
    assert (ball.grid.nodes, ball.title, ball.contact.load) == (65, "Ball", 20.0)
    assert ball.grid.side == Case.from_dict(ball.to_dict()).grid.side


def test_a_bearing():
    oil = {"base": "paper", "viscosity": "20 mPa s"}
    case = BearingCase.of(**DUTY, lubricant=oil)
    assert case == BearingCase.from_dict({"bearing": DUTY, "lubricant": oil})
    assert case == BearingCase(bearing=DUTY, lubricant=oil)
    assert case.bearing.inner_speed == pytest.approx(314.159, rel=1e-5)


def test_quantities_of_pint(line):
    unit = pint.UnitRegistry()
    given = {"reduced_radius": unit.Quantity(14.1, "mm"), "max_hertz_pressure": unit.Quantity(1.0, "GPa")}
    assert Case.line(**(LINE | given), lubricant="paper") == line
    with pytest.raises(InputError, match=r"contact\.reduced_radius"):
        Case.line(**(LINE | {"reduced_radius": unit.Quantity(1.0, "N")}), lubricant="paper")


@each(
    "make, key, text",
    [
        (lambda: Case.line(**LINE, reduced_radus=1.0, lubricant="paper"), "contact.reduced_radus", "contact.reduced_radius"),
        (lambda: Case.line(**LINE, lubricant="papper"), "lubricant.base", "paper"),
        (lambda: Case.line(**LINE, lubricant="paper", discharge={"strength": 1}), "discharge.strength", "nearest"),
        (lambda: Case.line(**(LINE | {"entrainment_speed": "4 kg"}), lubricant="paper"), "contact.entrainment_speed", "4 kg"),
        (lambda: Case.line(**LINE, radius_x=1.0, lubricant="paper"), "contact.radius_x", "line contact"),
        (lambda: Case.point(**BALL, reduced_radius=1.0, lubricant="paper"), "contact.reduced_radius", "point contact"),
        (lambda: Case(contcat=LINE, lubricant={"base": "paper"}), "contcat", "contact"),
        (lambda: Case(contact=LINE), "lubricant", "missing"),
        (lambda: Case(contact=5, lubricant={"base": "paper"}), "contact", "a table"),
        (lambda: BearingCase.of(**DUTY, lubricant="paper", fil="air"), "bearing.fil", "bearing.fill"),
        (lambda: BearingCase(bearing=DUTY, lubricant={}, motr={}), "motr", "motor"),
        (lambda: LineCase(contact={"geometry": "point", **BALL}, lubricant={"base": "paper"}), "contact.geometry", "'line'"),
    ],
)  # fmt: skip
def test_wrong_keywords(make, key, text):
    with pytest.raises(InputError) as caught:
        make()
    assert caught.value.key == key
    assert text in str(caught.value)


def test_a_case_that_moves_is_no_line_case(line):
    rough = {"surface": 1, "generator": "sinusoid", "amplitude": 1e-8, "wavelength": 1e-4}
    with pytest.raises(InputError, match=r"^motion: .*LineCase"):
        line.replace(roughness=(rough,), motion={"passes": 1.0})


def test_assignment_is_refused(line):
    for change in (
        lambda: setattr(line, "title", "B"),
        lambda: setattr(line.grid, "nodes", 801),
        lambda: delattr(line, "title"),
        lambda: setattr(line, "no_such_key", 1),
    ):
        with pytest.raises(InputError, match="frozen"):
            change()
    assert line == Case.line(**LINE, lubricant="paper")


def test_completion_has_no_names_of_pydantic(line):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        names = dir(line)
    assert not {"parse_obj", "construct", "dict", "json", "model_dump"} & set(names)
    assert {"contact", "lubricant", "replace", "from_dict", "from_toml", "to_toml", "line", "point"} <= set(
        names
    )


def test_an_error_in_a_table_within_a_table_has_its_whole_key():
    """Tables are not made by their constructors here, which would lose the table of the key."""
    bad = {"contact": LINE | {"body_1": {"youngs_modulu": 1}}, "lubricant": {"base": "paper"}}
    with pytest.raises(InputError) as caught:
        Case.from_dict(bad)
    assert caught.value.key == "contact.body_1.youngs_modulu"


def test_a_missing_lubricant_is_told_as_every_missing_key():
    for make in (Case.line, Case.point, BearingCase.of):
        with pytest.raises(InputError, match=r"^lubricant: missing"):
            make()
