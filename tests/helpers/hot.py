"""Oils, bodies and columns of heated films, for tests."""

import numpy as np

from ehlectric.film.across_film import Across
from ehlectric.film.deflection import LINE, point_geometry
from ehlectric.film.energy_equation import (
    FrozenTemperature,
    Heat,
    HeatColumns,
    Stream,
    Surface,
    solve_energy,
    stream_of,
)
from ehlectric.film.face_flow import Fluid
from ehlectric.film.hot_oil import Body, HotOil, Physics, Thermal
from ehlectric.film.mesh import Mesh, Width, at_centre
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.film.shear_flow import ShearedFlow
from ehlectric.film.shear_laws import Rheology
from ehlectric.formulas.film_line import velocity_parameter
from ehlectric.lubricant.density import dowson_higginson, incompressible
from ehlectric.lubricant.electrical_laws import constant_permittivity
from ehlectric.lubricant.oil import BoundLaw, OfDensity, Oil
from ehlectric.lubricant.viscosity import barus, roelands

STEEL = {"thermal_conductivity": 46.0, "heat_capacity": 470.0, "density": 7850.0}


def steel(temperature, **other):
    """Body of steel with a bulk temperature [K]; ``other`` properties may differ."""
    return Body(temperature, **(STEEL | other))


def cold_surface(temperature, nodes):
    """Surface that stays at its temperature [K], whatever heat flows into it."""
    downstream = np.zeros(nodes)
    downstream[0] = 1e-14
    return Surface(temperature, downstream, np.zeros(nodes))


def channel(u, *, degree=12, nodes=41, length=1e-3, thickness=1e-6, conductivity=0.14, **other):
    """Stream of a channel with constant thickness; ``u`` [m/s] is a function of zeta or a number."""
    across = Across.of(degree)
    shape = (across.zeta.size, nodes, 1)
    speed = u(across.zeta) if callable(u) else np.full(across.zeta.size, u)
    zeros = np.zeros(shape)
    values = {
        "v": zeros,
        "density": np.full(shape, 870.0),
        "heat_capacity": np.full(shape, 1.74e6),
        "conductivity": np.full(shape, conductivity),
        "heating": zeros,
        "heating_slope": zeros,
        "compression": zeros,
        "compression_p": zeros,
        "expansion": zeros,
    }
    return Stream(
        across=across,
        dx=length / (nodes - 1),
        dy=0.0,
        symmetric=False,
        thickness=np.full(shape[1:], thickness),
        filling=np.ones(shape[1:]),
        u=np.broadcast_to(speed[:, np.newaxis, np.newaxis], shape).copy(),
        **(values | other),
    )


def hot_oil(viscosity=0.04, alpha=None, roelands_z=0.68, at=313.15, expansion=6.5e-4, conductivity=0.14):
    """Oil over temperature: Roelands with S0 = 1.1, Dowson and Higginson with thermal expansion.

    ``alpha`` is the pressure-viscosity coefficient at ``at``; by default that of Roelands for this viscosity.
    """
    p0 = 1.96e8 if alpha is None else 1.98e8

    def oil_at(temperature):
        reduced = np.log(viscosity) + 9.67
        warmer = ((temperature - 138.0) / (at - 138.0)) ** -1.1
        eta = np.exp(reduced * warmer - 9.67)
        slope = warmer * (roelands_z * reduced / p0 if alpha is None else alpha)
        law = {"pressure_viscosity_coefficient": slope, "roelands_z": roelands_z, "roelands_pressure": p0}
        return Oil(
            eta,
            2.2,
            0.0,
            BoundLaw(roelands, law, temperature),
            BoundLaw(dowson_higginson, {"density_c1": 0.59e9, "density_c2": 1.34}, temperature),
            OfDensity(BoundLaw(constant_permittivity, {"relative_permittivity": 2.2})),
            temperature=temperature,
            density=870.0 * (1.0 - expansion * (temperature - at)),
            thermal_conductivity_law=lambda p: (np.full_like(p, conductivity), np.zeros_like(p)),
            heat_capacity_law=lambda p: (np.full_like(p, 870.0 * 2000.0), np.zeros_like(p)),
        )

    return oil_at


def hot_contact(
    oil_at,
    *,
    max_pressure=1e9,
    speed=4.0,
    slide_to_roll_ratio=0.0,
    radius=0.01,
    modulus=226e9,
    rheology=None,
    nodes=401,
    inlet=-6.0,
    outlet=2.0,
    temperature=313.15,
    heat=True,
    body=None,
    **options,
):
    """Problem of a contact with heat, between bodies of steel at the temperature of the oil.

    It is a line contact, or with a ``width`` a circular one.
    """
    line = "width" not in options
    circle = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2)
    half_width = (4.0 if line else np.pi) * radius * max_pressure / modulus
    oil = oil_at(temperature)
    fluid = Fluid(
        density=lambda p: _scaled(oil.density_ratio, p, max_pressure),
        log_viscosity=lambda p: _scaled(oil.log_viscosity, p, max_pressure),
        velocity_parameter=velocity_parameter(
            viscosity=oil.viscosity,
            entrainment_speed=speed,
            radius=radius,
            half_width=half_width,
            max_pressure=max_pressure,
        ),
        ambient_pressure=0.0,
    )
    slip = 0.5 * slide_to_roll_ratio * speed
    thermal = Thermal(
        (steel(temperature, **(body or {})), steel(temperature, **(body or {}))),
        temperature,
        HotOil.through(oil_at, temperature - 30.0, temperature + 300.0),
    )
    physics = Physics(
        rheology or Rheology("newtonian", {}),
        (speed - slip, speed + slip),
        oil.viscosity,
        thermal if heat else None,
    )
    scale = half_width**2 / radius
    guess = 1e-6 * 0.3 * (speed * oil.viscosity / 0.04) ** 0.7 / scale
    return FilmProblem(
        fluid,
        nodes,
        inlet,
        outlet,
        thickness_guess=guess,
        wedge_order=3,
        scales=Scales(half_width, max_pressure, scale, 0.0),
        physics=physics,
        geometry=LINE if line else circle,
        **options,
    )


