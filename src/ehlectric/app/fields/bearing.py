"""Fields of the page of a bearing."""

from __future__ import annotations

from ehlectric.app.fields.field import Field, Group, Way
from ehlectric.app.fields.kinds import ANGULAR, DEEP, ROLLERS, has_balls, has_clearance, kind_of
from ehlectric.app.fields.oil import OIL
from ehlectric.app.fields.supply import SUPPLY
from ehlectric.app.inputs import Inputs
from ehlectric.cases.bearings.ways import FILM_FACTORS

_ASSUMED = "The first values are assumptions: replace them with your own."


def _own(inputs: Inputs) -> bool:
    return inputs.value("bearing.base") is None


def _own_balls(inputs: Inputs) -> bool:
    return _own(inputs) and has_balls(inputs)


def _own_rollers(inputs: Inputs) -> bool:
    return _own(inputs) and kind_of(inputs) == ROLLERS


def _rollers(inputs: Inputs) -> bool:
    return kind_of(inputs) == ROLLERS


def _angular(inputs: Inputs) -> bool:
    return kind_of(inputs) == ANGULAR


def _ceramic(inputs: Inputs) -> bool:
    return bool(inputs.value("bearing.element_material") == "silicon-nitride")


def _no(_: Inputs) -> bool:
    return False


def _own_coating(inputs: Inputs) -> bool:
    return inputs.value("bearing.coating.base") is None


def _number(key: str, label: str, unit: str, ends: tuple[float, float], **more: object) -> Field:
    """Field of a number with the ends of its slider."""
    return Field(key, label, unit, *ends, **more)  # type: ignore[arg-type]


# Endings of a designation that change nothing here: seals, shields and classes of clearance, as makers write
# them. The clearance has fields of its own.
_ENDINGS = (
    r"([-\s/]*(2?rs[hlr]?[12]?|2?rz|2?z[rz]?|zz|2?ddu?|v{1,2}|ll[ubh]|2?ns[el]?|ee|uu|c[2-5]|cn|cm))+\s*$"
)

GEOMETRY = Group(
    "Bearing",
    (
        Field(
            "bearing.base",
            "Bearing",
            kind="choice",
            own="Own geometry",
            ignored=_ENDINGS,
            lacks="not in the catalogue ({count} bearings): choose your own geometry and type its dimensions",
        ),
        Field("bearing.kind", "Kind", kind="choice", choices=(DEEP, ANGULAR, ROLLERS), when=_own),
        Field("bearing.elements", "Rolling elements", low=5, high=45, kind="count", when=_own),
        _number("bearing.element_diameter", "Element diameter", "mm", (2.0, 60.0), log=True, when=_own),
        _number("bearing.pitch_diameter", "Pitch diameter", "mm", (10.0, 500.0), log=True, when=_own),
        _number(
            "bearing.inner_groove", "Inner groove radius / ball diameter", "", (0.51, 0.56), when=_own_balls
        ),
        _number(
            "bearing.outer_groove", "Outer groove radius / ball diameter", "", (0.51, 0.56), when=_own_balls
        ),
        _number(
            "bearing.shoulder_height", "Shoulder height / ball diameter", "", (0.05, 0.45), when=_own_balls
        ),
        _number("bearing.roller_length", "Roller length", "mm", (3.0, 100.0), log=True, when=_own_rollers),
        Field(
            "bearing.profile", "Roller profile", kind="choice", choices=("logarithmic", "none"), when=_rollers
        ),
        _number("bearing.contact_angle", "Free contact angle", "deg", (10.0, 45.0), when=_angular),
        _number("bearing.bore", "Bore", "mm", (5.0, 400.0), log=True, when=_own, optional=True),
        _number(
            "bearing.outer_diameter",
            "Outside diameter",
            "mm",
            (10.0, 600.0),
            log=True,
            when=_own,
            optional=True,
        ),
        _number("bearing.width", "Width", "mm", (3.0, 150.0), log=True, when=_own, optional=True),
        Field("bearing.element_material", "Element material", kind="choice"),
        _number(
            "bearing.element_capacitance",
            "Capacitance of an element",
            "pF",
            (0.05, 50.0),
            log=True,
            when=_ceramic,
            optional=True,
        ),
        Field("bearing.ring_material", "Ring material", kind="choice"),
    ),
)

# Clearance before mounting and fits of the example of the guide: a 6208 of class C3 in an aluminium housing.
_FITS = {
    "bearing.clearance_class": "C3",
    "bearing.fits.shaft_interference": "13.5 um",
    "bearing.fits.housing_interference": "-20 um",
    "bearing.fits.housing_material": "aluminium",
}


