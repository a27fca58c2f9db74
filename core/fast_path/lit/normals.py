"""Normals of triangles in camera space as planes: a direction is linear over the window.

A normal divided by w is linear over the window, and dividing all of it by one number does not turn it; so its three
components are evaluated at every visible pixel and made a unit vector there: perspective-correct without a division
by w.
"""

import numpy as np

from core.fast_path.draw_context import DrawContext
from core.fast_path.lit.corner_places import CornerPlaces
from core.fast_path.lit.pixel_light import make_unit
from core.fast_path.lit.planes import Plane, Shown, evaluate, plane_through
from core.fast_path.lit.vertex_facts import VertexFacts, are_unlike
from core.records.arrays import Flags, Integers, Singles
from core.scene import Camera

FORWARD = np.array([[0.0], [0.0], [1.0]])
"""Any direction."""
STEEPEST = 2.0**40
"""Change of a component a pixel; steeper planes are seen edge-on."""

NormalPlanes = tuple[Plane, Plane, Plane]
"""Of x, y and z of P triangles, over w and in any scale."""


def normal_planes(
    context: DrawContext, camera: Camera, facts: VertexFacts, places: CornerPlaces
) -> tuple[NormalPlanes, Flags] | None:
    """Return the normals of all primitives, and which of them hold too different ones.

    Parameters
    ----------
    facts : VertexFacts
        Of the values at the vertices.
    places : CornerPlaces
        Where the corners lie in the window.

    Returns
    -------
    normals : NormalPlanes
    is_unlike : (P,) bool
        Where they point anywhere: the normals at the corners are too different, see `are_unlike`.

    ``None`` is returned where a plane is too steep.
    """
    normal = facts.values.normals_seen_by(camera)
    corners = [normal.take(index, axis=1) for index in context.geometry.primitives.values.index]
    is_unlike = np.zeros(len(places.is_doubtful), bool)
    if context.geometry.clipped is not None or facts.unlike_count:
        is_unlike = are_unlike(corners)
        for corner in corners:
            corner[:, is_unlike] = FORWARD
    least = places.w.min(axis=0)
    for corner, of_corner in zip(corners, places.w, strict=True):
        corner *= least / of_corner
    x, y, z = (plane_through(places, [corner[axis] for corner in corners]) for axis in range(3))
    steepest = max(float(np.abs(slope).max(initial=0)) for plane in (x, y, z) for slope in plane[:2])
    return ((x, y, z), is_unlike) if steepest < STEEPEST else None


def unit_normals(
    planes: NormalPlanes, context: DrawContext, shown: Shown, column: Integers, row: Integers
) -> Singles:
    """Return the unit normals (3, F) float32 of primitives at pixels (F,), in the context's scratch."""
    x, y = context.raster.centers(column, row)
    value, term = context.scratch("normal_value", len(x)), context.scratch("normal_term", len(x))
    components = context.scratch("components", 3, len(x), dtype=np.float32)
    for plane, component in zip(planes, components, strict=True):
        evaluate(plane, shown, x, y, value, term)
        np.copyto(component, value, casting="same_kind")
    return make_unit(components, context.scratch)
