"""Trace of shadows: where a fragment lies in the map of the light, what it is compared with, what light arrives."""

from typing import Any

import numpy as np

from core.records.arrays import Floats
from core.records.listing import Listing, Operation, listing
from core.resolved import resolve
from core.scene import Scene
from core.shading.shadows import MapTests
from core.stages.passes import lamp_of, shadow_tests
from core.trace.source import TraceSource

SHADOW_BUFFERS = {
    "lamp_depth": "depth from the light",
    "lamp_stored": "depth in the map",
    "light_share": "share of light",
}
"""Columns of shadows that are buffers, where they have one number a fragment."""


def _casts(source: TraceSource) -> bool:
    scene = source.scene
    return (
        isinstance(scene, Scene) and scene.casting_light >= 0 and resolve(source.settings).shadow is not None
    )


def shadow_columns(source: TraceSource, position: Floats) -> dict[str, np.ndarray]:
    """Return every number of the shadow test of points (F, 3): name to (F, ...) array; empty: none is tested."""
    if not _casts(source):
        return {}
    assert isinstance(source.scene, Scene)
    tests = shadow_tests(source.scene, source.settings, position)
    lamp = lamp_of(source.scene, source.settings)
    assert tests is not None
    count = len(position)
    found: dict[str, Any] = {
        "lamp": np.full(count, lamp.number),
        **dict(zip(("lamp_u", "lamp_v", "lamp_depth"), tests.place.T, strict=True)),
        "light_share": tests.share,
    }
    if not isinstance(tests, MapTests):
        return found | {"blocker": tests.blocker, "blocker_depth": tests.blocker_depth}
    return found | {
        "lamp_texels": tests.texels,
        "lamp_stored": tests.stored,
        "texel_is_lit": tests.is_lit,
        "lamp_bias": np.full(count, lamp.bias),
    }


def shadow_operations(source: TraceSource) -> tuple[Operation, ...]:
    """Return what a row does to find its share of the light; empty: it looks for no shadow."""
    method = resolve(source.settings).shadow
    return method.operations["shadow"] if method is not None and _casts(source) else ()


def shadow_listings(source: TraceSource) -> dict[str, Listing]:
    """Return the listing of these operations, by operation."""
    method = resolve(source.settings).shadow
    if method is None or method.listing is None:
        return {}
    return dict.fromkeys((operation.name for operation in shadow_operations(source)), listing(method.listing))
