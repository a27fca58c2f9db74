"""Where a scene's own shaders replace the fixed stages; `core.shaders` is imported for such scenes only."""

from core.geometry.vertex_stage import VertexStage, transform_vertices
from core.scene import AnyScene


def has_program(scene: AnyScene) -> bool:
    """Whether a scene has shaders of its own."""
    return scene.program is not None


def vertex_stage(scene: AnyScene) -> VertexStage:
    """Return every vertex in clip space: by the vertex shader of a scene that has one, else by the matrices."""
    if scene.program is None:
        return transform_vertices(scene)
    from core.shaders.vertex_stage import shade_vertices

    return shade_vertices(scene)
