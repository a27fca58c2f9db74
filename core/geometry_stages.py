"""The stages from the vertices to the edge functions: everything before the first pixel is looked at."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.fragments.interpolation import Planes, set_up_planes, value_plane
from core.frame import StageCount
from core.geometry.culling import CullVerdicts, cull, plane_distances
from core.geometry.sutherland_hodgman import DEPTH_PLANES, Clipped, clip_primitives
from core.geometry.vertex_stage import VertexStage, transform_vertices
from core.methods import table
from core.primitives import DrawingOrder, Primitives
from core.raster.edge_functions import EdgeFunctions, orient, set_up_edges
from core.raster.snapping import place_corners
from core.raster.wireframe import Outlines, set_up_outlines
from core.scene import AnyScene, ClipScene, Scene
from core.settings import Settings, families
from core.surface import light_vertices


@dataclass(frozen=True, eq=False)
class Geometry:
    """Everything that is known of the triangles before the first pixel is looked at."""

    vertices: VertexStage
    assembled: Primitives
    """All triangles of the scene."""
    culled: CullVerdicts
    kept: Primitives
    """Those that were not culled, in drawing order."""
    clipped: Clipped | None
    """``None``: nothing was clipped against."""
    clipping_inserted: str
    """Why clipping runs although the settings have none: the method that needs it, else empty."""
    primitives: Primitives
    """What is drawn, in drawing order: kept triangles and pieces."""
    edges: EdgeFunctions
    planes: Planes
    depth_plane: tuple[Floats, Floats, Floats]
    """(P,) each: window depth as a linear function of the pixel."""
    inverse_w_plane: tuple[Floats, Floats, Floats]
    is_in_range: Flags
    """(P,) bool, every corner lies between the near and the far plane: depth is clamped, not tested."""
    uses_depth_test: bool
    outlines: Outlines | None
    """The edges that a wireframe draws; ``None``: triangles are filled."""


@contextmanager
def timed(count: StageCount) -> Iterator[StageCount]:
    """Add the time of the block to ``count``."""
    start = perf_counter()
    yield count
    count.seconds += perf_counter() - start


def check_needs(scene: AnyScene, settings: Settings) -> None:
    """Refuse, with a sentence, a method that the scene cannot serve."""
    if not isinstance(scene, Scene) or scene.camera.projection == "perspective":
        return
    for family in families():
        chosen = table.get(family, getattr(settings, family))
        if "perspective" in chosen.needs:
            raise ValueError(
                f"{family} {chosen.name} needs a perspective camera: 1/w is constant for an orthographic one"
            )


def process_geometry(
    scene: AnyScene, settings: Settings, counts: dict[str, StageCount], chosen: Integers | None = None
) -> Geometry:
    """Run the stages from the vertices to the edge functions.

    Parameters
    ----------
    chosen : (C,) int64, optional
        Only these triangles, in drawing order.
    """
    check_needs(scene, settings)
    is_outlined: bool = table.get("polygon_mode", settings.polygon_mode).function()
    with timed(counts["transform"]):
        vertices = transform_vertices(scene)
        assembled = assemble(scene, vertices, settings, chosen)
        counts["transform"].incoming = counts["transform"].outgoing = len(assembled)

    with timed(counts["cull"]):
        corners = place_corners(assembled.clip, scene.size, settings.coverage)
        culled = cull(assembled.clip, orient(corners), settings.cull)
        primitives = assembled.select(culled.kept)
        drawing = drawing_order(vertices, settings)
        rank = np.argsort(drawing.order, kind="stable")
        kept = primitives = primitives.take(np.argsort(rank[primitives.triangle], kind="stable"))
        counts["cull"].incoming, counts["cull"].outgoing = len(assembled), len(primitives)

    with timed(counts["clip"]):
        planes, inserted = clip_planes(primitives, settings)
        clipped = None
        counts["clip"].incoming = len(primitives)
        shares = None
        if planes:
            distances = plane_distances(primitives.clip)
            if inserted:
                # Only what needs it, whatever is drawn with it.
                distances[(primitives.clip[..., 3] > 0).all(axis=1)] = 0
            clipped = clip_primitives(primitives, distances, planes)
            primitives = clipped.primitives
            if is_outlined:
                corner_shares = replace(kept, varyings=np.tile(np.eye(3), (len(kept), 1, 1)))
                shares = clip_primitives(corner_shares, distances, planes).primitives.varyings
        counts["clip"].outgoing = len(primitives)
        counts["clip"].note = inserted if inserted else ("" if planes else "not-chosen")

    with timed(counts["edges"]):
        corners = place_corners(primitives.clip, scene.size, settings.coverage)
        edges = set_up_edges(corners, settings.fill_rule)
        interpolation = set_up_planes(corners.homogeneous)
        z, w = primitives.clip[..., 2], primitives.clip[..., 3]
        counts["edges"].incoming = counts["edges"].outgoing = len(primitives)
        return Geometry(
            vertices=vertices,
            assembled=assembled,
            culled=culled,
            kept=kept,
            clipped=clipped,
            clipping_inserted=inserted,
            primitives=primitives,
            edges=edges,
            planes=interpolation,
            depth_plane=value_plane(interpolation, (z + w) / 2),
            inverse_w_plane=value_plane(interpolation, np.ones_like(w)),
            is_in_range=np.all((w > 0) & (z >= -w) & (z <= w), axis=1),
            uses_depth_test=drawing.uses_depth_test,
            outlines=set_up_outlines(primitives, corners, shares, scene.size) if is_outlined else None,
        )


def drawing_order(vertices: VertexStage, settings: Settings) -> DrawingOrder:
    """Return the triangles (T,) of the scene from the first drawn to the last."""
    order: DrawingOrder = table.get("visibility", settings.visibility).function(
        vertices.clip[vertices.corners]
    )
    return order


def assemble(
    scene: AnyScene, vertices: VertexStage, settings: Settings, chosen: Integers | None = None
) -> Primitives:
    """Gather the corners of the ``chosen`` (T,) triangles with what is to be interpolated over them."""
    triangle = np.arange(len(vertices.corners)) if chosen is None else np.asarray(chosen, np.int64)
    corners = vertices.corners[triangle]
    if isinstance(scene, ClipScene):
        assert scene.attributes is not None
        varyings = scene.attributes[triangle]
        layout = {"uv": slice(0, 2)} if scene.texture else {"color": slice(0, min(4, varyings.shape[2]))}
    else:
        varyings, layout = light_vertices(scene, vertices, settings, triangle)
    if settings.interpolation == "flat":
        provoking = table.get("provoking", settings.provoking).function()
        varyings = np.repeat(varyings[:, provoking : provoking + 1], 3, axis=1)
    return Primitives(vertices.clip[corners], varyings, triangle, vertices.mesh[triangle], layout)


def clip_planes(primitives: Primitives, settings: Settings) -> tuple[tuple[int, ...], str]:
    """Return the planes to clip against, and the method that asked for them where the settings did not."""
    planes: tuple[int, ...] = table.get("clipping", settings.clipping).function()
    if planes or (primitives.clip[..., 3] > 0).all():
        return planes, ""
    for family in ("polygon_mode", "fill", "interpolation"):
        chosen = table.get(family, getattr(settings, family))
        if {"projected", "positive-w"} & set(chosen.needs):
            return DEPTH_PLANES, chosen.name
    return planes, ""
