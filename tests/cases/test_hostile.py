"""Hostile texts and tables: each is refused by the project's own error, in a time that its length bounds."""

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

import ehlectric
from ehlectric.cases import key_names, table
from ehlectric.cases.amounts import Amount, Count
from ehlectric.cases.case import Case
from ehlectric.cases.key_names import MOST_DEEP, refuse_deep, refuse_long_keys
from ehlectric.cases.library.library_oils import Grade
from ehlectric.cases.table import nearest, read_toml
from ehlectric.errors import InputError
from ehlectric.figures.figure_names import _OF_UNIT
from ehlectric.quantities import grouped_digits, unit_spelling, units
from ehlectric.quantities.units import ROTATION, length_unit
from ehlectric.runs import result_folders
from ehlectric.runtime import text_table
from ehlectric.runtime.files import _FORMULA
from ehlectric.runtime.files import _NUMBER as _NUMBER_OF_CELL
from ehlectric.surfaces import text_profiles
from ehlectric.surfaces.surface_files import read_surface
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

CASE = {
    "contact": {
        "reduced_radius": "10 mm",
        "reduced_modulus": "220 GPa",
        "load_per_length": "100 kN/m",
        "entrainment_speed": "1 m/s",
    },
    "lubricant": {"base": "paper"},
}
QUANTITIES = {
    "length": Amount("m", above=0.0),
    "speed": Amount("m/s"),
    "rotation": Amount(ROTATION),
    "temperature": Amount("K"),
    "fraction": Amount("", fraction=True),
    "number": Amount(""),
}
# Longest time of the processor for a refusal; those that hung took half a minute and more [s].
SOON = 3.0


def named(cases):
    """Cases of a test with their names."""
    return [pytest.param(value, id=name) for name, value in cases.items()]


@pytest.fixture(autouse=True)
def _units_are_loaded():
    """The registry of units, whose first use takes a while."""
    units.registry()


def refused(read, *given):
    """Line of the error of the project that a call raises soon."""
    began = time.thread_time()
    with pytest.raises(InputError) as error:
        read(*given)
    assert time.thread_time() - began < SOON
    line = str(error.value)
    assert "\n" not in line
    return line


@each("quantity", named(QUANTITIES))
@each(
    "text",
    [
        "1" * 2000 + "y\nz",
        "1 " + "a" * 200_000,
        "1 " + "m*" * 3000 + "m",
        "1 " + "m*" * 90 + "m",
        "1 " + "(" * 5000 + "m" + ")" * 5000,
        "1 m" + "**2" * 3000,
        "1 m^" + "⁺" * 100_000,
        "1," * 100_000,
        "1" * 150_000 + ",5 m",
        " " * 1_000_000,
        "1e" + "9" * 100_000,
        10**5000,
        -(10**400),
    ],
    ids=lambda text: f"{str(text)[:8] if isinstance(text, str) else 'whole'!r}",
)
def test_a_hostile_quantity_is_refused_soon_in_a_short_line(quantity, text):
    for written in (False, True):
        line = refused(lambda: quantity.parse(text, written=written))  # noqa: B023
        assert len(line) < 400


def test_lines_name_what_is_wrong_with_a_long_text():
    line = refused(QUANTITIES["length"].parse, "1" * 2000 + "y\nz")
    assert line.startswith("got '1111111111")
    assert "(it has 2003 characters, which is too long)" in line
    line = refused(QUANTITIES["length"].parse, "1 " + "m*" * 20 + "m")
    assert "is not a unit" in line
    assert QUANTITIES["length"].parse("1 " + "m*" * 3 + "m/m/m/m") == 1.0


@given(st.text(max_size=300) | st.from_regex(r"[0-9.,eE+\-* /()a-zµ°⁻¹²^]{0,300}", fullmatch=True))
def test_any_text_as_a_quantity_is_a_number_or_the_error_of_the_project(text):
    for quantity in QUANTITIES.values():
        try:
            value = quantity.parse(text)
        except InputError as error:
            value, line = 0.0, str(error)
        else:
            line = "one line"
        assert len(line.splitlines()) == 1
        assert len(line) < 500
        assert isinstance(value, float)


@given(st.text(max_size=300))
def test_any_text_as_a_grade_a_unit_or_a_count_is_the_error_of_the_project(text):
    for read in (Grade().parse, length_unit, Count(1, 9, "of items").parse):
        try:
            read(text)
        except InputError:
            pass
        else:
            assert read is not Count(1, 9, "of items").parse


def test_whole_numbers_without_a_text_are_refused():
    # Python writes no whole number of more than 4300 digits.
    line = refused(Count(1, 9, "of items").parse, 10**5000)
    assert "16610 bits" in line
    assert "from 1 to 9" in line


