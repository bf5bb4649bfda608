"""What the tests of measurements and the documentation share in one run."""

import numpy as np
import pytest

from tests.helpers.shared import SHARED, shared

pytestmark = pytest.mark.measured


@pytest.mark.parametrize("kept", [False, True])
def test_arrays_are_computed_once_for_the_same_inputs(tmp_path, monkeypatch, kept):
    monkeypatch.delenv(SHARED, raising=False)
    if kept:
        monkeypatch.setenv(SHARED, str(tmp_path))
    computed = []

    def compute(value):
        computed.append(value)
        return [np.array([value]), np.array([[np.nan, -0.0]])]

    for value in (0.1, 0.1, 0.2):
        one, other = shared(lambda value=value: compute(value), "film", value)
        assert one.tolist() == [value]
        assert np.isnan(other[0, 0])
        assert np.signbit(other[0, 1])
    assert computed == ([0.1, 0.2] if kept else [0.1, 0.1, 0.2])


def test_what_fails_is_not_kept(tmp_path, monkeypatch):
    monkeypatch.setenv(SHARED, str(tmp_path))
    with pytest.raises(ZeroDivisionError):
        shared(lambda: [np.array(1 / 0)], "film")
    assert shared(lambda: [np.array(2.0)], "film")[0] == 2.0
