"""Names of gear that other packages may import."""

from .discharge_places import discharge_places as discharge_places
from .gear_verdict import state_at as state_at
from .gear_verdict import state_of as state_of
from .gear_warnings import gear_warnings as gear_warnings
from .gear_warnings import warning_codes as warning_codes
from .geometry import GearPair as GearPair
from .geometry import gear_pair as gear_pair
from .mesh_duty import MeshDuty as MeshDuty
from .mesh_duty import MeshRows as MeshRows
from .mesh_duty import check_mesh_duty as check_mesh_duty
from .mesh_duty import mesh_states as mesh_states
from .mesh_forces import Hand as Hand
from .mesh_forces import mesh_forces as mesh_forces
from .points import name_of_place as name_of_place
from .points import weakest as weakest
from .result import GearResult as GearResult
from .result import solve_gear as solve_gear
from .run import result_of as result_of
from .run import save as save
from .run import solve_to_folder as solve_to_folder
from .solution import GearSolution as GearSolution
from .solution import drawing_of as drawing_of
from .solving import solve_gear_pair as solve_gear_pair
from .solving import solve_gear_pairs as solve_gear_pairs
from .stored import SCHEMA as SCHEMA
from .summary import gear_summary as gear_summary
