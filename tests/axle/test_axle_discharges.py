"""E-axles over time: a drive as an axle of one shaft, and inputs that are refused."""

import tomllib

import numpy as np
import pytest

from ehlectric import AxleCase, DriveCase, load, save, solve_axle, solve_drive
from ehlectric.axle.axle_discharges import _stream_of_bearing, simulate_axle
from ehlectric.axle.solution import solve_elements
from ehlectric.drive.discharges.films_and_source import Measuring
from ehlectric.drive.drive_netlist_files import source_points
from ehlectric.drive.drive_record import FILM, VOLTAGE
from ehlectric.drive.films_in_time import NetworkInTime, TimedFilm
from ehlectric.drive.network import HOUSING, WINDING, Film, Network
from ehlectric.errors import InputError
from tests.axle.axles import ALONE, two_stages
from tests.helpers.drives import arc, element, march, motor, square
from tests.helpers.places import EXAMPLES


def test_an_axle_of_one_shaft_is_a_drive():
    """The same films on the same shaft: the same events to the last digit, from the same random numbers."""
    circuit, breakdown = motor(), arc(renewal_time="50 us", recovery_time=1e-7)
    bearings = [element(breakdown=6.0, shape=5.0), element([200e-12, 250e-12], breakdown=7.0, step=3e-4)]
    source = square(280.0, 1e-4, 1e-7, 200)
    drive = march(circuit, bearings, breakdown, source, seed=5)
    fixed = (
        Film("winding", WINDING, "rotor", circuit.winding_rotor_capacitance),
        Film("rotor and frame", "rotor", HOUSING, circuit.rotor_frame_capacitance),
    )
    films = (TimedFilm("ab"[k], "rotor", HOUSING, film, k) for k, film in enumerate(bearings))
    axle = NetworkInTime(Network(("rotor",), fixed), tuple(films), breakdown)
    measuring = Measuring(0.0, drive.duration, 20.0, (1.0,), 0.0)
    record = axle.march(iter([source]), measuring, 5)
    assert len(drive.events) > 100
    for name in ("events", "counts", "sums", "largest", "histogram", "above", "peak", "rms", "spectrum"):
        assert getattr(record, name).tolist() == getattr(drive, name).tolist(), name


CHOKE = {"common_mode_inductance": "1 mH", "common_mode_resistance": "100 ohm"}
GROUND = CHOKE | {
    "ground_inductance": "2 uH",
    "cable_capacitance": "1 nF",
    "frame_earth_capacitance": "300 pF",
}
BRUSH = {"grounding_ring_table": {"speed": ["100 rpm", "6000 rpm"], "resistance": ["1 kohm", "10 kohm"]}}


def as_axle(tables):
    """Tables of an axle of one shaft with the drive of a file, whose bearings are equal."""
    keys = dict(tables["drive_end"]["bearing"])
    loads = {key: keys.pop(key) for key in ("radial_load", "axial_load") if key in keys}
    shaft, places, forces = {"name": "rotor", "rotor": True}, ["0 m", "1 m"], []
    locating = [False, False]
    if "rotor" in tables:
        rotor = tables["rotor"]
        shaft |= {key: rotor[key] for key in ("mass", "mass_at")}
        places = [rotor["drive_end_at"], rotor["non_drive_end_at"]]
        locating = [rotor["locating"] == end for end in ("drive_end", "non_drive_end")]
        forces = [{"shaft": "rotor", **force} for force in tables["force"]]
    return AxleCase.from_dict(
        {name: tables[name] for name in ("source", "circuit", "breakdown")}
        | {name: tables["drive_end"][name] for name in ("lubricant", "discharge")}
        | {"drive": tables["drive"] | {"torque": "1 N m", "contacts": "atlas"}, "force": forces}
        | {"bearings": {name: keys[name] for name in keys.keys() - {"inner_speed", "temperature"}}}
        | {"shaft": [shaft]}
        | {
            "bearing": [
                {"shaft": "rotor", "at": at, "locating": fixed, **loads}
                for at, fixed in zip(places, locating, strict=True)
            ]
        }
    )


