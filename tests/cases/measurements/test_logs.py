"""Logs of film and traction rigs and of LCR meters as these write them: steps below each other, a head that
stands twice, units below the heads and in the cells.
"""

import math

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings

from ehlectric import Case, film_factors
from ehlectric.cases.measurements import capacitance_of, read_measurement
from ehlectric.errors import InputError
from tests.contact.measured.test_film import BALL, formula
from tests.helpers.each import each
from tests.helpers.text_variants import Written, variants

HEADS = (
    "Rolling Speed (mm/s)\tAverage Film (nm)\tLube Temp (°C)\tBall Load (N)\t\tRolling Speed (mm/s)\tSRR (%)"
)
EHD = f"""\
EHD Test Data File

Profile description:\tX

Step 1 "Film" started at 01/01/2001 10:00

{HEADS}
1000.0\t200.0\t40.1\t20.0\t\t1000.02\t0.00
500.0\t125.7\t40.2\t20.0\t\t500.02\t0.00

Step 2 "Film, hot" started at 01/01/2001 10:30

{HEADS}
1000.0\t100.0\t80.1\t30.0\t\t1000.02\t50.00

Step 3 "Zero" started at 01/01/2001 10:40
"""


def read(tmp_path, text):
    (tmp_path / "log.txt").write_text(text, encoding="utf-8")
    return read_measurement(tmp_path / "log.txt")


def test_a_film_log_as_its_rig_writes_it(tmp_path):
    """Values as printed in the file above."""
    log = read(tmp_path, EHD)
    assert log.values["entrainment_speed"] == pytest.approx([1.0, 0.5, 1.0])
    assert log.values["film"] == pytest.approx([200e-9, 125.7e-9, 100e-9])
    assert log.values["temperature"] == pytest.approx([313.25, 313.35, 353.25])
    assert log.values["load"] == pytest.approx([20.0, 20.0, 30.0])
    assert log.values["slide_to_roll_ratio"] == pytest.approx([0.0, 0.0, 0.5])
    assert log.lines == (8, 9, 14)
    assert log.ignored == ("Rolling Speed (mm/s)",)


def test_each_row_has_the_film_at_its_load_and_temperature(tmp_path):
    """Films of the log are 0.8 of the films of the formula at the speed, load and temperature of each row."""
    oil = {
        "base": "paper",
        "temperature": {
            "kinematic_viscosity_40": "46 mm^2/s",
            "kinematic_viscosity_100": "6.8 mm^2/s",
            "density_15": "870 kg/m^3",
        },
    }
    case = Case.point(**BALL, entrainment_speed="1 m/s", lubricant=oil, temperature="40 degC")
    rows = [(1.0, 20.0, 40.0), (0.5, 20.0, 40.0), (1.0, 30.0, 80.0)]
    changes = [{"contact.load": load, "contact.temperature": warm + 273.15} for _, load, warm in rows]
    films = [formula(case.replace(change), speed) for change, (speed, *_) in zip(changes, rows, strict=True)]
    cells = [
        f"{1e3 * v}\t{0.8e9 * film:.4f}\t{warm}\t{load}\t\t{1e3 * v}\t0"
        for film, (v, load, warm) in zip(films, rows, strict=True)
    ]
    log = read(tmp_path, "\n".join([HEADS, *cells[:2], "", "Step 2", HEADS, cells[2]]))
    found = film_factors(case, log, contacts="formula", uncertainty="1 %")
    assert found.columns["film_factor"] == pytest.approx([0.8] * 3, rel=1e-5)


MTM = """\
MTM Data File
Step 1 "Traction" started at 01/01/2001 10:00
Time (s)\tRolling Speed (mm/s)\tSRR (%)\tTraction Coeff (-)\tBall Load (N)\tLube Temp (°C)\tPot Temp (°C)
0\t2000\t1.0\t0.012\t20.1\t40.0\t38.0
1\t2000\t50.0\t0.055\t20.1\t40.0\t38.0
Step 2 "Traction" started at 01/01/2001 10:10
Time (s)\tRolling Speed (mm/s)\tSRR (%)\tTraction Coeff (-)\tBall Load (N)\tLube Temp (°C)\tPot Temp (°C)
0\t1000\t1.0\t0.015\t20.1\t60.0\t38.0
"""


