"""Bones: each joint turns about its head, and a vertex follows the bones that it hangs on, by its weights.

A joint's matrix takes a point of the rest pose to where the bone takes it: pose times inverse bind. Linear blending
adds up the points where the bones take a vertex; so halfway between two turns it lies on the chord, nearer to the
joint: a bent elbow gets thin, and a twist by half a turn collapses. Dual quaternions blend the turns themselves.

References
----------
N. Magnenat-Thalmann, R. Laperriere, D. Thalmann, *Joint-dependent local deformations for hand animation and object
grasping*, Graphics Interface 1988.
J. Lewis, M. Cordner, N. Fong, *Pose space deformation*, SIGGRAPH 2000 (names both faults).
L. Kavan, S. Collins, J. Zara, C. O'Sullivan, *Skinning with dual quaternions*, I3D 2007.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from core.methods import method
from core.records.arrays import Floats, Integers, cached_property
from core.records.deformations import Skin
from core.transform.matrices import transform, translation
from core.transform.vertex_stage import unit

Placed = tuple[Floats, Floats]
"""Positions and unit normals (N, 3) after skinning."""


@dataclass(frozen=True, eq=False)
class Joints:
    """What J bones do to a point of the rest pose."""

    matrices: Floats
    """(J, 4, 4) float64, pose times inverse bind: object space to object space."""
    rotations: Floats
    """(J, 4) float64, unit quaternions w, x, y, z of the turns."""

    @cached_property
    def duals(self) -> Floats:
        """(J, 4) float64, the dual parts: half the move times the turn."""
        move = np.column_stack([np.zeros(len(self.matrices)), self.matrices[:, :3, 3]])
        return quaternion_product(move, self.rotations) / 2


def rotation(axis: Floats, angle: float) -> Floats:
    """Return the (4, 4) matrix that turns about a unit axis (3,) through the origin, by O. Rodrigues' formula."""
    x, y, z = axis
    c, s = np.cos(angle), np.sin(angle)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    matrix = np.eye(4)
    matrix[:3, :3] = c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis)
    return matrix


def joints_of(skin: Skin) -> Joints:
    """Return matrices and turns of all bones: a child is turned with its parent, then about its own head."""
    matrices, rotations = np.empty((skin.joint_count, 4, 4)), np.empty((skin.joint_count, 4))
    for joint, parent in enumerate(skin.parents.tolist()):
        head, angle = skin.heads[joint], float(skin.angles[joint])
        own = translation(*head) @ rotation(skin.axes[joint], angle) @ translation(*-head)
        turn = np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * skin.axes[joint]])
        if angle == 0:
            own = np.eye(4)
        matrices[joint] = own if parent < 0 else matrices[parent] @ own
        rotations[joint] = turn if parent < 0 else quaternion_product(rotations[parent], turn)
    return Joints(matrices, rotations)


def quaternion_product(first: Floats, second: Floats) -> Floats:
    """Return the products (..., 4) of quaternions (..., 4), w, x, y, z each: the second turn is made first."""
    a, b = np.moveaxis(first, -1, 0), np.moveaxis(second, -1, 0)
    return np.stack(
        [
            a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
        ],
        axis=-1,
    )


def cross(a: Floats, b: Floats) -> Floats:
    """Return cross products (..., 3) of vectors (..., 3), written out."""
    (ax, ay, az), (bx, by, bz) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def dot(a: Floats, b: Floats) -> Floats:
    """Return dot products (...,) of vectors (..., K), added from left to right."""
    total = a[..., 0] * b[..., 0]
    for k in range(1, a.shape[-1]):
        total = total + a[..., k] * b[..., k]
    return np.asarray(total)


def where_bones_take(positions: Floats, matrices: Floats) -> Iterator[Floats]:
    """Yield (N, 3) for each of the (J, 4, 4) matrices of bones: where it takes points (N, 3) of the rest pose."""
    points = np.column_stack([positions, np.ones(len(positions))])
    for matrix in matrices:
        yield transform(matrix, points)[:, :3]


def blended_matrices(weights: Floats, matrices: Floats) -> Floats:
    """Return (N, 3, 3): the turning parts of (J, 4, 4) matrices, added with weights (N, J)."""
    blended = np.zeros((len(weights), 3, 3))
    for joint, matrix in enumerate(matrices):
        blended = blended + weights[:, joint, None, None] * matrix[:3, :3]
    return blended


def blended_component(weights: Sequence[float], products: Sequence[float]) -> float:
    """Listing of one component of a vertex: where its bones take it, by its weights."""
    total = 0.0
    for weight, product in zip(weights, products, strict=True):
        total += weight * product  #: add
    return total


