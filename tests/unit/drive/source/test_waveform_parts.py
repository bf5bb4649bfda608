"""Parts of the reader of text files: columns, heads, numbers and spacing."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive import waveform_file as reader
from ehlectric.drive.waveform_file import _Choice, _Dialect, _Head, _Layout, _Samples
from ehlectric.errors import InputError
from tests.helpers.each import each

PATH = Path("scope.csv")


def layout(text):
    return reader._layout(PATH, text.split("\n"))


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
    assert found.dialect == _Dialect(separator, decimal)
    assert (found.first, found.header) == (0, ())


def test_the_decimal_mark_is_seen_behind_many_zeros():
    assert layout("\n".join(["0;0"] * 30 + ["0,5;1"] * 3)).dialect == _Dialect(";", ",")


def test_heads_settle_what_a_comma_is():
    assert layout("\n".join(["t,u", *["0,5"] * 20])).dialect == _Dialect(",", ".")
    assert layout("\n".join(["u [V]", *["0,5"] * 20])).dialect.decimal == ","
    with pytest.raises(InputError, match="decimal comma"):
        layout("\n".join(["0,5"] * 20))


def test_a_single_line_of_numbers_above_the_heads_belongs_to_the_header():
    found = layout("\n".join(["a title", "2500,4", "t,u", *(f"{k},{k}" for k in range(20))]))
    assert found.first == 3


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
    assert reader._parts(head) == (name, unit)


@each(
    "written, unit",
    [
        ("Second", ("s", 1.0)),
        ("S", ("s", 1.0)),
        ("VOLTS", ("V", 1.0)),
        ("\u03bcs", ("s", 1e-6)),
        ("µs", ("s", 1e-6)),
        ("mV", ("V", 1e-3)),
        ("MV", ("V", 1e6)),
        ("Seq", ("", 1.0)),
        ("M", ("", 1.0)),
        ("", ("", 1.0)),
    ],
)
def test_spellings_of_units(written, unit):
    assert reader._unit(written) == unit


@pytest.mark.parametrize(
    ("head", "names"),
    [("Time (us)  Ch 1 (V)", ["Time", "Ch 1"]), ("Time (us) CH1 (V)", ["Time", "CH1"]), ("t u", ["t", "u"])],
)
def test_heads_of_columns_of_white_space(head, names):
    heads = reader._heads(layout("\n".join([head, *(f"{k} {k / 7:.3f}" for k in range(20))])))
    assert [column.name for column in heads] == names


@each(
    "above, heads",
    [
        (["t,CH1,CH2", "(us),(V),(dB)"], [("t", "us"), ("CH1", "V"), ("CH2", "dB")]),
        (["s,CH1 (V),CH2 (V)"], [("s", ""), ("CH1", "V"), ("CH2", "V")]),
        (["s,V,A"], [("", "s"), ("", "V"), ("", "A")]),
        (["ms,CH1,1"], [("ms", "ms"), ("CH1", ""), ("1", "")]),
        (["Record Length,2500,4"], [("", ""), ("", ""), ("", "")]),
    ],
)
def test_rows_of_names_and_of_units(above, heads):
    found = reader._heads(layout("\n".join([*above, *(f"{k},{k / 7:.3f},1" for k in range(20))])))
    assert [(head.name, head.unit) for head in found] == heads


NUMBERS = ("1", "-2.5", "+.5", "3.", "1e-3", "1E+4", "0001", "-1.234567890123456789")
TEXTS = ("abc", "", "nan", "inf", "0x1", "1_0", "1,5", "--1", "∞", "True", "#1", "1 2")
OTHERS = (*TEXTS, "1e999", "9" * 41, "1" * 400)
fields = st.sampled_from([*NUMBERS, *OTHERS, '"1"', '"'])


def two_columns(separator, decimal="."):
    return _Layout(_Dialect(separator, decimal), (0, 1), 2, 0, (), {})


@pytest.mark.slow
@given(st.lists(st.lists(fields, min_size=1, max_size=4), min_size=1, max_size=6), st.sampled_from(";,\t"))
def test_the_fast_parser_reads_what_the_slow_one_reads(rows, separator):
    """Or nothing, and then the slow one decides."""
    text, columns = "\n".join(separator.join(row) for row in rows), two_columns(separator)
    fast = reader._at_once(columns, (1, 0), text)
    try:
        lines = reader._rows(columns.dialect, text, 1)
        slow = [reader._row(PATH, columns, (1, 0), number, row) for number, row in lines]
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
        found = reader._at_once(columns, (1, 0), "\n".join([*lines, "", ""]))
        assert found is not None
        assert found[0] == pytest.approx(np.arange(50) / 7, abs=1e-5)
        assert found[1].tolist() == list(range(50))
        longer = [*lines, lines[0] + (separator or " ") + "7"]
        assert reader._at_once(columns, (1, 0), "\n".join(longer)) is None


def test_lines_are_numbered_in_the_file():
    columns = two_columns(",")
    found = reader._numbers(PATH, columns, (1, 0), "0,1\n\n , \n1,2\n2,3\n", 10)
    assert found[0].tolist() == [1.0, 2.0, 3.0]
    with pytest.raises(InputError, match=r"line 12, column 2: .*'x'"):
        reader._numbers(PATH, columns, (1, 0), "0,1\n\n1,x\n", 10)
    blocks = ["0,1\n\n1,2\n", "\n2,3\n1,4\n"]
    with pytest.raises(InputError, match="line 6 goes backward"):
        reader._samples(PATH, columns, (1, 0), blocks, ordered=True)


def spaced(times, digit=0.0):
    """Step of times with a last printed digit."""
    choice = _Choice(_Head(1, "u", "V"), 1.0, _Head(0, "t", "s"), 1.0, ())
    return reader._timing(PATH, _Samples(np.zeros(times.size), times, digit), choice, None)[1]


@given(st.floats(1e-12, 1e3), st.integers(-10_000, 10_000), st.integers(3, 70_000))
def test_the_step_of_even_times(step, first, count):
    assert spaced((first + np.arange(count)) * step) == pytest.approx(step, rel=1e-9)


@given(st.integers(0, 69_999), st.floats(0.005, 0.9))
def test_one_late_sample_is_found(late, by):
    times = np.arange(70_000.0)
    times[late] += by
    with pytest.raises(InputError, match="unevenly sampled"):
        spaced(times)


@given(st.floats(0.3, 40.0), st.integers(3000, 70_000))
def test_rounding_of_printed_times_is_no_jitter(step, count):
    """Times that are printed with one to some hundred digits a step."""
    times = np.round(np.arange(count) * (1.0 + step))
    assert spaced(times, 1.0) == pytest.approx(1.0 + step, abs=1.1 / (count - 1))


def test_the_last_digit_of_times_that_are_printed_without_zeros_at_the_end():
    ends = ["-1.000e-03,0", "-9.99e-04,0"], ["0.001,0", "0.00101,0"]
    assert reader._digit(_Dialect(",", "."), 0, ends) == 1e-05


@given(st.integers(2, 8), st.integers(-300, 300), st.floats(1e-9, 1e-3))
def test_times_of_few_significant_digits_have_the_digits_of_the_largest(digits, first, step):
    times = (first + np.arange(60)) * step
    texts = [f"{time:.{digits}e}" for time in times]
    found = reader._digit(_Dialect(",", "."), 0, [texts[:40], texts[-40:]])
    largest = max(abs(float(text)) for text in texts)
    assert found >= np.max(np.abs(times - [float(text) for text in texts])) / 0.51
    assert found <= 10.0 ** (np.ceil(np.log10(largest)) - digits) * 1.001
