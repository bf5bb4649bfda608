"""Measurements in text files: heads with units, separators, decimal marks, and lines that are refused."""

import math
import time

import numpy as np
import pandas as pd
import pytest

from ehlectric.cases.measurements import (
    CYCLE,
    GEAR_CYCLE,
    MEASURED,
    MOST_ROWS,
    column_of,
    read_measurement,
    void_rows,
)
from ehlectric.cases.viscosity_tables import VISCOSITIES
from ehlectric.errors import InputError
from tests.helpers.each import each

RPM = math.pi / 30.0


def read(tmp_path, text, **encoding):
    path = tmp_path / "data.csv"
    path.write_text(text, **(encoding or {"encoding": "utf-8"}))
    return read_measurement(path)


def refused(tmp_path, text):
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    line = str(error.value)
    assert "\n" not in line
    return line.removeprefix(f"{tmp_path}/")


TWO = {"speed": [1000 * RPM, 3000 * RPM], "capacitance": [260.5e-12, 190e-12]}


@each(
    "text",
    [
        "speed [rpm],capacitance [pF]\n1000,260.5\n3000,190\n",
        "speed [rpm];capacitance [pF]\n1000;260,5\n3000;190\n",
        "Speed (1/min)\tCapacitance (nF)\n1000\t0.2605\n3000\t0.190\n",
        "# made by hand\n# speed [rpm], Cp [F]\n1000, 2.605e-10\n\n# a pause\n3000, 190e-12\n",
        "speed_rpm,Cp_pF\n1000,260.5\n3000,190\n",
        "speed rpm,Capacitance_F\n1000,260.5e-12\n3000,1.9e-10\n",
        "Drehzahl in 1/min;Kapazität / pF\n1000;260,5\n3000;190\n",
        "Vitesse de rotation [tr/min];capacité (nF)\n1000;0,2605\n3000;0,190\n",
        "Vitesse (tr/min);Capacité (pF)\n1000;260,5\n3000;190\n",
        "vitesse_tr_min;capacite_pF\n1000;260,5\n3000;190\n",
        "rpm,Cp_pF\n1000,260.5\n3000,190\n",
        "speed_radps,Cp_pF\n104.71975511965977,260.5\n314.1592653589793,190\n",
        "speed_1/min,cp: pF,remark_a\n1000,260.5,2\n3000,190,3\n",
        "\tspeed [rpm]\tcapacitance [pF]\n0\t1000\t260.5\n1\t3000\t190\n",  # to_csv of pandas, with its index
        "#\tspeed [rpm]\tcapacitance [pF]\n1000\t260.5\n3000\t190\n",
        "LCR meter 7\nOperator;N. N.\nShaft_speed [U/min];CAPACITANCE [pF]\r\n1000;260.5\r\n3000;190.0\r\n",
    ],
)
def test_ways_to_write_the_same_rows(tmp_path, text):
    measured = read(tmp_path, text)
    assert set(measured.values) == set(TWO)
    for name, values in TWO.items():
        assert measured.values[name] == pytest.approx(values, rel=1e-12)


@each("unit", ["in Grad Celsius", "[degré Celsius]", "(°C)", "in grad C", "_degC"])
def test_degrees_celsius_in_words(tmp_path, unit):
    measured = read(tmp_path, f"temperature {unit},film [µm]\n40,0.3\n".replace(" _", "_"))
    assert measured.values["temperature"] == pytest.approx([313.15])


@each(
    ("heads", "names"),
    [
        ("speed [rpm],x [mm],film [nm]", {"speed", "film"}),
        ("speed [rpm],R [mm],d,film [nm]", {"speed", "film"}),
        ("speed [rpm],phi [deg],capacitance [pF]", {"speed", "capacitance"}),
        ("rpm,speed [rpm],capacitance [pF]", {"speed", "capacitance"}),
        ("speed_rpm,speed_radps,capacitance_pF", {"speed", "capacitance"}),
        (
            "speed [rpm],frequency [Hz],R [ohm],X [ohm]",
            {"speed", "frequency", "series_resistance", "reactance"},
        ),
    ],
)
def test_a_head_in_doubt_counts_only_if_no_other_names_its_quantity(tmp_path, heads, names):
    """A letter of a meter may be a place, and a bare unit a second speed: 350 is no phase."""
    measured = read(tmp_path, f"{heads}\n{','.join(['350'] * (heads.count(',') + 1))}\n")
    assert set(measured.values) == names
    assert measured.values["speed"] == pytest.approx([350.0 * RPM])


