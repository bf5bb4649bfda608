"""Text files of oscilloscopes: formats of the makers, refusals by line, and warnings."""

import math
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES, ROOT

DATA = ROOT / "tests" / "data" / "waveforms"
SHARED = [4.0 * math.sin(2.0 * math.pi * k / 16.0) + k / 100.0 for k in range(48)]


def codes(warnings):
    return [warning.code for warning in warnings]


def written(folder, content, encoding="utf-8"):
    path = folder / "scope.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode(encoding))
    return path


def lines_of(values, step=1.0, head="time [us],CH1 [V]", form="{:g},{:g}"):
    return "\n".join([head, *(form.format(k * step, value) for k, value in enumerate(values))]) + "\n"


def wave(count, seed=0):
    rng = np.random.default_rng(seed)
    return np.sin(np.arange(count) / 7.0) + rng.normal(0.0, 0.02, count)


def refused(path, **keywords):
    with pytest.raises(InputError) as error:
        read_waveform(path, **keywords)
    line = str(error.value)
    assert "\n" not in line
    assert len(line) < 500 + len(str(path))
    return line


@each(
    "name, keywords, told",
    [
        ("tektronix_tds2000", {}, []),
        ("tektronix_mso4000", {}, []),
        ("keysight_infiniivision", {"column": "1"}, []),
        ("keysight_infiniivision", {"column": 3, "scale": 0.5}, []),
        ("rigol_ds1000z", {"step": 4e-9}, []),
        ("lecroy_spreadsheet", {}, ["units-assumed"]),
        ("lecroy_spreadsheet", {"time_unit": "s", "value_unit": "V"}, []),
        ("picoscope", {"column": "channel a"}, []),
        ("picoscope", {"column": "Channel B", "scale": 0.5}, []),
        ("picoscope_german", {}, []),
        ("siglent_sds1000", {}, ["units-assumed"]),
        ("siglent_sds1000", {"value_unit": "V"}, []),
        ("rohde_schwarz_rtm", {}, []),
    ],
)
def test_formats_of_the_makers(name, keywords, told):
    read, warnings = read_waveform(DATA / f"{name}.csv", **keywords)
    assert codes(warnings) == told
    assert read.values == pytest.approx(SHARED, abs=6e-4)
    assert read.step == pytest.approx(4e-9, rel=1e-12)
    # Without times, the first sample is at zero.
    assert read.start == pytest.approx(0.0 if "step" in keywords else -80e-9, rel=1e-9)
    assert read.duration == pytest.approx(47 * 4e-9)


def test_the_record_of_the_examples_contains_the_levels_of_a_dc_link_of_560_volts():
    """Half of the DC link, and a sixth."""
    waveform, _ = read_waveform(EXAMPLES / "measurements" / "common_mode.csv")
    assert sorted(set(waveform.values.round(1).tolist())) == [-280.0, -93.3, 93.3, 280.0]


def test_files_of_the_makers_are_those_that_their_program_writes():
    sys.path.insert(0, str(DATA))
    try:
        from written import FILES
    finally:
        sys.path.remove(str(DATA))
    assert {path.name for path in DATA.glob("*.csv")} == set(FILES)
    for name, lines in FILES.items():
        assert (DATA / name).read_bytes() == ("\r\n".join(lines) + "\r\n").encode()


HEADS = {
    ("time [ms]", "u [kV]"): (1e-3, 1e3),
    ("Time (us)", "CH1 (mV)"): (1e-6, 1e-3),
    ("t_ns", "Voltage_V"): (1e-9, 1.0),
    ("Zeit in s", "C1 in V"): (1.0, 1.0),
    ("TIME (µs)", "Shaft [V]"): (1e-6, 1.0),
    ("Time (\u03bcs)", "Shaft [mV]"): (1e-6, 1e-3),
}


