"""Voltages, charges and energies of a network of three shafts, by hand and by conservation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.drive.network import HOUSING, WINDING, Film, Network, rank

NANO = 1e-9

# Three shafts: rotor, intermediate and output shaft.
SHAFTS = ("1", "2", "3")


def network(conducting=(), **capacitances):
    """Network of three shafts with capacitances [nF]."""
    values = {"wr": 0.1, "10": 1.5, "12": 1.0, "20": 5.0, "23": 4.0, "30": 11.0} | capacitances
    ends = {"wr": (WINDING, "1"), "10": ("1", HOUSING), "12": ("1", "2"), "20": ("2", HOUSING)}
    ends |= {"23": ("2", "3"), "30": ("3", HOUSING)}
    films = [Film(name, *ends[name], NANO * value, name in conducting) for name, value in values.items()]
    return Network(SHAFTS, tuple(films))


def voltages_of(shafts):
    """Voltages of the elements that insulate, after an edge of 300 V."""
    potentials = shafts.potentials(300.0)
    return {each.name: abs(shafts.voltage(each, potentials)) for each in shafts.elements if not each.conducts}


def element(of, name):
    """Element of a network by its name."""
    return next(each for each in of.elements if each.name == name)


def test_potentials_after_an_edge_by_hand():
    """By Cramer's rule: the determinant is 333.4 nF^3, and the potentials are 30 (134, 15, 4)/333.4 V."""
    expected = [30.0 * part / 333.4 for part in (134.0, 15.0, 4.0)]
    assert list(network().potentials(300.0).values()) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "closed", "voltage", "after", "charge", "capacitance", "energy"),
    [
        ("12", (), 10.70786, (3.14685, 3.14685, 0.83916), 24.96503, 2.33147, 133.66103),
        ("10", (), 12.05759, (0.0, 0.0, 0.0), 30.0, 2.48806, 180.86383),
        ("20", (), 1.34973, (11.53846, 0.0, 0.0), 11.53846, 8.54872, 7.78690),
        ("23", (), 0.98980, (11.80556, 0.69444, 0.69444), 7.63889, 7.71759, 3.78049),
        ("10", ("12",), 3.14685, (0.0, 0.0, 0.0), 30.0, 9.53333, 47.20280),
        ("20", ("12",), 3.14685, (0.0, 0.0, 0.0), 30.0, 9.53333, 47.20280),
    ],
)
def test_breakdowns_by_hand(name, closed, voltage, after, charge, capacitance, energy):
    """Voltages [V], charge [nC], capacitance [nF] and energy [nJ] of a separate calculation."""
    shafts = network(closed)
    done = shafts.breakdown(element(shafts, name), shafts.potentials(300.0))
    assert done.voltage == pytest.approx(voltage, abs=1e-5)
    assert list(done.potentials.values()) == pytest.approx(after, abs=1e-5)
    assert done.charge / NANO == pytest.approx(charge, abs=2e-5)
    assert done.capacitance / NANO == pytest.approx(capacitance, abs=1e-5)
    assert done.energy / NANO == pytest.approx(energy, abs=2e-5)


def test_conducting_meshes_make_one_shaft():
    """30 nC on 17.6 nF, and without a gearbox on 1.6 nF."""
    everywhere = network(("12", "23")).potentials(300.0)
    assert list(everywhere.values()) == pytest.approx([30.0 / 17.6] * 3, rel=1e-12)
    alone = network(**{"12": 0.0, "23": 4.0}).potentials(300.0)
    assert alone["1"] == pytest.approx(18.75, rel=1e-12)


def test_a_large_capacitance_is_a_conducting_element():
    merged, large = network(("12",)).potentials(300.0), network(**{"12": 1e9}).potentials(300.0)
    assert list(large.values()) == pytest.approx(list(merged.values()), rel=1e-8)


def test_hybrid_bearings_raise_all_voltages():
    expected = (14.93979, 1.67237, 0.44596)
    assert list(network(**{"10": 1.02}).potentials(300.0).values()) == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(("closed", "rotor"), [("20", 11.53846), ("30", 12.0)])
def test_an_ideal_ring_on_another_shaft(closed, rotor):
    potentials = network((closed,)).potentials(300.0)
    assert potentials["1"] == pytest.approx(rotor, abs=1e-5)
    assert potentials["2" if closed == "20" else "3"] == 0.0


@given(
    st.lists(st.floats(0.01, 20.0), min_size=6, max_size=6),
    st.permutations(range(3)),
    st.floats(0.0, 0.9),
)
def test_the_energy_of_a_breakdown_is_lost_by_the_capacitances(values, order, part):
    """With the winding held, the energy before is the energy after, plus the energy of the breakdown."""
    names = ("wr", "10", "12", "20", "23", "30")
    shafts = network(**dict(zip(names, values, strict=True)))
    shafts = Network(tuple(SHAFTS[k] for k in order), shafts.elements)
    before = shafts.potentials(300.0)
    mesh = element(shafts, "12")
    rest = part * shafts.voltage(mesh, before)
    done = shafts.breakdown(mesh, before, rest)

    def energy(potentials):
        total = 0.0
        for each in shafts.elements:
            first, second = (
                300.0 if end == WINDING else potentials.get(end, 0.0) for end in (each.first, each.second)
            )
            total += 0.5 * each.capacitance * (first - second) ** 2
        return total

    # The source gives the charge that the winding takes up.
    winding = element(shafts, "wr")
    taken = winding.capacitance * (before["1"] - done.potentials["1"])
    lost = energy(before) + 300.0 * taken - energy(done.potentials)
    assert lost == pytest.approx(done.energy, rel=1e-6, abs=1e-9 * energy(before))
    assert shafts.voltage(mesh, done.potentials) == pytest.approx(rest, abs=1e-9)
    half = network(**{name: 0.5 * value for name, value in zip(names, values, strict=True)})
    assert half.breakdown(mesh, before, rest).energy == pytest.approx(0.5 * done.energy, rel=1e-9)


def test_the_rank_of_elements_by_their_breakdown_voltage():
    """The first mesh has most of the voltage, but a bearing with a thin film is first."""
    limits = {"10": 3.0, "12": 1.8, "20": 2.0, "23": 0.74, "30": 1.0}
    ranked = rank(voltages_of(network()), limits)
    assert [name for name, _ in ranked] == ["12", "10", "23", "20", "30"]
    assert ranked[0][1] == pytest.approx(10.70786 / 1.8, rel=1e-5)
    assert rank(voltages_of(network(("12",))), limits)[0][0] == "23"


def test_summits_that_touch_precede_all_others_by_their_voltage():
    """The first shaft has more voltage than the second one. What has no voltage does not discharge."""
    limits = {"10": 3.0, "12": 1.8, "20": 0.0, "23": 0.0, "30": 1.0}
    ranked = rank(voltages_of(network()), limits)
    assert ranked[:2] == [("20", np.inf), ("23", np.inf)]
    assert [name for name, _ in ranked[2:]] == ["12", "10", "30"]
    assert rank(voltages_of(network(("23",))), limits)[0] == ("20", np.inf)
    assert dict(rank(voltages_of(network(("20",))), limits))["23"] == 0.0


def test_a_shaft_without_a_path_to_the_housing_is_named():
    floating = Network(("1", "2"), (Film("10", "1", HOUSING, NANO),))
    with pytest.raises(ValueError, match="no path"):
        floating.potentials(1.0)
    assert np.isfinite(network().potentials(1.0)["3"])
