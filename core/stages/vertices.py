"""The stages from the vertices to the edge functions: everything before the first pixel is looked at.

Vertices are transformed, projected and snapped once, however many triangles share them; triangles point to them.
"""

from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from core.clipping.planes import DEPTH_CLIPPING, PolygonClipping
from core.clipping.sutherland_hodgman import Clipped
from core.coverage.edges import doubled_areas, orient
from core.coverage.pixel_runs import Raster
from core.coverage.snapping import WindowVertices, place_corners, place_vertices
from core.culling.culling import (
    BEHIND_BIT,
    PLANES,
    CullVerdicts,
    Outcodes,
    cull,
    has_bits,
    joined_bits,
    outcodes,
    plane_distances,
    shared_bits,
)
from core.families import suited
from core.records.arrays import Flags, Floats, Integers
from core.records.frame import StageCount
from core.records.primitives import (
    CornerValues,
    DrawingOrder,
    IndexedPrimitives,
    Pieces,
    index_corners,
    own_corners,
)
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings, families, no_effect
from core.stages.before_matrices import before_matrices
from core.stages.declared import GEOMETRY_STAGES
from core.stages.fragment_color import vertex_stage
from core.stages.geometry import Geometry, all_projected, clipping_distances, line_reach
from core.stages.needs import check_edits, check_needs
from core.transform.vertex_stage import CornerPositionsOnDemand, VertexStage, transform_vertices


class Before(NamedTuple):
    """What is drawn before a place of the drawing order, and after that one triangle, if any (-1: none)."""

    place: int
    then: int = -1


_last: list[tuple[AnyScene, Settings, Geometry, dict[str, StageCount]]] = []
"""The geometry of the last whole scenes, with its counts: scenes never change, so another look at the same one, a pixel
that is pointed at or the next redraw, starts from there, also where a pass was drawn in between."""
MOST_KEPT, KEPT_TRIANGLES = 3, 100_000
"""Scenes whose geometry is kept, and triangles of those that are kept beside the last one."""


def process_geometry(
    scene: AnyScene,
    settings: Settings,
    counts: dict[str, StageCount],
    chosen: Integers | Before | None = None,
    raster: Raster | None = None,
) -> Geometry:
    """Run the stages from the vertices to the edge functions; those of the last whole scene are kept.

    Parameters
    ----------
    chosen : (C,) int64 or Before, optional
        Only these triangles, or what is drawn before a place, in drawing order.
    raster : Raster, optional
        Leave out what lies beside it: a part of a picture is drawn from the triangles of that part.
    """
    if scene.program is not None or not resolve(settings).draws_any_scene:
        check_edits(scene, settings)
    if scene.makes_positions:
        scene = before_matrices(scene, settings)
    if scene.corner_count != 3:
        settings = suited(settings, scene)
    settings = resolve(settings).settings
    if chosen is not None or (raster is not None and raster.region is not None):
        return _process(scene, settings, counts, chosen, raster)
    for of_scene, of_settings, known, known_counts in _last:
        if of_scene is scene and (of_settings is settings or of_settings == settings):
            for stage in GEOMETRY_STAGES:
                counts[stage] = replace(known_counts[stage], seconds=0.0)
            return known.counted_in(counts["edges"])
    geometry = _process(scene, settings, counts, None, None)
    kept, total = [], 0
    for entry in _last[: MOST_KEPT - 1]:
        total += entry[2].assembled.triangle.size
        kept += [entry] if total <= KEPT_TRIANGLES else []
    latest = scene, settings, geometry, {stage: replace(counts[stage]) for stage in GEOMETRY_STAGES}
    _last[:] = [latest, *kept]
    return geometry