def test_the_speed_of_a_vehicle_goes_before_a_bare_unit(tmp_path):
    path = tmp_path / "drive.csv"
    path.write_text("time [s],speed [km/h],rpm,torque [N m]\n0,100,955,5\n1,100,955,5\n", encoding="utf-8")
    measured = read_measurement(path, GEAR_CYCLE)
    assert measured.values["vehicle_speed"] == pytest.approx([100.0 / 3.6] * 2)
    assert "rpm" in measured.ignored


@each("head", ["Vitesse [tr/min]", "velocity [rpm]", "vitesse_tr/min", "rpm", "Geschwindigkeit in U/min"])
def test_the_speed_of_a_shaft_and_of_a_vehicle_by_their_units(head):
    assert column_of(head, GEAR_CYCLE).name == "speed"
    assert column_of("Vitesse [km/h]", GEAR_CYCLE).name == "vehicle_speed"


@each("encoding", ["utf-8-sig", "utf-16", "cp1252"])
def test_encodings_of_instruments(tmp_path, encoding):
    measured = read(tmp_path, "temperature [°C],film [µm]\n40,0.3\n", encoding=encoding)
    assert measured.values["temperature"].tolist() == [313.15]
    assert measured.values["film"] == pytest.approx([3e-7])


def test_all_quantities_are_in_si_units(tmp_path):
    measured = read(
        tmp_path,
        "time [ms],u [-],entrainment speed [mm/s],impedance [kOhm],phase [°],frequency [kHz],film [nm]\n"
        "1,0,20,3,-90,20,140\n",
    )
    found = {name: float(values[0]) for name, values in measured.values.items()}
    assert found == pytest.approx(
        {"time": 1e-3, "entrainment_speed": 0.02, "impedance": 3e3, "phase": -math.pi / 2, "frequency": 2e4}
        | {"film": 1.4e-7}
    )
    assert measured.ignored == ("u [-]",)
    assert measured.lines == (2,)


def test_uncertainties_are_those_of_their_quantity(tmp_path):
    measured = read(tmp_path, "film [nm],uncertainty [%],speed [m/s]\n200,5,1\n100,10,2\n")
    assert measured.uncertainties["film"] == pytest.approx([1e-8, 1e-8])
    measured = read(tmp_path, "capacitance [pF],uncertainty of capacitance [fF]\n200,500\n")
    assert measured.uncertainties["capacitance"] == pytest.approx([5e-13])
    measured = read(tmp_path, "capacitance [pF],temperature [degC],temperature uncertainty [K]\n200,70,2\n")
    assert measured.uncertainties["temperature"] == pytest.approx([2.0])


def test_a_table_of_pandas_is_read_by_its_heads():
    frame = pd.DataFrame({"speed [rpm]": [1000, 3000], "capacitance [pF]": np.array([260.5, 190.0])})
    measured = read_measurement(frame)
    for name, values in TWO.items():
        assert measured.values[name] == pytest.approx(values, rel=1e-12)


