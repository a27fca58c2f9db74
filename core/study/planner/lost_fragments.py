"""Fragments that a depth format would lose: stored as the value of the cleared buffer, they are not nearer than it.

A trial sees that in the rows it draws. Between them every triangle is asked how far its fragments may lie
(`farthest_stored`), and where that does not settle it, for its fragments themselves.
"""

from collections.abc import Iterator

import numpy as np

from core.antialiasing.sample_rasters import at_sample, finer_raster, finer_scene, finer_settings, in_squares
from core.framebuffer.depth import DepthFormat, Stored
from core.methods import table
from core.raster.binning import bound
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Integers
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings
from core.stages.bin_and_raster import fragments_of
from core.stages.declared import STAGES
from core.stages.fragment_depth import farthest_stored, fragment_depth
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry

SAMPLES = 1 << 20
"""Samples in the boxes of triangles that are looked at; of triangles with more, some are taken to be lost."""


def far_triangles(geometry: Geometry) -> dict[str, Integers]:
    """Return by depth method the triangles (T,) of which a fragment may be lost."""
    found = {}
    for depth in table.names("depth"):
        depth_format: DepthFormat = table.get("depth", depth).function()
        is_far = ~_is_kept(farthest_stored(geometry, depth_format), depth_format)
        found[depth] = np.unique(geometry.primitives.triangle[is_far])
    return found


def loses_fragments(scene: AnyScene, settings: Settings, triangles: Integers) -> bool:
    """Return whether a fragment of some ``triangles`` (T,) is lost, or they have too many to be looked at."""
    if not len(triangles):
        return False
    depth_format = resolve(settings).depth_format
    counts = {stage: StageCount() for stage in STAGES}
    room = SAMPLES
    for geometry, raster in _of_samples(scene, settings, triangles):
        boxes = bound(geometry.edges, raster)
        room -= int(((boxes.row_end - boxes.row) * (boxes.column_end - boxes.column)).sum())
        if room < 0:
            return True
        for fragments in fragments_of(geometry, raster, counts):
            _, keeps, stored = fragment_depth(geometry, fragments, raster, depth_format)
            if not _is_kept(stored[keeps], depth_format).all():
                return True
    return False


def _is_kept(stored: Stored, depth_format: DepthFormat) -> Flags:
    """Return which of stored depths (F,) are nearer than the cleared buffer."""
    return depth_format.is_nearer(stored, np.full_like(stored, depth_format.cleared))


def _of_samples(
    scene: AnyScene, settings: Settings, triangles: Integers
) -> Iterator[tuple[Geometry, Raster]]:
    """Yield geometry and raster of all samples of one place in the pixel, or of those of a finer picture."""
    resolved, counts = resolve(settings), {stage: StageCount() for stage in STAGES}
    sampling, raster = resolved.sampling, Raster(*scene.size, resolved.center)
    if not sampling.side:
        geometry = process_geometry(scene, settings, counts, triangles)
        for sample in range(len(sampling.position)):
            yield at_sample(geometry, sample) if len(sampling.position) > 1 else geometry, raster
        return
    finer, plain = finer_scene(scene, sampling.side), finer_settings(settings)
    geometry = process_geometry(finer, plain, counts, triangles)
    yield in_squares(geometry, settings, sampling.side), finer_raster(raster, sampling.side)
