"""What building a tree will take, before it is built: measured rates, per object and level."""

from dataclasses import dataclass
from math import ceil, log2

from core.records.box_tree import ITEM_BYTES, NODE_BYTES

SECONDS = {"bvh": 0.3e-6, "bvh-area": 0.8e-6, "octree": 0.5e-6}
"""Seconds for an object in a level (measured, 20,000 to 400,000 triangles, one core of 2026); no tree: none."""
WORK_BYTES = 240
"""Bytes that an object takes while a tree is built (measured)."""
COPIES = 4
"""How often nodes are held then: level by level, and in order."""
NEWS_SECONDS = 0.5
"""What takes less is not reported."""


@dataclass(frozen=True)
class BuildCost:
    """What a tree of ``count`` objects will take, roughly."""

    count: int
    seconds: float
    byte_count: int

    @property
    def text(self) -> str:
        """What is being done, and what it takes; empty where nobody would notice."""
        if self.seconds < NEWS_SECONDS:
            return ""
        megabytes = max(round(self.byte_count / 1e6), 1)
        return f"building a tree of {self.count:,} triangles, about {self.seconds:.0f} s and {megabytes:,} MB"


def expected_build(hierarchy: str, count: int, leaf_size: int, octree_depth: int) -> BuildCost:
    """Return what a method of the family ``hierarchy`` will take for ``count`` objects.

    Notes
    -----
    Of an octree, objects that touch several cells are counted three times, as small triangles of a surface are.
    """
    levels = log2(max(count / leaf_size, 1)) + 1
    nodes = (
        2 * 2 ** ceil(levels - 1)
        if hierarchy != "octree"
        else min(8 ** (octree_depth + 1) // 7, 9 * count // leaf_size)
    )
    references = 3 * count if hierarchy == "octree" else count
    bytes_held = WORK_BYTES * count + COPIES * (NODE_BYTES * nodes + ITEM_BYTES * references)
    return BuildCost(count, SECONDS.get(hierarchy, 0.0) * count * levels, bytes_held)
