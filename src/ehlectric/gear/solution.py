"""Solution of a gear pair: geometry, load, film, capacitance and breakdown over a phase of its mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.bearing import Solid
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.gear_inputs import Gear, both
from ehlectric.discharge.discharge_laws import relaxation_time
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.formulas.asperities import LOAD_SHARE, contact_probability
from ehlectric.formulas.hertz import reduced_modulus
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import ContactPath, contact_path
from ehlectric.gear.flank_films import FlankFilms, Flanks
from ehlectric.gear.flank_oil import FlankOil
from ehlectric.gear.geometry import Drawing, GearPair, gear_pair
from ehlectric.gear.load_sharing import LineLoads, Modification, Sharing
from ehlectric.gear.losses import bulk_temperature, loss_factor
from ehlectric.gear.mesh_capacitance import back_capacitance
from ehlectric.gear.tooth_stiffness import mesh_stiffness, pair_stiffness
from ehlectric.quantities.field_metadata import stored

# Area of the contact of the disc machine on which the share of time was measured, if it is not given, and the
# factor by which it may be wrong either way.
REFERENCE_AREA, AREA_FACTOR = 1e-6, 3.0


@dataclass(frozen=True)
class GearSolution:
    """Mesh of a gear pair at its operating point.

    Arrays over the lines of contact have the shape (n,) of their nodes; NaN where there is no load.
    """

    case: GearCase
    pair: GearPair
    plane: PlaneOfAction
    flanks: Flanks
    loads: LineLoads
    films: FlankFilms
    # Films at the points A to E under the mean load that passes them, shape (5,).
    point_films: FlankFilms
    bulk_temperature: float  # temperature of the flanks [K]
    stiffness: float  # c' of a pair of teeth per face width [N/m^2]
    # Capacitance per length of the lines.
    capacitance_of_lines: Array = field(metadata=stored("node", "F/m", "not negative or NaN"))
    # Capacitance of the lines at which relief and crowning keep the flanks apart.
    open_capacitance: Array = field(metadata=stored("phase", "F", "not negative"))

    @property
    def path(self) -> ContactPath:
        """Path of contact."""
        return self.plane.path

    @property
    def normal_force(self) -> float:
        """Normal force F_bn with all load factors [N]."""
        return _normal_force(self.case.gear, self.pair)

    @property
    def rq(self) -> float:
        """Composite roughness of the flanks [m]."""
        return self.case.gear.rq

    @property
    def summits(self) -> float:
        """Height of the highest summits [m]."""
        return self.case.gear.summit_height * self.rq

    @cached_property
    def strength(self) -> float | None:
        """Dielectric strength of the oil at ambient pressure [V/m]; None without one."""
        return strength_of(self.case)

    @property
    def smooth_breakdown_voltage(self) -> float | None:
        """Breakdown voltage of the minimum film between smooth flanks [V]; None without a strength."""
        strength = self.strength
        return None if strength is None else strength * self.minimum_film

    @property
    def thinnest(self) -> int:
        """Number of the node with the smallest film of all lines."""
        return self.films.thinnest

    @property
    def minimum_film(self) -> float:
        """Smallest film of all lines [m]."""
        return float(self.films.minimum[self.thinnest])

    @property
    def backlash(self) -> float:
        """Normal backlash [m]; the recommended one where it is not known."""
        given = self.pair.normal_backlash
        return self.pair.recommended_backlash if given is None else given

    @property
    def film_error(self) -> float:
        """Relative error of the smallest film."""
        return float(self.films.error[self.thinnest])

    @property
    def outside_atlas(self) -> Mask:
        """Places on lines of contact whose films are outside the atlas, of the shape of the films."""
        return np.asarray(~self.films.known & ~np.isnan(self.films.minimum))

    @property
    def relaxation_time(self) -> float | None:
        """Charge relaxation time of the oil on the flanks [s]; None without a conductivity."""
        given, oil = self.case.discharge.conductivity, self.flanks.oil
        conductivity = oil.conductivity if given is None else given
        if conductivity is None:
            return None
        return float(relaxation_time(oil.relative_permittivity, conductivity))

    @cached_property
    def gap(self) -> Array:
        """Gap under the highest summits on all lines [m]; 0 where they touch, NaN without contact."""
        return np.maximum(self.films.minimum - self.summits, 0.0)

    @cached_property
    def breakdown_voltage(self) -> Array | None:
        """Smallest breakdown voltage of all lines at each phase, shape (p,) [V]; 0 where summits touch."""
        strength = self.strength
        return None if strength is None else strength * self.loads.least(self.gap)

    @property
    def breakdown_voltage_over_phase(self) -> tuple[Array, Array] | None:
        """Phases in increasing order, and the smallest breakdown voltage of all lines there, interpolated
        between the phases of ``breakdown_voltage`` [V].
        """
        strength = self.strength
        if strength is None:
            return None
        phases, gap = self.loads.least_over_phase(self.gap)
        return phases, strength * gap

    @cached_property
    def capacitance(self) -> Array:
        """Capacitance of the mesh at each phase, shape (p,) [F], with the flanks behind the working ones."""
        lines = self.loads.along(self.capacitance_of_lines)
        return np.asarray(lines + self.open_capacitance + self.back_capacitance)

    @cached_property
    def back_capacitance(self) -> float:
        """Mean capacitance of the flanks behind the working ones [F]; 0 where the backlash is not known."""
        if self.pair.normal_backlash is None:
            return 0.0
        radius = float(np.asarray(self.path.reduced_radius(self.path.pitch_point)))
        length = self.pair.face_width / math.cos(self.pair.base_helix_angle)
        permittivity = self.flanks.oil.relative_permittivity
        pair = back_capacitance(radius, self.pair.normal_backlash, length, permittivity)
        return self.path.contact_ratio * pair

    def contact_time_share(self, area_factor: float = 1.0) -> Array:
        """Share of time in which the mesh conducts by metallic contact at each phase, shape (p,).

        Patches of the reference area conduct independently of each other, each with the share of time of its
        lambda: ln(1 - p) is the integral of ln(1 - p(lambda)) over the Hertz area over the reference area.
        ``area_factor``, factor on the reference area.
        """
        return -np.expm1(self._open / (area_factor * reference_area_of(self.case)))

    @cached_property
    def mean_contact_share(self) -> float:
        """Mean over a phase of the share of time in which the mesh conducts by metallic contact."""
        return self.loads.mean(self.contact_time_share())

    @cached_property
    def _open(self) -> Array:
        """Integral of ln(1 - p(lambda)) over the Hertz area at each phase, shape (p,) [m^2]."""
        return open_area(self.loads, self.films, self.rq)

    @property
    def sliding_power(self) -> float:
        """Mean over the phases of the integral of w abs(v_g)/K over all lines [W]."""
        return self._mean_loss(1.0)

    @property
    def film_loss(self) -> float | None:
        """Friction loss of the films, with the friction of solved films [W]; None without these."""
        friction = self.films.friction
        return None if np.all(np.isnan(friction)) else self._mean_loss(friction)

    @property
    def asperity_loss(self) -> float | None:
        """Friction loss of asperities, which carry a share of the load that depends on lambda [W]; None
        without their friction coefficient.
        """
        friction = self.case.gear.operation.boundary_friction
        if friction is None:
            return None
        ratio = np.nan_to_num(self.films.central / self.rq)
        return self._mean_loss(friction * LOAD_SHARE["zhou_hoeprich"].share(ratio))

    def _mean_loss(self, friction: Numbers) -> float:
        """Mean over the phases of the integral of mu w abs(v_g)/K over all lines [W].

        Load factors K raise the load of a place or of an instant, and not the mean load of the mesh.
        """
        films, factor = self.films, self.case.gear.operation.load_factor
        return self.loads.mean(self.loads.along(friction * films.load * np.abs(films.sliding_speed))) / factor


def strength_of(case: GearCase) -> float | None:
    """Dielectric strength of the oil of a case at ambient pressure [V/m]; None without one."""
    if not case.discharge.has_strength:
        return None
    return float(np.asarray(dielectric_strength(case.discharge, np.zeros(()))))


def reference_area_of(case: GearCase) -> float:
    """Contact area on which the share of time with metallic contact was measured [m^2]."""
    given = case.gear.contact.reference_area
    return REFERENCE_AREA if given is None else given


def open_area(loads: LineLoads, films: FlankFilms, rq: float) -> Array:
    """Integral of ln(1 - p(lambda)) over the Hertz area at each phase, shape (p,) [m^2]; see
    ``GearSolution.contact_time_share``. ``rq``, composite roughness over the factor on all films [m].
    """
    ratio = np.where(loads.load > 0.0, films.central / rq, math.inf)
    closed = -np.exp(np.interp(ratio, _RATIOS, _closed(), right=-math.inf))
    return loads.along(2.0 * films.half_width * closed)


# Lambda ratios at which shares of time are tabulated. Beyond them the share is below 1e-28.
_RATIOS = np.linspace(0.0, 8.0, 8193)


@lru_cache(maxsize=1)
def _closed() -> Array:
    """Logarithms of -ln(1 - p(lambda)) at ``_RATIOS``, which are interpolated within 1e-6.

    A share that rounds to 1 leaves a patch open for the smallest share that is not 0.
    """
    share = np.minimum(contact_probability(_RATIOS), np.nextafter(1.0, 0.0))
    return np.log(-np.log1p(-share))


@dataclass(frozen=True)
class OperatingPair:
    """Gear pair of a case at its operating point, without its oil."""

    pair: GearPair
    plane: PlaneOfAction
    bulk_temperature: float  # temperature of the flanks [K]
    stiffness: float  # c' of a pair of teeth per face width [N/m^2]

    @classmethod
    def of(cls, case: GearCase) -> OperatingPair:
        """Gear pair of a case. Raises InputError for drawings that cannot run."""
        gear, operation = case.gear, case.gear.operation
        pair, plane = _geometry(drawing_of(gear))
        load_per_width = 2.0 * abs(operation.pinion_torque) / pair.reference_diameter[0] / pair.face_width
        steel = pair_stiffness(pair, load_per_width * operation.application_factor)
        return cls(
            pair,
            plane,
            _bulk_temperature(gear, pair, plane.path),
            steel * _solid(gear.material).youngs_modulus / _solid("steel").youngs_modulus,
        )

    def flanks(self, case: GearCase, oil: FlankOil) -> Flanks:
        """Flanks with their oil."""
        compliance = _solid(case.gear.material).compliance
        return Flanks(
            path=self.plane.path,
            ratio=self.pair.ratio,
            pinion_speed=case.gear.operation.pinion_speed,
            modulus=reduced_modulus(compliance, compliance),
            temperature=self.bulk_temperature,
            oil=oil,
        )

    def sharing(self, gear: Gear) -> Sharing:
        """Law of the load of the gear pair."""
        return Sharing.of(
            self.plane,
            _normal_force(gear, self.pair),
            gear.operation.load_sharing,
            stiffness=mesh_stiffness(self.stiffness, self.plane.path.contact_ratio),
            modification=modification_of(gear),
        )


@lru_cache(maxsize=64)
def _geometry(drawing: Drawing) -> tuple[GearPair, PlaneOfAction]:
    """Gear pair and plane of action of a drawing, which many operating points share."""
    pair = gear_pair(drawing)
    return pair, PlaneOfAction(contact_path(pair), pair.face_width)


# Solids of the library, which are read once.
_solid = lru_cache(maxsize=32)(Solid.of)


def drawing_of(gear: Gear) -> Drawing:
    """Numbers of the drawing of a gear table."""
    shifts = gear.profile_shift or (None, None)
    return Drawing(
        normal_module=gear.normal_module,
        teeth=gear.teeth,
        normal_pressure_angle=gear.normal_pressure_angle,
        helix_angle=gear.helix_angle,
        face_width=gear.face_width,
        centre_distance=gear.centre_distance,
        profile_shift=(shifts[0], shifts[1] if len(shifts) > 1 else None),
        tip_diameter=(None, None) if gear.tip_diameter is None else both(gear.tip_diameter),
        normal_backlash=gear.normal_backlash,
    )


def modification_of(gear: Gear) -> Modification:
    """Relief and crowning of a gear table."""
    first, second = (0.0, 0.0) if gear.tip_relief is None else both(gear.tip_relief)
    return Modification(second, first, gear.tip_relief_length or 0.0, gear.lead_crowning)


def _normal_force(gear: Gear, pair: GearPair) -> float:
    """Normal force F_bn with all load factors [N]."""
    operation = gear.operation
    tangential = 2.0 * abs(operation.pinion_torque) / pair.base_diameter[0]
    return operation.load_factor * tangential / math.cos(pair.base_helix_angle)


def _bulk_temperature(gear: Gear, pair: GearPair, path: ContactPath) -> float:
    """Temperature of the flanks [K]: the given one, or the estimate of ISO/TS 6336-22."""
    operation = gear.operation
    given = operation.bulk_temperature
    if not isinstance(given, str):
        return given
    assert operation.friction_coefficient is not None
    power = operation.pinion_torque * operation.pinion_speed
    factor = loss_factor(pair, path)
    return bulk_temperature(
        operation.oil_temperature,
        power,
        operation.friction_coefficient,
        factor,
        pair.centre_distance,
        pair.face_width,
    )