LOADED = {
    "rotor": {
        "mass": "18 kg",
        "mass_at": "80 mm",
        "drive_end_at": "10 mm",
        "non_drive_end_at": "180 mm",
        "locating": "non_drive_end",
    },
    "force": [{"at": "-60 mm", "x": "800 N", "y": "-100 N"}, {"at": "0 mm", "z": "150 N"}],
}


@pytest.mark.parametrize(
    ("circuit", "error", "more"),
    [({}, 0.0, {}), (BRUSH, 0.0, {}), (CHOKE, 1e-8, {}), (GROUND, 1e-8, {}), ({}, 0.0, LOADED)],
    ids=["capacitances", "brush", "choke", "ground", "rotor"],
)
def test_the_example_drive_as_an_axle_of_one_shaft(circuit, error, more):
    """Its loads, discharges, peaks and rms voltages are those of the drive."""
    with (EXAMPLES / "drive.toml").open("rb") as file:
        tables = tomllib.load(file)
    tables["drive"] |= {"duration": "20 ms" if not circuit else "4 ms"}
    tables["circuit"] |= circuit
    if more:
        tables = tables | more
        for load in ("radial_load", "axial_load"):
            del tables["drive_end"]["bearing"][load]
    drive, axle = DriveCase.from_dict(tables | {"remedies": []}), as_axle(tables)
    of_drive, of_axle = solve_drive(drive), solve_axle(axle, probable=True)
    one, other = of_drive.solution.record, of_axle.discharges.record
    for case, carried in zip(drive.bearings, of_axle.solution.elements, strict=True):
        assert case.bearing.radial_load == carried.radial_load
        assert case.bearing.axial_load == abs(carried.axial_load)
    assert len(one.events) > (1000 if not circuit else 100)
    for name in ("events", "counts", "sums", "largest", "peak"):
        expected = getattr(one, name)
        np.testing.assert_allclose(getattr(other, name), expected, rtol=error, atol=0.0, err_msg=name)
    # Oscillations are integrated with a tolerance that follows the mean capacitances of an axle.
    assert other.rms == pytest.approx(one.rms, rel=max(1e-10, 10.0 * error))


def scope(path, case, step=5e-9, noise=0.0):
    """File of an oscilloscope with the common-mode voltage of a case over four periods of its carrier."""
    points = np.array(source_points(case.source.at_speed(case.drive.speed), None)[0])
    times = np.arange(0.0, points[-1, 0], step)
    voltages = np.interp(times, *points.T) + np.random.default_rng(1).normal(0.0, noise, times.size)
    rows = np.column_stack([times, voltages])
    np.savetxt(path, rows, delimiter=",", header="time [s],voltage [V]", comments="", fmt="%.12g")
    return {"file": str(path)}


def test_a_measured_voltage_of_an_axle_of_one_shaft(tmp_path):
    """The discharges of the drive with the same file, to the last digit; the largest edge is a third of the
    link, and lasts as long as an edge of the inverter.
    """
    with (EXAMPLES / "drive.toml").open("rb") as file:
        tables = tomllib.load(file)
    tables["drive"] |= {"duration": "4 ms"}
    described = as_axle(tables)
    tables["source"] = scope(tmp_path / "scope.csv", described)
    drive, axle = DriveCase.from_dict(tables | {"remedies": []}), as_axle(tables)
    of_drive, of_axle = solve_drive(drive), solve_axle(axle)
    one, other = of_drive.solution.record, of_axle.discharges.record
    assert len(one.events) > 100
    assert one.events.tolist() == other.events.tolist()
    assert of_axle.solution.edge == pytest.approx((560.0 / 3.0, 100e-9), rel=1e-6)
    plain = solve_axle(described.replace({"drive.duration": None})).summary()
    summary = of_axle.summary()
    rows = zip(summary["elements"], plain["elements"], strict=True)
    assert all(row["voltage"] == pytest.approx(known["voltage"], rel=1e-6) for row, known in rows)
    assert {code for code in summary["warning_codes"] if code.startswith("record")} == {
        code for code in of_drive.summary()["warning_codes"] if code.startswith("record")
    }
    save(of_axle, tmp_path / "out")
    (tmp_path / "scope.csv").unlink()
    stored = load(tmp_path / "out").summary()
    assert [stored[name] for name in ("edge", "elements")] == [summary[name] for name in ("edge", "elements")]


