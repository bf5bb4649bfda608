"""Help of the fields of the app: its directions are solved, its ranges compared."""

import copy
import dataclasses
import tomllib

import pytest

from ehlectric import BearingCase, Case, DriveCase, GearCase, solve, solve_gear
from ehlectric.app import catalogue
from ehlectric.app.form_fields import BEARING_GROUPS, GEAR_GROUPS
from ehlectric.app.form_fields.axle_fields import AXLE_TEMPLATES
from ehlectric.app.form_fields.contact_fields import groups_of
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS
from ehlectric.app.form_fields.field_defaults import end_and_key
from ehlectric.app.form_fields.gear_fields import with_lists
from ehlectric.app.page_inputs import Inputs
from ehlectric.bearing.summary import summary_of
from ehlectric.quantities.field_help import effect, help_at, help_text
from ehlectric.quantities.inputs import attributes, key_of_list
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import in_unit
from tests.helpers.places import EXAMPLES

GROUPS = (BEARING_GROUPS, DRIVE_GROUPS, groups_of("line"), groups_of("point"), GEAR_GROUPS, AXLE_TEMPLATES)
FIELDS = {
    end_and_key(field.key)[1]: field
    for groups in GROUPS
    for group in groups
    for field in group.fields
    if field.kind != "alternatives"
}
NUMBERS = {key: field for key, field in FIELDS.items() if field.kind in ("number", "count")}
CLAIMS = {key: help_at(key) for key in NUMBERS if help_at(key).rises or help_at(key).falls}


def example(name, **changes):
    """Example file as a table, with changes by dotted key; None removes a key."""
    table = tomllib.loads((EXAMPLES / f"{name}.toml").read_text("utf-8"))
    return changed(table, {key.replace("__", "."): value for key, value in changes.items()})


def changed(table, changes):
    table = copy.deepcopy(table)
    for key, value in changes.items():
        *names, last = key.split(".")
        inner = table
        for name in names:
            inner = inner.setdefault(name, {})
        if value is None:
            inner.pop(last, None)
        else:
            inner[last] = value
    return table


BEARING = example("bearing_6208", contacts="atlas")
OWN = changed(
    BEARING,
    {
        "bearing.base": None,
        "bearing.kind": "deep-groove ball",
        "bearing.elements": 9,
        "bearing.element_diameter": "11.906 mm",
        "bearing.pitch_diameter": "60 mm",
        "bearing.inner_groove": 0.52,
        "bearing.outer_groove": 0.53,
        "bearing.shoulder_height": 0.19,
    },
)
# Rough films in which asperities touch for a part of the time.
ROUGH = changed(
    BEARING,
    {
        "bearing.composite_rq": "0.07 um",
        "bearing.summits": {"density": "2000 1/mm^2", "radius": "50 um"},
        "bearing.contact_resistance": "1 ohm",
    },
)
FITS = changed(
    BEARING,
    {
        "bearing.radial_clearance": None,
        "bearing.clearance_class": "C3",
        "bearing.fits": {"shaft_interference": "13.5 um", "housing_interference": "10 um"},
        "bearing.fits.housing_material": "steel",
        "bearing.fits.housing_diameter": "100 mm",
    },
)
COATING = {"ring": "outer", "relative_permittivity": 9.0, "thickness": "200 um"}
# 50 ms in which not every edge of the source has a discharge.
DRIVE = example("drive", remedies=None, drive__duration="0.05 s", source__dc_link="150 V")
MACHINE = {
    "stack_length": "120 mm",
    "bore_diameter": "110 mm",
    "air_gap": "0.5 mm",
    "slots": 36,
    "slot_opening": "3 mm",
    "copper_depth": "2 mm",
    "slot_permittivity": 2,
    "liner_width": "50 mm",
    "liner_thickness": "0.3 mm",
    "liner_permittivity": 3.5,
}
RINGING = {"source.overshoot": "20 %", "source.ringing_frequency": "2 MHz", "source.ringing_time": "1 us"}
GEAR = example("gear_pair", gear__composite_rq="0.08 um", gear__flank_ra=None)
RA = example("gear_pair", gear__rq_over_ra=1.25)
LINE = example("discharge", grid={"nodes": 801})
HOT = example("hot_contact", grid={"nodes": 401, "inlet": -5.0})
POINT = example("ball_contact", grid={"nodes": 65}, electric={"potential_1": "0 V", "potential_2": "2 V"})
POINT["discharge"] = {"dielectric_strength": "15 V/um"}
# A slow line contact whose asperities touch.
TOUCHING = changed(
    LINE,
    {
        "contact.entrainment_speed": "0.5 mm/s",
        "contact.slide_to_roll_ratio": 0.1,
        "contact.boundary_friction": 0.12,
        "electric.resistivity": "2.2e-7 ohm m",
        "electric.potential_2": "0.5 V",
        "roughness": [
            {"surface": 1, "generator": "gaussian", "rq": "0.4 um", "correlation_length": "40 um", "seed": 1}
        ],
    },
)
SHEET = {
    "contact.temperature": "70 degC",
    "lubricant.temperature": {
        "kinematic_viscosity_40": "46 mm^2/s",
        "kinematic_viscosity_100": "6.8 mm^2/s",
        "density_15": "870 kg/m^3",
        "thermal_conductivity": "0.137 W/m/K",
    },
}
BODIES = {
    "contact.reduced_modulus": None,
    "contact.body_1": {"youngs_modulus": "206 GPa", "poissons_ratio": 0.3},
    "contact.body_2": {"youngs_modulus": "206 GPa", "poissons_ratio": 0.3},
}
CARREAU = {
    "film.rheology": "carreau",
    "lubricant.carreau_stress": "0.1 MPa",
    "lubricant.carreau_exponent": 0.6,
}

