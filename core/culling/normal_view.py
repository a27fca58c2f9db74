"""Culling by N . V: the face normal and the vector from the eye to the face, in camera space.

N . V above 0 turns a face away. With N = (b - a) x (c - a) and V = a it is det(a, b, c): up to the factors of the
projection, which are positive, the determinant of the (x, y, w) matrix with the other sign. So the two agree for every
triangle, behind the eye too; a triangle without area, or one whose plane contains the eye, has neither side. They
part where

- snapping turns a thin triangle over: coverage and ``back`` look at the snapped corners;
- N is not made from the corners that are drawn. A normal that the mesh brings along has to be carried by the inverse
  transpose of the matrix: carried by the matrix itself, non-uniform scaling tilts it. A mirroring matrix turns the
  corners around but not this normal, so it still points out of a closed mesh;
- V is the direction in which the camera looks: the classical error, right for an orthographic camera alone.

Triangles given in clip space have no camera space: (x, y, -w) stands for it.

References
----------
M. I. Jubair, "Backface Culling" (N . V > 0 culls, V leads from the eye to the polygon); F. Pellacini, "culling".
J. F. Blinn, *Backface culling snags*, IEEE CG&A 13(6), 1993.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import RETURN, Operation
from core.transform.vertex_stage import VertexStage

AXIS = (0.0, 0.0, -1.0)
"""Where a camera looks."""
PRODUCT_ERROR = 2.0**-49
"""Rounding error of N . V over the sum of the sizes of its terms."""
SMALLEST = 2.0**-1022
"""In place of products that round to 0."""
Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class EyeTriangles:
    """T triangles in camera space, and what takes them there."""

    corners: Floats
    """(3, 3, T) float64, x, y and z of the corners in camera space: corner, axis, triangle."""
    given: Floats
    """(3, 3, T) float64, the same in object space."""
    carry: Floats
    """(T, 3, 3) float64, the part of C^-1 M that turns and stretches."""
    is_parallel: bool
    """Whether the camera looks at all points in the same direction."""


@dataclass(frozen=True, eq=False)
class NormalView:
    """N . V of T triangles."""

    eye: EyeTriangles
    normal: Floats
    """(T, 3) float64, N in camera space."""
    view: Floats
    """(T, 3) float64, V in camera space."""
    product: Floats
    """(T,) float64, N . V: above 0 is turned away. Its sign is that of exact arithmetic on the corners."""
    is_parallel: bool
    """Whether V is the direction of the camera."""
    drops: Flags | None = None
    """(T,) bool, what an edited listing drops; ``None``: what has N . V above 0."""


def eye_triangles(vertices: VertexStage, triangle: Integers) -> EyeTriangles:
    """Return the triangles (T,) of a scene in camera space."""
    corner = vertices.corner_rows.take(triangle, axis=1)
    x, y, _, w = vertices.clip_rows
    eye, given = np.stack([x, y, -w]), None
    carry = np.broadcast_to(np.eye(3), (len(triangle), 3, 3))
    is_parallel = False
    if vertices.camera is not None and (vertices.camera[:, 3] == 1).all():
        assert vertices.view is not None
        assert vertices.model is not None
        assert vertices.object is not None
        assert vertices.projection is not None
        eye, given = vertices.camera.T[:3], vertices.object.T[:3]
        turns = np.stack([(vertices.view @ model)[:3, :3] for model in vertices.model])
        carry = turns.take(vertices.mesh.take(triangle), axis=0)
        is_parallel = vertices.projection[3, 3] == 1
    corners = eye.take(corner, axis=1).transpose(1, 0, 2)
    own = corners if given is None else given.take(corner, axis=1).transpose(1, 0, 2)
    return EyeTriangles(corners, own, carry, is_parallel)


def face_normals(corners: Floats) -> tuple[Floats, Floats]:
    """Return (b - a) x (c - a) of corners (3, 3, T), and the sums of the sizes of its terms; (3, T) each."""
    (ux, uy, uz), (vx, vy, vz) = corners[1] - corners[0], corners[2] - corners[0]
    pairs = ((uy * vz, uz * vy), (uz * vx, ux * vz), (ux * vy, uy * vx))
    return np.stack([p - q for p, q in pairs]), np.stack([np.abs(p) + np.abs(q) for p, q in pairs])


def exact_product(corners: list[Point], view: Point | None) -> float:
    """Return N . V of one triangle, rounded once and never to 0; ``None``: V is the first corner."""
    a, b, c = ([Fraction(value) for value in corner] for corner in corners)
    v = a if view is None else [Fraction(value) for value in view]
    u, s = [y - x for x, y in zip(a, b, strict=True)], [y - x for x, y in zip(a, c, strict=True)]
    normal = (u[1] * s[2] - u[2] * s[1], u[2] * s[0] - u[0] * s[2], u[0] * s[1] - u[1] * s[0])
    product = sum(n * part for n, part in zip(normal, v, strict=True))
    return float(product) or SMALLEST * ((product > 0) - (product < 0))


def normal_view(eye: EyeTriangles, looks_along: bool) -> NormalView:
    """Return N . V with N from the corners; ``looks_along``: V is the direction of the camera, not the first corner."""
    normal, size = face_normals(eye.corners)
    along = looks_along or eye.is_parallel
    view = np.broadcast_to(np.array(AXIS)[:, None], normal.shape) if along else eye.corners[0]
    product = normal[0] * view[0] + normal[1] * view[1] + normal[2] * view[2]
    error = PRODUCT_ERROR * (size * np.abs(view)).sum(axis=0)
    for number in np.flatnonzero(np.abs(product) <= error).tolist():
        corners = eye.corners[..., number].tolist()
        product[number] = exact_product(corners, AXIS if along else None)
    return NormalView(eye, normal.T, view.T, product, along)


def cofactors(carry: Floats) -> tuple[Floats, Floats]:
    """Return the rows of the cofactor matrices of (T, 3, 3), (3, 3, T), and the determinants (T,)."""
    first, second, third = carry.transpose(1, 2, 0)

    def cross(p: Floats, q: Floats) -> Floats:
        return np.stack([p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]])

    rows = np.stack([cross(second, third), cross(third, first), cross(first, second)])
    determinant: Floats = first[0] * rows[0, 0] + first[1] * rows[0, 1] + first[2] * rows[0, 2]
    return rows, determinant


def stored_normal_view(eye: EyeTriangles) -> NormalView:
    """Return N . V with the normal of object space, carried by the inverse transpose; a singular matrix has none."""
    of_corners, (n, _) = normal_view(eye, looks_along=False), face_normals(eye.given)
    (rows, determinant), view = cofactors(eye.carry), of_corners.view.T
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = np.stack([(row[0] * n[0] + row[1] * n[1] + row[2] * n[2]) / determinant for row in rows])
        normal[:, determinant == 0] = 0
        product = normal[0] * view[0] + normal[1] * view[1] + normal[2] * view[2]
        # In exact arithmetic the carried normal is that of the corners over the determinant.
        wanted = np.where(determinant == 0, 0.0, of_corners.product / determinant)
    product = np.where(np.sign(product) == np.sign(wanted), product, wanted)
    return replace(of_corners, normal=normal.T, product=product)


def by_corners(eye: EyeTriangles) -> NormalView:
    """Return N . V with N from the corners, and V from the eye to the first corner; for T triangles."""
    return normal_view(eye, looks_along=False)


def by_axis(eye: EyeTriangles) -> NormalView:
    """Return N . V with N from the corners, and V the direction of the camera; for T triangles."""
    return normal_view(eye, looks_along=True)


def turns_away(corners: list[Point], is_parallel: bool) -> tuple[list[float], float, bool]:
    """Listing of N . V: corners (3, 3) in camera space; parallel rays all have the camera's direction."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    ux, uy, uz = bx - ax, by - ay, bz - az
    vx, vy, vz = cx - ax, cy - ay, cz - az
    n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]  #: normal
    view = (0.0, 0.0, -1.0) if is_parallel else (ax, ay, az)  #: view
    product = n[0] * view[0] + n[1] * view[1] + n[2] * view[2]  #: product
    return n, product, product > 0  #: test


