"""Limits of the simulation of a drive, in plain words, and the literature behind it."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.drives.case import DriveCase
from ehlectric.report.limits import Limit, Reference, limits_of, references_of

# Limits of bearings that the limits of drives say otherwise.
_REPLACED = ("contacts of asperities", "circuit", "oil as insulator")


def _scatters(case: DriveCase) -> bool:
    """Whether the thresholds of a bearing scatter."""
    given = case.breakdown.weibull_shape is not None
    return given or any(one.discharge is not None and one.discharge.weibull for one in case.bearings)


# Limits of drives, in the order of a report.
DRIVE_LIMITS = (
    Limit(
        "arc",
        "There is no model of the arc or its plasma: a film that breaks down conducts with the given "
        "resistance until the given current or voltage of extinction, and insulates again after the given "
        "time. Charges, energies and currents follow from these inputs. Real arcs have a voltage of their "
        "own and a resistance that changes.",
    ),
    Limit(
        "threshold",
        "The voltages at which films break down are drawn from Weibull's law, independent of each other, "
        "anew after each discharge and at random times. Space charge, debris, and oil that discharges have "
        "changed are left out.",
        _scatters,
    ),
    Limit(
        "threshold",
        "The films break down at the same voltage each time; those of oils scatter.",
        lambda case: not _scatters(case),
    ),
    Limit(
        "damage",
        "How much currents damage raceways and oil is not computed. Published limits of the current density "
        "are those of bearing trials, for the largest current over the Hertz areas of all elements.",
    ),
    Limit(
        "circuit of the machine",
        "The machine is one circuit of lumped capacitances, inductances and resistances. Waves on cable and "
        "winding, the distribution of the voltage along the winding, the impedance of the shaft, and "
        "currents that circulate through both bearings are left out.",
    ),
    Limit(
        "driven machine",
        "Bearings, gears and seals of the driven machine are not in the circuit. A coupling that conducts "
        "brings the voltage of the shaft to them.",
    ),
    Limit(
        "capacitances of the machine",
        "Capacitances from the geometry of the machine are those of a smooth rotor and parallel slots. End "
        "windings and leads are left out; they make the capacitances larger.",
        lambda case: bool(case.circuit.estimated),
    ),
    Limit(
        "source",
        "Dead times of the inverter, and the voltage of the middle of the DC link against earth, are left "
        "out.",
        lambda case: not case.source.measured,
    ),
    Limit(
        "speed of the source",
        "The frequency of the source follows the speed as that of a synchronous machine: the slip of an "
        "induction machine is left out.",
        lambda case: case.source.pole_pairs is not None,
    ),
    Limit(
        "source",
        "The measured voltage is imposed, whatever the circuit draws, and repeated where the simulated time "
        "is longer than the record.",
        lambda case: case.source.measured,
    ),
    Limit(
        "operation",
        "Speed, load and temperature are constant, and the films are those of stationary operation. "
        "Starting, stopping and vibration are left out, and so is the heat of the discharges.",
    ),
    Limit(
        "contacts of asperities",
        "Where asperities touch, they close the film for random times of the given mean. The voltage at "
        "which a contact discharges as it opens is left out.",
        lambda case: any(one.bearing.composite_rq is not None for one in case.bearings),
    ),
    Limit(
        "time",
        "Bounds of 95 % count the scatter within the simulated time alone. Errors of inputs and models are "
        "not in them.",
    ),
)


def drive_limits(case: DriveCase) -> Iterator[Limit]:
    """Limits that hold for a drive: those of its simulation, and those of its bearings, each once."""
    yield from (limit for limit in DRIVE_LIMITS if limit.holds(case))
    bearings = (limit for one in case.bearings for limit in limits_of(one))
    yield from dict.fromkeys(limit for limit in bearings if limit.topic not in _REPLACED)


# Publications behind the simulation of a drive, in the order of a report.
DRIVE_REFERENCES = (
    Reference(
        "space-vector modulation",
        "Holtz, Proc. IEEE 82 (1994) 1194",
        "10.1109/5.301684",
        lambda case: case.source.modulation == "space-vector",
    ),
    Reference(
        "Weibull law of the thresholds",
        "Weibull, J. Appl. Mech. 18 (1951) 293",
        "10.1115/1.4010337",
        _scatters,
    ),
    Reference("bounds of the rates", "Garwood, Biometrika 28 (1936) 437", "10.1093/biomet/28.3-4.437"),
    Reference(
        "coefficient of slots",
        "Carter, J. Inst. Electr. Eng. 29 (1901) 925",
        "",
        lambda case: bool(case.circuit.estimated),
    ),
    Reference(
        "end windings in capacitances of machines",
        "Stockbruegger and Ponick, Energies 14 (2021) 174",
        "10.3390/en14010174",
        lambda case: bool(case.circuit.estimated),
    ),
)


def drive_references(case: DriveCase) -> Iterator[Reference]:
    """Publications behind the simulation of a drive and behind its bearings, each once."""
    found = [one for one in DRIVE_REFERENCES if one.used(case)]
    known = {one.doi for one in found if one.doi}
    yield from found
    bearings = dict.fromkeys(one for bearing in case.bearings for one in references_of(bearing))
    yield from (one for one in bearings if one.doi not in known)
