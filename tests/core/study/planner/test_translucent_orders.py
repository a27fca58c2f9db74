"""Sheets that shine through: sorting them shows what a depth buffer hides, so it is no cheaper way to the same."""

import numpy as np
import pytest

from core.scene import ClipScene
from core.study import Tolerance, plan
from core.study.planner.choices.costs import LectureOrder
from core.study.planner.measuring import difference, shown


def sheets(first_depth: float, second_depth: float, alpha: float) -> ClipScene:
    """Return a red and a green triangle, in drawing order, that lie one before the other."""
    corners = np.array([[-0.8, -0.8, 0, 1], [0.8, -0.7, 0, 1], [0.1, 0.9, 0, 1]])
    clip = np.stack([corners, corners])
    clip[0, :, 2], clip[1, :, 2] = first_depth, second_depth
    colors = np.array([[1.0, 0.0, 0.0, alpha], [0.0, 1.0, 0.0, alpha]])[:, None].repeat(3, axis=1)
    return ClipScene(clip, colors, (24, 20))


@pytest.mark.parametrize(
    ("depths", "alpha", "visibility"),
    [
        # Nearer than what is there: drawn from far to near.
        ((0.5, -0.5), 0.5, "last-drawn"),
        # Behind what is there: hidden, but for the painter, who would draw it first and let it shine through.
        ((-0.5, 0.5), 0.5, "z-buffer"),
        # Behind what nothing shines through: the painter covers it.
        ((-0.5, 0.5), 1.0, "painters"),
    ],
)
def test_sorting_is_chosen_only_where_nothing_shines_through(
    depths: tuple[float, float], alpha: float, visibility: str
) -> None:
    scene = sheets(*depths, alpha)
    chosen = plan(scene, Tolerance(2.0), costs=LectureOrder())
    assert chosen.settings.visibility == visibility
    assert difference(shown(scene, chosen.settings), shown(scene, chosen.everything)).max() <= 2