@st.composite
def files(draw):
    """A waveform and a dialect in which it is written: samples, step, start, content of the file."""
    count = draw(st.integers(16, 60))
    steps = draw(st.integers(1, 999))
    start = draw(st.integers(-5000, 5000)) * steps
    samples = draw(st.lists(st.integers(-9999, 9999), min_size=count, max_size=count))
    samples[0], samples[1] = 1234, -777
    heads, factors = draw(st.sampled_from(sorted(HEADS.items())))
    separator, decimal = draw(st.sampled_from([(";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", ".")]))
    spaces = draw(st.sampled_from(["", " "]))
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    encoding = draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]))
    other = draw(st.booleans())

    def number(thousandths):
        return f"{thousandths / 1000:.3f}".replace(".", decimal)

    rows = [
        [number(start + k * steps), number(value), *([number(k)] if other else [])]
        for k, value in enumerate(samples)
    ]
    above = draw(st.sampled_from([[], ["Made on a bench"], ["# remark", "", "Model" + separator + "XY-1"]]))
    heads = [*heads, *(["I [A]"] if other else [])]
    if encoding == "cp1252":
        heads = [head.replace("\u03bc", "µ") for head in heads]
    lines = [*above, separator.join(heads), *((separator + spaces).join(row) for row in rows)]
    lines += draw(st.sampled_from([[], ["", " "], [separator]]))
    content = end.join(lines) + draw(st.sampled_from(["", end]))
    values = np.array(samples) / 1000 * factors[1]
    return values, steps / 1000 * factors[0], start / 1000 * factors[0], content.encode(encoding)


@pytest.mark.slow
@given(files())
def test_any_dialect_is_read_to_the_printed_precision(tmp_path_factory, made):
    values, step, start, content = made
    path = written(tmp_path_factory.mktemp("dialect"), content)
    read, _ = read_waveform(path)
    assert read.values == pytest.approx(values, rel=1e-12)
    assert read.step == pytest.approx(step, rel=1e-9)
    assert read.start == pytest.approx(start, rel=1e-12, abs=1e-9 * step)


@given(
    st.binary(max_size=400)
    | st.text(alphabet="0123456789.,;\t\n -+eE\"'#aVs[]()", max_size=400).map(str.encode)
)
def test_any_content_is_read_or_is_the_error_of_the_project(tmp_path_factory, content):
    path = written(tmp_path_factory.mktemp("any"), content)
    try:
        read, _ = read_waveform(path, step=1e-6)
    except InputError as error:
        lines = str(error).splitlines()
    else:
        lines = ["read"]
        assert np.isfinite(read.values).all()
        assert read.values.size >= 16
    assert len(lines) == 1


GOOD = [f"{k},{value:.4f}" for k, value in enumerate(wave(40))]


