"""Rows of culling of objects: the tree that is built, then every box that is asked, plane by plane."""

from dataclasses import replace

import numpy as np

from core.culling.culling import PLANES
from core.culling.object_culling import OUTSIDE, ObjectCulling, box_against_planes
from core.records.arrays import Integers
from core.records.listing import Operation, listing
from core.stages.object_tree import ObjectTree
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows
from core.trees.traced import building_rows

VERDICTS = ("outside", "inside", "crossing")
_FAR = (
    Operation("p", "p", {"p_corner": "p"}, ("node", "plane", "plane_equation")),
    Operation("far", "far", ("far",)),
)
WALK_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "box-outside": (*_FAR, Operation("outside", "outside", (), ("slack", "object_count"))),
    "box-plane": (
        *_FAR,
        Operation("not-outside", "outside", (), ("slack",)),
        Operation("n", "n", {"n_corner": "q"}),
        Operation("near", "near", ("near",)),
        Operation("crosses", "crosses", (), ("is_crossed",)),
    ),
    "box-verdict": (Operation("verdict", "verdict", (), ("node", "box_verdict", "object_count")),),
}
"""Kind of row to what it does: a box outside a plane, one that is not, and the end of one that no plane drops."""


def in_front_of(found: StageTrace, group: Integers, source: TraceSource, grown: ObjectTree) -> StageTrace:
    """Return the trace of the stage Cull with the rows about boxes before those of all triangles.

    Parameters
    ----------
    group : (R,) int64
        Of the rows that are there, from 0.
    """
    building = building_rows(grown, source.settings)
    objects = source.geometry.culled.objects
    if objects is not None:
        if objects.occlusion is not None:
            from core.culling.traced_occlusion import occlusion_rows  # Only occluders wait for it.

            comparing = occlusion_rows(objects.tree, objects.occlusion)
            found, group = insert_rows(found, group, comparing), np.concatenate([comparing.group, group])
        walking = walking_rows(objects)
        found, group = insert_rows(found, group, walking), np.concatenate([walking.group, group])
    return replace(insert_rows(found, group, building), extra={**found.extra, "object_tree": grown})


def walking_rows(objects: ObjectCulling) -> InsertedRows:
    """Return one row for every box and plane that is asked, and one for a box that no plane drops.

    A group is a box; groups count down from -2, as -1 is the building of the tree.
    """
    tree, visit, plane = objects.tree, objects.visit, objects.plane
    last = np.flatnonzero(objects.verdict != OUTSIDE)
    order = np.lexsort(
        (np.concatenate([np.zeros(len(visit)), np.ones(len(last))]), np.concatenate([visit, last]))
    )
    visit = np.concatenate([visit, last])[order]
    is_last = (np.arange(len(order)) >= len(plane))[order]
    plane = np.concatenate([plane, np.zeros(len(last), np.int64)])[order]
    node = objects.visited[visit]
    side, equation = objects.sides.side[node, plane], objects.planes.coefficients[plane]
    lower, upper = tree.lower[node], tree.upper[node]
    is_along = equation[:, :3] > 0
    kinds = tuple(WALK_OPERATIONS)
    kind = np.where(is_last, 2, np.where(side == OUTSIDE, 0, 1))
    columns = {
        "visit": visit,
        "node": node,
        "plane": np.array(PLANES)[plane],
        "plane_equation": equation,
        "node_lower": lower,
        "node_upper": upper,
        "node_depth": tree.depth[node],
        "object_count": tree.object_count[node],
        "p_corner": np.where(is_along, upper, lower),
        "n_corner": np.where(is_along, lower, upper),
        "far": objects.sides.far[node, plane],
        "near": objects.sides.near[node, plane],
        "slack": objects.sides.slack[node, plane],
        "is_crossed": objects.sides.near[node, plane] < 0,
        "box_verdict": np.array(VERDICTS)[objects.verdict[visit]],
        "is_node_leaf": tree.is_leaf[node],
    }
    return InsertedRows(
        before=np.zeros(len(order), np.int64),
        group=-2 - visit,
        triangle=np.full(len(order), -1),
        kinds=kinds,
        kind=kind,
        operations=WALK_OPERATIONS,
        columns=columns,
        listings=dict.fromkeys(kinds, listing(box_against_planes)),
    )
