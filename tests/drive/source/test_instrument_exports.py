"""Exports of oscilloscopes, recorders and simulators with traps: the correct value, or the refusal.

The files are written here after the formats of the makers. The expected numbers are those that are written.
"""

import re

import numpy as np
import pytest

from ehlectric.cases.drive_inputs import Source
from ehlectric.cases.measured_inputs import ShaftFile
from ehlectric.drive.measured_source import measured_waveform
from ehlectric.drive.shaft_record import measured_shaft
from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from tests.helpers.each import each

# A square wave with ripples, so that no sample repeats its neighbour.
VOLTS = [40.0, 41.0, 42.0, 40.5, -39.5, -38.5, -40.0, -39.0] * 8


def written(folder, lines, name="scope.csv", encoding="utf-8"):
    path = folder / name
    path.write_bytes(lines if isinstance(lines, bytes) else "\n".join([*lines, ""]).encode(encoding))
    return path


def refused(path, **keywords):
    with pytest.raises(InputError) as error:
        read_waveform(path, **keywords)
    return str(error.value).replace(str(path), "FILE")


def columns(*values, form="{:g},{:g}"):
    return [form.format(*row) for row in zip(*values, strict=True)]


def evenly(step, count=64):
    return [k * step for k in range(count)]


def test_uneven_times_are_not_replaced_by_a_step(tmp_path):
    """After LTspice: steps of 2 ns and 1 us in six digits, of which some repeat."""
    steps = np.tile([2e-9] * 7 + [1e-6], 8)
    times = 1e-3 + np.cumsum(steps)
    path = written(tmp_path, ["time,vcm", *(f"{t:.6g},{v:g}" for t, v in zip(times, VOLTS, strict=True))])
    assert re.search("line 3 repeats .*more digits", refused(path))
    step = float(times[-1] - times[0]) / 63
    even = times[0] + step * np.arange(64)
    worst = np.max(np.abs(even - times)) / step
    line = refused(path, step=step)
    assert line.startswith("step: ")
    assert float(re.search(r"is ([\d.]+) steps off", line)[1]) == pytest.approx(worst, abs=0.1)


def test_uneven_times_are_resampled_with_the_error(tmp_path):
    """A triangle between points at uneven times: exact on its sides, and lower at its tip."""
    times = np.concatenate([[0.0], np.cumsum(np.tile([1e-6, 3e-6, 0.5e-6, 2.5e-6], 10))])
    tip = times[21]
    volts = 10.0 - np.abs(times - tip) * 1e6
    path = written(
        tmp_path, ["time\tV(a)", *(f"{t:.12e}\t{v:.9e}" for t, v in zip(times, volts, strict=True))]
    )
    assert "resample" in refused(path)
    read, warnings = read_waveform(path, resample=0.32e-6)
    assert read.step == pytest.approx(0.32e-6, rel=1e-12)
    seconds = read.start + read.step * np.arange(read.values.size)
    assert read.values == pytest.approx(10.0 - np.abs(seconds - tip) * 1e6, abs=1e-6)
    # Closed form: halfway between two new samples, the line is half a step below the tip.
    lost = 0.5 * 0.32
    assert (tip / 0.32e-6) % 1.0 == pytest.approx(0.5)
    text = next(warning.text for warning in warnings if warning.code == "waveform-uneven")
    assert float(re.search(r"at most ([\d.]+) V", text)[1]) == pytest.approx(lost, rel=2e-3)
    assert refused(path, resample=1e-3).startswith("resample: ")
    coarse = written(
        tmp_path, ["time\tV(a)", *(f"{t:.1e}\t{v:g}" for t, v in zip(times[2:], volts[2:], strict=True))]
    )
    assert "more digits" in refused(coarse, resample=0.4e-6)


COUNTS = ["Memory Length,64,", "Source,CH1,", "Vertical Units,V,", "Vertical Scale,5.000E-01,"]
COUNTS += [
    "Vertical Position,0.000E+00,",
    "Horizontal Units,s,",
    "Sampling Period,2.000E-06,",
    "Waveform Data,",
]