@pytest.mark.parametrize(
    ("step", "noise", "error"), [(5e-9, 1.0, 0.03), (50e-9, 1.0, 0.03), (50e-9, 0.0, 1e-9)]
)
def test_edges_of_noisy_and_coarse_records(tmp_path, step, noise, error):
    """Noise adds to the largest edge, and coarse samples lengthen it by less than an interval."""
    case = two_stages()
    measured = two_stages(source=scope(tmp_path / "scope.csv", case, step, noise))
    edge = solve_elements(measured).edge
    assert edge.voltage == pytest.approx(case.edge, rel=error)
    assert case.source.rise_time * 0.9 < edge.rise_time < case.source.rise_time + step
    half = solve_elements(measured.replace({"source.scale": -0.5})).edge
    assert half == pytest.approx((0.5 * edge.voltage, edge.rise_time), rel=1e-12)


def test_a_measure_with_a_measured_source_is_stored(tmp_path):
    """The axle itself has a described one."""
    case = two_stages()
    source = scope(tmp_path / "scope.csv", case) | {"scale": 0.5}
    remedied = case.replace(remedies=[{"title": "A", "changes": {"source": source}}])
    result = solve_axle(remedied, probable=False)
    save(result, tmp_path / "out")
    (tmp_path / "scope.csv").unlink()
    loaded = load(tmp_path / "out")
    assert loaded.solution.measured_edge is None
    assert loaded.remedies[0].edge == result.remedies[0].edge
    assert loaded.remedies[0].edge.voltage == pytest.approx(0.5 * case.edge, rel=1e-9)
    assert loaded.summary()["remedies"] == result.summary()["remedies"]


def test_a_missing_record_of_an_axle_is_named(tmp_path):
    case = two_stages(source={"file": str(tmp_path / "lost.csv")})
    with pytest.raises(InputError, match=r"lost\.csv") as refused:
        solve_elements(case)
    assert refused.value.key == "source.file"


def test_nothing_discharges_if_all_shafts_are_connected_to_the_housing(tmp_path):
    """Bearings with summits that always touch conduct; a result without a simulation is stored and loaded."""
    rough = [
        {**bearing, "composite_rq": "1 um", "contact_resistance": "1 ohm"} for bearing in ALONE["bearing"]
    ]
    timed = ALONE["drive"] | {"duration": "1 ms", "speed": "20 rpm"}
    case = AxleCase.from_dict(
        COUPLED | {"drive": timed, "shaft": ALONE["shaft"], "bearing": rough, "link": []}
    )
    result = solve_axle(case)
    assert result.discharges is None
    assert "simulation" not in result.summary()
    save(result, tmp_path)
    assert load(tmp_path).discharges is None


def test_a_duration_without_an_arc_is_refused():
    case = AxleCase.from_dict(ALONE | {"drive": ALONE["drive"] | {"duration": "1 ms"}})
    with pytest.raises(InputError) as refused:
        solve_axle(case)
    assert refused.value.key == "breakdown"


# Two shafts with given loads and a coupling, whose thresholds scatter.
COUPLED = ALONE | {
    "drive": ALONE["drive"] | {"duration": "2 ms", "seed": 3},
    "shaft": [{"name": "rotor", "rotor": True}, {"name": "wheel"}],
    "bearing": [
        *ALONE["bearing"],
        *({**bearing, "shaft": "wheel", "radial_load": "500 N"} for bearing in ALONE["bearing"]),
    ],
    "link": [{"between": ["rotor", "wheel"], "kind": "insulated", "capacitance": "1 nF"}],
    "breakdown": {
        "arc_resistance": "10 ohm",
        "extinction_current": "10 mA",
        "recovery_time": "100 ns",
        "weibull_shape": 3.0,
    },
    "circuit": {"winding_rotor_capacitance": "1 nF", "rotor_frame_capacitance": "1 nF"},
}


def simulated(**changes):
    """Discharges of both shafts."""
    return simulate_axle(solve_elements(AxleCase.from_dict(COUPLED | changes)))


