"""Heights that may mark points without data, by hand."""

import numpy as np
import pytest

from ehlectric.errors import InputError
from ehlectric.surfaces.void_numbers import refuse_void_numbers

HEIGHTS = np.array([0.0, 0.4, 1.0, 0.7])


@pytest.mark.parametrize("far", [-3.1, 4.1])
def test_a_repeated_height_far_from_all_others_is_refused_and_a_lone_one_is_a_peak(far):
    """Far is more than three times the range of the others, which is 1."""
    refuse_void_numbers("a.txt", np.append(HEIGHTS, far))
    with pytest.raises(InputError, match="2 heights"):
        refuse_void_numbers("a.txt", np.append(HEIGHTS, [far, far]))
    near = far + 0.2 * np.sign(0.5 - far)
    refuse_void_numbers("a.txt", np.append(HEIGHTS, [near, near]))
