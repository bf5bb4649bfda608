"""Contacts, temperature profiles and traction, for tests of sheared films and a figure of the guide."""

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.film.across_film import Across, Properties
from ehlectric.film.deflection import point_geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.mesh import Mesh, Width, on_mesh
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.film.shear_flow import ShearedFlow, filled_part, traction
from ehlectric.formulas.film_line import velocity_parameter
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.viscosity import roelands

# Contact of the friction tests: reduced radius [m], reduced modulus [Pa], viscosity [Pa s], Roelands'
# exponent and pressure [Pa]; pressure-viscosity coefficient z (ln eta0 + 9.67)/p0.
RADIUS, MODULUS, VISCOSITY, EXPONENT, ROELANDS_PRESSURE = 0.01, 226e9, 0.04, 0.68, 1.96e8
ALPHA = EXPONENT * (np.log(VISCOSITY) + 9.67) / ROELANDS_PRESSURE
AMBIENT = 1e5


def fluid_of(max_pressure, half_width, speed, flow):
    """Oil after Roelands and Dowson and Higginson over P = p/p_h."""

    def log_viscosity(p):
        value, slope = roelands(
            p * max_pressure,
            pressure_viscosity_coefficient=ALPHA,
            roelands_z=EXPONENT,
            roelands_pressure=ROELANDS_PRESSURE,
        )
        return value, slope * max_pressure

    def density(p):
        value, slope = dowson_higginson(p * max_pressure, density_c1=5.9e8, density_c2=1.34)
        return value, slope * max_pressure

    parameter = velocity_parameter(
        viscosity=VISCOSITY,
        entrainment_speed=speed,
        radius=RADIUS,
        half_width=half_width,
        max_pressure=max_pressure,
    )
    return Fluid(density, log_viscosity, parameter, AMBIENT / max_pressure, flow)


def flow_of(rheology, max_pressure, half_width, ratio):
    """Flow law of the rheology; the Newtonian law of ``FLOWS`` for None."""
    if rheology is None:
        return "newtonian"
    return ShearedFlow(rheology, max_pressure * half_width / RADIUS, max_pressure, ratio)


def line_contact(max_pressure=1e9, speed=4.0, ratio=0.0, rheology=None, nodes=401):
    """Film problem of a line contact: p_h [Pa], u_m [m/s], slide-to-roll ratio and shear-thinning law."""
    half_width = 4.0 * RADIUS * max_pressure / MODULUS
    flow = flow_of(rheology, max_pressure, half_width, ratio)
    scales = Scales(half_width, max_pressure, half_width**2 / RADIUS, AMBIENT)
    guess = 0.4e-6 * speed**0.7 / scales.thickness
    fluid = fluid_of(max_pressure, half_width, speed, flow)
    return FilmProblem(fluid, nodes, -6.0, 2.0, guess, scales=scales, max_iterations=60)


def circular_contact(max_pressure=1e9, speed=4.0, ratio=0.0, rheology=None, nodes=65):
    """Film problem of a circular contact, as ``line_contact``."""
    line = line_contact(max_pressure, speed, ratio, rheology, nodes)
    half_width = np.pi * RADIUS * max_pressure / MODULUS
    scales = Scales(half_width, max_pressure, half_width**2 / RADIUS, AMBIENT)
    return replace(
        line,
        fluid=fluid_of(max_pressure, half_width, speed, flow_of(rheology, max_pressure, half_width, ratio)),
        inlet=-4.5,
        outlet=1.5,
        thickness_guess=0.25e-6 * speed**0.67 / scales.thickness,
        scales=scales,
        geometry=point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2),
        width=Width(nodes, 3.0),
        tolerance=1e-8,
    )


@dataclass(frozen=True)
class Warm:
    """Profile of a made-up temperature: ln eta falls by (1 + s P) T, the density by 0.05 T (1 - P/10)."""

    across: Across
    temperature: np.ndarray
    mesh: Mesh
    fluid: Fluid
    steepness: float = 1.0

    def __call__(self, pressure, mesh):
        temperature = on_mesh(self.temperature, self.mesh, mesh)
        density, density_p = self.fluid.density(pressure)
        part = 1.0 - 0.05 * temperature * (1.0 - 0.1 * pressure)
        return Properties(
            -(1.0 + self.steepness * pressure) * temperature,
            -self.steepness * temperature * np.ones_like(pressure),
            density * part,
            density_p * part + density * 0.005 * temperature,
        )


def solved(problem):
    """Solution on the grid of the problem, which must converge."""
    solution = nested_iteration(problem, None)[-1]
    assert solution.status == "converged"
    return solution


def friction(problem, solution):
    """Traction of a solved contact, with the cavitated film behind it."""
    law, state, level = problem.fluid.flow, solution.state, solution.level
    columns = law.columns(problem.fluid, state.pressure, state.thickness, level.mesh)
    return traction(
        columns,
        state.thickness,
        level.mesh,
        load=level.load,
        stress_ratio=law.stress_scale / law.pressure_scale,
        filled=filled_part(solution.final.full_film, columns.density.mean(axis=0) * state.thickness),
    )
