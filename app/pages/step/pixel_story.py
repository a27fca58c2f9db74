"""The history of a pixel, from core's keys and numbers to what the pixel history view shows."""

import numpy as np

from core.framebuffer.display import encode_linear, encode_srgb
from core.pixel_history import why
from core.pixel_history.fragments import PixelHistory, PixelPieces, PixelState, pixel_pieces
from core.pixel_history.told import count_sentences, event_reason, event_title, verdict_sentence
from core.pixel_history.told_coverage import (
    of_sample,
    piece_reason,
    pieces_verdict,
    samples_name,
    samples_verdict,
)
from core.records.arrays import Singles
from core.records.words import Nouns, counted, nouns, sentence_case
from core.resolved import resolve
from core.trace.source import TraceSource
from widgets.basics.drawing import Mark
from widgets.inspector.pixel_history import HistoryEntry, PixelStory, PixelValue

MOST_GROUPS = 4
"""Groups of samples whose histories are written out; those of more triangles in a pixel are only counted."""
Lines = list[tuple[HistoryEntry, int | None]]
"""The lines of a history, each with its triangle."""


def story_of(
    source: TraceSource, column: int, row: int, triangle: int | None = None
) -> tuple[PixelStory, list[int | None]]:
    """Return the history of a pixel of the traced picture, and the triangle of each of its lines."""
    if resolve(source.settings).sampling.count > 1:
        return _story_of_samples(source, column, row, triangle)
    pieces = pixel_pieces(source, column, row) if resolve(source.settings).sampling.is_area else None
    if pieces is not None:
        return _story_of_pieces(source, pieces, triangle)
    history, drawn = why(source, column, row, triangle), _drawn(source)
    lines = _lines(history, drawn)
    mark = Mark.COVERED if history.final.triangle >= 0 else Mark.REJECTED
    return _story(column, row, verdict_sentence(history, drawn), mark, lines)


def _drawn(source: TraceSource) -> Nouns:
    return nouns(source.scene.corner_count)


def _story_of_pieces(
    source: TraceSource, pieces: PixelPieces, triangle: int | None
) -> tuple[PixelStory, list[int | None]]:
    """Return what triangles did to the pieces of a pixel, and how much of it each of them has."""
    lines: Lines = [(HistoryEntry("Clear", after=_swatch(pieces.background_color)), None)]
    for event in pieces.events:
        is_rejected = not event.passed
        lines.append(
            (
                HistoryEntry(
                    f"{_drawn(source).one.capitalize()} {event.triangle}",
                    _swatch(event.before),
                    None if is_rejected else _swatch(event.color),
                    _swatch(event.after),
                    Mark.REJECTED if is_rejected else Mark.COVERED,
                    sentence_case(f"{piece_reason(event.area, event.passed, event.seen)}."),
                    is_rejected,
                ),
                event.triangle,
            )
        )
    if pieces.untouching_count:
        others = counted(pieces.untouching_count, "triangle does", "triangles do")
        lines.append((HistoryEntry(f"{others} not touch the pixel", is_rejected=True), None))
    mark = Mark.COVERED if any(event.seen for event in pieces.events) else Mark.REJECTED
    verdict = _pieces_verdict(source, pieces, triangle)
    return _story(pieces.column, pieces.row, verdict, mark, lines)


def _pieces_verdict(source: TraceSource, pieces: PixelPieces, triangle: int | None) -> str:
    """Return what the pixel shows; of a triangle that was asked about, what it covers, or why it touches nothing."""
    areas: dict[int, float] = {}
    drawn = _drawn(source)
    for event in pieces.events:
        areas[event.triangle] = areas.get(event.triangle, 0.0) + event.seen
    shown = [(number, area) for number, area in areas.items() if area]
    verdict = pieces_verdict(shown, pieces.background, pieces.is_blended, drawn)
    if triangle is None:
        return verdict
    own = [event for event in pieces.events if event.triangle == triangle]
    if not own:
        return f"{verdict} {verdict_sentence(why(source, pieces.column, pieces.row, triangle), drawn)}"
    area, passed, seen = (sum(getattr(event, name) for event in own) for name in ("area", "passed", "seen"))
    return f"{verdict} {drawn.one.capitalize()} {triangle} {piece_reason(area, passed, seen)}."


