"""Binary waveforms: files of independent writers give the numbers that were written, or the refusal."""

import re
import sys

import numpy as np
import pytest
import scipy

from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from tests.helpers import binary_waveforms as write
from tests.helpers.each import each

# The library imports matplotlib.
pytestmark = [pytest.mark.slow, pytest.mark.gate]

STEP, START = 4e-9, -80e-9
COUNTS = np.array([1600, 1640, 1680, 1620, -1580, -1540, -1600, -1560] * 8)
VOLTS = 0.025 * COUNTS
TIMES = START + STEP * np.arange(64)
EVEN = {"wf_increment": STEP, "wf_start_offset": START, "unit_string": "V"}
LECROY = {"gain": 0.025, "offset": 0.0, "interval": STEP, "start": START}
TEKTRONIX = {"interval": STEP, "start": START, "factor": 0.025}

FILES = {
    "mat": write.mat({"time": TIMES, "CH1_V": VOLTS}),
    "mat_columns": write.mat({"t": TIMES[:, np.newaxis], "U_V": VOLTS[:, np.newaxis]}),
    "tdms": write.tdms({"Shaft": (VOLTS, EVEN)}),
    "trc": write.trc(COUNTS, **LECROY),
    "trc_big": write.trc(COUNTS, **LECROY, order=">"),
    "isf": write.isf(COUNTS, **TEKTRONIX),
}


def written(folder, content):
    path = folder / "scope.bin"
    path.write_bytes(content)
    return path


def refused(path, **keywords):
    with pytest.raises(InputError) as error:
        read_waveform(path, **keywords)
    return str(error.value).replace(str(path), "FILE")


@each("kind", list(FILES))
def test_numbers_of_binary_files(tmp_path, kind):
    read, _ = read_waveform(written(tmp_path, FILES[kind]))
    assert read.values == pytest.approx(VOLTS, rel=1e-6)
    assert read.start == pytest.approx(START, rel=1e-9)
    assert read.step == pytest.approx(STEP, rel=1e-12)


@each(
    "content, keywords, words",
    [
        (write.trc(COUNTS, **LECROY, segments=4), {}, "4 segments"),
        (write.trc(COUNTS, **LECROY, unit="A"), {}, "'A'"),
        (write.trc(COUNTS, **LECROY, kind=6), {}, "type 6"),
        (write.trc(COUNTS, **LECROY)[:-40], {}, "RigolWFM"),
        (write.isf(COUNTS, **TEKTRONIX, form="ENV"), {}, "envelope"),
        (write.isf(COUNTS, **TEKTRONIX, sign="RP"), {}, "'RP'"),
        (write.isf(COUNTS, **TEKTRONIX, unit="A"), {}, "'A'"),
        (write.isf(COUNTS, **TEKTRONIX)[:-40], {}, "RigolWFM"),
        (
            write.isf(COUNTS[:60], **TEKTRONIX).replace(b"NR_P 60", b"NR_P 64"),
            {},
            "60 samples, but states 64",
        ),
        (write.isf(COUNTS, **TEKTRONIX).replace(b"YMU", b"XXX"), {}, "factor"),
        (write.mat({"A": VOLTS, "Tinterval": 4e-9}), {}, "step: missing.*Tinterval: 4e-09"),
        (write.mat({"time": TIMES, "A": VOLTS, "B": VOLTS}), {}, "column: missing.*A .*B "),
        (write.mat({"time": TIMES[:-1], "A": VOLTS}), {}, "63 .*64"),
        (write.mat({"time": TIMES, "A": np.where(VOLTS > 41, np.inf, VOLTS)}), {}, "range .* 8 samples"),
        (write.mat({"time": TIMES, "A": np.where(VOLTS > 41, np.nan, VOLTS)}), {}, "no number in 8 samples"),
        (write.mat({"time": TIMES, "A": COUNTS}), {}, "scale: missing"),
        (write.mat({"time": TIMES**2, "A": VOLTS}), {"column": "A"}, "FILE"),
        (write.mat({}), {}, "0 columns"),
        (b"MATLAB 5.0 MAT-file".ljust(128) + b"\1" * 300, {}, "SciPy"),
        (FILES["mat"][:-40], {}, "SciPy"),
        (FILES["tdms"][:-40], {}, "damaged"),
        (write.tdms({"I": (VOLTS, EVEN | {"unit_string": "A"})}), {}, "'A'"),
        (write.tdms({"U": (COUNTS, EVEN | {"unit_string": ""})}), {}, "scale: missing"),
        (write.tdms({"U": (VOLTS, {})}), {}, "step: missing"),
    ],
)
def test_refused_binary_files(tmp_path, content, keywords, words):
    assert re.search(words, refused(written(tmp_path, content), **keywords))


@pytest.mark.parametrize("compressed", [False, True])
@pytest.mark.parametrize("kind", ["f8", "f4"])
def test_arrays_that_scipy_writes(tmp_path, compressed, kind):
    path = tmp_path / "scope.mat"
    others = {"note": "text", "cell": np.array(["a", 1], object), "both": VOLTS + 1j, "field": {"x": VOLTS}}
    arrays = {"time_ns": 1e9 * TIMES, "CH1_V": VOLTS.astype(kind), "on": VOLTS > 0}
    scipy.io.savemat(path, arrays | others, do_compression=compressed)
    read, _ = read_waveform(path)
    assert read.values == pytest.approx(VOLTS, rel=1e-6)
    assert (read.start, read.step) == pytest.approx((START, STEP), rel=1e-9)


def test_keys_apply_to_binary_files(tmp_path):
    two = written(tmp_path, write.mat({"t_us": 1e6 * TIMES, "data": np.stack([VOLTS, 2 * VOLTS], axis=1)}))
    read, warnings = read_waveform(two, column="data(:,2)")
    assert read.values == pytest.approx(2 * VOLTS)
    assert warnings[0].code == "units-assumed"
    counts = written(tmp_path, write.mat({"time": TIMES, "A": COUNTS}))
    assert read_waveform(counts, scale=0.025)[0].values == pytest.approx(VOLTS)
    several = written(
        tmp_path, write.tdms({"A": (VOLTS, EVEN), "B": (2 * VOLTS, EVEN | {"unit_string": "mV"})})
    )
    assert read_waveform(several, column="B")[0].values == pytest.approx(2e-3 * VOLTS)


@each("kind, module", [("tdms", "nptdms"), ("trc", "RigolWFM.wfm"), ("isf", "RigolWFM.wfm")])
def test_a_missing_package_is_named(tmp_path, monkeypatch, kind, module):
    monkeypatch.setitem(sys.modules, module, None)
    assert "ehlectric[scopes]" in refused(written(tmp_path, FILES[kind]))