def _process(
    scene: AnyScene,
    settings: Settings,
    counts: dict[str, StageCount],
    chosen: Integers | Before | None,
    raster: Raster | None,
) -> Geometry:
    if not resolve(settings).draws_any_scene:
        check_needs(scene, settings)
    with counts["transform"]:
        vertices = transform_vertices(scene) if scene.program is None else vertex_stage(scene)
        before = None
        if isinstance(chosen, Before):
            with counts["cull"]:
                before, order = chosen, drawing_order(scene, vertices, settings).order
            drawn = order[: before.place]
            drawn = drawn if before.then < 0 else np.append(drawn, before.then)
            # As np.unique, which imports all of numpy.ma when it is first called: a window opens with this.
            chosen = np.flatnonzero(np.bincount(drawn))
        assembled = assemble(scene, vertices, settings, counts["transform"], chosen)
        triangle_count = len(assembled)
        counts["transform"].incoming = counts["transform"].outgoing = triangle_count

    with counts["cull"]:
        window, outcode = place(assembled, scene.size, settings)
        has_area = vertices.corner_count >= 3
        doubled_area = face(assembled, window, scene.size, settings) if has_area else np.ones(triangle_count)
        sight = None
        if (look := resolve(settings).look) is not None and vertices.corner_count == 3:
            from core.culling.normal_view import eye_triangles  # Only culling by N . V waits for its file.

            sight = look(eye_triangles(vertices, assembled.triangle))
        # Not the planes at the sides of the window where a line beside it reaches in.
        plane_count = len(PLANES) if line_reach(settings) == 0 else PLANES.index("left")
        grown, objects = None, None
        if resolve(settings).asks_boxes:
            from core.stages.object_tree import culled_objects, object_tree  # Only boxes wait for it.

            grown = object_tree(scene, vertices, settings)
            objects = culled_objects(scene, vertices, settings, grown, plane_count)
        drops = resolve(settings).drops_facing
        culled = (
            cull(assembled, outcode, doubled_area, drops, sight, plane_count, objects)
            if vertices.rings is None
            else cull_polygons(vertices, assembled, settings)
        )
        wanted = culled.kept
        if raster is not None and vertices.rings is None:
            wanted = wanted & ~is_beside(window, assembled.corner, raster)
        drawing, pieces = drawing_order(scene, vertices, settings), None
        if chosen is None and drawing.is_as_given and wanted.all():
            kept = assembled
        elif drawing.pieces is None:
            index, _ = in_drawing_order(np.flatnonzero(wanted), assembled, drawing)
            kept, doubled_area = assembled.take(index), doubled_area.take(index)
        else:
            kept, pieces = cut_to_pieces(np.flatnonzero(wanted), assembled, drawing, before)
            window, outcode = place(kept, scene.size, settings)
            doubled_area = face(kept, window, scene.size, settings)
            # Pieces that snapping makes flat cover no pixel.
            index = np.flatnonzero(doubled_area != 0)
            kept, pieces, doubled_area = kept.take(index), pieces.take(index), doubled_area.take(index)
        # Triangles beside the raster are counted as if they went on, or the bands' counts would not be the picture's.
        kept_count = cut_count = int(np.count_nonzero(culled.kept))
        if pieces is not None:
            cut_count = len(kept)
            if raster is not None:
                cut_count = len(in_drawing_order(np.flatnonzero(culled.kept), assembled, drawing)[0])
        counts["cull"].incoming, counts["cull"].outgoing = triangle_count, kept_count

    with counts["clip"]:
        primitives, clipped, inserted = clip(kept, outcode, settings, vertices.corner_count)
        piece_count = cut_count if primitives is kept else cut_count + len(primitives) - len(kept)
        counts["clip"].incoming, counts["clip"].outgoing = kept_count, piece_count
        is_clipped = clipped or (vertices.rings is not None and resolve(settings).clips_polygons)
        counts["clip"].note = inserted if inserted else ("" if is_clipped or pieces else "not-chosen")

    with counts["edges"]:
        counts["edges"].incoming = counts["edges"].outgoing = piece_count
        if primitives is not kept:
            window, outcode = place(primitives, scene.size, settings)
            doubled_area = (
                face(primitives, window, scene.size, settings) if has_area else np.ones(len(primitives))
            )
    return Geometry(
        vertices=vertices,
        assembled=assembled,
        culled=culled,
        kept=kept,
        kept_pieces=pieces,
        clipped=clipped,
        clipping_inserted=inserted,
        primitives=primitives,
        window=window,
        outcode=outcode,
        doubled_area=doubled_area,
        drawing=drawing,
        settings=settings,
        count=counts["edges"],
        object_tree=grown,
    )