def turned_normal(matrix: Sequence[Floats], normal: Floats) -> Floats:
    """Listing of a normal under a blended matrix, rows (3, 3): its cofactors times the normal, made unit."""
    a, b, c = matrix
    turned = np.array([dot(cross(b, c), normal), dot(cross(c, a), normal), dot(cross(a, b), normal)])
    return turned / sqrt(turned @ turned)  #: normal


@method(
    "skinning",
    "linear",
    "Linear blending",
    source="Magnenat-Thalmann et al. 1988; Pellacini, vertex processing: skinning",
    exact_for="vertices of one bone, and bones that only move: weights that sum to 1 keep a common move",
    breaks_where="a joint bent by t keeps |cos(t/2)| of its width where both weights are 1/2; a twist by half a turn "
    "collapses: the candy wrapper. Normals leave out how weights change from vertex to vertex",
    listing=blended_component,
)
def skin_linear(skin: Skin, positions: Floats, normals: Floats) -> Placed:
    """Add up where the bones take each vertex (N, 3), times its weights; normals (N, 3) by the cofactors of the sum."""
    placed = np.zeros_like(positions)
    matrices = joints_of(skin).matrices
    for joint, moved in enumerate(where_bones_take(positions, matrices)):
        placed = placed + skin.weights[:, joint, None] * moved
    a, b, c = np.moveaxis(blended_matrices(skin.weights, matrices), 1, 0)
    turned = np.stack(
        [dot(cross(b, c), normals), dot(cross(c, a), normals), dot(cross(a, b), normals)], axis=1
    )
    return placed, unit(turned)


def added_quaternion(
    weight: float, real: Floats, dual: Floats, pivot: Floats, sum_real: Floats, sum_dual: Floats
) -> tuple[int, Floats, Floats]:
    """Listing of one bone: its dual quaternion is added on the side of that of the largest weight."""
    side = 1 if dot(real, pivot) >= 0 else -1  #: side
    sum_real = sum_real + side * weight * real  #: real
    sum_dual = sum_dual + side * weight * dual  #: dual
    return side, sum_real, sum_dual


def moved_by_quaternion(sum_real: Floats, sum_dual: Floats, point: Floats) -> Floats:
    """Listing of a point (3,) moved by a sum of dual quaternions (4,) each, w first."""
    length = np.sqrt(dot(sum_real, sum_real))  #: length
    real, dual = sum_real / length, sum_dual / length  #: unit
    w, v, e, u = real[0], real[1:], dual[0], dual[1:]
    turned = point + 2 * cross(v, cross(v, point) + w * point)  #: turn
    return np.asarray(turned + 2 * (w * u - e * v + cross(v, u)))  #: move


@method(
    "skinning",
    "dual-quaternion",
    "Dual quaternions",
    source="Kavan et al. 2007",
    exact_for="width: every vertex is turned and moved as a whole, so nothing collapses",
    breaks_where="a bent joint bulges on its outer side, and bones that scale are none",
    listing=moved_by_quaternion,
)
def skin_by_quaternions(skin: Skin, positions: Floats, normals: Floats) -> Placed:
    """Blend the unit dual quaternions of the bones on one side, make the sum unit, move vertices (N, 3) by it."""
    *_, (_, real, dual) = quaternion_sums(skin.weights, joints_of(skin))
    length = np.sqrt(dot(real, real))[:, None]
    real, dual = real / length, dual / length
    w, v, e, u = real[:, :1], real[:, 1:], dual[:, :1], dual[:, 1:]
    turned = positions + 2 * cross(v, cross(v, positions) + w * positions)
    return turned + 2 * (w * u - e * v + cross(v, u)), unit(
        normals + 2 * cross(v, cross(v, normals) + w * normals)
    )


def quaternion_sums(weights: Floats, joints: Joints) -> Iterator[tuple[Integers, Floats, Floats]]:
    """Yield, bone by bone, the side (N,) on which it is added, and the sums (N, 4) of real and dual parts with it."""
    count = len(weights)
    pivot = joints.rotations[weights.argmax(axis=1)]
    sum_real, sum_dual = np.zeros((count, 4)), np.zeros((count, 4))
    for joint, (real, dual) in enumerate(zip(joints.rotations, joints.duals, strict=True)):
        side = np.where(dot(np.broadcast_to(real, pivot.shape), pivot) >= 0, 1, -1)
        weight = (side * weights[:, joint])[:, None]
        sum_real, sum_dual = sum_real + weight * real, sum_dual + weight * dual
        yield side, sum_real, sum_dual