def _fits(inputs: Inputs) -> bool:
    return inputs.value("bearing.fits") is not None


CLEARANCE = Group(
    "Clearance",
    (
        Field(
            "bearing.clearance",
            "Clearance given as",
            kind="ways",
            ways=(
                Way("Class and fits", _FITS, "bearing.fits"),
                Way(
                    "Class before mounting",
                    {"bearing.clearance_class": "CN", "bearing.fits": None},
                    "bearing.clearance_class",
                ),
                Way("Clearance in operation", {"bearing.radial_clearance": "10 um"}),
            ),
            when=has_clearance,
        ),
        _number("bearing.radial_clearance", "Radial clearance", "um", (0.0, 60.0), when=_no),
        Field(
            "bearing.clearance_class",
            "Clearance class",
            kind="choice",
            choices=("C2", "CN", "C3", "C4", "C5"),
            when=_no,
        ),
        _number(
            "bearing.fits.unmounted_clearance", "Clearance before mounting", "um", (0.0, 100.0), when=_no
        ),
        _number(
            "bearing.fits.shaft_interference", "Interference on the shaft", "um", (-50.0, 50.0), when=_fits
        ),
        _number(
            "bearing.fits.housing_interference",
            "Interference in the housing",
            "um",
            (-50.0, 50.0),
            when=_fits,
        ),
        _number(
            "bearing.fits.shaft_bore", "Bore of the shaft", "mm", (0.0, 100.0), when=_fits, optional=True
        ),
        _number(
            "bearing.fits.housing_diameter",
            "Housing diameter",
            "mm",
            (50.0, 1000.0),
            log=True,
            when=_fits,
            optional=True,
        ),
        Field("bearing.fits.shaft_material", "Shaft material", kind="choice", when=_fits, optional=True),
        Field("bearing.fits.housing_material", "Housing material", kind="choice", when=_fits),
    ),
    opened=False,
)

_DEGREES = (20.0, 120.0)

OPERATION = Group(
    "Operation",
    (
        _number("bearing.inner_speed", "Speed of the inner ring", "rpm", (50.0, 20_000.0), log=True),
        _number("bearing.radial_load", "Radial load", "N", (0.0, 10_000.0)),
        _number("bearing.axial_load", "Axial load", "N", (0.0, 5_000.0), when=has_balls),
        _number("bearing.temperature", "Temperature of the oil", "degC", _DEGREES),
        _number(
            "bearing.inner_ring_temperature",
            "Inner ring temperature",
            "degC",
            _DEGREES,
            optional=True,
            note="as the oil",
        ),
        _number(
            "bearing.outer_ring_temperature",
            "Outer ring temperature",
            "degC",
            _DEGREES,
            optional=True,
            note="as the oil",
        ),
    ),
)


def _factor(inputs: Inputs) -> bool:
    return inputs.value("bearing.film_factor") not in (None, *FILM_FACTORS)


def _part(inputs: Inputs) -> bool:
    return inputs.value("bearing.fill") not in (None, "oil", "air")


FILM = Group(
    "Films",
    (
        _number("bearing.composite_rq", "Composite roughness Rq", "um", (0.005, 1.0), log=True),
        Field(
            "bearing.film_way",
            "Heat and starvation",
            kind="ways",
            ways=(
                Way(
                    "Isothermal, fully flooded",
                    {"bearing.film_factor": "none"},
                    "bearing.film_factor",
                    "none",
                ),
                Way(
                    "Heat by shear in the inlet",
                    {"bearing.film_factor": "inlet-shear"},
                    "bearing.film_factor",
                    "inlet-shear",
                ),
                Way(
                    "Heat in the film, solved with the contacts",
                    {"bearing.film_factor": "solved"},
                    "bearing.film_factor",
                    "solved",
                ),
                Way("A factor of your own", {"bearing.film_factor": 0.7}, "bearing.film_factor"),
                Way("Isothermal, fully flooded", listed=False),
            ),
        ),
        Field("bearing.film_factor", "Film factor", low=0.1, high=1.0, when=_factor, strict=True),
        *SUPPLY,
        Field(
            "bearing.fill_way",
            "Around the films",
            kind="ways",
            ways=(
                Way("Oil", {"bearing.fill": "oil"}, "bearing.fill", "oil"),
                Way("Air", {"bearing.fill": "air"}, "bearing.fill", "air"),
                Way("Partly oil", {"bearing.fill": "30 %"}, "bearing.fill"),
                Way("Oil", listed=False),
            ),
        ),
        Field("bearing.fill", "Part filled with oil", "%", 0.0, 100.0, when=_part, strict=True),
        _number(
            "bearing.contact_resistance",
            "Resistance of a closed contact",
            "ohm",
            (0.01, 100.0),
            log=True,
            optional=True,
        ),
    ),
)

