"""Misprints and slips in the paper, each with a computed check that shows it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.contact import field_problem, film_problem, resolve
from ehlectric.errors import ConvergenceError
from ehlectric.field import solve_field
from ehlectric.film import FilmProblem, trapezoidal_weights
from ehlectric.lubricant.viscosity import roelands_exponent
from ehlectric.paper import fas, paper_relaxation
from ehlectric.paper.film_equations import FilmEquations, Iterate
from ehlectric.paper.paper_contacts import CONTACTS, SMOOTH_NODES, of_paper
from ehlectric.paper.sor import ROWS
from ehlectric.paper.study import Study, readings_differ_by


@dataclass(frozen=True)
class Slip:
    """Slip in the paper."""

    printed: str
    should_be: str
    check: Callable[[Study], str]  # returns, for a study, a text with computed numbers that show the slip


def _viscosity(_: Study) -> str:
    """Check of the viscosity of Table 1 by M, L and the Roelands exponent."""
    case = CONTACTS[4].case()
    oil = case.lubricant
    contact = replace(resolve(case).contact, pressure_viscosity_coefficient=case.oil.alpha)
    misprinted = replace(contact, viscosity=4e-4)
    assert oil.pressure_viscosity_coefficient is not None and oil.roelands_pressure is not None
    z = roelands_exponent(case.oil.viscosity, oil.pressure_viscosity_coefficient, oil.roelands_pressure)
    return (
        "M and L of Table 3's first row are printed as 49.2 and 15.7: 4e-4 gives "
        f"{misprinted.moes_m:.1f} and {misprinted.moes_l:.2f}, {oil.viscosity:g} gives {contact.moes_m:.1f} "
        f"and {contact.moes_l:.1f}. Roelands' relation gives z = {z:.3f} for {oil.viscosity:g}, printed 0.67"
    )


def _load(_: Study) -> str:
    """Check of the load of Table 2 by the Hertz pressures that it gives."""
    pressures = [resolve(CONTACTS[k].case()).max_pressure / 1e9 for k in (4, 0)]
    return f"w = 1.57e6 N/m gives p_h = {pressures[0]:.3f} GPa, a quarter of it {pressures[1]:.3f} GPa"


def _solved(nodes: int) -> tuple[FilmProblem, FilmEquations, Iterate]:
    """First contact at 1 GPa: its problem, the paper's equations on ``nodes`` nodes, and their solution."""
    case = CONTACTS[0].case(nodes=nodes, wedge="first-order")
    problem = film_problem(case, resolve(case))
    film, equations = fas.solve_film(problem), fas.equations_of(problem, nodes)
    pressure = film.pressure / problem.scales.pressure
    rigid = film.thickness / problem.scales.thickness - equations.gap - equations.deflection(pressure)
    return problem, equations, Iterate(pressure, float(np.mean(rigid)))


def _cavitation(_: Study) -> str:
    """Check of the cavitation condition by the lowest pressure of a film without it."""
    problem, equations, at = _solved(401)
    lowest = float(np.min(_unconstrained(equations, at).pressure))
    return (
        f"{CONTACTS[0].name}, 401 nodes: solved without the condition, the pressure behind the exit goes to "
        f"{100.0 * lowest:.1f} % of p_h, a tension of {-lowest * problem.scales.pressure / 1e6:.0f} MPa"
    )


def _unconstrained(equations: FilmEquations, at: Iterate) -> Iterate:
    """Film without cavitation: pressure and H00 by Newton's method, with pressures below ambient allowed."""
    n = equations.x.size
    weights = trapezoidal_weights(n, equations.dx)
    for _ in range(30):
        c = equations.coefficients(at)
        derivatives = equations.derivatives(at, c)
        matrix = np.zeros((n + 1, n + 1))
        matrix[:n, :n] = paper_relaxation.whole_jacobian(equations, derivatives)
        matrix[:n, n] = derivatives[1].sum(axis=0)
        matrix[0, 0] = matrix[n - 1, n - 1] = 1.0
        matrix[n, :n] = weights
        right = np.append(equations.residual(at, c), equations.load - equations.carried(at.pressure))
        change = np.linalg.solve(matrix, right)
        change /= max(1.0, float(np.max(np.abs(change))) / 0.1)
        at = Iterate(at.pressure + change[:n], at.h00 + float(change[n]))
        if np.max(np.abs(change)) < 1e-10:
            return at
    raise ConvergenceError("film without cavitation")


def _sign_of_c(_: Study) -> str:
    """Check of the sign of c in eq. (19) by the load that a raised H00 carries."""
    equations, at = _solved(201)[1:]
    loads = []
    for lift in (0.0, 0.01):
        lifted = replace(at, h00=at.h00 + lift)
        for _step in range(20):
            lifted = paper_relaxation.newton_step(equations, lifted)
        loads.append(equations.carried(lifted.pressure))
    return (
        f"{CONTACTS[0].name}, 201 nodes: with H00 raised by 0.01 the film, solved again, carries "
        f"{loads[1]:.4f} instead of {loads[0]:.4f}"
    )


