"""Traces: what every stage did, as rows of numbers that a cursor moves over.

``trace(scene, settings, triangle)`` runs nothing; a stage is traced when it is first looked at.
"""

from collections.abc import Callable
from dataclasses import replace

from core.frame import STAGES
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.trace.binning import trace_bin
from core.trace.blend import trace_blend
from core.trace.clip import trace_clip
from core.trace.cull import trace_cull
from core.trace.depth import trace_depth
from core.trace.edges import trace_edges
from core.trace.interpolate import trace_interpolate
from core.trace.raster import trace_raster
from core.trace.resolve import trace_resolve
from core.trace.samples import trace_samples
from core.trace.shade import trace_shade
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, Explanation, StageTrace
from core.trace.transform import trace_transform

TRACERS: dict[str, Callable[[TraceSource], StageTrace]] = {
    "transform": trace_transform,
    "cull": trace_cull,
    "clip": trace_clip,
    "edges": trace_edges,
    "bin": trace_bin,
    "raster": trace_raster,
    "interpolate": trace_interpolate,
    "shade": trace_shade,
    "depth": trace_depth,
    "blend": trace_blend,
    "resolve": trace_resolve,
}


class Trace:
    """All stages of one run; each is traced when it is first asked for."""

    def __init__(self, source: TraceSource) -> None:
        self.source = source
        self._stages: dict[str, StageTrace] = {}

    def stage(self, name: str) -> StageTrace:
        """Return the trace of a stage of ``core.STAGES``.

        Raises
        ------
        ValueError
            If there is no such stage.
        """
        if name not in TRACERS:
            raise ValueError(f"stage must be one of {', '.join(STAGES)}, got {name}")
        if name not in self._stages:
            self._stages[name] = self._run(name)
        return self._stages[name]

    def _run(self, name: str) -> StageTrace:
        """Trace a stage: of several samples a pixel, the stages before they are resolved have rows for each of them.

        Exact areas have their own rows where they are resolved; before, the pixels' centres are followed.
        """
        source, antialiasing = self.source, self.source.settings.antialiasing
        if name == "resolve" or antialiasing == "none":
            return TRACERS[name](source)
        if antialiasing == "area":
            return TRACERS[name](replace(source, settings=replace(source.settings, antialiasing="none")))
        return trace_samples(source, name, TRACERS[name])


def trace(
    scene: AnyScene,
    settings: Settings | None = None,
    triangle: int | None = None,
    region: tuple[int, int, int, int] | None = None,
    before: str = "earlier",
) -> Trace:
    """Prepare the trace of a scene, or of one of its triangles.

    Parameters
    ----------
    scene : Scene or ClipScene
    settings : Settings, optional
    triangle : int, optional
        Number of the triangle, in the order of the scene; all triangles by default.
    region : (column, row, columns, rows), optional
        Pixels of the image that the buffers show; the whole image by default.
    before : str
        Buffers at the start: as the ``"earlier"`` triangles left them, or ``"cleared"``.

    Raises
    ------
    ValueError
        For a triangle that is not there, a region without pixels, or another ``before``.
    """
    count = scene_triangle_count(scene)
    if triangle is not None and not 0 <= triangle < count:
        raise ValueError(f"triangle must be 0 to {count - 1}, got {triangle}")
    if before not in ("earlier", "cleared"):
        raise ValueError(f"before must be earlier or cleared, got {before}")
    source = TraceSource(scene, settings or Settings(), triangle, region, before)
    if min(source.raster.shape) <= 0:
        width, height = scene.size
        raise ValueError(f"region must contain pixels of the {width}x{height} image, got {region}")
    return Trace(source)


def scene_triangle_count(scene: AnyScene) -> int:
    """Return T."""
    if isinstance(scene, ClipScene):
        return len(scene.clip)
    return sum(len(mesh.triangles) for mesh in scene.meshes)


__all__ = [
    "BufferTrack",
    "Explanation",
    "StageTrace",
    "Trace",
    "TraceSource",
    "scene_triangle_count",
    "trace",
]
