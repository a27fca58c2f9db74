"""Why one piece of a BSP tree is painted over another: the plane that parts them, and the side of the eye."""

from typing import Any

import numpy as np

from core.methods import is_registered
from core.pixel_history.candidates import PixelCandidates
from core.stages.geometry import Geometry
from core.visibility.bsp import BspTree, build_tree


def piece_number(geometry: Geometry, primitive: int) -> int:
    """Return the number of a primitive's piece within its triangle; 0: the whole triangle."""
    if geometry.kept_pieces is None:
        return 0
    return int(geometry.kept_pieces.number[geometry.kept_of_primitive[primitive]])


def painted_over(candidates: PixelCandidates, primitive: int, below: int) -> dict[str, Any] | None:
    """Return why a primitive is painted over the one ``below``, as numbers and a key; ``None``: no tree orders them."""
    geometry = candidates.geometry
    if not is_registered(candidates.settings.visibility, "bsp") or candidates.scene.corner_count != 3:
        return None
    vertices = geometry.vertices
    tree = build_tree(vertices.clip_rows.take(vertices.corner_rows, axis=1).T)
    upper, lower = (_piece(tree, geometry, one) for one in (primitive, below))
    nodes = [int(tree.node[piece]) for piece in (upper, lower)]
    if min(nodes) < 0:
        return None
    parted = _common(tree, *nodes)
    root = int(tree.root[parted])
    how = "apart"
    if nodes[0] == nodes[1]:
        how = "level"
    elif tree.plane[parted, 2] == 0:
        return None
    elif parted in nodes:
        how = "own" if parted == nodes[0] else "other"
    return {
        "how": how,
        "below": (int(tree.triangle[lower]), int(tree.number[lower])),
        "plane": (int(tree.triangle[root]), int(tree.number[root])),
    }


def _piece(tree: BspTree, geometry: Geometry, primitive: int) -> int:
    """Return the number of a primitive's piece in the tree."""
    triangle = int(geometry.primitives.triangle[primitive])
    is_it = (tree.triangle == triangle) & (tree.number == piece_number(geometry, primitive))
    return int(np.flatnonzero(is_it)[0])


def _common(tree: BspTree, first: int, second: int) -> int:
    """Return the lowest node above both, or one of them; nodes stand before those below them."""
    while first != second:
        if first > second:
            first = int(tree.parent[first])
        else:
            second = int(tree.parent[second])
    return first
