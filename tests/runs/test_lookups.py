"""Functions behind commands: the numbers of the commands, and refusals that name the argument."""

import json
import math
import subprocess
import sys

import pytest

import ehlectric
from ehlectric import Case, InputError
from ehlectric.tables.contact_tables import result_rows
from tests.helpers.each import each
from tests.helpers.places import DEKTAK, EXAMPLES

NAMES = ("oils", "bearings", "check", "film", "surface", "formulas")
OIL = {"oil": "fva-3", "temperature": "70 degC"}
LINE = {"radius": "10 mm", "modulus": "226 GPa", "load": "0.1 MN/m", "speed": "5 m/s"}


def command(*words):
    """Numbers that a command prints with ``--json``."""
    done = subprocess.run(
        [sys.executable, "-m", "ehlectric", *words, "--json"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def as_json(found):
    return json.loads(json.dumps(found))


def test_names_are_listed_and_have_docstrings():
    assert set(NAMES) <= set(dir(ehlectric)) & set(ehlectric.__all__)
    for name in NAMES:
        text = getattr(ehlectric, name).__doc__
        for section in ("Returns", "Examples"):
            assert section in text, (name, section)


def test_functions_have_priority_over_packages_of_their_names():
    code = (
        "import ehlectric; import ehlectric.film.mesh, ehlectric.formulas.hertz; "
        "from ehlectric.film import newton; from ehlectric import film, formulas; ehlectric.solve; "
        "assert callable(film) and callable(formulas) and film is ehlectric.film, ehlectric.film; "
        "print(newton.__name__)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("ehlectric.film.newton\n", "")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("found", "words"),
    [
        (lambda: ehlectric.oils(), ("oils",)),
        (lambda: ehlectric.bearings(), ("bearings",)),
        (lambda: ehlectric.film(m=50.0, l=10.0), ("film", "--m", "50", "--l", "10")),
        (
            lambda: ehlectric.film(**OIL, **LINE),
            ("film", *(word for key, value in (OIL | LINE).items() for word in (f"--{key}", value))),
        ),
        (lambda: ehlectric.surface(DEKTAK, form="line"), ("surface", str(DEKTAK), "--form", "line")),
        (
            lambda: ehlectric.check(EXAMPLES / "line_contact.toml").summary,
            ("check", str(EXAMPLES / "line_contact.toml")),
        ),
        (
            lambda: ehlectric.check(str(EXAMPLES / "sweep.toml")).summary,
            ("check", str(EXAMPLES / "sweep.toml")),
        ),
    ],
)
def test_numbers_are_those_of_the_command(found, words):
    assert as_json(found()) == command(*words)


@each("point", [(False,), (True,)])
def test_moes_l_of_a_film_is_that_of_a_check(point):
    """L = alpha* E' (eta0 u_s/(E' R))^(1/4), in film as in check; the atlas uses another coefficient."""
    oil, contact = ehlectric.oil("fva-3", "70 degC"), {"reduced_modulus": 226e9, "entrainment_speed": 5.0}
    contact |= {"temperature": "70 degC", "geometry": "point" if point else "line"}
    shape = {"radius_x": 0.01, "radius_y": 0.02, "load": 50.0} if point else {}
    shape = shape or {"reduced_radius": 0.01, "load_per_length": 1e5}
    checked = ehlectric.check({"contact": contact | shape, "lubricant": "fva-3"}).summary["groups"]
    across = {"radius_across": 0.02} if point else {}
    load = 50.0 if point else 1e5
    found = ehlectric.film(**OIL, radius=0.01, modulus=226e9, load=load, speed=5.0, **across)
    by_hand = oil.alpha_star * 226e9 * (oil.viscosity * 10.0 / (226e9 * 0.01)) ** 0.25
    assert found["moes_l"] == pytest.approx(by_hand, rel=1e-9)
    assert found["moes_l"] == pytest.approx(checked["moes_l"], rel=1e-9)
    assert found["moes_m"] == pytest.approx(checked["moes_m"], rel=1e-9)
    k = {"k": found["ratio"]} if point else {}
    again = ehlectric.film(m=found["moes_m"], l=found["atlas_moes_l"], **k)
    assert again["moes_l"] is None
    # Without an oil, the atlas answers for a typical oil, with the spread between oils as an error.
    assert again["central"] == pytest.approx(found["central"], rel=again["errors"]["central"] + 0.05)


@each(
    "changes, key, assumed",
    [
        ({"load": "50 N"}, "load", "line"),
        ({"load": 50.0}, "moes_m", "line"),
        ({"load": "0.1 MN/m", "radius_across": "10 mm"}, "load", "point"),
    ],
)
def test_an_error_of_a_film_names_the_assumed_geometry(changes, key, assumed):
    """Only ``radius_across`` decides whether the load is a force or a force per length."""
    with pytest.raises(InputError, match=rf"^{key}: .*radius_across.* a {assumed} contact was assumed"):
        ehlectric.film(**OIL, **(LINE | changes))


def test_lambda_is_the_minimum_film_divided_by_the_composite_rq():
    """Definition of the lambda ratio of bearings; Rq = sqrt(pi/2) Ra of Gaussian heights."""
    found = ehlectric.film(**OIL, **LINE, composite_rq="0.1 um")
    assert found["lambda_ratio"] == pytest.approx(found["minimum_thickness"] / 1e-7, rel=1e-12)
    assert "lambda_ratio" not in ehlectric.film(**OIL, **LINE)
    with pytest.raises(InputError, match=r"^composite_rq: "):
        ehlectric.film(**OIL, **LINE, composite_rq="0 um")
    of_ra = ehlectric.film(**OIL, **LINE, composite_ra="0.1 um")["lambda_ratio"]
    assert of_ra == pytest.approx(found["lambda_ratio"] / math.sqrt(math.pi / 2.0), rel=1e-12)
    with pytest.raises(InputError, match=r"^composite_rq: got composite_rq and composite_ra together"):
        ehlectric.film(**OIL, **LINE, composite_rq="0.1 um", composite_ra="0.1 um")
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20.0}
    contact |= {"reduced_modulus": 226e9, "entrainment_speed": 2.0}
    tables = {"contact": contact, "lubricant": "paper", "meter": {"fill": "oil", "ra": "50 nm"}}
    checked = ehlectric.check(tables)
    film = checked.summary["film_formulas"]["chittenden"]["minimum_thickness"]
    rq = math.sqrt(math.pi / 2.0) * 50e-9
    assert checked.summary["lambda_by_formula"]["lambda_ratio"] == pytest.approx(film / rq, rel=1e-12)
    assert any(row.name == "lambda ratio (film-thickness formula)" for row in checked.rows)


@pytest.mark.slow
def test_lambda_of_a_contact_with_a_stated_roughness_is_in_the_table():
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20.0}
    contact |= {"reduced_modulus": 226e9, "entrainment_speed": 2.0}
    tables = {"contact": contact, "lubricant": "paper", "meter": {"fill": "oil", "rq": "50 nm"}}
    solved = ehlectric.solve(Case.from_dict(tables | {"grid": {"nodes": 65}}))
    (row,) = [row for row in result_rows(solved) if row.name == "lambda ratio"]
    expected = solved.film.minimum_thickness / 50e-9
    assert row.value == pytest.approx(expected, rel=1e-12)
    assert solved.summary()["meter"]["film_ratio"] == pytest.approx(expected, rel=1e-12)


