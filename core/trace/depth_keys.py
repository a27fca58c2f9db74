"""Keys of the depth method ``fixed-38`` in the trace: depth and triangle in one number, the least of which is kept."""

import numpy as np

from core.framebuffer.fixed_depth import FixedPlanes
from core.framebuffer.packed_keys import NUMBER_BITS
from core.framebuffer.stacks import stack_fragments
from core.raster.lines.wireframe import LineFragments
from core.records.arrays import Integers
from core.records.listing import RETURN
from core.records.operation import Operation
from core.trace.source import TraceSource

_DEPTH = {"depth": "depth", "stored": "depth"}
_PLANE = Operation("plane", "depth", _DEPTH)
_KEY = (
    Operation("key", "key", ("key",)),
    Operation("minimum", "minimum", ("passes",), ("before", "before_key")),
    Operation("write", "store", dict.fromkeys(("after", "after_key"), RETURN)),
)
PLANAR_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "test": (_PLANE, *_KEY),
    "rounded": (Operation("depth", "depth", _DEPTH), *_KEY),
    "plane": (
        _PLANE,
        Operation("write", "store", {"after": RETURN}, ("before",)),
    ),
}
"""Kinds of rows that only depth on integer planes has; ``rounded``: tested, but the triangle has no plane."""


def plane_columns(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the integer planes of the fragments, and which have one."""
    fragments = source.fragments
    if isinstance(fragments, LineFragments):
        nothing = np.zeros(len(fragments), np.int64)
        return {"origin": nothing, "across": nothing, "up": nothing, "is_linear": nothing > 0}
    fixed: FixedPlanes = source.geometry.fixed_planes
    columns = {name: getattr(fixed.planes, name) for name in ("origin", "across", "up")}
    columns["is_linear"] = fixed.is_linear
    return {name: values.take(fragments.primitive) for name, values in columns.items()}


def key_columns(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the key of every fragment, what was in the buffer, and what is there afterwards.

    Notes
    -----
    A key is (depth + slack) << 24 | number + 1, as `NearestFragments` packs it. Pictures number what culling and
    clipping leave, here it is the triangle's number in the scene: the order is the same. Keys of fragments out of
    depth range take no part and are -1.
    """
    depth_format, (_, keeps, stored) = source.depth_format, source.depths
    kept = np.flatnonzero(keeps & ~np.isnan(stored))
    number = source.triangle_of_fragment

    def key_of(depth: np.ndarray, triangle: Integers) -> Integers:
        return (depth_format.nearness_key(depth) << NUMBER_BITS) | (triangle + 1)

    key, before, after = np.full((3, len(stored)), -1)
    key[kept] = key_of(stored[kept], number[kept])

    # The least key so far, one layer after another.
    stacks = stack_fragments(source.place[kept])
    start = source.start
    there = key_of(start.depth.ravel(), start.primitive.ravel().astype(np.int64)).take(stacks.pixel)
    for count, place in stacks.layers():
        fragment = kept.take(place)
        before[fragment] = there[:count]
        keeps_key = True if source.writes_depth is None else source.writes_depth[fragment]
        np.minimum(there[:count], key[fragment], out=there[:count], where=keeps_key)
        after[fragment] = there[:count]
    return {"number": number, "key": key, "before_key": before, "after_key": after}
