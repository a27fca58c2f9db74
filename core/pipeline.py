"""The pipeline: a scene becomes a picture, stage by stage.

`draw` begins the story, and `draw_centers` tells it once for one sample a pixel:

1. *transform, cull, clip, edges* (`process_geometry`): vertices to clip space and to the window, triangles that need
   not be drawn left out, those that cross a plane cut, edge functions set up;
2. *bin, raster* (`fragments_of`): boxes and runs of pixels, and which of these lie inside of all edges;
3. *depth* (`find_visible`): which fragment of every pixel is seen;
4. *interpolate, shade*: attributes, texture and light of what is seen;
5. *blend, resolve*: what the fragments leave in the buffers.

Several samples a pixel, or areas, vary it: `draw_supersampled` tells it on a finer raster, `draw_multisampled` finds
what is seen for each sample and shades once for a triangle in a pixel, `draw_areas` cuts pixels into pieces. The same
functions serve the picture (in batches, nothing kept) and the trace (a few triangles, everything kept).
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from core.antialiasing.resolve import (
    at_sample,
    bands_of,
    filter_weights,
    finer_raster,
    finer_scene,
    finer_settings,
    grown,
    in_squares,
    inner_of,
    join_bands,
    reach_of,
    resolve_frame,
)
from core.antialiasing.sampling import ROTATED_GRID, grid_positions
from core.coverage.fills import Fragments
from core.coverage.pixel_runs import Raster
from core.depth.depth import NearestFragments, Stored
from core.families import suited
from core.lines.wireframe_fragments import weigh_alpha, writes_depth
from core.records.arrays import Floats, Integers, Singles
from core.records.frame import Frame, Samples, StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene, Texture
from core.settings import DEFAULTS, Settings
from core.stages.before_matrices import before_matrices
from core.stages.bin_and_raster import Counts, fragments_of
from core.stages.declared import STAGES
from core.stages.fragments import (
    fragment_depth,
    fragments_at,
    interpolate,
    not_discarded,
    owner_of,
    shade,
    shade_once,
)
from core.stages.geometry import Geometry
from core.stages.hidden_surfaces import Visible, decide_fragments
from core.stages.needs import check_edits
from core.stages.vertices import Before, process_geometry

if TYPE_CHECKING:
    from core.antialiasing.temporal import MixedPicture

SAMPLE_BAND = 1 << 21
"""Samples that are drawn in one go: the numbers of more would take too much memory."""
PIECE_BAND = 1 << 16
"""Pixels whose pieces are worked on together."""


def render(scene: AnyScene, settings: Settings | None = None) -> Frame:
    """Draw a scene.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings, optional

    Returns
    -------
    Frame

    Raises
    ------
    ValueError
        If a method needs what the scene does not have (``inverse-w`` with an orthographic camera).

    Examples
    --------
    >>> clip = [[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]]
    >>> print(render(ClipScene(clip, size=(4, 3))).primitive[::-1])
    [[-1 -1 -1 -1]
     [ 0  0 -1 -1]
     [ 0  0  0 -1]]
    """
    settings = settings or DEFAULTS
    if scene.corner_count == 0:
        # A table of depths has no samples and no other place of the pixels.
        check_edits(scene, settings)
        settings = suited(settings, scene)
    resolved = resolve(settings)
    # Its settings, which are those it is kept by: looked up again by every stage, they need not be compared.
    return draw(scene, resolved.settings, Raster(*scene.size, resolved.center))


def draw_triangles(
    clip: ArrayLike,
    width: int,
    height: int,
    attributes: ArrayLike | None = None,
    texture: Texture | ArrayLike | None = None,
    settings: Settings | None = None,
) -> Frame:
    """Draw triangles given in clip space.

    Parameters
    ----------
    clip : (T, 3, 4) array_like
        x, y, z, w of every corner, any signs of w.
    width, height : int
        Size of the raster in pixels.
    attributes : (T, 3, K) array_like, optional
        Values to interpolate; the first four are the colour (missing ones are 0, 0, 0, 1), or the first two the
        texture coordinates where a texture is given.
    texture : Texture or (h, w, C) array_like, optional
        Linear texels, row 0 at v = 0; see `core.scene.Texture`.
    settings : Settings, optional
    """
    if texture is not None and not isinstance(texture, Texture):
        texture = Texture(np.asarray(texture))
    values = None if attributes is None else np.asarray(attributes)
    return render(ClipScene(np.asarray(clip), values, (width, height), texture), settings)


def draw(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all; the buffers are those of the raster's region."""
    resolved = resolve(settings).imported
    if scene.makes_positions:
        scene = before_matrices(scene, settings)
    sampling, settings = resolved.sampling, resolved.settings
    if sampling.is_area:
        return draw_areas(scene, settings, raster, chosen)
    if sampling.is_filtered:
        return draw_filtered(scene, settings, raster, chosen)
    if sampling.is_temporal:
        return draw_temporal(scene, settings, raster, chosen)
    if sampling.side:
        return draw_supersampled(scene, settings, raster, chosen, sampling.side)
    if len(sampling.position) > 1:
        return draw_multisampled(scene, settings, raster, chosen)
    return draw_centers(scene, settings, raster, chosen)


