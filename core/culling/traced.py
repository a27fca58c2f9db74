"""Trace of culling: the tests of every triangle, up to the first that applies."""

import numpy as np

from core.coverage.snapping import place_corners
from core.culling.culling import DEGENERATE, KEPT, PLANES, REASONS, cull_verdict
from core.culling.normal_view import NormalView, cofactors, face_normals
from core.culling.object_culling import box_against_planes
from core.culling.occlusion import box_behind_occluders
from core.methods import table
from core.records.arrays import Integers
from core.records.listing import RETURN, Operation, listing
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

WITH_BOX = ("with-its-box", "behind-occluders")
"""Kinds of rows about a triangle that is dropped with a box, before tests of its own."""
KINDS: tuple[str, ...] = ("behind", "plane", "degenerate", "facing", "kept", *WITH_BOX)
"""What rows may be about; the method decides by what the facing is tested."""


def trace_cull(source: TraceSource) -> StageTrace:
    """Return one row for every test: behind the eye, six planes, degenerate, facing; and one for a kept triangle.

    Culling by N . V has rows of its own in place of the facing. Where boxes are asked, the rows of building their tree
    and of asking them stand before all triangles, and a triangle that is dropped with its box has a single row.

    Segments and points have neither area nor facing.
    """
    assembled, culled, vertices = source.geometry.assembled, source.geometry.culled, source.geometry.vertices
    clip = vertices.clip[vertices.all_corners[assembled.triangle]]
    projected = place_corners(assembled.clip, source.scene.size, source.settings.coverage).is_projected
    count = len(assembled)
    behind = (clip[..., 3] <= 0).all(axis=1)
    outside = np.asarray((culled.distances < 0).all(axis=1))
    outside[:, culled.plane_count :] = False

    # Tests 0: behind, 1 to 6: planes, 7: degenerate, 8: facing, 9: kept; each runs if none before applied.
    # Alone: 10, with its box; 11, behind occluders.
    applies = np.zeros((count, 12), bool)
    applies[:, 0] = behind
    applies[:, 1:7] = outside
    applies[:, 7] = culled.facing == 0
    applies[:, 8] = (culled.verdict != KEPT) & (culled.verdict < DEGENERATE)
    runs = np.cumsum(applies, axis=1) - applies == 0
    runs[:, 1 + culled.plane_count : 7] = False
    corner_count = vertices.corner_count
    if corner_count < 3:
        runs[:, 7:9] = False
    alone = np.stack([culled.dropped_by >= 0, culled.is_hidden], axis=1)
    runs[alone.any(axis=1)] = False
    applies[:, 10:] = runs[:, 10:] = alone
    which, test = np.nonzero(runs)
    kind = np.array([0, *[1] * 6, 2, 3, 4, 5, 6])[test]
    plane = np.where(test == 10, culled.dropped_by[which], np.clip(test - 1, 0, 5))
    verdict = np.array(REASONS)[culled.verdict]
    columns = {
        "w": clip[which][..., 3],
        "plane": np.array(PLANES)[plane],
        "distances": np.take_along_axis(culled.distances[which], plane[:, None, None], axis=2)[
            :, :corner_count, 0
        ],
        "facing": culled.facing[which],
        "is_projected": projected[which],
        "applies": applies[which, test],
        "verdict": np.where(applies[which, test] | (test == 9), verdict[which], "undecided"),
    }
    if vertices.rings is not None:
        flat = vertices.rings_of(assembled.triangle).are_flat.reshape(count, -1)
        columns["flat_ring"] = np.where(flat.any(axis=1), flat.argmax(axis=1), -1)[which]
    kinds, listings = KINDS, dict.fromkeys(KINDS, listing(cull_verdict))
    method = table.get("cull", source.settings.cull)
    if culled.objects is not None:
        columns["node"] = culled.objects.dropped_in[assembled.triangle[which]]
        listings["with-its-box"] = listing(box_against_planes)
        listings["behind-occluders"] = listing(box_behind_occluders)
    sight = culled.sight
    if sight is not None:
        columns |= _normal_view(sight, which)
        kinds = tuple(method.name if name == "facing" else name for name in KINDS)
        assert method.listing is not None
        listings[method.name] = listing(method.listing)
    steps = Steps(
        kinds=kinds,
        kind=kind,
        operations=dict(method.operations)
        | {
            "behind": (Operation("test", "behind", (), ("w", "applies")),),
            "plane": (Operation("test", "outside", (), ("plane", "distances", "applies")),),
            "degenerate": (Operation("test", "degenerate", (), ("facing", "applies")),),
            "facing": (Operation("test", "facing", (), ("facing", "applies", "verdict")),),
            "kept": (Operation("verdict", "kept", {"verdict": RETURN}),),
            "with-its-box": (Operation("drop", "dropped", (), ("plane", "node", "applies", "verdict")),),
            "behind-occluders": (Operation("drop", "compare", (), ("node", "applies", "verdict")),),
        },
        triangle_ends=ends_of(which),
        group_ends=ends_of(which, kind),
    )
    found = StageTrace(
        stage="cull",
        method=f"cull={source.settings.cull}",
        steps=steps,
        columns=columns,
        triangle=assembled.triangle[which],
        pixel=no_pixels(len(which)),
        listings=listings,
        marks={"rejected": applies[which, test], "covered": test == 9},
        extra={"culled": culled},
    )
    grown = source.geometry.object_tree
    if grown is None:
        return found
    from core.culling.traced_objects import in_front_of  # Only boxes wait for it.

    return in_front_of(found, len(KINDS) * which + kind, source, grown)


def _normal_view(sight: NormalView, which: Integers) -> dict[str, np.ndarray]:
    """Return what N . V is made of, for rows (R,) about the triangles ``which``."""
    eye, count = sight.eye, len(which)
    stored, _ = face_normals(eye.given)
    _, determinant = cofactors(eye.carry)
    return {
        "eye_corners": eye.corners.transpose(2, 0, 1)[which],
        "object_corners": eye.given.transpose(2, 0, 1)[which],
        "carry": eye.carry[which],
        "stored": stored.T[which],
        "determinant": determinant[which],
        "normal": sight.normal[which],
        "is_parallel": np.full(count, sight.is_parallel),
        "view": sight.view[which],
        "product": sight.product[which],
    }
