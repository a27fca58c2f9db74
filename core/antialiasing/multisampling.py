"""Multisampling: coverage and depth at four samples a pixel, colour once for every triangle in it.

Attributes are interpolated and textures looked up at the pixel's centre, whichever samples are covered: there they may
lie beyond the triangle (OpenGL's default, without ``centroid``). Depth is that of the sample.

The samples of one place in all pixels are a picture of their own: that of the scene moved by the way from the sample
to the pixel's centre (`core.framebuffer.sample_positions`). A wireframe is not moved: its lines have no area, and cover
all samples of their pixels, as OpenGL's lines without multisampling do.
"""

import numpy as np

from core.antialiasing.sample_counts import SampleTraits
from core.antialiasing.sampled import SampledPicture, resolve_region
from core.antialiasing.single_sample import FoundFragments, find_fragments
from core.framebuffer.blending import blend_stacks
from core.framebuffer.sample_positions import ROTATED_GRID
from core.methods import method, table
from core.pipeline import fragments_of, interpolate_fragments, owner_of, shade_values
from core.raster.lines.intensities import weigh_alpha
from core.raster.pixel_runs import Raster
from core.records.arrays import Floats, Integers, Singles
from core.records.frame import STAGES, Frame, Samples, StageCount
from core.scene import AnyScene
from core.settings import Settings
from core.stages.blend_choice import blend_choice, is_mixed
from core.stages.vertices import Geometry, process_geometry, timed


@method(
    "antialiasing",
    "msaa-4",
    "Multisampling, 4 samples",
    source="OpenGL 4.6, 14.3.1 Multisampling; LMU 2020, Multisampling (MSAA)",
    exact_for="edges, in quarters of a pixel",
    breaks_where="what lies inside triangles (textures, highlights), and colours that extrapolate beyond an edge",
    takes=("resolve_filter",),
    traits=SampleTraits(positions=ROTATED_GRID),
)
def multisample(scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None = None) -> Frame:
    """Draw with four samples a pixel; ``chosen`` (T,) triangles, or all."""
    return resolve_region(
        lambda wide: _draw_samples(scene, settings, wide, chosen), ROTATED_GRID, settings, raster
    )


def at_sample(geometry: Geometry, sample: int) -> Geometry:
    """Return the geometry that has one of the four samples at the pixels' centres."""
    if geometry.outlines is not None:
        return geometry
    x, y = 0.5 - ROTATED_GRID[sample]
    return geometry.moved(float(x), float(y))


def _draw_samples(
    scene: AnyScene, settings: Settings, raster: Raster, chosen: Integers | None
) -> SampledPicture:
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts, chosen)
    moved = [at_sample(geometry, sample) for sample in range(len(ROTATED_GRID))]
    found = [find_fragments(of_sample, settings, raster, counts) for of_sample in moved]
    counts["bin"].incoming //= len(moved)

    # What every sample shows.
    seen = [of_sample.seen for of_sample in found]
    counts["depth"].outgoing = sum(len(pixel) for pixel, _, _ in seen)
    first = fragments_of(geometry, seen[0][1], *raster.position(seen[0][0]))
    values = interpolate_fragments(geometry, settings, raster, first, counts["interpolate"])

    # Colours: one for every triangle in a pixel, whichever of its samples it has.
    color = np.empty((len(moved), len(seen[0][2]), 4), np.float32)
    color[:] = scene.background
    if not is_mixed(settings):
        source, number = _shade_once(scene, geometry, settings, raster, [s[:2] for s in seen], counts)
        with timed(counts["blend"]):
            for of_sample, (pixel, _, _), of_fragment in zip(color, seen, number, strict=True):
                of_sample[pixel] = source.take(of_fragment, axis=0)
        counts["blend"].incoming = counts["blend"].outgoing = counts["depth"].outgoing
    else:
        _blend(color, scene, geometry, settings, raster, found, counts)

    # Buffers of all samples.
    with timed(counts["resolve"]):
        identity = np.full(color.shape[:2], -1, np.int32)
        for of_identity, (pixel, owner, _) in zip(identity, seen, strict=True):
            primitive = fragments_of(geometry, owner, *raster.position(pixel)).primitive
            of_identity[pixel] = geometry.primitives.triangle[primitive]
        attributes = np.zeros((color.shape[1], values.shape[1]), np.float32)
        attributes[seen[0][0]] = values
        shape = (len(moved), *raster.shape)
        samples = Samples(
            ROTATED_GRID,
            color.reshape(*shape, 4),
            np.stack([depth for _, _, depth in seen]).reshape(shape),
            identity.reshape(shape),
            np.stack([of_sample.cover_count for of_sample in found]).reshape(shape),
        )
    return SampledPicture(samples, attributes.reshape(*raster.shape, -1), counts)


def _shade_once(
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    fragments: list[tuple[Integers, Integers]],
    counts: dict[str, StageCount],
) -> tuple[Floats, list[Integers]]:
    """Return the colours (U, 4) at the centres of pixels, and which of them the fragments of every sample have.

    Parameters
    ----------
    fragments : list of ((F,) int64, (F,) int64)
        Pixel and owner of the fragments of every sample.
    """
    pixel_count = raster.shape[0] * raster.shape[1]
    keys = [owner * pixel_count + pixel for pixel, owner in fragments]
    every, number = np.unique(np.concatenate(keys), return_inverse=True)
    owner, pixel = np.divmod(every, pixel_count)
    once = fragments_of(geometry, owner, *raster.position(pixel))
    values = interpolate_fragments(geometry, settings, raster, once, counts["interpolate"])
    colors = shade_values(scene, geometry, settings, raster, once, values, counts["shade"])
    return colors, np.split(number.reshape(-1), np.cumsum([len(key) for key in keys])[:-1])


def _blend(
    color: Singles,
    scene: AnyScene,
    geometry: Geometry,
    settings: Settings,
    raster: Raster,
    found: list[FoundFragments],
    counts: dict[str, StageCount],
) -> None:
    """Blend the fragments of every sample that pass the depth test there into ``color`` (S, H*W, 4)."""
    decided = [of_sample.decided for of_sample in found if of_sample.decided is not None]
    passing = [of_sample.fragments.select(of_sample.passes) for of_sample in decided]
    keys = [(raster.index(f.column, f.row), owner_of(f)) for f in passing]
    source, number = _shade_once(scene, geometry, settings, raster, keys, counts)
    with timed(counts["blend"]):
        rule = table.get("blend", blend_choice(settings)[0]).function
        for of_sample, each, fragments, of_fragment in zip(color, decided, passing, number, strict=True):
            weighed = weigh_alpha(source.take(of_fragment, axis=0), fragments)
            blend_stacks(of_sample, weighed, np.cumsum(each.passes) - 1, each.stacks, each.passes, rule)
        counts["depth"].outgoing = counts["blend"].incoming = counts["blend"].outgoing = sum(
            map(len, passing)
        )
