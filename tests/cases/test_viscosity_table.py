"""Tables of viscosity over pressure and temperature: the table of a known law gives the law."""

import math

import numpy as np
import pytest
from hypothesis import given, settings

import ehlectric
from ehlectric import Case
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case_oil import Lubricant, named_oil, oil
from ehlectric.errors import InputError
from ehlectric.lubricant.viscosity_fit import fit_warnings
from tests.helpers.bearings import BALLS
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.text_variants import Written, variants

ELECTRIC = {"density_law": "incompressible", "relative_permittivity": 2.2}
PRESSURES, WARM = (0.1e6, 100e6, 200e6, 400e6, 600e6), (293.15, 313.15, 333.15, 353.15, 373.15)

# Oils whose laws are known, and a table of each.
KNOWN = {
    "roelands": {
        **ELECTRIC,
        "atmospheric_law": "roelands",
        "viscosity": 0.04,
        "reference_temperature": 313.15,
        "roelands_s0": 1.1,
        "viscosity_law": "roelands",
        "pressure_viscosity_coefficient": 22e-9,
        "roelands_z": 0.67,
        "roelands_pressure": 0.198e9,
    },
    "barus": {
        **ELECTRIC,
        "atmospheric_law": "vogel",
        "vogel_viscosity": 6.2e-5,
        "vogel_b": 1021.7,
        "vogel_c": 171.5983,
        "viscosity_law": "barus",
        "pressure_viscosity_coefficient": 18e-9,
    },
    "modulus": {"base": "fva-3"},
    "yasutomi": {
        **ELECTRIC,
        "viscosity_law": "yasutomi",
        "yasutomi_glass_viscosity": 1e12,
        "yasutomi_glass_temperature": 189.95,
        "yasutomi_a1": 188.86,
        "yasutomi_a2": 0.719e-9,
        "yasutomi_b1": 8.2e-9,
        "yasutomi_b2": -0.5278,
        "yasutomi_c1": 16.09,
        "yasutomi_c2": 17.38,
    },
}


def rows_of(table, pressures=PRESSURES, temperatures=WARM):
    """Pressures [Pa], temperatures [K] and viscosities [Pa s] of a known oil."""
    rows = []
    for at in temperatures:
        known = oil(table, at)
        exponents = np.asarray(known.log_viscosity(np.array(pressures))[0])
        rows += [
            (p, at, known.viscosity * math.exp(x)) for p, x in zip(pressures, exponents.tolist(), strict=True)
        ]
    return rows


def table_of(rows, *, digits=6):
    names = ("pressure", "temperature", "viscosity")
    return {
        name: [float(f"{value:.{digits}g}") for value in column]
        for name, column in zip(names, zip(*rows, strict=True), strict=True)
    }


@pytest.mark.parametrize("name", KNOWN)
def test_the_table_of_a_known_oil_gives_its_law(name):
    """alpha* of the known law by quadrature, within 1 %; viscosities between the rows within 0.5 %."""
    fitted = Lubricant.from_dict({**ELECTRIC, "viscosity_table": table_of(rows_of(KNOWN[name]), digits=4)})
    for at in (300.0, 313.15, 345.0, 370.0):
        known, found = oil(KNOWN[name], at), fitted.at(at)
        assert found.alpha_star == pytest.approx(known.alpha_star, rel=0.01)
        assert found.viscosity == pytest.approx(known.viscosity, rel=0.005)
        exponents = [law.log_viscosity(np.array([0.3e9]))[0] for law in (found, known)]
        assert exponents[0] == pytest.approx(exponents[1], abs=0.005)


@pytest.mark.parametrize("name", ["roelands", "barus"])
def test_the_film_is_the_film_of_the_known_oil(name):
    ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "5 N"}
    films = []
    for table in (KNOWN[name], {**ELECTRIC, "viscosity_table": table_of(rows_of(KNOWN[name]), digits=4)}):
        case = Case.point(
            **ball, entrainment_speed="1 m/s", temperature="60 degC", lubricant=table, grid={"nodes": 65}
        )
        films.append(ehlectric.solve(case).film.central_thickness)
    assert films[1] == pytest.approx(films[0], rel=0.005)


