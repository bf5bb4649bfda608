"""Whatever becomes of a contact, its result is written whole, without NaN, and read back equal."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import Case, load, save, solve
from tests.helpers.strategies import discharges


def powers_of_ten(low, high):
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


rough = st.fixed_dictionaries(
    {
        "surface": st.sampled_from([1, 2]),
        "generator": st.just("gaussian"),
        "rq": powers_of_ten(-9.0, -6.5),
        "correlation_length": powers_of_ten(-1.5, -0.3),
        "seed": st.integers(0, 99),
    }
)
# From a film thinner than an atom to one without a contact; what is not solved is written like any other.
contacts = st.fixed_dictionaries(
    {
        "contact": st.fixed_dictionaries(
            {
                "reduced_radius": st.just(0.01),
                "reduced_modulus": powers_of_ten(10.5, 12.0),
                "max_hertz_pressure": powers_of_ten(7.0, 9.5),
                "entrainment_speed": powers_of_ten(-6.0, 1.5),
            }
        ),
        "lubricant": st.fixed_dictionaries(
            {"base": st.just("paper"), "viscosity_law": st.sampled_from(["roelands", "barus", "constant"])}
        ),
        "roughness": st.lists(rough, max_size=1),
        "electric": st.fixed_dictionaries(
            {"potential_1": st.just(0.0), "potential_2": powers_of_ten(-5.0, 6.0)}
        ),
        "discharge": st.one_of(st.none(), discharges),
        "grid": st.fixed_dictionaries(
            {
                "nodes": st.integers(65, 300),
                "wedge": st.sampled_from(["first-order", "second-order", "third-order"]),
            }
        ),
        "solver": st.fixed_dictionaries({"max_iterations": st.sampled_from([1, 5, 30, 30])}),
    }
)


def assert_equal(read, original):
    """Field by field, arrays to the last bit."""
    assert type(read) is type(original)
    for field in dataclasses.fields(original):
        ours, theirs = getattr(read, field.name), getattr(original, field.name)
        if dataclasses.is_dataclass(theirs) and not isinstance(theirs, type):
            assert_equal(ours, theirs)
        elif isinstance(theirs, np.ndarray):
            np.testing.assert_array_equal(ours, theirs, err_msg=field.name)
        else:
            assert ours == theirs, field.name


def with_lengths(table):
    """The correlation length, drawn in half-widths 4 R p_h/E', in metres."""
    contact = table["contact"]
    half_width = 4.0 * contact["reduced_radius"] * contact["max_hertz_pressure"] / contact["reduced_modulus"]
    scaled = [
        each | {"correlation_length": half_width * each["correlation_length"]} for each in table["roughness"]
    ]
    return table | {"roughness": scaled}


@pytest.mark.slow
@settings(deadline=None, max_examples=15)
@given(table=contacts.map(with_lengths))
def test_any_result_survives_the_disk(table, tmp_path_factory):
    result = solve(Case.from_dict(table))
    folder = tmp_path_factory.getbasetemp() / "round-trip"
    summary_file, result_file, _ = save(result, folder)
    written = json.loads(summary_file.read_text(encoding="utf-8"), parse_constant=pytest.fail)
    back = load(result_file)
    assert_equal(back, result)
    assert written == back.summary()
    assert written["converged"] == result.film.converged == (written["status"] == "converged")
