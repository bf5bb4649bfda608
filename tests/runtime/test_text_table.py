"""Tables of text: any way to write the same numbers is read to these numbers, and errors name the line."""

from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.errors import InputError
from ehlectric.runtime import text_table
from ehlectric.runtime.text_table import Dialect, Layout, decimal_mark, decoded, layout_of, text_blocks
from tests.helpers.each import each

PATH = Path("table.csv")


def layout(text, **keywords):
    return layout_of(PATH, text.split("\n"), **keywords)


@each(
    "row, separator, decimal",
    [
        ("0.5;1.5", ";", "."),
        ("0,5;1,5", ";", ","),
        ("0;1", ";", "."),
        ("0.5\t1.5", "\t", "."),
        ("0,5\t1,5", "\t", ","),
        ("0.5,1.5", ",", "."),
        ("0.5, 1.5", ",", "."),
        ('"0,5","1,5"', ",", ","),
        ('"0.5","1.5"', ",", "."),
        ("  0.5   1.5  ", None, "."),
        ("0,5 1,5", None, ","),
        ("1,2,3", ",", "."),
        ("-1.5e-3,+2E4", ",", "."),
    ],
)
def test_dialects(row, separator, decimal):
    found = layout("\n".join([row] * 20))
    assert found.dialect == Dialect(separator, decimal)
    assert (found.first, found.header) == (0, ())


def test_the_decimal_mark_is_seen_behind_many_zeros():
    assert layout("\n".join(["0;0"] * 30 + ["0,5;1"] * 3)).dialect == Dialect(";", ",")
    assert layout("\n".join([*["0;0"] * 5000, "0,5;1", *["0;0"] * 4000])).dialect == Dialect(";", ",")


def test_heads_settle_what_a_comma_is():
    assert layout("\n".join(["t,u", *["0,5"] * 20])).dialect == Dialect(",")
    assert layout("\n".join(["u [V]", *["0,5"] * 20])).dialect.decimal == ","
    with pytest.raises(InputError, match=r"line 1 is '0,5', .*decimal comma"):
        layout("\n".join(["0,5"] * 20))
    with pytest.raises(InputError, match=r"line 2 is '0,5', .*decimal comma"):
        layout("\n".join(["t,u", *["0,5"] * 20]), strict=True)


def test_single_lines_of_numbers_above_the_heads_belong_to_the_header():
    rows = [f"{k},{k}" for k in range(20)]
    assert layout("\n".join(["a title", "2500,4", "t,u", *rows])).first == 3
    assert layout("\n".join(["# t,u", "", "20", *rows])).header == ("t,u", "", "20")


ROWS = "\n1e-6,2\n2e-6,3\n3e-6,4"


@each(
    "above, line",
    [
        ("t,u\n0.0", 2),
        ("t,u\n\n0.0\n\n", 3),
        ("0.0", 1),
        ("t,u\n0.0,OL", 2),
        ("t,u\n0,1\n1e-6,OL", 3),
        ("t,u\n0,1\nOL,2", 3),
        ("t,u\n,", None),
        ("t,u\nnan,nan", 2),
        ("t,u\n3", None),  # number of rows
        ("t,u\n3.5", 2),
        ("t,u\n2", 2),
        ("Sample interval,1e-6", None),
        ("# 0.0", None),
    ],
)
def test_a_first_row_that_lacks_a_number_is_not_a_part_of_the_header(above, line):
    if line is None:
        assert layout(above + ROWS).first == len(above.split("\n"))
        return
    for strict in (False, True)[: 1 + (",2" not in above and "0,1" not in above)]:
        with pytest.raises(InputError, match=f"line {line} is .*all columns"):
            layout(above + ROWS, strict=strict)


def test_an_empty_line_of_a_spreadsheet_separates_no_rows():
    found = layout("t,u\n,\n0,1\n,\n1e-6,2\n2e-6,3\n")
    assert found.first == 2
    assert found.numbers(PATH, (0, 1), "0,1\n,\n1e-6,2", 3)[0].tolist() == [0.0, 1e-6]


def test_words_above_columns_between_spaces_may_begin_with_a_number():
    assert layout("6208 inner ring\n0 1\n1 2").first == 1
    with pytest.raises(InputError, match="line 2 is '0 OL'"):
        layout("t u\n0 OL\n1 2\n2 3")


def test_a_header_may_be_longer_than_the_table():
    found = layout("\n".join([*(f"key {k}: value" for k in range(90)), "0;1,5", "1;2"]))
    assert (found.first, found.dialect) == (90, Dialect(";", ","))


@each(
    "text, message",
    [
        ("", "is empty"),
        ("a word\nanother", "'another'"),
        ("a;b\n1;2\nend", "below each other"),
        ("1;2\ntext\n3;4\n5;6", "line 2 is 'text'"),
    ],
)
def test_texts_without_a_table(text, message):
    with pytest.raises(InputError, match=message):
        layout(text)