def write(folder, rows, name="oil.csv"):
    lines = [f"{p / 1e6:.6g},{t - 273.15:.6g},{1e3 * eta:.6g}" for p, t, eta in rows]
    text = "\n".join(["pressure [MPa],temperature [degC],viscosity [mPa s]", *lines])
    (folder / name).write_text(text, encoding="utf-8")


def test_a_file_relative_to_the_case(tmp_path):
    """The case contains the rows, and a copy in another folder gives the same oil."""
    write(tmp_path, rows_of(KNOWN["roelands"]))
    text = (
        '[contact]\ngeometry = "point"\nradius_x = "10 mm"\nradius_y = "10 mm"\nreduced_modulus = "226 GPa"\n'
        'load = "20 N"\nentrainment_speed = "1 m/s"\ntemperature = "60 degC"\n[lubricant]\n'
        'viscosity_table = "oil.csv"\ndensity_law = "incompressible"\nrelative_permittivity = 2.2\n'
    )
    (tmp_path / "case.toml").write_text(text, encoding="utf-8")
    case = Case.from_toml(tmp_path / "case.toml")
    assert len(case.lubricant.viscosity_table.viscosity) == 25
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "copy.toml").write_text(case.to_toml(), encoding="utf-8")
    (tmp_path / "oil.csv").unlink()
    assert Case.from_toml(tmp_path / "more" / "copy.toml").lubricant == case.lubricant


def test_a_bearing_takes_the_table_of_its_oil(tmp_path):
    write(tmp_path, rows_of(KNOWN["roelands"]))
    table = {"viscosity_table": str(tmp_path / "oil.csv"), **ELECTRIC}
    known, found = (
        ehlectric.solve_bearing(BearingCase.from_dict({**BALLS, "contacts": "formula", "lubricant": of}))
        for of in (KNOWN["roelands"], table)
    )
    capacitances = [result.summary()["bearing"]["capacitance"] for result in (found, known)]
    assert capacitances[0] == pytest.approx(capacitances[1], rel=0.002)
    codes = [warning.code for warning in found.all_warnings]
    assert "viscosity-table" in codes


def test_what_is_outside_the_table():
    fitted = Lubricant.from_dict({**ELECTRIC, "viscosity_table": table_of(rows_of(KNOWN["roelands"]))})
    with pytest.raises(InputError, match=r"temperature.*20 to 100 degC|temperature.*19.5 to 100.5 degC"):
        fitted.at(400.0)
    codes = {
        pressure: [warning.code for warning in fitted.at(313.15).warnings(pressure)]
        for pressure in (0.5e9, 0.7e9)
    }
    assert codes == {0.5e9: ["viscosity-table"], 0.7e9: ["viscosity-table", "law-range"]}
    short = table_of(rows_of(KNOWN["roelands"], (0.0, 10e6, 20e6, 30e6)))
    warnings = Lubricant.from_dict({**ELECTRIC, "viscosity_table": short}).at(313.15).warnings(20e6)
    assert "viscosity-table-short" in [warning.code for warning in warnings]


@pytest.mark.parametrize(
    "head", ["Kinematic viscosity [mm²/s]", "kinematische Viskosität", "viscosité cinématique"]
)
def test_a_kinematic_viscosity_is_named(tmp_path, head):
    path = tmp_path / "oil.csv"
    path.write_text(f"Temperature [°C];{head}\n20;100\n40;50\n", encoding="utf-8")
    with pytest.raises(InputError, match="multiply a kinematic viscosity by the density"):
        Lubricant.from_dict({**ELECTRIC, "viscosity_law": "barus", "viscosity_table": str(path)})
    path.write_text(f"T [°C];{head};dynamic viscosity [mPa s]\n20;100;85\n40;50;40\n", encoding="utf-8")
    given = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}
    found = Lubricant.from_dict({**ELECTRIC, **given, "viscosity_table": str(path)})
    assert list(found.viscosity_table.viscosity) == pytest.approx([0.085, 0.04])


def test_one_temperature_and_ambient_pressure():
    isotherm = table_of(rows_of(KNOWN["roelands"], temperatures=(313.15,)))
    found = Lubricant.from_dict({**ELECTRIC, "viscosity_table": isotherm}).at(313.15)
    assert found.alpha_star == pytest.approx(oil(KNOWN["roelands"], 313.15).alpha_star, rel=0.01)
    ambient = table_of(rows_of(KNOWN["barus"], pressures=(0.0,)))
    del ambient["pressure"]
    given = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}
    found = Lubricant.from_dict({**ELECTRIC, **given, "viscosity_table": ambient}).at(345.0)
    assert found.viscosity == pytest.approx(oil(KNOWN["barus"], 345.0).viscosity, rel=1e-4)
    assert found.alpha_star == pytest.approx(18e-9, rel=1e-3)
    with pytest.raises(InputError, match="viscosity_law"):
        Lubricant.from_dict({**ELECTRIC, "viscosity_table": ambient})