# Inputs in which a number matters, by its key or the beginning of it; the longest that fits holds.
SHEET = "lubricant.temperature"
KINEMATIC_1 = changed(
    BEARING,
    {
        f"{SHEET}.kinematic_viscosity_40": None,
        f"{SHEET}.kinematic_viscosity_1": "46 mm^2/s",
        f"{SHEET}.temperature_1": "40 degC",
    },
)
KINEMATIC_2 = changed(
    BEARING,
    {
        f"{SHEET}.kinematic_viscosity_100": None,
        f"{SHEET}.kinematic_viscosity_2": "11.5 mm^2/s",
        f"{SHEET}.temperature_2": "80 degC",
    },
)
MEAN_HEIGHT = changed(BEARING, {"bearing.composite_rq": None, "bearing.composite_ra": "0.024 um"})
INPUTS = {
    "bearing": BEARING,
    **{f"bearing.{name}": OWN for name in ("elements", "element_diameter", "pitch_diameter")},
    **{f"bearing.{name}": OWN for name in ("inner_groove", "shoulder_height")},
    "bearing.roller_length": changed(
        BEARING,
        {
            "bearing": {"kind": "cylindrical roller", "elements": 14, "element_diameter": "11 mm"},
            "bearing.pitch_diameter": "60 mm",
            "bearing.profile": "logarithmic",
            "bearing.radial_load": "1800 N",
            **{f"bearing.{key}": BEARING["bearing"][key] for key in ("inner_speed", "temperature")},
            **{f"bearing.{key}": BEARING["bearing"][key] for key in ("radial_clearance", "composite_rq")},
        },
    ),
    "bearing.contact_angle": changed(
        BEARING,
        {"bearing.base": "7208-b", "bearing.radial_clearance": None, "bearing.axial_load": "1000 N"},
    ),
    "bearing.element_capacitance": changed(BEARING, {"bearing.element_material": "silicon-nitride"}),
    "bearing.fits": FITS,
    "bearing.fits.unmounted_clearance": changed(FITS, {"bearing.clearance_class": None}),
    "bearing.coating": changed(BEARING, {"bearing.coating": COATING}),
    "bearing.summits": ROUGH,
    "lubricant": LINE,
    "lubricant.temperature": BEARING,
    "lubricant.temperature.viscosity_index": changed(
        BEARING, {"lubricant.temperature.kinematic_viscosity_100": None}
    ),
    **{f"lubricant.temperature.{name}_1": KINEMATIC_1 for name in ("kinematic_viscosity", "temperature")},
    "lubricant.temperature.dynamic_viscosity_1": changed(
        KINEMATIC_1, {f"{SHEET}.kinematic_viscosity_1": None}
    ),
    **{f"lubricant.temperature.{name}_2": KINEMATIC_2 for name in ("kinematic_viscosity", "temperature")},
    "lubricant.temperature.dynamic_viscosity_2": changed(
        KINEMATIC_2, {f"{SHEET}.kinematic_viscosity_2": None}
    ),
    "bearing.composite_ra": MEAN_HEIGHT,
    "bearing.rq_over_ra": MEAN_HEIGHT,
    "lubricant.roelands_z": BEARING,
    **{f"lubricant.{name}": HOT for name in ("eyring_stress", "thermal_conductivity", "heat_capacity")},
    "lubricant.carreau": changed(HOT, CARREAU),
    "lubricant.limiting_coefficient": changed(HOT, {"film.rheology": "limiting"}),
    "motor": BEARING,
    "discharge": BEARING,
    "discharge.length": LINE,
    **dict.fromkeys(("drive", "source", "circuit", "breakdown"), DRIVE),
    **{key: changed(DRIVE, RINGING) for key in ("source.overshoot",)},
    "circuit.machine": changed(DRIVE, {"circuit": {"machine": MACHINE}}),
    "breakdown.extinction_current": changed(DRIVE, {"breakdown.recovery_time": "0 ns"}),
    "breakdown.extinction_voltage": changed(
        DRIVE, {"breakdown.extinction_current": None, "breakdown.recovery_time": "0 ns"}
    ),
    "gear": GEAR,
    **dict.fromkeys(("gear.flank_ra", "gear.rq_over_ra"), RA),
    "contact": LINE,
    "inlet": LINE,
    "grid": LINE,
    "grid.error": changed(LINE, {"grid.nodes": None}),
    "electric": TOUCHING,
    "contact.boundary": TOUCHING,
    "contact.body": HOT,
    "contact.slide_to_roll_ratio": HOT,
    "contact.temperature": HOT,
    **{f"contact.body_{k}.{name}": changed(LINE, BODIES) for k in (1, 2) for name in ("young", "poisson")},
    **{
        f"contact.radius_{k}": changed(
            LINE, {"contact.reduced_radius": None, "contact.radius_1": "30 mm", "contact.radius_2": "30 mm"}
        )
        for k in (1, 2)
    },
    **{
        f"contact.speed_{k}": changed(
            LINE,
            {
                "contact.entrainment_speed": None,
                "contact.slide_to_roll_ratio": None,
                "contact.speed_1": "4 m/s",
                "contact.speed_2": "4 m/s",
            },
        )
        for k in (1, 2)
    },
    "contact.max_hertz_pressure": changed(LINE, {"contact.load_per_length": None}),
    **{f"contact.{name}": POINT for name in ("radius_x", "radius_y")},
}
INPUTS["contact.load"] = POINT
INPUTS["contact.load_per_length"] = LINE

