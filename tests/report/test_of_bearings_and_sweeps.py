"""What reports say of bearings and sweeps: no internal names, no columns that mislead, no heading twice."""

import re

import pytest

from ehlectric import BearingCase, save, solve
from ehlectric.cases.case import Case
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.report.build import report_of
from ehlectric.report.pdf import _parted
from ehlectric.report.report_content import Picture, Table, Text
from ehlectric.report.report_facts import pictures_of, warning_block
from ehlectric.report.report_texts import references_of
from ehlectric.report.sweep_report import sweep_part
from tests.helpers.bearings import BALLS, OIL, ROLLERS, bearing_case, changed
from tests.helpers.sweep_models import POTENTIAL, SPEED, breakdown, grid

OF_LIBRARY = (
    "kind",
    "elements",
    "element_diameter",
    "pitch_diameter",
    "inner_groove",
    "outer_groove",
    "shoulder_height",
)


@pytest.fixture(scope="module")
def touching(tmp_path_factory):
    """Report of a bearing of the library that is so slow that its surfaces touch."""
    place = tmp_path_factory.mktemp("touching")
    own = {f"bearing__{key}": None for key in OF_LIBRARY}
    own |= {"bearing__base": "6208", "bearing__inner_speed": "30 rpm", "lubricant": OIL}
    save(solve(BearingCase.from_dict(changed(BALLS, contacts="formula", **own))), place)
    return report_of(place)


@pytest.mark.slow
def test_a_figure_that_is_empty_is_told_in_words(touching):
    texts = [block.text for block in touching.blocks() if isinstance(block, Text)]
    assert not any(".png" in text or "expected one of" in text for text in texts)


@pytest.mark.slow
def test_the_name_of_a_bearing_keeps_its_letters(touching):
    answer = touching.sections[2].blocks
    assert any(isinstance(block, Text) and block.text.startswith("Bearing 6208") for block in answer)


@pytest.mark.slow
def test_cells_are_true_without_the_cells_beside_them(touching):
    tables = [block for block in touching.blocks() if isinstance(block, Table)]
    cells = {row[0]: row for table in tables if "quantity" in table.heads for row in table.rows}
    assert cells["first breakdown voltage"][1] == "not computed"
    assert cells["first breakdown voltage"][3].endswith("discharges at a low voltage")
    assert cells["parallel capacitance"][1] == "not given"


@pytest.mark.slow
def test_the_finding_of_a_figure_is_said_once(touching):
    pictures = [block for block in touching.blocks() if isinstance(block, Picture)]
    assert pictures
    for picture in pictures:
        assert picture.title
        assert not picture.figure.get_suptitle().strip()


@pytest.mark.slow
def test_the_minimum_film_has_the_contact_that_it_belongs_to():
    result = solve(bearing_case(BALLS, contacts="formula"))
    (loads,) = pictures_of(result, converged=True, names=["bearing_loads"])
    thinnest = min(result.contacts(), key=lambda row: row["minimum_thickness"])
    assert f"{thinnest['minimum_thickness'] * 1e6:.3g} µm ({thinnest['ring']}, " in loads.title


def test_publications_are_those_of_the_laws_that_are_used():
    def used(tables, **changes):
        case = BearingCase.from_dict(changed(tables, **changes))
        return " ".join(f"{one.topic}: {one.citation}" for one in references_of(case))

    heated = {"bearing__film_factor": "inlet-shear", "lubricant__thermal_conductivity": "0.14 W/m/K"}
    balls = used(BALLS, contacts="formula", **heated)
    for name in ("Wilson and Sheu", "Roelands", "Dowson and Higginson,", "ASTM D341"):
        assert name in balls
    assert "equations of film and field" not in balls
    assert "ISO/TS 16281" not in balls
    rollers = used(ROLLERS)
    assert "ISO/TS 16281" in rollers
    assert "equations of film and field" in rollers
    assert "Wilson" not in rollers


def test_publications_of_a_contact_are_those_of_its_laws():
    contact = {"reduced_radius": 0.01, "reduced_modulus": 2e11, "load_per_length": 1e5}
    oil = {"viscosity": 0.01, "viscosity_law": "barus", "pressure_viscosity_coefficient": 2e-8}
    oil |= {"density_law": "incompressible", "permittivity_law": "constant", "relative_permittivity": 2.0}
    case = Case.from_dict({"contact": contact | {"entrainment_speed": 1.0}, "lubricant": oil})
    cited = " ".join(one.citation for one in references_of(case))
    assert "Barus" in cited
    assert not re.search("Roelands|Dowson and Higginson, Elasto|ASTM", cited)


def points_of(results):
    """Tables of the varied inputs, which are on the first page, and of the points."""
    part = sweep_part(results)
    (section,) = (one for one in part.further if one.title == "Points")
    return [block for block in (*part.first, *section.blocks) if isinstance(block, Table)]


def test_points_of_a_sweep_have_their_numbers_and_volts():
    """A large value gives the others no prefix."""
    speeds = (0.01, 4.0, 4e4)
    _, points = points_of(grid({SPEED: speeds, POTENTIAL: (4.0,)}))
    assert [row[0] for row in points.rows] == ["0", "1", "2"]
    column = next(n for n, head in enumerate(points.heads) if head.startswith("breakdown voltage"))
    assert "[V]" in points.heads[column]
    voltages = [breakdown({SPEED: speed})["discharge"]["breakdown_voltage"] for speed in speeds]
    assert [row[column] for row in points.rows] == [f"{voltage:.4g}" for voltage in voltages]


def test_temperatures_of_a_sweep_are_in_degrees_celsius():
    varied, points = points_of(grid({"contact.temperature": (243.15, 393.15)}))
    assert "°C" in varied.rows[0][0].text
    assert varied.rows[0][1] == "-30, 120"
    assert [row[1] for row in points.rows] == ["-30", "120"]


def test_warnings_of_one_code_have_one_heading():
    told = [ResultWarning("points-with-warnings", text) for text in ("one", "two")]
    lines = warning_block(told).lines
    assert [(line.code, line.texts) for line in lines] == [("points-with-warnings", ("one", "two"))]


@pytest.mark.slow
def test_words_are_broken_after_a_mark_where_they_are_too_long():
    assert _parted("kinematic_viscosity_40", 80.0, 8.0) == "kinematic_<br/>viscosity_40"
    assert _parted("a<b", 80.0, 8.0) == "a&lt;b"
    assert _parted("short_word", 80.0, 8.0) == "short_word"