def assemble(
    scene: AnyScene,
    vertices: VertexStage,
    settings: Settings,
    count: StageCount,
    chosen: Integers | None = None,
) -> IndexedPrimitives:
    """Point the ``chosen`` (T,) triangles, or all, to their vertices, which are lit when their values are asked for."""
    values_of = partial(corner_values, scene, vertices, settings, count)
    number = np.arange(len(vertices.corners)) if chosen is None else np.asarray(chosen, np.int64)
    triangle = number
    if isinstance(scene, ClipScene) and scene.table is not None:
        triangle = scene.numbers.take(number)
    if chosen is None:
        return IndexedPrimitives(
            vertices.clip_rows, vertices.corner_rows, triangle, vertices.mesh, values_of, number
        )
    vertex_clip, corner = vertices.clip_rows, vertices.corner_rows.take(number, axis=1)
    if corner.size < vertex_clip.shape[1]:
        # A few triangles of many: only their own vertices go on.
        vertex_clip, corner = vertex_clip.take(corner.T.ravel(), axis=1), own_corners(np.arange(len(number)))
    return IndexedPrimitives(vertex_clip, corner, triangle, vertices.mesh.take(number), values_of, number)


def corner_values(
    scene: AnyScene, vertices: VertexStage, settings: Settings, count: StageCount, triangle: Integers
) -> CornerValues:
    """Return what is interpolated over triangles (P,); the time goes to ``count``."""
    if isinstance(scene, ClipScene):
        find_values = partial(_given_values, scene, vertices)
    elif vertices.shaded is not None:
        find_values = partial(_shaded_values, vertices, resolve(settings).interpolation[1])
    else:
        from core.stages.vertex_light import light_vertices  # Clip space comes without light.

        find_values = partial(light_vertices, scene, vertices, settings)
    with count:
        values = find_values(triangle)
        if not resolve(settings).is_flat:
            return values
        _, provoking, _ = resolve(settings).interpolation
        return CornerValues(values.rows, values.layout, values.index[[provoking] * 3])


def _given_values(scene: ClipScene, vertices: VertexStage, triangle: Integers) -> CornerValues:
    """Return the attributes at the corners of triangles (P,)."""
    assert scene.attributes is not None
    count, corners, width = scene.attributes.shape
    layout = {"uv": slice(0, 2)} if scene.texture else {"color": slice(0, min(4, width))}
    rows = scene.attributes.reshape(count * corners, width)
    return CornerValues(rows, layout, vertices.corner_rows.take(triangle, axis=1))


def _shaded_values(vertices: VertexStage, provoking: int, triangle: Integers) -> CornerValues:
    """Return the outs of the vertex shader at the corners of triangles (P,); ``flat`` ones of one corner only."""
    shaded, corner = vertices.shaded, vertices.corner_rows.take(triangle, axis=1)
    assert shaded is not None
    if not shaded.flat:
        return CornerValues(shaded.rows, shaded.layout, corner)
    rows = shaded.rows.take(corner.T.ravel(), axis=0).reshape(len(triangle), 3, -1)
    for columns in shaded.flat:
        rows[..., columns] = rows[:, provoking : provoking + 1, columns]
    own = own_corners(np.arange(len(triangle)))
    return CornerValues(rows.reshape(3 * len(triangle), -1), shaded.layout, own)


