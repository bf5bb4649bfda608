"""Values of an oil that replace the grade of an oil of the library."""

import pytest

from ehlectric import AxleCase
from ehlectric.axle.result import solve_axle
from ehlectric.axle.uncertainty import uncertainty_of
from tests.helpers.full_cases import cases_of


def test_a_viscosity_displaces_the_grade_of_the_oil():
    case = AxleCase.from_dict(cases_of("axle")[0])
    oil = case.replace({"lubricant.temperature.kinematic_viscosity_40": "50 mm^2/s"}).lubricant.temperature
    assert oil.iso_vg is None
    assert oil.kinematic_viscosity_40 == pytest.approx(5e-5, rel=1e-12, abs=0.0)


@pytest.mark.slow
def test_an_oil_with_a_grade_has_a_distribution_of_the_margin():
    """The viscosity at 40 degC of the grade is one of the uncertain inputs, and every axle has a result."""
    solution = solve_axle(AxleCase.from_dict(cases_of("axle")[0]), probable=False).solution
    margin = uncertainty_of(solution, stages=(32,))
    assert "lubricant.temperature.kinematic_viscosity_40" in [
        each["key"] for each in margin.summary()["indices"]
    ]
    assert all(each.breakdown > 0.0 for each in margin.elements)