def test_heads_decide_whether_a_comma_separates_columns_or_thousands():
    rows = ["500.00", "1,000.00", "2,000.00", "3,000.00"]
    found = layout("\n".join(["u [V]", *rows]))
    assert (found.dialect, found.columns) == (Dialect(";", "."), (0,))
    text = "\n".join(rows)
    assert found.numbers(PATH, (0,), text, 2)[0].tolist() == [500.0, 1000.0, 2000.0, 3000.0]
    pairs = layout("t [s],u [V]\n1,500.25\n2,600.50")
    assert (pairs.dialect, pairs.columns) == (Dialect(",", "."), (0, 1))
    with pytest.raises(
        InputError, match=r"line 2 is '1,000.00', one number with a separator of thousands or"
    ):
        layout(text)
    # The second column of another row has no three digits before its point.
    assert layout("1,500.25\n2,60.5").columns == (0, 1)


TABLES = st.integers(1, 4).flatmap(
    lambda width: st.lists(
        st.lists(st.integers(-9_999_999, 9_999_999), min_size=width, max_size=width), min_size=2, max_size=30
    )
)
ABOVE = st.sampled_from([[], ["Made on a bench"], ["# remark", "", "Model: XY-1"], ['"a ""quoted"" remark"']])


@st.composite
def files(draw):
    """Numbers, the text in which they are written, its encoding, and the number of lines above them."""
    table = draw(TABLES)
    separator, decimal = draw(
        st.sampled_from(
            [(";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), (",", ","), (" ", ",")]
        )
    )
    digits, grouped = draw(st.sampled_from([2, 3])), draw(st.booleans())
    quoted = separator != " " and (separator == "," or draw(st.booleans()))
    marks = str.maketrans(".,", ",.") if decimal == "," else {}

    def field(number):
        text = f"{number / 10**digits:{',' if grouped else ''}.{digits}f}".translate(marks)
        return f'"{text}"' if quoted else text

    heads = [f"µ{k} [V]".replace(" ", "" if separator == " " else " ") for k in range(len(table[0]))]
    above = [*draw(ABOVE), separator.join(heads)]
    rows = [separator.join(map(field, row)) for row in table]
    for place in draw(st.lists(st.integers(0, len(rows)), max_size=2)):
        rows.insert(place, draw(st.sampled_from(["", " "])))
    end, encoding = draw(st.sampled_from(["\n", "\r\n", "\r"])), draw(st.sampled_from(CODES))
    last = draw(st.sampled_from(["", end]))
    return np.array(table) / 10**digits, (end.join([*above, *rows]) + last).encode(encoding), len(above)


CODES = ("utf-8", "utf-8-sig", "utf-16", "cp1252")


@given(files(), st.integers(100, 500))
def test_any_way_to_write_a_table_is_read_to_the_same_numbers(tmp_path_factory, made, size):
    table, content, above = made
    path = tmp_path_factory.mktemp("table") / "table.csv"
    path.write_bytes(content)
    text = decoded(path, content)
    with patch.object(text_table, "_BLOCK", size):
        assert "".join(text_blocks(path, most=len(content))) == text
    found = layout(text)
    assert found.columns == tuple(range(table.shape[1]))
    assert found.header[above - 1].startswith("µ0")
    numbers = found.numbers(PATH, found.columns, found.below(text), found.first + 1)
    assert np.transpose(numbers) == pytest.approx(table, rel=1e-15)


@given(files(), st.data())
def test_an_error_names_the_line_and_the_column(made, data):
    table, content, _ = made
    lines = decoded(PATH, content).split("\n")
    found = layout_of(PATH, lines)
    rows = [place for place in range(found.first, len(lines)) if lines[place].strip()]
    place = data.draw(st.sampled_from(rows))
    column = data.draw(st.integers(0, table.shape[1] - 1))
    fields = ["1", *["2"] * (table.shape[1] - 1)]
    fields[column] = data.draw(st.sampled_from(["x", "∞", "1e999", "--1", "1,5.5"]))
    lines[place] = (found.dialect.separator or " ").join(f'"{field}"' for field in fields)
    if found.dialect.separator is None:
        lines[place] = lines[place].replace('"', "")
    begin = data.draw(st.integers(found.first, place))
    with pytest.raises(InputError, match=f"line {place + 1}, column {column + 1}: got"):
        found.numbers(PATH, found.columns, "\n".join(lines[begin:]), begin + 1)


NUMBERS = ("1", "-2.5", "+.5", "3.", "1e-3", "1E+4", "0001", "-1.234567890123456789")
TEXTS = ("abc", "", "nan", "inf", "0x1", "1_0", "1,5", "--1", "∞", "True", "#1", "1 2")
OTHERS = (*TEXTS, "1e999", "9" * 41, "1" * 400)
fields = st.sampled_from([*NUMBERS, *OTHERS, '"1"', '"'])


def two_columns(separator, decimal="."):
    return Layout(Dialect(separator, decimal), (0, 1), 2, 0, ())


@pytest.mark.slow
@given(st.lists(st.lists(fields, min_size=1, max_size=4), min_size=1, max_size=6), st.sampled_from(";,\t"))
def test_the_fast_parser_reads_what_the_slow_one_reads(rows, separator):
    """Or nothing, and then the slow one decides."""
    text, columns = "\n".join(separator.join(row) for row in rows), two_columns(separator)
    fast = columns._at_once((1, 0), text)
    try:
        slow = [columns._row(PATH, (1, 0), (), number, row) for number, row in columns.rows(text, 1)]
    except InputError:
        # Only a field behind an empty one is left out by the fast parser.
        assert fast is None or any(len(row) > 3 for row in rows)
        return
    if fast is not None:
        assert np.transpose(fast) == pytest.approx(np.reshape(slow, (-1, 2)), rel=1e-15)


def test_ordinary_lines_are_parsed_fast():
    for separator, decimal in ((";", ","), (",", "."), ("\t", "."), (None, ".")):
        row = f"{{:.3f}}{separator or '  '}{{:.5f}}".format
        lines = [row(k, k / 7).replace(".", decimal) for k in range(50)]
        columns = two_columns(separator, decimal)
        found = columns._at_once((1, 0), "\n".join([*lines, "", ""]))
        assert found is not None
        assert found[0] == pytest.approx(np.arange(50) / 7, abs=1e-5)
        assert found[1].tolist() == list(range(50))
        longer = [*lines, lines[0] + (separator or " ") + "7"]
        assert columns._at_once((1, 0), "\n".join(longer)) is None


def test_lines_are_numbered_in_the_file():
    columns = two_columns(",")
    found = columns.numbers(PATH, (1, 0), "0,1\n\n , \n1,2\n2,3\n", 10)
    assert found[0].tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(InputError, match=r"line 12, column 2: .*'x'"):
        columns.numbers(PATH, (1, 0), "0,1\n\n1,x\n", 10)
    assert columns.line_of("0,1\n\n , \n1,2\n2,3\n", 10, 1) == 13


def test_fields_without_a_value_are_voids_only_in_some_columns():
    columns = two_columns(";")
    found = columns.numbers(PATH, (0, 1), "0;1\n1;\n2;N/A\n3;4", 1, voids=(1,))
    np.testing.assert_array_equal(found[1], [1.0, np.nan, np.nan, 4.0])
    with pytest.raises(InputError, match="line 2, column 1: got ''"):
        columns.numbers(PATH, (0, 1), "0;1\n;2", 1, voids=(1,))
    with pytest.raises(InputError, match="line 2 has 1 columns, no column 2"):
        columns.numbers(PATH, (0, 1), "0;1\n1", 1, voids=(1,))


@each(
    "rows, separator, mark",
    [
        (["1", "2"], ";", "."),
        (["0,5"], ";", ","),
        (["1,500.5", "1,500"], ",", "."),
        (["1.500,5", "1.600"], ";", ","),
        (["1,500", "0.5"], ",", "."),
        (["remark 1,5", "2.5"], ",", "."),
    ],
)
def test_the_decimal_mark_of_all_numbers(rows, separator, mark):
    assert decimal_mark(PATH, enumerate([[row] for row in rows]), separator) == mark


@each(
    "rows, separator, message",
    [
        (["0.5", "0,5"], ";", "'0.5' in line 0 and '0,5' in line 1"),
        (["1,500"], ",", "line 0 has the number '1,500', which may be 1.5 or 1500"),
    ],
)
def test_decimal_marks_in_doubt(rows, separator, message):
    with pytest.raises(InputError, match=message):
        decimal_mark(PATH, enumerate([[row] for row in rows]), separator)


def test_the_last_digit_of_times_that_are_printed_without_zeros_at_the_end():
    ends = ["-1.000e-03,0", "-9.99e-04,0"], ["0.001,0", "0.00101,0"]
    assert two_columns(",").last_digit(0, ends) == 1e-05


@given(st.integers(2, 8), st.integers(-300, 300), st.floats(1e-9, 1e-3))
def test_times_of_few_significant_digits_have_the_digits_of_the_largest(digits, first, step):
    times = (first + np.arange(60)) * step
    texts = [f"{time:.{digits}e}" for time in times]
    found = two_columns(",").last_digit(0, [texts[:40], texts[-40:]])
    largest = max(abs(float(text)) for text in texts)
    assert found >= np.max(np.abs(times - [float(text) for text in texts])) / 0.51
    assert found <= 10.0 ** (np.ceil(np.log10(largest)) - digits) * 1.001


def test_blocks_of_text(tmp_path):
    path = tmp_path / "a.txt"
    path.write_bytes("µ;1\r\n2;3\r4;5".encode("cp1252"))
    with patch.object(text_table, "_BLOCK", 5):
        assert list(text_blocks(path, most=20)) == ["µ;1\n", "2;3\n", "4;5"]
    for content, message in (
        (b"PK\x03\x04" + 30 * b"\0" + b"xl/workbook.xml", "workbook.*save the sheet as CSV"),
        (b"0,1\n\0\0", "not a text file"),
        (b"\xff\xfe\x00\xd8" + b"0\x00" * 40, "UTF-16"),
        (b"1" * 100_001, "line of more than 100000"),
    ):
        path.write_bytes(content)
        with pytest.raises(InputError, match=message):
            list(text_blocks(path, most=200_000))
