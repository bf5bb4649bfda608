"""Heat and shear of a solved film in SI units: temperature, shear stress, traction and power loss."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.runtime.stored import number, stored
from ehlectric.runtime.values import Values

_ACROSS = "from surface 1 to surface 2"


@dataclass(frozen=True, eq=False, repr=False)
class HeatedFilm(Values):
    """Heat and shear of a film in SI units, with nodal values (nx,), or (nx, ny) of a point contact.

    Attributes
    ----------
    rheology : str
        Name of the law between shear stress and shear rate, such as "eyring".
    shear_stress : ndarray
        Shear stress at mid-film along entrainment [Pa], positive where surface 1 is the faster one.
    traction_coefficient : float or None
        Mean shear stress at mid-film over the mean pressure, dimensionless; its sign is that of the stress.
        None, as the other friction, if the film did not converge.
    rolling_coefficient : float or None
        Rolling friction over the load, dimensionless, of each of the two surfaces.
    power_loss : float or None
        Power that the film turns into heat [W]; of a line contact per length [W/m].
    isothermal_minimum_thickness, isothermal_central_thickness : float or None
        Film thicknesses of the same contact with an isothermal Newtonian film [m]; None if that film did not
        converge.
    outer_iterations : int
        Number of alternations between the film and its temperature.
    zeta : ndarray, shape (nz,), or None
        Positions across the film from surface 1, at 0, to surface 2, at 1. None for an isothermal film.
    temperature : ndarray, shape (nz, nx) or (nz, nx, ny), or None
        Temperature in the film [K]; its first and last rows are those of the surfaces.
    mid_temperature : ndarray or None
        Temperature at mid-film [K].
    max_temperature_rise : float or None
        Largest temperature at mid-film less that of the oil in the inlet [K].
    temperature_rise_error : float or None
        Estimated error of ``max_temperature_rise`` by the grids along and across the film, the iteration and
        extrapolated properties of the oil [K]; None if unknown.
    energy_imbalance : float or None
        Heat that the film makes or loses by the discretisation, over the heat of compression and shear.
    """

    rheology: str = field(metadata=number("text"))
    shear_stress: Array = field(
        metadata=stored("nodes", "Pa", "finite", "shear stress at mid-film along entrainment", needed=False)
    )
    traction_coefficient: float | None = field(metadata=number())
    rolling_coefficient: float | None = field(metadata=number())
    power_loss: float | None = field(metadata=number("not negative or null"))
    isothermal_minimum_thickness: float | None = field(metadata=number("positive or null"))
    isothermal_central_thickness: float | None = field(metadata=number("positive or null"))
    outer_iterations: int = field(metadata=number("whole"))
    zeta: Array | None = field(
        default=None,
        metadata=stored("zeta", "1", "increasing", f"fraction of the film, {_ACROSS}", needed=False),
    )
    temperature: Array | None = field(
        default=None,
        metadata=stored("zeta nodes", "K", "positive", f"temperature in the film, {_ACROSS}", needed=False),
    )
    mid_temperature: Array | None = field(
        default=None, metadata=stored("nodes", "K", "positive", "temperature at mid-film", needed=False)
    )
    max_temperature_rise: float | None = field(default=None, metadata=number())
    temperature_rise_error: float | None = field(default=None, metadata=number())
    energy_imbalance: float | None = field(default=None, metadata=number())

    @property
    def thermal(self) -> bool:
        """Whether the temperature in the film was computed."""
        return self.temperature is not None

    @property
    def surface_temperatures(self) -> Array | None:
        """Temperatures of surfaces 1 and 2 [K], shape (2, nx) or (2, nx, ny); None of an isothermal film."""
        return None if self.temperature is None else self.temperature[[0, -1]]

    @property
    def temperature_range(self) -> tuple[float, float] | None:
        """Lowest and highest temperature in the film [K]; None of an isothermal film."""
        if self.temperature is None:
            return None
        return float(np.min(self.temperature)), float(np.max(self.temperature))
