"""Rows of an axle: a spread that its inputs predict only in part."""

from ehlectric.tables.axle_tables import chance_cells, chance_rows
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


def test_shares_above_all_are_explained():
    """60 % and 50 % add up to 110 %; 104 % is within the error of the shares."""
    index = {"low": None, "label": "input", "assumed": False, "key": "drive.torque"}
    for second, expected in ((0.5, "110 %"), (0.44, None)):
        indices = [index | {"total": share} for share in (0.6, second)]
        rows = [*chance_rows({"uncertainty": {"indices": indices, "predicted": 1.0}})]
        assert next((row.value for row in rows if row.name == "sum of these shares"), None) == expected


def test_probabilities_to_be_the_first_add_up_with_a_row_for_none():
    keys = ("breakdown_probability", "asperity_contact_probability", "conduction_probability")
    row = dict.fromkeys(keys, 0.0) | {"element": "bearing", "first_probability": 0.75}
    row |= {"voltage_ratio_low": 0.5, "voltage_ratio_high": None}
    _, *cells = chance_cells({"uncertainty": {"elements": [row], "none_first_probability": 0.25}})
    assert [cell[:2] for cell in cells] == [("bearing", "75"), ("none", "25")]