# Two values [unit of the field] where those at 0.4 and 0.6 of the slider do not suit the inputs.
VALUES = {
    "bearing.elements": (8, 9),
    "bearing.element_diameter": (10, 11.9),
    "bearing.pitch_diameter": (60, 66),
    "bearing.composite_rq": (0.03, 0.06),
    "bearing.composite_ra": (0.024, 0.048),
    "bearing.rq_over_ra": (1.1, 1.4),
    f"{SHEET}.kinematic_viscosity_1": (40, 50),
    f"{SHEET}.dynamic_viscosity_1": (35, 45),
    f"{SHEET}.temperature_1": (40, 50),
    f"{SHEET}.kinematic_viscosity_2": (10, 13),
    f"{SHEET}.dynamic_viscosity_2": (8, 11),
    f"{SHEET}.temperature_2": (80, 90),
    "bearing.summit_height": (1, 2),
    "bearing.radial_load": (1500, 2500),
    "bearing.axial_load": (300, 600),
    "bearing.inner_speed": (2000, 3000),
    "bearing.fits.unmounted_clearance": (30, 40),
    "bearing.fits.shaft_interference": (5, 15),
    "bearing.fits.housing_interference": (8, 15),
    "bearing.fits.shaft_bore": (5, 20),
    "bearing.fits.housing_diameter": (90, 120),
    "bearing.summits.height_deviation": (0.03, 0.04),
    "lubricant.pressure_viscosity_coefficient": (15, 20),
    "lubricant.viscosity": (0.04, 0.08),
    "lubricant.roelands_z": (0.6, 0.7),
    "drive.speed": (3000, 6000),
    "drive.temperature": (60, 80),
    "contact.slide_to_roll_ratio": (0.1, 0.5),
    "contact.temperature": (50, 70),
    "contact.temperature_1": (50, 70),
    "contact.temperature_2": (50, 70),
    "contact.load_per_length": (0.8, 1.5),
    "inlet.oil_layer": (0.2, 0.4),
    **{f"gear.flank_ra.{gear}": (0.04, 0.06) for gear in (1, 2)},
    "gear.composite_rq": (0.07, 0.09),
    "gear.rq_over_ra": (1.1, 1.4),
    "gear.summit_height": (1, 2),
    "gear.operation.pinion_torque": (20, 40),
    "gear.operation.pinion_speed": (12000, 16000),
    "gear.operation.bulk_temperature": (60, 70),
}