def stored_turns_away(
    given: list[Point], carry: list[Point], corner: Point, is_parallel: bool
) -> tuple[list[float], float, bool]:
    """Listing with the mesh's N: object corners (3, 3), rows of C^-1 M (3, 3), the first corner in camera space."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = given
    u = bx - ax, by - ay, bz - az
    v = cx - ax, cy - ay, cz - az
    n = _cross(u, v)  #: stored
    a, b, c = carry
    cofactors = _cross(b, c), _cross(c, a), _cross(a, b)
    determinant = _dot(a, cofactors[0])  #: determinant
    n = [_dot(row, n) / determinant for row in cofactors]  #: carried
    view = (0.0, 0.0, -1.0) if is_parallel else corner  #: view
    product = _dot(n, view)  #: product
    return n, product, product > 0  #: test


def _cross(a: Sequence[float], b: Sequence[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


_NORMAL = Operation("normal", "normal", {"normal": "n"})
_TESTS = (
    Operation("view", "view", ("view",)),
    Operation("product", "product", ("product",)),
    Operation("test", "test", {"applies": RETURN, "verdict": RETURN}),
)


@method(
    "cull",
    "back-normal",
    "Back faces, by N · V",
    source="Jubair, Backface culling: N . V > 0",
    exact_for="closed surfaces seen from outside; the same faces as by the determinant of (x, y, w)",
    breaks_where="thin triangles that snapping turns over; a mirroring transform turns N over with the corners",
    listing=turns_away,
    operations={"back-normal": (_NORMAL, *_TESTS)},
    traits=by_corners,
)
def cull_by_normal(facing: Floats) -> Flags:
    """Drop triangles with N . V above 0. (T,) -N . V to (T,) bool."""
    return np.asarray(facing < 0)


@method(
    "cull",
    "back-axis",
    "Back faces, by N · view direction",
    source="The classical error, as in Blinn 1993, Backface culling snags",
    exact_for="orthographic cameras, whose rays are parallel",
    breaks_where="perspective: faces beside the centre that turn between the axis and their own ray are dropped or "
    "kept wrongly",
    listing=turns_away,
    operations={"back-axis": (_NORMAL, *_TESTS)},
    traits=by_axis,
)
def cull_by_axis(facing: Floats) -> Flags:
    """Drop triangles whose normal leads along the view. (T,) -N . V to (T,) bool."""
    return np.asarray(facing < 0)


@method(
    "cull",
    "back-stored-normal",
    "Back faces, by the mesh's own N · V",
    source="Jubair, Backface culling: before the pipeline starts; Blinn 1993, Backface culling snags",
    exact_for="closed surfaces seen from outside, mirrored ones too: N still points out of them",
    breaks_where="N carried by the matrix itself: non-uniform scaling tilts it; a singular matrix carries no normal",
    listing=stored_turns_away,
    operations={
        "back-stored-normal": (
            Operation("stored", "stored", {"stored": "n"}),
            Operation("determinant", "determinant", ("determinant",)),
            Operation("carried", "carried", {"normal": "n"}),
            *_TESTS,
        )
    },
    traits=stored_normal_view,
)
def cull_by_stored_normal(facing: Floats) -> Flags:
    """Drop triangles with N . V above 0, N as the mesh has it. (T,) -N . V to (T,) bool."""
    return np.asarray(facing < 0)
