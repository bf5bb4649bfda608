"""Grids that fit, and grids that do not."""

import subprocess
import sys

import pytest

from ehlectric import Case, InputError
from ehlectric.contact.contact_memory import KRYLOV_VECTORS, check_memory, point_memory
from ehlectric.film import newton
from ehlectric.runtime.memory import physical_memory
from tests.helpers.films import film_alone
from tests.helpers.moving_cases import TABLES, moving

POINT = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20.0, "reduced_modulus": 226e9}
PIT = {"surface": 1, "generator": "pit", "depth": 1e-7, "width": 4e-5, "position_y": 3e-5}


def point(*roughness, **grid):
    contact = POINT | {"entrainment_speed": 2.0}
    oil = {"base": "paper"}
    return Case.from_dict({"contact": contact, "lubricant": oil, "grid": grid, "roughness": list(roughness)})


def test_grids_that_do_not_fit_into_memory(monkeypatch, paper_case):
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 1e9)
    check_memory(paper_case)
    with pytest.raises(InputError, match=r"grid\.nodes: .*5000001 .* GB.* 1 GB"):
        check_memory(paper_case.replace({"grid.nodes": 5_000_001}))
    with pytest.raises(InputError, match=r"grid\.field_nodes: .*1000001 .*field_degree 8"):
        check_memory(paper_case.replace({"grid.field_nodes": 1_000_001, "grid.field_degree": 8}))


def test_machine_has_memory():
    assert physical_memory() > 1e8


def test_contacts_that_are_no_mirror_image_of_themselves_take_twice_as_much(monkeypatch):
    whole, half = (sum(point_memory(point(nodes=513).grid, rough=rough)) for rough in (True, False))
    assert whole == pytest.approx(2.0 * half, rel=0.01)  # but for the line they share
    assert sum(point_memory(point(nodes=512).grid, rough=False)) == pytest.approx(whole, rel=0.01)
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 0.7 * whole)
    check_memory(point(nodes=513))
    with pytest.raises(InputError, match=r"grid\.nodes: got 513 x 513"):
        check_memory(point(PIT, nodes=513))


def test_krylov_space_that_is_reckoned_with(paper_case, monkeypatch):
    """Flexible GMRES keeps every direction and its preconditioned one, and the first residual."""
    solver, limits = newton.flexible_gmres, []

    def counted(*values, **options):
        limits.append(options["limit"])
        return solver(*values, **options)

    monkeypatch.setattr(newton, "flexible_gmres", counted)
    film_alone(paper_case.replace({"grid.nodes": 401}))
    assert limits
    assert 2 * max(limits) + 1 == KRYLOV_VECTORS


# Solves in a fresh process; what the system counts as its highest memory, before and after.
MEASURED = """
from ehlectric import Case
from ehlectric.contact.conditions import resolve_point
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.contact.problems import point_film_problem

def highest():
    with open("/proc/self/status") as status:
        return next(1024 * int(line.split()[1]) for line in status if line.startswith("VmHWM"))

case = Case.from_dict({table})
problem = point_film_problem(case, resolve_point(case))
before = highest()
solve_point_film(problem)
print(highest() - before)
"""


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("nodes_y", [513, 512])
def test_film_of_a_point_contact_takes_what_is_reckoned_with(nodes_y):
    case = point(nodes=513, nodes_y=nodes_y)
    code = MEASURED.replace("{table}", repr(case.model_dump(exclude_unset=True)))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    reckoned, _ = point_memory(case.grid, rough=False)
    # Twenty iterations, where up to sixty are reckoned with: some half of it.
    assert reckoned / 3.0 < int(done.stdout) < reckoned


def test_instants_of_a_motion_that_fit_into_no_memory_are_refused(monkeypatch):
    """64 bytes a node and instant; no more instants than time steps and one are kept."""
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 64e6)
    check_memory(moving(motion={"passes": 1.0, "record": 20_000}))
    with pytest.raises(InputError, match=r"^motion\.record: .*20000 .* 15384 "):
        check_memory(moving(motion={"duration": "1 s", "record": 20_000}))
    ball = moving(TABLES["point"], motion={"duration": "1 s", "record": 300})
    with pytest.raises(InputError, match=r"^motion\.record: .*300 .* 4225 "):
        check_memory(ball)
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 1e9)
    check_memory(ball)


def test_a_field_on_half_of_the_domain_takes_half_of_the_memory():
    """Columns at the distances of the nodes: their number is a share of the nodes along each axis."""
    sizes = {"nodes": 513, "side": 4.0, "inlet": -4.0, "outlet": 4.0}

    def field(**part):
        return point_memory(point(PIT, **sizes, **part).grid, rough=True)[1]

    whole = field(field_range=[-4.0, 4.0], field_side=4.0)
    assert field(field_range=[-4.0, 4.0], field_side=2.0) == pytest.approx(0.5 * whole, rel=0.01)
    assert field(field_range=[-2.0, 2.0], field_side=4.0) == pytest.approx(0.5 * whole, rel=0.01)