@each(
    "above, factor",
    [
        (COUNTS, 0.02),
        ([line.replace("5.000E-01", "500mV") for line in COUNTS], 0.02),
        (["Volts/Div: CH1: 0.5 V", "Sample Interval: 2e-6", "CH1"], 0.02),
    ],
)
def test_counts_of_the_converter_are_no_volts(tmp_path, above, factor):
    """After GW Instek: 25 counts in a division of 0.5 V."""
    counts = [round(2.0 * volt) for volt in VOLTS]
    path = written(tmp_path, [*above, *(f"{count}," for count in counts)])
    line = refused(path, step=2e-6)
    assert line.startswith("scale: missing")
    assert f" {factor} " in line
    read, _ = read_waveform(path, step=2e-6, scale=factor)
    assert read.values == pytest.approx([count * 0.5 / 25.0 for count in counts])
    assert refused(path, step=2e-6, scale=1.5).startswith("scale: ")
    # Numbers with decimals are volts.
    volts = written(tmp_path, [*above, *(f"{count * factor:.3f}," for count in counts)])
    assert np.max(read_waveform(volts, step=2e-6)[0].values) == pytest.approx(1.68)


@each("last", [[], ['"HUnit","s"', '"VUnit","V"'], ['"Comment",""', '"BlockSize",64']])
def test_keys_left_of_values_are_no_samples(tmp_path, last):
    """After Yokogawa: the first field of a row is empty."""
    above = [
        '"Model","RECORDER"',
        '"VUnit","V"',
        '"SampleRate",500000',
        '"HResolution",2.0E-06',
        '"HOffset",0.0',
    ]
    path = written(tmp_path, [*above, *last, "", *(f",{volt:+.4E}" for volt in VOLTS)])
    assert "HResolution" in refused(path) or "SampleRate" in refused(path)
    read, warnings = read_waveform(path, step=2e-6)
    assert read.values == pytest.approx(VOLTS)
    assert [warning.code for warning in warnings] == ["edges-unresolved"]
    two = written(tmp_path, [*above, "", *(f",{volt:+.4E},{2 * volt:+.4E}" for volt in VOLTS)])
    assert read_waveform(two, step=2e-6, column=3)[0].values == pytest.approx(2 * np.array(VOLTS))


@each(
    "heads, keys, factors",
    [
        ("TIME (MS),VOLTAGE (MV)", {"time_unit": "ms", "value_unit": "mV"}, (1e-3, 1e-3)),
        ("TIME [US],VOLTAGE [MVOLT]", {"value_unit": "mV"}, (1e-6, 1e-3)),
        ("TIME_MS,VOLTAGE_KV", {"time_unit": "ms"}, (1e-3, 1e3)),
        ("MS,V", {"time_unit": "ms"}, (1e-3, 1.0)),
    ],
)
def test_capital_letters_are_never_mega(tmp_path, heads, keys, factors):
    path = written(tmp_path, [heads, *columns(evenly(1e-3), VOLTS)])
    for key in keys:
        others = {name: unit for name, unit in keys.items() if name != key}
        assert refused(path, **others).startswith(f"{key}: missing")
    read, _ = read_waveform(path, **keys)
    assert read.step == pytest.approx(1e-3 * factors[0])
    assert read.values == pytest.approx(factors[1] * np.array(VOLTS))


def test_units_in_capitals_above_the_numbers_are_asked_for(tmp_path):
    path = written(tmp_path, ["Vertical Units,MV", "TIME,CH1", *columns(evenly(1e-6), VOLTS)])
    assert refused(path).startswith("value_unit: missing")
    assert read_waveform(path, value_unit="mV")[0].values == pytest.approx(1e-3 * np.array(VOLTS))


def test_a_number_that_names_another_column_is_refused(tmp_path):
    """After Keysight: channels 1 and 2 are columns 2 and 3."""
    small = [volt / 100.0 for volt in VOLTS]
    rows = columns(evenly(1e-6), VOLTS, small, form="{:g},{:g},{:g}")
    path = written(tmp_path, ["x-axis,1,2", "second,Volt,Volt", *rows])
    assert refused(path, column=2).startswith("column: got 2, ")
    assert np.max(read_waveform(path, column="2")[0].values) == pytest.approx(0.42)
    assert np.max(read_waveform(path, column=3)[0].values) == pytest.approx(0.42)
    for name in ("1", '"1"'):
        assert np.max(read_waveform(path, column=name)[0].values) == pytest.approx(42.0)


