"""The last event of a pixel's history: what pictures before, or pixels beside it, have a part in its colour."""

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from core.antialiasing.fxaa import around_edges, smooth_edges
from core.antialiasing.moving import moves_camera
from core.antialiasing.resolve import inner_of
from core.antialiasing.temporal import MixedPicture
from core.coverage.pixel_runs import Raster, make_raster
from core.pipeline import draw_centers, mixed_pictures
from core.pixel_history.fragments import Link, PixelEvent, PixelState
from core.records.arrays import read_only
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings


def resolved_event(
    scene: AnyScene, settings: Settings, column: int, row: int, drawn: PixelState
) -> PixelEvent | None:
    """Return how the colour ``drawn`` at a pixel's centre was mixed with others; ``None``: it is shown as it is."""
    sampling = resolve(settings).sampling
    if not (sampling.is_temporal or sampling.is_filtered):
        return None
    raster = make_raster(scene.size, settings.pixel_center, (column, row, 1, 1))
    if sampling.is_filtered:
        return _smoothed(scene, settings, raster, drawn)
    follows = resolve(settings).method("history").function().follows_camera and moves_camera(scene)
    whole = make_raster(scene.size, settings.pixel_center) if follows else raster
    last, before = _last_mixed(scene, settings, whole)
    at = (row, column) if follows else (0, 0)
    history, limited, kept = (getattr(last, name)[at] for name in ("history", "limited", "kept"))
    x, y = (float(place[at]) for place in (last.from_x, last.from_y))
    values = {
        "share": last.share,
        "before": before,
        "history": limited,
        "is_limited": not np.array_equal(history, limited),
        "place": (x, y),
        "is_moved": (x, y) != (column + raster.center, row + raster.center),
    }
    key = "mixed" if last.is_known[at] else "begun" if before == 0 else "lost"
    return _event(Link("resolve", key, values), drawn, kept)


@lru_cache(maxsize=1)
def _last_mixed(scene: AnyScene, settings: Settings, raster: Raster) -> tuple[MixedPicture, int]:
    """Return the last picture of a sequence, in the pixels of a raster, and how many come before it.

    It is kept for the next pixel: where the history follows the camera, it takes as long as the whole picture.
    """
    pictures, inner = mixed_pictures(scene, settings, raster)
    last = pictures[-1]
    arrays: dict[str, Any] = {
        name: of[inner] for name, of in vars(last).items() if isinstance(of, np.ndarray)
    }
    return replace(last, **arrays), len(pictures) - 1


def _smoothed(scene: AnyScene, settings: Settings, raster: Raster, drawn: PixelState) -> PixelEvent:
    """Return the event of the pixel of a raster, which the filter for edges has looked at."""
    wide = around_edges(raster)
    picture = smooth_edges(draw_centers(scene, settings, wide).color)
    rows, columns = inner_of(wide, raster)
    at = rows.start, columns.start
    edges = picture.edges
    found = np.flatnonzero(edges.place == at[0] * picture.luma.shape[1] + at[1])
    values = {"contrast": float(picture.contrast[at]), "threshold": float(picture.threshold[at])}
    key = "no-edge"
    if len(found):
        of = int(found[0])
        values |= {"share": float(edges.offset[of]), "side": int(edges.side[of])}
        values |= {"is_horizontal": bool(edges.is_horizontal[of])}
        key = "smoothed" if values["share"] > 0 else "edge-kept"
    return _event(Link("resolve", key, values), drawn, picture.color[at])


def _event(link: Link, drawn: PixelState, color: object) -> PixelEvent:
    shown = read_only(np.asarray(color, np.float32).copy())
    after = PixelState(shown, drawn.depth, drawn.triangle)
    return PixelEvent("resolve", (link,), before=drawn, out=None, after=after)
