"""Lines of netlists: nothing that a user writes leaves a comment, and every parameter has its unit."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError, solve_bearing, write_netlist
from ehlectric.drive.netlist import comment, interpolated, name_of, number, speeds_of
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

ARC = {"arc_resistance": "1 ohm", "extinction_voltage": "1 V"}


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


@pytest.fixture(scope="module")
def plain():
    return solved()


@pytest.mark.slow
@given(st.text())
def test_every_line_of_a_comment_is_one(text):
    for line in comment(text):
        assert line == "*" or line.startswith("* ")
        assert line.isascii()
        assert line.isprintable()
        assert len(line) <= 102


@pytest.mark.slow
@given(st.text())
def test_names_are_words_of_a_netlist(text):
    assert re.fullmatch(r"[a-z0-9_]*", name_of(text))


@given(st.floats(1e-18, 1e18))
def test_numbers_have_no_suffix_and_nine_digits(value):
    """A letter after a number is a factor in SPICE; "e" is none."""
    assert re.fullmatch(r"[\d.]+(e[+-]\d+)?", number(value))
    assert float(number(value)) == pytest.approx(value, rel=1e-8)


TITLE = "Ölfilm; .end $ {1/0} \u00a0 * +"


def statements(text):
    """Lines that are no comments, each with what continues it, without comments at their ends."""
    found = []
    for line in text.splitlines():
        if line.startswith("+"):
            found[-1] += line[1:].partition(";")[0]
        elif not line.startswith("*"):
            found.append(line.partition(";")[0].strip())
    return found


@pytest.mark.parametrize("options", [{}, ARC], ids=["plain", "arc"])
def test_a_title_changes_comments_only(plain, options, tmp_path):
    titled = solved(title=TITLE)
    for result, name in ((plain, "one.lib"), (titled, "two.lib")):
        write_netlist(result, tmp_path / name, **options)
    one, two = ((tmp_path / name).read_text("ascii") for name in ("one.lib", "two.lib"))
    assert one != two
    assert statements(one) == statements(two)
    assert "* title: \\xd6lfilm; .end $ {1/0}" in two


def test_every_parameter_has_a_line_with_its_unit(plain, tmp_path):
    results = [plain, solved(bearing__inner_speed="2000 rpm")]
    for given_results in (plain, results):
        write_netlist(given_results, tmp_path / "bearing.lib", **ARC)
        for line in (tmp_path / "bearing.lib").read_text().splitlines():
            if line.startswith("+ ") and "=" in line and "{" not in line:
                assert re.fullmatch(r"\+ \w+=[\d.e+-]+ ; (F|Ohm|V|rpm), .+", line), line
            if line.startswith(".param") and "{" not in line:
                assert re.fullmatch(r"\.param \w+=[\d.e+-]+ ; (F|Ohm|V|rpm), .+", line), line


def test_the_header_says_what_was_computed(plain, tmp_path):
    write_netlist(plain, tmp_path / "bearing.lib")
    text = (tmp_path / "bearing.lib").read_text()
    joined = " ".join(line.removeprefix("*").strip() for line in text.splitlines())
    numbers = (
        "3000 rpm",
        "70 degC",
        "radial load 1.8 kN",
        "axial load 300 N",
        "from the film-thickness formula",
        "converged",
    )
    assert [number for number in numbers if number not in joined] == []
    for warning in plain.warnings:
        assert warning.text.replace("µ", "u")[:60] in joined


def test_warnings_of_other_speeds_have_their_speed(plain, tmp_path):
    """Breakdown is expected at the lower speed only."""
    slow = solved(bearing__inner_speed="900 rpm")
    code = "breakdown-expected"
    assert code not in {warning.code for warning in plain.warnings}
    (told,) = (warning.text for warning in slow.warnings if warning.code == code)
    write_netlist([plain, slow], tmp_path / "bearing.lib")
    lines = (tmp_path / "bearing.lib").read_text().splitlines()
    (line,) = (line for line in lines if line.startswith(f"* warning: at 900 rpm: {told[:30]}"))
    assert line


def test_missing_conductivity_is_said(tmp_path):
    write_netlist(solved(discharge__conductivity=None), tmp_path / "bearing.lib")
    text = (tmp_path / "bearing.lib").read_text()
    assert "+ R_leak=1e+12 ; Ohm" in text
    assert re.search(r"^\* note: .*discharge\.conductivity", text, re.MULTILINE)


def test_files_of_others_are_kept(plain, tmp_path):
    own, other = tmp_path / "own.lib", tmp_path / "other.lib"
    other.write_text("* my library\n")
    assert write_netlist(plain, own) == write_netlist(plain, own) == [own]
    with pytest.raises(InputError, match=r"other\.lib: "):
        write_netlist(plain, other)
    with pytest.raises(InputError, match=r"own\.lib"):
        write_netlist(plain, own, bench=own)
    with pytest.raises(InputError, match="folder"):
        write_netlist(plain, tmp_path / "none" / "own.lib")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="folder: "):
        write_netlist(plain, tmp_path / "folder")
    with pytest.raises(InputError, match="netlist"):
        write_netlist(plain, tmp_path / "a'b.lib", bench=tmp_path / "bench.cir")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder", "other.lib", "own.lib"]
    assert other.read_text() == "* my library\n"


@each(
    "options, message",
    [
        ({"arc_resistance": "1 ohm"}, "extinction_voltage: missing"),
        ({"extinction_voltage": "1 V"}, "arc_resistance: missing"),
        ({"arc_resistance": "1 V", "extinction_voltage": "1 V"}, "arc_resistance: .*'1 V'"),
        ({"arc_resistance": "0 ohm", "extinction_voltage": "1 V"}, "arc_resistance: .*'0 ohm'"),
        (
            {"arc_resistance": "1 ohm", "extinction_voltage": "9 V"},
            "extinction_voltage: .* 9 V",
        ),
        ({"bench": "bench.cir"}, "motor.switching_frequency: missing"),
    ],
)
def test_wrong_inputs_are_refused_by_their_names(plain, options, message, tmp_path_factory):
    folder = tmp_path_factory.mktemp("netlist")
    options = options | ({"bench": folder / "bench.cir"} if "bench" in options else {})
    with pytest.raises(InputError, match=message):
        write_netlist(plain, folder / "bearing.lib", **options)
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    ("changes", "options", "message"),
    [
        ({"discharge__dielectric_strength": None}, ARC, "discharge.dielectric_strength: missing"),
        ({"bearing__inner_speed": "50 rpm"}, {}, "bearing.contact_resistance: missing"),
        ({"motor": None}, {"bench": True}, "motor: missing"),
        (
            {"motor__switching_frequency": "10 kHz", "motor__rise_time": "60 us"},
            {"bench": True},
            "motor.rise_time: .* 6e-05 s.* 5e-05 s",
        ),
    ],
)
def test_what_a_bearing_lacks_is_told(changes, options, message, tmp_path):
    result = solved(**changes)
    options = {key: tmp_path / "b.cir" if key == "bench" else value for key, value in options.items()}
    with pytest.raises(InputError, match=message):
        write_netlist(result, tmp_path / "bearing.lib", **options)
    assert not list(tmp_path.iterdir())


def test_what_is_no_table_is_refused(plain, tmp_path):
    path = tmp_path / "bearing.lib"
    with pytest.raises(InputError, match=r"^result: "):
        write_netlist([], path)
    with pytest.raises(InputError, match=r"^result: "):
        write_netlist([plain, solved(bearing__radial_load="1 kN", bearing__inner_speed="2000 rpm")], path)
    with pytest.raises(InputError, match=r"0\.1 %"):
        write_netlist([plain, solved(bearing__inner_speed="3001 rpm")], path)
    touching = solved(bearing__inner_speed="50 rpm", bearing__contact_resistance="1 ohm")
    apart = solved(bearing__contact_resistance="1 ohm")
    with pytest.raises(InputError, match="50 rpm"):
        write_netlist([apart, touching], path)
    assert not list(tmp_path.iterdir())


def test_speeds_are_read_from_a_text():
    case = bearing_case(BALLS)
    turn = 2.0 * 3.141592653589793 / 60.0
    assert speeds_of(case, "500 rpm, 10 rad/s") == pytest.approx((500 * turn, 10.0))
    assert speeds_of(case, "500 rpm : 2000 rpm: 3") == pytest.approx((500 * turn, 1000 * turn, 2000 * turn))
    for text in ("", "500", "500 rpm; 600 rpm", "5 V", "2000 rpm : 500 rpm : 3", "5 rpm : 6 rpm : 1"):
        with pytest.raises(InputError, match="--speeds: "):
            speeds_of(case, text)


def test_a_long_table_is_broken_into_lines():
    lines = list(interpolated("C_films", "C", 99))
    assert max(map(len, lines)) < 110
    assert "".join(lines).count("{") == "".join(lines).count("}") == 1
