"""Capacitances between winding, rotor and frame of an electric machine, from its geometry. SI units.

The rotor is a smooth conducting cylinder: a closed or bar-filled surface. The stator is a row of slots with
parallel walls at the potential of the frame; the copper of the winding fills them from a depth below the
bore on. The electric field of one slot, unrolled, is solved by its modes in the slot and in the air gap,
matched at the opening. Where the copper lies deep, the capacitance of the gap is that of Carter
(J. Inst. Electr. Eng. 29 (1901) 925): the smooth one over his coefficient.

What the two-dimensional field leaves out adds to all of them: the end windings and the leads. Their share of
the capacitance from winding to rotor is not small in short machines (Stockbruegger and Ponick, Energies 14
(2021) 174, doi:10.3390/en14010174).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

# Modes of the slot, and waves of the gap for each of them and for each ratio of slot pitch to opening. The
# field at the edges of the teeth is singular: capacitances are exact to 1e-3.
_MODES, _WAVES = 40, 10


@dataclass(frozen=True)
class Machine:
    """Geometry of the active part of a machine.

    Attributes
    ----------
    length : float
        Length of the stack of laminations [m].
    bore : float
        Diameter of the bore of the stator [m].
    gap : float
        Air gap between the stator's teeth and the rotor [m].
    slots : int
        Number of slots of the stator.
    opening : float
        Width of a slot at the bore [m].
    depth : float
        Depth below the bore at which the copper begins [m].
    permittivity : float
        Relative permittivity of what fills the slot up to the copper.
    liner_width : float
        Length of the line along which copper and iron face each other in the section of a slot [m].
    liner : float
        Thickness of the insulation between them [m].
    liner_permittivity : float
        Its relative permittivity.
    """

    length: float
    bore: float
    gap: float
    slots: int
    opening: float
    depth: float
    permittivity: float
    liner_width: float
    liner: float
    liner_permittivity: float

    @property
    def pitch(self) -> float:
        """Distance between two slots along the bore [m]."""
        return math.pi * self.bore / self.slots


@dataclass(frozen=True)
class MachineCapacitances:
    """Capacitances of a machine [F].

    Attributes
    ----------
    winding_rotor : float
        From the winding to the rotor, through the openings of the slots.
    rotor_frame : float
        From the rotor to the frame, through the air gap.
    winding_frame : float
        From the winding to the frame, through the insulation of the slots.
    """

    winding_rotor: float
    rotor_frame: float
    winding_frame: float


def machine_capacitances(machine: Machine) -> MachineCapacitances:
    """Capacitances of a machine without its end windings.

    Parameters
    ----------
    machine : Machine
        Geometry.

    Returns
    -------
    MachineCapacitances
        Capacitances [F].

    Notes
    -----
    The cylinder of the gap has the capacitance ``2 pi epsilon_0 length / log(bore / (bore - 2 gap))``; its
    parts to winding and frame are those of the unrolled gap. The insulation of the slots is a plate, as in
    Muetze and Binder, IEEE Trans. Ind. Appl. 43 (2007) 665, doi:10.1109/TIA.2007.895734.

    Examples
    --------
    >>> machine = Machine(0.1, 0.1, 0.5e-3, 36, 2.5e-3, 1.5e-3, 1.0, 40e-3, 0.3e-3, 3.5)
    >>> found = machine_capacitances(machine)
    >>> [round(1e12 * value) for value in (found.winding_rotor, found.rotor_frame, found.winding_frame)]
    [14, 460, 14875]
    """
    smooth = 2.0 * math.pi * machine.length / math.log(machine.bore / (machine.bore - 2.0 * machine.gap))
    winding, rotor = gap_shares(
        machine.opening, machine.pitch, machine.gap, machine.depth, machine.permittivity
    )
    slots = machine.slots * machine.length * machine.liner_width / machine.liner
    return MachineCapacitances(
        epsilon_0 * smooth * winding,
        epsilon_0 * smooth * (rotor - winding),
        epsilon_0 * machine.liner_permittivity * slots,
    )


def gap_shares(
    opening: float, pitch: float, gap: float, depth: float, permittivity: float
) -> tuple[float, float]:
    """Capacitances of a slotted air gap, as parts of that of a smooth one.

    Parameters
    ----------
    opening, pitch : float
        Width of the slots and distance between them [m].
    gap : float
        Air gap [m].
    depth : float
        Depth of the copper below the teeth [m].
    permittivity : float
        Relative permittivity in the slot.

    Returns
    -------
    winding : float
        Capacitance between rotor and winding.
    rotor : float
        Capacitance between the rotor and all that it faces; one over Carter's coefficient for deep slots.

    Examples
    --------
    Slots that are half as wide as their pitch, over a narrow gap: hardly more than the teeth count.

    >>> winding, rotor = gap_shares(1.0, 2.0, 0.01, 5.0, 1.0)
    >>> round(winding, 4), round(rotor, 2)
    (0.0, 0.53)
    """
    modes = (2.0 * np.arange(_MODES) + 1.0) * (math.pi / opening)
    count = math.ceil(_WAVES * _MODES * pitch / opening)
    waves = np.arange(count + 1) * (2.0 * math.pi / pitch)
    common = _overlaps(waves, modes, opening)
    # Charge on the opening for each wave of its potential; the mean is a plate's.
    stiff = np.empty(count + 1)
    stiff[0], stiff[1:] = 1.0 / gap, 2.0 * waves[1:] / np.tanh(np.minimum(waves[1:] * gap, 300.0))
    below = (common.T * (stiff / pitch)) @ common
    deep = np.minimum(modes * depth, 300.0)
    above = np.diag(0.5 * opening * permittivity * modes / np.tanh(deep))
    copper = (4.0 / opening) * np.where(np.arange(_MODES) % 2, -1.0, 1.0) / np.sinh(deep)
    charges = np.stack([0.5 * opening * permittivity * copper, common[0] / gap], axis=1)
    by_copper, by_rotor = np.linalg.solve(below + above, charges).T
    return float(by_copper @ common[0]) / pitch, 1.0 - float(by_rotor @ common[0]) / pitch


def _overlaps(waves: np.ndarray, modes: np.ndarray, opening: float) -> np.ndarray:
    """Integrals of each wave times each mode over the opening, shape (waves, modes)."""
    half = 0.5 * opening
    plus, minus = waves[:, None] + modes, waves[:, None] - modes
    # sinc of numpy is that of pi x.
    found: np.ndarray = half * (np.sinc(plus * half / math.pi) + np.sinc(minus * half / math.pi))
    return found
