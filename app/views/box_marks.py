"""Boxes of objects in the 3D view: those made or asked so far, by what has been decided of them."""

from dataclasses import dataclass, field

import numpy as np

from core.culling.traced_occlusion import OCCLUSION_OPERATIONS
from core.records.arrays import Floats
from core.trace.stage_trace import StageTrace

MOST_BOXES = 120
"""Boxes that are drawn: the last ones of more."""
_WAY = (0, 1, 3, 2, 0, 4, 5, 7, 6, 4, -1, 1, 5, -1, 3, 7, -1, 2, 6)
"""Corners of a box along its twelve edges; bit k is the upper end of axis k, -1 lifts the pen."""
INKS = {"outside": "rejected", "inside": "good", "crossing": "tie", "hidden": "rejected", "kept": "good"}
"""Of a box by its verdict."""


@dataclass(frozen=True, eq=False)
class SpaceMark:
    """A line through points of the space that is shown, with a mark and a name at its last point."""

    points: Floats = field(repr=False)
    """(N, 3) float64; a row of NaN lifts the pen."""
    ink: str
    label: str = ""
    shape: str = "none"
    """As of ``widgets.space.scene_view.SceneMark``."""


def box_marks(trace: StageTrace, row: int, is_done: bool = True) -> list[SpaceMark]:
    """Return the boxes that the rows up to ``row`` (with it) have made or asked, that of the row in the accent.

    A box that is asked is drawn by its verdict once the last operation of its row is done (``is_done``); boxes beside
    world space are not drawn.
    """
    from core.culling.traced_objects import VERDICTS  # Trees come along: most scenes are drawn without.

    grown, columns = trace.extra["object_tree"], trace.columns
    if not grown.is_world:
        return []
    node, kind = int(columns["node"][row]), trace.kind_of(row)
    if kind in OCCLUSION_OPERATIONS:
        return _against_occluders(trace, row, is_done)
    if not kind.startswith("box-"):
        first = max(node - MOST_BOXES, 0)
        return [
            *(_box(trace, other, "muted_text") for other in range(first, node)),
            _box(trace, node, "accent", "node"),
        ]
    objects, visit = trace.extra["culled"].objects, int(columns["visit"][row])
    first = max(visit - MOST_BOXES, 0)
    asked = zip(objects.visited[first:visit].tolist(), objects.verdict[first:visit].tolist(), strict=True)
    what = f"{columns['plane'][row]} plane" if kind != "box-verdict" else str(columns["box_verdict"][row])
    what = "outside the " + what if kind == "box-outside" and is_done else what
    marks = [_box(trace, other, INKS[VERDICTS[verdict]]) for other, verdict in asked]
    return [*marks, _box(trace, node, "accent", what)]


def _against_occluders(trace: StageTrace, row: int, is_done: bool) -> list[SpaceMark]:
    """Return the occluders chosen so far, or those of all boxes that have been compared, by their verdicts."""
    occlusion, columns = trace.extra["culled"].objects.occlusion, trace.columns
    boxes, place, rank = occlusion.boxes, int(columns["compared"][row]), int(columns["occluder_rank"][row])
    if rank >= 0 or place < 0:
        chosen = occlusion.occluders if rank < 0 else occlusion.occluders[:rank]
        marks = [_box(trace, int(node), "good") for node in boxes.node[chosen][-MOST_BOXES:]]
        return marks + (
            [_box(trace, int(boxes.node[place]), "accent", f"occluder {rank + 1}")] if rank >= 0 else []
        )
    verdicts = np.where(occlusion.tests.is_hidden, "hidden", "kept")
    before = range(max(place - MOST_BOXES, 0), place)
    marks = [_box(trace, int(boxes.node[other]), INKS[verdicts[other]]) for other in before]
    what = "hidden behind the occluders" if verdicts[place] == "hidden" else "kept"
    what = what if is_done else "node"
    return [*marks, _box(trace, int(boxes.node[place]), "accent", what)]


def _box(trace: StageTrace, node: int, ink: str, what: str = "") -> SpaceMark:
    tree = trace.extra["object_tree"].tree
    ends = np.stack([tree.lower[node], tree.upper[node]])
    corners = np.array([ends[[k & 1, k >> 1 & 1, k >> 2 & 1], [0, 1, 2]] for k in range(8)] + [[np.nan] * 3])
    label = f"node {node}" if what == "node" else f"node {node}: {what}"
    return SpaceMark(corners[list(_WAY)], ink, label if what else "")
