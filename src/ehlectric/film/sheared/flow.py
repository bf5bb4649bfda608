"""Flow of a shear-thinning oil through the faces of a grid, with its derivatives.

A face has the mean film thickness and density of its two nodes and the logarithmic mean of their fluidities,
as for a Newtonian oil (``ehlectric.film.flow.mean_fluidity``). Where the viscosity varies across the film,
the logarithm of its ratio to the viscosity of the reference temperature is the mean of the two nodes. The
mass flux relative to the mean speed of the surfaces is, with the dimensionless flux of a column (``column``),

    F = (12/lambda) H^2 S flux(a, w, q, g),    q = H dP/dX/S,    g = lambda SRR/(12 H S)

Stresses are over p_h b/R, and S is the characteristic stress of the law. F is the mass
flux less the mean density times u_m h. The wedge term is therefore that of a Newtonian oil with the mean
density across the film.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.flow import (
    Coefficients,
    FaceFlow,
    Flow,
    Fluid,
    Sides,
    evaluate,
    logarithmic_mean,
    with_mirror,
)
from ehlectric.film.mesh import Mesh
from ehlectric.film.sheared.columns import Columns, columns_of
from ehlectric.film.sheared.even import Flux
from ehlectric.film.sheared.faces import flux_of
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.sheared.profile import Across, Profile, Properties, over_columns

# Degree of the polynomial across a film without a temperature profile, for stresses and speeds.
_DEGREE = 8


@dataclass(frozen=True)
class ShearedFlow:
    """Flow law of a shear-thinning oil, a value of ``Fluid.flow``.

    Attributes
    ----------
    rheology : Rheology
        Shear-thinning law.
    stress_scale : float
        Unit of the shear stress, p_h b/R [Pa], with half-width b and reduced radius R along entrainment.
    pressure_scale : float
        Hertz pressure p_h [Pa].
    slide_to_roll_ratio : float
        Slip of the surfaces over their mean speed, (u_2 - u_1)/u_m: positive where surface 2 is faster. The
        ratio of a case is its negative.
    profile : Profile or None
        Viscosity and density across the film, at a fixed temperature; None where they are uniform.

    Examples
    --------
    Between parallel surfaces an Eyring oil flows faster than a Newtonian one:

    >>> constant = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(constant, isoviscous, velocity_parameter=0.1, ambient_pressure=0.0)
    >>> pressure, mesh = np.array([[0.0], [1.0], [2.0]]), Mesh.over(3, 0.0, 1.0)
    >>> law = ShearedFlow(Rheology("eyring", {"eyring_stress": 5e6}), stress_scale=1e7, pressure_scale=1e9)
    >>> law(fluid, pressure, np.ones((3, 1)), mesh).along.flux[:, 0].round(1)
    array([58.5, 58.5])
    """

    rheology: Rheology
    stress_scale: float
    pressure_scale: float
    slide_to_roll_ratio: float = 0.0
    profile: Profile | None = None

    def __call__(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
        """Flow through all faces at P (nx, ny) and H (nx, ny) on a mesh."""
        k, properties = self._evaluate(fluid, pressure, thickness, mesh)
        nodes = _Nodes.of(k, properties, pressure, thickness)
        slip = fluid.velocity_parameter * self.slide_to_roll_ratio / 12.0
        if mesh.dy is None:
            return Flow(k, self._through(nodes, mesh.dx, slip, fluid, None), None)
        by_x, by_y = gradients(pressure, mesh)
        along = self._through(nodes, mesh.dx, slip, fluid, by_y)
        turned = nodes.turned(mesh)
        across = self._through(turned, mesh.dy, slip, fluid, with_mirror(by_x, mesh).T, across=True)
        return Flow(k, along, across)

    def columns(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Columns:
        """Stress, shear rate and speed across the film at the nodes, with central differences of P."""
        k, properties = self._evaluate(fluid, pressure, thickness, mesh)
        clipped = np.maximum(pressure, fluid.ambient_pressure)
        degree = _DEGREE if self.profile is None else self.profile.across.zeta.size - 1
        viscosity = np.exp(k.log_viscosity)[np.newaxis]
        density = k.density[np.newaxis]
        if properties is not None:
            viscosity = viscosity * np.exp(properties.log_ratio)
            density = properties.density
        return columns_of(
            self.rheology,
            Across.of(degree),
            (viscosity, density),
            gradient=np.stack(gradients(pressure, mesh)),
            thickness=thickness,
            scale=self._scale(clipped)[0],
            slip=fluid.velocity_parameter * self.slide_to_roll_ratio / 12.0,
            speed_unit=12.0 / fluid.velocity_parameter,
        )

    def _evaluate(
        self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh
    ) -> tuple[Coefficients, Properties | None]:
        """Coefficients at the nodes, with the mean density across the film, and the profile's properties."""
        k = evaluate(fluid, pressure, thickness)
        if self.profile is None:
            return k, None
        properties = self.profile(np.maximum(pressure, fluid.ambient_pressure), mesh)
        weights = over_columns(self.profile.across.weights, pressure)
        density = np.sum(weights * properties.density, axis=0)
        return (
            replace(
                k,
                density=density,
                density_p=np.sum(weights * properties.density_p, axis=0),
                eps=k.eps * density / k.density,
                eps_p=k.eps_p * density / k.density,
                eps_h=k.eps_h * density / k.density,
            ),
            properties,
        )

    def _scale(self, pressure: Array) -> tuple[Array, Array]:
        """Characteristic stress of the law over ``stress_scale``, and its derivative by P."""
        rheology = self.rheology
        scale, slope = rheology.law.scale(pressure * self.pressure_scale, rheology.constants)
        return scale / self.stress_scale, slope * self.pressure_scale / self.stress_scale

    def _through(
        self,
        nodes: _Nodes,
        spacing: float,
        slip: float,
        fluid: Fluid,
        beside: Array | None,
        *,
        across: bool = False,
    ) -> FaceFlow:
        """Flow along the first axis; ``beside`` is the gradient of P along the other axis at the nodes."""
        mean, by_before, by_after = logarithmic_mean(nodes.log_viscosity, nodes.fluidity)
        gap = _mean(nodes.thickness)
        difference = np.diff(nodes.pressure, axis=0)
        lowest = fluid.ambient_pressure
        scale, scale_p = self._scale(np.maximum(_mean(nodes.pressure), lowest))
        gradient = (gap / spacing * difference / scale)[np.newaxis]
        sliding = (slip / (gap * scale))[np.newaxis]
        if beside is not None:
            # The derivatives by the gradient along the other axis are left out of the Jacobian, as they reach
            # nodes outside its stencil. They are products of both gradients; Newton's method takes a few more
            # steps without them.
            gradient = np.concatenate([gradient, (gap * _mean(beside) / scale)[np.newaxis]])
            still = np.zeros_like(sliding)
            sliding = np.concatenate([still, sliding] if across else [sliding, still])
        found = flux_of(self.rheology, mean, gradient, sliding, nodes.profile())

        size = 12.0 / fluid.velocity_parameter * gap**2 / spacing
        of_scale = found.flux - np.sum(gradient * found.by_gradient + sliding * found.by_slip, axis=0)
        of_gap = 2.0 * found.flux + np.sum(gradient * found.by_gradient - sliding * found.by_slip, axis=0)
        by_scale = 0.5 * size * of_scale * np.where(_mean(nodes.pressure) > lowest, scale_p, 0.0)
        amount = size * scale
        mass = 1.0 if nodes.layers is not None else _mean(nodes.density)
        half_gap = 0.5 * amount * mass * of_gap / gap
        before, after = nodes.by_properties(found, by_before / mean, by_after / mean)
        return FaceFlow(
            flux=amount * mass * found.flux,
            conductance=size * mass * found.by_gradient[0] * gap / spacing,
            by_properties=Sides(amount * before + mass * by_scale, amount * after + mass * by_scale),
            by_gap=Sides(half_gap, half_gap),
        )


