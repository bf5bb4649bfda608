"""Impedance of a bearing of contacts made by hand: its ends, its corner, and the file it goes into."""

import numpy as np
import pytest
import tomli_w
from typer.testing import CliRunner

from ehlectric.bearing.impedance import impedance_of, oil_relaxation_time
from ehlectric.commands.command_line import app
from tests.figures.bearing.test_save import TABLE, by_hand


@pytest.fixture(scope="module")
def result():
    return by_hand()


def test_impedance_is_that_of_the_capacitance_where_all_is_oil(result):
    """Then every contact has the same time constant, and so has the bearing."""
    found = impedance_of(result.solution)
    tau = oil_relaxation_time(result.solution)
    z = 1.0 / (result.capacitance("oil") * (2j * np.pi * found.frequency + 1.0 / tau))
    np.testing.assert_allclose(found.magnitude, np.abs(z), rtol=1e-9)
    corner = 1.0 / (2.0 * np.pi * tau)
    assert found.corner == pytest.approx(corner, rel=1e-12)
    assert found.frequency[0] == pytest.approx(0.01 * corner, rel=1e-9)
    assert found.frequency[-1] == pytest.approx(1e7, rel=1e-9)
    at_corner = np.interp(np.log(corner), np.log(found.frequency), found.phase)
    assert at_corner == pytest.approx(-45.0, abs=0.05)


def test_air_does_not_leak():
    """High up the impedance is that of all capacitances, far down it is above what oil alone would have."""
    result = by_hand(bearing={"fill": "air"})
    found = impedance_of(result.solution)
    high = found.magnitude[-1] * 2.0 * np.pi * found.frequency[-1] * result.capacitance("air")
    assert high == pytest.approx(1.0, rel=1e-6)
    assert found.magnitude[0] > 1.1 * oil_relaxation_time(result.solution) / result.capacitance("oil")


@pytest.mark.slow
def test_the_impedance_of_an_earlier_bearing_is_taken_away(monkeypatch, tmp_path):
    """With a conductivity it is written, without one there is none."""
    file, out = tmp_path / "bearing.toml", tmp_path / "out"
    file.write_text(tomli_w.dumps(TABLE), encoding="utf-8")
    for changes, there in (({}, True), ({"discharge": None}, False)):
        result = by_hand(positions=1, **changes)
        monkeypatch.setattr("ehlectric.bearing.run.solve_bearing", lambda *_, r=result, **__: r)
        done = CliRunner().invoke(app, ["bearing", str(file), "-o", str(out), "-q", "--no-plots"])
        assert done.exit_code == 0, done.output
        assert (out / "impedance.csv").exists() == there


def test_with_air_the_bearing_has_a_corner_below_that_of_the_oil():
    """More of it is a capacitor than of its oil: beyond -45 degrees where the oil alone has them."""
    found = impedance_of(by_hand(bearing={"fill": "air"}).solution)
    at_corner = np.interp(np.log(found.corner), np.log(found.frequency), found.phase)
    assert -90.0 < at_corner < -45.5
    own = np.interp(45.0, -found.phase, found.frequency)
    assert 0.1 * found.corner < own < found.corner


@pytest.mark.parametrize(
    "changes",
    [{"discharge": None}, {"film": 0.02e-6}, {"bearing": {"element_material": "silicon-nitride"}}],
    ids=["no conductivity", "surfaces touch", "ceramic"],
)
def test_where_there_is_none(changes):
    assert impedance_of(by_hand(positions=1, **changes).solution) is None
