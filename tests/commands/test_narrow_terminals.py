"""Tables in narrow terminals: every number of the wide table is there, and nothing is cut."""

import re
from collections import Counter

import pytest
from rich.console import Console

from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.narrow_tables import fitted
from tests.helpers.places import EXAMPLES

BEARING = EXAMPLES / "bearing_6208.toml"

# Widest word that is never broken [characters]: longer ones are addresses and formulas of chemistry.
WORD = 14


def numbers_of(output):
    """Words with digits of an output, with their counts."""
    timeless = re.sub(r"computing\s+time\s+\S+", "", output)
    found = (word.strip("(),;") for word in timeless.split())
    return Counter(word for word in found if any(map(str.isdigit, word)) and len(word) <= WORD)


def assert_nothing_is_lost(typed, monkeypatch, words, widths):
    """Compare with the table at a width at which nothing is broken. Returns the outputs by width."""
    outputs = {}
    for width in (400, *widths):
        monkeypatch.setenv("COLUMNS", str(width))
        done = typed(*words)
        assert done.returncode == 0, done.stderr
        outputs[width] = done.stdout
    for width in widths:
        # A list may repeat what a column has once.
        assert numbers_of(outputs[400]) - numbers_of(outputs[width]) == Counter(), width
        assert "…" not in outputs[width]
    return outputs


def test_every_number_of_a_check_is_in_a_narrow_table(typed, case_file, monkeypatch):
    widths = (20, 24, 33, 40, 45, 50, 60, 72)
    outputs = assert_nothing_is_lost(typed, monkeypatch, ("check", case_file), widths)
    for width in widths:
        lines = [line.rstrip() for line in outputs[width].splitlines()[:30]]
        assert max(map(len, lines)) <= width
        # A number keeps its unit, beside its label or below it.
        (at,) = (k for k, line in enumerate(lines) if line.strip().startswith("maximum Hertzian"))
        assert any(line.endswith(" 1 GPa") for line in lines[at : at + 3]), lines


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ("check", BEARING),
        ("check", EXAMPLES / "drive.toml"),
        ("oils",),
        ("oil", "fva-3"),
        ("bearings",),
        ("surface", EXAMPLES / "surfaces" / "dektak-1.csv"),
        ("film", "--m", "20", "--l", "10"),
        ("bearing", BEARING, "--contacts", "formula", "--no-plots"),
    ],
)
def test_every_number_of_a_command_is_in_a_narrow_table(typed, monkeypatch, words):
    assert_nothing_is_lost(typed, monkeypatch, words, (20, 45))


HEADS = ("name", "speed\n[rpm]", "permit-\ntivity")
ROWS = [("first bearing", "3000", "2.2"), ("second bearing", "4500", "")]


def lines_at(width, table, capsys):
    Console(width=width).print(fitted(table, width))
    return [line.rstrip() for line in capsys.readouterr().out.splitlines()]


def test_columns_become_a_list_where_they_do_not_fit(capsys):
    table = columns_table(HEADS, ROWS, "Title")
    assert fitted(table, 40) is table
    assert lines_at(24, table, capsys) == [
        "Title",
        "first bearing",
        "  speed [rpm]  3000",
        "  permittivity 2.2",
        "second bearing",
        "  speed [rpm]  4500",
    ]


def test_a_number_in_the_first_column_keeps_its_head(capsys):
    table = columns_table(("line", "a long head", "another long head"), [("1", "2.5", "3.5")])
    assert lines_at(24, table, capsys)[0] == "line 1"


def test_a_column_without_a_head_has_the_units_of_its_rows(capsys):
    table = columns_table(("", "drive end", "other end", ""), [("peak voltage", "3.31", "3.3", "V")])
    expected = ["peak voltage [V]", "  drive end 3.31", "  other end 3.3"]
    assert lines_at(20, table, capsys) == expected
