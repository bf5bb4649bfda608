"""Changes of remedies in reports: each row has the value before and after, of both ends."""

from ehlectric.report.drive_report import changed_inputs
from tests.helpers.drives import small_drive
from tests.helpers.each import each

BOTH, DRIVE, OTHER = ", both bearings", ", drive end", ", non-drive end"
ALUMINA = {"bearings.bearing.coating": "alumina"}


def rows(before, changes):
    case = small_drive(**before)
    return [
        (name.text, *(text.replace("\xa0", " ") for text in values))
        for name, *values in changed_inputs(case, case.replace(changes), changes)
    ]


@each(
    ("before", "changes", "expected"),
    [
        # The name of a library stands for a table.
        ({}, ALUMINA, [(f"coating{BOTH}", "not given", "alumina")]),
        (ALUMINA, {"bearings.bearing.coating": {"base": "skf-insocoat-vl0241", "relative_permittivity": 9}},
         [(f"coating{BOTH}", "alumina", "skf-insocoat-vl0241"),
          (f"relative permittivity of the coating{BOTH}", "9", "9")]),
        (ALUMINA, {"bearings.bearing.coating.thickness": "200 um"},
         [(f"coating thickness{BOTH}", "0.1 mm", "0.2 mm")]),
        (ALUMINA, {"bearings.bearing.coating": {"thickness": "50 um", "relative_permittivity": 8,
                                                "ring": "outer"}},
         [(f"coating thickness{BOTH}", "0.1 mm", "50 µm"),
          (f"relative permittivity of the coating{BOTH}", "9", "8"),
          (f"coated ring{BOTH}", "outer", "outer")]),
        # A change to what is there already.
        (ALUMINA, ALUMINA, [(f"coating{BOTH}", "alumina", "alumina")]),
        # Both ends differ before the change.
        ({"drive_end.bearing.coating": "alumina"}, ALUMINA,
         [(f"coating{BOTH}", f"alumina{DRIVE}; not given{OTHER}", "alumina")]),
        ({"non_drive_end.bearing.radial_load": "900 N"}, {"bearings.bearing.radial_load": "1 kN"},
         [(f"radial load{BOTH}", f"1.8 kN{DRIVE}; 900 N{OTHER}", "1 kN")]),
        # Inputs of one end, and of none.
        ({}, {"non_drive_end.bearing.coating": "alumina"}, [(f"coating{OTHER}", "not given", "alumina")]),
        ({}, {"bearings.lubricant.base": "fva-3"}, [(f"lubricant{BOTH}", "paper", "fva-3")]),
        ({}, {"circuit.grounding_ring_resistance": "1 ohm"},
         [("resistance of the grounding ring", "not given", "1 Ω")]),
        ({}, {"bearings.bearing.element_material": "silicon-nitride"},
         [(f"element material{BOTH}", "steel", "silicon-nitride")]),
    ],
)  # fmt: skip
def test_a_change_has_the_values_before_and_after(before, changes, expected):
    assert rows(before, changes) == expected