def draw_centers(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all, with one sample a pixel: its centre."""
    counts = {stage: StageCount() for stage in STAGES}

    # Transform, cull, clip, edge functions: the triangles.
    geometry = process_geometry(scene, settings, counts, chosen)
    return draw_geometry(scene, geometry, raster, counts)


def draw_geometry(scene: AnyScene, geometry: Geometry, raster: Raster, counts: Counts) -> Frame:
    """Draw what is known of the triangles already, at the pixels' centres; the work is added to ``counts``."""
    # Bin, raster, depth: which fragment is seen at every pixel.
    visible = find_visible(scene, geometry, raster, counts)
    pixel, depth = visible.pixel, visible.depth
    counts["depth"].outgoing = len(pixel)

    # Interpolate, texture and shade, blend: of what is seen, or of all that is mixed with what is there.
    seen = fragments_at(geometry, visible.owner, *raster.position(visible.pixel))
    values = interpolate(geometry, raster, seen, counts["interpolate"])
    color = np.empty((len(depth), 4), np.float32)
    color[:] = scene.background
    if resolve(geometry.settings).is_mixed:
        blend(color, scene, geometry, raster, visible, counts)
    else:
        color[pixel] = shade(scene, geometry, raster, seen, values, counts["shade"])
        counts["blend"].incoming = counts["blend"].outgoing = len(pixel)

    # Resolve: with one sample a pixel there is nothing to average.
    with counts["resolve"]:
        identity = np.full(len(depth), -1, np.int32)
        identity[pixel] = geometry.primitives.triangle[seen.primitive]
        attributes = np.zeros((len(depth), values.shape[1]), np.float32)
        attributes[pixel] = values
        counts["resolve"].incoming = counts["resolve"].outgoing = len(depth)
    return Frame(
        color=color.reshape(*raster.shape, 4),
        depth=depth.reshape(raster.shape),
        primitive=identity.reshape(raster.shape),
        attributes=attributes.reshape(*raster.shape, values.shape[1]),
        cover_count=visible.cover_count.reshape(raster.shape),
        statistics=counts,
    )


def find_visible(scene: AnyScene, geometry: Geometry, raster: Raster, counts: Counts) -> Visible:
    """Bin, raster, depth: find every fragment, in batches, and which of them are seen."""
    resolved = resolve(geometry.settings)
    depth_format, outlines, tested = (
        resolved.depth_format,
        geometry.outlines,
        geometry.drawing.uses_depth_test,
    )
    pixel_count = raster.shape[0] * raster.shape[1]
    cover_count = np.zeros(pixel_count, np.int32)
    owner_count = len(geometry.primitives if outlines is None else outlines)
    in_order = geometry.drawing.decides is not None or not depth_format.keeps_nearest
    nearest = None if in_order else NearestFragments(pixel_count, owner_count, depth_format, tested)
    counts["blend"].note = resolved.blend_inserted_for
    keeps_all = in_order or resolved.is_mixed
    kept: list[tuple[Fragments, Stored]] = []
    for fragments in fragments_of(geometry, raster, counts):
        with counts["depth"] as count:
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            if scene.program is not None:
                keeps = keeps & not_discarded(scene, geometry, raster, fragments)
            if not keeps.all():
                fragments, stored = fragments.select(keeps), stored[keeps]
            pixel = raster.index(fragments.column, fragments.row)
            np.add.at(cover_count, pixel, np.int32(1))
            count.incoming += len(pixel)
            if keeps_all:
                kept.append((fragments, stored))
            if nearest is not None:
                writes = None if outlines is None else writes_depth(fragments)
                if writes is not None:
                    pixel, fragments, stored = pixel[writes], fragments.select(writes), stored[writes]
                nearest.add(pixel, owner_of(fragments), stored)
    with counts["depth"]:
        decided = decide_fragments(geometry, kept, raster) if keeps_all else None
        if nearest is not None:
            pixel, owner, depth = nearest.resolve()
        elif decided is not None:
            pixel, owner, depth = decided.resolve(raster, depth_format)
    return Visible(pixel, owner, depth, cover_count, decided)


def blend(
    color: Singles, scene: AnyScene, geometry: Geometry, raster: Raster, visible: Visible, counts: Counts
) -> None:
    """Interpolate, shade and blend all fragments that pass the depth test into ``color`` (H*W, 4), in drawing order."""
    assert visible.decided is not None
    fragments = visible.decided.passing
    values = interpolate(geometry, raster, fragments, counts["interpolate"])
    source = shade(scene, geometry, raster, fragments, values, counts["shade"])
    with counts["blend"]:
        visible.decided.blend_into(
            color, weigh_alpha(source, fragments), resolve(geometry.settings).blend_method.function
        )
        counts["depth"].outgoing = counts["blend"].incoming = counts["blend"].outgoing = len(fragments)


# A filter over the finished picture.


def draw_filtered(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all, at the pixels' centres, and smooth the edges in the picture."""
    from core.antialiasing.fxaa import around_edges, smoothed_frame

    wide = around_edges(raster)
    return smoothed_frame(draw_centers(scene, settings, wide, chosen), wide, raster)


# The mean of pictures over time.


def draw_temporal(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all, at the pixels' centres, and mix the picture with those before."""
    frame = draw_centers(scene, settings, raster, chosen)
    with frame.statistics["resolve"]:
        mixed, inner = mixed_pictures(scene, settings, raster, chosen)
        color = mixed[-1].kept[inner].astype(np.float32)
    return replace(frame, color=color)


def mixed_pictures(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> "tuple[list[MixedPicture], tuple[slice, slice]]":
    """Return all pictures of a sequence, mixed one after another, and where the raster's pixels stand in them."""
    from core.antialiasing.moving import moves_camera, scene_before
    from core.antialiasing.temporal import mix_pictures

    rule = resolve(settings).method("history").function()
    follows = rule.follows_camera and moves_camera(scene)
    wide = replace(raster, region=None) if follows else grown(raster, 1)
    # Reprojection needs depths that are not rounded to the buffer's format.
    plain = resolve(settings).of_one_sample
    in_depth = replace(plain, depth="z-float32")

    def draw_one(age: int, point: tuple[float, float]) -> tuple[Singles, Floats]:
        then, counts = scene_before(scene, age), {stage: StageCount() for stage in STAGES}
        geometry = process_geometry(then, plain, counts, chosen)
        if geometry.outlines is None:
            geometry = geometry.moved(0.5 - point[0], 0.5 - point[1])
        drawn = draw_geometry(then, geometry, wide, counts)
        if not follows or plain.depth == in_depth.depth:
            return drawn.color, drawn.depth.astype(np.float64)
        geometry = process_geometry(then, in_depth, counts, chosen).moved(0.5 - point[0], 0.5 - point[1])
        return drawn.color, draw_geometry(then, geometry, wide, counts).depth.astype(np.float64)

    first_column, first_row, _, _ = wide.bounds
    origin = first_column + raster.center, first_row + raster.center
    found = mix_pictures(scene, rule, settings.pictures, settings.blend_share / 100, origin, draw_one)
    return found, inner_of(wide, raster)


# Several samples a pixel.


def draw_supersampled(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None, side: int
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all, at ``side`` times the size, every sample shaded, and resolve them.

    Memory: 28 bytes a sample for the buffers (450 a pixel of 4 x 4), beside what `SAMPLE_BAND` samples take.
    """
    weights = filter_weights(grid_positions(side), settings.resolve_filter)
    wide = grown(raster, reach_of(weights))
    finer, plain = finer_scene(scene, side), finer_settings(settings)
    bands = []
    for band in bands_of(finer_raster(wide, side), side, SAMPLE_BAND):
        of_band = {stage: StageCount() for stage in STAGES}
        geometry = in_squares(process_geometry(finer, plain, of_band, chosen), settings, side)
        bands.append(draw_geometry(finer, geometry, band, of_band))

    return resolve_frame(*join_bands(bands, side), weights, wide, raster)


def draw_multisampled(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all: depth at four samples a pixel, colour once for a triangle in a pixel.

    Attributes are interpolated and textures looked up at the pixel's centre, whichever samples are covered: there they
    may lie beyond the triangle (OpenGL's default, without ``centroid``). Depth is that of the sample.
    """
    weights = filter_weights(ROTATED_GRID, settings.resolve_filter)
    wide = grown(raster, reach_of(weights))
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts, chosen)
    moved = [at_sample(geometry, sample) for sample in range(len(ROTATED_GRID))]
    visible = [find_visible(scene, of_sample, wide, counts) for of_sample in moved]
    counts["bin"].incoming //= len(visible)
    seen = [fragments_at(geometry, of_sample.owner, *wide.position(of_sample.pixel)) for of_sample in visible]
    values = interpolate(geometry, wide, seen[0], counts["interpolate"])

    # Colours: one for every triangle in a pixel, whichever of its samples it has.
    resolved = resolve(geometry.settings)
    is_mixed, rule = resolved.is_mixed, resolved.blend_method.function
    shaded = [of_sample.decided.passing for of_sample in visible if of_sample.decided] if is_mixed else seen
    source, number = shade_once(scene, geometry, wide, shaded, counts)
    color = np.empty((len(visible), len(visible[0].depth), 4), np.float32)
    color[:] = scene.background
    with counts["blend"]:
        for buffer, of_sample, fragments, which in zip(color, visible, shaded, number, strict=True):
            drawn = source.take(which, axis=0)
            if is_mixed and of_sample.decided:
                of_sample.decided.blend_into(buffer, weigh_alpha(drawn, fragments), rule)
            else:
                buffer[of_sample.pixel] = drawn
    passed = sum(map(len, shaded))
    counts["depth"].outgoing = counts["blend"].incoming = counts["blend"].outgoing = passed

    # Buffers of all samples.
    with counts["resolve"]:
        identity = np.full(color.shape[:2], -1, np.int32)
        for buffer, of_sample, fragments in zip(identity, visible, seen, strict=True):
            buffer[of_sample.pixel] = geometry.primitives.triangle[fragments.primitive]
        attributes = np.zeros((*wide.shape, values.shape[1]), np.float32)
        attributes.reshape(-1, values.shape[1])[visible[0].pixel] = values
        depth, cover_count = ([getattr(of, name) for of in visible] for name in ("depth", "cover_count"))
        samples = Samples(
            ROTATED_GRID,
            *(
                np.reshape(buffers, (len(visible), *wide.shape, *channels))
                for buffers, channels in ((color, (4,)), (depth, ()), (identity, ()), (cover_count, ()))
            ),
        )
    return resolve_frame(samples, attributes, counts, weights, wide, raster)


# Areas instead of samples.


def draw_areas(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | Before | None = None
) -> Frame:
    """Draw the ``chosen`` (T,) triangles, or all, with exact areas.

    The buffers beside the colour, and all of a wireframe or polygon, are those of the pixels' centres.
    """
    from core.antialiasing.exact_area import draw_pieces, sum_areas

    frame = draw_centers(scene, settings, raster, chosen)
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts, chosen)
    if not geometry.is_cut_to_pixels:
        return frame
    color = np.empty((*raster.shape, 4), np.float32)
    color[:] = scene.background
    for band in bands_of(raster, 1, PIECE_BAND):
        pieces = draw_pieces(scene, geometry, band, counts)
        with counts["resolve"]:
            of_band = color[band.bounds[1] - raster.bounds[1] :][: band.shape[0]].reshape(-1, 4)
            of_band[pieces.touched] = sum_areas(pieces, len(of_band))[pieces.touched]
    counts["resolve"].incoming, counts["resolve"].outgoing = counts["shade"].outgoing, frame.depth.size
    counts["bin"].incoming, counts["bin"].outgoing = counts["edges"].outgoing, counts["raster"].incoming
    counts["blend"].incoming = counts["blend"].outgoing = counts["depth"].outgoing
    for stage, count in frame.statistics.items():
        counts[stage].seconds += count.seconds
    return replace(frame, color=color, statistics=counts)