def test_random_numbers_do_not_depend_on_the_order_of_the_file():
    """Another order of shafts and bearings has the same discharges."""
    plain = simulated()
    other = simulated(shaft=COUPLED["shaft"][::-1], bearing=COUPLED["bearing"][::-1])
    times = {each["time"] for each in plain.events()}
    assert len(times) > 20
    assert [each["time"] for each in other.events()] == pytest.approx(
        [each["time"] for each in plain.events()], rel=1e-9
    )
    assert [each["energy"] for each in other.events()] == pytest.approx(
        [each["energy"] for each in plain.events()], rel=1e-6
    )


def test_random_numbers_do_not_depend_on_other_elements():
    """Streams of the bearings of the rotor with another name of the other shaft, and without this shaft."""

    def streams(**changes):
        case = AxleCase.from_dict(COUPLED | changes)
        return {
            (bearing.shaft, bearing.at): _stream_of_bearing(case, number)
            for number, bearing in enumerate(case.bearing)
        }

    whole = streams()
    alone = streams(shaft=COUPLED["shaft"][:1], bearing=COUPLED["bearing"][:2], link=[])
    assert alone == {key: value for key, value in whole.items() if key[0] == "rotor"}
    assert list(alone.values()) == [0, 1]
    assert len(set(whole.values())) == 4


# Two shafts, each with a capacitance to the winding and to the housing.
SEPARATE = (
    Film("winding", WINDING, "rotor", 50e-12),
    Film("rotor and frame", "rotor", HOUSING, 500e-12),
    Film("winding 2", WINDING, "a", 50e-12),
    Film("frame 2", "a", HOUSING, 500e-12),
)


def test_the_first_thresholds_of_a_film_do_not_depend_on_other_films():
    """The first discharges of a film that no other film influences: thresholds from its own stream."""

    def first(films):
        axle = NetworkInTime(Network(("rotor", "a"), SEPARATE), films, arc(recovery_time=1e-7))
        record = axle.march(iter([square(280.0, 1e-4, 1e-7, 20)]), Measuring(0.0, 2e-3, 40.0, (1.0,), 0.0), 7)
        of_rotor = [each.name for each in axle.active].index("rotor bearing")
        return record.events[record.events[:, FILM] == of_rotor][:, VOLTAGE]

    rotor = TimedFilm("rotor bearing", "rotor", HOUSING, element(breakdown=6.0, shape=4.0))
    other = TimedFilm("other", "a", HOUSING, element(breakdown=1.0, shape=4.0))
    alone = first((rotor,))
    assert alone.size > 20
    assert first((other, rotor)) == pytest.approx(alone, rel=1e-9)


def test_all_missing_resistances_are_named_at_once():
    """Ground flanks of the first mesh and rough bearings of the output shaft conduct at times."""
    rough = two_stages(
        **{
            "bearing.output.composite_rq": "0.12 um",
            "mesh.1.gear.flank_ra": "0.2 um",
            "mesh.1.contact_resistance": None,
            "drive.duration": "1 ms",
            "breakdown": {"arc_resistance": 10.0, "extinction_current": 0.01, "recovery_time": 1e-7},
            "remedies": [],
        }
    )
    with pytest.raises(InputError) as refused:
        solve_axle(rough)
    keys = ("bearing.5.contact_resistance", "bearing.6.contact_resistance", "mesh.1.contact_resistance")
    assert [error.key for error in refused.value.several] == [*keys]
    assert all(key in str(refused.value) for key in keys)


def test_the_resistance_of_a_mesh_replaces_the_value_of_its_gear_file():
    case = two_stages(**{"mesh.1.contact_resistance": "2 ohm", "mesh.2.contact_resistance": None})
    contacts = [case.gear_case(number, case.turning()).gear.contact for number in range(2)]
    assert [contact.contact_resistance for contact in contacts] == [2.0, None]
    again = AxleCase.from_dict(case.to_dict()).replace({"mesh.gear.contact.contact_resistance": "3 ohm"})
    contacts = [again.gear_case(number, again.turning()).gear.contact for number in range(2)]
    assert [contact.contact_resistance for contact in contacts] == [3.0, 3.0]


