"""The events of a pixel in drawing order, and the verdict above them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from core.culling.culling import REASONS
from core.depth.depth import DepthFormat
from core.framebuffer.blending import blend_traits
from core.interpolation.interpolation import window_weights
from core.pixel_history.candidates import PixelCandidates
from core.pixel_history.chain import (
    clip_link,
    cull_link,
    outline_link,
    raster_links,
    undrawn_values,
    vertex_link,
)
from core.pixel_history.fragments import (
    Link,
    Passage,
    PixelEvent,
    PixelFragments,
    cleared_state,
    fold,
    overwriters,
    run_fragments,
)
from core.records.arrays import Integers
from core.resolved import resolve
from core.stages.hidden_surfaces import shades

# The first line of a pixel's history: what is seen here and why, or what became of one triangle.


FROM_FRONT = ("added", "shut-out")
"""What becomes of fragments that are blended from front to back."""


def pixel_verdict(events: Sequence[PixelEvent], counts: Mapping[str, int], blend: str) -> Link:
    """Return the verdict on a pixel.

    Notes
    -----
    ``nothing-near``: no triangle's box contains it. ``all-missed``: some do, none has a fragment.
    ``all-rejected``: there were fragments, or culled triangles that would have had one. ``seen``,
    ``seen-over`` (it overwrote others), ``blended``: the triangle drawn last is named. ``from-front``,
    ``seen-in-front``: a list was resolved, and the triangle in front is named.
    """
    fragments = [event for event in events if event.kind == "fragment"]
    passed = [event for event in fragments if not event.is_rejected]
    others = [event for event in events if event.kind in ("missed", "culled", "clipped")]
    lost = [event for event in others if event.reason.values.get("would_cover")]
    values: dict[str, Any] = {
        "fragment_count": len(fragments),
        "passed_count": len(passed),
        "listed_count": len(fragments) + len(others),
        "triangle_count": sum(counts.values()) + len({event.triangle for event in (*fragments, *others)}),
    }
    if passed:
        from_front = passed[0].reason.key in FROM_FRONT
        values |= {"triangle": passed[0 if from_front else -1].triangle}
        hidden = [event for event in passed if event.reason.key in ("overwritten", "shut-out")]
        values["overwritten_count"] = len(hidden)
        if from_front and len(passed) > 1:
            key = "from-front" if len(passed) - len(hidden) > 1 else "seen-in-front"
            return Link("verdict", key, values)
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
    ``triangle-seen``, ``triangle-blended`` (others lie over it), ``triangle-overwritten``, ``triangle-shut-out``,
    ``triangle-rejected`` (it had a fragment), ``triangle-absent`` (it had none, and ``reason`` says why).
    """
    own = [event for event in events if event.triangle == triangle]
    fragments = [event for event in own if event.kind == "fragment"]
    passed = [event for event in fragments if not event.is_rejected]
    listed = passed or fragments or own
    reason = listed[-1].reason if listed else Link("raster", "empty-cell", {})
    drawn = [e for e in events if e.kind == "fragment" and not e.is_rejected]
    from_front = bool(drawn) and drawn[0].reason.key in FROM_FRONT
    seen = drawn[0 if from_front else -1].triangle if drawn else -1
    values: dict[str, Any] = {"triangle": triangle, "reason": reason, "seen": seen}
    if not fragments:
        key = "triangle-absent"
    elif not passed:
        key = "triangle-rejected"
    elif reason.key in ("overwritten", "shut-out"):
        key = f"triangle-{reason.key}"
    else:
        key = "triangle-seen" if seen == triangle else "triangle-blended"
    return Link("verdict", key, values)


# The events of a pixel in drawing order: initial value, clear, and every candidate triangle.


LISTED_LIMIT = 256
"""Triangles without a fragment that are listed one by one; of more, those whose edges are nearest."""


