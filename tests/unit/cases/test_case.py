"""Cases: alternatives, bounds, messages, replacement and round trips."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, InputError, solve
from ehlectric.contact.case_warnings import line_case_warnings
from ehlectric.contact.resolve import resolve
from tests.conftest import PAPER_CONTACT

TABLE = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}}


def changed(**tables):
    """The paper's case with keys changed, or dropped where they are None."""
    table = {key: dict(value) for key, value in TABLE.items()}
    for name, keys in tables.items():
        if not isinstance(keys, dict):
            table[name] = keys
            continue
        section = table.setdefault(name, {})
        for key, value in keys.items():
            section[key] = value
            if value is None:
                del section[key]
    return table


def test_defaults_are_those_of_the_paper():
    case = Case.from_dict(TABLE)
    assert (case.electric.potential_1, case.electric.potential_2) == (-1.0, 1.0)
    assert (case.grid.nodes, case.grid.inlet, case.grid.outlet) == (None, -4.0, 2.0)
    assert case.grid.wedge == "third-order"
    assert case.grid.field_range == (-1.25, 1.25)
    assert case.lubricant.ambient_pressure == 1e5
    assert case.lubricant.viscosity == 0.04


def test_cases_are_frozen():
    case = Case.from_dict(TABLE)
    with pytest.raises(InputError, match="a case is frozen"):
        case.title = "other"


