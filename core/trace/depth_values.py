"""How the value that the depth buffer gets is made, by the methods that do more than keep z: steps and listings."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.methods import table
from core.raster.lines.wireframe import LineFragments, line_parameter
from core.records.listing import RETURN, Listing, listing
from core.records.operation import Columns, Operation
from core.stages.fragment_depth import fragment_quantity, logarithm_range, outlines_of, reversed_ends
from core.trace.source import TraceSource


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
