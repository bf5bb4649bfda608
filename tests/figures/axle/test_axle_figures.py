"""Figures of an axle: forces in equilibrium on each shaft, and the network with its voltages."""

import numpy as np
import pytest

from ehlectric import AxleCase, figure, figure_names, solve_axle
from ehlectric.figures.axle_figures import FIGURES, drawings_of
from ehlectric.figures.figure_names import AXLE_FIGURE_FILES
from ehlectric.figures.network_elements import elements_of_network
from ehlectric.figures.shaft_forces import placed_forces
from ehlectric.quantities.palette import ORANGE
from ehlectric.readable import readable
from tests.axle.axles import ALONE, two_stages
from tests.helpers.places import DATA
from tests.helpers.titles import title_of


@pytest.fixture(scope="module")
def result():
    return solve_axle(two_stages(), remedies=False, probable=False)


def texts(ax):
    return [text.get_text() for text in ax.texts]


def test_names_are_those_of_the_files(result):
    names = [name.removesuffix(".png") for name in AXLE_FIGURE_FILES]
    assert tuple(FIGURES) == AXLE_FIGURE_FILES
    assert figure_names(result) == names[:3]
    assert figure_names(solve_axle(AxleCase.from_dict(ALONE), probable=False)) == names[:2]


def test_remedies_have_a_cell_for_each_element():
    """Each cell contains U/V_b of the ranking, or a word."""
    result = solve_axle(two_stages(), probable=False)
    (ax,) = figure(result, "axle_remedies").axes
    columns = 1 + len(result.remedies)
    assert len(ax.texts) == columns * len(result.solution.elements)
    first = ax.get_yticklabels()[0].get_text()
    assert first == result.solution.ranking()[0][0]
    for text, solution in zip(ax.texts[:columns], (result.solution, *result.remedies), strict=True):
        ratio = dict(solution.ranking()).get(first)
        assert (
            text.get_text() == readable(ratio, 3) if ratio is not None else not text.get_text()[:1].isdigit()
        )
    assert title_of(ax.figure)[0].startswith("Ring on the rotor: ")


def test_remedies_name_elements_that_touch_or_conduct():
    """Ground flanks touch at any voltage, and a mesh that is set to conduct has no voltage."""
    rough = two_stages().replace(
        {"mesh.1.gear.flank_ra": "0.3 um", "mesh.2.gear.contact.conduction": "always"}
    )
    (ax,) = figure(solve_axle(rough, probable=False), "axle_remedies").axes
    names = [label.get_text() for label in ax.get_yticklabels()]
    first_column = ax.texts[:: len(ax.texts) // len(names)]
    words = dict(zip(names, (text.get_text() for text in first_column), strict=True))
    assert words["mesh of rotor and intermediate"] == "touches"
    assert words["mesh of intermediate and output"] == "conducts"


@pytest.mark.parametrize("case", [two_stages, lambda: AxleCase.from_toml(DATA / "axles" / "e_axle.toml")])
def test_forces_of_each_shaft_are_in_balance(case):
    """For both signs of the torque; the second sign turns the tangential and the axial forces."""
    for forces in placed_forces(case()).values():
        both = np.array([each.forces for each in forces])
        assert np.sum(both, axis=0) == pytest.approx(0.0, abs=1e-9 * np.max(np.abs(both)))
        meshes = [each.forces for each in forces if each.kind == "mesh"]
        for first, second in meshes:
            assert first[2] == pytest.approx(-second[2], rel=1e-12)
            assert np.hypot(*first[:2]) == pytest.approx(np.hypot(*second[:2]), rel=1e-12)


def test_forces_are_written_at_their_arrows(result):
    """Numbers of the separate program at 150 N m, in proportion to the torque, in the names below."""
    panels = figure(result, "axle_forces").axes
    assert len(panels) == 6
    labels = [label.get_text() for label in panels[0].get_xticklabels()]
    assert labels[0] == "bearing 1\nat 0 mm\n989 | 860 N"
    assert labels[2] == "bearing 2\nat 80 mm\n507 | 633 N"
    along = [label.get_text().split("\n")[2] for label in panels[1].get_xticklabels()]
    assert along == ["630 | -630 N", "-630 | 630 N", "0 | 0 N"]
    assert "-30 N m" in title_of(figure(result, "axle_forces"))[0]


def test_the_network_shows_voltages_and_marks_the_first_element(result):
    (ax,) = figure(result, "axle_network").axes
    written = texts(ax)
    potentials = result.solution.potentials()
    assert f"rotor\n{potentials['rotor']:.1f} V" in written
    name, ratio = result.solution.ranking()[0]
    assert name == "mesh of rotor and intermediate"
    assert any(text.endswith(f"= {ratio:.1f}") for text in written)
    assert "mesh, conducts" in written
    bold = [text.get_text() for text in ax.texts if text.get_weight() == "bold"]
    capacitance = next(each.capacitance for each in result.solution.elements if each.name == name)
    assert bold[-2] == f"mesh, {1e12 * capacitance:.1f} pF"
    # Bars of all elements with a breakdown voltage; a half is filled at the breakdown voltage.
    filled = [patch for patch in ax.patches if patch.get_facecolor()[:3] == pytest.approx(_rgb(ORANGE))]
    assert len(filled) == 1
    assert filled[0].get_width() == pytest.approx(1.2 * 0.5 * (1.0 + np.log10(ratio) / 2.0))


def _rgb(colour):
    return [int(colour[at : at + 2], 16) / 255.0 for at in (1, 3, 5)]


def test_links_are_in_the_network():
    links = [
        {"between": ["rotor", "output"], "kind": "ring", "resistance": 1e4},
        {"between": ["intermediate", "housing"], "kind": "brush", "resistance": 2.0},
    ]
    (ax,) = figure(solve_axle(two_stages(link=links), remedies=False), "axle_network").axes
    assert {"ring, 10 kΩ", "brush, 2 Ω"} <= {*texts(ax)}


def test_an_axle_without_gears_has_a_figure_of_its_forces():
    """One torque, as no force depends on its sign, and no number for forces of 0."""
    bearings = [
        {key: bearing[key] for key in bearing if not key.endswith("_load")} for bearing in ALONE["bearing"]
    ]
    shaft = [{"name": "rotor", "rotor": True, "mass": "10 kg", "mass_at": "20 mm"}]
    result = solve_axle(AxleCase.from_dict(ALONE | {"bearing": bearings, "shaft": shaft}), probable=False)
    assert "axle_forces.png" in drawings_of(result)
    ax, other = figure(result, "axle_forces").axes
    assert [text.get_text() for text in ax.texts if text.get_text().endswith(" N")] == []
    numbers = sorted(float(text.get_text()[:-2]) for text in other.texts if text.get_text().endswith(" N"))
    assert numbers == pytest.approx([24.5, 73.5, 98.1], abs=0.1)


def test_the_network_shows_shafts_and_housing_only():
    """Choke, cable and earth are not between them."""
    keys = {"common_mode_inductance": "1 mH", "ground_inductance": "1 uH", "cable_capacitance": "1 nF"}
    keys["frame_earth_capacitance"] = "1 nF"
    plain, inductive = (
        solve_axle(AxleCase.from_dict(ALONE | {"circuit": ALONE["circuit"] | more}), probable=False).solution
        for more in ({}, keys)
    )
    shown = [each.film.name for each in elements_of_network(inductive)]
    assert shown == [each.film.name for each in elements_of_network(plain)]
    assert shown == ["rotor and frame", "bearing 1 of rotor", "bearing 2 of rotor"]
