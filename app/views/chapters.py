"""The run as chapters: what went into each stage and came out, how long it took, why it is there."""

from core import STAGES, Trace
from core.antialiasing.sampling import Sampling
from core.explain.stage_texts import skipped_because
from core.explain.subjects.number_formats import replaced_fill
from core.records.frame import StageCount
from core.records.nouns import POLYGON
from core.resolved import resolve
from core.stages.declared import GEOMETRY_STAGES, stage_of
from core.trace import TraceSource
from widgets.timeline.chapter_button import Chapter, ChapterState

INSERTED_FOR = {"clip": "corners in front of the eye", "blend": 'its pixels blended "over"'}
"""What a method lacked that made the pipeline insert a stage."""
COMPUTED = "No pixel is tested: the ends of the spans are computed."
"""Why the pixels that go into the rasterization are those that come out."""
_TRIANGLES, _PIXELS, _FRAGMENTS = ("triangles", "tri"), ("pixels", "px"), ("fragments", "frag")
_SAMPLES, _PIECES = ("samples", "smp"), ("pieces", "pcs")
Units = tuple[tuple[str, str], tuple[str, str]]
_PRIMITIVES = {4: ("polygons", "poly"), 2: ("segments", "seg"), 1: ("points", "pt"), 0: ("fragments", "frag")}
_UNITS = dict.fromkeys(GEOMETRY_STAGES, (_TRIANGLES, _TRIANGLES)) | {
    "bin": (_TRIANGLES, _PIXELS),
    "raster": (_PIXELS, _FRAGMENTS),
    "resolve": (_PIXELS, _PIXELS),
}
"""What goes into a stage and comes out, in words and in signs, where it is not fragments; of one sample a pixel."""


def traced_counts(trace: Trace) -> dict[str, tuple[int, int]]:
    """Return what goes into and comes out of every stage of the trace.

    The picture has all triangles, and interpolates and shades only what is seen in the end; the trace may have one
    triangle in focus, and does it with every fragment, in pipeline order.
    """
    source, geometry = trace.source, trace.source.geometry
    given, kept, pieces = len(geometry.assembled), len(geometry.kept), len(geometry.primitives)
    counts = source.picture.statistics
    found = {stage: (count.incoming, count.outgoing) for stage, count in counts.items()}
    found |= {"transform": (given, given), "cull": (given, kept)}
    found |= {"clip": (kept, pieces), "edges": (pieces, pieces)}
    tested, fragments, shaded, passed = trace.fragment_counts
    found |= {"bin": (pieces, tested), "raster": (tested, fragments)}
    found |= dict.fromkeys(("interpolate", "shade"), (shaded, shaded))
    found |= {"depth": (fragments, passed), "blend": (passed, passed)}
    if source.scene.corner_count != 3:
        found |= {"bin": (pieces, pieces), "raster": (pieces, found["raster"][1])}
    elif not found["raster"][0] and found["raster"][1]:
        found["raster"] = found["bin"][1], found["raster"][1]
    return found


def chapters_of(trace: Trace, *, current: str, is_predicting: bool) -> list[Chapter]:
    """Return the chapters of all stages.

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
    is_whole, corner_count = trace.source.triangle is None, trace.source.scene.corner_count
    sampling = resolve(trace.source.settings).sampling
    chapters = []
    for index, stage in enumerate(STAGES):
        count, (incoming, outgoing) = counts[stage], through[stage]
        state, is_inserted, reason = _state_and_reason(stage, current, count, trace.source)
        if stage == "raster" and outgoing and not count.incoming and corner_count == 3:
            reason = reason or COMPUTED
        if is_whole and not is_predicting and stage in ("interpolate", "shade") and outgoing > count.outgoing:
            reason = f"The picture needs only the {count.outgoing:,} that are seen in the end."
        share = count.seconds / whole_seconds if whole_seconds > 0 else 0.0
        words, short = (
            _counted(_units(stage, corner_count, sampling), incoming, outgoing, is_predicting, form)
            for form in (0, 1)
        )
        duration = (
            "" if is_predicting else f"{count.seconds * 1000:.1f} ms, {100 * share:.0f} % of all stages"
        )
        key = str((index + 1) % 10) if index < 10 else ""
        chapters.append(
            Chapter(stage_of(stage).short_title, key, words, short, duration, state, is_inserted, reason)
        )
    return chapters


def _units(stage: str, corner_count: int, sampling: Sampling) -> Units:
    """Return what goes into a stage and comes out of it, each in words and in signs."""
    takes, gives = _UNITS.get(stage, (_FRAGMENTS, _FRAGMENTS))
    if stage == "resolve":
        takes = _PIECES if sampling.is_area else _SAMPLES if sampling.count > 1 else takes
    elif sampling.count > 1 and (sampling.side or stage not in ("interpolate", "shade")):
        takes, gives = (_SAMPLES if unit in (_PIXELS, _FRAGMENTS) else unit for unit in (takes, gives))
    if corner_count == 3:
        return takes, gives
    primitives = _PRIMITIVES[min(corner_count, POLYGON)]
    return {"bin": (primitives, primitives), "raster": (primitives, gives)}.get(
        stage, (primitives, primitives) if takes == _TRIANGLES else (takes, gives)
    )


def _counted(units: Units, incoming: int, outgoing: int, is_predicting: bool, form: int) -> str:
    """Return what goes in and comes out with its units, in words (0) or signs (1); one unit is written once."""
    takes, gives = (
        unit[form].removesuffix("s") if count == 1 and not is_predicting else unit[form]
        for unit, count in zip(units, (incoming, outgoing), strict=True)
    )
    ins, outs = ("?", "?") if is_predicting else (f"{incoming:,}", f"{outgoing:,}")
    return f"{ins} → {outs} {gives}" if units[0] == units[1] else f"{ins} {takes} → {outs} {gives}"


def _state_and_reason(
    stage: str, current: str, count: StageCount, source: TraceSource
) -> tuple[ChapterState, bool, str]:
    """Return where a stage lies in the run, whether the pipeline has put it in by itself, and why."""
    place, present = STAGES.index(stage), STAGES.index(current)
    state = ChapterState.DONE if place < present else ChapterState.AHEAD
    if place == present:
        state = ChapterState.CURRENT
    skipped = skipped_because(stage, source.scene.corner_count)
    if skipped:
        return state if place == present else ChapterState.SKIPPED, False, skipped
    if count.note == "not-chosen":
        is_behind = bool((source.geometry.vertices.clip[:, 3] <= 0).any())
        what = "Nothing is clipped, though a part lies behind the eye" if is_behind else "Nothing is clipped"
        reason = f"{what}: homogeneous rasterization needs no clipping."
        if source.geometry.vertices.rings is not None:
            reason = "Nothing is clipped: choose a method of polygon clipping."
        return state if place == present else ChapterState.SKIPPED, False, reason
    if count.note and stage == "raster":
        return state, True, replaced_fill(count.note, source.settings.coverage)
    if count.note:
        return state, True, f"Inserted because {count.note} needs {INSERTED_FOR[stage]}."
    return state, False, ""
