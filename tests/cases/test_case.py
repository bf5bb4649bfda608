"""Cases: alternatives, bounds, messages, replacement and round trips."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, InputError, solve
from ehlectric.contact.conditions import resolve
from ehlectric.contact.warnings import case_warnings
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each

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


# Texts of a user in a message, in which they are cut.
LONG = [
    (changed(title="x" * 201), r"^title: got 'x+\.\.\.x+'.* 200 "),
    (changed(contact={"x" * 1000: 1.0}), r"^contact\.'x+\.\.\.x+': "),
]


def test_defaults_are_those_of_the_paper():
    case = Case.from_dict(TABLE)
    assert (case.electric.potential_1, case.electric.potential_2) == (-1.0, 1.0)
    assert (case.grid.nodes, case.grid.ends) == (None, (-4.0, 2.0))
    assert case.grid.wedge == "third-order"
    assert case.grid.field_range == (-1.25, 1.25)
    assert case.lubricant.ambient_pressure == 1e5
    assert case.lubricant.viscosity == 0.04


def test_cases_are_frozen():
    case = Case.from_dict(TABLE)
    with pytest.raises(InputError, match="frozen"):
        case.title = "other"


@each("table, message", LONG)
def test_long_texts_are_cut(table, message):
    with pytest.raises(InputError, match=message) as caught:
        Case.from_dict(table)
    assert "\n" not in str(caught.value)


def test_messages_stay_short():
    with pytest.raises(InputError) as caught:
        Case.from_dict(changed(contact={"load_per_length": [1.0] * 1000}))
    assert len(str(caught.value)) < 400


def test_a_constant_viscosity_needs_no_coefficient():
    laws = {"viscosity_law": "constant", "density_law": "incompressible"}
    lubricant = {"viscosity": 0.04, "relative_permittivity": 2.4} | laws
    assert Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})


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


WARNINGS = [
    ({"contact.load_per_length": "2 kN/m"}, "isoviscous-rigid"),
    ({"contact.max_hertz_pressure": "20 MPa"}, "ambient"),
    ({"lubricant.viscosity_law": "barus"}, "Barus"),
    ({"lubricant.roelands_z": 0.4}, "0.675"),
]


@each("keys, message", WARNINGS)
def test_warnings_before_solving(keys, message):
    case = Case.from_dict(TABLE).replace(keys)
    assert any(message in text for text in map(str, case_warnings(case, resolve(case))))


def test_paper_case_needs_no_warning():
    case = Case.from_dict(TABLE)
    assert not list(case_warnings(case, resolve(case)))


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
    warnings = [w for w in case_warnings(case, resolve(case)) if w.code == "radius-large"]
    assert len(warnings) == told
    assert all("reduced_radius" in str(w) and " 1.1 m" in str(w) for w in warnings)


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


@each("key", ["contact.nonsense", "nonsense", "contact.load_per_length.x"])
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
    with pytest.raises(InputError, match=r"roelands_z: missing.*0\.675"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})
    del lubricant["roelands_pressure"]
    with pytest.raises(InputError, match=r"roelands_z: missing.*roelands_pressure"):
        Case.from_dict({"contact": PAPER_CONTACT, "lubricant": lubricant})


def test_contacts_that_no_bearing_has_are_said():
    contact = PAPER_CONTACT | {"load_per_length": "7 MN/m"}
    case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    assert any(
        "deforms permanently above 4 GPa" in text for text in map(str, case_warnings(case, resolve(case)))
    )
    electric = {"potential_1": 0.0, "potential_2": "2 kV"}
    case = Case.from_dict({"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "electric": electric})
    assert not any("permanently" in text for text in map(str, case_warnings(case, resolve(case))))
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