SUMMITS = Group(
    "Summits of the roughness",
    (
        _number("bearing.summits.density", "Summits per area", "1/mm^2", (100.0, 1e6), log=True),
        _number("bearing.summits.radius", "Radius of the summits", "um", (0.5, 500.0), log=True),
        _number(
            "bearing.summits.height_deviation",
            "Deviation of their heights",
            "um",
            (0.005, 1.0),
            log=True,
            optional=True,
        ),
        _number("bearing.summits.bandwidth", "Or their bandwidth", "", (1.5, 100.0), log=True, optional=True),
        _number("bearing.summits.highest", "Worn to this height", "", (1.0, 6.0), optional=True),
    ),
    table="bearing.summits",
    start={"density": "2000 1/mm^2", "radius": "50 um"},
    note=f"{_ASSUMED} ehlectric surface prints those of a measured surface.",
)

COATING = Group(
    "Insulating coating",
    (
        Field("bearing.coating.base", "Coating", kind="choice", own="Own coating"),
        Field(
            "bearing.coating.ring",
            "Coated ring",
            kind="choice",
            choices=("inner", "outer"),
            when=_own_coating,
        ),
        _number("bearing.coating.thickness", "Thickness", "um", (10.0, 1000.0), log=True),
        _number("bearing.coating.relative_permittivity", "Relative permittivity", "", (1.0, 20.0)),
        _number(
            "bearing.coating.breakdown_voltage",
            "Breakdown voltage",
            "V",
            (100.0, 10_000.0),
            log=True,
            optional=True,
        ),
        _number(
            "bearing.coating.strength",
            "Or its dielectric strength",
            "V/um",
            (1.0, 50.0),
            log=True,
            optional=True,
        ),
        _number(
            "bearing.coating.resistance",
            "Insulation resistance",
            "Mohm",
            (1.0, 10_000.0),
            log=True,
            optional=True,
        ),
        _number("bearing.coating.area", "Area", "cm^2", (1.0, 1000.0), log=True, optional=True),
    ),
    table="bearing.coating",
    start={"base": "schaeffler-j20aa", "relative_permittivity": 9.0},
    note=f"{_ASSUMED} No maker states a permittivity.",
)

MOTOR = Group(
    "Motor",
    (
        _number("motor.common_mode_voltage", "Common-mode voltage, peak", "V", (1.0, 1000.0)),
        _number("motor.winding_rotor_capacitance", "Winding-rotor capacitance", "pF", (1.0, 500.0), log=True),
        _number("motor.rotor_frame_capacitance", "Rotor-frame capacitance", "nF", (0.05, 20.0), log=True),
        _number(
            "motor.second_bearing_capacitance",
            "Second bearing capacitance",
            "pF",
            (10.0, 5000.0),
            log=True,
            optional=True,
        ),
        _number(
            "motor.switching_frequency", "Switching frequency", "kHz", (0.5, 100.0), log=True, optional=True
        ),
        _number("motor.rise_time", "Rise time", "us", (0.01, 5.0), log=True, optional=True),
    ),
    table="motor",
    start={
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    },
    note=f"{_ASSUMED} Without a motor no shaft voltage is computed.",
)

BREAKDOWN = Group(
    "Breakdown",
    (
        _number("discharge.dielectric_strength", "Dielectric strength", "V/um", (1.0, 100.0), log=True),
        _number(
            "discharge.conductivity", "Conductivity of the oil", "pS/m", (0.01, 1e6), log=True, optional=True
        ),
        _number("discharge.peak_current", "Peak current", "A", (0.01, 20.0), log=True, optional=True),
    ),
    table="discharge",
    start={"dielectric_strength": "15 V/um"},
    note=f"{_ASSUMED} 15 V/µm is a rule of thumb for the films of bearings.",
)

REPORT = Group("Title", (Field("title", "Title of the case", kind="text"),), opened=False)

BEARING_GROUPS = (GEOMETRY, OPERATION, OIL, FILM, CLEARANCE, MOTOR, BREAKDOWN, COATING, SUMMITS, REPORT)
