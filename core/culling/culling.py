"""Culling: triangles that need not be drawn, each with its reason; outcodes say on which side of planes corners are.

A triangle whose corners share a bit is outside that plane as a whole; one whose corners have a bit between them
crosses it, or is outside. So bytes are gathered and joined for a triangle, not six distances of each corner.

References
----------
R. Sproull, I. Sutherland, *A clipping divider*, 1968.

References
----------
LMU, *Computer Graphics 1*, tutorial 5, "Culling"; Jubair, "Backface culling"; F. Pellacini, "culling".
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from core.methods import method
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.primitives import IndexedPrimitives

if TYPE_CHECKING:
    from core.culling.normal_view import NormalView
    from core.culling.object_culling import ObjectCulling


# Outcodes: on which side of which plane a vertex lies, one byte a vertex.


Outcodes = NDArray[np.uint8]

PLANE_BITS = 0b0011_1111
"""Bit k: outside plane k of ``core.culling.culling.PLANES``, its distance is negative."""
BEHIND_BIT = 0b0100_0000
"""w <= 0: the vertex is not in front of the eye."""
RANGE_BIT = 0b1000_0000
"""Not between the near and the far plane in front of the eye."""


def outcodes(clip: Floats) -> Outcodes:
    """Return the outcodes (M,) uint8 of clip positions (M, 4).

    Notes
    -----
    ``w + z < 0`` is the same as ``z < -w`` in floating point: a sum is rounded to 0 only where it is 0.
    """
    x, y, z, w = clip.T
    farthest = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    if ((farthest <= w) & (w > 0)).all():
        return np.zeros(len(clip), np.uint8)
    opposite = -w
    is_behind = w <= 0
    is_in_range = (w > 0) & (z >= opposite) & (z <= w)
    flags = (z < opposite, z > w, x < opposite, x > w, y < opposite, y > w, is_behind, ~is_in_range)
    code = np.zeros(len(clip), np.uint8)
    for bit, flag in enumerate(flags):
        code |= flag.view(np.uint8) << np.uint8(bit)
    return code


def shared_bits(code: Outcodes, corner: Integers) -> Outcodes:
    """Return (P,) uint8: the bits that all corners (3, P) of a triangle have."""
    return _of_corners(np.bitwise_and, code, corner)


def joined_bits(code: Outcodes, corner: Integers) -> Outcodes:
    """Return (P,) uint8: the bits that any corner (3, P) of a triangle has."""
    return _of_corners(np.bitwise_or, code, corner)


def _of_corners(combine: np.ufunc, code: Outcodes, corner: Integers) -> Outcodes:
    if not code.any():
        return np.zeros(corner.shape[1], np.uint8)
    first, second, third = (code.take(index) for index in corner)
    combined: Outcodes = combine(combine(first, second), third)
    return combined


def has_bits(code: Outcodes, bits: int) -> Flags:
    """Return (P,) bool: one of ``bits`` is set."""
    found: Flags = (code & np.uint8(bits)) != 0
    return found


# Culling: triangles that need not be drawn, each with its reason.


KEPT, BACK_FACING, FRONT_FACING, DEGENERATE, BEHIND_EYE, OUTSIDE_PLANE, WITH_ITS_BOX, HIDDEN = range(8)
REASONS = (
    *("kept", "back-facing", "front-facing", "degenerate", "behind-eye", "outside-plane"),
    *("with-its-box", "behind-occluders"),
)

PLANES = ("near", "far", "left", "right", "bottom", "top")
"""Planes of the view volume, in clipping order."""
PLANE_COEFFICIENTS = np.array(
    [[0, 0, 1, 1], [0, 0, -1, 1], [1, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1]], float
)
"""(6, 4): the signed distance of a clip position from plane k is the dot product with row k; inside is 0 or more."""


FIRST_PLANE = np.array([-1, *((code & -code).bit_length() - 1 for code in range(1, PLANE_BITS + 1))])
"""(64,) int64: the first plane whose bit is set in the planes' part of an outcode; -1: none."""