@pytest.mark.parametrize(("start", "step"), [(-4.0, 1e-4), (0.0, 2e-5), (-0.3, 4e-6)])
def test_times_in_single_precision_have_equal_steps(tmp_path, start, step):
    times = [float(np.float32(start + k * step)) for k in range(256)]
    path = written(tmp_path, ["Second,Volt", *columns(times, VOLTS * 4, form="{:.11f},{:.3f}")])
    read, _ = read_waveform(path)
    assert read.step == pytest.approx(step, rel=1e-12)
    # A sample that is late by a third of a step is none of the rounding.
    times[100] += 0.3 * step
    late = written(tmp_path, ["Second,Volt", *columns(times, VOLTS * 4, form="{:.11f},{:.3f}")])
    assert "unevenly sampled" in refused(late)


def test_columns_of_values_without_times(tmp_path):
    """After R&S: a column for each channel, and neither times nor heads."""
    third = [volt / 3.0 for volt in VOLTS]
    path = written(tmp_path, columns(VOLTS, third, form="{:.4f},{:.4f}"))
    assert read_waveform(path, column=1, step=1e-6)[0].values == pytest.approx(VOLTS)
    assert read_waveform(path, column=2, step=1e-6)[0].values == pytest.approx(third, abs=1e-4)
    assert refused(path, step=1e-6).startswith("column: missing")
    assert refused(path).startswith("step: missing")
    # Times are no voltages.
    timed = written(tmp_path, columns(evenly(1e-6), VOLTS, form="{:.7f},{:.4f}"))
    assert refused(timed, column=1, step=1e-6).startswith("column: ")
    assert read_waveform(timed, column=2, step=1e-6)[0].values == pytest.approx(VOLTS)
    assert refused(timed, column=2, step=2e-6).startswith("step: ")


def test_commas_do_not_separate_columns_and_decimals(tmp_path):
    rows = [f"{1e3 * t:.3f},{v:.3f}".replace(".", ",") for t, v in zip(evenly(1e-6), VOLTS, strict=True)]
    assert "commas separate columns and decimals" in refused(written(tmp_path, rows), column=3, step=1e-6)


def test_a_line_without_a_value_below_the_first_sample_is_refused(tmp_path):
    path = written(tmp_path, ["t [s],u [V]", "0,40", "NaN", *columns(evenly(1e-6)[1:], VOLTS[1:])])
    assert "line 3 is 'NaN'" in refused(path)


def test_numbers_of_samples_are_no_times(tmp_path):
    rows = [f"{k};{v:g};{t:g}" for k, (t, v) in enumerate(zip(evenly(1e-6), VOLTS, strict=True))]
    path = written(tmp_path, rows)
    assert refused(path, time_unit="ms", column=2).startswith("time_column: missing")
    assert read_waveform(path, time_column=3, column=2)[0].step == pytest.approx(1e-6)


@each(
    "heads, keys",
    [
        ("time\tV(vcm)", {}),
        ("time\tV(s)", {}),
        ("time\tV(ms)", {}),
        ("Time\tV(A)", {}),
        ("time\tv(n001)", {}),
        ("time\tV(mV)", {"value_unit": "V"}),
        ("time\tV(vcm)\tI(R1)", {}),
        ("time\tV(vcm)\tV(s)", {"column": "V(vcm)"}),
        ("time\tV(n1,n2)\tIx(U1:2)", {"column": "V(n1,n2)"}),
    ],
)
def test_heads_of_circuit_simulators(tmp_path, heads, keys):
    others = heads.count("\t") - 1
    rows = [f"{t:.9e}\t{v:.5e}" + others * f"\t{7 * v:g}" for t, v in zip(evenly(1e-6), VOLTS, strict=True)]
    path = written(tmp_path, [heads, *rows], "circuit.txt")
    read, _ = read_waveform(path, **keys)
    assert (read.step, read.values.tolist()) == (1e-6, VOLTS)
    if "value_unit" in keys:
        assert refused(path).startswith("value_unit: missing")


@each(
    "heads",
    [
        ["X,CH1,Start,Increment,", "Sequence,Volt,-3.200000e-05,1.000000e-06"],
        ["X,CH1(V),t0 = -3.2e-05, tInc = 1.0e-06"],
        ["Sample Interval,1e-06", "Index,CH1 (V)"],
    ],
)
def test_an_increment_is_shown_with_its_number(tmp_path, heads):
    """After Rigol: numbers of samples, and the increment in the second line or in the heads."""
    path = written(tmp_path, [*heads, *(f"{k},{volt:.3e}," for k, volt in enumerate(VOLTS))])
    line = refused(path)
    assert line.startswith("step: missing")
    assert re.search(r"1\.0*e-06|1e-06", line)
    assert read_waveform(path, step=1e-6)[0].values == pytest.approx(VOLTS)