def test_a_film_in_floats_is_the_film_in_texts():
    floats = {"radius": 0.01, "modulus": 226e9, "load": 1e5, "speed": 5.0}
    assert ehlectric.film(**OIL, **LINE) == ehlectric.film(oil="fva-3", temperature=343.15, **floats)


def test_moes_groups_of_a_film_follow_from_the_oil():
    """M = w/(E' R) / sqrt(2 U), with U = eta_0 u/(E' R) of the entrainment speed u."""
    viscosity = ehlectric.oil("fva-3", "70 degC").viscosity
    speed = viscosity * 5.0 / (226e9 * 0.01)
    load = 1e5 / (226e9 * 0.01)
    assert ehlectric.film(**OIL, **LINE)["moes_m"] == pytest.approx(load / math.sqrt(2.0 * speed), rel=1e-9)


def test_check_takes_a_case_of_every_form():
    file = EXAMPLES / "line_contact.toml"
    case = Case.from_toml(file)
    summaries = [ehlectric.check(one).summary for one in (file, str(file), case, case.to_dict())]
    assert all(one["hertz"] == summaries[0]["hertz"] for one in summaries)


def test_formulas_of_a_line_contact():
    """Dowson and Higginson (1966): h_min = 2.65 U^0.7 G^0.54 W^-0.13 R, with G = alpha* E'."""
    case = Case.line(
        reduced_radius=0.01,
        reduced_modulus=226e9,
        load_per_length=1e5,
        entrainment_speed=4.0,
        lubricant="paper",
    )
    speed, load, alpha = 0.04 * 4.0 / (226e9 * 0.01), 1e5 / (226e9 * 0.01), case.oil.alpha_star * 226e9
    expected = 2.65 * speed**0.7 * alpha**0.54 * load**-0.13 * 0.01
    films = ehlectric.formulas(case)
    assert films["dowson_higginson"].minimum_thickness == pytest.approx(expected, rel=1e-3)
    assert films == ehlectric.formulas(case.to_dict())


@each(
    "call, key",
    [
        (lambda: ehlectric.film(m=50.0), "l"),
        (lambda: ehlectric.film(m="50", l=10.0), "m"),
        (lambda: ehlectric.film(m=50.0, l=math.nan), "l"),
        (lambda: ehlectric.film(m=50.0, l=10.0, oil="fva-3"), "oil"),
        (lambda: ehlectric.film(), "oil"),
        (lambda: ehlectric.film(**OIL), "radius"),
        (lambda: ehlectric.film(**OIL, **(LINE | {"load": "1 kg"})), "load"),
        (lambda: ehlectric.film(oil="fva", **LINE), "oil"),
        (lambda: ehlectric.check(5), "case"),
        (lambda: ehlectric.formulas(EXAMPLES / "bearing_6208.toml"), "case"),
        (lambda: ehlectric.surface(DEKTAK, fom="line"), "fom"),
    ],
)
def test_what_is_wrong_is_named(call, key):
    with pytest.raises(InputError) as caught:
        call()
    assert caught.value.key == key


def test_a_meaning_is_one_short_line():
    text = repr(ehlectric.check(EXAMPLES / "line_contact.toml"))
    assert "\n" not in text
    assert len(text) <= 200
