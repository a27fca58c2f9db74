"""Why a pixel looks as it does: its history from the vertices to the blended colour, for every triangle.

The rules of the picture are applied to this one pixel, as a raster of its own; nothing else is drawn. It does not read
a trace of the pixel, which would have rows of what is drawn only: most of a history is about triangles that are not
(culled, clipped away, missed and by how far), and a source for the fragments alone is as long as their stages here.
Triangles whose box does not contain the pixel are only counted. Of several samples a pixel each has a history of its
own; of exact areas ``pieces`` lists which triangle covers how much of the pixel, and this one what is at its centre.
Where pictures are mixed over time, or edges smoothed, the last event says what the colour was mixed with.
"""

from dataclasses import replace

from core.pixel_history.candidates import PixelCandidates, candidates_at, check_pixel, whole_geometry
from core.pixel_history.events import list_events, pixel_verdict, triangle_verdict
from core.pixel_history.fragments import PixelHistory
from core.pixel_history.resolved import resolved_event
from core.resolved import resolve
from core.settings import Settings
from core.trace import scene_triangle_count
from core.trace.source import TraceSource


def why(
    source: TraceSource, column: int, row: int, triangle: int | None = None, sample: int | None = None
) -> PixelHistory:
    """Return the history of a pixel in the picture of the whole scene.

    Parameters
    ----------
    source : TraceSource
        Scene and settings; which triangle it traces and its region do not matter here.
    column, row : int
        The pixel, row 0 at the bottom.
    triangle : int, optional
        A triangle of the scene: it is listed even if it is far away, and the verdict is about it.
    sample : int, optional
        One of several samples of the pixel, instead of its centre. Of n x n samples, columns and rows in the events
        are those of samples.

    Raises
    ------
    ValueError
        For a pixel outside the image, a triangle or a sample that is not there.

    Examples
    --------
    >>> from core import ClipScene, Settings
    >>> scene = ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(4, 3))
    >>> why(TraceSource(scene, Settings()), 0, 0).verdict.key
    'seen'
    >>> why(TraceSource(scene, Settings()), 3, 2).verdict.key
    'all-missed'
    """
    scene, settings = source.scene, source.settings
    check_pixel(scene, column, row)
    geometry = whole_geometry(source)
    count = scene_triangle_count(scene)
    if triangle is not None and not 0 <= triangle < count:
        raise ValueError(f"triangle must be 0 to {count - 1}, got {triangle}")
    if sample is None:
        candidates = PixelCandidates(scene, settings, geometry, column, row, triangle)
    else:
        _check_sample(sample, settings)
        candidates = candidates_at(source, column, row, triangle, sample)
    events, counts, cover_count = list_events(candidates, resolve(settings).depth_format)
    if triangle is None:
        verdict = pixel_verdict(events, counts, resolve(settings).blend_name)
    else:
        verdict = triangle_verdict(events, triangle)
    history = PixelHistory(column, row, triangle, verdict, events, counts, cover_count, sample)
    resolved = resolved_event(scene, settings, column, row, history.final) if sample is None else None
    return history if resolved is None else replace(history, events=(*events, resolved))


def _check_sample(sample: int, settings: Settings) -> None:
    """Refuse a sample that pixels do not have."""
    count = resolve(settings).sampling.count
    if count == 1:
        raise ValueError(
            f"sample needs an antialiasing method with several samples, got {settings.antialiasing}"
        )
    if not 0 <= sample < count:
        raise ValueError(f"sample must be 0 to {count - 1}, got {sample}")
