"""Lists of hits: each sample keeps all that it hits, sorts it by depth, and resolves it from front to back.

A z-buffer decides of each fragment when it is drawn, and forgets the loser. Here a sample appends every hit, depth with
colour and alpha, to a list of its own. When everything is drawn, the list is sorted by the stored depths: opaque, its
front is what the z-buffer of the same fragments shows; transparent, it is resolved from front to back
(`core.framebuffer.blending.add_behind`), in whatever order the fragments came. Of equal depths the one drawn first
stays in front, as a z-buffer keeps it.

References
----------
R. Cook, L. Carpenter, E. Catmull, *The Reyes image rendering architecture*, 1987 (a list of hits for each sample).
L. Carpenter, *The A-buffer, an antialiased hidden surface method*, 1984 (lists sorted by depth, front to back).
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", "hidden surface removal – REYES".

Notes
-----
As with the z-buffer, a hit that is not nearer than what the depth buffer held at first is left out: one at depth 1
exactly, or one behind a picture that was there before.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from core.methods import method
from core.records.arrays import Flags, Floats, Integers
from core.records.primitives import DrawingOrder
from core.records.steps import RowOrder
from core.visibility.exact_case import ExactCase, ExactTests

HIT_BYTES = 20
"""Bytes of a hit: its depth, and red, green, blue and alpha, in float32 each; a sample of a z-buffer holds as many."""
LIST_BY_LIST = RowOrder(
    ("Row", "Pixel", "Hit"),
    is_by_pixel=True,
    sums=(
        ("rows", "step", ""),
        ("covered", "hit", "kept"),
        ("depth-failed", "hit", "left out"),
        ("tie", "tie", ""),
    ),
)
"""Pixel after pixel, and of each the hits as they are appended, then as they are sorted."""

Triangle = TypeVar("Triangle")


@dataclass(frozen=True, eq=False)
class HitLists:
    """The lists of all pixels, of F fragments."""

    tracer: ClassVar[str] = "core.visibility.traced_hit_lists.trace_lists"
    listed: Integers
    """(K,) int64, the fragments in lists: pixel after pixel in the order of their numbers, each from front to back."""
    place: Integers
    """(F,) int64, place in the list, 0 at its front; -1: not in it."""
    length: Integers
    """(F,) int64, hits in the list of the fragment's pixel, the fragment among them or not."""
    in_front: Integers
    """(F,) int64, the fragment just in front of it in its list, -1: none."""
    triangle: Integers
    """(F,) int64, of the fragments."""
    is_mixed: bool
    """Whether all of a list is resolved, not only its front."""

    @property
    def work(self) -> dict[str, int]:
        """How many hits are in lists, how long the longest is, and the bytes of all."""
        count = len(self.listed)
        longest = int(self.length.max(initial=0))
        return {"hits listed": count, "longest list": longest, "bytes of lists": HIT_BYTES * count}

    @property
    def turn(self) -> Integers | None:
        """(K,) int64, the listed hits, each pixel's from back to front; ``None`` where only fronts are seen."""
        if not self.is_mixed:
            return None
        start = np.arange(len(self.listed)) - self.place[self.listed]
        return self.listed.take(2 * start + self.length[self.listed] - 1 - np.arange(len(self.listed)))

    def told(self) -> tuple[NDArray[Any], dict[str, Integers]]:
        """Return what is said of F fragments of one pixel: where in the list they are, behind which triangle."""
        keys = np.where(self.place > 0, "list-behind", np.where(self.place == 0, "list-front", "list-beyond"))
        against = np.where(self.in_front >= 0, self.triangle.take(self.in_front), -1)
        return keys, {"against": against, "place": self.place + 1, "length": self.length}


def list_hits(
    hits: Iterable[tuple[float, Triangle]],
    cleared: float,
    larger_is_nearer: bool,
    shows_through: bool,
) -> list[tuple[float, Triangle]]:
    """Listing of one sample: its hits in drawing order, depth and triangle; what is resolved, from front to back."""
    hit_list: list[tuple[float, Triangle]] = []
    for depth, triangle in hits:
        nearer = depth > cleared if larger_is_nearer else depth < cleared
        if not nearer:
            continue  #: beyond
        hit_list.append((depth, triangle))  #: append
    hit_list.sort(key=lambda hit: hit[0], reverse=larger_is_nearer)  #: sort
    return hit_list if shows_through else hit_list[:1]  #: resolve


def decide_by_lists(case: ExactCase) -> tuple[Flags, ExactTests]:
    """Append every hit to its pixel's list and sort the lists; transparent, all in them pass, opaque, their fronts."""
    pixel, stored, kept = case.pixel, case.stored, case.depth_format
    is_listed = kept.is_nearer(stored, case.initial_depth.take(pixel))
    hit = np.flatnonzero(is_listed)
    from_front = -stored[hit] if kept.larger_is_nearer else stored[hit]
    listed = hit[np.lexsort((hit, from_front, pixel[hit]))]
    begins = np.flatnonzero(np.diff(pixel[listed], prepend=-1))
    count = np.diff(begins, append=len(listed))
    place, in_front = np.full((2, len(pixel)), -1)
    place[listed] = np.arange(len(listed)) - np.repeat(begins, count)
    behind = np.flatnonzero(place[listed] > 0)
    in_front[listed[behind]] = listed[behind - 1]
    length = np.zeros(len(case.initial), np.int64)
    length[pixel[listed[begins]]] = count
    lists = HitLists(listed, place, length.take(pixel), in_front, case.triangle, case.is_mixed)
    return (is_listed if case.is_mixed else place == 0), lists


@method(
    "visibility",
    "hit-lists",
    "Lists of hits (REYES)",
    source="Cook, Carpenter and Catmull 1987; Carpenter 1984 (A-buffer); Pellacini, hidden surface removal: REYES",
    exact_for="opaque and blended triangles in any order, to the resolution of the depth format",
    breaks_where="memory: it grows with the hits of all samples; exact areas: pieces of pixels are not sorted",
    listing=list_hits,
    traits="lists",
)
def hit_lists(clip: Floats) -> DrawingOrder:
    """Take the triangles as given: lists are sorted when all of them are drawn."""
    return DrawingOrder(np.arange(len(clip)), True, decide_by_lists, LIST_BY_LIST, resolves_lists=True)