# Every regular expression for texts of a user, and texts that made such expressions slow.
PATTERNS = {
    "number and unit": units._NUMBER_AND_UNIT.fullmatch,
    "unit": units._UNIT.fullmatch,
    "exponent": units._EXPONENT.findall,
    "superscript": unit_spelling._SUPERSCRIPT.findall,
    "not raised": unit_spelling._NOT_RAISED.findall,
    "product in brackets": unit_spelling._BRACKETS.findall,
    "product": unit_spelling._PRODUCT.findall,
    "dot": unit_spelling._DOT.findall,
    "words": lambda text: [pattern.findall(text) for pattern, _ in unit_spelling._WORDS],
    "comma": units._COMMA.fullmatch,
    "infinite": units._INFINITE.fullmatch,
    "thousands": grouped_digits._THOUSANDS["."].fullmatch,
    "fields": text_table.Dialect(",").fields,
    "point number": text_table.Dialect(";").number,
    "decimal comma number": text_table.Dialect(";", ",").number,
    "quoted field": text_table._QUOTED.findall,
    "token": key_names._TOKENS.findall,
    "place": table._PLACE.findall,
    "quoted": table._QUOTED.findall,
    "comma number": table._COMMA_NUMBER.findall,
    "unit number": table._UNIT_NUMBER.findall,
    "brackets": text_profiles._BRACKETED.findall,
    "bracketed fields": text_profiles._BRACKETED_FIELDS.fullmatch,
    "number of a unit": _OF_UNIT.findall,
    "csv": _FORMULA.match,
    "number of a csv": _NUMBER_OF_CELL.fullmatch,
}
PARTS = (
    *(
        "1",
        "a",
        " ",
        "1.",
        "1,",
        "1 ",
        "m*",
        "(",
        "[",
        '"',
        "'",
        '\\"',
        "e1",
        "=1",
        "=,",
        "/",
        "⁺",
        "\n",
        "##",
    ),
    *("a.", "[a]", "(1", "= ", "9 ", ",1"),
)
ENDS = ("", "x", "!", "\n", "y\nz", ",", "]")


@pytest.mark.slow
@each("search", named(PATTERNS))
def test_the_time_of_a_regular_expression_grows_with_the_length_of_the_text(search):
    """40 000 characters take below 1 s; an expression that takes the square of them takes seconds."""
    for part in PARTS:
        for end in ENDS:
            text = ("1 " + part * 40_000)[:40_000] + end
            times = []
            for _ in range(3):
                began = time.thread_time()
                search(text)
                times.append(time.thread_time() - began)
                if times[-1] < 1.0:
                    break
            assert min(times) < 1.0, (part, end)


def test_names_of_files_of_maps_are_recognised_soon():
    name = ("map_" + "_at_=" * 60)[:255]
    began = time.thread_time()
    assert result_folders._MAP.fullmatch(name) is None
    assert time.thread_time() - began < SOON


@pytest.mark.slow
@each(
    "text, message",
    [
        ("a." * 25_000 + "b = 1", "line 1 has a key of more than 16 parts"),
        ("[" + "a." * 400_000 + "b]", "line 1 has a key of more than 16 parts"),
        ('title = "a.b"\n\nx = {' + '"a" . ' * 20_000 + "b = 1}", "line 3 has a key of more than 16 parts"),
        ("x = " + "[" * 400_000, "is not TOML"),
        ("x = " + "{a = " * 100_000, "is not TOML"),
        ("x = " + "[" * 100 + "]" * 100, "x: has tables in each other more than 16 deep"),
        ("x = " + "{a = " * 40 + "1" + "}" * 40, "x: has tables in each other more than 16 deep"),
        ("x = " + "1" * 900_000, "is not TOML"),
        ('x = "' + '\\"' * 400_000, "is not TOML"),
        ("1" * 900_000, "is not TOML"),
        ("x = 1" + "," * 900_000, "is not TOML"),
        ("=" * 900_000, "is not TOML"),
        ('"' + "k" * 900_000 + '" = 1', "has 900000 characters; expected a key of at most 1000"),
        ('[vary]\n"' + "a." * 5000 + 'b" = [1]', "has 5001 parts; expected at most 16"),
    ],
    ids=lambda case: repr(case[0][:12]),
)
def test_hostile_files_are_refused_soon(tmp_path, text, message):
    (tmp_path / "case.toml").write_text(text)
    for read in (read_toml, Case.from_toml, Sweep.from_toml):
        line = refused(read, tmp_path / "case.toml")
        assert message in line
        assert len(line) < 400 + len(str(tmp_path))


