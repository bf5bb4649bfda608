"""Names of axle that other packages may import."""

from .axle_discharges import AxleDischarges as AxleDischarges
from .axle_duty import AxleDuty as AxleDuty
from .axle_netlist_files import axle_netlist as axle_netlist
from .axle_netlist_files import write_axle_netlist as write_axle_netlist
from .many_axles import solve_axles as solve_axles
from .measurable import AxleModel as AxleModel
from .result import AxleResult as AxleResult
from .result import solve_axle as solve_axle
from .run import result_of as result_of
from .run import save as save
from .run import solve_to_folder as solve_to_folder
from .solution import CONDUCTIONS as CONDUCTIONS
from .solution import AxleSolution as AxleSolution
from .solution import Element as Element
from .solution import forces_on_shafts as forces_on_shafts
from .solution import loads_on_shafts as loads_on_shafts
from .stored import SCHEMA as SCHEMA
from .summary import axle_summary as axle_summary
from .summary import ratio_word as ratio_word
from .summary import tables_of_point as tables_of_point
from .summary import worst_ratio as worst_ratio
