"""Captions of the figures of a report: what each figure shows, in a sentence."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ehlectric.figures.names import with_units_kept

# Captions of figures by the names of their files without the ending.
CAPTIONS: Mapping[str, str] = MappingProxyType(
    {
        # Line contacts
        "film": "Pressure and film thickness along the contact, from the inlet to the outlet.",
        "field_strength": "Map of the electric field strength in the film, between both surfaces.",
        "field_profiles": "Field strength along the film, on both walls and at mid-film.",
        # Point contacts
        "film_map": "Film thickness, with contours and the position of the minimum.",
        "pressure_map": "Pressure, and where the film cavitates.",
        "field_map": "Field strength at mid-film, the contour at 95 % of its maximum, and the position of "
        "the maximum.",
        "field_sections": "Sections of the film along and across entrainment through the maximum field, "
        "coloured by the field strength.",
        "cuts": "Pressure, film and field along and across entrainment, through the centre and through the "
        "minimum film.",
        # Contacts of both kinds
        "field_deviation": "Deviation of the field strength from voltage divided by film thickness, the "
        "usual estimate.",
        "roughness": "Roughness of the surfaces, and the change of the film that it causes.",
        "breakdown": "Voltage at which the film breaks down, over the position in the contact.",
        "meter": "Capacitance that a meter reads, collected up to a distance from the contact.",
        "temperature": "Temperature across the film, at its middle and on both surfaces, and shear stress at "
        "mid-film; of a point contact along y = 0.",
        "shear_stress": "Shear stress at mid-film, of a point contact along y = 0, and the pressure times "
        "the traction coefficient.",
        # Moving roughness
        "motion_history": "Minimum film, maximum field and its position, over time.",
        "motion_maps": "Film, pressure and field over position and time, with lines of the mean speed and of "
        "the speed of the rough surface.",
        "motion_beside_stationary": "Film, pressure and field of moving and of stationary roughness at the "
        "instant of the same position.",
        # Bearings
        "bearing_loads": "Load and minimum film of the contacts around the bearing.",
        "bearing_circuit": "Capacitance of each contact and, where one is computed, the bearing voltage at "
        "which the contact breaks down, over the elements.",
        "bearing_pitch": "Capacitance and, where they vary, breakdown voltages over one pitch of the cage.",
        "bearing_impedance": "Magnitude and, where it varies, phase of the impedance of the bearing over "
        "frequency.",
        "capacitance_over_speed": "Capacitance of the bearing over the speed of the shaft, with contacts "
        "that are not solved, scaled to the result.",
        "breakdown_over_speed": "First breakdown voltage and shaft voltage over the speed of the shaft, with "
        "contacts that are not solved, scaled to the result.",
        # Drives
        "drive_voltages": "Common-mode voltage and the voltages across the films over two periods of the "
        "carrier, with their discharges. A discharge of one bearing takes the voltage of both: they are "
        "parallel.",
        "drive_histogram": "Share of time at the voltages across the films, and share of time above a "
        "voltage of either sign; dots are the limits of the key numbers.",
        "drive_spectrum": "Amplitudes (peak values) of the shaft voltage over the frequency, without a "
        "window. Where lines are too close to be seen apart, the largest one is drawn.",
        "drive_discharges": "Distributions of voltage, charge, energy and peak current of the discharges of "
        "each bearing. Charge, energy and current follow from the given resistance of an arc.",
        "drive_remedies": "Discharges per second with bounds of 95 %, and mean energy of a discharge, of the "
        "drive as it is and of each remedy. An arrow is the upper bound where nothing discharged.",
        # Sweeps
        "sensitivity": "Share of the spread that each varied input contributes, with confidence intervals.",
    }
)

# Meaning of a mark of sweeps.
_RING = "A ring marks a point that is less accurate than others, as its warnings in sweep.csv say."

# Captions of maps and lines of a sweep, which are named by the value that they show.
_OF_SWEEPS = (
    (
        "map_",
        f"Map of the value over the varied inputs. Points without a usable film have marks. {_RING}",
    ),
    (
        "lines_",
        f"Lines of the value over the varied inputs; points without a usable film are left out. {_RING}",
    ),
)

# Sentence below each figure of a result that is not converged.
UNCONVERGED = "NOT CONVERGED: the figure shows no solution; do not use it."


def caption_of(name: str, *, converged: bool) -> str:
    """Caption of a figure; that of a result that is not converged says so.

    Parameters
    ----------
    name : str
        Name of the figure, without the ending of a file.
    converged : bool
        Whether the result is converged.

    Examples
    --------
    >>> caption_of("film_map", converged=True)
    'Film thickness, with contours and the position of the minimum.'
    """
    text = CAPTIONS.get(name, "")
    for start, caption in _OF_SWEEPS:
        if name.startswith(start):
            text = caption
    return " ".join(filter(None, ["" if converged else UNCONVERGED, with_units_kept(text)]))
