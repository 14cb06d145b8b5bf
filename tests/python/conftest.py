"""Surfaces that several tests need."""

import numpy as np
import pytest

CUBE_POINTS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
CUBE_TRIANGLES = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7],
                  [2, 7, 6], [3, 0, 4], [3, 4, 7]]


@pytest.fixture
def cube():
    """Points and triangles of the unit cube."""
    return np.array(CUBE_POINTS, float), np.array(CUBE_TRIANGLES)
