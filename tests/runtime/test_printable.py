"""Texts of users where they are shown: one printable line on a terminal, no markup and no formula."""

import csv
import io
import logging
import unicodedata
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from rich.console import Console

from ehlectric.cases.case import Case
from ehlectric.commands.terminal import echo_files, say, warn
from ehlectric.errors import InputError, printable, short, shown, unseen
from ehlectric.figures.figure_names import literal
from ehlectric.figures.style import name_over, save_figure
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.rows import Row
from ehlectric.runtime.files import _FORMULA, csv_of, csv_text, write
from ehlectric.runtime.progress import log_warnings
from ehlectric.sweep.points import Point
from ehlectric.sweep.result import write_tables
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.tables.html_tables import html_of
from ehlectric.tables.measured_tables import table_of
from tests.helpers.each import each
from tests.helpers.sweep_models import SPEED, grid

# Characters that a terminal obeys or that are not seen, by name.
HIDDEN = {
    "escape": "\x1b",
    "line feed": "\n",
    "carriage return": "\r",
    "next line": "\x85",
    "one of C1": "\x9b",
    "line separator": "\u2028",
    "paragraph separator": "\u2029",
    "right-to-left override": "\u202e",
    "isolate": "\u2066",
    "zero width space": "\u200b",
    "byte order mark": "\ufeff",
    "half of a pair": "\udc80",
}
LETTERS = [pytest.param(letter, id=name) for name, letter in HIDDEN.items()]
FORMULAS = ("=HYPERLINK(A1)", "+1", "-1+cmd", "@SUM(A1)", "\t=1", "\r=1", "'=1", "''-1", "'", "")
TITLES = st.text(max_size=30) | st.sampled_from([*HIDDEN.values(), *FORMULAS, "$\\frac{$", "[red]", "<b>&"])


@given(TITLES)
def test_any_text_gives_one_printable_line(text):
    line = printable(text)
    assert not any(unseen(letter) for letter in line)
    assert len(line.splitlines()) <= 1
    assert printable(line) == line
    assert (line == text) == (not any(unseen(letter) for letter in text))


def test_ordinary_texts_stay_as_they_are():
    for text in ("6208, 70 °C, λ = 1.2", "µm²\xa0–\u2009Ω", r"C:\new\table", "日本語", "Größe 🙂"):
        assert printable(text) == text
    assert printable("a\x1b[31mb\nc\u202ed") == r"a\x1b[31mb\nc\u202ed"


@given(TITLES, TITLES, TITLES)
def test_no_error_of_an_input_holds_a_character_that_a_terminal_obeys(key, got, takes):
    for error in (
        InputError(key, got=got, takes=takes),
        InputError(Path(f"{key}.toml".replace("\0", "")), got),
        InputError.worded(key, got),
        InputError.unknown(key, got),
        InputError(got).under(key),
    ):
        assert not any(unseen(letter) for letter in str(error))


@given(st.text(max_size=200) | st.integers() | st.lists(st.text(), max_size=20))
def test_values_are_shown_in_at_most_80_characters(value):
    assert len(shown(value)) <= 80
    assert len(shown({"a": [value] * 10, "b": value})) <= 80


def test_the_ends_of_a_long_value_are_shown():
    assert short("0123456789", 10) == "0123456789"
    assert short("0123456789a", 10) == "0123...89a"
    assert len(short("x" * 1000)) == 80


@each("letter", LETTERS)
def test_titles_in_files_have_no_character_that_is_not_seen(letter):
    table = {
        "title": f"a{letter}b",
        "contact": {
            "reduced_radius": "10 mm",
            "reduced_modulus": "220 GPa",
            "load_per_length": "100 kN/m",
            "entrainment_speed": "1 m/s",
        },
        "lubricant": {"base": "paper"},
    }
    for read in (Case.from_written, lambda t: Sweep.from_written({"case": t, "vary": {"grid.nodes": [401]}})):
        with pytest.raises(InputError, match="title: got") as refused:
            read(table)
        assert not any(unseen(sign) for sign in str(refused.value))
    if unicodedata.category(letter) in ("Cf", "Zl", "Zp"):
        # Results of earlier versions may have such titles.
        case = Case.from_dict(table)
        assert case.title == f"a{letter}b"
        assert letter not in repr(case)
        assert letter not in html_of(case)


@each("letter", LETTERS)
def test_what_is_printed_obeys_no_terminal(capsys, caplog, letter):
    capsys.readouterr()
    caplog.clear()
    say(f"written: a{letter}b")
    warn([f"a{letter}b", ResultWarning("not-converged", f"x{letter}y")])
    echo_files([Path(f"results{letter}1") / f"film{letter}.png"])
    echo_files([Path(f"results{letter}2") / f"{name}{letter}.png" for name in "ab"])
    out, err = capsys.readouterr()
    seen = f"{out}{err}"
    assert out.count("\n") == 4
    assert err.count("\n") == 2
    assert not any(unseen(sign) for sign in seen.replace("\n", ""))
    assert printable(letter) in seen
    with caplog.at_level(logging.INFO, logger="ehlectric"):
        log_warnings(f"t{letter}", [ResultWarning("not-converged", f"x{letter}y")])
    assert caplog.messages == [printable(f"t{letter}: x{letter}y [not-converged]")]


