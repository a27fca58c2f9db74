"""How the value that the depth buffer gets is made, by the methods that do more than keep z: steps and listings."""

from collections.abc import Callable
from typing import Any

import numpy as np

from core.framebuffer.depth_formats import (
    logarithm_of_w,
    reversed_depth,
    reversed_depth_along,
    share_of_depth,
    unsigned_depth,
)
from core.raster.lines.wireframe import LineFragments, line_parameter
from core.records.listing import Listing, listing
from core.records.steps import Operation
from core.stages.fragment_depth import fragment_quantity, logarithm_range, outlines_of, reversed_ends
from core.trace.source import TraceSource

_ROUND = Operation("depth", "round", ("depth", "stored"))
_VALUE = (Operation("value", "value", ("depth", "value")), Operation("depth", "round", ("stored",)))


def value_operations(source: TraceSource) -> tuple[Operation, ...]:
    """Return the operations that make the value; none where z or 1/w is stored as it is."""
    kept = source.depth_format
    if kept.quantity in ("reversed-z", "logarithm"):
        return _VALUE
    return (_ROUND,) if kept.scale != 1 and not kept.is_planar else ()


def value_listings(source: TraceSource) -> dict[str, Listing]:
    """Return the listings of these operations, by kind of row and operation."""
    kept, found = source.depth_format, dict[str, Callable[..., Any]]()
    if kept.quantity == "reversed-z":
        along = isinstance(source.fragments, LineFragments)
        found = {"value": reversed_depth_along if along else reversed_depth, "depth": share_of_depth}
    elif kept.quantity == "logarithm":
        found = {"value": logarithm_of_w, "depth": share_of_depth}
    elif value_operations(source):
        found = {"depth": unsigned_depth}
    return {f"{kind}.{name}": listing(of) for kind in ("test", "store") for name, of in found.items()}


def value_columns(source: TraceSource) -> dict[str, np.ndarray]:
    """Return the numbers (F,) that the value is made from."""
    kept, geometry, fragments = source.depth_format, source.geometry, source.fragments
    if kept.quantity not in ("reversed-z", "logarithm"):
        return {}
    columns = {"value": fragment_quantity(geometry, fragments, source.raster, kept.quantity)}
    if kept.quantity == "logarithm":
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
    constants: dict[str, float | str] = {"quantity": source.depth_format.quantity}
    if source.depth_format.scale != 1 and not source.depth_format.is_planar:
        constants["scale"] = source.depth_format.scale
    if source.depth_format.quantity == "logarithm":
        constants["near"], constants["far"] = logarithm_range(source.geometry)
    return constants