@each(
    "stated, doubted",
    [
        ("Sample Interval,2e-06", True),
        ("Sample Interval,1e-06", False),
        ("Sampling Period: 1 us", False),
        ("Sampling Period: 1 ns", True),
        ("Sample Rate: 1 MSa/s", False),
        ("Sampling Rate,250000000.0", True),
        ("Sample Rate: 1000 kSa/s", False),
    ],
)
def test_a_step_that_the_file_contradicts_is_doubted(tmp_path, stated, doubted):
    path = written(tmp_path, [stated, "CH1 (V),CH2 (V)", *columns(VOLTS, VOLTS)])
    read, warnings = read_waveform(path, step=1e-6, column="CH1")
    assert read.step == 1e-6
    assert ("samples-missing" in [warning.code for warning in warnings]) == doubted
    texts = [warning.text for warning in warnings if warning.code == "samples-missing"]
    assert all(stated in text for text in texts)


SEGMENT = columns(evenly(1e-6, 32), VOLTS[:32])
LATER = columns([1.0 + t for t in evenly(1e-6, 32)], VOLTS[:32], form="{:.9f},{:g}")


@each(
    "lines, places",
    [
        (["LECROY,1", "Segments,2,SegmentSize,32", "Time,Ampl", *SEGMENT, *SEGMENT], "2 segments.*line 2"),
        (["Time [s],Ampl [V]", *SEGMENT, *SEGMENT, *SEGMENT], "3 segments.*line 34, line 66"),
        (["Time [s],Ampl [V]", *SEGMENT, *LATER], "2 segments.*line 34"),
        (["Time [s],Ampl [V]", *SEGMENT, "Time [s],Ampl [V]", *SEGMENT], "2 segments.*line 34"),
        (["Time [s],Ampl [V]", *SEGMENT, "", "Segment 2", *SEGMENT], "2 segments.*line 35"),
        (
            ["time\tV(a)", "Step Information: R=1 (Run: 1/3)", *(row.replace(",", "\t") for row in SEGMENT)],
            "3 seg",
        ),
    ],
)
def test_segments_are_counted_and_refused(tmp_path, lines, places):
    assert re.search(places, refused(written(tmp_path, lines)))


@each(
    "word",
    [
        "∞",
        "-∞",
        "OL",
        "OVERFLOW",
        "overload",
        ">1.00",
        "<-1.00",
        "1.#INF",
        "9.9E+37",
        "9.91e37",
        "-Inf",
        "OVER RANGE",
        "≥ 20",
        "O/L",
        "OVER RANGE",
        "≥ 20",
        "O/L",
    ],
)
def test_voltages_beyond_the_range_are_counted(tmp_path, word):
    rows = columns(evenly(1.0), VOLTS, form="{:.3f},{:.4f}")
    for places in ((9, 10, 20), (0, 1), (0,), (63,)):
        bad = [f"{row.partition(',')[0]},{word}" if k in places else row for k, row in enumerate(rows)]
        line = refused(written(tmp_path, ["Time,Channel A", "(us),(V)", "", *bad]))
        assert re.search(rf"range .* {len(places)} samples, .*line {places[0] + 4}\b", line)


@each(
    "lines",
    [
        ["Point Format,ENV", "TIME [s],CH1 [V]", *SEGMENT],
        ["Pt Fmt,Env", "TIME [s],CH1 [V]", *SEGMENT],
        ["t [us],u [V]", *(f"{k // 2},{volt:g}" for k, volt in enumerate(VOLTS))],
    ],
)
def test_envelopes_are_refused(tmp_path, lines):
    assert "envelope" in refused(written(tmp_path, lines))


def test_a_column_of_maxima_is_no_waveform(tmp_path):
    rows = columns(evenly(1e-6), VOLTS, [v + 1.0 for v in VOLTS], form="{:g},{:g},{:g}")
    path = written(tmp_path, ["t [s],CH1 Min [V],CH1 Max [V]", *rows])
    lines = ["t [s],CH1_min [V],CH1_max [V]", *rows]
    assert "envelope" in refused(written(tmp_path, lines, "other.csv"), column="CH1_max")
    for column in ("CH1 Max", 2):
        assert "envelope" in refused(path, column=column)


