"""Parts of the reader of text files: layout, heads, numbers and spacing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.source.text import numbers
from ehlectric.drive.source.text.dialect import Dialect, layout_of
from ehlectric.drive.source.text.heads import heads_of
from ehlectric.drive.source.text.numbers import Columns, block_of
from ehlectric.drive.source.text.spacing import Spacing, resolution
from ehlectric.drive.source.text.spelling import parts, spelled
from ehlectric.errors import InputError
from tests.helpers.each import each


def layout(text):
    return layout_of("scope.csv", text.split("\n"))


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
    assert (found.first, found.header) == (1, ())


def test_the_decimal_mark_is_seen_behind_many_zeros():
    assert layout("\n".join(["0;0"] * 30 + ["0,5;1"] * 3)).dialect == Dialect(";", ",")


def test_heads_settle_what_a_comma_is():
    assert layout("\n".join(["t,u", *["0,5"] * 20])).dialect == Dialect(",", ".")
    assert layout("\n".join(["u [V]", *["0,5"] * 20])).dialect.decimal == ","
    with pytest.raises(InputError, match="decimal comma"):
        layout("\n".join(["0,5"] * 20))


def test_a_single_line_of_numbers_above_the_heads_belongs_to_the_header():
    found = layout("\n".join(["a title", "2500,4", "t,u", *(f"{k},{k}" for k in range(20))]))
    assert found.first == 4


@each(
    "head, name, unit",
    [
        ("Time (us)", "Time", "us"),
        ("CH1 [kV]", "CH1", "kV"),
        ("(ms)", "", "ms"),
        ("in s", "", "s"),
        ("C1 in mV", "C1", "mV"),
        ("time_ms", "time", "ms"),
        ("U mV", "U", "mV"),
        ("Channel A", "Channel A", ""),
        ("CH1 V", "CH1", "V"),
        ("U [furlong]", "U", "furlong"),
        ("", "", ""),
    ],
)
def test_names_and_units_of_heads(head, name, unit):
    assert parts(head) == (name, unit)


@each(
    "written, unit",
    [
        ("Second", "s"),
        ("S", "s"),
        ("VOLTS", "V"),
        ("(\u03bcs)", "us"),
        ("[µs]", "us"),
        ("(MV)", "MV"),
        ("Seq", ""),
    ],
)
def test_spellings_of_units(written, unit):
    assert spelled(written) == unit


@pytest.mark.parametrize(
    ("head", "names"),
    [("Time (us)  Ch 1 (V)", ["Time", "Ch 1"]), ("Time (us) CH1 (V)", ["Time", "CH1"]), ("t u", ["t", "u"])],
)
def test_heads_of_columns_of_white_space(head, names):
    heads = heads_of(layout("\n".join([head, *(f"{k} {k / 7:.3f}" for k in range(20))])))
    assert [column.name for column in heads.columns] == names


def test_units_in_the_lines_above():
    text = "\n".join(["Horizontal Units,ms", "Vertical Units,mV,V", "TIME,CH1,CH2", *["0,1,2"] * 20])
    assert [column.unit for column in heads_of(layout(text)).columns] == ["ms", "mV", "V"]


NUMBERS = ("1", "-2.5", "+.5", "3.", "1e-3", "1E+4", "0001", "-1.234567890123456789")
TEXTS = ("abc", "", "nan", "inf", "0x1", "1_0", "1,5", "--1", "∞", "True", "#1", "1 2")
OTHERS = (*TEXTS, "1e999", "9" * 41, "1" * 400)
fields = st.sampled_from([*NUMBERS, *OTHERS, '"1"', '"'])


def test_stated_values_above_a_single_column():
    """After Infiniium: keys, no times, and a start that counts samples."""
    keys = ["Type,raw", "Start,0", "Points,20", "XInc,2.0E-09", "XOrg,-1.0E-06", "YUnits,Volt", "Data,"]
    heads = heads_of(layout("\n".join([*keys, *(f"{k / 7:.3e}" for k in range(20))])))
    assert (heads.step, heads.start, heads.points) == (2e-9, -1e-6, 20)
    assert [column.unit for column in heads.columns] == ["V"]


@pytest.mark.slow
@given(st.lists(st.lists(fields, min_size=1, max_size=4), min_size=1, max_size=6), st.sampled_from(";,\t"))
def test_the_fast_parser_reads_what_the_slow_one_reads(rows, separator):
    """Or nothing, and then the slow one decides."""
    text = "\n".join(separator.join(row) for row in rows).encode()
    columns = Columns("scope.csv", Dialect(separator, "."), (1, 0), 2)
    fast = numbers._at_once(text, columns)
    try:
        slow = numbers._line_by_line(text, 1, columns)
    except InputError:
        # Only a field behind an empty one is left out by the fast parser.
        assert fast is None or any(len(row) > 3 for row in rows)
        return
    if fast is not None:
        for one, other in zip(fast, slow, strict=True):
            assert one == pytest.approx(other, rel=1e-15)


def test_ordinary_lines_are_parsed_fast():
    for separator, decimal in ((";", ","), (",", "."), ("\t", "."), (None, ".")):
        row = f"{{:.3f}}{separator or '  '}{{:.5f}}".format
        lines = [row(k, k / 7).replace(".", decimal) for k in range(50)]
        columns = Columns("scope.csv", Dialect(separator, decimal), (1, 0), 2)
        found = numbers._at_once("\r\n".join([*lines, "", ""]).encode(), columns)
        assert found is not None
        assert found[0] == pytest.approx(np.arange(50) / 7, abs=1e-5)
        assert found[1].tolist() == list(range(50))
        longer = [*lines, lines[0] + (separator or " ") + "7"]
        assert numbers._at_once("\n".join(longer).encode(), columns) is None


def test_lines_are_numbered_in_the_file():
    columns = Columns("scope.csv", Dialect(",", "."), (1, 0), 2)
    block = block_of(b"0,1\n\n , \n1,2\n2,3\n", 10, columns)
    assert block.values[0].tolist() == [1.0, 2.0, 3.0]
    assert [block.line(row) for row in range(3)] == [10, 13, 14]
    with pytest.raises(InputError, match=r"line 12, column 2: .*'x'"):
        block_of(b"0,1\n\n1,x\n", 10, columns)


def spaced(times, sizes):
    """Step of times that come in blocks of given sizes."""
    spacing = Spacing("scope.csv")
    for part in np.split(times, np.cumsum(sizes)):
        spacing.add(part, lambda row: row)
    return spacing


@given(
    st.lists(st.integers(1, 30_000), max_size=5),
    st.floats(1e-12, 1e3),
    st.integers(-10_000, 10_000),
    st.integers(3, 70_000),
)
def test_the_step_does_not_depend_on_the_blocks(sizes, step, first, count):
    times = (first + np.arange(count)) * step
    assert spaced(times, sizes).step(0.0) == pytest.approx(step, rel=1e-9)


@given(st.lists(st.integers(1, 30_000), max_size=5), st.integers(0, 69_999), st.floats(0.005, 0.9))
def test_one_late_sample_is_found_in_any_block(sizes, late, by):
    times = np.arange(70_000.0)
    times[late] += by
    with pytest.raises(InputError, match="unevenly sampled"):
        spaced(times, sizes).step(0.0)


@given(st.floats(0.3, 40.0), st.integers(3000, 70_000), st.lists(st.integers(1, 30_000), max_size=5))
def test_rounding_of_printed_times_is_no_jitter(step, count, sizes):
    """Times that are printed with one to some hundred digits a step."""
    times = np.round(np.arange(count) * (1.0 + step))
    assert spaced(times, sizes).step(1.0) == pytest.approx(1.0 + step, abs=1.1 / (count - 1))


@given(st.integers(2, 8), st.integers(-300, 300), st.floats(1e-9, 1e-3))
def test_times_of_few_significant_digits_have_the_digits_of_the_largest(digits, first, step):
    times = (first + np.arange(60)) * step
    texts = [f"{time:.{digits}e}" for time in times]
    found = resolution(".", [texts[:40], texts[-40:]])
    largest = max(abs(float(text)) for text in texts)
    assert found >= np.max(np.abs(times - [float(text) for text in texts])) / 0.51
    assert found <= 10.0 ** (np.ceil(np.log10(largest)) - digits) * 1.001