def test_another_table_over_temperature_keeps_the_law_over_pressure():
    """Twice the viscosity of the first table, with the coefficient that the file gives."""
    ambient = table_of(rows_of(KNOWN["barus"], pressures=(0.0,)))
    del ambient["pressure"]
    given = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}
    ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
    case = Case.point(
        **ball,
        entrainment_speed="1 m/s",
        temperature="60 degC",
        lubricant={**ELECTRIC, **given, "viscosity_table": ambient},
    )
    twice = ambient | {"viscosity": [2.0 * float(value) for value in ambient["viscosity"]]}
    changed = case.replace({"lubricant.viscosity_table": twice})
    assert changed.oil.viscosity == pytest.approx(2.0 * case.oil.viscosity, rel=1e-6)
    assert changed.oil.alpha_star == pytest.approx(18e-9, rel=1e-3)


def test_the_table_replaces_the_viscosity_of_a_base():
    table = table_of(rows_of(KNOWN["roelands"]))
    for base in ("fva-3", "paper"):
        found = Lubricant.from_dict({"base": base, "viscosity_table": table}).at(320.0)
        assert found.viscosity == pytest.approx(oil(KNOWN["roelands"], 320.0).viscosity, rel=1e-4)
        assert found.alpha_star == pytest.approx(oil(KNOWN["roelands"], 320.0).alpha_star, rel=1e-3)


def test_changes_of_an_oil_with_a_table():
    lubricant = {**ELECTRIC, "viscosity_table": table_of(rows_of(KNOWN["roelands"]))}
    ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "5 N"}
    case = Case.point(**ball, entrainment_speed="1 m/s", temperature="60 degC", lubricant=lubricant)
    other = case.replace({"lubricant.viscosity_table": table_of(rows_of(KNOWN["barus"]))})
    assert other.lubricant.at(333.15).alpha_star == pytest.approx(18e-9, rel=1e-3)
    changed = case.replace({"lubricant.pressure_viscosity_coefficient": 10e-9})
    (warning, *_) = [w for w in changed.lubricant.at(333.15).warnings(1e8) if w.code == "viscosity-table"]
    assert "pressure_viscosity_coefficient" in warning.text


@each(
    "change, words",
    [
        (
            {"temperature": {"iso_vg": 46, "viscosity_index": 95, "density_15": 870.0}},
            "viscosity_table and temperature",
        ),
        ({"viscosity_table": {"viscosity": [0.04, 0.05], "pressure": [0.0]}}, "viscosity_table.pressure"),
        ({"viscosity_table": "none.csv"}, "none.csv"),
        (
            {"viscosity_table": {"viscosity": [0.04, 40.0, 0.05, 3.0], "pressure": [0.0, 1e8, 2e8, 3e8]}},
            "row 2 differs|row 4 differs|row 3 differs",
        ),
    ],
)
def test_what_is_no_table_of_an_oil(change, words):
    with pytest.raises(InputError, match=words):
        Lubricant.from_dict({**ELECTRIC, "viscosity_table": table_of(rows_of(KNOWN["roelands"])), **change})


def rheometer(rows, *, decimal=".", encoding="utf-8"):
    """Export of a rheometer: intervals below each other, with the units below the heads; ``rows``,
    temperature [degC], shear rate [1/s] and viscosity [mPa s] of the rows of each interval.
    """
    lines = ["Project:\tOil A", "Test:\tTemperature sweep", ""]
    for number, interval in enumerate(rows, 1):
        lines += [
            f"Interval and data points:\t{number}\t{len(interval)}",
            "Interval data:\tPoint No.\tTemperature\tShear Rate\tViscosity\tStatus",
            "\t\t[°C]\t[1/s]\t[mPa·s]\t",
            "",
        ]
        cells = [
            f"\t{place}\t{t:.2f}\t{rate:.1f}\t{eta:.5g}\tM-".replace(".", decimal)
            for place, (t, rate, eta) in enumerate(interval, 1)
        ]
        lines += [*cells, ""]
    return "\n".join(lines).encode(encoding)


