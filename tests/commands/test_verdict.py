"""Verdicts on the terminal: in colour there, and plain lines, which do not wrap, for everybody else."""

from rich.console import Console

from ehlectric.commands.terminal import print_verdict
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.tables.probability_rows import input_range
from tests.helpers.each import each

# A verdict whose one line is longer than a terminal is wide.
REASON = Statement.of("neglected", reason="words " * 30 + "end")
TEXT = "No breakdown expected\n  caution      Words " + "words " * 29 + "end.\n"


@each("level", ["green", "yellow", "red", "grey"])
def test_a_file_gets_lines_without_colours(capsys, level):
    print_verdict(Verdict(level, "breakdown-excluded", reasons=(REASON,)))
    assert capsys.readouterr().out == TEXT


@each(("level", "code"), [("green", "32"), ("yellow", "33"), ("red", "31"), ("grey", "1")])
def test_a_terminal_gets_the_colour_of_the_level(monkeypatch, level, code):
    """What is handed to ``typer.echo``, which takes colours away where stdout is no terminal."""
    said = []
    with monkeypatch.context() as patch:
        patch.setattr("typer.echo", lambda text, **_: said.append(text))
        patch.setattr(
            "rich.console.Console",
            lambda **options: Console(**options, force_terminal=True, color_system="standard", _environ={}),
        )
        print_verdict(Verdict(level, "breakdown-excluded", reasons=(REASON,)))
    heading, lines = said
    assert code in heading.partition("m")[0].partition("[")[2].split(";")
    assert "end." in lines
    assert lines.count("\n") > 2


def test_nothing_is_printed_without_a_verdict(capsys):
    print_verdict(None)
    assert capsys.readouterr().out == ""


@each(
    ("key", "ends", "text"),
    [
        ("bearing.radial_clearance", (5e-6, 15e-6), "5 to 15 µm"),
        ("bearing.contact_angle", (0.3490659, 0.5235988), "20 to 30 deg"),
        ("bearing.radial_load", (1440.0, 2160.0), "1440 to 2160 N"),
        ("bearing.inner_speed", (100.0, 200.0), "954.9 to 1910 rpm"),
        ("bearing.composite_rq", (2e-8, 4e-8), "20 to 40 nm"),
        ("bearing.film_factor", (0.5, 1.0), "0.5 to 1"),
        ("discharge.strength_table.strength", (0.8, 1.2), "0.8 to 1.2"),
        ("motor.winding_rotor_capacitance", (1e-11, 3e-11), "10 to 30 pF"),
    ],
)
def test_ranges_of_inputs_in_printed_units(key, ends, text):
    assert input_range({"key": key, "low_input": ends[0], "high_input": ends[1]}) == text
