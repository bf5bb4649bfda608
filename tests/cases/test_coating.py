"""Table of a coated ring: values of the library, areas of rings, and lines for what is wrong."""

import math

import pytest
from scipy.constants import epsilon_0

from ehlectric.cases import library
from ehlectric.cases.coating_inputs import Coating
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

OUTER = {"ring": "outer", "thickness": "100 um", "relative_permittivity": 8.0}


def coated(coating, **bearing):
    changes = {f"bearing__{key}": value for key, value in bearing.items()}
    return bearing_case(BALLS, bearing__coating=coating, **changes)


@each("name", [name for name in library.coating_names() if name not in ("alumina", "over-moulded")])
def test_coated_rings_of_the_library_lack_their_permittivity(name):
    """No maker states it; with it and a thickness they are complete."""
    with pytest.raises(InputError, match="relative_permittivity"):
        Coating.from_dict({"base": name, "thickness": "100 um"})
    made = Coating.from_dict({"base": name, "thickness": "100 um", "relative_permittivity": 8.0})
    assert made.ring in ("inner", "outer")
    assert made.thickness == pytest.approx(1e-4)


def test_what_a_file_gives_stands_before_the_library():
    table = {"base": "schaeffler-j20aa", "relative_permittivity": 8.0}
    assert (Coating.from_dict(table).voltage, Coating.from_dict(table).thickness) == (3000.0, 2e-4)
    assert Coating.from_dict(table | {"strength": "10 V/um"}).voltage == pytest.approx(2000.0)


@pytest.mark.parametrize(
    ("ring", "dimensions", "diameter"),
    [("outer", {"outer_diameter": "80 mm"}, 0.08), ("inner", {"bore": "40 mm"}, 0.04)],
)
def test_the_area_of_a_ring(ring, dimensions, diameter):
    case = coated(OUTER | {"ring": ring}, width="18 mm", **dimensions)
    expected = epsilon_0 * 8.0 * math.pi * diameter * 0.018 / 1e-4
    assert case.bearing.coating_capacitance() == pytest.approx(expected, rel=1e-12)
    assert type(case).from_dict(case.to_dict()) == case


def test_an_over_moulded_ring_is_a_cylinder_capacitor():
    """2 pi eps0 eps_r B/ln((D + 2 t)/D) of 80 x 18 mm under 1 mm with 4.2: 170.3 pF."""
    case = coated("over-moulded", outer_diameter="80 mm", width="18 mm")
    expected = 2.0 * math.pi * epsilon_0 * 4.2 * 0.018 / math.log(82.0 / 80.0)
    assert case.bearing.coating_capacitance() == pytest.approx(expected, rel=1e-12)
    assert 1e12 * expected == pytest.approx(170.3, abs=0.05)
    assert type(case).from_dict(case.to_dict()) == case


@each("wrong", [{"ring": "inner"}, {"area": "40 cm^2"}])
def test_only_an_outer_ring_without_an_area_is_over_moulded(wrong):
    with pytest.raises(InputError, match="over_moulded"):
        Coating.from_dict(OUTER | {"over_moulded": True} | wrong)


def test_a_new_base_replaces_the_values_of_the_old_one():
    case = coated({"base": "schaeffler-j20aa", "relative_permittivity": 8.0, "area": "40 cm^2"})
    other = case.replace({"bearing.coating.base": "skf-insocoat-vl0241"}).bearing.coating
    assert (other.thickness, other.voltage, other.relative_permittivity, other.area) == (
        1e-4,
        None,
        8.0,
        4e-3,
    )
    stronger = case.replace({"bearing.coating.strength": "10 V/um"}).bearing.coating
    assert stronger.voltage == pytest.approx(2000.0)


@each("fill, value", [("30 %", 0.3), (0.25, 0.25), (1, 1.0), ("air", "air")])
def test_fillings(fill, value):
    assert bearing_case(BALLS, bearing__fill=fill).bearing.fill == value


def test_a_coating_in_one_line_says_what_it_assumes():
    coating = coated("alumina", width="18 mm", outer_diameter="80 mm").bearing.coating
    assert (coating.ring, coating.base) == ("outer", "alumina")
    assert coating.assumed == {"thickness": pytest.approx(1e-4), "relative_permittivity": 9.0}
    own = Coating.from_dict({"base": "alumina", "thickness": "150 um"})
    assert set(own.assumed) == {"relative_permittivity"}
    assert Coating.from_dict(OUTER).assumed == {}