# Each bad input with a part of the one line it gets.
# ruff: noqa: E501
BAD = [
    (changed(contact={"reduced_moduls": 1e9}), r"reduced_moduls: unknown key.*contact\.reduced_modulus"),
    (changed(roughness={"surface": 1}), r"roughness: got .* expected tables, each headed \[\[roughness\]\]"),
    (changed(roughness=[{"surface": 3}]), r"roughness\.surface: got 3; expected 1 or 2"),
    (changed(roughness=[{"surface": 1}]), r"roughness\.file: missing; expected either file or generator"),
    (changed(roughness=[{"surface": 1, "file": "a", "cutof": 1}]), r"cutof: unknown key.*roughness\.cutoff"),
    (changed(roughness=[{"surface": 1, "file": "a", "generator": "pit"}]), r"got file and generator together"),
    (changed(roughness=[{"surface": 1, "generator": "pits"}]), r"generator: got 'pits'; expected one of 'sinusoid'"),
    (changed(roughness=[{"surface": 1, "generator": "gaussian", "rq": 1e-8}]), r"correlation_length: missing"),
    (changed(roughness=[{"surface": 1, "file": "a", "rq": 1e-8}]), r"rq: is not used by a file"),
    (changed(roughness=[{"surface": 1, "file": "a", "direction": "y"}]), r"direction: got 'y'.*assume_transverse"),
    (changed(roughness=[{"surface": 1, "file": "a", "x_unit": "foo"}]), r"roughness\.x_unit: got 'foo' .* expected a unit of length"),
    (changed(roughness=[{"surface": 1, "file": "a", "z_unit": "kg"}]), r"roughness\.z_unit: got 'kg' .* expected a unit of length"),
    (changed(roughness=[{"surface": 1, "file": "a", "z_unit": 1}]), r"roughness\.z_unit: got 1; expected a string"),
    (changed(roughness=[{"surface": 1, "generator": "self-affine", "rq": 1e-8, "hurst": 0.5, "seed": 1, "rolloff_wavelength": 1e-5, "shortest_wavelength": 1e-5}]), r"shortest_wavelength: got 1e-05 m; expected less than rolloff"),
    (changed(nodes=5), r"nodes: unknown key.*grid\.nodes"),
    (changed(extra={"a": 1}), r"extra: unknown key"),
    (changed(contact={"load_per_length": None}), r"contact\.load_per_length: missing.*max_hertz_pressure"),
    (changed(lubricant={"base": None}), r"lubricant\.viscosity_law: required"),
    ({"lubricant": {"base": "paper"}}, r"contact: missing; expected a table"),
    (changed(contact={"reduced_modulus": "226 kg"}), r"reduced_modulus: got '226 kg' \(kg is not a unit"),
    (changed(contact={"load_per_length": -1.0}), r"contact\.load_per_length: got -1\.0; expected .*at least 0\.01"),
    (changed(contact={"load_per_length": 0}), r"contact\.load_per_length: got 0; expected .*at least 0\.01"),
    (changed(contact={"load_per_length": float("nan")}), r"got nan \(it is not finite\)"),
    (changed(contact={"load_per_length": float("inf")}), r"got inf \(it is not finite\)"),
    (changed(contact={"load_per_length": [1.0]}), r"got \[1\.0\] \(it is not a number\)"),
    (changed(contact={"load_per_length": True}), r"got True \(it is not a number\)"),
    (changed(contact={"max_hertz_pressure": "1 GPa"}), r"got load_per_length, max_hertz_pressure together"),
    (changed(contact={"reduced_radius": None, "radius_1": 1.0}), r"contact\.radius_2: missing"),
    (changed(contact={"reduced_radius": None, "radius_1": 0, "radius_2": 1.0}), r"radius_1: got 0"),
    (changed(contact={"speed_1": 1.0}), r"entrainment_speed, speed_1 together"),
    (changed(contact={"entrainment_speed": None, "speed_1": 1.0, "speed_2": -1.0}), r"speed_1, speed_2: got 1 and -1 m/s"),
    (
        changed(contact={"entrainment_speed": None, "speed_1": 1.0, "speed_2": 2.0, "slide_to_roll_ratio": 0}),
        r"slide_to_roll_ratio: follows from speed_1 and speed_2",
    ),
    (changed(contact={"geometry": "ball"}), r"contact\.geometry: got 'ball'; expected 'line'"),
    (changed(contact=[1]), r"contact: got \[1\]; expected a table"),
    (changed(title=3), r"title: got 3; expected a string"),
    (changed(title="two\nlines"), r"title: got 'two\\nlines'; expected at most 200 printable"),
    (changed(title="x" * 201), r"title: got 'x+\.\.\.x+'; expected at most 200"),
    (changed(lubricant={"base": None, "viscosity": 1}), r"viscosity_law: required; also missing: density_law"),
    (changed(contact={"a\nb": 1.0}), r"contact\.'a\\nb': unknown key"),
    (changed(contact={"x" * 1000: 1.0}), r"contact\.'x+\.\.\.x+': unknown key"),
    (changed(contact={"slide_to_roll_ratio": "1 deg"}), r"slide_to_roll_ratio: got '1 deg'"),
    (changed(electric={"potential_1": 1.0 + 1e-9}), r"electric\.potential_2: got 1 V, which is potential_1"),
    (changed(grid={"outlet": 1.2}), r"field_range: got \[-1\.25, 1\.25\], its default"),
    (changed(grid={"field_range": [0.0, 1e-12]}), r"field_range: .* holds 0 nodes of the film"),
    (changed(grid={"field_range": [0.0, 1e-12], "field_nodes": 50}), r"field_range: .* at least 0\.001"),
    (changed(grid={"nodes": 100, "inlet": -50.0}), r"grid\.nodes: got 100 over 52 half-widths; expected at least 417"),
    (changed(lubricant={"base": "papr"}), r"lubricant\.base: got 'papr'; expected .*paper"),
    (changed(lubricant={"viscosity_law": "roeland"}), r"viscosity_law: got 'roeland'.*nearest is 'roelands'"),
    (changed(lubricant={"viscosity_law": 3}), r"lubricant\.viscosity_law: got 3; expected a string"),
    (changed(electric={"potential_1": "1 V"}), r"electric\.potential_2: got 1 V, which is potential_1"),
    (changed(grid={"nodes": 10}), r"grid\.nodes: got 10; expected a whole number from 65"),
    (changed(grid={"nodes": 10**9}), r"grid\.nodes: got 1000000000; expected .* from 65 to 10000001"),
    (changed(grid={"nodes": "many"}), r"grid\.nodes: got 'many'; expected a whole number"),
    (changed(grid={"nodes": 100.5}), r"grid\.nodes: got 100\.5; expected a whole number"),
    (changed(grid={"inlet": 3.0}), r"grid\.inlet: got 3\.0; expected a number.*below -1"),
    (changed(grid={"field_range": [-5.0, 1.0]}), r"grid\.field_range: got \[-5, 1\].*\[-4, 2\]"),
    (changed(grid={"field_range": [1.0, -1.0]}), r"grid\.field_range: got \[1, -1\]"),
    (changed(grid={"field_range": [1.0]}), r"grid\.field_range: got .* expected a list of two numbers"),
    (changed(grid={"field_range": 1.0}), r"grid\.field_range: got 1\.0; expected a list of two numbers"),
    (changed(grid={"wedge": "third"}), r"grid\.wedge: got 'third'; expected 'third-order', 'second-order' or 'first-order'"),
]  # fmt: skip