@each(
    "content, words",
    [
        (b"PK\x03\x04" + 30 * b"\0" + b"xl/workbook.xml" + 64 * b"\0", "workbook.*save the sheet as CSV"),
        (b"PK\x03\x04" + 30 * b"\0" + b"opendocument.spreadsheet" + 9 * b"\0", "workbook"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + 99 * b"\0" + "Workbook".encode("utf-16-le"), "workbook"),
        (b"#9000000000WAVEDESC" + 64 * b"\0", "LECROY_2_3.*CSV"),
        (b"\x0f\x0f:WFM#003" + 64 * b"\0", "Tektronix.*CSV"),
        (b":WFMPRE:BYT_NR 2;:CURVE #3100" + bytes(range(100)), "no points in its header"),
        (b"AG10" + 64 * b"\0", "Keysight.*CSV"),
        (b"\xa5\xa5\0\0" + 64 * b"\0", "Rigol.*CSV"),
        (b"TDSm\x0e\0\0\0" + 64 * b"\0", "TDMS"),
        (b"MDF     4.10    " + 64 * b"\0", "MDF"),
        (b"\x89HDF\r\n\x1a\n" + 64 * b"\0", "HDF5"),
        ("Title: * a.asc\nPlotname: Transient\n".encode("utf-16-le"), "LTspice"),
        (b"Title: * a.asc\nPlotname: Transient\nBinary:\n" + 64 * b"\0", "circuit simulator"),
        (b"\2\0\0\0" + bytes(range(64)), "not a text file"),
        ("0,1\n1,2\n".encode("utf-16-le"), "UTF-16 without"),
        (b"\0\1\2\3" * 40, "not a text file.*CSV"),
    ],
)
def test_files_that_are_no_text_are_named(tmp_path, content, words):
    assert re.search(words, refused(written(tmp_path, content, "scope.bin")))


def test_the_key_of_the_file_is_named(tmp_path):
    path = written(tmp_path, b"PK\x03\x04" + 30 * b"\0" + b"xl/workbook.xml" + 64 * b"\0", "scope.xlsx")
    with pytest.raises(InputError) as error:
        measured_waveform(Source(file=str(path)), None)
    assert error.value.key == "source.file"
    assert str(path) in error.value.text


TWO = columns(evenly(1e-6), [-volt for volt in VOLTS], VOLTS, form="{:g},{:g},{:g}")
BARE = [f",{-volt:g},{volt:g}" for volt in VOLTS]


@each(
    "above, rows",
    [
        (["Vertical Units,A,mV", "Horizontal Units,s", "", "TIME,CH1,CH2"], TWO),
        (["Vertical Units,,A,,mV", "", "TIME,CH1,CH2"], TWO),
        (["Vertical Units,CH1:A,CH2:mV", "Second,CH1,CH2"], TWO),
        (["CH1 Unit,A", "CH2 Unit,mV", "", "TIME,CH1,CH2"], TWO),
        (["Unit of x,s", "Trace Unit,A,mV", "", "TIME,CH1,CH2"], TWO),
        (["x-axis,CH1,CH2", "s,W,mV"], TWO),
        (["Time,CH1 Current A,CH2 mV"], TWO),
        (["TIME,CH1_A,CH2_mV"], TWO),
        (["TIME,CH1 A,CH2 mV"], TWO),
        (["Zeit / s,CH1 / A,CH2 / mV"], TWO),
        (["Einheit,s,A,mV", "Zeit,CH1,CH2"], TWO),
        (["Vertikale Einheit,A,mV", "Zeit,CH1,CH2"], TWO),
        (["CH1: A,CH2: mV", "TIME,CH1,CH2"], TWO),
        (["CH1 [A],CH2 [mV]", "TIME,CH1,CH2"], TWO),
        (["TraceName,CH1,CH2", "BlockSize,64,64", "VUnit,A,mV", "HResolution,1e-6,1e-6"], BARE),
        (['"TraceName","CH1","CH2",', "VUnit,A,mV,", "HResolution,1e-6,1e-6,", "HUnit,s,s,"], BARE),
    ],
)
def test_a_unit_belongs_to_its_channel(tmp_path, above, rows):
    """The second channel has the written numbers in millivolts; the first is no voltage and is refused."""
    path = written(tmp_path, [*above, *rows])
    step = {"step": 1e-6} if rows is BARE else {}
    if step:
        assert "HResolution" in refused(path, column="CH2")
    second = "CH2" if "CH2 mV" not in above[0] or len(above) > 1 else 3
    read, _ = read_waveform(path, column=second, **step)
    assert read.values == pytest.approx(1e-3 * np.array(VOLTS))
    assert read_waveform(path, **step)[0].values == pytest.approx(read.values)
    assert re.search("'[AW]' as unit of CH1", refused(path, column=2, **step))