def test_a_traction_log_contains_no_film(tmp_path):
    log = read(tmp_path, MTM)
    assert log.values["slide_to_roll_ratio"] == pytest.approx([0.01, 0.5, 0.01])
    assert log.values["entrainment_speed"] == pytest.approx([2.0, 2.0, 1.0])
    assert log.values["temperature"] == pytest.approx([313.15, 313.15, 333.15])
    case = Case.point(**BALL, entrainment_speed="1 m/s", lubricant="paper")
    assert log.values["traction_coefficient"] == pytest.approx([0.012, 0.055, 0.015])
    with pytest.raises(InputError, match=r"film: missing.*a traction coefficient gives no film factor"):
        film_factors(case, log)


def test_a_step_before_the_films_is_a_note(tmp_path):
    zero = f"Step 0, zero\nTime (s)\tRolling Speed (mm/s)\n0\t5\n1\t6\n\nStep 1\tFilm\n{HEADS}"
    log = read(tmp_path, EHD.replace(HEADS, zero, 1))
    assert log.values["film"] == pytest.approx([200e-9, 125.7e-9, 100e-9])
    assert any("the table below line" in text for text in log.ignored)


def test_a_step_without_the_measured_quantity_is_a_note(tmp_path):
    log = read(
        tmp_path, EHD.replace("Step 3", "Step 3\nTime (s)\tRolling Speed (mm/s)\n0\t5\n1\t6\n\nStep 4")
    )
    assert log.size == 3
    assert "the table below line 17" in log.ignored[-1]


@each(
    "text, values",
    [
        (
            "Freq,Cp\n100 kHz,123.4 pF\n1 MHz,0.1234 nF\n",
            {"capacitance": [123.4e-12] * 2, "frequency": [1e5, 1e6]},
        ),
        ("Frequency;Cp\n100 kHz;123,4 pF\n100 kHz;1,5 pF\n", {"capacitance": [123.4e-12, 1.5e-12]}),
        ("freq [kHz]\tCp [pF]\n100\t123.4 pF\n100\t0.1234 nF\n", {"capacitance": [123.4e-12] * 2}),
        ("frequency,cp,D\n[kHz],[pF],\n100,123.4,0.01\n", {"capacitance": [123.4e-12], "frequency": [1e5]}),
        ("frequency;cp\nHz;pF\n100000;123,4\n", {"capacitance": [123.4e-12], "frequency": [1e5]}),
        (
            "|Z|,θ,Freq\n1.2 kΩ,-89.5 °,100 kHz\n",
            {"impedance": [1200.0], "phase": [math.radians(-89.5)], "frequency": [1e5]},
        ),
    ],
)
def test_units_in_the_cells_and_below_the_heads(text, values, tmp_path):
    log = read(tmp_path, text)
    for name, expected in values.items():
        assert log.values[name] == pytest.approx(expected, rel=1e-12)
    frame = pd.DataFrame({"Cp": ["123.4 pF", "2 nF"], "speed [rpm]": [10, 20]})
    assert read_measurement(frame).values["capacitance"] == pytest.approx([123.4e-12, 2e-9])


def test_a_meter_with_impedances_in_its_cells(tmp_path):
    """C = -sin(phase)/(2 pi f |Z|) by hand."""
    log = read(tmp_path, "|Z|,phase,freq\n1.2 kΩ,-90 °,100 kHz\n")
    assert capacitance_of(log).value == pytest.approx([1.0 / (2.0 * math.pi * 1e5 * 1200.0)])


