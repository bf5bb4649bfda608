"""Parts of the reader of waveforms: heads, units and spacing."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ehlectric.drive.waveform import text_heads as reader
from ehlectric.drive.waveform.chosen_columns import Choice
from ehlectric.drive.waveform.sample_times import timing
from ehlectric.drive.waveform.samples import Samples, line_of
from ehlectric.drive.waveform.text_heads import Head, parts_of, unit_of
from ehlectric.errors import InputError
from ehlectric.runtime.text_table import layout_of
from tests.helpers.each import each

PATH = Path("scope.csv")


def layout(text):
    return layout_of(PATH, text.split("\n"))


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
        ("phase_A", "phase_A", ""),
        ("Kanal 1 / A", "Kanal 1", "A"),
        ("Leistung / W", "Leistung", "W"),
        *(
            (name, name, "")
            for name in ("V_W", "U_N", "V1_A", "CH1 A", "Phase 1 A", "v_amp", "phase UA", "v_ua")
        ),
        *((name, name, "") for name in ("V/N", "L1/N", "u_bar", "Gate amp", "v_ma")),
        ("P_W", "P", "W"),
        ("V(vcm)", "V(vcm)", "V"),
        ("V(s)", "V(s)", "V"),
        ("V(n001,n002)", "V(n001,n002)", "V"),
        ("Ix(U1:A)", "Ix(U1:A)", "A"),
        ("CH1 V", "CH1", "V"),
        ("U [furlong]", "U", "furlong"),
        ("", "", ""),
    ],
)
def test_names_and_units_of_heads(head, name, unit):
    assert parts_of(head) == (name, unit)


@each(
    "written, unit",
    [
        ("Second", ("s", 1.0)),
        ("S", ("s", 1.0)),
        ("VOLTS", ("V", 1.0)),
        ("\u03bcs", ("s", 1e-6)),
        ("µs", ("s", 1e-6)),
        ("mV", ("V", 1e-3)),
        ("KV", ("V", 1e3)),
        ("Seq", ("", 1.0)),
        ("M", ("", 1.0)),
        ("", ("", 1.0)),
    ],
)
def test_spellings_of_units(written, unit):
    assert unit_of(written) == unit


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


def test_lines_of_samples_are_numbered_in_the_file(tmp_path):
    path = tmp_path / "scope.csv"
    text = "t,u\n0,1\n\n1,2\n" + "\n2,3\n1,4\n"
    path.write_text(text)
    assert [line_of(path, layout(text), k) for k in range(4)] == [2, 4, 6, 7]


def spaced(times, digit=0.0):
    """Step of times with a last printed digit."""
    choice = Choice(Head(1, "u", "V"), 1.0, Head(0, "t", "s"), 1.0, ())
    return timing(PATH, Samples(np.zeros(times.size), times, digit), choice, None)[1]


@example(step=2.0**-14, first=0, count=3)
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