@each(
    "lines, message",
    [
        ([], "empty"),
        (["", " ", ""], "empty"),
        (["a word", "and another"], "'and another'"),
        (["time [us],u [V]", *GOOD[:15]], "15 samples.* 16"),
        (["time [us],u [V]", GOOD[0]], " 1 samples"),
        (["time [us],u [V]", "0", *GOOD[1:]], "line 2 is '0'"),
        (["time [us],u [V]", *GOOD[:1], "1,OL", *GOOD[2:]], "range .*line 3: 'OL'"),
        (["time [us],u [V]", *GOOD[:20], "overload", *GOOD[21:]], "range .*line 22: 'overload'"),
        (["time [us],u [V]", *GOOD[:20], "20,abc", *GOOD[21:]], "line 22, column 2: .*'abc'"),
        (["time [us],u [V]", *GOOD[:20], "20,NaN", *GOOD[21:]], "line 22, column 2: .*'NaN'"),
        (["time [us],u [V]", *GOOD[:20], "20,inf", *GOOD[21:]], "range .*line 22: 'inf'"),
        (["time [us],u [V]", *GOOD[:20], "20,-∞", *GOOD[21:]], "range .*line 22: '-∞'"),
        (["time [us],u [V]", *GOOD[:20], "20,1e999", *GOOD[21:]], "line 22, column 2: .*'1e999'"),
        (["time [us],u [V]", *GOOD[:20], "20,", *GOOD[21:]], "line 22 .*column 2"),
        (["time [us],u [V]", *GOOD[:20], "20,0.1,0.2", *GOOD[21:]], "line 22 .*3 columns.* 2"),
        (["time [us],u [V]", *GOOD, "40"], "line 42 .*column 2"),
        ([*GOOD[:1], "text", *GOOD[1:]], "line 2 .*'text'"),
        (["time [us],u [V]", *GOOD[:20], GOOD[19], *GOOD[20:]], "line 22 repeats"),
        (["time [us],u [V]", *GOOD[:20], GOOD[5], *GOOD[20:]], "line 22 .*backward"),
        (["time [us],u [V]", *GOOD[::-1]], "line 3 .*backward"),
        (["time [us],u [V]", *(f"{k**1.01},{k % 3}" for k in range(40))], r"unevenly sampled.* sample \d+ "),
        (["time [us],u [V]", *GOOD[:20], *GOOD[23:]], "unevenly sampled"),
        (["time [us],u [V]", *(f"{k},1.5" for k in range(40))], r" 40 samples of u \(column 2\) .*1\.5"),
        (
            ["time [us],u [V]", *(f"{k},{(-1) ** k}e308" for k in range(40))],
            r"-1e\+308 to 1e\+308 V .*u \(column 2\).* 1e\+09 V",
        ),
        (["time [us],I [A]", *GOOD], r"'A' .*I \(column 2\)"),
        # A column of volts is no time, whatever its name is.
        (["time [V],u [V]", *GOOD], "^column: "),
        (["time [us],u [sausage]", *GOOD], r"'sausage' .*u \(column 2\)"),
        (["time [us]", *(str(k) for k in range(40))], "one column"),
        ([f"{k},{k}" for k in range(40)], "decimal comma"),
    ],
)
def test_refused_files_name_what_is_wrong_and_where(tmp_path, lines, message):
    assert re.search(message, refused(written(tmp_path, "\n".join(lines))))


def test_what_is_no_text_file_is_refused(tmp_path):
    for content, word in (
        (b"0,1\n\0\0\0\n2,3\n", "text"),
        (b"\xff\xfe\x00\xd8" + b"0\x00" * 40, "UTF-16"),
        (b"0," * 100_000 + b"1", "line"),
    ):
        assert word in refused(written(tmp_path, content)).replace(str(tmp_path), "")
    assert "none.csv" in refused(tmp_path / "none.csv")
    assert "directory" in refused(tmp_path).replace(str(tmp_path), "")


@pytest.mark.slow
@each(
    "content",
    [
        "," * 90_000,
        ("," * 9_000 + "\n") * 200,
        "1," * 40_000 + "\n" + "1," * 40_000,
        ("1 " * 20_000 + "\n") * 40,
        '"' * 90_000,
        ('"' + "1" * 200 + "\n") * 2_000,
        "a" * 90_000 + "\n" + "0,1\n" * 20,
        "(" * 60_000 + "\n" + "0 1\n" * 20,
        "Sample Interval," + "1" * 60_000 + "\n" + "0,1\n" * 20,
        "Sample Rate:" + "1 " * 30_000 + "\n" + "0 1\n" * 20,
        "t,u\n" + "0,1\n" * 9 + "1" * 90_000 + ",1\n" + "2,3\n" * 9,
        "\n" * 1_000_000,
    ],
)
def test_hostile_files_are_refused_soon(tmp_path, content):
    began = time.process_time()
    refused(written(tmp_path, content))
    assert time.process_time() - began < 5.0


def test_too_large_a_file_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "large.csv"
    with path.open("wb") as file:
        file.truncate(5_000_000_000)
    assert re.search("5 GB.* 2 GB", refused(path))


