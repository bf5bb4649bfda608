"""Clearance in operation of a bearing file with fits: what it is, what it warns of, and what it refuses."""

import re

import pytest

from ehlectric import InputError
from ehlectric.bearing.mounted_clearance import (
    class_warning_conditions,
    fit_warning_conditions,
    mounted_clearance,
)
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.result_warnings import active
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.each import each

FITS = {
    "bearing__radial_clearance": None,
    "bearing__bore": "40 mm",
    "bearing__outer_diameter": "80 mm",
    "bearing__fits__unmounted_clearance": "24 um",
    "bearing__fits__shaft_interference": "13.5 um",
    "bearing__fits__housing_interference": "-20 um",
    "bearing__fits__housing_material": "aluminium",
}


def fitted(**changes):
    return bearing_case(BALLS, **FITS | changes)


def um(case):
    found = mounted_clearance(case.bearing)
    return tuple(1e6 * value for value in (found.mounted.clearance, found.running.clearance))


def test_the_fit_of_the_shaft_and_a_warm_inner_ring_take_clearance():
    """By hand: 13.5 um 40/48.082; then 12.5e-6 (71.918 50 K - 48.082 65 K - 2 11.906 57.5 K).

    The raceways are 60 mm less and plus 11.906 mm and half of 24 um.
    """
    mounted = 24.0 - 13.5 * 40.0 / 48.082
    warm = 12.5e-3 * (71.918 * 50.0 - 48.082 * 65.0 - 2.0 * 11.906 * 57.5)
    case = fitted(bearing__inner_ring_temperature="85 degC")
    assert um(case) == pytest.approx((mounted, mounted + warm), rel=1e-9, abs=0.0)
    assert resolve_bearing(case).geometry.clearance == mounted_clearance(case.bearing).running.clearance


def test_temperatures_of_shaft_elements_and_housing_are_those_of_the_rings_unless_given():
    assert um(fitted(bearing__fits__element_temperature="70 degC")) == um(fitted())
    same = {"shaft_temperature": "85 degC", "element_temperature": "77.5 degC"}
    case = fitted(bearing__inner_ring_temperature="85 degC")
    own = case.replace({f"bearing.fits.{key}": value for key, value in same.items()})
    assert um(own) == pytest.approx(um(case), rel=1e-12, abs=0.0)
    warmer = case.replace({"bearing.fits.shaft_temperature": "95 degC"})
    # 10 K 12.5e-6 40 mm = 5 um of interference, 40/48.082 of which reach the raceway.
    assert um(warmer)[1] == pytest.approx(um(case)[1] - 5.0 * 40.0 / 48.082, rel=1e-6, abs=0.0)


def test_a_class_is_the_clearance_before_mounting():
    """C3 of a bore of 40 mm is 15 to 33 um, its middle 24."""
    of_class = fitted(bearing__fits__unmounted_clearance=None, bearing__clearance_class="C3")
    assert um(of_class) == um(fitted())
    assert of_class.bearing.radial_clearance is None
    assert BearingCase.from_dict(of_class.to_dict()) == of_class
    (warning,) = active(class_warning_conditions(of_class.bearing))
    assert "15 to 33 µm" in str(warning)
    assert " 9 µm" in str(warning)
    as_clearance = fitted(bearing__fits__unmounted_clearance=None, bearing__radial_clearance="C3")
    assert as_clearance == of_class


def test_rollers_have_fits_too():
    case = bearing_case(ROLLERS, **FITS)
    assert um(case)[0] == pytest.approx(24.0 - 13.5 * 40.0 / 48.988, rel=1e-9, abs=0.0)


def test_a_preload_and_a_loose_ring_are_warned_of():
    assert list(active(fit_warning_conditions(None))) == []
    assert list(active(fit_warning_conditions(mounted_clearance(fitted().bearing)))) == []
    tight = fitted(bearing__inner_ring_temperature="120 degC")
    (preload,) = active(fit_warning_conditions(mounted_clearance(tight.bearing)))
    assert preload.code == "clearance-negative"
    assert f"{um(tight)[1]:.3g} µm" in preload.text
    loose = fitted(bearing__fits__housing_interference="10 um", bearing__fits__housing_diameter="120 mm")
    (warning,) = active(fit_warning_conditions(mounted_clearance(loose.bearing)))
    assert warning.code == "fit-loose"
    # (22 - 12.5) 1e-6/K 50 K 80 mm = 38 um.
    assert "10 µm" in warning.text
    assert "-28 µm" in warning.text


