"""Trace of the depth test: how the stored value is made, and every fragment or ray against what was there."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.depth.depth import depth_in_range, stack_fragments, store_depth
from core.depth.fixed_depth import NUMBER_BITS, FixedPlanes, packed_depth_test, rounded_depth_test
from core.lazy_import import imported
from core.lines.wireframe import LineFragments, line_parameter
from core.methods import table
from core.records.arrays import Flags, Integers
from core.records.listing import RETURN, Columns, Either, Listing, Operation, listing
from core.records.steps import Steps, ends_of
from core.stages.fragments import fragment_quantity, logarithm_range, outlines_of, reversed_ends
from core.trace.row_order import in_order
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

# Keys of the depth method ``fixed-38`` in the trace: depth and triangle in one number, the least of which
# is kept.


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
    "plane": (_PLANE, Operation("write", "store", {"after": RETURN}, ("before",))),
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


# How the value that the depth buffer gets is made, by the methods that do more than keep z: steps and
# listings.


def _value_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of the logarithm's listing that returns: behind the eye the farthest depth."""
    return np.where(columns["inverse_w"][rows] > 0, "value", "behind")


_ROUND = Operation("depth", "round", {"stored": RETURN}, ("depth",))
_STORED = Operation("depth", "round", {"stored": RETURN})
_LOGARITHM = Operation("value", _value_label, {"value": RETURN}, ("depth",))
_VALUE = Operation("value", "value", {"value": RETURN}, ("depth",))


def value_operations(source: TraceSource) -> tuple[Operation, ...]:
    """Return the operations that make the value; none where z or 1/w is stored as it is."""
    quantity = source.depth_format.quantity
    if quantity.listing is not None:
        return (_LOGARITHM if quantity.name == "logarithm" else _VALUE), _STORED
    return () if table.get("depth", source.settings.depth).listing is None else (_ROUND,)


def value_listings(source: TraceSource) -> dict[str, Listing]:
    """Return the listings of these operations, by kind of row and operation."""
    quantity, rounding = source.depth_format.quantity, table.get("depth", source.settings.depth).listing
    value = quantity.listing
    if isinstance(source.fragments, LineFragments):
        value = quantity.line_listing or value
    made: dict[str, Callable[..., Any] | None] = {"value": value, "depth": rounding}
    found = {name: of for name, of in made.items() if of is not None}
    return {f"{kind}.{name}": listing(of) for kind in ("test", "store") for name, of in found.items()}


