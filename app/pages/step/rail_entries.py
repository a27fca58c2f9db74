"""What the pipeline rail shows of each stage: what went in and came out, how long it took, why it is there."""

from collections.abc import Mapping

from core import STAGES
from core.explain.subjects.number_formats import replaced_fill
from core.records.frame import StageCount
from core.stages.declared import stage_of
from widgets.timeline.pipeline_rail import StageEntry, StageState

INSERTED_FOR = {
    "clip": "corners in front of the eye",
    "blend": 'its pixels blended "over"',
}
"""What a method lacked that made the pipeline insert a stage."""
COMPUTED = "No pixel is tested: the ends of the spans are computed."
"""Why the pixels that go into the rasterization are those that come out."""


def rail_entries(
    counts: Mapping[str, StageCount],
    *,
    current: str,
    whole_seconds: float,
    measured: str,
    coverage: str,
    is_predicting: bool,
) -> list[StageEntry]:
    """Return the entries of all stages.

    Parameters
    ----------
    counts : mapping
        Of every name of ``core.STAGES``.
    current : str
        The stage that is stepped.
    whole_seconds : float
        What the parts of the time are parts of.
    measured : str
        What took that time, as ``the traced picture``.
    coverage : str
        The number format, which some fills do not take.
    is_predicting : bool
        Whether counts would tell the answer.
    """
    entries = []
    for index, stage in enumerate(STAGES):
        count = counts[stage]
        state, is_inserted, reason = _state_and_reason(stage, count, stage == current, coverage)
        incoming = count.incoming
        if stage == "raster" and not incoming and count.outgoing:
            incoming, reason = counts["bin"].outgoing, reason or COMPUTED
        entries.append(
            StageEntry(
                stage_of(stage).short_title,
                str((index + 1) % 10) if index < 10 else "",
                "? → ?" if is_predicting else f"{incoming:,} → {count.outgoing:,}",
                f"{count.seconds * 1000:.1f} ms",
                state,
                is_inserted,
                reason,
                count.seconds / whole_seconds if whole_seconds > 0 else 0.0,
                measured,
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