@dataclass(frozen=True, eq=False)
class CullVerdicts:
    """Why each of T triangles is drawn or not."""

    assembled: IndexedPrimitives
    facing: Floats
    """(T,) float64, twice the snapped area or the determinant: positive front, negative back, 0 neither."""
    drops: Flags
    """(T,) bool, the method of the family ``cull`` drops what faces this way."""
    shared_outcode: Outcodes
    """(T,) uint8, the bits that all corners have, see ``core.culling.culling``."""
    sight: "NormalView | None" = None
    """What a method by N . V has seen; ``None``: ``facing`` decides."""
    plane_count: int = len(PLANES)
    """How many of ``PLANES`` are tested: 2 where lines beside the window may reach into it."""
    objects: "ObjectCulling | None" = None
    """What culling of objects has dropped before; ``None``: no object was asked."""

    @property
    def side(self) -> Floats:
        """(T,) float64, by which the method drops: positive front, negative back."""
        return self.facing if self.sight is None else -self.sight.product

    @cached_property
    def kept(self) -> Flags:
        """(T,) bool."""
        is_outside = has_bits(self.shared_outcode, PLANE_BITS | BEHIND_BIT)
        culled: Flags = self.drops | (self.facing == 0) | is_outside
        return ~culled if self.objects is None else ~(culled | (self.dropped_by >= 0) | self.is_hidden)

    @cached_property
    def dropped_by(self) -> Integers:
        """(T,) int64, the plane that the box of its object lies outside of, -1: none, or no object was asked."""
        if self.objects is None:
            return np.full(len(self.assembled), -1)
        return self.objects.dropped_by.take(self.assembled.triangle)

    @cached_property
    def is_hidden(self) -> Flags:
        """(T,) bool, its object is hidden behind occluders."""
        if self.objects is None:
            return np.zeros(len(self.assembled), bool)
        return self.objects.is_hidden.take(self.assembled.triangle)

    @cached_property
    def verdict(self) -> Integers:
        """(T,) int64, an index of ``REASONS``; the first that applies of box, behind, outside, degenerate, facing."""
        verdict = np.where(self.drops, np.where(self.side > 0, FRONT_FACING, BACK_FACING), KEPT)
        verdict[self.facing == 0] = DEGENERATE
        verdict[has_bits(self.shared_outcode, PLANE_BITS)] = OUTSIDE_PLANE
        verdict[has_bits(self.shared_outcode, BEHIND_BIT)] = BEHIND_EYE
        verdict[self.dropped_by >= 0] = WITH_ITS_BOX
        verdict[self.is_hidden] = HIDDEN
        return verdict

    @cached_property
    def plane(self) -> Integers:
        """(T,) int64, the plane that all corners, or its object's box, are outside of, else -1."""
        first = FIRST_PLANE[self.shared_outcode & PLANE_BITS]
        return np.where(self.verdict == OUTSIDE_PLANE, first, self.dropped_by)

    @cached_property
    def distances(self) -> Floats:
        """(T, 3, 6) float64, distance of every corner from every plane of the view volume."""
        return plane_distances(self.assembled.clip)


def plane_distances(clip: Floats) -> Floats:
    """Return (..., 6): signed distances w + z, w - z, w + x, w - x, w + y, w - y of clip positions (..., 4)."""
    x, y, z, w = (clip[..., k] for k in range(4))
    return np.stack([w + z, w - z, w + x, w - x, w + y, w - y], axis=-1)


def cull(
    assembled: IndexedPrimitives,
    outcode: Outcodes,
    facing: Floats,
    drops_facing: Callable[[Floats], Flags],
    sight: "NormalView | None" = None,
    plane_count: int = len(PLANES),
    objects: "ObjectCulling | None" = None,
) -> CullVerdicts:
    """Give every triangle its verdict.

    Parameters
    ----------
    outcode : (M,) uint8, of its vertices
    facing : (T,) float64, see ``core.coverage.edges.orient``
    drops_facing : callable
        The function of a method of the family ``cull``.
    sight : NormalView, optional
        What a method by N . V decides by, of the same triangles.
    plane_count : int
        How many of ``PLANES`` are tested.
    objects : ObjectCulling, optional
        What is dropped with its object.
    """
    drops = None if sight is None else sight.drops
    if drops is None:
        drops = drops_facing(facing if sight is None else -sight.product)
    shared = shared_bits(outcode, assembled.corner)
    if plane_count < len(PLANES):
        shared &= np.uint8(~PLANE_BITS & 0xFF | (1 << plane_count) - 1)
    return CullVerdicts(assembled, facing, drops, shared, sight, plane_count, objects)


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
    breaks_where="open surfaces: their back faces vanish",
)
def cull_back(facing: Floats) -> Flags:
    """Drop clockwise triangles. (T,) facing to (T,) bool."""
    return np.asarray(facing < 0)


@method(
    "cull",
    "front",
    "Front faces",
    source="OpenGL 4.6, 14.6.1",
    exact_for="closed surfaces seen from inside",
    breaks_where="surfaces seen from outside: their front faces vanish",
)
def cull_front(facing: Floats) -> Flags:
    """Drop counter-clockwise triangles. (T,) facing to (T,) bool."""
    return np.asarray(facing > 0)


def cull_verdict(clip: Floats, facing: float, drops: bool, planes: Floats = PLANE_COEFFICIENTS) -> str:
    """Listing of the verdict on one triangle: corners (3, 4), its facing, whether that facing is dropped."""
    if all(corner[3] <= 0 for corner in clip):  #: behind
        return "behind-eye"
    for a, b, c, d in planes:
        if all(a * x + b * y + c * z + d * w < 0 for x, y, z, w in clip):  #: outside
            return "outside-plane"
    if facing == 0:  #: degenerate
        return "degenerate"
    if drops:  #: facing
        return "back-facing" if facing < 0 else "front-facing"
    return "kept"  #: kept
