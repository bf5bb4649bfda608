"""Names of field that other packages may import."""

from .line_field import Field as Field
from .line_field import field_from_potential as field_from_potential
from .line_field import solve_field as solve_field
from .mesh import columns_within as columns_within
from .mesh import thinned as thinned
from .point_field import PointField as PointField
from .point_field import solve_point_field as solve_point_field
from .poisson import FieldProblem as FieldProblem
from .poisson_3d import PointFieldProblem as PointFieldProblem
from .zones import ATOM as ATOM
from .zones import HIGH_FIELD as HIGH_FIELD
from .zones import Zone as Zone
from .zones import areas as areas
from .zones import areas_by_zone as areas_by_zone
from .zones import contact_zones as contact_zones
