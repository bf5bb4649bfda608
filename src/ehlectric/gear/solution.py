"""Solution of a gear pair: geometry, load, film, capacitance and breakdown over a phase of its mesh."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.bearing import Solid
from ehlectric.cases.case_oil import temperature_coefficient
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.gear_inputs import Gear, both
from ehlectric.discharge.discharge_laws import Leakage, leakage
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.formulas.asperities import LOAD_SHARE, contact_probability
from ehlectric.formulas.hertz import reduced_modulus
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import ContactPath, contact_path
from ehlectric.gear.flank_films import FlankFilms, Flanks, flank_films
from ehlectric.gear.geometry import Drawing, GearPair, gear_pair
from ehlectric.gear.load_sharing import SIDES, LineLoads, Modification, line_loads, load_at
from ehlectric.gear.losses import bulk_temperature, loss_factor
from ehlectric.gear.mesh_capacitance import back_capacitance, capacitance_per_length
from ehlectric.gear.tooth_stiffness import mesh_stiffness, pair_stiffness
from ehlectric.lubricant.heat_laws import ASSUMED_CONDUCTIVITY
from ehlectric.quantities.field_metadata import stored

# Area of the contact of the disc machine on which the share of time was measured, if it is not given, and the
# factor by which it may be wrong either way.
REFERENCE_AREA, AREA_FACTOR = 1e-6, 3.0

# Distance of a place next to B or D from it [m].
_JUMP = 1e-8

# Part of the path of contact on both sides of C over which the friction of a film reverses.
_REVERSAL = 0.05


@dataclass(frozen=True)
class GearSolution:
    """Mesh of a gear pair at its operating point.

    Arrays over the lines of contact have the shape (p, k, s) of phases, lines and nodes of a line; NaN where
    there is no contact.
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
    capacitance_of_lines: Array = field(metadata=stored("phase line node", "F/m", "not negative or NaN"))

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

    @property
    def strength(self) -> float | None:
        """Dielectric strength of the oil at ambient pressure [V/m]; None without one."""
        return strength_of(self.case)

    @property
    def thinnest(self) -> tuple[int, ...]:
        """Index (p, k, s) of the smallest film of all lines."""
        return self.films.thinnest

    @property
    def film_error(self) -> float:
        """Relative error of the smallest film."""
        return float(self.films.error[self.thinnest])

    @property
    def outside_atlas(self) -> Mask:
        """Places on lines of contact whose films are outside the atlas, of the shape of the films."""
        return np.asarray(~self.films.known & ~np.isnan(self.films.minimum))

    @property
    def leakage(self) -> Leakage:
        """Leakage of charge through the oil at the temperature of the flanks."""
        return leakage(self.case.discharge, self.flanks.oil)

    @property
    def gap(self) -> Array:
        """Gap under the highest summits on all lines [m]; 0 where they touch, NaN without contact."""
        return np.maximum(self.films.minimum - self.summits, 0.0)

    @property
    def breakdown_voltage(self) -> Array | None:
        """Smallest breakdown voltage of all lines at each phase, shape (p,) [V]; 0 where summits touch."""
        strength = self.strength
        return None if strength is None else strength * np.nanmin(self.gap, axis=(1, 2))

    @property
    def capacitance(self) -> Array:
        """Capacitance of the mesh at each phase, shape (p,) [F], with the flanks behind the working ones."""
        return self.loads.along(self.capacitance_of_lines) + self.back_capacitance

    @property
    def back_capacitance(self) -> float:
        """Mean capacitance of the flanks behind the working ones [F]; 0 where the backlash is not known."""
        if self.pair.normal_backlash is None:
            return 0.0
        radius = float(np.asarray(self.path.reduced_radius(self.path.pitch_point)))
        length = self.pair.face_width / math.cos(self.pair.base_helix_angle)
        permittivity = self.flanks.oil.relative_permittivity
        pair = back_capacitance(radius, self.pair.normal_backlash, length, float(permittivity))
        return self.path.contact_ratio * pair

    def contact_time_share(self, area_factor: float = 1.0) -> Array:
        """Share of time in which the mesh conducts by metallic contact at each phase, shape (p,).

        Patches of the reference area conduct independently of each other, each with the share of time of its
        lambda: ln(1 - p) is the integral of ln(1 - p(lambda)) over the Hertz area over the reference area.
        ``area_factor``, factor on the reference area.
        """
        return -np.expm1(self._open / (area_factor * reference_area_of(self.case)))

    @cached_property
    def _open(self) -> Array:
        """Integral of ln(1 - p(lambda)) over the Hertz area at each phase, shape (p,) [m^2]."""
        return open_area(self.loads, self.films, self.rq)

    @property
    def sliding_power(self) -> float:
        """Mean over the phases of the integral of w abs(v_g) over all lines [W]."""
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
        """Mean over the phases of the integral of mu w abs(v_g) over all lines [W]."""
        films = self.films
        return self.loads.mean(self.loads.along(friction * films.load * np.abs(films.sliding_speed)))


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
    share = contact_probability(np.nan_to_num(films.central / rq, nan=math.inf))
    with np.errstate(divide="ignore"):
        closed = np.log1p(-share)
    width = 2.0 * np.nan_to_num(films.half_width)
    return loads.along(np.where(width > 0.0, width * closed, 0.0))


