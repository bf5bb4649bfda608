"""Rows of a measurement in the units of their heads, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.tables.measured_tables import rows_table


@pytest.mark.parametrize(
    ("quantity", "measured", "expected"),
    [
        ("capacitance", [250e-12, 300e-12], ["rpm", "3000", "250", "200", "1.250", "0.05"]),
        ("film", [250e-9, 300e-9], ["m/s", "314.2", "250", "200", "1.250", "0.05"]),
    ],
)
def test_a_row_has_its_numbers_in_the_units_of_the_heads(quantity, measured, expected):
    """100 pi rad/s are 3000 rpm; the second row has no factor."""
    columns = {
        "line": np.array([2.0, 3.0]),
        "speed": np.array([100.0 * math.pi] * 2),
        quantity: np.array(measured),
        "computed": 0.8 * np.array(measured),
        "film_factor": np.array([1.25, math.nan]),
        "factor_uncertainty": np.array([0.05, math.nan]),
    }
    factors = SimpleNamespace(
        quantity=quantity, columns=columns, reasons=("", "too small"), speed_key="speed"
    )
    table = rows_table(factors)
    cells = [list(column.cells) for column in table.columns]
    heads = [str(column.header) for column in table.columns]
    unit = "pF" if quantity == "capacitance" else "nm"
    assert expected[0] in heads[1]
    assert all(f"[{unit}]" in head for head in heads[2:4])
    assert [str(cell[0]) for cell in cells] == ["2", *expected[1:]]
    assert [str(cell[1]) for cell in cells][4:] == ["none", ""]
