"""Vector statics of a shaft on two bearings, independent of the package."""

import numpy as np


def by_vectors(forces, places):
    """Reactions of two bearings on a shaft, the first one locating: six equations of equilibrium, solved."""
    # Unknown: forces of A along x, y and z, and of B along x and y on the shaft; moments about the origin.
    matrix, right = np.zeros((5, 5)), np.zeros(5)
    for column, (place, way) in enumerate([(places[0], 0), (places[0], 1), (places[0], 2), (places[1], 0),
                                           (places[1], 1)]):  # fmt: skip
        unit = np.eye(3)[way]
        matrix[:3, column] = unit
        matrix[3:, column] = np.cross([0.0, 0.0, place], unit)[:2]
    for force, at in forces:
        right[:3] -= force
        right[3:] -= np.cross([0.0, 0.0, at], force)[:2]
    return np.linalg.solve(matrix, right)