def test_channels_are_listed_where_there_are_several(tmp_path):
    text = lines_of(wave(30), head="time [us],CH1 [V],CH2 [V]", form="{0:g},{1:g},{1:g}")
    path = written(tmp_path, text)
    line = refused(path)
    assert line.startswith("column: ")
    assert "CH1 (column 2), CH2 (column 3)" in line
    assert "'CH3'" in refused(path, column="CH3")
    assert " 4," in refused(path, column=4)
    assert refused(path, column="time").startswith("column: ")
    assert read_waveform(path, column=3)[0].values == pytest.approx(
        read_waveform(path, column="ch1")[0].values
    )


def test_a_single_voltage_among_other_columns_needs_no_name(tmp_path):
    text = lines_of(wave(30), head="nr;time [us];I [A];U [V]", form="{0:g};{0:g};7;{1:g}")
    read, warnings = read_waveform(written(tmp_path, text))
    assert (read.values.size, read.step, codes(warnings)) == (30, 1e-6, [])


def test_a_file_without_heads_has_its_times_first(tmp_path):
    read, warnings = read_waveform(
        written(tmp_path, "\n".join(f"{1e-3 * k:.3f} {v:.4f}" for k, v in enumerate(wave(30))))
    )
    assert (read.step, codes(warnings)) == (1e-3, ["units-assumed"])
    assert "column 2 is in V" in warnings[0].text
    assert "column 1 is in s" in warnings[0].text
    path = written(tmp_path, "\n".join(GOOD))
    assert read_waveform(path, time_unit="us", value_unit="mV")[1] == ()
    assert read_waveform(path, time_unit="us", value_unit="mV")[0].step == pytest.approx(1e-6)


def test_slow_times_without_a_unit_are_refused(tmp_path):
    """Times in milliseconds are not taken as seconds; a unit that the user gives is believed."""
    path = written(tmp_path, "\n".join(f"{0.1 * k:.1f},{value:.4f}" for k, value in enumerate(wave(30))))
    assert " 0.1 s " in refused(path)
    assert refused(path).startswith("time_unit: missing")
    assert read_waveform(path, time_unit="ms")[0].step == pytest.approx(1e-4)
    assert read_waveform(path, time_unit="s")[0].step == pytest.approx(0.1)


def test_a_file_without_times_needs_the_interval(tmp_path):
    path = written(tmp_path, "u [V]\n" + "\n".join(f"{value:.4f}" for value in wave(30)))
    assert refused(path).startswith("step: missing")
    assert read_waveform(path, step=2e-9)[0].step == 2e-9
    assert " 0 s" in refused(path, step=0.0)
    assert refused(path, step=1.0, scale=0.0).startswith("scale: ")
    decimal = written(tmp_path, "u [V]\n" + "\n".join(f"{value:.4f}".replace(".", ",") for value in wave(30)))
    assert read_waveform(decimal, step=2e-9)[0].values == pytest.approx(wave(30), abs=1e-4)


@each(
    "stated",
    ["Sample Interval,4e-9", "Sampling Period: 4 ns", "Sample Rate,250000000.0", "Sampling Rate: 250 MSa/s"],
)
def test_an_interval_that_a_line_above_states_is_asked_for(tmp_path, stated):
    path = written(tmp_path, f"{stated}\nCH1 [V],CH2 [V]\n" + "\n".join(f"{v:.4f},0" for v in wave(30)))
    line = refused(path, column="CH1")
    assert line.startswith("step: missing")
    assert stated in line
    assert "'4 ns'" in line
    assert read_waveform(path, column="CH1", step=4e-9)[0].step == 4e-9


def test_a_file_with_an_interval_in_its_second_row_is_not_guessed():
    """After Rigol: numbers of samples, and no times."""
    line = refused(DATA / "rigol_ds1000z.csv")
    assert line.startswith("step: missing")
    assert "'Increment: 4.000000e-09'" in line
    assert "'Sequence' as unit of X (column 1)" in refused(DATA / "rigol_ds1000z.csv", time_column="X")


