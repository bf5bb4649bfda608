"""Every input: its bounds, and cases of all kinds to a file and back."""

import math
from typing import get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import Case, InputError
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.contact_inputs import Body, Contact
from ehlectric.cases.discharge_inputs import Discharge, Pit, Weibull
from ehlectric.cases.grid_inputs import Electric, Grid, Solver
from ehlectric.cases.roughness_inputs import Roughness
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each
from tests.helpers.strategies import tables

BODY = {"youngs_modulus": 2e11, "poissons_ratio": 0.3}
# Tables whose other keys are needed where one of them is given.
WHOLE = {
    "body_1": BODY,
    "weibull": {"scale": 3e7, "shape": 8.0, "reference_area": 1e-6},
    "pit": {"efficiency": 0.2, "melting_energy": 1e10},
}
PARTS = {
    "contact": Contact,
    "contact.body_1": Body,
    "lubricant": Lubricant,
    "electric": Electric,
    "discharge": Discharge,
    "discharge.weibull": Weibull,
    "discharge.pit": Pit,
    "grid": Grid,
    "solver": Solver,
    "roughness": Roughness,
}


# Tables with keys that stand for each other.
WITHOUT = ("contact", "lubricant", "discharge", "grid", "roughness")


def bounds_of(annotation):
    """The bounds that an annotation holds, in its own metadata or in that of an alternative."""
    for part in (*getattr(annotation, "__metadata__", ()), *get_args(annotation)):
        if isinstance(part, Amount | Count):
            return part
        found = bounds_of(part)
        if found is not None:
            return found
    return None


def numeric_inputs():
    for prefix, model in PARTS.items():
        for name, field in model.known_keys().items():
            for kind in (*field.metadata, bounds_of(field.annotation)):
                if isinstance(kind, Amount | Count):
                    yield f"{prefix}.{name}", kind


INPUTS = dict(numeric_inputs())


def case_with(key, value):
    """The table of a valid case but for one value."""
    table = {"contact": dict(PAPER_CONTACT), "lubricant": {"base": "paper"}}
    *parents, leaf = key.split(".")
    if parents == ["roughness"]:
        table["roughness"] = [{"surface": 1, "file": "surface.csv", leaf: value}]
        return table
    part = table
    for name in parents:
        part = part.setdefault(name, dict(WHOLE.get(name, {})))
    part[leaf] = [value, 1.0] if leaf == "field_range" else value
    return table


def refusal(key, value):
    with pytest.raises(InputError) as caught:
        Case.from_dict(case_with(key, value))
    return str(caught.value)


def outside(kind):
    """The numbers next to the bounds on their outer sides, and numbers far outside."""
    if isinstance(kind, Count):
        return [kind.least - 1, kind.most + 1, -(10**30), 10**30, kind.least + 0.5]
    numbers = [math.nextafter(kind.least, -math.inf), math.nextafter(kind.most, math.inf)]
    numbers += [kind.above, kind.below, -1e300, 1e300]
    return [
        x
        for x in numbers
        if math.isfinite(x) and not (kind.above < x < kind.below and kind.least <= x <= kind.most)
    ]


def test_every_number_has_bounds():
    """What a case file takes as a number is a quantity or a count: no other float or int."""
    assert len(INPUTS) > 50
    for prefix, model in PARTS.items():
        for name, field in model.known_keys().items():
            if {float, int} & {field.annotation, *get_args(field.annotation)}:
                assert f"{prefix}.{name}" in INPUTS


@pytest.mark.slow
@each("key", INPUTS)
def test_numbers_out_of_bounds_are_refused_by_name(key):
    kind = INPUTS[key]
    # The radius of a plane is infinite.
    infinite = [] if getattr(kind, "infinite", False) else [math.inf, -math.inf]
    for value in [*outside(kind), math.nan, *infinite, True, None, [], "x", ""]:
        if value is None and (
            key.split(".")[0] in WITHOUT
            or PARTS[key.rpartition(".")[0]].known_keys()[key.rpartition(".")[2]].default is None
        ):
            continue  # optional there
        message = refusal(key, value)
        assert message.startswith(f"{key}: got "), value
        assert "expected" in message
        assert "\n" not in message
        assert len(message) < 400


@each("key", [key for key, kind in INPUTS.items() if isinstance(kind, Amount)])
def test_bounds_are_the_same_in_any_unit(key):
    """A text is refused where its number is, and a bound that is allowed is allowed."""
    kind = INPUTS[key]
    for bound in (kind.least, kind.most):
        if math.isfinite(bound):
            assert kind.parse(bound) == bound
    if kind.unit:
        written = kind.unit.replace("*", " ")
        for value in outside(kind):
            if (
                abs(value) < 1e200
                and abs(value / kind.most - 1.0) > 1e-12
                and abs(value - kind.least) > 1e-12 * abs(value)
            ):
                assert refusal(key, f"{value!r} {written}").startswith(f"{key}: got ")
        absolute = kind.unit == "K" and not kind.difference
        kind_of = "an absolute temperature" if absolute else "this quantity"
        assert f"is not a unit of {kind_of}" in refusal(key, "1 kg")


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(table=tables)
def test_cases_of_all_kinds_survive_tables_and_files(table, tmp_path_factory):
    case = Case.from_dict(table)
    assert Case.from_dict(case.to_dict()) == case
    path = tmp_path_factory.getbasetemp() / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert Case.from_toml(path) == case
    assert case.replace() == case


# Those of a table that is there once, and not within another.
PLAIN = sorted(key for key in INPUTS if key.count(".") == 1 and not key.startswith("roughness"))


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(table=tables, key=st.sampled_from(PLAIN))
def test_a_wrong_number_is_found_in_any_case(table, key):
    name, leaf = key.split(".")
    table[name] = {**table.get(name, {}), leaf: [1e300, 1.0] if leaf == "field_range" else 1e300}
    with pytest.raises(InputError, match=f"^{key}: got ") as caught:
        Case.from_dict(table)
    assert "\n" not in str(caught.value)