def _wall_charge(_: Study) -> str:
    """Check of the wall condition Q = V eps0 by the potential that it gives."""
    eps = 2.4
    return (
        "eq. (16) at a wall node among nodes of the same potential V = 1 V, with Q = V eps0: V = "
        f"(a0 V + Q/eps0)/a0 = {(4.0 * eps + 1.0) / (4.0 * eps):.2f} V"
    )


def _square_cells(study: Study) -> str:
    """Check of eqs. (A1) to (A5) on cells that are not square by the field that they give."""
    contact = CONTACTS[4]
    result = study.rough[contact]
    film = result.film
    problem = field_problem(result.case, result.conditions, film, result.roughness)
    # Cells of the size of the paper's grid: columns at its film nodes, and eight rows in the smallest gap.
    dx = float(np.ptp(film.x)) / (SMOOTH_NODES - 1)
    dy = film.minimum_thickness / ROWS
    squeezed = solve_field(replace(problem, x=problem.x * dy / dx))
    # The field strength follows from this potential with the true dx.
    strength = np.hypot(squeezed.field_x * dy / dx, squeezed.field_y)
    return (
        f"{contact.name}, rough, cells of {dx * 1e9:.0f} by {dy * 1e9:.0f} nm: as printed, the coefficients "
        f"solve the gap squeezed {dx / dy:.0f} times along x, with E_max h_min/V12 "
        f"{float(np.max(strength)) * result.strength_scale:.2f} instead of {result.max_dimensionless:.2f}"
    )


def _m68(study: Study) -> str:
    """Check of the name M68 by the computed M."""
    groups = of_paper(study.smooth[CONTACTS[5]])
    return f"M = {groups.moes_m:.1f}; Table 3 prints 69.6"


def _inverse(study: Study) -> str:
    """Check that the largest field is inversely proportional to the minimum film thickness."""
    results = list(study.smooth.values())
    products = [result.max_dimensionless for result in results]
    films = [r.film.minimum_thickness * 1e6 for r in results]
    return (
        f"E_max h_min/V12 is 1 within {max(abs(product - 1.0) for product in products):.0e} for films of "
        f"{min(films):.2f} to {max(films):.2f} µm: the field goes with 1/h_min"
    )


def _current_density(study: Study) -> str:
    """Check of the unit of the current density by the currents that it gives."""
    area = 2.0 * study.smooth[CONTACTS[4]].conditions.half_width * 10e-3
    return (
        f"over the Hertzian contact area of a 2 GPa contact 10 mm long, {area * 1e6:.0f} mm^2, 0.8 A/m^2 is "
        f"{0.8 * area * 1e6:.0f} µA and 0.8 A/mm^2 is {0.8e6 * area:.0f} A; limits of bearing currents are "
        "given in A/mm^2 (Busse et al., the paper's reference 45)"
    )


def _readings(study: Study) -> str:
    """Check of the two readings of mid-film by their largest difference."""
    rough = max(readings_differ_by(result) for result in study.rough.values())
    return (
        "half of the average film above the average lower surface is a straight line: between smooth equal "
        "bodies it is s = 1/2 itself, in the rough films of Figure 11 the two differ by up to "
        f"{100.0 * rough:.2g} %"
    )


SLIPS = (
    Slip("Table 1: eta0 = 4e-4 Pa s", "0.04 Pa s", _viscosity),
    Slip("Table 2: one load, 1.57e6 N/m, for both pressures", "1 GPa takes 3.925e5 N/m", _load),
    Slip(
        "Eq. (6) and its boundary conditions only",
        "P >= p_atm/p_h, and P = p_atm/p_h where the film cavitates",
        _cavitation,
    ),
    Slip("Eq. (19): c is a damping factor", "c < 0: too little load must lower H00", _sign_of_c),
    Slip("Section 2.4: Q = V eps0 on the walls", "V itself, a Dirichlet condition", _wall_charge),
    Slip(
        "Eqs. (A1) to (A5) for any grid",
        "they hold for square cells; else a1 and a3 times (dy/dx)^2, a0 their new sum, Q = rho_q dy^2",
        _square_cells,
    ),
    Slip("Figure 6: M68", "M69.5", _m68),
    Slip(
        "Section 3.1: the field strength 'increases linearly with minimum film thickness'",
        "it goes inversely with it",
        _inverse,
    ),
    Slip("Section 3.1: 0.8 A m^-2", "0.8 A mm^-2", _current_density),
    Slip(
        "Stationary roughness under rolling surfaces called 'pure rolling'",
        "the stationary problem describes a rough surface at rest, the other sliding over it",
        lambda _: (
            "roughness of a rolling surface travels with it, and eq. (6) then needs the squeeze term "
            "d(rho H)/dT; the rough films here are stationary as well, and state it"
        ),
    ),
    Slip("Mid-film 'as defined by half of the average film thickness'", "the line s = 1/2", _readings),
)