@each(
    "above, key, found",
    [
        ("Vertical Units,mV,V,mV", "value_unit", "mV, V, mV"),
        ("Vertical Units,dB", "value_unit", "dB"),
        ("Horizontal Units,points", "time_unit", "points"),
        ("yunit: CH1", "value_unit", "CH1"),
    ],
)
def test_units_above_that_are_not_clear_are_asked_for(tmp_path, above, key, found):
    text = "\n".join([above, "TIME,CH1,CH2", *(f"{k}e-6,{v:.4f},0" for k, v in enumerate(wave(30)))])
    line = refused(written(tmp_path, text), column="CH1")
    assert line.startswith(f"{key}: ")
    assert f"'{found}'" in line


def test_units_above_that_differ_from_those_of_the_user_are_refused(tmp_path):
    text = "\n".join(["Vertical Units,mV", "TIME,CH1", *(f"{k}e-6,{v:.4f}" for k, v in enumerate(wave(30)))])
    path = written(tmp_path, text)
    assert read_waveform(path)[0].values == pytest.approx(1e-3 * wave(30), abs=1e-7)
    assert refused(path, value_unit="V").startswith("value_unit: ")


@each("above", ["Made on a bench", "# bench 3, run 7, again", "Time (us) CH 1 (V)"])
def test_a_line_above_without_names_is_not_passed_over(tmp_path, above):
    text = "\n".join([above, *(f"{k}e-6 {v:.4f}" for k, v in enumerate(wave(30)))])
    path = written(tmp_path, text)
    assert refused(path).startswith("time_column: missing")
    line = refused(path, time_column=1, column=2)
    assert line.startswith("value_unit: missing")
    assert above.strip("# ") in line
    assert refused(path, time_column=1, column=2, value_unit="V").startswith("time_unit: missing")
    read, warnings = read_waveform(path, time_column=1, column=2, value_unit="V", time_unit="s")
    assert (read.step, warnings) == (pytest.approx(1e-6), ())


def test_units_of_the_user_and_of_the_file_must_agree(tmp_path):
    path = written(tmp_path, lines_of(wave(30)))
    assert read_waveform(path, time_unit="µs", value_unit="V")[0].step == 1e-6
    assert re.search("^value_unit: .*'mV'", refused(path, value_unit="mV"))
    assert re.search("^time_unit: .*'V'", refused(path, time_unit="V"))
    unknown = written(tmp_path, lines_of(wave(30), head="time [us],u [CH1]"))
    assert "'CH1'" in refused(unknown)


def test_columns_that_are_not_known_are_asked_for(tmp_path):
    path = written(tmp_path, lines_of(wave(30), head="foo,bar [V]"))
    assert "time" in refused(path).replace(str(tmp_path), "")
    assert read_waveform(path, time_column="foo", time_unit="us")[0].step == pytest.approx(1e-6)


def test_the_step_comes_from_the_whole_record_where_times_have_few_digits(tmp_path):
    """Times of 1.25 ns printed in steps of 1 ns: distances of 1 and 2 ns, none a repetition."""
    path = written(tmp_path, lines_of(wave(401), step=1.25, head="time [ns],u [V]", form="{:.0f},{:.4f}"))
    read, _ = read_waveform(path)
    assert read.step == pytest.approx(1.25e-9, rel=1e-12)


def test_repeated_times_are_replaced_by_a_given_interval(tmp_path):
    path = written(tmp_path, lines_of(wave(400), step=0.4, head="time [ns],u [V]", form="{:.0f},{:.4f}"))
    assert "step" in refused(path).replace(str(tmp_path), "")
    read, _ = read_waveform(path, step=0.4e-9)
    assert (read.start, read.step) == (0.0, 0.4e-9)
    assert refused(path, step=0.5e-9).startswith("step: ")


