"""Roughness as Ra: Rq is the given factor times Ra, or sqrt(pi/2) times for Gaussian heights, with a note."""

import math

import numpy as np
import pytest

import ehlectric
from ehlectric import BearingCase, Case, InputError, evaluate, solve
from ehlectric.runs.preview import preview_of
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

GAUSSIAN = math.sqrt(math.pi / 2.0)
OF_RA = {"bearing__composite_rq": None, "bearing__composite_ra": "0.024 um", "contacts": "formula"}


def of_ra(**changes):
    return bearing_case(BALLS, **OF_RA | changes)


def test_the_factor_of_gaussian_heights():
    """Mean of |z| of a normal distribution with a standard deviation of 1, by quadrature."""
    z = np.linspace(0.0, 12.0, 200_001)
    mean = 2.0 * np.trapezoid(z * np.exp(-0.5 * z**2) / math.sqrt(2.0 * math.pi), z)
    assert 1.0 / mean == pytest.approx(GAUSSIAN, rel=1e-8)
    assert of_ra().bearing.composite_rq == pytest.approx(0.024e-6 * GAUSSIAN, rel=1e-12)


@pytest.mark.slow
def test_a_given_factor_and_the_same_bearing_with_its_rq():
    case = of_ra(bearing__rq_over_ra=1.11)
    same = bearing_case(BALLS, bearing__composite_rq=f"{0.024 * 1.11} um", contacts="formula")
    assert case.bearing.composite_rq == pytest.approx(same.bearing.composite_rq, rel=1e-12)
    found, wanted = (solve(one).summary()["bearing"] for one in (case, same))
    for key in ("lambda_ratio", "capacitance"):
        assert found[key] == pytest.approx(wanted[key], rel=1e-9)


@pytest.mark.slow
def test_check_shows_the_ra_with_its_rq():
    rows = {row.key: f"{row.text}{row.note}" for row in preview_of(of_ra()).rows}
    assert rows["inputs.bearing.composite_ra"].startswith("0.024 µm, Rq = 0.03008 µm with the factor 1.253")


def test_files_state_the_ra(tmp_path):
    for case in (of_ra(), of_ra(bearing__rq_over_ra=1.3)):
        assert "composite_rq" not in case.to_dict()["bearing"]
        assert BearingCase.from_dict(case.to_dict()) == case
        path = tmp_path / "case.toml"
        path.write_text(case.to_toml())
        assert BearingCase.from_toml(path) == case


def test_a_new_height_replaces_the_other_one():
    rq = bearing_case(BALLS)
    ra = rq.replace({"bearing.composite_ra": "0.04 um"})
    assert ra.bearing.composite_rq == pytest.approx(0.04e-6 * GAUSSIAN)
    assert ra.replace({"bearing.rq_over_ra": 1.2}).bearing.composite_rq == pytest.approx(0.048e-6)
    back = ra.replace({"bearing.rq_over_ra": 1.2}).replace({"bearing.composite_rq": "0.05 um"}).bearing
    assert (back.composite_rq, back.composite_ra, back.rq_over_ra) == (5e-8, None, None)


@pytest.mark.slow
@pytest.mark.parametrize("factor", [None, 1.3])
def test_table_and_warning_state_the_factor(factor):
    case = of_ra(bearing__rq_over_ra=factor)
    summary = solve(case).summary()
    rq = 0.024 * (factor or GAUSSIAN)
    assert summary["inputs"]["bearing"]["composite_rq"] == pytest.approx(1e-6 * rq)
    (row,) = (row for row in total_rows(summary) if row.key == "inputs.bearing.composite_ra")
    assert f"Rq = {rq:.4g} µm" in row.note
    assert ("assumed" if factor is None else "given") in row.note
    (text,) = (
        text
        for text, code in zip(summary["warnings"], summary["warning_codes"], strict=True)
        if code == "rq-of-ra"
    )
    assert ("assumed" if factor is None else "given") in text


@pytest.mark.slow
@pytest.mark.parametrize("factor", [None, 1.3])
def test_sweeps_and_evaluate_vary_the_ra(factor):
    """Twice the Ra is half of the lambda ratio."""
    case = of_ra(bearing__rq_over_ra=factor)
    table = evaluate(case, {"bearing.composite_ra": np.array([0.012e-6, 0.024e-6, 0.048e-6])})
    ratios = np.asarray(table["bearing.lambda_ratio"])
    assert ratios == pytest.approx(ratios[1] * np.array([2.0, 1.0, 0.5]), rel=1e-9)
    assert ratios[1] == pytest.approx(solve(case).summary()["bearing"]["lambda_ratio"], rel=1e-9)
    sweep = Sweep.from_dict({"case": case, "vary": {"bearing.composite_ra": ["12 nm", "24 nm"]}})
    assert sweep.axes["bearing.composite_ra"] == pytest.approx((12e-9, 24e-9))


@each(
    "changes, text",
    [
        ({"bearing__composite_rq": "0.03 um"}, "composite_rq and composite_ra together"),
        (
            {"bearing__composite_ra": None, "bearing__composite_rq": "1 um", "bearing__rq_over_ra": 1.2},
            "without",
        ),
        ({"bearing__rq_over_ra": 0.8}, "at least 1"),
        ({"bearing__composite_ra": "0.024 kg"}, "composite_ra"),
    ],
)
def test_what_is_refused(changes, text):
    with pytest.raises(InputError, match=text):
        of_ra(**changes)


CONTACT = {"reduced_radius": "10 mm", "reduced_modulus": "226 GPa", "load_per_length": "400 kN/m"}
CONTACT |= {"entrainment_speed": "2 m/s"}
SURFACE = {"surface": 1, "generator": "gaussian", "correlation_length": "20 um", "seed": 1}


def test_surfaces_and_meters_of_contacts():
    tables = {"contact": CONTACT, "lubricant": {"base": "paper"}, "roughness": [SURFACE | {"ra": "20 nm"}]}
    case = Case.from_dict(tables)
    assert case.roughness[0].rq == pytest.approx(20e-9 * GAUSSIAN)
    assert Case.from_dict(case.to_dict()) == case
    other = case.replace({"roughness.1.rq": "30 nm"}).roughness[0]
    assert (other.rq, other.ra) == (30e-9, None)
    again = case.replace({"roughness.1.rq": "30 nm"}).replace({"roughness.1.ra": "10 nm"}).roughness[0]
    assert again.rq == pytest.approx(10e-9 * GAUSSIAN)
    meter = {"fill": "oil", "length": "10 mm", "ra": "0.02 um", "rq_over_ra": 1.2}
    measured = Case.from_dict({"contact": CONTACT, "lubricant": {"base": "paper"}, "meter": meter})
    assert measured.meter.rq == pytest.approx(24e-9)
    assert Case.from_dict(measured.to_dict()) == measured
    with pytest.raises(InputError, match="is not used by a file"):
        Case.from_dict(tables | {"roughness": [{"surface": 1, "file": "a.csv", "ra": "1 um"}]})
    coarse = {"nodes": 129}
    codes = ehlectric.solve(Case.from_dict(measured.to_dict() | {"grid": coarse})).summary()["warning_codes"]
    assert codes.count("rq-of-ra") == 1
