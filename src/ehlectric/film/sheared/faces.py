"""Flux through faces of a grid, from the properties of the oil at the nodes across the film.

Nearly all columns of a film have stress differences below the characteristic stress of the law, for which few
Gauss points across the film are exact. Only the columns at the pressure spike need many.
"""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.column import column_flux, uniform_eyring
from ehlectric.film.sheared.even import Flux, even_flux
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.sheared.plane import plane_flux
from ehlectric.film.sheared.profile import Quadrature, to_points

# Largest stress difference over the characteristic stress for which few points are enough, and the number of
# these points for uniform properties and for those of a temperature profile. The flux is then exact to 1e-10
# for the Eyring law and to 1e-7 for Carreau's law.
_SMALL, _FEW, _FEW_OF_PROFILE = 2.0, 8, 12

# Number of columns, as around a pressure spike, up to which two quadratures take longer than the larger one.
_TOGETHER = 100


def flux_of(
    rheology: Rheology,
    mean: Array,
    gradient: Array,
    slip: Array,
    profile: tuple[Array, Array] | None = None,
) -> Flux:
    """Flux along the first axis of columns with uniform properties or with a profile across the film.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    mean : ndarray, shape (...)
        Fluidity eta_0/eta of the columns, at the reference temperature.
    gradient, slip : ndarray, shape (d, ...)
        q and g of ``column``, along the axis of the flux and, for d = 2, along the other axis.
    profile : tuple of ndarray, each of shape (nz, ...), optional
        Logarithm of the viscosity over that at the reference temperature, and the density, at the nodes
        across the film. Without it the viscosity is uniform and the density is one.

    Returns
    -------
    Flux
        Flux and derivatives; those by viscosity and density are by the values at the nodes across the film.

    Examples
    --------
    >>> found = flux_of(Rheology(), np.ones(1), np.array([[1.2]]), np.array([[3.0]]))
    >>> round(float(found.flux[0]), 12)
    0.1
    """
    if profile is None and len(gradient) == 1 and rheology.name == "eyring":
        return uniform_eyring(mean, gradient[0], slip[0])
    shape, d = mean.shape, len(gradient)
    mean, gradient, slip = mean.reshape(-1), gradient.reshape(d, -1), slip.reshape(d, -1)
    nz = 1 if profile is None else len(profile[0])
    ratio, layers = (None, None) if profile is None else (values.reshape(nz, -1) for values in profile)
    few = _FEW if profile is None else _FEW_OF_PROFILE
    small = (np.max(np.abs(gradient), axis=0) < _SMALL) | rheology.law.even
    if mean.size <= _TOGETHER and not small.all():
        small[:] = False
    flux, by_gradient, by_slip = np.empty_like(mean), np.empty_like(gradient), np.empty_like(slip)
    by_viscosity, by_weight = np.empty((nz, mean.size)), np.empty((nz, mean.size))
    for part, quadrature in ((small, Quadrature.gauss(few)), (~small, Quadrature.gauss())):
        if not part.any():
            continue
        found = _at_points(
            rheology,
            mean[part],
            gradient[:, part],
            slip[:, part],
            None if ratio is None or layers is None else (ratio[:, part], layers[:, part]),
            quadrature,
        )
        flux[part], by_gradient[:, part], by_slip[:, part] = found.flux, found.by_gradient, found.by_slip
        by_viscosity[:, part] = found.by_viscosity
        if profile is not None:
            by_weight[:, part] = found.by_weight
    return Flux(
        flux.reshape(shape),
        by_gradient.reshape(d, *shape),
        by_slip.reshape(d, *shape),
        by_viscosity.reshape(nz, *shape),
        None if profile is None else by_weight.reshape(nz, *shape),
    )


def _at_points(
    rheology: Rheology,
    mean: Array,
    gradient: Array,
    slip: Array,
    profile: tuple[Array, Array] | None,
    quadrature: Quadrature,
) -> Flux:
    """Flux of some columns (n,) by one quadrature; arguments as for ``flux_of``."""
    if profile is None:
        fluidity, weight = mean[np.newaxis], quadrature.offset[:, np.newaxis]
        return _by_law(rheology, fluidity, weight, gradient, slip, quadrature)
    ratio, layers = profile
    values, below = to_points(len(ratio) - 1, quadrature.offset.size)
    found = _by_law(rheology, mean * np.exp(-values @ ratio), below @ layers, gradient, slip, quadrature)
    assert found.by_weight is not None
    by_ratio, by_layers = values.T @ found.by_viscosity, below.T @ found.by_weight
    return Flux(found.flux, found.by_gradient, found.by_slip, by_ratio, by_layers)


def _by_law(
    rheology: Rheology,
    fluidity: Array,
    weight: Array,
    gradient: Array,
    slip: Array,
    quadrature: Quadrature,
) -> Flux:
    """Flux of columns by the equations of their law and of the number of axes."""
    if rheology.law.even:
        return even_flux(rheology, fluidity, weight, gradient, slip, quadrature)
    if len(gradient) == 2:
        return plane_flux(rheology, fluidity, weight, gradient, slip, quadrature)
    return column_flux(rheology, fluidity, weight, gradient[0], slip[0], quadrature)