def _scaled(law, pressure, scale):
    value, slope = law(scale * pressure)
    return value, scale * slope


def paper_line(**options):
    """Line contact of Morris et al. (2022) at 1 GPa with heat, between bodies of steel."""
    oil = hot_oil(alpha=22e-9, roelands_z=0.67)
    return hot_contact(oil, **({"radius": 14.1e-3, "inlet": -4.0} | options))


def ball(nodes=65, **options):
    """Circular contact with heat on ``nodes`` nodes along both axes."""
    domain = {"nodes": nodes, "inlet": -4.5, "outlet": 1.5, "width": Width(nodes, 3.0)}
    return hot_contact(hot_oil(), **(domain | {"max_pressure": 0.7e9} | options))


def couette(nahme, reduced_rate=None, *, degree=12, loops=60):
    """Oil between surfaces at one temperature that slide, far from the entry, at the nodes across.

    The viscosity is eta0 exp(-beta (T - T_w)). The functions are those of a contact: flow with a frozen
    temperature, its heat, and the march of the energy equation. The result is theta = beta (T - T_w) and the
    uniform stress over eta0 U/h.
    """
    beta, eta, conductivity, wall, gap, length = 0.03, 0.01, 0.14, 300.0, 1e-6, 1.0
    slip = np.sqrt(nahme * conductivity / (beta * eta))
    speed, hertz = 2.0 * slip, 1e9
    law = Rheology("newtonian")
    if reduced_rate is not None:
        law = Rheology("eyring", {"eyring_stress": eta * slip / (gap * reduced_rate)})
    none = BoundLaw(barus, {"pressure_viscosity_coefficient": 0.0})
    eps = OfDensity(BoundLaw(constant_permittivity, {"relative_permittivity": 2.2}))

    def oil_at(temperature):
        return Oil(
            eta * np.exp(-beta * (temperature - wall)),
            2.2,
            0.0,
            none,
            BoundLaw(incompressible, {}),
            eps,
            density=870.0,
            thermal_conductivity_law=lambda p: (np.full_like(p, conductivity), np.zeros_like(p)),
            heat_capacity_law=lambda p: (np.full_like(p, 1.74e6), np.zeros_like(p)),
        )

    oil = HotOil.through(oil_at, wall - 10.0, wall + 200.0)
    mesh, across = Mesh.over(9, 0.0, 1.0), Across.of(degree)
    flat = np.ones(mesh.shape)
    fluid = Fluid(
        lambda p: (np.ones_like(p), np.zeros_like(p)),
        lambda p: (np.zeros_like(p), np.zeros_like(p)),
        velocity_parameter=12.0 * eta * speed * length / (gap**2 * hertz),
        ambient_pressure=0.0,
    )
    stress = hertz * gap / length
    zeros = np.zeros((degree + 1, *mesh.shape))
    heat = Heat(zeros + wall, zeros[:2], zeros)
    for _ in range(loops):
        profile = FrozenTemperature(across, mesh, heat, 0.0 * flat, oil, wall, hertz)
        flow = ShearedFlow(law, stress, hertz, slip / speed, profile)
        columns = flow.columns(fluid, 0.0 * flat, flat, mesh)
        stream = stream_of(
            oil,
            columns,
            heat.temperature,
            pressure=0.0 * flat,
            thickness=gap * flat,
            filled=flat,
            mesh=mesh,
            length=length,
            pressure_scale=hertz,
            speed=speed,
            stress=stress,
        )
        surfaces = (cold_surface(wall, mesh.x.size), cold_surface(wall, mesh.x.size))
        heat = solve_energy(HeatColumns.of(stream, heat.temperature), surfaces, heat, inlet_temperature=wall)
    theta = beta * (heat.temperature[:, -1, 0] - wall)
    return across.zeta, theta, columns.middle[0, -1, 0] * stress * gap / (eta * slip)


def films(solution):
    """Central and minimum film thickness of the film with heat and of that without [um]."""
    found = []
    for grid in (solution.refined.last, solution.simple.last):
        thickness = 1e6 * solution.refined.problem.scales.thickness * grid.state.thickness
        found += [at_centre(grid.level.mesh, thickness), float(thickness.min())]
    return found


def random_contact(seed, *, point=False, nodes=None):
    """Random contact: 0.5 to 2 GPa, 0.5 to 20 m/s, Eyring stress of 3 to 10 MPa.

    The slide-to-roll ratio is 0 to 2 in a line contact, and 0 to 0.5 in a point contact.
    """
    rng = np.random.default_rng(seed)
    options = {
        "max_pressure": rng.uniform(0.5e9, 2e9),
        "speed": np.exp(rng.uniform(np.log(0.5), np.log(20.0))),
        "slide_to_roll_ratio": rng.uniform(0.0, 0.5 if point else 2.0),
        "rheology": Rheology("eyring", {"eyring_stress": rng.uniform(3e6, 1e7)}),
    }
    if point:
        return ball(nodes=nodes or 65, **options)
    return paper_line(nodes=nodes or 401, **options)