def value_columns(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the numbers (F,) that the value is made from."""
    quantity, geometry, fragments = source.depth_format.quantity, source.geometry, source.fragments
    if quantity.listing is None:
        return {}
    columns = {"value": fragment_quantity(geometry, fragments, source.raster, quantity, source.depths[0])}
    if quantity.plane != "reversed-z":
        return columns
    if isinstance(fragments, LineFragments):
        outlines = outlines_of(geometry)
        columns["t"] = line_parameter(outlines, fragments, source.raster.center)
        columns["ends"] = reversed_ends(geometry, outlines)[fragments.segment]
        return columns
    columns["x"], columns["y"] = source.centers
    for name, plane in zip("abc", geometry.reversed_plane, strict=True):
        columns[name] = plane.take(fragments.primitive)
    return columns


def value_constants(source: TraceSource) -> dict[str, float | str]:
    """Return what is the same for all fragments."""
    kept = source.depth_format
    constants: dict[str, float | str] = {"quantity": kept.quantity.name}
    if kept.scale != 1 and not kept.is_planar:
        constants["scale"] = kept.scale
    if kept.quantity.convert is not None and kept.quantity.plane != "z":
        constants["near"], constants["far"] = logarithm_range(source.geometry)
    return constants


# Trace of the depth test: every fragment against what the buffer held.


OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "test": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("compare", "compare", {"passes": "nearer"}, ("before",)),
        Operation("write", Either("passes", "store", "reject"), {"after": RETURN}),
    ),
    "out-of-range": (Operation("range", "range", {"passes": RETURN}, ("depth",)),),
    "store": (
        Operation("depth", "", (), ("depth", "stored")),
        Operation("write", "store", {"after": RETURN}, ("before", "passes")),
    ),
}
"""Kind of row to what it does."""
DISCARDED: dict[str, tuple[Operation, ...]] = {"discarded": (Operation("discard", "", (), ("passes",)),)}
"""What the row of a fragment does that the fragment shader has discarded: it comes to no test."""
CELL = (
    Operation("depth", "", (), ("stored",)),
    Operation("compare", "compare", ("passes",), ("before",)),
    Operation("write", Either("passes", "store", "reject"), {"after": RETURN}),
)
"""What a row of a table of depths does, which is of the kind ``cell``."""


def trace_depth(source: TraceSource) -> StageTrace:
    """Return one row for every fragment, in the order that the method of visibility asks for."""
    exact, order = source.exact_tests, source.geometry.drawing.row_order
    found = _trace_tests(source) if exact is None else imported(exact.tracer)(source, exact)
    return found if order is None else in_order(found, order)


def _trace_tests(source: TraceSource) -> StageTrace:
    fragments, tests = source.fragments, source.depth_tests
    depth, keeps, stored = source.depths
    writes = np.ones(len(fragments), bool) if source.writes_depth is None else source.writes_depth
    is_stored = tests.passes & writes
    after = np.where(is_stored, stored, tests.before) if tests.left is None else tests.left
    tested = source.geometry.drawing.uses_depth_test
    columns: dict[str, np.ndarray] = {
        "column": fragments.column,
        "row": fragments.row,
        "depth": depth,
        "inverse_w": source.inverse_w,
        "stored": stored,
        "before": tests.before,
        "after": after,
        "passes": tests.passes,
        "writes": writes,
        "larger_is_nearer": np.full(len(fragments), source.depth_format.larger_is_nearer),
        "primitive": fragments.primitive,
    }
    operations = _operations(source)
    listings = {
        "test": listing(source.depth_format.listing),
        "out-of-range": listing(depth_in_range),
        "store": listing(store_depth),
    }
    columns |= value_columns(source)
    listings |= value_listings(source)
    is_table = source.scene.corner_count == 0
    if is_table:
        listings["cell"] = listing(source.depth_format.listing)
    if source.depth_format.is_planar:
        columns |= plane_columns(source)
        operations, listings = operations | PLANAR_OPERATIONS, listings | _planar_listings()
        if tested:
            columns |= key_columns(source)
    triangle = source.triangle_of_fragment
    kind = _kinds(tuple(operations), tested, keeps, columns, is_table)
    if not source.goes_on.all():
        kind[~source.goes_on] = len(operations)
        operations = operations | DISCARDED
    steps = Steps(
        kinds=tuple(operations),
        kind=kind,
        operations=operations,
        triangle_ends=ends_of(triangle),
        group_ends=ends_of(
            triangle if source.scene.corner_count == 0 else fragments.primitive, fragments.row
        ),
    )
    kept = np.flatnonzero(is_stored)
    changed = kept if tests.left is None else np.flatnonzero(keeps)
    place = source.place
    identity = source.start.primitive
    every = np.arange(len(fragments))
    unknown = np.full(source.raster.shape, np.nan)
    return StageTrace(
        stage="depth",
        method="" if source.scene.corner_count == 0 else f"depth={source.settings.depth}",
        steps=steps,
        columns=columns,
        triangle=triangle,
        pixel=np.stack([fragments.column, fragments.row], axis=1),
        listings=listings,
        constants={**value_constants(source), **_test_constants(source)},
        marks={"covered": tests.passes, "depth-failed": ~tests.passes, "nan": np.isnan(depth)},
        buffers=(
            BufferTrack(
                "depth", source.start.depth, changed, place[changed], after[changed], starts_known=True
            ),
            BufferTrack("primitive", identity, kept, place[kept], triangle[kept], "ids", True),
            BufferTrack("passes", unknown, every, place, tests.passes.astype(float), "flags"),
        ),
    )


def _test_constants(source: TraceSource) -> dict[str, str]:
    """Return how depths are compared, where a table of depths has chosen it."""
    return {"comparison": source.depth_format.comparison} if source.scene.corner_count == 0 else {}


def _operations(source: TraceSource) -> dict[str, tuple[Operation, ...]]:
    """Return what the rows do; most depth methods make the value that is stored in steps of their own."""
    if source.scene.corner_count == 0:
        return {**OPERATIONS, "cell": CELL}
    made = value_operations(source)
    if not made:
        return OPERATIONS
    return {kind: (*made, *rows[1:]) if kind != "out-of-range" else rows for kind, rows in OPERATIONS.items()}


def _kinds(
    names: tuple[str, ...], tested: bool, keeps: Flags, columns: dict[str, np.ndarray], is_table: bool
) -> Integers:
    """Return (R,) int64, which of ``names`` each row is."""
    test = "cell" if is_table else "test"
    usual = names.index(test if tested else "store")
    kind = np.where(keeps, usual, names.index("out-of-range"))
    if "is_linear" in columns:
        # A depth that is rounded pixel by pixel, or one that is a plane, needs words of its own.
        is_other = columns["is_linear"] != tested
        kind[keeps & is_other] = names.index("rounded" if tested else "plane")
    return kind


def _planar_listings() -> dict[str, Listing]:
    packed = listing(packed_depth_test)
    return {"test": packed, "plane": packed, "rounded": listing(rounded_depth_test)}
