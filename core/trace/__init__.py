"""Traces: what every stage did, as rows of numbers that a cursor moves over.

``trace(scene, settings, triangle)`` runs nothing; a stage is traced when it is first looked at,
and what traces it is imported no earlier.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

from core.records.arrays import cached_property
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.stages.declared import STAGES

if TYPE_CHECKING:
    from core.trace.source import TraceSource
    from core.trace.stage_trace import StageTrace


class Trace:
    """All stages of one run; each is traced when it is first asked for."""

    def __init__(self, source: "TraceSource") -> None:
        self.source = source
        self._stages: dict[str, StageTrace] = {}

    @cached_property
    def fragment_counts(self) -> tuple[int, int, int, int, int]:
        """Pixels or samples tested and covered, what is interpolated and shaded, and what passes the depth test."""
        from core.trace.sample_sources import count_fragments

        return count_fragments(self.source)

    def stage(self, name: str) -> "StageTrace":
        """Return the trace of a stage of ``core.STAGES``; ValueError if there is no such stage."""
        if name not in STAGES:
            raise ValueError(f"stage must be one of {', '.join(STAGES)}, got {name}")
        if name not in self._stages:
            from core.trace.stage_trace import without_steps
            from core.trace.tracers import trace_stage

            found = trace_stage(self.source, name)
            corner_count = self.source.scene.corner_count
            if corner_count == 0 and STAGES.index(name) < STAGES.index("depth"):
                found = without_steps(found)
            # Another thread may have traced it meanwhile: all see the same.
            found = found if corner_count == 3 else replace(found, corner_count=corner_count)
            self._stages.setdefault(name, found)
        return self._stages[name]


def trace(
    scene: AnyScene,
    settings: Settings | None = None,
    triangle: int | None = None,
    region: tuple[int, int, int, int] | None = None,
    before: str = "earlier",
    lanes: str = "one",
) -> Trace:
    """Prepare the trace of a scene, or of one of its triangles.

    Parameters
    ----------
    triangle : int, optional
        Number of the triangle, in the order of the scene; all triangles by default.
    region : (column, row, columns, rows), optional
        Pixels of the image that the buffers show; the whole image by default.
    before : str
        Buffers at the start: as the ``"earlier"`` triangles left them, or ``"cleared"``.
    lanes : str
        Order of a shader's steps: ``"one"`` vertex or fragment after another, or all of a triangle ``"together"``.

    Raises
    ------
    ValueError
        For a triangle that is not there, a region without pixels, or another ``before`` or ``lanes``.
    """
    if scene.makes_positions:
        from core.stages.before_matrices import before_matrices

        scene = before_matrices(scene, settings or Settings())
    count = scene_triangle_count(scene)
    if triangle is not None and not 0 <= triangle < count:
        raise ValueError(f"triangle must be 0 to {count - 1}, got {triangle}")
    if before not in ("earlier", "cleared"):
        raise ValueError(f"before must be earlier or cleared, got {before}")
    if lanes not in ("one", "together"):
        raise ValueError(f"lanes must be one or together, got {lanes}")
    from core.trace.source import TraceSource

    source = TraceSource(scene, settings or Settings(), triangle, region, before, lanes)
    if min(source.raster.shape) <= 0:
        width, height = scene.size
        raise ValueError(f"region must contain pixels of the {width}x{height} image, got {region}")
    return Trace(source)


def scene_triangle_count(scene: AnyScene) -> int:
    """Return T; of a table of depths the number of its patches."""
    if isinstance(scene, ClipScene):
        return len(scene.clip if scene.table is None else scene.table.depths)
    return sum(len(mesh.triangles) for mesh in scene.meshes)
