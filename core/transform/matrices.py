"""The five matrices of the vertex transform ``p' = D P C^-1 M p``, and the projection of reversed z.

References
----------
M. Zwicker, *Computergrafik*, lecture "The complete vertex transform", Bern 2016.

For a perspective camera at distance w the clip coordinates of the usual projection are z = ((f + n) w - 2 f n)/(f - n)
and w. Those of the reversed one are n (f - w)/(f - n) and w: what is small for far surfaces is computed as a small
number, while (1 - z/w)/2 would be left over from the difference of two large ones. Their quotient is linear over the
window, so that it is interpolated like z.

Where there is only clip space (``ClipScene``), and for an orthographic camera, it is (w - z)/2 over w in float64:
no more exact than the z that was given.

References
----------
E. Lapidous, G. Jiao, *Optimal depth buffer for low-cost graphics hardware*, 1999.
N. Reed, *Depth precision visualized*, 2015.
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import Camera

# The five matrices of the vertex transform ``p' = D P C^-1 M p``, for column vectors.


def transform(matrix: Floats, points: Floats) -> Floats:
    """Return ``matrix @ p`` for every point, each sum written out from left to right.

    Parameters
    ----------
    matrix : (4, 4) float64
    points : (..., 4) float64

    Returns
    -------
    (..., 4) float64
        A view of four contiguous rows, one for each component.

    Notes
    -----
    A matrix product would let the library choose the order of the sums, and a vertex could come out
    different in the last bit in a batch of another size. Products with a zero of the matrix are left out:
    finite points get the same sum.
    """
    rows = np.empty((4, *points.shape[:-1]))
    product = np.empty(points.shape[:-1])
    for k, row in enumerate(matrix):
        total = rows[k, ...]
        used = np.flatnonzero(row)
        if len(used):
            np.multiply(row[used[0]], points[..., used[0]], out=total)
        else:
            total[...] = 0.0
        for column in used[1:]:
            np.multiply(row[column], points[..., column], out=product)
            total += product
        if row[3] == 0:
            total += 0.0  # what the last product would do: -0.0 becomes 0.0
    return np.moveaxis(rows, 0, -1)


def transform_component(row: Floats, point: Floats) -> float:
    """Listing of one component of a transformed point."""
    x, y, z, w = point
    first = row[0] * x
    second = first + row[1] * y
    third = second + row[2] * z
    return float(third + row[3] * w)  #: fourth


def translation(x: float, y: float, z: float) -> Floats:
    """Return the (4, 4) matrix that moves by (x, y, z)."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def scaling(x: float, y: float, z: float) -> Floats:
    """Return the (4, 4) matrix that scales by x, y and z."""
    return np.diag([x, y, z, 1.0])


def rotation(axis: Floats, angle: float) -> Floats:
    """Return the (4, 4) rotation about ``axis`` (3,) by ``angle`` radians, counter-clockwise (Rodrigues)."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)
    return matrix


def camera_axes(camera: Camera) -> Floats:
    """Return (3, 3): the camera's right, up and backward unit vectors in world space, one a row."""
    backward = camera.eye - camera.target
    backward = backward / np.linalg.norm(backward)
    right = np.cross(camera.up, backward)
    right = right / np.linalg.norm(right)
    return np.array([right, np.cross(backward, right), backward])


def world_to_camera(camera: Camera) -> Floats:
    """Return C^-1, (4, 4): the camera's matrix is a rotation and a translation, so its inverse is exact."""
    axes = camera_axes(camera)
    matrix = np.eye(4)
    matrix[:3, :3] = axes
    # Every point of the line of sight has the same x and y; that of the smaller numbers rounds least, a 0 not at all.
    on_sight = min(camera.eye, camera.target, key=np.linalg.norm)
    matrix[:2, 3] -= axes[:2] @ on_sight
    matrix[2, 3] -= axes[2] @ camera.eye
    return matrix


def projection(camera: Camera, aspect: float) -> Floats:
    """Return P, (4, 4): camera space to clip space, w > 0 in front of the eye, NDC in [-1, 1]^3.

    Parameters
    ----------
    aspect : float
        Width over height of the raster.

    Notes
    -----
    LMU's tutorial prints a projection whose w is *negative* in front of the eye; Zwicker's rule "all w < 0:
    behind" and this program want it positive.
    """
    near, far = camera.near, camera.far
    if camera.projection == "orthographic":
        half = camera.view_height / 2
        return np.array(
            [
                [1 / (half * aspect), 0, 0, 0],
                [0, 1 / half, 0, 0],
                [0, 0, -2 / (far - near), -(far + near) / (far - near)],
                [0, 0, 0, 1],
            ]
        )
    scale = 1 / np.tan(camera.field_of_view / 2)
    return np.array(
        [
            [scale / aspect, 0, 0, 0],
            [0, scale, 0, 0],
            [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)],
            [0, 0, -1, 0],
        ]
    )


def viewport(width: int, height: int) -> Floats:
    """Return D, (4, 4): NDC to window, x in [0, width], y in [0, height] upwards, depth in [0, 1]."""
    return np.array(
        [[width / 2, 0, 0, width / 2], [0, height / 2, 0, height / 2], [0, 0, 0.5, 0.5], [0, 0, 0, 1]]
    )


# The projection of reversed z: depth that is 1 at the near plane and 0 at the far plane, without 1 - z.


def reversed_clip_depth(z: Floats, w: Floats, view_range: tuple[float, float] | None) -> Floats:
    """Return the clip coordinate that takes the place of (z + w)/2; divided by w it is the reversed depth.

    Parameters
    ----------
    z, w : (...) float64, any shape
        Clip coordinates.
    view_range : (near, far), optional
        Distances of the planes of a perspective camera, whose w is the distance; ``None``: z decides.
    """
    if view_range is None:
        return (w - z) / 2
    near, far = view_range
    return near * ((far - w) / (far - near))
