"""The Utah teapot: the Bezier patches of M. Newell, tessellated.

Body, lid and bottom are curves that turn about the z axis; handle and spout are given for one side and mirrored.
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import Mesh
from lessons.shapes import grid_triangles

QUARTER = 0.56
"""How far the inner control points of a quarter turn stand off, for radius 1: Newell's round number for 0.5523."""

CURVES = (
    ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),
    ((1.5, 2.4), (1.75, 1.875), (2.0, 1.35), (2.0, 0.9)),
    ((2.0, 0.9), (2.0, 0.45), (1.5, 0.225), (1.5, 0.15)),
    ((0.0, 3.15), (0.8, 3.15), (0.0, 2.85), (0.2, 2.7)),
    ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),
    ((1.5, 0.15), (1.5, 0.075), (1.425, 0.0), (0.0, 0.0)),
)
"""Rim, body, foot, knob, lid and bottom: radius and height of four control points each."""

HANDLE = (
    ((-1.6, 2.025), (-1.5, 2.25), 0.3),
    ((-2.3, 2.025), (-2.5, 2.25), 0.3),
    ((-2.7, 2.025), (-3.0, 2.25), 0.3),
    ((-2.7, 1.8), (-3.0, 1.8), 0.3),
    ((-2.7, 1.575), (-3.0, 1.35), 0.3),
    ((-2.5, 1.125), (-2.65, 0.9375), 0.3),
    ((-2.0, 0.9), (-1.9, 0.6), 0.3),
)
SPOUT = (
    ((1.7, 1.425), (1.7, 0.6), 0.66),
    ((2.6, 1.425), (3.1, 0.825), 0.66),
    ((2.3, 2.1), (2.4, 2.025), 0.25),
    ((2.7, 2.4), (3.3, 2.4), 0.25),
    ((2.8, 2.475), (3.525, 2.49375), 0.25),
    ((2.9, 2.475), (3.45, 2.5125), 0.15),
    ((2.8, 2.4), (3.2, 2.4), 0.15),
)
"""Rows of control points of two patches that share the fourth row: both ends (x, z) at y = 0, and the half width."""


def patches() -> Floats:
    """Return the control points as (32, 4, 4, 3) float64, z up; seen from outside, the second index turns left.

    References
    ----------
    M. Newell, The utilization of procedure models in digital image synthesis, 1975; F. C. Crow, The origins of the
    teapot, 1987.
    """
    found = [_turned(np.array(curve), quarter) for curve in CURVES for quarter in range(4)]
    for rows in (HANDLE, SPOUT):
        tube = np.array([[(a, 0, b), (a, half, b), (c, half, d), (c, 0, d)] for (a, b), (c, d), half in rows])
        for half_tube in (tube[:4], tube[3:]):
            # One mirror turns the patch over, so the other side runs along its rows backwards.
            found += [half_tube, (half_tube * (1, -1, 1))[:, ::-1]]
    return np.array(found)


def _turned(curve: Floats, quarter: int) -> Floats:
    """Return the patch (4, 4, 3) of a curve (4, 2) of radius and height, turned through one quarter."""
    arc = np.array([(1, 0), (1, QUARTER), (QUARTER, 1), (0, 1)])
    for _ in range(quarter):
        arc = np.stack([-arc[:, 1], arc[:, 0]], axis=1)
    radius, height = curve[:, 0, None, None], np.broadcast_to(curve[:, 1, None, None], (4, 4, 1))
    return np.concatenate([radius * arc, height], axis=2)


def teapot(cells: int = 6, height: float = 1.3) -> Mesh:
    """Return the teapot around the origin, y up: ``cells`` x ``cells`` cells of two triangles for each of 32 patches.

    The first row of the knob and the last one of the bottom are single points: their cells keep one triangle, and
    their normals point along the axis. Patches do not share vertices, but those on a common border are equal.
    """
    control = patches()
    t = np.linspace(0, 1, cells + 1)
    weights = np.stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1)
    slopes = np.stack([-((1 - t) ** 2), (1 - t) * (1 - 3 * t), t * (2 - 3 * t), t**2], axis=1)

    def evaluate(down: Floats, across: Floats) -> Floats:
        return np.asarray(np.einsum("ia,pabk,jb->pijk", down, control, across))

    places = evaluate(weights, weights)
    normals = np.cross(evaluate(slopes, weights), evaluate(weights, slopes))
    lengths = np.linalg.norm(normals, axis=3, keepdims=True)
    axis = np.where(places[..., 2:] > 1, 1.0, -1.0) * (0.0, 0.0, 1.0)
    normals = np.where(lengths > 1e-9, normals / np.maximum(lengths, 1e-9), axis)

    cell_triangles, _ = grid_triangles(cells, cells)
    first = np.arange(len(control)) * (cells + 1) ** 2
    triangles = (first[:, None, None] + cell_triangles[:, [0, 2, 1]]).reshape(-1, 3)
    corners = places.reshape(-1, 3)[triangles]
    has_area = (
        np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 1e-9
    )
    grid = np.stack(np.meshgrid(t, t), axis=-1)
    scale = height / places[..., 2].max()
    return Mesh(
        positions=scale
        * (places - (0, 0, places[..., 2].max() / 2)).reshape(-1, 3)[:, [0, 2, 1]]
        * (1, 1, -1),
        triangles=triangles[has_area],
        normals=normals.reshape(-1, 3)[:, [0, 2, 1]] * (1, 1, -1),
        uvs=np.tile(grid.reshape(-1, 2), (len(control), 1)),
        faces=np.repeat(np.arange(len(control)), 2 * cells**2)[has_area],
        name="teapot",
    )
