"""What traces each stage."""

from collections.abc import Callable
from dataclasses import replace
from importlib import import_module

from core.resolved import resolve
from core.settings import Settings
from core.stages.declared import STAGES, stage_of
from core.trace.samples import trace_samples
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace


def tracer_of(stage: str) -> Callable[[TraceSource], StageTrace]:
    """Return the function that traces a stage."""
    module, _, name = stage_of(stage).tracer.rpartition(".")
    found: Callable[[TraceSource], StageTrace] = getattr(import_module(module), name)
    return found


def load_tracers() -> None:
    """Import what traces the stages: each of them is otherwise imported when it is first traced."""
    for stage in STAGES:
        tracer_of(stage)


def trace_stage(source: TraceSource, name: str) -> StageTrace:
    """Trace a stage: of several samples a pixel, the stages before they are resolved have rows for each of them.

    Exact areas have their own rows where they are resolved; before, the pixels' centres are followed.
    """
    antialiasing = source.settings.antialiasing
    if name == "resolve" or antialiasing == Settings.antialiasing:
        return tracer_of(name)(source)
    if resolve(source.settings).sampling.is_area:
        at_centers = replace(source.settings, antialiasing=Settings.antialiasing)
        return tracer_of(name)(replace(source, settings=at_centers))
    return trace_samples(source, name, tracer_of(name))