@each(
    "text, parts",
    [
        ("Cp,freq\n123.4 pF,1 kHz\n1e-10,1 kHz\n", ("line 3", "'1e-10'", "without a unit")),
        ("Cp [pF]\n123.4 kHz\n", ("line 2", "kHz")),
        ("Cp\n123.4\n", ("column 'Cp'", "no unit")),
        ("film [nm]\tspeed [m/s]\n1\t1\nStep 2\n2\t2\n", ("line 4", "below 'Step 2'")),
        ("film [nm],speed [m/s],film [nm]\n100,1,100.5\n100,1,150\n", ("two columns", "line 3", "'150'")),
        (f"{HEADS}\n1\t1\t1\t1\t\t1\t0\n{HEADS}\n1\t1\t1\t1\t\t2\t0\n", ("two columns", "line 4", "'2'")),
        ("film [nm],u\n1,1\n\nfilm [nm],temperature [degC]\n1,1\n", ("different columns", "line 4")),
        ("film [nm],speed [m/s]\n100,1\nend,of file\n", ("line 3", "'end'")),
        ("film [nm],speed [m/s]\n100,1\n100\n", ("line 3 has 1 columns",)),
    ],
)
def test_what_a_log_leaves_open_is_refused(text, parts, tmp_path):
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    assert all(part in str(error.value) for part in parts)


FILM_LOG = (
    Written(
        ("Rolling Speed", "entrainment speed", "Mean speed"),
        (("m/s", 1.0), ("mm/s", 1e3), ("cm/s", 1e2)),
        (1.0, 0.5, 0.31),
    ),
    Written(
        ("Average Film", "film", "Central film thickness"),
        (("nm", 1e9), ("µm", 1e6), ("um", 1e6), ("m", 1.0)),
        (2.003e-7, 1.257e-7, 8.93e-8),
    ),
    Written(("Ball Load", "load"), (("N", 1.0), ("mN", 1e3)), (20.0, 20.05, 19.98)),
)
METER_LOG = (
    Written(("speed", "Shaft speed"), (("rpm", 30.0 / math.pi), ("rad/s", 1.0)), (10.0, 21.5, 300.25)),
    Written(
        ("capacitance", "Cp", "Parallel capacitance"),
        (("pF", 1e12), ("nF", 1e9), ("F", 1.0)),
        (2e-10, 1.5e-10, 3.25e-10),
    ),
    Written(("frequency", "Freq"), (("kHz", 1e-3), ("Hz", 1.0)), (1e5, 1e5, 2.5e5)),
)
NAMES = {
    "film": ("entrainment_speed", "film", "load"),
    "meter": ("speed", "capacitance", "frequency"),
}
COUNTS = {"film": [0, 0], "meter": [0, 0]}


def check_variant(content, folder, kind, columns):
    path = folder / "log.txt"
    path.write_bytes(content)
    try:
        log = read_measurement(path)
    except InputError:
        COUNTS[kind][1] += 1
        return
    COUNTS[kind][0] += 1
    for name, column in zip(NAMES[kind], columns, strict=True):
        order = np.argsort(log.values["entrainment_speed" if kind == "film" else "speed"])
        expected = np.array(column.values)[np.argsort(columns[0].values)]
        assert log.values[name][order] == pytest.approx(expected, rel=1e-5), content


@given(content=variants(FILM_LOG))
@settings(max_examples=60)
def test_variants_of_a_film_log_are_read_or_refused(tmp_path_factory, content):
    check_variant(content, tmp_path_factory.mktemp("log"), "film", FILM_LOG)


@given(content=variants(METER_LOG))
@settings(max_examples=60)
def test_variants_of_a_meter_log_are_read_or_refused(tmp_path_factory, content):
    check_variant(content, tmp_path_factory.mktemp("log"), "meter", METER_LOG)


def test_most_variants_are_read():
    for kind, (good, wrong) in COUNTS.items():
        assert good >= 2 * wrong, kind
