"""Where a scene's own shaders replace the fixed stages; `core.shaders` is imported for such scenes only."""

import numpy as np

from core.geometry.vertex_stage import VertexStage, transform_vertices
from core.raster.coverage import Fragments
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags
from core.scene import AnyScene
from core.stages.geometry import Geometry


def has_program(scene: AnyScene) -> bool:
    """Whether a scene has shaders of its own."""
    return scene.program is not None


def vertex_stage(scene: AnyScene) -> VertexStage:
    """Return every vertex in clip space: by the vertex shader of a scene that has one, else by the matrices."""
    if scene.program is None:
        return transform_vertices(scene)
    from core.shaders.vertex_stage import shade_vertices

    return shade_vertices(scene)


def not_discarded(scene: AnyScene, geometry: Geometry, raster: Raster, fragments: Fragments) -> Flags:
    """Return (F,) bool, which fragments go on to the depth test: all but those that a fragment shader discards."""
    if not has_program(scene):
        return np.ones(len(fragments), bool)
    from core.shaders.fragment_stage import discarded_fragments

    discarded = discarded_fragments(scene, geometry, raster, fragments)
    return np.ones(len(fragments), bool) if discarded is None else ~discarded
