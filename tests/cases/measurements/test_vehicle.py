"""Duty cycles with the speed of a vehicle: the speed of the shaft follows from wheels and ratio, by hand;
without them the cycle is refused.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings

from ehlectric.axle.axle_duty import check_axle_duty, run_axle_duty
from ehlectric.bearing.duty_cycle import check_duty
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.duty_inputs import Duty, read_cycle
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.measurements import AXLE_CYCLE, CYCLE, GEAR_CYCLE, read_measurement
from ehlectric.drive.drive_cycle import check_drive_cycle
from ehlectric.errors import InputError
from ehlectric.gear.mesh_duty import check_mesh_duty
from tests.axle.axles import two_stages
from tests.bearing.duty.wltc_duty import FILE
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.text_variants import Written, variants

# The car of the example: 317 mm, and 9 turns of the motor for each turn of a wheel.
CAR = {"wheel_radius": "317 mm", "ratio": 9}


def duty_of(folder, text, **vehicle):
    (folder / "cycle.csv").write_text(text, encoding="utf-8")
    table = {"file": str(folder / "cycle.csv")}
    return Duty.from_dict({**table, "vehicle": vehicle} if vehicle else table)


def test_the_motor_of_the_test_cycle(tmp_path):
    """The file of the example contains both speeds; its generator computed the speed of the motor."""
    lines = [line for line in FILE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    cells = [line.split(",") for line in lines]
    rows = "\n".join(",".join(row[:2]) for row in cells)
    cycle = read_cycle(duty_of(tmp_path, rows, **CAR))
    rpm = np.array([float(row[2]) for row in cells[1:]])
    assert cycle.values["speed"] * 30.0 / math.pi == pytest.approx(rpm, abs=0.06)
    assert set(cycle.values) == {"speed"}


@each(
    "head, speed",
    [
        ("speed [km/h]", 36.0),
        ("speed [kmh]", 36.0),
        ("Speed (km/hr)", 36.0),
        ("speed [kmph]", 36.0),
        ("speed [kph]", 36.0),
        ("Vehicle speed [m/s]", 10.0),
        ("speed [m/s]", 10.0),
        ("vehicle_speed [mph]", 10.0 / 0.44704),
        ("velocity [mi/h]", 10.0 / 0.44704),
        ("car speed [mm/s]", 10_000.0),
        ("v [km/h]", 36.0),
        ("Geschwindigkeit (km/h)", 36.0),
    ],
)
def test_units_of_the_speed_of_a_vehicle(head, speed, tmp_path):
    """A speed of 10 m/s turns wheels of 0.5 m with 20 rad/s, and the shaft with 200 rad/s."""
    for book in (CYCLE, GEAR_CYCLE, AXLE_CYCLE):
        duty = duty_of(tmp_path, f"time [s],{head}\n0,0\n1,{speed}\n", wheel_radius="0.5 m", ratio=10)
        assert read_cycle(duty, book).values["speed"] == pytest.approx([0.0, 200.0])


def test_an_axle_computes_the_ratio_from_its_meshes(tmp_path):
    """The meshes of the example have 23/67 and 19/73 teeth."""
    text = "time [s],speed [km/h],torque [N m]\n0,36,50\n1,72,50\n"
    (tmp_path / "cycle.csv").write_text(text, encoding="utf-8")
    table = {"file": str(tmp_path / "cycle.csv"), "vehicle": {"wheel_radius": "0.3 m"}}
    for shaft, ratio in ((None, 67 / 23 * 73 / 19), ("intermediate", 67 / 23), ("rotor", 1.0)):
        vehicle = table["vehicle"] | ({} if shaft is None else {"shaft": shaft})
        case = two_stages(remedies=[], duty=table | {"vehicle": vehicle})
        result = run_axle_duty(case)
        assert result.speed == pytest.approx([10.0 / 0.3 * ratio, 20.0 / 0.3 * ratio])


def test_further_columns_in_km_per_h(tmp_path):
    """They are ignored next to the speed of the shaft, and refused if there are several without it."""
    text = "time [s],v set [km/h],v [km/h],{}\n0,1,2,3\n1,1,2,3\n"
    cycle = read_cycle(duty_of(tmp_path, text.format("speed [rpm]")))
    assert cycle.values["speed"] == pytest.approx([math.pi / 10.0] * 2)
    assert cycle.ignored == ("v set [km/h]", "v [km/h]")
    with pytest.raises(InputError, match="one speed of the vehicle"):
        read_cycle(duty_of(tmp_path, text.format("radial load [N]"), **CAR))


SPEED = "time [s],speed [km/h]\n0,10\n1,20\n"


@each(
    "text, vehicle, key, parts",
    [
        (SPEED, {}, "cycle.csv", ("speed [km/h]", "speed of the vehicle", "speed [rpm]", "vehicle")),
        (SPEED.replace("km/h", "mph"), {}, "cycle.csv", ("speed [mph]", "speed of the vehicle")),
        (SPEED.replace("km/h", "mm/s"), {}, "cycle.csv", ("speed [mm/s]", "speed of the vehicle")),
        (SPEED, {"wheel_radius": "0.3 m"}, "duty.vehicle.ratio", ("missing",)),
        (SPEED, {**CAR, "shaft": "output"}, "duty.vehicle.shaft", ("axle",)),
        (SPEED.replace("km/h", "rpm"), CAR, "duty.vehicle", ("speed [rpm]",)),
        ("time [s],radial load [N]\n0,1\n1,2\n", CAR, "duty.vehicle", ("vehicle speed [km/h]",)),
        (
            "time [s],speed [km/h]\n0,1\n1,9000\n",
            {"wheel_radius": "1 cm", "ratio": 900},
            "line 3",
            ("100000",),
        ),
    ],
)
def test_what_no_cycle_contains(text, vehicle, key, parts, tmp_path):
    with pytest.raises(InputError) as error:
        read_cycle(duty_of(tmp_path, text, **vehicle))
    assert key in str(error.value)
    assert all(part in str(error.value) for part in parts)


def test_every_kind_of_file_refuses_the_speed_of_a_vehicle(tmp_path):
    (tmp_path / "cycle.csv").write_text(SPEED, encoding="utf-8")
    duty = {"file": str(tmp_path / "cycle.csv")}
    kinds = (
        (BearingCase, "duty_wltc", check_duty),
        (DriveCase, "duty_drive", check_drive_cycle),
        (GearCase, "duty_gear", check_mesh_duty),
    )
    for kind, example, check in kinds:
        case = kind.from_toml(EXAMPLES / f"{example}.toml")
        with pytest.raises(InputError, match="speed of the vehicle"):
            check(case.replace({"duty": duty}))
        check(case.replace({"duty": {**duty, "vehicle": CAR}}))
    with pytest.raises(InputError, match="speed of the vehicle"):
        check_axle_duty(two_stages(remedies=[], duty=duty))
    for vehicle, key in ((CAR, "ratio"), ({"wheel_radius": "0.3 m", "shaft": "wheel"}, "shaft")):
        with pytest.raises(InputError, match=f"duty.vehicle.{key}"):
            check_axle_duty(two_stages(remedies=[], duty={**duty, "vehicle": vehicle}))


def test_a_measurement_contains_no_speed_of_a_vehicle(tmp_path):
    path = tmp_path / "film.csv"
    path.write_text("speed [km/h],film [nm]\n3.6,200\n", encoding="utf-8")
    with pytest.raises(InputError, match="speed of the shaft"):
        read_measurement(path)
    path.write_text("entrainment speed [km/h],film [nm]\n3.6,200\n", encoding="utf-8")
    assert read_measurement(path).values["entrainment_speed"] == pytest.approx([1.0])


CYCLE_COLUMNS = (
    Written(("time", "elapsed time"), (("s", 1.0), ("min", 1.0 / 60.0), ("ms", 1e3)), (0.0, 10.0, 25.5)),
    Written(
        ("speed", "vehicle speed", "v"),
        (("km/h", 3.6), ("kmh", 3.6), ("mph", 1.0 / 0.44704)),
        (1.25, 10.0, 12.75),
    ),
    Written(("radial load",), (("N", 1.0), ("kN", 1e-3)), (300.0, 302.5, 1250.0)),
)
COUNTS = [0, 0]


@given(content=variants(CYCLE_COLUMNS, digits=8, steps=False))
@settings(max_examples=60)
def test_variants_of_a_driving_cycle_are_read_or_refused(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("cycle") / "cycle.csv"
    path.write_bytes(content)
    vehicle = {"wheel_radius": "0.5 m", "ratio": 10}
    try:
        cycle = read_cycle(Duty.from_dict({"file": str(path), "vehicle": vehicle}))
    except InputError:
        COUNTS[1] += 1
        return
    COUNTS[0] += 1
    time, speed, load = (np.array(column.values) for column in CYCLE_COLUMNS)
    assert cycle.time == pytest.approx(time, rel=1e-6), content
    assert cycle.values["speed"] == pytest.approx(20.0 * speed, rel=1e-6), content
    assert cycle.values["radial_load"] == pytest.approx(load, rel=1e-6), content


def test_most_variants_are_read():
    assert COUNTS[0] >= 2 * COUNTS[1]


def test_the_example_of_a_vehicle_is_the_low_part_of_the_cycle():
    """The low part of the WLTC has at most 56.5 km/h; wheels of 317 mm, ratio 9."""
    duty = {"file": str(EXAMPLES / "measurements" / "wltc_low_km_h.csv"), "vehicle": CAR}
    case = BearingCase.from_toml(EXAMPLES / "duty_wltc.toml").replace({"duty": duty})
    check_duty(case)
    assert read_cycle(case.duty).values["speed"].max() == pytest.approx(56.5 / 3.6 / 0.317 * 9.0)
