"""The history of a pixel, from core's keys and numbers to what the pixel history view shows."""

import numpy as np

from core.framebuffer.display import encode_linear, encode_srgb
from core.trace import TraceSource
from core.why import PixelState, why
from widgets.marks import Mark
from widgets.pixel_history import HistoryEntry, PixelStory, PixelValue
from widgets.why_sentences import count_sentences, event_reason, event_title, verdict_sentence


def story_of(
    source: TraceSource, column: int, row: int, triangle: int | None = None
) -> tuple[PixelStory, list[int | None]]:
    """Return the history of a pixel of the traced picture, and the triangle of each of its lines."""
    history = why(source, column, row, triangle)
    entries, triangles = [], []
    for event in history.events:
        is_fragment = event.kind not in ("initial", "clear")
        mark = None
        if is_fragment:
            mark = Mark.REJECTED if event.is_rejected else Mark.COVERED
        entries.append(
            HistoryEntry(
                event_title(event),
                _value(event.before),
                _value(event.out),
                _value(event.after),
                mark,
                event_reason(event),
                event.is_rejected,
            )
        )
        triangles.append(event.triangle if event.triangle >= 0 else None)
    for sentence in count_sentences(history):
        entries.append(HistoryEntry(sentence, is_rejected=True))
        triangles.append(None)
    mark = Mark.COVERED if history.final.triangle >= 0 else Mark.REJECTED
    verdict = verdict_sentence(history)
    if source.settings.antialiasing != "none":
        verdict = f"At the pixel's centre, whatever its samples are: {verdict}"
    story = PixelStory(column, row, verdict, mark, tuple(entries))
    return story, triangles


def _value(state: PixelState | None) -> PixelValue | None:
    if state is None:
        return None
    color = np.asarray(state.color, np.float32)
    red, green, blue = (int(byte) for byte in encode_srgb(color[:3]))
    return PixelValue((red, green, blue, int(encode_linear(color[3:])[0])), float(state.depth))
