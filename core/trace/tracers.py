"""What traces each stage."""

from collections.abc import Callable
from dataclasses import replace

from core.resolved import resolve
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
from core.trace.stage_trace import StageTrace
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


def trace_stage(source: TraceSource, name: str) -> StageTrace:
    """Trace a stage: of several samples a pixel, the stages before they are resolved have rows for each of them.

    Exact areas have their own rows where they are resolved; before, the pixels' centres are followed.
    """
    antialiasing = source.settings.antialiasing
    if name == "resolve" or antialiasing == Settings.antialiasing:
        return TRACERS[name](source)
    if resolve(source.settings).sampling.is_area:
        at_centers = replace(source.settings, antialiasing=Settings.antialiasing)
        return TRACERS[name](replace(source, settings=at_centers))
    return trace_samples(source, name, TRACERS[name])