@each(
    "text, line",
    [
        (
            "speed [rpm],capacitance [pF]\n1000,abc\n",
            "line 2, capacitance [pF]: got 'abc'; expected a number",
        ),
        (
            "speed [rpm],capacitance [pF]\n\n1000,\n2000,nan\n",
            "has no row with a number in every known column",
        ),
        ("speed [rpm],capacitance [pF]\n1000,inf\n", "got 'inf'"),
        ("speed [rpm],capacitance [pF]\n1000,1e999\n", "expected a finite number"),
        ("speed [rpm],capacitance [pF]\n-5,100\n", "line 2, speed [rpm]: got '-5'; expected above 0 rad/s"),
        ("speed [rpm],capacitance [pF]\n1000,1,5\n", "line 2 has 3 columns; expected 2 as in its headings"),
        ("speed [rpm];capacitance [pF]\n1000;1,5\n2000;1.5\n", "mixes decimal points and decimal commas"),
        ("speed;capacitance [pF]\n1000;1,5\n", "column 'speed': has no unit; expected a unit in brackets"),
        ("speed [kg],capacitance [pF]\n1,2\n", "column 'speed [kg]': has the unit 'kg'"),
        ("speed [%],capacitance [pF]\n1,2\n", "column 'speed [%]': has the unit '%'"),
        ("speed [rpm],capacitance [%]\n1,2\n", "the value of 100 % is unknown); expected values in pF"),
        ("phase [percent],film [nm]\n1,2\n", "percent is not a unit of an angle"),
        (
            "a,b\n1,2\n",
            "has no headings of known columns, but 'a', 'b'; expected headings such as",
        ),
        ("speed [rpm],capacitance [pF]\n", "has no rows below its headings"),
        ("speed [rpm],shaft speed [rpm]\n1,2\n", "has the columns 'speed [rpm]' and 'shaft speed [rpm]'"),
        ("speed [rpm],film uncertainty [nm]\n1,2\n", "expected a column film with it"),
        ("film [nm],uncertainty [s]\n1,2\n", "s is not a unit of this quantity"),
        ("film [nm],uncertainty [nm]\n1,0\n", "has a value of 0 or below"),
        ("", "has no headings of known columns"),
        ('speed [rpm],note\n1000,"open\n2000,b\n', "line 2: got '1000,\"open' (unexpected end of data)"),
        ('speed [rpm],film [nm]\n"1,500",100\n', "the number '1,500', which may be 1.5 or 1500"),
        ('speed [rpm],film [nm]\n"1,50.5",100\n', "mixes decimal points and decimal commas"),
    ],
)
def test_what_is_wrong_is_one_line_with_its_place(tmp_path, text, line):
    assert line in refused(tmp_path, text)


@each("book", [MEASURED, CYCLE])
def test_no_quantity_of_a_column_is_a_percentage(book):
    for name, quantity in book.columns.items():
        for unit in ("%", "percent", "ppm") if quantity.unit else ():
            with pytest.raises(InputError, match=quantity.usual) as caught:
                column_of(f"{name} [{unit}]", book)
            assert name in str(caught.value)
        assert column_of(f"uncertainty of {name} [%]", book).factor() == 0.01


def test_files_without_end_or_measure_are_refused_soon(tmp_path):
    began = time.thread_time()
    many = "film [nm],speed [m/s]\n" + "1,1\n" * (MOST_ROWS + 1)
    assert f"expected at most {MOST_ROWS}" in refused(tmp_path, many)
    assert "has no headings" in refused(tmp_path, ";" * 1_000_000)
    assert "has no headings" in refused(tmp_path, "speed [" * 100_000)
    assert "got '1" in refused(tmp_path, "film [nm]\n" + "1" * 1_000_000)
    (tmp_path / "zeros").write_bytes(bytes(1000))
    for path in (tmp_path / "zeros", tmp_path, tmp_path / "none.csv", "/dev/zero"):
        with pytest.raises(InputError):
            read_measurement(path)
    assert time.thread_time() - began < 5.0


def test_control_characters_of_a_head_are_not_printed(tmp_path):
    measured = read(tmp_path, "film [nm],\x1b[31mred\n1,2\n")
    assert "\x1b" not in measured.ignored[0]


def test_a_speed_is_told_by_its_unit():
    assert column_of("speed [m/s]").name == "entrainment_speed"
    assert column_of("speed [rad/s]").name == "speed"


