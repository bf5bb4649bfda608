"""Capacitances of an electric machine from its geometry."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse
from scipy.constants import epsilon_0
from scipy.sparse.linalg import spsolve

from ehlectric.formulas.capacitances import Machine, gap_shares, machine_capacitances

MACHINE = Machine(0.12, 0.11, 0.5e-3, 36, 3e-3, 2e-3, 2.0, 50e-3, 0.3e-3, 3.5)


@pytest.mark.parametrize(("opening", "gap", "pitch"), [(1, 0.2, 10), (1, 1, 10), (1, 5, 10), (3, 0.5, 10)])
def test_deep_slots_have_carters_coefficient(opening, gap, pitch):
    """Carter's conformal map of a single slot with parallel walls."""
    ratio = 0.5 * opening / gap
    lost = 4.0 / math.pi * (ratio * math.atan(ratio) - 0.5 * math.log(1.0 + ratio**2))
    winding, rotor = gap_shares(opening, pitch, gap, 20.0 * opening, 1.0)
    assert rotor == pytest.approx(1.0 - lost * gap / pitch, rel=1e-4)
    assert winding < 1e-20


def test_copper_close_below_wide_openings_is_a_plate():
    """The field of the edges, of the order of the gap over the opening, is left out of the plate."""
    winding, rotor = gap_shares(100.0, 200.0, 0.5, 0.1, 2.0)
    assert winding == pytest.approx(0.5 * 0.5 / (0.5 + 0.1 / 2.0), rel=0.01)
    assert rotor == pytest.approx(0.5 + 0.5 * 0.5 / (0.5 + 0.1 / 2.0), rel=0.01)


def _by_differences(opening, pitch, gap, depth, permittivity, cells):
    """The same from finite volumes of half a slot pitch, with ``cells`` of them in the gap."""
    step = gap / cells
    columns, rows = round(0.5 * pitch / step), cells + round(depth / step)
    in_slot = (np.arange(columns) + 0.5) * step < 0.5 * opening
    free = np.ones((rows, columns), dtype=bool)
    free[cells:, ~in_slot] = False
    number = np.full(free.shape, -1)
    number[free] = np.arange(free.sum())
    material = np.ones(rows)
    material[cells:] = permittivity
    matrix, charge = sparse.lil_matrix((free.sum(), free.sum())), np.zeros(free.sum())
    for row, column in np.argwhere(free):
        own, here = number[row, column], material[row]
        for d_row, d_column in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            r, c = row + d_row, column + d_column
            if c < 0 or c >= columns:
                continue
            # A face to an electrode is half a cell away.
            if r < 0 or r >= rows or not free[r, c]:
                matrix[own, own] += 2.0 * here
                charge[own] += 2.0 * here * (r >= rows)
            else:
                face = 2.0 * here * material[r] / (here + material[r])
                matrix[own, own] += face
                matrix[own, number[r, c]] -= face
    potential = spsolve(matrix.tocsr(), charge)
    return 2.0 * float(np.sum(potential[number[0]])) / (0.5 * pitch / gap)


def test_capacitance_to_the_copper_is_that_of_finite_volumes():
    shape = (2.0, 5.0, 0.5, 1.0, 2.0)
    coarse, fine = (_by_differences(*shape, cells) for cells in (6, 12))
    assert gap_shares(*shape)[0] == pytest.approx(2.0 * fine - coarse, rel=0.01)


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=25)
@given(
    st.floats(0.2, 0.9), st.floats(0.05, 1.0), st.floats(0.05, 3.0), st.floats(1.0, 10.0), st.floats(1.05, 2)
)
def test_bounds(opening, gap, depth, permittivity, factor):
    """Neither more than the plates, nor less with a better dielectric or with copper that is nearer."""
    winding, rotor = gap_shares(opening, 1.0, gap, depth, permittivity)
    assert 0.0 <= winding <= opening * gap / (gap + depth / permittivity) * (1.0 + 2.0 * gap / opening)
    assert winding < rotor <= 1.0 + 1e-12
    assert gap_shares(opening, 1.0, gap, depth, factor * permittivity)[0] >= winding
    assert gap_shares(opening, 1.0, gap, depth / factor, permittivity)[0] >= winding


def test_a_machine():
    found = machine_capacitances(MACHINE)
    plate = epsilon_0 * 3.5 * 36 * 0.12 * 50e-3 / 0.3e-3
    assert found.winding_frame == pytest.approx(plate)
    plates = 36 * epsilon_0 * 0.12 * 3e-3 / (0.5e-3 + 2e-3 / 2.0)
    assert plates / found.winding_rotor == pytest.approx(3.4, abs=0.05)  # as docs/theory/drive.md says
    smooth = 2.0 * math.pi * epsilon_0 * 0.12 / math.log(110.0 / 109.0)
    assert 0.8 * smooth < found.rotor_frame < smooth
    longer = machine_capacitances(replace(MACHINE, length=0.24))
    assert longer.winding_rotor == pytest.approx(2.0 * found.winding_rotor)