def _story_of_samples(
    source: TraceSource, column: int, row: int, triangle: int | None
) -> tuple[PixelStory, list[int | None]]:
    """Return the histories of the samples of a pixel, one for all samples that show the same triangle."""
    groups, drawn = _groups(source, column, row), _drawn(source)
    lines: Lines = []
    verdicts = []
    for _, samples in groups[:MOST_GROUPS]:
        history = why(source, column, row, triangle, sample=samples[0])
        name = samples_name(samples)
        verdict = of_sample(verdict_sentence(history, drawn))
        verdicts.append(f"{name}: {verdict}" if len(groups) > 1 else verdict)
        lines += [
            (_of_samples(entry, name if len(groups) > 1 else ""), of_triangle)
            for entry, of_triangle in _lines(history, drawn)
            if entry.title != "Initial value"
        ]
    rest = groups[MOST_GROUPS:]
    if rest:
        counts = f"{sum(len(samples) for _, samples in rest)} more samples, of {len(rest)} more {drawn.many}"
        lines.append((HistoryEntry(counts), None))
    verdict = samples_verdict(groups, resolve(source.settings).sampling.count, drawn)
    if triangle is not None or len(groups) == 1:
        verdict = f"{verdict} {' '.join(verdicts)}"
    mark = Mark.COVERED if any(shown >= 0 for shown, _ in groups) else Mark.REJECTED
    return _story(column, row, verdict, mark, lines)


def _groups(source: TraceSource, column: int, row: int) -> list[tuple[int, list[int]]]:
    """Return the triangles that samples of a pixel show, -1 for none, and the samples: most samples first."""
    samples = source.picture.samples
    assert samples is not None
    first_column, first_row, _, _ = source.raster.bounds
    shown = samples.primitive[:, row - first_row, column - first_column]
    found = [(int(number), np.flatnonzero(shown == number).tolist()) for number in np.unique(shown)]
    return sorted(found, key=lambda group: (-len(group[1]), group[0] < 0, group[0]))


def _of_samples(entry: HistoryEntry, name: str) -> HistoryEntry:
    """Return a line as one of some samples; of all of them it needs no ``name``."""
    return HistoryEntry(
        f"{entry.title}, {name[0].lower()}{name[1:]}" if name else entry.title,
        entry.before,
        entry.out,
        entry.after,
        entry.mark,
        of_sample(entry.reason),
        entry.is_rejected,
    )


def _lines(history: PixelHistory, drawn: Nouns) -> Lines:
    """Return one line for every event, and for every reason why triangles are not listed."""
    lines: Lines = []
    for event in history.events:
        is_fragment = event.kind not in ("initial", "clear", "resolve")
        mark = None
        if is_fragment:
            mark = Mark.REJECTED if event.is_rejected else Mark.COVERED
        entry = HistoryEntry(
            event_title(event, drawn),
            _value(event.before),
            None if any(link.key == "not-shaded" for link in event.chain) else _value(event.out),
            _value(event.after),
            mark,
            event_reason(event, drawn),
            event.is_rejected,
        )
        lines.append((entry, event.triangle if event.triangle >= 0 else None))
    for text in count_sentences(history, drawn):
        count, _, reason = text.partition(": ")
        lines.append((HistoryEntry(count, reason=reason[:1].upper() + reason[1:], is_rejected=True), None))
    return lines


def _story(
    column: int, row: int, verdict: str, mark: Mark, lines: Lines
) -> tuple[PixelStory, list[int | None]]:
    entries = tuple(entry for entry, _ in lines)
    return PixelStory(column, row, verdict, mark, entries), [triangle for _, triangle in lines]


def _value(state: PixelState | None) -> PixelValue | None:
    return None if state is None else _swatch(state.color, float(state.depth))


def _swatch(linear: Singles, depth: float | None = None) -> PixelValue:
    """Return a linear colour (4,) as it is displayed."""
    color = np.asarray(linear, np.float32)
    red, green, blue = (int(byte) for byte in encode_srgb(color[:3]))
    return PixelValue((red, green, blue, int(encode_linear(color[3:])[0])), depth)
