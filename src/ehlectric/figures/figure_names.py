"""File names of the figures for every kind of result.

The functions that draw them stand in tables by these names; this module is imported without matplotlib.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence

from ehlectric.errors import InputError, printable, shown

# Space between a number and its unit, at which a title is not broken into lines.
_OF_UNIT = re.compile(
    r"(?<=\d) (?=(?:%|‰|°C|rpm|[fpnµumkMG]?(?:Pa|Hz|V|m|N|F|A|W|s|S|K|Ω)(?:[/²³]\S*)?)(?:[\s,;:.()]|$))"
)

# Formats of the files, and styles of the figures.
FORMATS = ("png", "svg", "pdf")
STYLES = ("screen", "journal", "dark")

# Figures of contacts. The roughness is drawn of rough contacts only, the breakdown of contacts with a
# dielectric strength only, the capacitance at a meter of cases with a table meter only, the spots of contacts
# whose surfaces touch only, and temperature or shear stress of cases with a table film only.
FIGURE_FILES = (
    "film.png",
    "field_strength.png",
    "field_profiles.png",
    "field_deviation.png",
)
POINT_FIGURE_FILES = (
    "film_map.png",
    "pressure_map.png",
    "field_map.png",
    "field_deviation.png",
    "field_sections.png",
    "cuts.png",
)
ROUGHNESS_FIGURE, BREAKDOWN_FIGURE, METER_FIGURE = "roughness.png", "breakdown.png", "meter.png"
SPOTS_FIGURE, TEMPERATURE_FIGURE, SHEAR_FIGURE = "spots.png", "temperature.png", "shear_stress.png"

# Figures of stationary contacts, line or point. Earlier versions also drew the potential of line contacts.
ALL_FIGURES = tuple(
    dict.fromkeys(
        (
            *FIGURE_FILES,
            *POINT_FIGURE_FILES,
            *(ROUGHNESS_FIGURE, BREAKDOWN_FIGURE, METER_FIGURE, SPOTS_FIGURE),
            *(TEMPERATURE_FIGURE, SHEAR_FIGURE),
            "potential.png",
        )
    )
)

# Figures of transient contacts: over time, over position and time, and compared with stationary roughness.
MOTION_FIGURE_FILES = ("motion_history.png", "motion_maps.png", "motion_beside_stationary.png")

# Figures of bearings: loads and films, circuit, course over a pitch of the cage, impedance over frequency,
# margin over the speed within the uncertain inputs, and a duty cycle over time, of a bearing that has one.
DUTY_FIGURE = "bearing_duty.png"
BEARING_FIGURE_FILES = (
    "bearing_loads.png",
    "bearing_circuit.png",
    "bearing_pitch.png",
    "bearing_impedance.png",
    "bearing_margin.png",
    DUTY_FIGURE,
)

# Figures of bearings over the speed of the shaft.
SPEED_FIGURE_FILES = ("capacitance_over_speed.png", "breakdown_over_speed.png")

DRIVE_DUTY_FIGURE, DRIVE_FORCES_FIGURE = "drive_duty.png", "drive_forces.png"

# Figures of drives: voltages over a short time, how long which voltages last, the spectrum of the shaft
# voltage, discharges, remedies, a duty cycle, and forces on the rotor.
DRIVE_FIGURE_FILES = (
    "drive_voltages.png",
    "drive_histogram.png",
    "drive_spectrum.png",
    "drive_discharges.png",
    "drive_remedies.png",
    DRIVE_DUTY_FIGURE,
    DRIVE_FORCES_FIGURE,
)

# Figures of gear pairs: radii, speeds, loads and pressures along the path of contact, the film along it, map
# of the film on the flank, capacitance and breakdown voltage over a phase of the mesh, and a duty cycle.
GEAR_FLANK_FIGURE = "gear_flank.png"
GEAR_DUTY_FIGURE = "gear_duty.png"
GEAR_FIGURE_FILES = (
    "gear_path.png",
    "gear_film.png",
    GEAR_FLANK_FIGURE,
    "gear_mesh.png",
    GEAR_DUTY_FIGURE,
)

# Figures of an axle: voltage of each element over its breakdown voltage, network, and forces on the shafts.
AXLE_FIGURE, NETWORK_FIGURE, FORCES_FIGURE = "axle_elements.png", "axle_network.png", "axle_forces.png"
AXLE_DUTY_FIGURE, AXLE_REMEDIES_FIGURE = "axle_duty.png", "axle_remedies.png"
AXLE_DISCHARGES_FIGURE = "axle_discharges.png"
AXLE_FIGURE_FILES = (
    AXLE_FIGURE,
    NETWORK_FIGURE,
    FORCES_FIGURE,
    AXLE_DUTY_FIGURE,
    AXLE_REMEDIES_FIGURE,
    AXLE_DISCHARGES_FIGURE,
)

# Figures of an oil.
OIL_FIGURE_FILES = ("oil_over_pressure.png", "oil_over_temperature.png")

# Figure of a measurement compared with computed values.
MEASURED_FIGURE = "measured_and_computed.png"
CALIBRATION_FIGURE = "calibration.png"

# Figure of the sensitivity of a sweep; maps and lines of a sweep are named by the value that they show.
SENSITIVITY_FIGURE = "sensitivity.png"


def map_files(value: str, at: Mapping[str, str] | None = None) -> tuple[str, str]:
    """Return the file names of a value's map and lines in a sweep.

    Examples
    --------
    >>> map_files("discharge.breakdown_voltage")
    ('map_discharge.breakdown_voltage.png', 'lines_discharge.breakdown_voltage.png')
    >>> map_files("bearing.margin", {"bearing.temperature": "70 degC"})[0]
    'map_bearing.margin_at_bearing.temperature=70degC.png'
    """
    return of_cut(f"map_{value}.png", at), of_cut(f"lines_{value}.png", at)


def of_cut(file: str, at: Mapping[str, str] | None = None) -> str:
    """Name of a file of a figure of a cut through a sweep.

    Examples
    --------
    >>> of_cut("breakdown_over_speed.png", {"bearing.temperature": "70 degC"})
    'breakdown_over_speed_at_bearing.temperature=70degC.png'
    """
    if not at:
        return file
    cut = ",".join(f"{key}={_of_file_name(text)}" for key, text in sorted(at.items()))
    return f"{_stem(file)}_at_{cut}.png"


def with_units_kept(text: str) -> str:
    r"""Text with no-break spaces between numbers and their units.

    Examples
    --------
    >>> with_units_kept("below 2.28 to 3.25 m/s (8 V)") == "below 2.28 to 3.25\xa0m/s (8\xa0V)"
    True
    """
    return _OF_UNIT.sub("\xa0", text)


def literal(text: str) -> str:
    r"""Text of a user for a label of a figure, which matplotlib takes for no formula.

    Examples
    --------
    >>> print(literal("$film$.csv"))
    \$film\$.csv
    """
    return printable(text).replace("$", r"\$")


def broken(name: str, letters: int, lines: int | None = None) -> str:
    r"""Name on lines of at most so many letters, shortened to a number of ``lines``.

    Examples
    --------
    >>> broken("winding-rotor capacitance", 14), broken("winding-rotor capacitance", 18, 1)
    ('winding-rotor\ncapacitance', 'winding-rotor ...')
    """
    return "\n".join(textwrap.wrap(literal(name), letters, max_lines=lines, placeholder=" ..."))


def _of_file_name(text: str) -> str:
    """Text without spaces and without characters that a file name cannot have everywhere."""
    return re.sub(r"[^\w.+-]+", "-", "".join(text.split()), flags=re.ASCII)


def in_formats(files: Iterable[str], formats: Sequence[str] = ("png",)) -> tuple[str, ...]:
    """Names of the files of figures in some formats. Raises InputError where there is no format of this name.

    Examples
    --------
    >>> in_formats(["film.png", "cuts"], ["png", "svg"])
    ('film.png', 'film.svg', 'cuts.png', 'cuts.svg')
    """
    for name in formats:
        if name not in FORMATS:
            raise InputError("format", got=shown(name), takes=f"one of {', '.join(FORMATS)}")
    return tuple(f"{_stem(file)}.{name}" for file in files for name in dict.fromkeys(formats))


def _stem(file: str) -> str:
    """Name of a file without the ending of a format; the key of a sweep in it may have points."""
    stem, point, ending = file.rpartition(".")
    return stem if point and ending in FORMATS else file
