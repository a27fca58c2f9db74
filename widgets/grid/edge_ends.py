"""Both ends of edges in the window, also of those that end behind the eye: there they have no end in sight."""

import numpy as np
from numpy.typing import NDArray

FAR = 2.0**22
"""Pixels that an edge goes on towards a vertex behind the eye: beyond every raster."""


def edge_segments(
    vertices: NDArray[np.float64], behind: NDArray[np.float64] | None, pairs: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return (N, 2, 2) float64 the ends of edges in the window.

    Parameters
    ----------
    vertices : (V, 2) float64 array
        Window positions; NaN: none.
    behind : (V, 3) float64 array or None
        Homogeneous window coordinates (x w, y w, w) of the vertices at w <= 0, else NaN.
    pairs : (N, 2) integer array
        The vertices at both ends of each edge.

    Notes
    -----
    From the end p in front, the edge to (X, Y, W) begins in the direction (X, Y) - W p, for any W: what is seen of it
    is a ray, since it meets the plane w = 0 infinitely far away.
    """
    ends: NDArray[np.float64] = vertices[pairs]
    if behind is None:
        return ends
    for here, there in ((0, 1), (1, 0)):
        start = ends[:, here]
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            direction = towards(start, behind[pairs[:, there]])
            reached = start + direction / np.linalg.norm(direction, axis=1, keepdims=True) * FAR
        is_ray = np.isfinite(reached).all(axis=1)
        ends[is_ray, there] = reached[is_ray]
    return ends


def towards(start: NDArray[np.float64], goal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (..., 2) the direction in which goals (..., 3) in homogeneous window coordinates lie, of any length."""
    direction: NDArray[np.float64] = goal[..., :2] - start * goal[..., 2:]
    return direction
