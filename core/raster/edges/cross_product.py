"""The line through two points of the homogeneous window as a cross product; which corners are the ends of an edge."""

from typing import Any

import numpy as np

FIRST = np.array([0, 1, 2])
NEXT = np.array([1, 2, 0])
LAST = np.array([2, 0, 1])
"""Corner k itself, and the two that follow it counter-clockwise: the ends of edge k."""


def cross(x1: Any, y1: Any, w1: Any, x2: Any, y2: Any, w2: Any) -> tuple[Any, Any, Any]:
    """Return the cross products (3, P) of (x1, y1, w1) and (x2, y2, w2): lines through two homogeneous points.

    Every product and sum is one of the numbers' own type.
    """
    return y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
