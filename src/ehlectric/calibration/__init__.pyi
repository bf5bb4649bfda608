"""Names of calibration that other packages may import."""

from .calibrated_files import written_input as written_input
from .range_update import calibrate as calibrate
from .range_update import check_measured as check_measured
from .range_update import given_points as given_points
from .result import CalibratedInput as CalibratedInput
from .result import Calibration as Calibration
from .result import Compared as Compared
from .run import calibrate_to_folder as calibrate_to_folder
