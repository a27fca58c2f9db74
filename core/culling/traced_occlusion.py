"""Rows of occlusion culling: the boxes that are drawn first, the pyramid over their depth, and every box against it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.culling.occlusion import (
    Occlusion,
    box_behind_occluders,
    coarser_level,
    largest_boxes,
    pyramid_of,
)
from core.records.box_tree import BoxTree
from core.records.listing import Operation, listing
from core.trace.stage_trace import InsertedRows

_AGAINST = (
    Operation("rectangle", "rectangle", {"box_rectangle": "left bottom right top"}, ("node", "box_window")),
    Operation("nearest", "nearest", {"box_nearest": "nearest"}, ("box_depth", "depth_slack")),
    Operation("pyramid-level", "level", (), ("box_level",)),
    Operation("texels", "texels", {"box_farthest": "farthest"}, ("box_texels", "box_stored")),
    Operation("compare", "compare", (), ("is_hidden", "object_count")),
)
OCCLUSION_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "occluder": (
        Operation("pixels", "pixels", {"box_pixels": "pixels"}, ("node", "box_rectangle")),
        Operation("chosen", "chosen", (), ("occluder_rank", "occluder_count", "box_count")),
    ),
    "no-occluder": (Operation("none", "", (), ("why_none",)),),
    "pyramid-bottom": (Operation("drawn", "", (), ("made_level", "level_size", "occluder_count")),),
    "pyramid-level": (
        Operation("level", "level", {"level_size": "coarser"}, ("made_level", "keeps_farthest")),
    ),
    "near-box": (Operation("near-plane", "near-plane", (), ("node", "object_count")),),
    "seen-box": _AGAINST,
    "hidden-box": _AGAINST,
}
"""Kind of row to what it does; without occluders there is the row that says why, and none of the others."""
KINDS = tuple(OCCLUSION_OPERATIONS)


def occlusion_rows(tree: BoxTree, occlusion: Occlusion) -> InsertedRows:
    """Return one row for every occluder and every level of the pyramid, then one for every box that is compared.

    Occluders, levels and boxes are a group each.
    """
    boxes, tests, chosen = occlusion.boxes, occlusion.tests, occlusion.occluders
    levels = np.arange(len(tests.pyramid) if len(chosen) else 0)
    compared = np.arange(len(boxes.node) if len(chosen) else 0)
    of_box = np.where(boxes.is_before, KINDS.index("near-box"), KINDS.index("seen-box") + tests.is_hidden)
    kind = np.concatenate(
        [
            np.full(len(chosen) or 1, KINDS.index("occluder" if len(chosen) else "no-occluder")),
            np.where(levels > 0, KINDS.index("pyramid-level"), KINDS.index("pyramid-bottom")),
            of_box[compared],
        ]
    ).astype(np.int64)
    count, first_level = len(kind), len(chosen) or 1
    place = np.full(count, -1)
    place[: len(chosen)], place[count - len(compared) :] = chosen, compared
    node = np.where(place >= 0, boxes.node[place], -1) if len(boxes.node) else place
    rank = np.full(count, -1)
    rank[: len(chosen)] = np.arange(len(chosen))
    made = np.full(count, -1)
    made[first_level : first_level + len(levels)] = levels
    window = boxes.corners[..., :2]
    reached = np.concatenate([window.min(axis=1) - boxes.reach, window.max(axis=1) + boxes.reach], axis=1)
    nearest_corner = boxes.nearest + boxes.slack

    def of_boxes(values: NDArray[Any], empty: Any = np.nan) -> NDArray[Any]:
        """Spread values (B, ...) of the boxes over the rows."""
        if not len(values):
            return np.full((count, *values.shape[1:]), empty, values.dtype)
        spread: NDArray[Any] = values[place]
        spread[place < 0] = empty
        return spread

    def of_nodes(values: NDArray[Any], empty: Any) -> NDArray[Any]:
        """Spread values (N, ...) of all nodes over the rows."""
        spread: NDArray[Any] = values[node]
        spread[node < 0] = empty
        return spread

    columns = {
        "node": node,
        "node_lower": of_nodes(tree.lower, np.nan),
        "node_upper": of_nodes(tree.upper, np.nan),
        "node_depth": of_nodes(tree.depth, -1),
        "object_count": of_nodes(tree.object_count, -1),
        "compared": place,
        "box_window": of_boxes(reached),
        "box_rectangle": of_boxes(boxes.rectangle, -1),
        "box_pixels": of_boxes(boxes.pixel_count, -1),
        "box_depth": of_boxes(nearest_corner),
        "depth_slack": of_boxes(boxes.slack),
        "box_nearest": of_boxes(boxes.nearest),
        "box_level": of_boxes(tests.level, -1),
        "box_texels": of_boxes(tests.texels, -1),
        "box_stored": of_boxes(tests.stored),
        "box_farthest": of_boxes(tests.farthest),
        "is_hidden": of_boxes(tests.is_hidden, False),
        "occluder_rank": rank,
        "occluder_count": np.full(count, len(chosen)),
        "box_count": np.full(count, np.count_nonzero(~boxes.is_before)),
        "made_level": made,
        "level_size": np.array([tests.pyramid[k].shape[::-1] if k >= 0 else (-1, -1) for k in made.tolist()]),
        "keeps_farthest": np.array([k > 0 and _keeps_farthest(occlusion, k) for k in made.tolist()]),
        "larger_is_nearer": np.full(count, occlusion.larger_is_nearer),
        "why_none": np.full(count, occlusion.why_none),
    }
    listings = dict.fromkeys(KINDS, listing(box_behind_occluders))
    listings |= {"occluder": listing(largest_boxes), "pyramid-level": listing(coarser_level)}
    return InsertedRows(
        before=np.zeros(count, np.int64),
        group=-2 - len(tree) - np.where(made >= 0, 1, np.where(rank >= 0, 0, 2)),
        triangle=np.full(count, -1),
        kinds=KINDS,
        kind=kind,
        operations=OCCLUSION_OPERATIONS,
        columns=columns,
        listings={name: listings[name] for name in KINDS if name not in ("no-occluder", "pyramid-bottom")},
    )


def _keeps_farthest(occlusion: Occlusion, level: int) -> bool:
    """Return whether each texel of a level keeps the farthest of those below it."""
    join = np.minimum if occlusion.larger_is_nearer else np.maximum
    pyramid = occlusion.tests.pyramid
    return bool(np.array_equal(pyramid[level], pyramid_of(pyramid[level - 1], join)[1]))