@each("decimal, encoding", [(".", "utf-16"), (",", "cp1252"), (",", "utf-8-sig")])
def test_an_export_of_a_rheometer(decimal, encoding, tmp_path):
    """Vogel's law of FVA 3 over temperature, in two intervals; the viscosity at 50 degC between the rows."""
    of = {t: 1e3 * 6.2e-5 * math.exp(1021.7 / (t + 273.15 - 171.5983)) for t in (20, 40, 60, 80, 100)}
    intervals = [[(t, 100.0, of[t]) for t in (20, 40, 60)], [(t, 100.0, of[t]) for t in (80, 100)]]
    (tmp_path / "rheo.txt").write_bytes(rheometer(intervals, decimal=decimal, encoding=encoding))
    given = {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}
    table = Lubricant.from_dict({**ELECTRIC, **given, "viscosity_table": str(tmp_path / "rheo.txt")})
    expected = 6.2e-5 * math.exp(1021.7 / (323.15 - 171.5983))
    assert table.at(323.15).viscosity == pytest.approx(expected, rel=1e-3)


def test_a_flow_curve_is_newtonian_or_refused(tmp_path):
    path, given = tmp_path / "flow.txt", {"viscosity_law": "barus", "pressure_viscosity_coefficient": 18e-9}
    path.write_bytes(rheometer([[(40.0, 10.0, 50.5), (40.01, 100.0, 50.0), (39.99, 1000.0, 49.5)]]))
    table = Lubricant.from_dict({**ELECTRIC, **given, "viscosity_table": str(path)})
    assert table.at(313.15).viscosity == pytest.approx(0.05, rel=1e-3)
    path.write_bytes(rheometer([[(40.0, 10.0, 50.0), (40.0, 1000.0, 50.0), (40.0, 1e5, 30.0)]]))
    with pytest.raises(InputError, match=r"shear rate: 50 mPa s at 10 1/s .* 30 mPa s"):
        Lubricant.from_dict({**ELECTRIC, **given, "viscosity_table": str(path)})


ROWS = rows_of(KNOWN["barus"], (0.1e6, 100e6, 300e6), (313.15, 353.15))
COLUMNS = (
    Written(
        ("pressure", "p"),
        (("MPa", 1e-6), ("bar", 1e-5), ("GPa", 1e-9), ("Pa", 1.0)),
        [row[0] for row in ROWS],
    ),
    Written(("temperature", "Temp"), (("K", 1.0),), [row[1] for row in ROWS]),
    Written(
        ("viscosity", "Dynamic viscosity", "η"),
        (("mPa s", 1e3), ("mPa·s", 1e3), ("cP", 1e3), ("Pa.s", 1.0), ("Pa s", 1.0)),
        [row[2] for row in ROWS],
    ),
)
COUNTS = [0, 0]


@given(content=variants(COLUMNS))
@settings(max_examples=40, deadline=None)
def test_variants_of_a_viscosity_table_are_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("oil") / "oil.csv"
    path.write_bytes(content)
    try:
        table = Lubricant.from_dict({**ELECTRIC, "viscosity_table": str(path)})
    except InputError:
        COUNTS[1] += 1
        return
    COUNTS[0] += 1
    assert table.at(330.0).alpha_star == pytest.approx(18e-9, rel=0.005), content


def test_most_variants_are_read():
    assert COUNTS[0] >= 2 * COUNTS[1]


def test_the_report_of_an_oil_names_its_table():
    named = named_oil(EXAMPLES / "measured_contact.toml")
    source = named.source("roelands_z")
    assert (source.kind, source.citation) == ("fitted", "viscosity table of oil_viscosity.csv")
    assert "40 rows" in source.note


def test_a_note_states_the_share_of_the_coefficient_beyond_a_table():
    """30 % of the coefficient above 20 MPa, 0.02 GPa, as given."""
    numbers = {"rows": 5, "rms": 0.01, "worst": 0.02, "highest": 20e6, "share": 0.3}
    (note,) = (each for each in fit_warnings(1e9, 0.1, **numbers) if each.code == "viscosity-table-short")
    assert "30 %" in str(note)
    assert "0.02 GPa" in str(note)