@each(
    "changes, key, names",
    [
        ({"bearing__radial_clearance": "10 um"}, "radial_clearance", ["1e-05 m", "clearance_class"]),
        ({"bearing__fits__unmounted_clearance": None}, "fits.unmounted_clearance", ["clearance_class"]),
        ({"bearing__clearance_class": "C3"}, "fits.unmounted_clearance", ["clearance_class"]),
        ({"bearing__bore": None}, "bore", ["missing", "[bearing.fits]"]),
        ({"bearing__outer_diameter": None}, "outer_diameter", ["missing", "[bearing.fits]"]),
        ({"bearing__fits__shaft_bore": "40 mm"}, "fits.shaft_bore", ["got 0.04 m", ", 0.04 m"]),
        ({"bearing__fits__housing_diameter": "79 mm"}, "fits.housing_diameter", ["0.079 m", "0.08 m"]),
        (
            {"bearing__fits__housing_material": "wood"},
            "fits.housing_material",
            ["'wood'", "aluminium, cast-iron, silicon-nitride, steel"],
        ),
        ({"bearing__ring_material": "cast-iron"}, "ring_material", ["'cast-iron'", "silicon-nitride, steel"]),
    ],
)
def test_what_a_file_with_fits_may_not_have(changes, key, names):
    with pytest.raises(InputError, match=rf"^bearing\.{re.escape(key)}: ") as error:
        fitted(**changes)
    assert [name for name in names if name not in str(error.value)] == []


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        (
            {"bearing__fits__housing_interference": "5 um"},
            r"bearing\.fits\.housing_diameter: missing.* 5 um",
        ),
        (
            {"bearing__fits__shaft_interference": "2 mm"},
            r"bearing\.fits: got .* -1640 um.* -1000 to 10000 um",
        ),
    ],
)
def test_what_fits_refuse_at_their_temperatures(changes, line):
    with pytest.raises(InputError, match=rf"^{line}$"):
        resolve_bearing(fitted(**changes))


def test_angular_contact_bearings_have_a_contact_angle_in_place_of_fits():
    changes = {"bearing__kind": "angular-contact ball", "bearing__contact_angle": "15 deg"}
    with pytest.raises(InputError, match=r"^bearing\.fits: .*'angular-contact ball'"):
        fitted(**changes)


def test_a_changed_case_keeps_one_clearance():
    case = fitted()
    given = case.replace({"bearing.radial_clearance": "5 um"}).bearing
    assert (given.fits, given.radial_clearance) == (None, 5e-6)
    for key in ("radial_clearance", "clearance_class"):
        of_class = case.replace({f"bearing.{key}": "C4"}).bearing
        assert (of_class.clearance_class, of_class.fits.unmounted_clearance) == ("C4", None)
        assert of_class.fits.shaft_interference == 13.5e-6
        again = case.replace({f"bearing.{key}": "C4"}).replace({"bearing.fits.unmounted_clearance": "9 um"})
        assert (again.bearing.clearance_class, again.bearing.unmounted_clearance) == (None, 9e-6)
    fits = {key.replace("__", "."): value for key, value in FITS.items() if value is not None}
    assert bearing_case(BALLS).replace(fits) == case


def test_fits_and_classes_are_varied_in_sweeps():
    """An interference is a varied key as any other, and passes on 40/48.082 to the raceway."""
    case = fitted(bearing__fits__unmounted_clearance=None, bearing__clearance_class="C3")
    vary = {
        "bearing.fits.shaft_interference": {"from": "0 um", "to": "10 um", "count": 2},
        "bearing.clearance_class": ["C2", "C3"],
        "bearing.inner_ring_temperature": ["70 degC"],
    }
    sweep = Sweep.from_dict({"case": case.to_dict(), "vary": vary})
    assert sweep.size == 4
    assert sweep.axes["bearing.fits.shaft_interference"] == (0.0, 10e-6)
    for interference in (0.0, 10e-6):
        changed = case.replace({"bearing.fits.shaft_interference": interference})
        assert um(changed)[0] == pytest.approx(24.0 - 1e6 * interference * 40.0 / 48.082, rel=1e-9, abs=0.0)
    for key in ("bearing.fits.shaft_interference", "bearing.running_clearance"):
        assert label_of(key, case).unit == "m"
