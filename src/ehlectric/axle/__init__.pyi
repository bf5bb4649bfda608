"""Names of axle that other packages may import."""

from .many_axles import solve_axles as solve_axles
from .result import AxleResult as AxleResult
from .result import solve_axle as solve_axle
from .run import save as save
from .run import solve_to_folder as solve_to_folder
from .summary import tables_of_point as tables_of_point
