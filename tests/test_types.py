"""Types of the public names, as a user's type checker sees them."""

import subprocess
import sys
from pathlib import Path

import pytest

import ehlectric

SCRIPT = """
import pint
import ehlectric
from ehlectric import BearingCase, BearingResult, Case, PointResult, Result, Sweep, solve, solve_many

unit: pint.UnitRegistry[float] = pint.UnitRegistry()
line = Case.line(
    reduced_radius=0.0141, reduced_modulus="226 GPa", load_per_length=unit.Quantity(1.57, "MN/m"),
    speed_1=1.0, speed_2=unit.Quantity(7.0, "m/s"), lubricant="paper", grid={"nodes": 801},
)
ball = Case.point(
    radius_x="10 mm", radius_y=0.01, load=20, reduced_modulus=226e9, entrainment_speed=2.0,
    lubricant={"base": "paper"},
)
bearing = BearingCase.of(
    base="6208", radial_clearance="10 um", radial_load="1 kN", inner_speed="3000 rpm",
    temperature="70 degC", composite_rq="0.03 um", lubricant={"base": "paper", "viscosity": "20 mPa s"},
)
tables = Case(contact={"load": 20}, lubricant={"base": "paper"})
machine = BearingCase(bearing={"base": "6208"}, lubricant={"base": "paper"}, contacts="formula")
sweep = Sweep.from_dict({"case": line, "vary": {"grid.nodes": [401, 801]}})
reveal_type(solve(line))
reveal_type(solve(ball))
reveal_type(solve(bearing))
reveal_type(solve(Case.from_toml("case.toml")))
reveal_type(solve("case.toml"))
thickness: float = solve(Case.from_toml("case.toml")).film.minimum_thickness
for one in solve_many([bearing]):
    reveal_type(one.result)
for number, result, error in solve_many([line, line]):
    reveal_type(result)
reveal_type(solve(line).plot())
reveal_type(line.replace({"grid.nodes": 401}))
"""
WRONG = """
from ehlectric import Case, solve

Case.line(reduced_radus=1.0, lubricant="paper")
Case.line(reduced_radius=[1.0], lubricant="paper")
Case(contact=5, lubricant={})
solve(5)
case = Case.line(lubricant="paper")
solve(case).no_such_attribute
solve(case, workers=2)
"""
PUBLIC = sorted({*ehlectric.__all__} - {"__version__"})
NAMES = "\n".join(["import ehlectric", *(f"reveal_type(ehlectric.{name})" for name in PUBLIC)])


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """Lines of mypy about scripts of a user, which have their own strict settings and no plugin.

    The scripts are checked at once, as most of the time goes into the package.
    """
    folder = tmp_path_factory.mktemp("user")
    (folder / "script.py").write_text(SCRIPT, encoding="utf-8")
    (folder / "wrong.py").write_text(WRONG, encoding="utf-8")
    (folder / "names.py").write_text(NAMES, encoding="utf-8")
    # As of every installed package, what is wrong inside of this one is not looked for.
    settings = "[mypy]\nstrict = True\n[mypy-ehlectric.*]\nignore_errors = True\n"
    (folder / "mypy.ini").write_text(settings, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", "mypy.ini", "script.py", "wrong.py", "names.py"],
        cwd=folder,
        env={"MYPYPATH": str(Path(ehlectric.__file__).parents[1]), "PATH": ""},
        capture_output=True,
        text=True,
    )
    return done.stdout.splitlines()


@pytest.mark.slow
def test_a_type_checker_knows_the_results(told):
    lines = [line for line in told if line.startswith("script.py")]
    assert not [line for line in lines if ": error" in line], lines
    shown = [line.partition("Revealed type is ")[2].strip('"') for line in lines]
    assert shown == [
        "ehlectric.contact.result.Result",
        "ehlectric.contact.result.PointResult",
        "ehlectric.bearing.result.BearingResult",
        "ehlectric.contact.result.Result | ehlectric.contact.result.PointResult",
        "Any",
        "ehlectric.bearing.result.BearingResult | None",
        "ehlectric.contact.result.Result | None",
        "matplotlib.figure.Figure",
        "ehlectric.cases.case.LineCase",
    ]


@pytest.mark.slow
def test_a_type_checker_finds_mistakes(told):
    lines = [line for line in told if line.startswith("wrong.py")]
    wrong = [line.split(":")[1] for line in lines if ": error" in line]
    assert {int(number) for number in wrong} == {4, 5, 6, 7, 9, 10}


@pytest.mark.slow
def test_a_type_checker_knows_every_public_name(told):
    lines = [line for line in told if line.startswith("names.py")]
    types = [line.partition("Revealed type is ")[2].strip('"') for line in lines]
    assert len(types) == len(PUBLIC)
    assert not [name for name, shown in zip(PUBLIC, types, strict=True) if shown in ("", "Any")]