@pytest.mark.parametrize(("share", "even"), [(5e-4, True), (3e-3, False)])
def test_jitter_above_a_thousandth_of_a_step_is_refused(tmp_path, share, even):
    rng = np.random.default_rng(3)
    times = np.arange(5000) + share * rng.uniform(-1.0, 1.0, 5000)
    times[[0, -1]] = 0, 4999
    path = written(
        tmp_path,
        "t [s],u [V]\n" + "\n".join(f"{t:.9f},{v:.4f}" for t, v in zip(times, wave(5000), strict=True)),
    )
    if even:
        assert read_waveform(path)[0].step == pytest.approx(1.0, rel=1e-12)
    else:
        assert "unevenly sampled" in refused(path)


def test_a_gap_that_rounding_may_explain_is_told(tmp_path):
    times = [k + (k >= 250) for k in range(500)]
    path = written(
        tmp_path, "t [s],u [V]\n" + "\n".join(f"{t},{v:.4f}" for t, v in zip(times, wave(500), strict=True))
    )
    _, warnings = read_waveform(path)
    assert codes(warnings) == ["samples-missing"]
    assert "sample 250" in warnings[0].text


def test_a_file_that_is_cut_off_is_told(tmp_path):
    lines = (DATA / "tektronix_mso4000.csv").read_text().splitlines()[:-10]
    _, warnings = read_waveform(written(tmp_path, "\n".join(lines)))
    assert codes(warnings) == ["samples-missing"]
    assert re.search(" 48 .* 38", warnings[0].text)


def test_a_clipped_waveform_is_told(tmp_path):
    path = written(tmp_path, lines_of(np.minimum(wave(2000), 0.8), form="{:g},{:.4f}"))
    read, warnings = read_waveform(path)
    assert codes(warnings) == ["waveform-clipped"]
    assert f"{np.count_nonzero(read.values == 0.8)} samples" in warnings[0].text
    assert "0.8 V" in warnings[0].text


@pytest.mark.slow
def test_lines_of_several_blocks_are_counted(tmp_path):
    """A file of some ten megabytes: the error of a line far behind the first block."""
    good = "".join(f"{k},{k % 7}.{'1' * 24}\n" for k in range(300_000))
    path = written(tmp_path, "time [us],u [V]\n" + good)
    assert read_waveform(path)[0].values.size == 300_000
    with path.open("a") as file:
        file.write("300000,x\n")
    assert re.search("line 300002, column 2: .*'x'", refused(path))


PEAK = """
import sys
from pathlib import Path
from ehlectric.drive.waveform.waveform_file import read_waveform
read, _ = read_waveform(sys.argv[1])
status = Path("/proc/self/status").read_text()
print(read.values.size, 1024 * int(status.partition("VmHWM:")[2].split()[0]))
"""


@pytest.mark.slow
def test_memory_grows_with_the_samples(tmp_path):
    """At most 48 bytes a sample, so that ten million need less than 0.5 GB beside the program."""
    peaks = []
    for count in (600_000, 2_600_000):
        k = np.arange(count)
        text = "time [s],u [V]\n" + "".join(f"{a * 4e-9:.8e},{a % 977 / 7:.3f}\n" for a in k.tolist())
        path = written(tmp_path, text)
        done = subprocess.run(
            [sys.executable, "-c", PEAK, str(path)], capture_output=True, text=True, check=True, timeout=300
        )
        size, peak = map(int, done.stdout.split())
        assert size == count
        peaks.append(peak)
    assert peaks[1] - peaks[0] < 48 * 2_000_000


def test_a_path_may_be_a_text(tmp_path):
    path = written(tmp_path, lines_of(wave(30)))
    assert read_waveform(str(path))[0].values == pytest.approx(read_waveform(Path(path))[0].values)


def test_quoted_fields_with_separators_of_thousands(tmp_path):
    values = wave(64)
    quoted = lines_of(values, 50.5, '"time, zeroed [us]","CH1 [V]"', '"{:,.1f}","{:.6f}"')
    assert '"1,010.0"' in quoted
    read, warnings = read_waveform(written(tmp_path, quoted))
    assert read.step == pytest.approx(50.5e-6)
    assert read.values == pytest.approx(values, abs=1e-6)
    assert not warnings