@each(
    "text, speeds",
    [
        ('speed [rpm],note\n1500,"accel, 1st"\n1600,cruise\n', (1500, 1600)),
        ('speed [rpm],film [nm]\n"1,500.5",100\n"1,600",100\n', (1500.5, 1600)),
        ('speed [rpm],film [nm]\n"1,500",100.5\n900,99.5\n', (1500, 900)),
        ('"speed, mean [rpm]",note\n"1500","a ""fast"" run, hot"\n1600,\n', None),
        ('"speed\n[rpm]",note\n1500,"two\nlines"\n1600,one\n', (1500, 1600)),
        ("speed [rpm];film [nm]\n1.500,5;100,25\n1.600;99,75\n", (1500.5, 1600)),
        ('speed [rpm],film [nm]\n"1500,5","100,25"\n"1600","99,75"\n', (1500.5, 1600)),
        ("speed [rpm],film [nm]\n1500,100\n1550,\n1570,NaN\n1580,#N/A\n1600,100\n", (1500, 1600)),
        ("speed [rpm]\tfilm [nm]\n1500\t100\nnan\t90\n1600\t100\n", (1500, 1600)),
    ],
)
def test_quoted_fields_thousands_and_voids(tmp_path, text, speeds):
    """Fields of RFC 4180; a decimal mark that any number proves, and rows without a value are not used."""
    if speeds is None:
        assert "has no headings of known columns" in refused(tmp_path, text)
        return
    assert read(tmp_path, text).values["speed"] == pytest.approx([RPM * speed for speed in speeds])


def test_rows_without_a_value_are_counted_and_named(tmp_path):
    measured = read(tmp_path, 'speed [rpm],note\n1500,"a\nb"\n,"c"\n1600,\n')
    assert (measured.lines, measured.void) == ((3, 5), (4,))
    (warning,) = void_rows(measured)
    assert warning.code == "rows-void"
    assert "1 of 3 rows" in warning.text
    assert "line 4" in warning.text
    frame = pd.DataFrame({"speed [rpm]": [1000, np.nan, 3000], "capacitance [pF]": [260.5, 1.0, 190.0]})
    assert read_measurement(frame).values["speed"] == pytest.approx(TWO["speed"])


@each(
    "head, book, name, value",
    [
        ("time_s", CYCLE, "time", 1.0),
        ("speed_kmh", CYCLE, "vehicle_speed", 1 / 3.6),
        ("temperature_degC", CYCLE, "temperature", 274.15),
        ("Fahrgeschwindigkeit in km/h", CYCLE, "vehicle_speed", 1 / 3.6),
        ("Öltemperatur / °C", CYCLE, "temperature", 274.15),
        ("torque_Nm", GEAR_CYCLE, "torque", 1.0),
        ("Drehmoment (Nm)", GEAR_CYCLE, "torque", 1.0),
        ("speed_rad_s", MEASURED, "speed", 1.0),
        ("entrainment_speed_m_per_s", MEASURED, "entrainment_speed", 1.0),
        ("viscosity_mPa_s", VISCOSITIES, "viscosity", 1e-3),
        ("Shear rate(s-¹)", VISCOSITIES, "shear_rate", 1.0),
        ("Température, °C", VISCOSITIES, "temperature", 274.15),
    ],
)
def test_units_without_brackets(head, book, name, value):
    column = column_of(head, book)
    assert (column.name, column.value(1.0)) == (name, pytest.approx(value, rel=1e-12))


@each("head", ["temperature_oil", "speed ratio", "time stamp", "load_case", "film_left"])
def test_words_after_a_name_are_no_units(head):
    assert column_of(head) is None


def test_a_bare_unit_of_another_quantity_is_refused():
    with pytest.raises(InputError, match="has the unit 'V'"):
        column_of("speed_V")


@each(
    "head, book, reason",
    [
        ("viscosity [cSt]", VISCOSITIES, "quantity; multiply a kinematic viscosity by the density)"),
        ("speed [Hz]", CYCLE, "turns or radians: write rpm, min^-1, rad/s or deg/s)"),
        ("radial load [kg]", CYCLE, "quantity; a mass is not a force: write N, lbf or kgf)"),
    ],
)
def test_a_reason_is_never_cut(head, book, reason):
    with pytest.raises(InputError) as error:
        column_of(head, book)
    assert reason in str(error.value)


def test_cuts_of_a_long_head_are_visible(tmp_path):
    measured = read(tmp_path, f"speed [rpm],film [nm],{'n' * 190}\n1000,20,1\n")
    assert measured.ignored[0].startswith("nnnn")
    assert "..." in measured.ignored[0]
