"""Culling: triangles that need not be drawn, each with its reason.

References
----------
LMU, *Computer Graphics 1*, tutorial 5, "Culling"; Jubair, "Backface culling"; F. Pellacini, "culling".
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.methods import method, table

KEPT, BACK_FACING, FRONT_FACING, DEGENERATE, BEHIND_EYE, OUTSIDE_PLANE = range(6)
REASONS = ("kept", "back-facing", "front-facing", "degenerate", "behind-eye", "outside-plane")

PLANES = ("near", "far", "left", "right", "bottom", "top")
"""Planes of the view volume, in clipping order."""
PLANE_COEFFICIENTS = np.array(
    [[0, 0, 1, 1], [0, 0, -1, 1], [1, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1]], float
)
"""(6, 4): the signed distance of a clip position from plane k is the dot product with row k; inside is 0 or more."""


@dataclass(frozen=True, eq=False)
class CullVerdicts:
    """Why each of T triangles is drawn or not."""

    facing: Floats
    """(T,) float64, twice the snapped area or the determinant: positive front, negative back, 0 neither."""
    distances: Floats
    """(T, 3, 6) float64, distance of every corner from every plane of the view volume."""
    verdict: Integers
    """(T,) int64, an index of ``REASONS``; the first that applies in the order behind, outside, degenerate, facing."""
    plane: Integers
    """(T,) int64, the plane that all corners are outside of, else -1."""

    @property
    def kept(self) -> Flags:
        """(T,) bool."""
        return np.asarray(self.verdict == KEPT)


def plane_distances(clip: Floats) -> Floats:
    """Return (..., 6): signed distances w + z, w - z, w + x, w - x, w + y, w - y of clip positions (..., 4)."""
    x, y, z, w = (clip[..., k] for k in range(4))
    return np.stack([w + z, w - z, w + x, w - x, w + y, w - y], axis=-1)


def cull(clip: Floats, facing: Floats, cull_faces: str) -> CullVerdicts:
    """Give every triangle its verdict.

    Parameters
    ----------
    clip : (T, 3, 4) float64
    facing : (T,) float64, see ``core.raster.edge_functions.orient``
    cull_faces : str
        A method of the family ``cull``.
    """
    distances = plane_distances(clip)
    outside = np.all(distances < 0, axis=1)
    verdict = np.where(table.get("cull", cull_faces).function(facing), BACK_FACING, KEPT)
    verdict[(verdict == BACK_FACING) & (facing > 0)] = FRONT_FACING
    verdict[facing == 0] = DEGENERATE
    verdict[outside.any(axis=1)] = OUTSIDE_PLANE
    verdict[(clip[..., 3] <= 0).all(axis=1)] = BEHIND_EYE
    plane = np.where(verdict == OUTSIDE_PLANE, outside.argmax(axis=1), -1)
    return CullVerdicts(facing, distances, verdict, plane)


@method("cull", "none", "Both faces", source="OpenGL 4.6, 14.6.1", exact_for="every scene")
def cull_none(facing: Floats) -> Flags:
    """Drop no face. (T,) facing to (T,) bool."""
    return np.zeros(len(facing), bool)


@method(
    "cull",
    "back",
    "Back faces",
    source="LMU 2020, Culling; Jubair, Backface culling",
    exact_for="closed surfaces seen from outside",
    breaks_where="open surfaces: their backs vanish",
)
def cull_back(facing: Floats) -> Flags:
    """Drop clockwise triangles. (T,) facing to (T,) bool."""
    return np.asarray(facing < 0)


@method(
    "cull",
    "front",
    "Front faces",
    source="OpenGL 4.6, 14.6.1",
    exact_for="insides of closed surfaces",
    breaks_where="everything that is meant to be seen from the front",
)
def cull_front(facing: Floats) -> Flags:
    """Drop counter-clockwise triangles. (T,) facing to (T,) bool."""
    return np.asarray(facing > 0)


def cull_verdict(clip: Floats, facing: float, drops: bool) -> str:
    """Listing of the verdict on one triangle: corners (3, 4), its facing, whether that facing is dropped."""
    if all(corner[3] <= 0 for corner in clip):  #: behind
        return "behind-eye"
    for a, b, c, d in PLANE_COEFFICIENTS:
        if all(a * x + b * y + c * z + d * w < 0 for x, y, z, w in clip):  #: outside
            return "outside-plane"
    if facing == 0:  #: degenerate
        return "degenerate"
    if drops:  #: facing
        return "back-facing" if facing < 0 else "front-facing"
    return "kept"  #: kept
