"""Coating and roughness of the surfaces of a film, and what they make of its capacitance, place by place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.discharge.roughness_factor import roughness_factor


@dataclass(frozen=True)
class Layers:
    """Coating in series with a film, and roughness of the surfaces of a smooth solved film.

    The coating is in series place by place: the gap h/eps becomes h/eps + t/eps_c. This neglects the field
    along the coating, which spreads the voltage where the film changes over a length below t.

    Attributes
    ----------
    coating : float
        Thickness of the coating over its relative permittivity, t/eps_c [m].
    rq : float
        Combined root-mean-square height of both surfaces in the loaded contact [m].

    Examples
    --------
    A film of 0.5 um with a relative permittivity of 2.5, and a coating of 1.6 um with one of 8, share the
    voltage equally:

    >>> film = epsilon_0 * 2.5 / 0.5e-6
    >>> round(float(Layers(coating=1.6e-6 / 8.0).density(film, 2.5) / film), 12)
    0.5
    """

    coating: float = 0.0
    rq: float = 0.0

    def density(self, film: ArrayLike, relative_permittivity: ArrayLike) -> Array:
        """Capacitance per area of film, coating and roughness together.

        Parameters
        ----------
        film : array_like, shape (...)
            Capacitance per area of the smooth film alone [F/m^2], positive.
        relative_permittivity : array_like, shape (...)
            Relative permittivity in the film, dimensionless.

        Returns
        -------
        ndarray, shape (...)
            Capacitance per area [F/m^2].
        """
        alone = np.asarray(film, dtype=float)
        permittivity = np.asarray(relative_permittivity, dtype=float)
        if self.coating > 0.0:
            alone = alone / (1.0 + alone * self.coating / epsilon_0)
        if self.rq > 0.0:
            alone = alone * roughness_factor(epsilon_0 * permittivity / alone / self.rq)
        return alone

    def film_share(self, film: ArrayLike) -> Array:
        """Share of the voltage that lies on the film, from its capacitance per area alone [F/m^2].

        Parameters
        ----------
        film : array_like, shape (...)
            Capacitance per area of the film alone [F/m^2].

        Returns
        -------
        ndarray, shape (...)
            Share from 0 to 1, dimensionless; the rest lies on the coating.
        """
        share: Array = 1.0 / (1.0 + np.asarray(film, dtype=float) * self.coating / epsilon_0)
        return share


# Surfaces without a coating, whose roughness is in the film or is neglected.
BARE = Layers()
