"""The equations of docs/theory/numerical_methods.md, coded from the page: films fulfil them at every node."""

import numpy as np
import pytest

from ehlectric import Case, solve

RADIUS, MODULUS, VISCOSITY, ALPHA = 14.1e-3, 226e9, 0.02, 15e-9


def film_of(pressure, speed, amplitude, wavelength, wedge):
    """Film of an oil of Barus' law without compressibility over a wavy surface."""
    contact = {"reduced_radius": RADIUS, "reduced_modulus": MODULUS}
    contact |= {"max_hertz_pressure": pressure, "entrainment_speed": speed}
    oil = {"viscosity": VISCOSITY, "viscosity_law": "barus", "pressure_viscosity_coefficient": ALPHA}
    oil |= {"density_law": "incompressible", "density": 850.0}
    oil |= {"permittivity_law": "constant", "relative_permittivity": 2.2}
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": amplitude, "wavelength": wavelength}
    grid = {"nodes": 801, "wedge": wedge}
    case = Case.from_dict({"contact": contact, "lubricant": oil, "roughness": [wave], "grid": grid})
    return solve(case).film


def flow_of(film, hertz, speed, wedge):
    """Flow of oil through all faces, parts of lower order there, and the nodes that are full."""
    half = 4.0 * RADIUS * hertz / MODULUS
    x, gap, p = film.x / half, film.thickness * RADIUS / half**2, film.pressure / hertz
    step, theta, full = x[1] - x[0], film.film_fraction, film.film_fraction > 1.0 - 1e-12
    fluidity = np.exp(-ALPHA * film.pressure)
    change = np.diff(np.log(fluidity))
    plain = np.abs(change) < 1e-6
    mean = np.where(
        plain, 0.5 * (fluidity[1:] + fluidity[:-1]), np.diff(fluidity) / np.where(plain, 1.0, change)
    )
    face = 0.5 * (gap[1:] + gap[:-1])
    epsilon = face**3 * mean / (6.0 * VISCOSITY * 2.0 * speed * RADIUS**2 / (half**3 * hertz))
    if wedge != "third-order":
        nodes = gap**3 * fluidity / (6.0 * VISCOSITY * 2.0 * speed * RADIUS**2 / (half**3 * hertz))
        epsilon = 0.5 * (nodes[1:] + nodes[:-1])
    # Weights of the nodes.
    scale = np.full(len(x), 0.01)
    scale[1:-1] = np.minimum(0.1 * gap[1:-1] * step / (epsilon[1:] + epsilon[:-1]), 0.01)
    excess = p - p[0]
    w = excess**2 / (excess**2 + scale**2)
    w[:2] = 1.0
    w, m = np.where(full, w, 0.0), np.where(full, gap, 0.0)

    def q(ratio):
        s = np.maximum(ratio - 1.3, 0.0)
        return s**2 / (1.0 + s**2)

    c, d = np.concatenate([[0.0], q(gap[:-1] / gap[1:])]), q(gap[1:] / gap[:-1])
    before = np.concatenate([m[:1], m[:-2]])
    a, b = np.concatenate([[0.0], w[:-2] * full[1:-1]]), w[:-1] * w[1:] * (1.0 - d)
    upwind = m[:-1] + 0.5 * b * (m[1:] - m[:-1])
    second = 0.5 * (3.0 * m[:-1] - before)
    high = {
        "third-order": (1.0 - b) * second + b * (3.0 * m[1:] + 6.0 * m[:-1] - before) / 8.0,
        "second-order": second,
    }
    weighted = m[:-1] if wedge == "first-order" else (1.0 - a) * upwind + a * high[wedge]
    part = np.where(full, c, 0.0)[:-1]
    mass = (1.0 - part) * weighted + part * upwind
    # Cavitated nodes, the first one behind a full node as if it were full.
    g = np.where(np.concatenate([[False], full[:-1]]), np.concatenate([[0.0], w[:-1]]) * (1.0 - c), 0.0)
    g = 0.0 * g if wedge == "first-order" else g
    held = theta * gap
    behind = held + 0.5 * g * (held - np.concatenate([held[:1], held[:-1]]))
    mass = np.where(full[:-1], mass, behind[:-1])
    return mass - epsilon * np.diff(p) / step, part, full


CAVITY, STEEP = (5e8, 1.0, 3e-7, 60e-6), (5e8, 0.05, 4e-7, 30e-6)


@pytest.mark.parametrize(
    ("contact", "wedge"),
    [(CAVITY, "third-order"), (CAVITY, "second-order"), (CAVITY, "first-order"), (STEEP, "third-order")],
)
def test_the_flow_of_the_page_is_the_same_through_all_faces(contact, wedge):
    hertz, speed, *_ = contact
    flow, part, full = flow_of(film_of(*contact, wedge), hertz, speed, wedge)
    assert not full.all()
    assert np.any(part[1:-1] > 0.01) == (contact is STEEP)
    assert np.max(np.abs(np.diff(flow)[1:-1])) < 1e-8 * np.median(flow)