@pytest.mark.parametrize(("table", "message"), BAD)
def test_bad_input_gets_one_line(table, message):
    with pytest.raises(InputError, match=message) as caught:
        Case.from_dict(table)
    assert "\n" not in str(caught.value)


def test_messages_stay_short():
    with pytest.raises(InputError) as caught:
        Case.from_dict(changed(contact={"load_per_length": [1.0] * 1000}))
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize("law", ["roelands", "barus", "constant"])
def test_a_law_takes_what_it_needs(law):
    lubricant = {
        "viscosity": 0.04,
        "viscosity_law": law,
        "density_law": "incompressible",
        "relative_permittivity": 2.4,
    }
    if law == "constant":
        assert Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})
    else:
        with pytest.raises(InputError, match="pressure_viscosity_coefficient: missing"):
            Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})


def test_alternatives_give_the_same_contact():
    reference = resolve(Case.from_dict(TABLE))
    modulus = 226e9 * (1 - 0.3**2)
    body = {"youngs_modulus": modulus, "poissons_ratio": 0.3}
    contact = {
        "radius_1": "28.2 mm",
        "radius_2": 0.0282,
        "body_1": body,
        "body_2": body,
        "max_hertz_pressure": reference.max_pressure,
        "speed_1": 5.0,
        "speed_2": 3.0,
    }
    other = resolve(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    for name in ("reduced_radius", "reduced_modulus", "load_per_length", "entrainment_speed", "half_width"):
        assert getattr(other, name) == pytest.approx(getattr(reference, name), rel=1e-12, abs=0.0)
    assert other.slide_to_roll_ratio == pytest.approx(0.5)
    assert (other.curvature_share, other.compliance_share) == pytest.approx((0.5, 0.5))


def test_shares_of_unequal_bodies():
    contact = PAPER_CONTACT | {
        "radius_1": 0.01,
        "radius_2": -0.02,
        "body_1": {"youngs_modulus": 200e9, "poissons_ratio": 0.0},
        "body_2": {"youngs_modulus": 300e9, "poissons_ratio": 0.0},
    }
    del contact["reduced_radius"], contact["reduced_modulus"]
    conditions = resolve(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    # 1/R = 1/0.01 - 1/0.02 = 50: body 1 has 100 of it. Compliances 1/200 and 1/300: three to two.
    assert conditions.reduced_radius == pytest.approx(0.02)
    assert conditions.curvature_share == pytest.approx(2.0)
    assert conditions.compliance_share == pytest.approx(0.6)


CONTRADICTIONS = [
    ({"radius_1": 0.02, "radius_2": -0.01, "reduced_radius": None}, "concave body must be wider"),
    ({"load_per_length": "900 MN/m"}, "dry contact would be"),
    (
        {"radius_1": 0.01, "radius_2": -0.0101, "reduced_radius": None, "load_per_length": 8e6},
        "less conforming",
    ),
    ({"load_per_length": "0.1 N/m"}, "well above the ambient"),
]


@pytest.mark.parametrize(("keys", "message"), CONTRADICTIONS)
def test_contradictions_are_refused(keys, message):
    with pytest.raises(InputError, match=message):
        resolve(Case.from_dict(changed(contact=keys)))


WARNINGS = [
    ({"contact.load_per_length": "2 kN/m"}, "isoviscous-rigid"),
    ({"contact.max_hertz_pressure": "20 MPa"}, "ambient pressure carries"),
    ({"lubricant.viscosity_law": "barus"}, "Barus"),
    ({"lubricant.roelands_z": 0.4}, "Roelands' own relation gives 0.675"),
]


@pytest.mark.parametrize(("keys", "message"), WARNINGS)
def test_warnings_before_solving(keys, message):
    case = Case.from_dict(TABLE).replace(keys)
    assert any(message in text for text in map(str, line_case_warnings(case, resolve(case))))


def test_paper_case_needs_no_warning():
    case = Case.from_dict(TABLE)
    assert not list(line_case_warnings(case, resolve(case)))


@pytest.mark.parametrize(("radius", "told"), [("1 m", 0), ("1.1 m", 1)])
def test_radii_of_no_machine_are_doubted(radius, told):
    case = Case.from_dict(
        {
            "contact": {
                "reduced_radius": radius,
                "reduced_modulus": "226 GPa",
                "max_hertz_pressure": "1 GPa",
                "entrainment_speed": "4 m/s",
            },
            "lubricant": {"base": "paper"},
        }
    )
    warnings = [w for w in line_case_warnings(case, resolve(case)) if w.code == "radius-large"]
    assert len(warnings) == told
    assert all(str(w).startswith("reduced_radius is 1.1 m, more than machine parts") for w in warnings)


def test_replace_displaces_alternatives():
    case = Case.from_dict(TABLE)
    other = case.replace({"contact.max_hertz_pressure": "1 GPa"}, contact={"speed_1": 1.0, "speed_2": 3.0})
    assert other.contact.load_per_length is None
    assert other.contact.entrainment_speed is None
    assert other.contact.max_hertz_pressure == 1e9
    assert case.contact.load_per_length == 1.57e6
    back = other.replace({"contact.load_per_length": 1.57e6, "contact.entrainment_speed": 4.0})
    assert back == case


def test_replace_takes_parts_of_another_case():
    case = Case.from_dict(TABLE)
    other = case.replace({"contact.max_hertz_pressure": "1 GPa", "grid.nodes": 801})
    assert case.replace(contact=other.contact, grid=other.grid) == other


def test_replace_of_the_base_drops_the_old_lubricant():
    case = Case.from_dict(changed(lubricant={"viscosity": 0.1}))
    assert case.replace({"lubricant.base": "paper"}).lubricant.viscosity == 0.04
    assert case.replace(title="b", lubricant={"relative_permittivity": 3.0}).lubricant.viscosity == 0.1


@pytest.mark.parametrize("key", ["contact.nonsense", "nonsense", "contact.load_per_length.x"])
def test_replace_refuses_unknown_keys(key):
    with pytest.raises(InputError, match="unknown key"):
        Case.from_dict(TABLE).replace({key: 1.0})


positive = st.floats(0.01, 1.0)


@given(
    title=st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=30),
    radius=positive,
    speed=st.floats(1e-3, 1e3),
    voltage=st.floats(-1e3, 1e3).filter(lambda v: v != -1.0),
    nodes=st.integers(1000, 10**7),
    field_range=st.tuples(st.floats(-4.0, -0.1), st.floats(0.1, 2.0)),
)
def test_toml_round_trip(title, radius, speed, voltage, nodes, field_range):
    table = changed(
        title=title,
        contact={"reduced_radius": radius, "entrainment_speed": speed},
        electric={"potential_2": voltage},
        grid={"nodes": nodes, "field_range": list(field_range)},
    )
    case = Case.from_dict(table)
    assert Case.from_dict(tomllib.loads(case.to_toml())) == case


def test_files_of_a_case_written_elsewhere(tmp_path, monkeypatch):
    """A name relative to one folder means another file beside the next one."""
    (tmp_path / "other").mkdir()
    rough = TABLE | {"roughness": [{"surface": 1, "file": "surfaces/a.csv"}]}
    (tmp_path / "case.toml").write_text(Case.from_dict(rough).to_toml())
    monkeypatch.chdir(tmp_path)
    case = Case.from_toml("case.toml")
    assert case.roughness[0].file == str(tmp_path / "surfaces" / "a.csv")
    (tmp_path / "other" / "case.toml").write_text(case.to_toml())
    assert Case.from_toml("other/case.toml") == case
    monkeypatch.chdir("other")
    assert Case.from_toml("case.toml") == case


def test_byte_order_mark_of_windows_editors(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(Case.from_dict(TABLE).to_toml(), encoding="utf-8-sig")
    assert Case.from_toml(path) == Case.from_dict(TABLE)


def test_files_that_are_no_cases(tmp_path):
    for name, content, message in (
        ("broken.toml", b"[contact\n", "is not TOML"),
        ("latin.toml", b"title = '\xe9'", "is not a text file in UTF-8"),
        ("deep.toml", b"a = " + 5000 * b"[", "is not TOML"),
        ("long.toml", b"a = " + 5000 * b"9", "is not TOML"),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(InputError, match=message):
            Case.from_toml(tmp_path / name)
    with pytest.raises(InputError, match="is a directory"):
        Case.from_toml(tmp_path)
    with pytest.raises(InputError, match="no such file"):
        Case.from_toml(tmp_path / "nowhere.toml")


def test_missing_roelands_exponent_is_given_by_his_relation():
    """alpha p0/(ln eta0 + 9.67) = 22e-9 1.98e8/(ln 0.04 + 9.67) = 0.675."""
    lubricant = {
        "viscosity": 0.04, "viscosity_law": "roelands", "pressure_viscosity_coefficient": 22e-9,
        "roelands_pressure": 0.198e9, "density_law": "incompressible", "relative_permittivity": 2.4,
    }  # fmt: skip
    with pytest.raises(InputError, match=r"roelands_z: missing.* gives 0.675$"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})
    del lubricant["roelands_pressure"]
    with pytest.raises(InputError, match=r"roelands_z: missing; .* needs it with roelands_pressure$"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})


def test_contacts_that_no_bearing_has_are_said():
    contact = PAPER_CONTACT | {"load_per_length": "7 MN/m"}
    case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    assert any(
        "deforms permanently above 4 GPa" in text
        for text in map(str, line_case_warnings(case, resolve(case)))
    )
    electric = {"potential_1": 0.0, "potential_2": "2 kV"}
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "electric": electric})
    assert not any("permanently" in text for text in map(str, line_case_warnings(case, resolve(case))))
    assert any(
        "no insulator withstands" in text
        for text in map(str, solve(case.replace({"grid.nodes": 801})).warnings)
    )


def test_an_empty_table_is_there_and_changes_nothing(paper_case):
    """An empty [discharge] asks for capacitances alone, by any way of writing it."""
    for changed in (paper_case.replace(discharge={}), paper_case.replace({"discharge": {}})):
        assert changed.discharge is not None
        assert changed.discharge.dielectric_strength is None
    strong = paper_case.replace(discharge={"dielectric_strength": "15 V/um"})
    assert strong.replace(discharge={}) == strong
    assert paper_case.replace(grid={}) == paper_case
