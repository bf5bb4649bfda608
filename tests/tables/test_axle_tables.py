"""Rows of an axle: a spread that its inputs predict only in part."""

from ehlectric.tables.axle_tables import chance_rows
from tests.helpers.each import each

SPREAD = {"indices": [], "deciding": [{"key": "a", "label": "input", "total": 0.5}]}


@each(
    "predicted, deciding, expected",
    [
        (0.95, 0.97, []),
        (0.704, 0.97, [("uncertainty.predicted", "70 % of the spread")]),
        (0.95, -0.2, [("uncertainty.deciding_predicted", "0 % of the spread")]),
        (0.95, None, []),
    ],
)
def test_rough_shares_are_named(predicted, deciding, expected):
    table = SPREAD | {"predicted": predicted, "deciding_predicted": deciding}
    rows = chance_rows({"uncertainty": table | {"deciding_elements": ["bearing", "mesh"]}})
    assert [(row.key, row.value) for row in rows if row.key.endswith("predicted")] == expected
