"""Trace of blending that resolves lists of hits: each pixel's fragments from front to back, then the background."""

import numpy as np

from core.depth.depth import stack_fragments
from core.framebuffer.blending import add_behind, over_background, resolve_from_front
from core.lines.wireframe_fragments import intensities_of, weigh_alpha, weighed_color
from core.records.arrays import Integers
from core.records.listing import RETURN, Operation, listing
from core.records.steps import RowOrder, Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace

FRONT_TO_BACK = RowOrder(
    ("Row", "Pixel", "Hit"), is_by_pixel=True, sums=(("rows", "step", ""), ("covered", "hit", "added"))
)
"""Pixel after pixel, and of each its fragments from front to back."""
_ADD = (
    Operation("share", "share", {"share": "share"}, ("source", "rest_before")),
    Operation("add", "add", {"added": "color"}, ("front_color",)),
    Operation("rest", "rest", {"rest": "rest"}),
)
_WEIGH = Operation("weigh", "weigh", {"source": "alpha"}, ("color", "intensity"))
FRONT_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "front": _ADD,
    "line-front": (_WEIGH, *_ADD),
    "front-shut": (Operation("shut", "shut", (), ("rest_before",)),),
    "front-store": (
        Operation(
            "store", "store", {"after": RETURN}, {"added": "front", "rest": "through", "before": "buffer"}
        ),
    ),
}
"""Kind of row to what it does: a fragment that is added, one behind an opaque one, and the end of a list."""
KINDS = tuple(FRONT_OPERATIONS)


def trace_from_front(source: TraceSource) -> StageTrace:
    """Return one row for every listed fragment, each pixel's from front to back, and one that stores its colour."""
    drawn = source.drawn[::-1]
    drawn = drawn[np.argsort(source.place[drawn], kind="stable")]
    fragments, place = source.fragments.take(drawn), source.place[drawn]
    shaded = source.surface.color[drawn]
    colors, intensity = weigh_alpha(shaded, fragments), intensities_of(fragments)
    count = len(drawn)

    # What is added so far, and what shows through, before and after each fragment, one layer after another.
    front_color, added = np.zeros((2, count, 4))
    rest_before, rest = np.ones((2, count))
    stacks = stack_fragments(place)
    sums, open_part = np.zeros((len(stacks.pixel), 4)), np.ones(len(stacks.pixel))
    for reached, fragment in stacks.layers():
        front_color[fragment], rest_before[fragment] = sums[:reached], open_part[:reached]
        sums[:reached], open_part[:reached] = add_behind(
            sums[:reached], open_part[:reached], colors.take(fragment, axis=0)
        )
        added[fragment], rest[fragment] = sums[:reached], open_part[:reached]

    # Rows: all fragments of a pixel, then the one that stores; it is about the fragment in front.
    last = ends_of(place)[: len(stacks.pixel)] - 1
    first = np.append(0, last[:-1] + 1)[: len(last)]
    which = np.insert(np.arange(count), last + 1, first)
    is_store = np.insert(np.zeros(count, bool), last + 1, True)
    state = np.insert(np.arange(count), last + 1, last)
    is_added = ~is_store & (rest_before[state] != 0)
    kind = np.where(is_store, KINDS.index("front-store"), KINDS.index("front-shut"))
    kind[is_added] = KINDS.index("front" if intensity is None else "line-front")
    there = source.start.color.reshape(-1, 4).take(place[which], axis=0)
    after = over_background(added[state], rest[state], there)
    row, column = fragments.row[which], fragments.column[which]
    columns = {
        "column": column,
        "row": row,
        "source": colors[which],
        "rest_before": rest_before[state],
        "share": np.where(is_added, rest_before[state] * colors[state][:, 3], np.nan),
        "front_color": front_color[state],
        "added": added[state],
        "rest": rest[state],
        "before": there,
        "after": np.where(is_store[:, None], after, there),
        "in_front": _opaque_in_front(place, rest, source.triangle_of_fragment[drawn])[which],
        "primitive": fragments.primitive[which],
    }
    if intensity is not None:
        columns |= {"color": shaded[which], "intensity": intensity[which]}
    stored = np.flatnonzero(is_store)
    of_list = listing(resolve_from_front)
    return StageTrace(
        stage="blend",
        method=f"blend={source.settings.blend}",
        steps=Steps(KINDS, kind, FRONT_OPERATIONS, ends_of(row), ends_of(row, column)),
        columns=columns,
        triangle=source.triangle_of_fragment[drawn][which],
        pixel=np.stack([column, row], axis=1),
        listings=dict.fromkeys(KINDS, of_list) | {"line-front.weigh": listing(weighed_color)},
        marks={"covered": is_added, "nan": np.any(np.isnan(after), axis=1)},
        buffers=(
            BufferTrack(
                "color", source.start.color, stored, place[which][stored], after[stored], "color", True
            ),
        ),
        order=FRONT_TO_BACK,
    )


def _opaque_in_front(place: Integers, rest: np.ndarray, triangle: Integers) -> Integers:
    """Return for fragments (F,), pixel by pixel from the front, the triangle that nothing shows through; -1: none."""
    found = np.full(len(place), -1)
    shuts = np.flatnonzero(rest == 0)
    pixel, first = np.unique(place[shuts], return_index=True)
    if len(pixel):
        at = np.minimum(np.searchsorted(pixel, place), len(pixel) - 1)
        found = np.where(pixel[at] == place, triangle[shuts[first[at]]], -1)
    return found
