"""Flow of a shear-thinning oil through the faces of a grid, with its derivatives, the stress across the
film, and traction.

A face has the mean film thickness and density of its two nodes and the logarithmic mean of their fluidities,
as for a Newtonian oil (``ehlectric.film.face_flow.mean_fluidity``). If the viscosity varies across the
film, the logarithm of its ratio to the viscosity of the reference temperature is the mean of the two nodes.
The mass flux relative to the mean speed of the surfaces is, with the dimensionless flux of a column
(``ehlectric.film.shear_stress``),

    F = (12/lambda) H^2 S flux(a, w, q, g),    q = H dP/dX/S,    g = lambda SRR/(12 H S)

Stresses are over p_h b/R, and S is the characteristic stress of the law. F is the mass
flux less the mean density times u_m h. The wedge term therefore equals the wedge term of a Newtonian oil with
the mean density across the film. Nearly all columns have stress differences below the characteristic stress,
for which few Gauss points across the film are exact. Only the columns at the pressure spike need many.

The shear stress in the film is tau = tau_m + (z - h/2) dp/dx. The mid-film stress tau_m drags both surfaces
in opposite directions, and vanishes in pure rolling. The rest, h/2 dp/dx on each surface, resists the motion
of both in the same direction. It remains in pure rolling, where the inlet has the larger film.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.film.across_film import (
    GAUSS,
    Across,
    Profile,
    Properties,
    Quadrature,
    integrals,
    over_columns,
    to_points,
)
from ehlectric.film.face_flow import (
    Coefficients,
    FaceFlow,
    Flow,
    Fluid,
    Sides,
    evaluate,
    face_mean,
    gradients,
    logarithmic_mean,
    node_mean,
    with_mirror,
)
from ehlectric.film.mesh import Mesh
from ehlectric.film.shear_laws import Rheology
from ehlectric.film.shear_stress import (
    EvenStress,
    Flux,
    column_flux,
    even_flux,
    middle_stress,
    middle_stresses,
    plane_flux,
    uniform_eyring,
)

# Number of points for a stress difference below the ``reach`` of the law.
_FEW = 12

# Largest sum of the stress difference and the range of ln(viscosity) across the film for which fewer points
# are enough, and their number for the flux and for the speeds. The part of the flux that the gradient drives
# is exact to 3e-5, the speeds are exact to 1e-7.
_SMALLEST, _FEWEST, _FEWEST_OF_SPEEDS = 0.5, 6, 8

# The same sum for which ``_FEW`` points give the speeds to 1e-6.
_SMALL = 2.0

# Relative error of the flux and of the speeds by the mid-film stress.
_EXACT, _EXACT_SPEEDS = 1e-7, 1e-9

# Number of columns, as around a pressure spike, up to which two quadratures take longer than the larger one,
# and number whose arrays at the points fit into the cache of a core.
_TOGETHER, _BLOCK = 100, 2048


def flux_of(
    rheology: Rheology,
    mean: Array,
    gradient: Array,
    slip: Array,
    profile: tuple[Array, Array] | None = None,
) -> Flux:
    """Flux along the first axis of columns with uniform properties or with a profile across the film.

    ``mean``, fluidity eta_0/eta of the columns, at the reference temperature, shape (...); ``gradient`` and
    ``slip``, q and g of ``shear_stress``, along the axis of the flux and, for d = 2, along the other axis,
    shape (d, ...); ``profile``, logarithm of the viscosity divided by the viscosity at the reference
    temperature, and the density, at the nodes across the film, shape (nz, ...). Returns flux and derivatives;
    the derivatives by viscosity and density are by the values at the nodes across the film.

    Examples
    --------
    >>> found = flux_of(Rheology(), np.ones(1), np.array([[1.2]]), np.array([[3.0]]))
    >>> round(float(found.flux[0]), 12)
    0.1

    The viscosity falls by a factor of e from surface 1 to surface 2: the oil moves more with surface 1, as
    the mean of G = (exp(zeta) - 1)/(e - 1) is (e - 2)/(e - 1).

    >>> profile = -Across.of(12).zeta[:, np.newaxis], np.ones((13, 1))
    >>> found = flux_of(Rheology(), np.ones(1), np.zeros((1, 1)), np.ones((1, 1)), profile)
    >>> values = found.flux[0], found.drift[0], 0.5 - (np.e - 2.0) / (np.e - 1.0)
    >>> [round(float(value), 6) for value in values]
    [0.081977, 0.081977, 0.081977]
    """
    if profile is None and len(gradient) == 1 and rheology.name == "eyring":
        return uniform_eyring(mean, gradient[0], slip[0])
    shape, d = mean.shape, len(gradient)
    mean, gradient, slip = mean.reshape(-1), gradient.reshape(d, -1), slip.reshape(d, -1)
    nz = 1 if profile is None else len(profile[0])
    ratio, layers = (None, None) if profile is None else (values.reshape(nz, -1) for values in profile)
    flux, by_gradient, by_slip = np.empty_like(mean), np.empty_like(gradient), np.empty_like(slip)
    by_viscosity, by_weight = np.empty((nz, mean.size)), np.empty((nz, mean.size))
    drift = np.empty_like(mean)

    def compute(part: _Part, number: int, *, estimated: bool = False) -> Array | None:
        """Flux of some columns by a number of points, and the step of their mid-film stress that is left."""
        piece = _at_points(
            rheology,
            mean[part],
            gradient[:, part],
            slip[:, part],
            None if ratio is None or layers is None else (ratio[:, part], layers[:, part]),
            Quadrature.gauss(number),
            estimated=estimated,
        )
        flux[part], by_gradient[:, part], by_slip[:, part] = piece.flux, piece.by_gradient, piece.by_slip
        by_viscosity[:, part] = piece.by_viscosity
        if piece.drift is not None:
            by_weight[:, part], drift[part] = piece.by_weight, piece.drift
        return piece.step

    grade, numbers = _grades(rheology, gradient, ratio)
    if d == 2 and not rheology.law.even and np.count_nonzero(grade == 0) > _TOGETHER:
        for start in range(0, mean.size, _BLOCK):
            block = slice(start, start + _BLOCK)
            step = compute(block, numbers[0], estimated=True)
            assert step is not None
            grade[block] = np.maximum(grade[block], step > _EXACT**0.5)
        rest = np.flatnonzero(grade)
        for part, number in _parts(grade[rest], numbers):
            compute(rest[part], number)
    else:
        for part, number in _parts(grade, numbers):
            compute(part, number)
    return Flux(
        flux.reshape(shape),
        by_gradient.reshape(d, *shape),
        by_slip.reshape(d, *shape),
        by_viscosity.reshape(nz, *shape),
        None if profile is None else by_weight.reshape(nz, *shape),
        None if profile is None else drift.reshape(shape),
    )


def _grades(
    rheology: Rheology, gradient: Array, ratio: Array | None, *, speeds: bool = False
) -> tuple[NDArray[np.intp], tuple[int, int, int]]:
    """Grade of columns (n,), and the numbers of points of the three grades that are exact enough for the
    flux, or for the ``speeds``. The other arguments are the arguments of ``flux_of``.
    """
    reach = np.zeros(gradient.shape[1]) if rheology.law.even else np.max(np.abs(gradient), axis=0)
    varied = reach if ratio is None else reach + np.max(ratio, axis=0) - np.min(ratio, axis=0)
    grade = (varied >= _SMALLEST).astype(np.intp)
    grade += varied >= _SMALL if speeds else reach >= rheology.law.reach
    return grade, (_FEWEST_OF_SPEEDS if speeds else _FEWEST, _FEW, GAUSS.offset.size)


# Some columns of an array.
_Part: TypeAlias = NDArray[np.intp] | slice


def _parts(grade: NDArray[np.intp], numbers: tuple[int, int, int]) -> list[tuple[_Part, int]]:
    """Columns (n,) of each grade, with their number of points."""
    counted = np.bincount(grade, minlength=len(numbers))
    if grade.size <= _TOGETHER:
        counted[: np.max(grade, initial=0)] = 0
    used = np.flatnonzero(counted)
    if used.size <= 1:
        return [(slice(None), numbers[k]) for k in used]
    return [(np.flatnonzero(grade == k), numbers[k]) for k in used]


def _at_points(
    rheology: Rheology,
    mean: Array,
    gradient: Array,
    slip: Array,
    profile: tuple[Array, Array] | None,
    quadrature: Quadrature,
    *,
    estimated: bool = False,
) -> Flux:
    """Flux of some columns (n,) by one quadrature, by the equations of their law and number of axes.

    The arguments are the arguments of ``flux_of`` and ``plane_flux``.
    """
    if profile is None:
        fluidity, weight = mean[np.newaxis], quadrature.offset[:, np.newaxis]
    else:
        values, below = to_points(len(profile[0]) - 1, quadrature.offset.size)
        fluidity, weight = mean * np.exp(-values @ profile[0]), below @ profile[1]
    if rheology.law.even:
        flux = even_flux(rheology, fluidity, weight, gradient, slip, quadrature)
    elif len(gradient) == 2:
        columns = fluidity, weight, gradient, slip
        flux = plane_flux(rheology, *columns, quadrature, exact=_EXACT, estimated=estimated)
    else:
        flux = column_flux(rheology, fluidity, weight, gradient[0], slip[0], quadrature)
    if profile is None or flux.by_weight is None:
        return flux
    measure = quadrature.weights[:, np.newaxis] * fluidity
    return replace(
        flux,
        by_viscosity=values.T @ flux.by_viscosity,
        by_weight=below.T @ flux.by_weight,
        drift=np.einsum("kn,kn->n", measure, weight) / np.sum(measure, axis=0),
    )


# Degree of the polynomial across a film without a temperature profile, for stresses and speeds.
_DEGREE = 8


@dataclass(frozen=True)
class ShearedFlow:
    """Flow law of a shear-thinning oil, a value of ``Fluid.flow``.

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

    rheology: Rheology  # shear-thinning law
    # Unit of the shear stress, p_h b/R [Pa], with half-width b and reduced radius R along entrainment.
    stress_scale: float
    pressure_scale: float  # Hertz pressure p_h [Pa]
    # Slip of the surfaces over their mean speed, (u_2 - u_1)/u_m: positive where surface 2 is faster. The
    # ratio of a case is its negative.
    slide_to_roll_ratio: float = 0.0
    # Viscosity and density across the film, at a fixed temperature; None where they are uniform.
    profile: Profile | None = None

    def __call__(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
        """Flow through all faces at P (nx, ny) and H (nx, ny) on a mesh."""
        k, properties = self._evaluate(fluid, pressure, thickness, mesh)
        nodes = _Nodes(k, properties, thickness, pressure)
        slip = self._slip(fluid)
        if mesh.dy is None:
            faces = [self._faces(nodes, mesh.dx, slip, fluid, None)]
        else:
            by_x, by_y = gradients(pressure, mesh)
            lateral = with_mirror(by_x, mesh).T
            faces = [
                self._faces(nodes, mesh.dx, slip, fluid, by_y),
                self._faces(nodes.turned(mesh), mesh.dy, slip, fluid, lateral, across=True),
            ]
        through = [
            self._through(each, flux, fluid)
            for each, flux in zip(faces, _fluxes(self.rheology, faces), strict=True)
        ]
        return Flow(k, through[0], None if mesh.dy is None else through[1])

    def columns(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Columns:
        """Stress, speed and heat across the film at the nodes, with central differences of P."""
        log_viscosity, density = self._across(fluid, pressure, thickness, mesh)
        gradient = np.stack(gradients(pressure, mesh))
        return self._columns(fluid, pressure, (log_viscosity, density), gradient, thickness)

    def columns_that_pass(
        self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh, speed: Array
    ) -> Columns:
        """Stress, speed and heat across the film at the nodes, with the mean speed of the mass balance.

        ``speed`` (nx, ny) is the mean speed of the oil along x over u_m; NaN where it is not known.

        Pressure and viscosity of a rough film may change by large factors from node to node. The flow through
        a face balances the flows through its neighbours. Central differences of P with the viscosity of the
        node may give arbitrary speeds. The means of the columns at both faces replace the columns of these
        nodes, and a part of the columns whose speed differs little.
        """
        properties, gradient = self._across(fluid, pressure, thickness, mesh), gradients(pressure, mesh)
        nodes = self._columns(fluid, pressure, properties, np.stack(gradient), thickness)
        part = _part_of_faces(np.abs(nodes.mean_speed - speed))
        wrong = part > 0.0
        if not wrong.any():
            return nodes
        needed = wrong[1:] | wrong[:-1]

        def at_faces(values: Array) -> Array:
            return face_mean(values)[..., needed]

        # The mean of ln eta is a geometric mean of eta: the integral of the shear stress then has the error
        # of the midpoint rule.
        log_viscosity, density = (at_faces(values) for values in properties)
        along = np.diff(pressure, axis=0)[needed] / mesh.dx
        faces = self._columns(
            fluid,
            at_faces(pressure),
            (log_viscosity, density),
            np.stack([along, at_faces(gradient[1])]),
            at_faces(thickness),
        )
        return nodes.mixed(faces, needed, part)

    def _across(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> tuple[Array, Array]:
        """Logarithm of eta/eta_0 and rho/rho_0 across the film, (nz, nx, ny), or (1, nx, ny) if uniform."""
        k, properties = self._evaluate(fluid, pressure, thickness, mesh)
        if properties is None:
            return k.log_viscosity[np.newaxis], k.density[np.newaxis]
        return k.log_viscosity + properties.log_ratio, properties.density

    def _columns(
        self,
        fluid: Fluid,
        pressure: Array,
        properties: tuple[Array, Array],
        gradient: Array,
        thickness: Array,
    ) -> Columns:
        """Columns at a pressure P, with further arguments of ``columns_of``."""
        return columns_of(
            self.rheology,
            Across.of(_DEGREE if self.profile is None else self.profile.across.zeta.size - 1),
            properties,
            gradient=gradient,
            thickness=thickness,
            scale=self._scale(np.maximum(pressure, fluid.ambient_pressure))[0],
            slip=self._slip(fluid),
            speed_unit=12.0 / fluid.velocity_parameter,
        )

    def _slip(self, fluid: Fluid) -> float:
        """Slip of the surfaces, lambda SRR/12."""
        return fluid.velocity_parameter * self.slide_to_roll_ratio / 12.0

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

    def _faces(
        self,
        nodes: _Nodes,
        spacing: float,
        slip: float,
        fluid: Fluid,
        lateral: Array | None,
        *,
        across: bool = False,
    ) -> _Faces:
        """Faces along the first axis; ``lateral`` is the gradient of P along the other axis at the nodes."""
        properties = nodes.profile
        gap = face_mean(nodes.thickness)
        difference = np.diff(nodes.pressure, axis=0)
        mean_pressure, lowest = face_mean(nodes.pressure), fluid.ambient_pressure
        scale, scale_p = self._scale(np.maximum(mean_pressure, lowest))
        gradient = (gap / spacing * difference / scale)[np.newaxis]
        sliding = (slip / (gap * scale))[np.newaxis]
        if lateral is not None:
            gradient = np.concatenate([gradient, (gap * face_mean(lateral) / scale)[np.newaxis]])
            still = np.zeros_like(sliding)
            sliding = np.concatenate([still, sliding] if across else [sliding, still])
        profile = (
            None if properties is None else (face_mean(properties.log_ratio), face_mean(properties.density))
        )
        return _Faces(
            nodes=nodes,
            spacing=spacing,
            across=across,
            mean=logarithmic_mean(nodes.uniform.log_viscosity, nodes.uniform.fluidity),
            gap=gap,
            scale=scale,
            scale_p=np.where(mean_pressure > lowest, scale_p, 0.0),
            gradient=gradient,
            slip=sliding,
            profile=profile,
        )

    def _through(self, faces: _Faces, flux: Flux, fluid: Fluid) -> FaceFlow:
        """Flow through faces along the first axis, from the flux of their columns."""
        gap, gradient, slip, spacing = faces.gap, faces.gradient, faces.slip, faces.spacing
        size = 12.0 / fluid.velocity_parameter * gap**2 / spacing
        driven, sheared = np.sum(gradient * flux.by_gradient, axis=0), np.sum(slip * flux.by_slip, axis=0)
        of_gap = 2.0 * flux.flux + driven - sheared
        by_scale = 0.5 * size * (flux.flux - driven - sheared) * faces.scale_p
        amount = size * faces.scale
        mass = face_mean(faces.nodes.uniform.density) if faces.profile is None else 1.0
        half_gap = 0.5 * amount * mass * of_gap / gap
        mean, by_before, by_after = faces.mean
        before, after = faces.nodes.by_properties(flux, by_before / mean, by_after / mean)
        drift: Array | float = 0.0
        if flux.drift is not None and not faces.across:
            drift = gap * self.slide_to_roll_ratio / spacing * flux.drift
        passing = size * mass * gap
        return FaceFlow(
            flux=amount * mass * flux.flux,
            conductance=passing / spacing * flux.by_gradient[0],
            by_lateral=passing * flux.by_gradient[1] if len(gradient) > 1 else None,
            by_properties=Sides(amount * before + mass * by_scale, amount * after + mass * by_scale),
            by_gap=Sides(half_gap, half_gap),
            drift=drift,
            drift_by_gap=0.5 * drift / gap,
        )


@dataclass(frozen=True)
class _Nodes:
    """Quantities at nodes (n, m) that determine the flow along the first axis; profiles are (nz, n, m)."""

    uniform: Coefficients
    profile: Properties | None
    thickness: Array
    pressure: Array

    def turned(self, mesh: Mesh) -> _Nodes:
        """Quantities with the axes swapped, and the mirror image of a symmetric mesh."""

        def turn(values: Array) -> Array:
            if mesh.symmetric:
                values = np.concatenate([values[..., 1:2], values], axis=-1)
            return np.swapaxes(values, -1, -2)

        uniform = Coefficients(**{name: turn(values) for name, values in vars(self.uniform).items()})
        profile = self.profile
        if profile is not None:
            profile = Properties(*(turn(values) for values in vars(profile).values()))
        return _Nodes(uniform, profile, turn(self.thickness), turn(self.pressure))

    def by_properties(self, flux: Flux, before: Array, after: Array) -> tuple[Array, Array]:
        """Derivatives of the mass flux by P of both nodes through viscosity and density.

        ``before`` and ``after`` are the derivatives of ln of the mean fluidity by ln eta of both nodes.
        """
        of_all, k, profile = -np.sum(flux.by_viscosity, axis=0), self.uniform, self.profile
        sides = []
        for side, log_mean in ((slice(None, -1), before), (slice(1, None), after)):
            uniform = of_all * log_mean * k.log_viscosity_p[side]
            if profile is None or flux.by_weight is None:
                sides.append(face_mean(k.density) * uniform + 0.5 * flux.flux * k.density_p[side])
                continue
            varying = np.einsum("k...,k...->...", flux.by_viscosity, profile.log_ratio_p[:, side])
            varying += np.einsum("k...,k...->...", flux.by_weight, profile.density_p[:, side])
            sides.append(uniform + 0.5 * varying)
        return sides[0], sides[1]


@dataclass(frozen=True)
class _Faces:
    """Columns at the faces along the first axis, (n - 1, m), for their flux."""

    nodes: _Nodes
    spacing: float
    across: bool  # whether the faces are along y, and the surfaces slip along their second axis
    mean: tuple[Array, Array, Array]  # fluidity of the faces, and its derivatives by ln eta of both nodes
    # gap, scale and scale_p: film thickness H, characteristic stress over ``stress_scale``, and its
    # derivative by P.
    gap: Array
    scale: Array
    scale_p: Array
    # gradient, slip and profile: arguments of ``flux_of``.
    gradient: Array
    slip: Array
    profile: tuple[Array, Array] | None


def _fluxes(rheology: Rheology, groups: list[_Faces]) -> list[Flux]:
    """Flux of each group of faces. All columns are computed together, as few columns take as long as many."""
    if len(groups) == 1:
        (faces,) = groups
        return [flux_of(rheology, faces.mean[0], faces.gradient, faces.slip, faces.profile)]

    def joined(arrays: list[Array]) -> Array:
        return np.concatenate([values.reshape(*values.shape[:-2], -1) for values in arrays], axis=-1)

    profiles = [faces.profile for faces in groups if faces.profile is not None]
    flux = flux_of(
        rheology,
        joined([faces.mean[0] for faces in groups]),
        joined([faces.gradient for faces in groups]),
        joined([faces.slip for faces in groups]),
        (joined([p[0] for p in profiles]), joined([p[1] for p in profiles])) if profiles else None,
    )
    fluxes, end = [], 0
    for faces in groups:
        start, end, shape = end, end + faces.gap.size, faces.gap.shape

        def part(values: Array, columns: slice = slice(start, end), shape: tuple[int, ...] = shape) -> Array:
            return values[..., columns].reshape(*values.shape[:-1], *shape)

        fluxes.append(
            Flux(
                flux=part(flux.flux),
                by_gradient=part(flux.by_gradient),
                by_slip=part(flux.by_slip),
                by_viscosity=part(flux.by_viscosity),
                by_weight=None if flux.by_weight is None else part(flux.by_weight),
                drift=None if flux.drift is None else part(flux.drift),
            )
        )
    return fluxes


@dataclass(frozen=True)
class Columns:
    """Stress, speed and heat across the film in columns, at the nodes of a grid or at some faces along x."""

    across: Across  # nodes zeta across the film, nz of them
    # Heat of shear tau gamma_dot h/u_m over the stress scale p_h b/R, shape (nz, nx, ny).
    heating: Array
    speed: Array  # speed of the oil along x and y over the entrainment speed u_m, shape (2, nz, nx, ny)
    # d ln(tau)/d ln(eta) at a fixed shear rate; one for a Newtonian fluid, shape (nz, nx, ny).
    softening: Array
    density: Array  # rho/rho_0, shape (nz, nx, ny)
    gradient: Array  # dP/dX and dP/dY, shape (2, nx, ny)
    middle: Array  # stress at zeta = 1/2 along x and y over the stress scale, shape (2, nx, ny)

    @property
    def mean_speed(self) -> Array:
        """Mean speed along x of the mass across the film, over u_m, shape (nx, ny)."""
        mass = np.tensordot(self.across.weights, self.density, axes=1)
        return np.asarray(np.tensordot(self.across.weights, self.density * self.speed[0], axes=1) / mass)

    def mixed(self, at_faces: Columns, needed: Mask, part: Array) -> Columns:
        """Columns at the nodes with a part (nx, ny) of the means of both faces along x.

        ``at_faces`` has the columns (n,) of the faces of a mask ``needed`` (nx - 1, ny).
        """

        def mix(of_nodes: Array, of_faces: Array) -> Array:
            faces = np.zeros((*of_nodes.shape[:-2], *needed.shape))
            faces[..., needed] = of_faces
            return np.asarray(of_nodes + part * (node_mean(faces) - of_nodes))

        return replace(
            self,
            heating=mix(self.heating, at_faces.heating),
            speed=mix(self.speed, at_faces.speed),
            softening=mix(self.softening, at_faces.softening),
        )


# Error of the mean speed over u_m at which half of a column is the mean of the columns at its faces, up to
# which no part of it is, and above which it makes no difference.
_HALF_OF_FACES, _NONE_OF_FACES, _LARGEST_ERROR = 0.1, 0.01, 1e100


def _part_of_faces(error: Array) -> Array:
    """Part of the columns at the faces in the columns of the nodes, from the error of their mean speed.

    Examples
    --------
    >>> _part_of_faces(np.array([0.01, 0.11, 10.0, np.inf, np.nan])).round(3).tolist()
    [0.0, 0.5, 1.0, 1.0, 0.0]
    """
    above = np.clip(np.nan_to_num(error) - _NONE_OF_FACES, 0.0, _LARGEST_ERROR) / _HALF_OF_FACES
    return np.asarray(1.0 - 1.0 / (1.0 + above**2))


def columns_of(
    rheology: Rheology,
    across: Across,
    properties: tuple[Array, Array],
    *,
    gradient: Array,
    thickness: Array,
    scale: Array,
    slip: float,
    speed_unit: float,
) -> Columns:
    """Stress, speed and heat at the nodes across the film.

    ``properties``, ln(eta/eta_0) and rho/rho_0 across the film, (nz, nx, ny) or (1, nx, ny); ``gradient``,
    dP/dX and dP/dY, shape (2, nx, ny); ``thickness``, film thickness H, shape (nx, ny); ``scale``,
    characteristic stress of the law over p_h b/R, shape (nx, ny). Returns state of the columns.
    """
    shape, nz = thickness.shape, across.zeta.size
    log_viscosity, density = (np.broadcast_to(v, (nz, *shape)) for v in properties)
    log_viscosity = log_viscosity.reshape(nz, -1)
    node_fluidity = np.exp(-log_viscosity)
    uniform = len(properties[0]) == 1
    reduced = (thickness * gradient / scale).reshape(2, -1)
    slips = np.zeros_like(reduced)
    slips[0] = (slip / (thickness * scale)).reshape(-1)
    speed, middle = np.empty((2, *log_viscosity.shape)), np.empty_like(reduced)
    heating, softening = np.empty_like(log_viscosity), np.empty_like(log_viscosity)
    grades = _grades(rheology, reduced, None if uniform else log_viscosity, speeds=True)
    for part, number in _parts(*grades):
        quadrature, (values, _) = Quadrature.gauss(number), to_points(nz - 1, number)
        columns = reduced[:, part], slips[:, part]
        fluidity = np.exp(-values @ log_viscosity[:, part])
        law = _ColumnLaw.of(rheology, fluidity, *columns, quadrature)
        middle[:, part] = law.middle
        stress, rate, softening[:, part] = law(across.zeta - 0.5, node_fluidity[:, part], columns[0])
        heating[:, part] = np.sum(stress * rate, axis=0)
        _, at_points, _ = law(quadrature.offset, fluidity, columns[0])
        speed[:, :, part] = _up_to(nz - 1, number) @ at_points
    size = speed_unit * (thickness * scale)
    speed = size * speed.reshape(2, nz, *shape)
    speed[0] += 1.0 - 0.5 * slip * speed_unit
    return Columns(
        across=across,
        heating=scale * size * heating.reshape(nz, *shape),
        speed=speed,
        softening=softening.reshape(nz, *shape),
        density=density,
        gradient=gradient,
        middle=scale * middle.reshape(2, *shape),
    )


@dataclass(frozen=True)
class _ColumnLaw:
    """Law of some columns (n,) at their mid-film stress."""

    rheology: Rheology
    middle: Array  # mid-film stress over the characteristic stress, shape (2, n)
    even: EvenStress | None  # factor of a law that is uniform across the film; None of the others

    @classmethod
    def of(
        cls, rheology: Rheology, fluidity: Array, gradient: Array, slip: Array, quadrature: Quadrature
    ) -> _ColumnLaw:
        """Law from a (nq, n) at the points of the quadrature, q (2, n) and g (2, n)."""
        if rheology.law.even:
            even = EvenStress.of(rheology, fluidity, gradient, slip, quadrature)
            return cls(rheology, even.middle, even)
        if gradient[1].any():
            plane = middle_stresses(rheology, fluidity, gradient, slip, quadrature, exact=_EXACT_SPEEDS)
            return cls(rheology, plane, None)
        along = middle_stress(rheology, fluidity, gradient[0], slip[0], quadrature)
        return cls(rheology, np.stack([along, np.zeros_like(along)]), None)

    def __call__(self, offset: Array, fluidity: Array, gradient: Array) -> tuple[Array, Array, Array]:
        """Stress and rate (2, m, n), and softening (m, n), at positions ``offset`` (m,) from mid-film."""
        stress = self.middle[:, np.newaxis] + offset[:, np.newaxis] * gradient[:, np.newaxis]
        if self.even is not None:
            even = self.even
            return stress, even.factor * fluidity * stress, np.broadcast_to(even.softening, fluidity.shape)
        squared = stress[0] ** 2 + stress[1] ** 2
        factor, slope = self.rheology.law.factor(squared, self.rheology.constants)
        return stress, factor * fluidity * stress, factor / (factor + 2.0 * slope * squared)


@cache
def _up_to(degree: int, number: int) -> Array:
    """Integrals from 0 to each node of ``Across.of(degree)`` from values at the Gauss points, (nz, nq)."""
    return integrals(Quadrature.gauss(number).offset + 0.5, Across.of(degree).zeta)


@dataclass(frozen=True)
class Traction:
    """Friction of a contact, over its load."""

    # Traction coefficient: integral of the mid-film stress along x over the load; positive where surface 2 is
    # faster.
    sliding: float
    rolling: float  # rolling coefficient: integral of h/2 dp/dx over the load, the resistance on each surface

    def __add__(self, other: Traction) -> Traction:
        """Friction of two parts of a contact together."""
        return Traction(self.sliding + other.sliding, self.rolling + other.rolling)

    def power_loss(self, load: float, *, entrainment_speed: float, slide_to_roll_ratio: float) -> float:
        """Power [W], or [W/m] of a line contact, that the motion of the surfaces takes: stress times speed.

        ``load`` is in N, or in N/m of a line contact, and ``entrainment_speed`` in m/s.

        Examples
        --------
        1 kN at a traction coefficient of 0.05, where the surfaces slide with 0.2 m/s:

        >>> speeds = {"entrainment_speed": 2.0, "slide_to_roll_ratio": 0.1}
        >>> round(Traction(0.05, 0.0).power_loss(1000.0, **speeds), 9)
        10.0
        """
        return load * entrainment_speed * (self.sliding * slide_to_roll_ratio + 2.0 * self.rolling)


def traction(
    columns: Columns,
    thickness: Array,
    mesh: Mesh,
    *,
    load: float,
    stress_ratio: float,
    filled: Array | float = 1.0,
    part: Array | float = 1.0,
) -> Traction:
    """Traction and rolling coefficients of a contact with the film thickness H (nx, ny), or of a ``part``
    of each node (nx, ny).

    ``filled`` (nx, ny) is the part of the gap that the oil fills. The stress of a cavitated film is this part
    of the stress of a full film.
    """
    weights = stress_ratio / load * mesh.weights * part
    sliding = np.sum(weights * filled * columns.middle[0])
    rolling = np.sum(weights * 0.5 * thickness * columns.gradient[0])
    return Traction(float(sliding), float(rolling))


def filled_part(full_film: Mask, mass: Array) -> Array:
    """Part of the gap that the oil fills behind the rupture of a stationary film.

    ``full_film``, nodes with a full film, shape (nx, ny); ``mass``, mass rho H of a full film,
    shape (nx, ny). Returns one at the nodes with a full film and before the first of them; behind the last of
    them the mass at the last full node divided by the mass of a full film, at most one, shape (nx, ny).

    Examples
    --------
    >>> full = np.array([[False], [True], [True], [False]])
    >>> filled_part(full, np.array([[9.0], [2.0], [1.0], [4.0]]))[:, 0].tolist()
    [1.0, 1.0, 1.0, 0.25]
    """
    row = np.arange(len(mass))[:, np.newaxis]
    last = np.maximum.accumulate(np.where(full_film, row, -1), axis=0)
    carried = np.take_along_axis(mass, np.maximum(last, 0), axis=0)
    return np.where(full_film | (last < 0), 1.0, np.minimum(1.0, carried / mass))