def test_blocks_of_tektronix_have_units_of_their_own(tmp_path):
    """Two channels next to each other, each with its keys left of its numbers."""
    keys = [("Record Length", "64"), ("Vertical Units", "A"), ("Horizontal Units", "s")]
    others = [(key, value.replace("A", "mV")) for key, value in keys]
    rows = [
        f"{a},{b},,{k}e-6,{-volt:g},,{c},{d},,{k}e-6,{volt:g},"
        for k, (volt, (a, b), (c, d)) in enumerate(
            zip(VOLTS, keys + [("", "")] * 61, others + [("", "")] * 61, strict=True)
        )
    ]
    path = written(tmp_path, rows)
    read, _ = read_waveform(path)
    assert (read.step, read.values.tolist()) == (1e-6, pytest.approx([1e-3 * volt for volt in VOLTS]))
    assert "'A' as unit of column 5" in refused(path, column=5)


@each("head", ["V_W", "U_N", "V1_A", "CH1 A", "Phase 1 A", "v_amp", "phase UA", "U/N"])
@each("above", [[], ["Trigger source CH1 A"], ["Coupling of CH1 A"]])
def test_a_phase_is_no_unit(tmp_path, head, above):
    path = written(tmp_path, [*above, f"time (s),{head}", *columns(evenly(1e-6), VOLTS)])
    assert read_waveform(path)[0].values == pytest.approx(np.array(VOLTS))


def test_a_column_has_the_name_that_the_file_writes(tmp_path):
    path = written(tmp_path, ["time_s,u_mV", *columns(evenly(1e-6), VOLTS)])
    for name in ("u", "u_mV"):
        assert read_waveform(path, column=name)[0].values == pytest.approx(1e-3 * np.array(VOLTS))


@each("head", ["shaft current", "Strom", "I in A", "Current A", "CH1 (mA)", "i_A", "I_mA", "Kanal 1 / A"])
def test_a_current_is_no_shaft_voltage(tmp_path, head):
    path = written(tmp_path, [f"time (s),{head}", *columns(evenly(1e-6), VOLTS)])
    record = ShaftFile(file=str(path))
    with pytest.raises(InputError, match=r"'m?A' as unit|may be a current"):
        measured_shaft(record)


def test_the_interval_of_owon_is_offered(tmp_path):
    """After OWON HDS242: its other lines have frequencies and periods of the signal."""
    above = ["Channel\t\t\t  :,CH1", "Frequency\t\t  :,F=1.498kHz", "Period \t\t\t  :,T=667.4us"]
    above += ["Voltage per ADC value:,20.00mV", "Time interval\t\t  :,0.40uS", "", "index,CH1_Voltage(mV)"]
    path = written(tmp_path, [*above, *columns(evenly(1), VOLTS)])
    assert "the line 'Time interval :,0.40uS'" in refused(path)
    read, warnings = read_waveform(path, step=0.4e-6)
    assert read.values == pytest.approx(1e-3 * np.array(VOLTS))
    assert "samples-missing" not in [warning.code for warning in warnings]
    _, warnings = read_waveform(path, step=0.8e-6)
    assert "samples-missing" in [warning.code for warning in warnings]


@each("empty", ["{:g},40,", "{:g},,"])
def test_a_channel_may_end_before_the_others(tmp_path, empty):
    rows = columns(evenly(1e-6), VOLTS, VOLTS, form="{:g},{:g},{:g}")
    ends = [empty.format(k * 1e-6) for k in range(64, 80)]
    path = written(tmp_path, ["time (s),CH1 (V),CH2 (V)", *rows, *ends])
    read, warnings = read_waveform(path, column="CH2")
    assert read.values.tolist() == VOLTS
    assert "the last 16 of 80 rows have no value in CH2 (column 3)" in warnings[0].text
    inside = written(tmp_path, ["time (s),CH1 (V),CH2 (V)", *rows[:40], ends[0], *rows[40:]])
    assert "line 42 has" in refused(inside, column="CH2")