@pytest.mark.slow
def test_all_missing_values_of_an_axle_and_its_remedies_are_named_at_once():
    """A mesh that insulates needs no resistance; a rougher one does, also if a remedy roughens it."""
    case = two_stages()
    tables = case.to_dict()
    for mesh in tables["mesh"]:
        mesh.pop("contact_resistance", None)
    rough = [
        {"title": f"Rough {n}", "changes": {f"mesh.{n}.gear.flank_ra": ra}}
        for n, ra in ((1, 9e-8), (2, 1.2e-7))
    ]
    tables["drive"]["duration"] = 1e-4
    tables["breakdown"] = {"arc_resistance": 10.0, "extinction_current": 0.01, "recovery_time": 1e-7}
    alone = solve_axle(AxleCase.from_dict(tables | {"remedies": []}))
    assert alone.discharges is not None
    with pytest.raises(InputError) as caught:
        solve_axle(AxleCase.from_dict(tables | {"remedies": rough}))
    text = str(caught.value)
    assert text.startswith("mesh.1.contact_resistance: missing")
    assert "missing with the mitigation measure 'Rough 1'; expected the resistance" in text
    assert "also missing: mesh.2.contact_resistance with the mitigation measure 'Rough 2'" in text


@pytest.mark.slow
def test_a_value_that_the_axle_itself_lacks_is_named_once():
    """With the table of the arc, and not again for a remedy."""
    tables = two_stages().to_dict()
    for mesh in tables["mesh"]:
        mesh.pop("contact_resistance", None)
        mesh["pair"]["gear"]["flank_ra"] = [1.2e-7, 1.2e-7]
    tables["drive"]["duration"] = 1e-4
    tables.pop("breakdown", None)
    tables["remedies"] = [{"title": "Edge", "changes": {"source.rise_time": 2e-7}}]
    with pytest.raises(InputError) as caught:
        solve_axle(AxleCase.from_dict(tables))
    text = str(caught.value)
    assert text.startswith("breakdown: missing")
    assert [text.count(f"mesh.{number}.contact_resistance") for number in (1, 2)] == [1, 1]


def test_a_mesh_discharges_between_its_shafts():
    """The first mesh of the e-axle of the examples, which insulates; the second one conducts for good."""
    keys = {"bearings.contact_resistance": "1 ohm", "mesh.1.contact_resistance": "1 ohm"}
    discharges = solve_axle(
        two_stages(**{"drive.duration": "0.5 ms", "remedies": [], "breakdown": COUPLED["breakdown"]} | keys)
    ).discharges
    rows = {row["element"]: row for row in discharges.summary()["elements"]}
    assert rows["mesh of rotor and intermediate"]["events"] > 0


@pytest.mark.parametrize("axle", [ALONE, COUPLED])
def test_an_arc_that_goes_out_above_a_breakdown_voltage_is_refused(axle):
    """As in a drive, by the name of the bearing: an arc that a film without summits would not feed either.
    An arc between the voltages with and without summits lifts the limit of the film, and is simulated.
    """
    limit = min(each.breakdown_voltage for each in solve_elements(AxleCase.from_dict(axle)).elements)
    arc_of = COUPLED["breakdown"] | {"extinction_voltage": 10.0 * limit}
    del arc_of["extinction_current"]
    timed = axle["drive"] | {"duration": "0.1 ms"}
    with pytest.raises(InputError, match=r"at which the films of bearing \d of \w+ break down") as refused:
        solve_axle(AxleCase.from_dict(axle | {"drive": timed, "breakdown": arc_of}))
    assert refused.value.key == "breakdown.extinction_voltage"
    hotter = {"title": "hotter", "changes": {"breakdown.extinction_voltage": 10.0 * limit}}
    arc_of["extinction_voltage"] = 0.5 * limit
    with pytest.raises(InputError, match=r"^remedies\.1\.changes\.breakdown\.extinction_voltage: "):
        solve_axle(AxleCase.from_dict(axle | {"drive": timed, "breakdown": arc_of, "remedies": [hotter]}))
    arc_of["extinction_voltage"] = 1.02 * limit
    assert solve_axle(AxleCase.from_dict(axle | {"drive": timed, "breakdown": arc_of})).discharges is not None