def list_events(
    candidates: PixelCandidates, depth_format: DepthFormat
) -> tuple[tuple[PixelEvent, ...], dict[str, int], int]:
    """Return the events, the triangles that are only counted by reason, and the fragments in depth range."""
    cleared = cleared_state(candidates, depth_format)
    fragments = run_fragments(candidates, depth_format)
    passages = fold(fragments, cleared, candidates)
    drawn = _fragment_events(candidates, fragments, passages)
    is_table = candidates.scene.corner_count == 0  # A patch has nothing but its fragments.
    missed = [] if is_table else _missed_events(candidates, fragments.triangle)
    culled = [_culled_event(candidates, int(triangle)) for triangle in candidates.culled]
    clipped = [_clipped_event(candidates, int(triangle)) for triangle in candidates.clipped_away]
    undrawn = [*missed, *culled, *clipped]
    if fragments.turn is None:
        ranked = sorted([*drawn, *undrawn], key=_Rank(candidates))
    else:
        undrawn.sort(key=lambda event: event.triangle)
        ranked = [*undrawn, *(drawn[k] for k in fragments.in_turn)]
    first = (
        PixelEvent("initial", (Link("blend", "initial", {}),)),
        PixelEvent("clear", (Link("blend", "clear", {}),), out=cleared, after=cleared),
    )
    events = (*first, *ranked)
    counts = _absent_patches(candidates, events) if is_table else _counts(candidates, events)
    return events, counts, int(np.count_nonzero(fragments.keeps))


class _Rank:
    """Sort key: the drawing order, in which a culled triangle stands where it would have been drawn.

    Notes
    -----
    Under the painter's algorithm culled triangles are never sorted: they stand before the others. So do they where the
    order cuts triangles, whose pieces are drawn in several turns.
    """

    def __init__(self, candidates: PixelCandidates) -> None:
        self._order = candidates.geometry.kept.triangle
        self._is_rising = bool((np.diff(self._order) > 0).all())
        self._is_cut = candidates.geometry.kept_pieces is not None

    def __call__(self, event: PixelEvent) -> tuple[int, int]:
        if self._is_rising:
            return event.triangle, event.primitive
        if self._is_cut:
            return event.primitive, 0
        place = np.flatnonzero(self._order == event.triangle)
        return (int(place[0]) if len(place) else -1), event.primitive


def _weights(candidates: PixelCandidates, fragments: PixelFragments, k: int) -> dict[str, Any]:
    """Return the weights of a fragment, and those in the window where the division by w makes others of them."""
    values: dict[str, Any] = {"weights": fragments.weights[k], "inverse_w": float(fragments.inverse_w[k])}
    geometry = candidates.geometry
    is_area = geometry.outlines is None and candidates.scene.corner_count == 3
    if is_area and candidates.settings.interpolation == "perspective":
        w = geometry.planes.w[fragments.primitive[k]]
        if w.min() != w.max():
            values["in_window"] = window_weights(fragments.weights[k], w)
    return values


def _fragment_events(
    candidates: PixelCandidates, fragments: PixelFragments, passages: list[Passage]
) -> list[PixelEvent]:
    """Return one event for every covered primitive."""
    blend = resolve(candidates.settings).blend_name
    hidden_by = overwriters(fragments, blend)
    corner_count = candidates.scene.corner_count
    # Of several samples, a fragment that is hidden at this one may be shaded for another.
    shaded_ones = (
        "all" if candidates.colored_by is not None else shades(candidates.scene, candidates.geometry)
    )
    events = []
    for k, (which, passage) in enumerate(zip(candidates.covering.tolist(), passages, strict=True)):
        raster = []
        if corner_count and candidates.geometry.outlines is None:
            raster = raster_links(candidates, which)
        elif corner_count:
            raster = [outline_link(candidates, k)]
        chain = [*_upper_chain(candidates, which), *raster]
        if corner_count in (2, 3):
            chain.append(Link("interpolate", "weights", _weights(candidates, fragments, k)))
        share = None if fragments.light_share is None else float(fragments.light_share[k])
        added = None if fragments.lit_color is None else (fragments.color[k] - fragments.lit_color[k])[:3]
        shaded = Link(
            "shade", "color", {"color": fragments.color[k], "light_share": share, "mirrored": added}
        )
        is_left = passage.passes and hidden_by[k] < 0
        if shaded_ones != "all" and not passage.passes:
            shaded = Link("shade", "not-shaded", {})
        elif shaded_ones == "left" and not is_left:
            shaded = Link("shade", "not-left", {})
        chain += [shaded, passage.depth_link]
        if passage.passes:
            values = {
                "by": hidden_by[k],
                "alpha": float(fragments.source[k, 3]),
                "is_depth": shaded.key == "not-left",
            }
            key = "overwritten" if hidden_by[k] >= 0 else "written"
            if key == "written" and blend_traits(blend).mixes:
                key = "blended"
            if fragments.from_front:
                key = "shut-out" if hidden_by[k] >= 0 else "added"
            chain.append(Link("blend", key, values))
        event = PixelEvent(
            "fragment",
            tuple(chain),
            int(fragments.triangle[k]),
            int(fragments.primitive[k]),
            passage.before,
            passage.out,
            passage.after,
            is_rejected=not passage.passes,
        )
        events.append(event)
    return events


