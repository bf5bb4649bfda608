"""Point contacts, one for each layout of the figures, and their figures as they are saved."""

import tempfile
from functools import cache
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from ehlectric import Case, solve
from ehlectric.figures.result_figures import save_figures

CIRCLE = {
    "geometry": "point",
    "radius_x": "10 mm",
    "radius_y": "10 mm",
    "reduced_modulus": "226 GPa",
    "load": "20 N",
    "entrainment_speed": "2 m/s",
}
BEARING = {
    "load": "600 N",
    "entrainment_speed": "4 m/s",
    "radius_x": None,
    "radius_y": None,
    "body_1": {"radius_x": "24 mm", "radius_y": "-6.191 mm"},
    "body_2": {"radius_x": "5.953 mm", "radius_y": "5.953 mm"},
}
GAUSSIAN = {"surface": 1, "generator": "gaussian", "rq": "40 nm", "correlation_length": "40 um", "seed": 3}
PIT = {"surface": 2, "generator": "pit", "depth": "200 nm", "width": "60 um", "rim": "20 nm"}


def solved(contact=None, grid=None, solver=None, beside_smooth=True, **tables):
    contact = {key: value for key, value in (CIRCLE | (contact or {})).items() if value is not None}
    grid = {"nodes": 65, "nodes_y": 65, "field_degree": 4} | (grid or {})
    tables |= {"contact": contact, "grid": grid, "lubricant": {"base": "paper"}}
    case = Case.from_dict(tables | ({"solver": solver} if solver else {}))
    return solve(case, beside_smooth=beside_smooth)


KINDS = {
    "circle": {"title": "20 N"},
    "across": {"contact": BEARING, "title": "A ball of a deep groove ball bearing 6208"},
    "along": {"contact": {"radius_x": "200 mm", "load": "60 N"}, "grid": {"nodes_y": 73}, "title": "Along"},
    # Thinner than the boundary film the surfaces would touch, and be solved.
    "unsolved": {
        "contact": BEARING | {"entrainment_speed": "0.05 m/s", "boundary_film": "0.1 nm"},
        "solver": {"max_iterations": 2},
    },
    "gaussian": {
        "grid": {"nodes_y": 49, "wedge": "second-order"},
        "roughness": [GAUSSIAN],
        "title": "Rough, $",
    },
}


# The first kind in every run, the others in long ones: figures take seconds to draw.
EVERY_KIND = pytest.mark.parametrize(
    "kind", [kind if kind == "circle" else pytest.param(kind, marks=pytest.mark.slow) for kind in KINDS]
)


@cache
def result_of(kind):
    return solved(**KINDS[kind])


@cache
def pages(kind):
    """Figures of a contact by the names of their files."""
    saved = []
    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", lambda figure, _, **__: saved.append(figure))
        files = save_figures(result_of(kind), Path(folder))
    return dict(zip((path.name for path in files), saved, strict=True))


def drawn(kind, draw):
    """First axes of the figure that ``draw`` makes."""
    return pages(kind)[f"{draw.__name__}.png"].axes[0]


def on_page(result, x, y):
    """Positions [m] in coordinates of the figure; entrainment points down if the ellipse is long across."""
    b = result.conditions.semi_axis_x
    return (y / b, x / b) if result.conditions.ratio > 1.2 else (x / b, y / b)