def drawn(table):
    console = Console(file=io.StringIO(), width=200, highlight=False)
    console.print(table)
    return console.file.getvalue()


@each("letter", LETTERS)
def test_tables_obey_no_terminal_and_no_markup(letter):
    rows = [Row(f"[red]a{letter}"), Row(f"[/b]{letter}", f"v{letter}", note=f", n{letter}")]
    text = drawn(table_of(rows, f"[bold]title{letter}"))
    assert not any(unseen(sign) for sign in text.replace("\n", ""))
    for part in ("[red]a", "[/b]", "[bold]title"):
        assert f"{part}{printable(letter)}" in text


def test_html_has_the_title_as_text():
    page = html_of(replace(grid({SPEED: [1.0, 2.0]}), title="<script>alert(1)</script>\u202e"))
    assert "<script" not in page
    assert r"&lt;script&gt;alert(1)&lt;/script&gt;\u202e" in page


@pytest.mark.slow
@pytest.mark.parametrize(
    "title", ["$", "$$", r"$\frac{$", r"\$a$", "$x^{" * 50 + "$", "a\x1b[0m", "\u202eabc", "_a", "a" * 200]
)
@pytest.mark.parametrize("kind", ["png", "svg"])
def test_any_title_can_be_drawn_as_text(tmp_path, title, kind):
    figure = Figure(figsize=(3, 2))
    ax = figure.subplots()
    ax.plot([0, 1], [0, 1], label=f"file {literal(title)}")
    ax.legend()
    name_over(ax, f"finding\n{title}")
    (path,) = save_figure(figure, tmp_path / "figure.png", [kind])
    content = path.read_bytes()
    assert b"\x1b[0m" not in content
    assert "\u202e".encode() not in content
    assert figure.get_label() == f"finding. {printable(title)}"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["screen", "journal"])
def test_texts_of_a_varied_key_are_no_formulas_in_the_legend_of_a_figure(kind):
    texts = ["$\\frac{$", "one $ more", "\u202ea", "_b"]
    results = grid({SPEED: [1.0, 2.0, 4.0], "title": texts})
    figure = results.plot("lines_discharge.margin", x=SPEED, y="title", style=kind)
    drawn = FigureCanvasAgg(figure)
    drawn.draw()
    entries = [text.get_text() for legend in figure.findobj(Legend) for text in legend.get_texts()]
    for text in texts[:3]:
        assert literal(text) in entries
    assert "\u202ea" not in entries


@given(TITLES)
def test_a_text_in_a_csv_is_no_formula_and_comes_back(text):
    cell = csv_text(text)
    assert not cell.startswith(("=", "+", "-", "@", "\t", "\r", "\n"))
    # The way back is known from the cell alone.
    assert (cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell) == text
    file = io.StringIO(newline="")
    csv.writer(file).writerow([cell, "end"])
    assert next(csv.reader(io.StringIO(file.getvalue(), newline="")))[0] == cell


def test_numbers_in_a_csv_stay_numbers(tmp_path):
    rows = [["=1+1", -1.5], ["-2", -3], ["\udc80", None]]
    write(tmp_path / "a.csv", csv_of(["=head", "x [m]"], rows))
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    assert rows == [["'=head", "x [m]"], ["'=1+1", "-1.5"], ["-2", "-3"], [r"\udc80", ""]]


@pytest.mark.slow
@pytest.mark.parametrize("title", [text for text in FORMULAS[:-2] if "\r" not in text])
def test_titles_and_reasons_in_sweep_csv_are_no_formulas(tmp_path, title):
    results = grid({"title": [title, "b"], "electric.potential_2": [-3.0]})
    failed = Point(0, results.points[0].inputs, "failed", reason=f"{title}.csv: cannot be read")
    write_tables(replace(results, points=(failed, *results.points[1:])), tmp_path)
    with (tmp_path / "sweep.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["title"] == f"'{title}"
    assert rows[0]["reason"] == f"'{title}.csv: cannot be read"
    assert [float(row["electric.potential_2 [V]"]) for row in rows] == [-3.0, -3.0]


def test_a_carriage_return_in_a_text_breaks_no_line_of_sweep_csv(tmp_path):
    results = grid({SPEED: [1.0, 2.0]})
    failed = Point(0, results.points[0].inputs, "failed", reason="\r=1\ntwo")
    write_tables(replace(results, points=(failed, *results.points[1:])), tmp_path)
    with (tmp_path / "sweep.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["number"] for row in rows] == ["0", "1"]
    assert rows[0]["reason"] == "\\r=1\ntwo"