def test_dots_in_texts_and_numbers_make_no_long_key():
    many = ", ".join(["1.5", '"a.b.c.d"', "'e.f.g.h'"] * 100)
    texts = f"y = '''\n{'b.' * 100}'''\nz = " + '"""' + "c." * 100 + '\\""""'
    refuse_long_keys(f"x = [{many}] # {'a.' * 100}\n{texts}")
    refuse_long_keys("\n".join(f"a.b{k}.c = 1.5" for k in range(1000)))
    with pytest.raises(InputError, match="line 2 has a key"):
        refuse_long_keys(f"x = 'a.b'\n{'a.' * 16}b = 1")
    refuse_long_keys(f"{'a.' * (MOST_DEEP - 1)}b = 1")


def nested(levels, kind=dict):
    inner = 1
    for _ in range(levels):
        inner = {"contact": inner} if kind is dict else [inner]
    return inner


def within_itself():
    table = {"grid": {}}
    table["grid"]["contact"] = table["grid"]["lubricant"] = table
    return table


DEEP = {
    "tables": lambda: nested(5000),
    "below the limit of Python": lambda: nested(300),
    "lists": lambda: {"roughness": nested(5000, list)},
    "itself": within_itself,
    "a list within itself": lambda: {"roughness": [items := [], items.append(items)]},
}


@each("made", named(DEEP))
def test_tables_that_are_too_deep_are_refused_wherever_they_are_given(made):
    case = Case.from_dict(CASE)
    for read in (
        refuse_deep,
        Case.from_dict,
        lambda table: Case(**table),
        ehlectric.solve,
        case.replace,
        lambda table: case.replace(contact=table),
        lambda table: case.replace({"contact.load": table}),
        lambda table: Sweep.from_dict({"case": table, "vary": {"grid.nodes": [401]}}),
        lambda table: Sweep.from_dict({"case": case, "vary": table}),
        lambda table: Sweep(case=case, vary=table),
    ):
        assert "has tables in each other more than 16 deep" in refused(read, made())


def test_as_many_levels_as_a_case_may_have():
    refuse_deep(nested(MOST_DEEP))
    with pytest.raises(InputError, match="more than 16 deep"):
        refuse_deep(nested(MOST_DEEP + 1))


@pytest.mark.parametrize("bits", [10_001, 16_000])
def test_integers_that_have_no_text_are_refused(bits):
    """Python writes no text for those of more than 4300 digits."""
    number = 2 ** (bits - 1)
    with pytest.raises(InputError, match=rf"^grid: got an integer of {bits} bits"):
        refuse_deep({"grid": {"nodes": [1, number]}})
    refuse_deep({"grid": {"nodes": [1, 2**10_000 - 1]}})


def test_keys_that_are_no_text_are_named():
    assert "got the key 1;" in refused(Case.from_dict, {1: 2})
    assert "got the key None" in refused(Case.from_dict(CASE).replace, {None: 2})


@pytest.mark.parametrize("parts", [5000, 20_000])
def test_a_varied_key_of_many_parts_is_refused_soon(parts):
    key = ".".join(["a"] * parts)
    line = refused(Sweep.from_dict, {"case": CASE, "vary": {key: [1, 2]}})
    assert f"has {parts} parts; expected at most 16" in line
    assert len(line) < 200
    assert f"has {parts} parts" in refused(Case.from_dict(CASE).replace, {key: 1})


def test_the_nearest_name_of_a_long_one_is_found_soon():
    began = time.thread_time()
    assert nearest("contact.load" + "x" * 1_000_000, ["contact.load", "grid.nodes"]) == "contact.load"
    assert time.thread_time() - began < SOON


@pytest.mark.slow
@each(
    "content",
    [
        "x [um],z [um]\n0,1\n1 " + "1" * 60_000 + "x\n",
        "1 " + "1" * 60_000 + "x",
        "a" * 1_000_000 + "\n0 1\n",
        "a " * 500_000 + "\n0;1\n",
        "(" * 1_000_000 + "\n0 1\n",
        "1 (" * 300_000 + "\n" + "\n".join(f"{k} 0" for k in range(40)),
        "1" + " " * 1_000_000 + "\n" + "\n".join(f"{k} 0" for k in range(40)),
        "0," * 300_000,
        "0;" * 300_000 + "x",
        "1" * 900_000 + "\n" + "1" * 900_000,
    ],
    ids=lambda content: repr(content[:12]),
)
def test_hostile_text_files_of_surfaces_are_refused_soon(tmp_path, content):
    (tmp_path / "rough.csv").write_text(content)
    line = refused(read_surface, tmp_path / "rough.csv")
    assert len(line) < 300 + len(str(tmp_path))


def test_values_of_a_grid_are_compared_soon():
    """Thirty thousand values, of which the last is there twice; comparing all pairs takes half a minute."""
    values = [*range(801, 60_801, 2), 801]
    began = time.thread_time()
    with pytest.raises(InputError, match="got 801 twice"):
        Sweep.from_dict({"case": CASE, "vary": {"grid.nodes": values}})
    assert time.thread_time() - began < 2.0 * SOON