def gradients(pressure: Array, mesh: Mesh) -> tuple[Array, Array]:
    """Central differences dP/dX and dP/dY at the nodes, one-sided on the edges, each of shape (nx, ny)."""
    by_x = np.asarray(np.gradient(pressure, mesh.dx, axis=0))
    if mesh.dy is None:
        return by_x, np.zeros_like(pressure)
    by_y = np.asarray(np.gradient(with_mirror(pressure, mesh), mesh.dy, axis=1))
    return by_x, by_y[:, 1:] if mesh.symmetric else by_y


def _mean(values: Array) -> Array:
    """Means of neighbours along the last but one axis."""
    return np.asarray(0.5 * (values[..., 1:, :] + values[..., :-1, :]))


@dataclass(frozen=True)
class _Nodes:
    """Quantities at nodes (n, m) that determine the flow along the first axis; profiles are (nz, n, m)."""

    log_viscosity: Array
    log_viscosity_p: Array
    fluidity: Array
    density: Array
    density_p: Array
    thickness: Array
    pressure: Array
    log_ratio: Array | None = None
    log_ratio_p: Array | None = None
    layers: Array | None = None
    layers_p: Array | None = None

    @classmethod
    def of(cls, k: Coefficients, properties: Properties | None, pressure: Array, thickness: Array) -> _Nodes:
        uniform = (k.log_viscosity, k.log_viscosity_p, k.fluidity, k.density, k.density_p)
        if properties is None:
            return cls(*uniform, thickness, pressure)
        varying = (properties.log_ratio, properties.log_ratio_p, properties.density, properties.density_p)
        return cls(*uniform, thickness, pressure, *varying)

    def turned(self, mesh: Mesh) -> _Nodes:
        """Quantities with the axes swapped, and the mirror image of a symmetric mesh."""

        def turn(values: Array) -> Array:
            if mesh.symmetric:
                values = np.concatenate([values[..., 1:2], values], axis=-1)
            return np.swapaxes(values, -1, -2)

        fields = {name: value for name, value in vars(self).items() if value is not None}
        return _Nodes(**{name: turn(value) for name, value in fields.items()})

    def profile(self) -> tuple[Array, Array] | None:
        """Logarithm of the viscosity ratio and density across the film at the faces, (nz, n - 1, m)."""
        if self.log_ratio is None or self.layers is None:
            return None
        return _mean(self.log_ratio), _mean(self.layers)

    def by_properties(self, found: Flux, before: Array, after: Array) -> tuple[Array, Array]:
        """Derivatives of the mass flux by P of both nodes through viscosity and density.

        ``before`` and ``after`` are the derivatives of ln of the mean fluidity by ln eta of both nodes.
        """
        of_all = -np.sum(found.by_viscosity, axis=0)
        sides = []
        for side, log_mean in ((slice(None, -1), before), (slice(1, None), after)):
            uniform = of_all * log_mean * self.log_viscosity_p[side]
            if self.log_ratio_p is None or self.layers_p is None or found.by_weight is None:
                sides.append(_mean(self.density) * uniform + 0.5 * found.flux * self.density_p[side])
                continue
            varying = (
                found.by_viscosity * self.log_ratio_p[:, side] + found.by_weight * self.layers_p[:, side]
            )
            sides.append(uniform + 0.5 * np.sum(varying, axis=0))
        return sides[0], sides[1]