def place(
    primitives: IndexedPrimitives, size: tuple[int, int], settings: Settings
) -> tuple[WindowVertices, Outcodes]:
    """Return where the vertices of primitives lie in the window of ``size`` and against the view volume.

    Returns
    -------
    window : WindowVertices
    outcode : (M,) uint8
    """
    clip_position = primitives.vertex_clip.T
    return place_vertices(clip_position, size, resolve(settings).numbers), outcodes(clip_position)


def face(
    primitives: IndexedPrimitives, window: WindowVertices, size: tuple[int, int], settings: Settings
) -> Floats:
    """Return (P,) float64 as ``core.coverage.edges.orient``, from vertices that are placed already."""
    facing = doubled_areas(window.x, window.y, primitives.corner)
    lost = np.flatnonzero(~all_projected(window, primitives.corner))
    if len(lost):
        facing[lost] = orient(place_corners(primitives.clip_of(lost), size, settings.coverage))
    return facing


def cull_polygons(vertices: VertexStage, assembled: IndexedPrimitives, settings: Settings) -> CullVerdicts:
    """Give every polygon its verdict, by all of its corners and the signed area inside all of its rings.

    Of a polygon that crosses itself so that its parts cancel, the triangle of its plane decides: only what has no
    area at all is degenerate.
    """
    rings = vertices.rings_of(assembled.triangle)
    facing = np.zeros(len(assembled))
    np.add.at(facing, rings.polygon, 2 * rings.areas)
    one, other = (
        vertices.window[assembled.corner[k], :2] - vertices.window[assembled.corner[0], :2] for k in (1, 2)
    )
    facing = np.where(facing == 0, one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], facing)
    clip = vertices.clip[vertices.all_corners[assembled.triangle]]
    shared = np.bitwise_and.reduce(outcodes(clip.reshape(-1, 4)).reshape(clip.shape[:2]), axis=1)
    culled = CullVerdicts(assembled, facing, resolve(settings).drops_facing(facing), shared)
    vars(culled)["distances"] = plane_distances(clip)
    return culled


def is_beside(window: WindowVertices, corner: Integers, raster: Raster) -> Flags:
    """Return (T,) bool: all corners (3, T) lie beyond the same outermost pixel centres, so no pixel is covered.

    A corner that cannot be projected is beyond none.
    """
    first_column, first_row, end_column, end_row = raster.bounds
    left, bottom, right, top = (
        edge + raster.center for edge in (first_column, first_row, end_column - 1, end_row - 1)
    )
    code = np.zeros(len(window.x), np.uint8)
    for bit, is_beyond in enumerate((window.x < left, window.x > right, window.y < bottom, window.y > top)):
        code |= is_beyond.view(np.uint8) << np.uint8(bit)
    beside: Flags = shared_bits(code, corner) != 0
    return beside


def drawing_order(scene: AnyScene, vertices: VertexStage, settings: Settings) -> DrawingOrder:
    """Return the triangles (T,) of the scene from the first drawn to the last; fragments patch by patch."""
    if scene.corner_count > 0 or not isinstance(scene, ClipScene):
        return resolve(settings).drawing_order(CornerPositionsOnDemand(vertices))
    _, patch, counts = np.unique(scene.numbers, return_inverse=True, return_counts=True)
    means = np.stack([np.bincount(patch, row) / counts for row in vertices.clip_rows], axis=1)
    drawing = resolve(settings).drawing_order(np.repeat(means[:, None], 3, axis=1))
    return replace(drawing, order=np.argsort(np.argsort(drawing.order)[patch], kind="stable"))


