"""Trace of culling: the tests of every triangle, up to the first that applies."""

import numpy as np

from core.geometry.culling import DEGENERATE, KEPT, PLANES, REASONS, cull_verdict
from core.raster.edges.snapping import place_corners
from core.records.listing import listing
from core.records.operation import Operation
from core.records.steps import Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import StageTrace, no_pixels

KINDS = ("behind", "plane", "degenerate", "facing", "kept")


def trace_cull(source: TraceSource) -> StageTrace:
    """Return one row for every test: behind the eye, six planes, degenerate, facing; and one for a kept triangle.

    Segments and points have neither area nor facing.
    """
    assembled, culled, vertices = source.geometry.assembled, source.geometry.culled, source.geometry.vertices
    clip = vertices.clip[vertices.all_corners[assembled.triangle]]
    projected = place_corners(assembled.clip, source.scene.size, source.settings.coverage).is_projected
    count = len(assembled)
    behind = (clip[..., 3] <= 0).all(axis=1)
    outside = (culled.distances < 0).all(axis=1)

    # Tests 0: behind, 1 to 6: planes, 7: degenerate, 8: facing, 9: kept; each runs if none before applied.
    applies = np.zeros((count, 10), bool)
    applies[:, 0] = behind
    applies[:, 1:7] = outside
    applies[:, 7] = culled.facing == 0
    applies[:, 8] = (culled.verdict != KEPT) & (culled.verdict < DEGENERATE)
    runs = np.cumsum(applies, axis=1) - applies == 0
    corner_count = vertices.corner_count
    if corner_count < 3:
        runs[:, 7:9] = False
    which, test = np.nonzero(runs)
    kind = np.array([0, *[1] * 6, 2, 3, 4])[test]
    plane = np.clip(test - 1, 0, 5)
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
    steps = Steps(
        kinds=KINDS,
        kind=kind,
        operations={
            "behind": (Operation("test", "behind", ("w", "applies")),),
            "plane": (Operation("test", "outside", ("plane", "distances", "applies")),),
            "degenerate": (Operation("test", "degenerate", ("facing", "applies")),),
            "facing": (Operation("test", "facing", ("facing", "applies", "verdict")),),
            "kept": (Operation("verdict", "kept", ("verdict",)),),
        },
        triangle_ends=ends_of(which),
        group_ends=ends_of(which, kind),
    )
    return StageTrace(
        stage="cull",
        method=f"cull={source.settings.cull}",
        steps=steps,
        columns=columns,
        triangle=assembled.triangle[which],
        pixel=no_pixels(len(which)),
        listings=dict.fromkeys(KINDS, listing(cull_verdict)),
        marks={"rejected": applies[which, test], "covered": test == 9},
        extra={"culled": culled},
    )
