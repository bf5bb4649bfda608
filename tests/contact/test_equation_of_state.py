"""How much the equation of state changes a contact of a bearing at 2 GPa."""

import pytest

from tests.contact.equation_of_state import values

pytestmark = pytest.mark.measured


@pytest.mark.slow
@pytest.mark.gate
def test_tait_beside_dowson_higginson():
    """Tait's oil is 8 % denser at 2 GPa, so that the film is 7 % thinner and its permittivity 9 % higher.

    Both together make 17 % at the centre. Over the whole Hertz zone the mean pressure is two thirds of it,
    and the capacitance rises by about 10 %. The minimum film lies at the edge, at low pressure, and hardly
    changes.
    """
    simple, tait = (values(tait=law, nodes=97) for law in (False, True))
    assert simple["density"] == pytest.approx(1.2625, abs=0.005)
    assert tait["density"] == pytest.approx(1.36, abs=0.01)
    assert simple["permittivity"] == pytest.approx(3.01, rel=0.01)
    assert tait["permittivity"] == pytest.approx(3.29, rel=0.01)

    def change(name):
        return tait[name] / simple[name] - 1.0

    assert change("central film") == pytest.approx(-0.07, abs=0.015)
    assert change("central film") == pytest.approx(simple["density"] / tait["density"] - 1.0, abs=0.015)
    assert change("capacitance, centre") == pytest.approx(0.17, abs=0.025)
    assert 0.06 < change("capacitance, zone") < 0.14
    assert abs(change("minimum film")) < 0.015
