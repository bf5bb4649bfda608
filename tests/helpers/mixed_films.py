"""Films of rough contacts whose surfaces may touch, dimensionless on their grid, and their key figures."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from ehlectric import Case
from ehlectric.contact.preparation import prepare
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution
from ehlectric.film.problem import FilmProblem
from ehlectric.runtime.threads import quiet_solution

RADIUS, MODULUS = 14.1e-3, 226e9

# Point contact of 20 N on a ball of 10 mm: p_h 0.68 GPa, semi-axis 118 um.
BALL = {"geometry": "point", "radius_x": 10e-3, "radius_y": 10e-3, "reduced_modulus": MODULUS, "load": 20.0}
BALL_OIL = {"viscosity": 0.04, "pressure_viscosity_coefficient": 20e-9, "base": "paper"}


@dataclass(frozen=True)
class MixedFilm:
    """Film on its finest grid, and the solutions that led to it."""

    problem: FilmProblem
    solutions: list[GridSolution]

    @property
    def last(self):
        return self.solutions[-1]

    @property
    def converged(self):
        return self.last.status == "converged"

    @property
    def mesh(self):
        return self.last.level.mesh

    @property
    def pressure(self):
        """Pressure of oil and asperities together, P (nx, ny)."""
        return self.last.state.pressure

    @property
    def oil_pressure(self):
        return self.last.state.oil_pressure

    @property
    def contact_pressure(self):
        return np.broadcast_to(self.last.state.contact_pressure, self.mesh.shape)

    @property
    def gap(self):
        return self.last.state.thickness

    @property
    def touching(self):
        return self.contact_pressure > 0.0

    @property
    def share(self):
        """Share of the load that asperities carry."""
        return self._integral(self.contact_pressure) / self.last.level.load

    @property
    def area(self):
        """Area of the spots, b^2, or their length in a line contact, b."""
        return self._integral(self.touching)

    @property
    def zone(self):
        """Nodes in the Hertz zone, as a mask (nx, ny)."""
        mesh = self.mesh
        across = 0.0 if mesh.y.size == 1 else (mesh.y / self._half_width_across) ** 2
        mask = mesh.x[:, np.newaxis] ** 2 + across < 1.0
        return np.broadcast_to(mask, mesh.shape)

    @property
    def film_outside(self):
        """Mean gap over the Hertz zone outside the spots [m]; the boundary film where there is none."""
        outside = self.zone & ~self.touching
        if not outside.any():
            return self.problem.boundary_film * self.problem.scales.thickness
        return float(np.mean(self.gap[outside])) * self.problem.scales.thickness

    @property
    def oil(self):
        """Oil that spots swallow, that spots make, and that other nodes make, over the mean flow.

        It is the integral of the residual of the Reynolds equation, negative or positive, over the mass that
        the mean gap of the Hertz zone carries through it. Where oil does not fill the gap, more may leave a
        node than reaches it. Such oil counts as made only where the gap is full again further downstream in
        the Hertz zone: the condition for cavitation fills it there, whatever reaches it.
        """
        final, zone = self.last.final, self.zone
        carried = float(np.mean((final.coefficients.density * self.gap)[zone]))
        if self.mesh.y.size > 1:
            carried *= 2.0 * self._half_width_across
        full = zone & (self.oil_pressure > self.problem.fluid.ambient_pressure)
        refilled = np.logical_or.accumulate(full[::-1], axis=0)[::-1]
        r = final.reynolds
        made = refilled & (r > 0.0)
        parts = (self.touching & (r < 0.0), self.touching & made, zone & ~self.touching & made)
        return tuple(abs(self._integral(np.where(part, r, 0.0))) / carried for part in parts)

    @property
    def _half_width_across(self):
        """Semi-axis of the dry contact across entrainment over that along it."""
        return self.problem.geometry.load / (2.0 * np.pi / 3.0)

    @property
    def krylov(self):
        """GMRES iterations on the finest grid, from all starts."""
        finest = [each for each in self.solutions if each.level.mesh.shape == self.mesh.shape]
        return sum(step.krylov_iterations for each in finest for step in each.steps)

    @property
    def steps(self):
        """Newton steps on the finest grid, from all of its starts."""
        finest = [each for each in self.solutions if each.level.mesh.shape == self.mesh.shape]
        return sum(len(each.steps) for each in finest)

    def _integral(self, values):
        return float(np.vdot(self.last.level.weights, np.asarray(values, dtype=float)))


def posed(case):
    """Film problem of a case of either kind, with its rough surfaces."""
    prepared = prepare(case)
    return prepared.kind.film_problem(prepared.case, prepared.conditions, prepared.rough)


def on_few_nodes(case, nodes):
    """Film problem of a point contact on fewer nodes than a case takes, along and across entrainment."""
    problem = posed(case)
    return replace(problem, nodes=nodes, width=replace(problem.width, nodes=nodes))


def mixed_film(case, *, boundary_film=None):
    """Film of a case, equal to that of ``solve`` without ``refine``; ``boundary_film`` [m] may be zero."""
    problem = posed(case) if isinstance(case, Case) else case
    if boundary_film is not None:
        problem = replace(problem, boundary_film=boundary_film / problem.scales.thickness)
    with quiet_solution():
        return MixedFilm(problem, nested_iteration(problem, None))


def rough_line(*tables, nodes=801, speed=0.1, load=3e5, grid=(), **contact):
    """Line contact with rough tables."""
    contact = {"reduced_radius": RADIUS, "reduced_modulus": MODULUS, "load_per_length": load} | contact
    return Case.from_dict(
        {
            "contact": contact | {"entrainment_speed": speed},
            "lubricant": {"base": "paper"},
            "roughness": [{"surface": 1} | table for table in tables],
            "grid": {"nodes": nodes} | dict(grid),
        }
    )


def rough_point(*tables, nodes=65, speed=0.01, grid=(), **contact):
    """Point contact of a ball on a flat with rough tables."""
    return Case.from_dict(
        {
            "contact": BALL | {"entrainment_speed": speed} | contact,
            "lubricant": BALL_OIL,
            "roughness": [{"surface": 1} | table for table in tables],
            "grid": {"nodes": nodes, "inlet": -2.5, "outlet": 1.5, "side": 1.6} | dict(grid),
        }
    )


def central_film(case):
    """Central film of smooth surfaces by the formula that also scales the first guess [m]."""
    problem = posed(case.replace({"roughness": ()}))
    return problem.thickness_guess * problem.scales.thickness


def at_film(case, film):
    """Case at the speed at which the formula gives a film [m]."""

    def off(exponent):
        return np.log(central_film(case.replace({"contact.entrainment_speed": np.exp(exponent)})) / film)

    return case.replace({"contact.entrainment_speed": float(np.exp(brentq(off, -20.0, 9.0, xtol=1e-6)))})


def sinusoid(amplitude, wavelength, **more):
    return {"generator": "sinusoid", "amplitude": amplitude, "wavelength": wavelength} | more


def gaussian(rq, correlation_length, seed=1, **more):
    return {"generator": "gaussian", "rq": rq, "correlation_length": correlation_length, "seed": seed} | more
