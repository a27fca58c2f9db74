"""What the pipeline rail shows of each stage: what went in and came out, how long it took, why it is there."""

from core import STAGES, Trace
from core.explain.subjects.number_formats import replaced_fill
from core.records.frame import StageCount
from core.resolved import resolve
from core.stages.declared import GEOMETRY_STAGES, stage_of
from widgets.timeline.pipeline_rail import StageEntry, StageState

INSERTED_FOR = {
    "clip": "corners in front of the eye",
    "blend": 'its pixels blended "over"',
}
"""What a method lacked that made the pipeline insert a stage."""
COMPUTED = "No pixel is tested: the ends of the spans are computed."
"""Why the pixels that go into the rasterization are those that come out."""


UNITS = dict.fromkeys(GEOMETRY_STAGES, "triangles") | {"bin": "pixels", "resolve": "pixels"}
"""What comes out of a stage, where it is not fragments."""


def traced_counts(trace: Trace) -> dict[str, tuple[int, int]]:
    """Return what goes into and comes out of every stage of the trace.

    The picture has all triangles, and interpolates and shades only what is seen in the end; the trace may have one
    triangle in focus, and does it with every fragment, in pipeline order. With several samples a pixel, the counts from
    the bins on are those of the picture.
    """
    source, geometry = trace.source, trace.source.geometry
    given, kept, pieces = len(geometry.assembled), len(geometry.kept), len(geometry.primitives)
    counts = source.picture.statistics
    found = {stage: (count.incoming, count.outgoing) for stage, count in counts.items()}
    found |= {"transform": (given, given), "cull": (given, kept)}
    found |= {"clip": (kept, pieces), "edges": (pieces, pieces)}
    if resolve(source.settings).sampling.count == 1:
        fragments, passed = len(source.fragments), int(source.depth_tests.passes.sum())
        tested = fragments if geometry.outlines is not None else int(source.runs.lengths.sum())
        found |= {"bin": (pieces, tested), "raster": (tested, fragments)}
        found |= dict.fromkeys(("interpolate", "shade"), (fragments, fragments))
        found |= {"depth": (fragments, passed), "blend": (passed, passed)}
    elif not found["raster"][0] and found["raster"][1]:
        found["raster"] = found["bin"][1], found["raster"][1]
    return found


def rail_entries(trace: Trace, *, current: str, is_predicting: bool) -> list[StageEntry]:
    """Return the entries of all stages.

    Parameters
    ----------
    trace : Trace
        What is stepped; the times are those of its picture.
    current : str
        The stage that is stepped.
    is_predicting : bool
        Whether counts would tell the answer.
    """
    counts, through = trace.source.picture.statistics, traced_counts(trace)
    whole_seconds = sum(count.seconds for count in counts.values())
    is_whole = trace.source.triangle is None
    entries = []
    for index, stage in enumerate(STAGES):
        count, (incoming, outgoing) = counts[stage], through[stage]
        state, is_inserted, reason = _state_and_reason(
            stage, count, stage == current, trace.source.settings.coverage
        )
        if stage == "raster" and outgoing and not count.incoming:
            reason = reason or COMPUTED
        if is_whole and stage in ("interpolate", "shade") and outgoing > count.outgoing:
            reason = f"The picture needs only the {count.outgoing:,} that are seen in the end."
        entries.append(
            StageEntry(
                stage_of(stage).short_title,
                str((index + 1) % 10) if index < 10 else "",
                "? → ?" if is_predicting else f"{incoming:,} → {outgoing:,}",
                UNITS.get(stage, "fragments"),
                f"{count.seconds * 1000:.1f} ms",
                state,
                is_inserted,
                reason,
                count.seconds / whole_seconds if whole_seconds > 0 else 0.0,
            )
        )
    return entries


def _state_and_reason(
    stage: str, count: StageCount, is_current: bool, coverage: str
) -> tuple[StageState, bool, str]:
    """Return where a stage stands, whether the pipeline has put it in by itself, and why."""
    state = StageState.CURRENT if is_current else StageState.DONE
    if count.note == "not-chosen":
        reason = "Nothing is clipped: homogeneous rasterization needs no clipping."
        return state if is_current else StageState.SKIPPED, False, reason
    if count.note and stage == "raster":
        return state, True, replaced_fill(count.note, coverage)
    if count.note:
        return state, True, f"Inserted because {count.note} needs {INSERTED_FOR[stage]}."
    return state, False, ""
