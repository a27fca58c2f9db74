"""What a step of de Casteljau's scheme mixes, as lines and points that a view draws."""

import numpy as np

from core.records.arrays import Floats
from core.scene import Scene
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from core.transform.matrices import transform

OF_A_POINT = ("parameter", "parameter-v", "mix", "mix-row", "mix-column", "normal", "emit")
"""Kinds of rows of one point; those of a curve's cut come before."""


def scheme_of(trace: Trace, stage: StageTrace, row: int) -> tuple[Floats, Floats] | None:
    """Return the scheme of the point that a row of Transform is about, as far as it is done; ``None``: it is of none.

    Returns
    -------
    lines : (L, 2, 4) float64
        Clip positions: the control polygon, and the neighbours that were mixed, level by level.
    points : (P, 4) float64
        The mixture that the row made.
    """
    if row < 0 or stage.stage != "transform" or stage.kind_of(row) not in OF_A_POINT:
        return None
    first = row
    while stage.kind_of(first) != "parameter":
        first -= 1
    end = first
    while stage.kind_of(end) != "emit":
        end += 1
    level, kind = stage.columns["level"][first:end], stage.steps.kind[first:end]
    done = np.arange(first, end) <= row
    # A patch has four rows and two columns; the first level of its rows joins control points.
    is_control = (level == 1) & ~(kind == _number(stage, "mix-column"))
    shown = first + np.flatnonzero((level > 0) & (is_control | done))
    lines = np.stack([stage.columns[name][shown] for name in ("first_point", "second_point")], axis=1)
    made = (
        stage.columns["after"][row : row + 1] if level[min(row, end - 1) - first] > 0 or row == end else None
    )
    points = np.empty((0, 4)) if made is None else made
    return _in_clip(trace, lines, int(stage.columns["owner"][row])), _in_clip(
        trace, points, int(stage.columns["owner"][row])
    )


def _number(stage: StageTrace, kind: str) -> int:
    return stage.steps.kinds.index(kind) if kind in stage.steps.kinds else -1


def _in_clip(trace: Trace, points: Floats, patch: int) -> Floats:
    """Return points (..., 4) in clip space: those of a curve are there already, those of a patch in object space."""
    scene, vertices = trace.source.scene, trace.source.geometry.vertices
    if not isinstance(scene, Scene):
        return points
    for mesh in scene.meshes:
        count = 0 if mesh.patches is None else len(mesh.patches)
        if patch < count:
            assert vertices.view is not None
            assert vertices.projection is not None
            world = transform(mesh.transform, points)
            return np.asarray(transform(vertices.projection, transform(vertices.view, world)))
        patch -= count
    raise ValueError(f"the scene has no patch {patch}")
