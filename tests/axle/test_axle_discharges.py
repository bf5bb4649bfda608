"""E-axles over time: a drive as an axle of one shaft, and inputs that are refused."""

import pytest

from ehlectric import AxleCase, solve_axle
from ehlectric.axle.films_in_time import AxleInTime, TimedFilm
from ehlectric.axle.network import HOUSING, WINDING, Film, Network
from ehlectric.drive.discharges.films_and_source import Measuring
from ehlectric.errors import InputError
from tests.axle.axles import ALONE
from tests.helpers.drives import arc, element, march, motor, square


def test_an_axle_of_one_shaft_is_a_drive():
    """The same films on the same shaft: the same events, from the same random numbers."""
    circuit, breakdown = motor(), arc(renewal_time="50 us", recovery_time=1e-7)
    bearings = [element(breakdown=6.0, shape=5.0), element([200e-12, 250e-12], breakdown=7.0, step=3e-4)]
    source = square(280.0, 1e-4, 1e-7, 200)
    drive = march(circuit, bearings, breakdown, source, seed=5)
    fixed = (
        Film("winding", WINDING, "rotor", circuit.winding_rotor_capacitance),
        Film("rotor and frame", "rotor", HOUSING, circuit.rotor_frame_capacitance),
    )
    films = (TimedFilm(name, "rotor", HOUSING, film) for name, film in zip("ab", bearings, strict=True))
    axle = AxleInTime(Network(("rotor",), fixed), tuple(films), breakdown)
    measuring = Measuring(0.0, drive.duration, 20.0, (1.0,), 0.0)
    record = axle.march(iter([source]), measuring, 5)
    assert len(drive.events) > 100
    assert record.events == pytest.approx(drive.events, rel=1e-9, abs=1e-20)
    assert record.rms == pytest.approx(drive.rms, rel=1e-9)


def test_a_duration_without_an_arc_is_refused():
    case = AxleCase.from_dict(ALONE | {"drive": ALONE["drive"] | {"duration": "1 ms"}})
    with pytest.raises(InputError) as refused:
        solve_axle(case)
    assert refused.value.key == "breakdown"
