"""The first line of a pixel's history: what is seen here and why, or what became of one triangle."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from core.framebuffer.blending import blend_traits
from core.pixel_history.records import Link, PixelEvent


def pixel_verdict(events: Sequence[PixelEvent], counts: Mapping[str, int], blend: str) -> Link:
    """Return the verdict on a pixel.

    Notes
    -----
    ``nothing-near``: no triangle's box contains it. ``all-missed``: some do, none has a fragment.
    ``all-rejected``: there were fragments, or culled triangles that would have had one. ``seen``,
    ``seen-over`` (it overwrote others), ``blended``: the triangle drawn last is named.
    """
    fragments = [event for event in events if event.kind == "fragment"]
    passed = [event for event in fragments if not event.is_rejected]
    others = [event for event in events if event.kind in ("missed", "culled", "clipped")]
    lost = [event for event in others if _would_cover(event)]
    values: dict[str, Any] = {
        "fragment_count": len(fragments),
        "passed_count": len(passed),
        "listed_count": len(fragments) + len(others),
        "triangle_count": sum(counts.values()) + len({event.triangle for event in (*fragments, *others)}),
    }
    if passed:
        values |= {"triangle": passed[-1].triangle}
        hidden = [event for event in passed if event.reason.key == "overwritten"]
        values["overwritten_count"] = len(hidden)
        if blend_traits(blend).mixes and len(passed) - len(hidden) > 1:
            return Link("verdict", "blended", values)
        return Link("verdict", "seen-over" if hidden else "seen", values)
    if fragments or lost:
        last = (fragments or lost)[-1]
        values |= {"triangle": last.triangle, "reason": last.reason}
        return Link("verdict", "all-rejected", values)
    missed = [event for event in others if "distance" in event.reason.values]
    if missed:
        clearance = [event.reason.values["distance"] for event in missed]
        nearest = missed[int(np.argmax(np.nan_to_num(clearance, nan=-np.inf)))]
        values |= {"triangle": nearest.triangle, "reason": nearest.reason}
        return Link("verdict", "all-missed", values)
    return Link("verdict", "nothing-near", values)


def triangle_verdict(events: Sequence[PixelEvent], triangle: int) -> Link:
    """Return the verdict on one triangle at the pixel.

    Notes
    -----
    ``triangle-seen``, ``triangle-blended`` (others lie over it), ``triangle-overwritten``,
    ``triangle-rejected`` (it had a fragment), ``triangle-absent`` (it had none, and ``reason`` says why).
    """
    own = [event for event in events if event.triangle == triangle]
    fragments = [event for event in own if event.kind == "fragment"]
    passed = [event for event in fragments if not event.is_rejected]
    listed = passed or fragments or own
    reason = listed[-1].reason if listed else Link("raster", "empty-cell", {})
    drawn = [e.triangle for e in events if e.kind == "fragment" and not e.is_rejected]
    seen = drawn[-1] if drawn else -1
    values: dict[str, Any] = {"triangle": triangle, "reason": reason, "seen": seen}
    if not fragments:
        key = "triangle-absent"
    elif not passed:
        key = "triangle-rejected"
    elif reason.key == "overwritten":
        key = "triangle-overwritten"
    else:
        key = "triangle-seen" if seen == triangle else "triangle-blended"
    return Link("verdict", key, values)


def _would_cover(event: PixelEvent) -> bool:
    return bool(event.reason.values.get("would_cover"))