@dataclass(frozen=True)
class OperatingPair:
    """Gear pair of a case at its operating point, before its load and films are solved."""

    pair: GearPair
    plane: PlaneOfAction
    flanks: Flanks
    bulk_temperature: float  # temperature of the flanks [K]
    stiffness: float  # c' of a pair of teeth per face width [N/m^2]

    @classmethod
    def of(cls, case: GearCase) -> OperatingPair:
        """Gear pair of a case. Raises InputError for drawings that cannot run, and for an oil without a value
        at the temperature of the flanks.
        """
        gear, operation = case.gear, case.gear.operation
        pair = gear_pair(drawing_of(gear))
        path = contact_path(pair)
        temperature = _bulk_temperature(gear, pair, path)
        load_per_width = 2.0 * abs(operation.pinion_torque) / pair.reference_diameter[0] / pair.face_width
        steel = pair_stiffness(pair, load_per_width * operation.application_factor)
        return cls(
            pair,
            PlaneOfAction(path, pair.face_width),
            _flanks(case, pair, path, temperature),
            temperature,
            steel * Solid.of(gear.material).youngs_modulus / Solid.of("steel").youngs_modulus,
        )


def solve_gear_pair(case: GearCase) -> GearSolution:
    """Mesh of a gear pair at its operating point. Raises InputError for drawings that cannot run, and for an
    oil without a value at the temperature of the flanks.
    """
    at = OperatingPair.of(case)
    loads = loads_of(case, at)
    films, point_films = _films(case, at, loads)
    return GearSolution(
        case=case,
        pair=at.pair,
        plane=at.plane,
        flanks=at.flanks,
        loads=loads,
        films=replace(films, atlas=None),
        point_films=replace(point_films, atlas=None),
        bulk_temperature=at.bulk_temperature,
        stiffness=at.stiffness,
        capacitance_of_lines=capacitance_per_length(at.flanks, films),
    )


def solve_gear_pairs(cases: Iterable[GearCase]) -> list[GearSolution | InputError | ConvergenceError]:
    """Meshes of many gear pairs, as ``solve_gear_pair`` gives them; the error of a pair that has none."""
    return [_attempt(case) for case in cases]


def _attempt(case: GearCase) -> GearSolution | InputError | ConvergenceError:
    try:
        return solve_gear_pair(case)
    except (InputError, ConvergenceError) as error:
        return error


def loads_of(case: GearCase, at: OperatingPair) -> LineLoads:
    """Loads on the lines of contact of a gear pair at its operating point."""
    gear = case.gear
    return line_loads(
        at.plane,
        _normal_force(gear, at.pair),
        gear.operation.load_sharing,
        stiffness=mesh_stiffness(at.stiffness, at.plane.path.contact_ratio),
        modification=modification_of(gear),
    )


def tabulated_films(case: GearCase) -> tuple[LineLoads, FlankFilms]:
    """Loads and films on the lines of contact of a case whose films are not solved. Raises InputError as
    ``solve_gear_pair`` does.
    """
    at = OperatingPair.of(case)
    loads = loads_of(case, at)
    return loads, flank_films(at.flanks, loads.places, loads.load, by_formula=case.contacts == "formula")


def _films(case: GearCase, pair: OperatingPair, loads: LineLoads) -> tuple[FlankFilms, FlankFilms]:
    """Films on all lines, and films at the points A to E under the mean load that passes them, arrays of
    shape (5,), in the way that the file asks for.
    """
    plane, flanks, by_formula = pair.plane, pair.flanks, case.contacts == "formula"
    points = plane.path.points
    mean = np.array([load_at(plane, loads, place, SIDES[name]) for name, place in points.items()])
    films = flank_films(flanks, loads.places, loads.load, by_formula=by_formula)
    at_points = flank_films(flanks, np.array(list(points.values())), mean, by_formula=by_formula)
    if case.contacts != "solved":
        return films, at_points
    from ehlectric.gear.solved_points import solved_correction  # late: the atlas needs no solver

    places, load = _to_solve(plane, loads, films)
    correction = solved_correction(case, flanks, places[load > 0.0], load[load > 0.0])
    return correction.applied(films), correction.applied(at_points)


def _to_solve(plane: PlaneOfAction, loads: LineLoads, films: FlankFilms) -> tuple[Array, Array]:
    """Places and loads at which films are solved: the smallest film, A to E, both sides of C, between which
    the friction reverses, and the other sides of B and D, where the load on a spur pair jumps.
    """
    points, at = plane.path.points, films.thinnest
    sides = [(name, side, 0.0) for name, side in SIDES.items()]
    sides += [(name, -SIDES[name], _JUMP) for name in "BD"]
    places = [points[name] + side * shift for name, side, shift in sides]
    load = [load_at(plane, loads, points[name], side) for name, side, _ in sides]
    reversal = [points["C"] + side * _REVERSAL * plane.path.length for side in (-1.0, 1.0)]
    load_at_pitch_point = load[list(SIDES).index("C")]
    return (
        np.array([loads.places[at], *places, *reversal]),
        np.array([loads.load[at], *load, load_at_pitch_point, load_at_pitch_point]),
    )


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


def _flanks(case: GearCase, pair: GearPair, path: ContactPath, temperature: float) -> Flanks:
    """Flanks with the oil at their temperature [K]."""
    compliance = Solid.of(case.gear.material).compliance
    oil = case.lubricant.at(temperature, "gear.operation.bulk_temperature")
    if not np.any(oil.alpha):
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{oil.laws['viscosity']!r} with gears, whose films are those of piezoviscous oils;",
            takes="another law",
        )
    known = oil.thermal_conductivity
    slope = temperature_coefficient(case.lubricant, temperature)
    return Flanks(
        path=path,
        ratio=pair.ratio,
        pinion_speed=case.gear.operation.pinion_speed,
        modulus=reduced_modulus(compliance, compliance),
        temperature=temperature,
        oil=oil,
        slope=None if slope is None else float(slope),
        conductivity=float(ASSUMED_CONDUCTIVITY if known is None else known),
    )