def _upper_chain(candidates: PixelCandidates, which: int) -> list[Link]:
    """Return the links of candidate ``which`` before binning; a fragment of a table enters the pipeline later."""
    if candidates.scene.corner_count == 0:
        return []
    triangle = int(candidates.triangle[which])
    return [
        vertex_link(candidates, triangle),
        cull_link(candidates, triangle),
        clip_link(candidates, triangle, int(candidates.primitive[which])),
    ]


def _missed_events(candidates: PixelCandidates, covering: Integers) -> list[PixelEvent]:
    """Return one event for every drawn triangle without a fragment: of its pieces, the nearest."""
    clearance = candidates.edge_tests.clearance
    open_ones = np.flatnonzero(~np.isin(candidates.triangle, covering))
    # Nearest piece first, then one of each triangle.
    order = open_ones[np.argsort(-clearance[open_ones], kind="stable")]
    _, first = np.unique(candidates.triangle[order], return_index=True)
    chosen = order[np.sort(first)]
    is_focus = candidates.triangle[chosen] == (-1 if candidates.focus is None else candidates.focus)
    chosen = np.concatenate([chosen[is_focus], chosen[~is_focus]])[:LISTED_LIMIT]
    events = []
    for which in chosen.tolist():
        chain = (*_upper_chain(candidates, which), *raster_links(candidates, which))
        primitive = int(candidates.primitive[which])
        event = PixelEvent("missed", chain, int(candidates.triangle[which]), primitive, is_rejected=True)
        events.append(event)
    return events


def _culled_event(candidates: PixelCandidates, triangle: int) -> PixelEvent:
    values = undrawn_values(candidates, triangle)
    link = cull_link(candidates, triangle, values)
    return PixelEvent("culled", (vertex_link(candidates, triangle), link), triangle, is_rejected=True)


def _clipped_event(candidates: PixelCandidates, triangle: int) -> PixelEvent:
    link = clip_link(candidates, triangle)
    link = Link(link.stage, link.key, {**link.values, **undrawn_values(candidates, triangle)})
    chain = (vertex_link(candidates, triangle), cull_link(candidates, triangle), link)
    return PixelEvent("clipped", chain, triangle, is_rejected=True)


def _absent_patches(candidates: PixelCandidates, events: tuple[PixelEvent, ...]) -> dict[str, int]:
    """Count the patches of a table of depths that have no fragment here."""
    count = len(candidates.geometry.vertices.all_corners) - len({event.triangle for event in events} - {-1})
    return {"no-fragment": count} if count else {}


def _counts(candidates: PixelCandidates, events: tuple[PixelEvent, ...]) -> dict[str, int]:
    """Count the triangles that are not listed: culled, clipped away, elsewhere, or past the limit."""
    geometry = candidates.geometry
    listed = np.zeros(len(geometry.assembled), bool)
    listed[[event.triangle for event in events if event.triangle >= 0]] = True
    counts = {}
    by_reason = np.bincount(geometry.culled.verdict[~listed], minlength=len(REASONS))
    for reason, count in zip(REASONS[1:], by_reason[1:].tolist(), strict=True):
        counts[reason] = count
    is_drawn = np.zeros(len(listed), bool)
    is_drawn[geometry.primitives.triangle] = True
    in_box = np.zeros(len(listed), bool)
    in_box[candidates.triangle] = True
    counts["clipped-away"] = int(np.count_nonzero(geometry.culled.kept & ~is_drawn & ~listed))
    counts["outside-box"] = int(np.count_nonzero(is_drawn & ~in_box & ~listed))
    counts["missed"] = int(np.count_nonzero(is_drawn & in_box & ~listed))
    return {reason: count for reason, count in counts.items() if count}
