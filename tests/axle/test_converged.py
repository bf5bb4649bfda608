"""Axles with a film that is not converged: no verdict, status 3, and numbers that may not be used."""

import json

import pytest

from ehlectric import AxleCase, load
from ehlectric.app.compute.answer_parts import UNUSABLE
from ehlectric.app.compute.axle_answers import answer_of
from ehlectric.axle.run import solve_to_folder
from ehlectric.sweep.engine import solve_point
from tests.axle.axles import ALONE

ROLLERS = {"base": "NU208", "profile": "logarithmic", "radial_clearance": "20 um", "composite_rq": "0.03 um"}


def axle():
    """Rotor on two roller bearings, whose line contacts are solved."""
    bearings = [
        {"shaft": "rotor", "at": at, "radial_load": load, **ROLLERS}
        for at, load in (("0 mm", "2 kN"), ("80 mm", "1.5 kN"))
    ]
    return AxleCase.from_dict(ALONE | {"bearing": bearings, "drive": ALONE["drive"] | {"contacts": "solved"}})


@pytest.mark.slow
@pytest.mark.parametrize("most", [1, None])
def test_a_film_that_is_not_converged_is_told_every_way(monkeypatch, tmp_path, most):
    """As a drive and a bearing do. One iteration is too few for every contact; the default is enough."""
    made = AxleCase.bearing_case
    if most is not None:
        monkeypatch.setattr(
            AxleCase,
            "bearing_case",
            lambda *about: made(*about).replace({"solver.max_iterations": most}),
        )
    converged = most is None
    case = axle()
    outcome = solve_to_folder(case, tmp_path)
    result = outcome.result
    assert outcome.converged == result.converged == converged
    assert outcome.failure == (None if converged else "not converged: a contact of a bearing")
    assert json.loads((tmp_path / "summary.json").read_text("utf-8"))["converged"] == converged
    assert ("NOT CONVERGED" in str(result)) != converged
    again = load(tmp_path)
    for each in (result, again):
        assert each.converged == converged
        assert (each.verdict.level == "grey") != converged
    assert again.verdict == result.verdict
    numbers = answer_of(result).shown
    assert numbers
    assert all((number.note == UNUSABLE) != converged == number.known for number in numbers)
    point = solve_point(case.to_dict())
    assert point.status == ("solved" if converged else "not converged")
