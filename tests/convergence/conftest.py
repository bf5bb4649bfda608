import numpy as np
import pytest


@pytest.fixture(scope="session")
def slope():
    """Observed order: slope of log error against log spacing, by least squares."""

    def fit(spacings, errors):
        return np.polyfit(np.log(spacings), np.log(errors), 1)[0]

    return fit