def inputs_of(key):
    return INPUTS[max((one for one in INPUTS if key.startswith(one)), key=len)]


def flat(table, before=""):
    for name, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", value


def results(key, value):
    """Results of the inputs of a key with a value [unit of the field], by dotted key of the summary."""
    field = NUMBERS[key]
    written = field.from_text(f"{value!r} {field.unit}".strip())
    if "gear" in inputs_of(key):
        case = with_lists(Inputs(inputs_of(key)), {key: written})
        return dict(
            flat(solve_gear(GearCase.from_dict(changed(inputs_of(key), case)), probable=False).summary())
        )
    table = changed(inputs_of(key), {key: written})
    kind = DriveCase if "drive" in table else BearingCase if "bearing" in table else Case
    result = solve(kind.from_dict(table))
    # Without the curves over the speed and the probability of breakdown of a bearing.
    found = dict(flat(summary_of(result.solution) if kind is BearingCase else result.summary()))
    if kind is DriveCase:
        found["drive_end.voltage_at_peak"] = found["drive_end.voltage_ratio"] * found["source.peak"]
        if found["drive.events"]:
            found["drive_end.scatter"] = found["drive_end.voltage_high"] / found["drive_end.voltage_mean"]
    return found


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("key", CLAIMS)
def test_results_rise_and_fall_as_the_help_says(key):
    field, claims = NUMBERS[key], CLAIMS[key]
    low, high = (results(key, value) for value in VALUES.get(key, (field.at(0.4), field.at(0.6))))
    for name in (*claims.rises, *claims.falls):
        known = [one for one in effect(name)["keys"] if low.get(one) is not None]
        assert known, f"{key}: no result tells of {name}"
        for one in known:
            grown = high[one] - low[one]
            assert grown != 0.0, f"{one} does not depend on {key}"
            assert (grown > 0.0) == (name in claims.rises), f"{one}: {low[one]} to {high[one]} over {key}"


def test_every_field_has_help():
    for key, field in FIELDS.items():
        text = help_text(key)
        assert text.endswith("."), key
        assert len(text) < 620, (key, len(text))
        if field.kind in ("number", "count") and help_at(key).usual != "":
            assert ("Usual: " in text) != ("No source" in text), key


def test_help_is_of_known_inputs_and_effects():
    data = data_file("ehlectric.quantities", "field_help.toml")
    assert attributes("help").keys() <= {key_of_list(key) for key in FIELDS}
    used = {name for claims in CLAIMS.values() for name in (*claims.rises, *claims.falls)}
    assert used == set(data["effects"])
    sources = {help_at(key).source for key in FIELDS}
    assert set(data["sources"]) <= sources


@pytest.mark.parametrize("key", [key for key in NUMBERS if isinstance(help_at(key).usual, list)])
def test_usual_values_lie_on_the_slider(key):
    field, (low, high) = NUMBERS[key], help_at(key).usual
    assert field.low <= low < high <= field.high
    assert help_at(key).source, "usual values have a source"


@pytest.mark.parametrize("source", ["library", "oils"])
def test_usual_values_of_the_library_are_its_ends(source):
    names = {
        one.name for one in catalogue.choices()["bearing.base" if source == "library" else "lubricant.base"]
    }
    find = catalogue.bearing if source == "library" else catalogue.oil
    known = [dict(flat(find(name))) for name in names]
    for key, field in NUMBERS.items():
        about = help_at(key)
        if about.source != source:
            continue
        name = key.partition(".")[2]
        texts = [table[name] for table in known if name in table]
        values = [in_unit(str(text), field.unit) if field.unit else float(text) for text in texts]
        assert [min(values), max(values)] == pytest.approx(about.usual, rel=2e-3), key


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_usual_factors_of_films_are_those_of_a_fast_cold_greased_bearing():
    changes = {
        "bearing.temperature": "40 degC",
        "bearing.inner_speed": "15000 rpm",
        "bearing.supply": "grease",
    }
    found = solve(BearingCase.from_dict(changed(BEARING, changes))).summary()["bearing"]
    assert found["heat_factor"] == pytest.approx(help_at("bearing.film_factor").usual[0], rel=0.02)
    assert found["supply_factor"] == pytest.approx(help_at("bearing.supply").usual[0], rel=0.02)


def test_help_of_a_field_is_one_text_in_both_bearings_of_a_drive():
    end = dataclasses.replace(FIELDS["bearing.radial_load"], key="drive_end.bearing.radial_load")
    assert help_text(end_and_key(end.key)[1]) == help_text("bearing.radial_load")
