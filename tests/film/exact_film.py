"""A film chosen freely, and the added gap and the source that make it the exact solution.

With t from -1 to 1 over the domain the pressure is P = c (1 - t^2)^(5/2) (1 + t/4). P sqrt(1 - t^2) is a
sum of Chebyshev polynomials T_n, whose logarithmic potentials have closed forms: the integral of
ln|t - s| T_n(s)/sqrt(1 - s^2) over s is -pi T_n(t)/n, and -pi ln 2 for n = 0 (J. C. Mason and
D. C. Handscomb, Chebyshev Polynomials, 2003, chapter 9). The exponent 5/2 is smooth enough for second
order, and not so flat at the ends that a discrete pressure falls below the ambient there.
"""

import numpy as np
import sympy
from numpy.polynomial import chebyshev, polynomial

from ehlectric.film.face_flow import MEAN_MOBILITY, Fluid
from ehlectric.film.problem import FilmProblem
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.viscosity import roelands

INLET, OUTLET = -1.9, 1.3
MIDDLE, HALF = 0.5 * (INLET + OUTLET), 0.5 * (OUTLET - INLET)
H00 = -0.25
VELOCITY_PARAMETER = 0.05
SKEW = 0.25

# The paper's lubricant at the Hertz pressure 0.7 GPa: the viscosity rises 9e4-fold.
_P_H = 0.7e9
VISCOSITY = {
    "pressure_viscosity_coefficient": 22e-9 * _P_H,
    "roelands_z": 0.67,
    "roelands_pressure": 0.198e9 / _P_H,
}
DENSITY = {"density_c1": 0.59e9 / _P_H, "density_c2": 1.34}

# (1 - t^2)^3 (1 + SKEW t) in Chebyshev polynomials. P over t integrates to pi times the first coefficient,
# and over X it is to be pi/2.
_SERIES = chebyshev.poly2cheb(polynomial.polymul(polynomial.polypow([1, 0, -1], 3), [1, SKEW]))
_SCALE = 0.5 / (HALF * _SERIES[0])


def _expressions():
    x = sympy.Symbol("x")
    t = (x - MIDDLE) / HALF
    pressure = _SCALE * (1 - t**2) ** sympy.Rational(5, 2) * (1 + SKEW * t)
    # A parabola that closes towards the exit and has a constriction there.
    thickness = 0.15 + (x - 0.2) ** 2 / 10 - 0.03 * sympy.exp(-4 * (x - 0.7) ** 2)
    c1, c2 = DENSITY["density_c1"], DENSITY["density_c2"]
    density = (c1 + c2 * pressure) / (c1 + pressure)
    alpha, z, p0 = VISCOSITY.values()
    viscosity = sympy.exp(alpha * p0 / z * ((1 + pressure / p0) ** z - 1))
    eps = density * thickness**3 / (viscosity * VELOCITY_PARAMETER)
    source = sympy.diff(density * thickness, x) - sympy.diff(eps * sympy.diff(pressure, x), x)
    return [sympy.lambdify(x, expression) for expression in (pressure, thickness, source)]


_pressure, thickness, _source = _expressions()


def _inside(x):
    """Nodes at the ends, whose t is one but for rounding, would have roots of negative numbers."""
    return np.clip(x, INLET + 1e-14, OUTLET - 1e-14)


def pressure(x):
    return _pressure(_inside(x))


def deflection(x):
    """Gap opened by the pressure, -(1/pi) times the integral of ln|X - X'| P(X')."""
    orders = np.arange(1, _SERIES.size)
    potential = chebyshev.chebval((x - MIDDLE) / HALF, np.append(0.0, _SERIES[1:] / orders))
    return HALF * _SCALE * (potential + _SERIES[0] * (np.log(2.0) - np.log(HALF)))


def problem(nodes, *, wedge_order, law=MEAN_MOBILITY):
    """The film problem whose exact solution this is."""

    def column(values):
        return values[:, np.newaxis]

    return FilmProblem(
        Fluid(
            density=lambda p: dowson_higginson(p, **DENSITY),
            log_viscosity=lambda p: roelands(p, **VISCOSITY),
            velocity_parameter=VELOCITY_PARAMETER,
            ambient_pressure=0.0,
            flow=law,
        ),
        nodes,
        inlet=INLET,
        outlet=OUTLET,
        thickness_guess=0.15,
        wedge_order=wedge_order,
        added_gap=lambda x, _: column(thickness(x) - H00 - 0.5 * x**2 - deflection(x)),
        source=lambda x, _: column(_source(_inside(x))),
    )