def in_drawing_order(
    index: Integers, assembled: IndexedPrimitives, drawing: DrawingOrder
) -> tuple[Integers, Integers]:
    """Return ``index`` (P,) of assembled triangles from the first drawn to the last, and their places (P,) in it.

    A triangle that is cut stands there once for each piece.
    """
    number = assembled.source.take(index)  # Fragments of one patch go by the same ``triangle``.
    if drawing.is_as_given:
        ordered = index if (number[1:] >= number[:-1]).all() else index[np.argsort(number, kind="stable")]
        return ordered, assembled.source.take(ordered)
    place = np.full(int(drawing.order.max(initial=-1)) + 1, -1)
    place[number] = index
    ordered = place.take(drawing.order)
    return ordered[ordered >= 0], np.flatnonzero(ordered >= 0)


def cut_to_pieces(
    index: Integers, assembled: IndexedPrimitives, drawing: DrawingOrder, before: Before | None = None
) -> tuple[IndexedPrimitives, Pieces]:
    """Return the pieces of assembled triangles ``index`` (P,) in drawing order, as primitives and as they were cut.

    With ``before``, only those that it has.
    """
    assert drawing.pieces is not None
    ordered, place = in_drawing_order(index, assembled, drawing)
    if before is not None:
        is_drawn = (place < before.place) | (assembled.source.take(ordered) == before.then)
        ordered, place = ordered[is_drawn], place[is_drawn]
    pieces, whole = drawing.pieces.take(place), assembled.take(ordered)

    def values_of(source: Integers) -> CornerValues:
        of_triangle = assembled.values_of(whole.source.take(source))
        values = pieces.shares.take(source, axis=0) @ of_triangle.at_corners
        rows = values.reshape(3 * len(source), values.shape[2])
        return CornerValues(rows, of_triangle.layout, own_corners(np.arange(len(source))))

    number = np.arange(len(ordered))
    vertex_clip = np.ascontiguousarray(pieces.clip.reshape(-1, 4).T)
    cut = IndexedPrimitives(vertex_clip, own_corners(number), whole.triangle, whole.mesh, values_of, number)
    return cut, pieces


def clip(
    kept: IndexedPrimitives, outcode: Outcodes, settings: Settings, corner_count: int = 3
) -> tuple[IndexedPrimitives, Clipped | None, str]:
    """Clip what crosses a plane that the settings, or a method that they choose, have to be kept to.

    Parameters
    ----------
    outcode : (M,) uint8, of its vertices
    corner_count : int
        Less than 3 of segments and points.

    Returns
    -------
    primitives : IndexedPrimitives
        ``kept`` itself where nothing crosses.
    clipped : Clipped, optional
    inserted : str
        See ``Geometry.clipping_inserted``.
    """
    if not resolve(settings).clips and not (outcode & BEHIND_BIT).any():
        return kept, None, ""
    joined = joined_bits(outcode, kept.corner)
    crosses_eye = has_bits(joined, BEHIND_BIT)
    clipping, inserted = choose_clipping(settings, bool(crosses_eye.any()))
    if not clipping.is_any:
        return kept, None, inserted
    behind = BEHIND_BIT if clipping.divides else 0
    crossing = has_bits(joined, behind | sum(1 << plane for plane in clipping.planes))
    if inserted:
        crossing &= crosses_eye
    if crossing.any():
        clipped = clipping.clip(kept.gathered(), clipping_distances(kept, inserted), corner_count)
        return index_corners(clipped.primitives), clipped, inserted
    none = kept.take(np.empty(0, np.int64))
    clipped = clipping.clip(none.gathered(), plane_distances(none.clip), corner_count)
    return kept, replace(clipped, primitives=kept.gathered()), inserted


def choose_clipping(settings: Settings, crosses_eye: bool) -> tuple[PolygonClipping, str]:
    """Return how to clip, and the method that asked for it where the settings did not."""
    clipping = resolve(settings).clipping
    if clipping.is_any or not crosses_eye:
        return clipping, ""
    for family in families():
        chosen = resolve(settings).method(family)
        if {"projected", "positive-w"} & set(chosen.needs) and not no_effect(settings, family):
            return DEPTH_CLIPPING, chosen.name
    return clipping, ""
