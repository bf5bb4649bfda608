"""Names of axle that other packages may import."""

from .result import AxleResult as AxleResult
from .result import solve_axle as solve_axle
from .run import save as save
from .run import solve_to_folder as solve_to_folder
