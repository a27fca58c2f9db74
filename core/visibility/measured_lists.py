"""What lists of hits cost, and what they give: panes of glass in any order, with a z-buffer and with lists.

References
----------
L. Carpenter, *The A-buffer, an antialiased hidden surface method*, 1984.
"""

from dataclasses import replace

import numpy as np

from core.pipeline import render
from core.records.arrays import Flags
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.study.family import Assignment, StudyFamily
from core.study.frame_task import FrameTask, color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.workloads import clip_of_window, random_source, random_triangles
from core.trace.source import TraceSource
from core.visibility.hit_lists import HIT_BYTES

WRONG_COLOR = ErrorMeasure("wrong-color", "Pixels blended in a wrong order", "pixels")
SIZE = (48, 48)
HALF_A_BYTE = 0.5 / 255


def panes(count: int, seed: int) -> ClipScene:
    """Return triangles of glass over a picture, each at one depth, drawn in no order of depth."""
    source = random_source(seed)
    window = random_triangles(SIZE, count, 1.2 * SIZE[0], seed)
    depth = np.repeat(source.permutation(count)[:, None] / max(count, 1) * 0.8 + 0.1, 3, axis=1)
    colors = np.repeat(
        np.append(source.random((count, 3)), np.full((count, 1), 0.5), axis=1)[:, None], 3, axis=1
    )
    return ClipScene(clip_of_window(window, SIZE, depth, np.ones((count, 3))), colors, SIZE)


class PanesTask(FrameTask):
    """Panes of glass, which are to be blended from back to front."""

    scene: ClipScene
    stage = "depth"

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the bytes of depths and colours that are held while everything is drawn, and the longest list."""
        exact = TraceSource(self.scene, settings).exact_tests
        of_samples = HIT_BYTES * SIZE[0] * SIZE[1]
        work = {} if exact is None else dict(exact.work)
        return {
            "bytes held": work.get("bytes of lists", of_samples),
            "longest list": work.get("longest list", 0),
            "fragments": int(made.cover_count.sum()),
        }

    def _wrong(self, settings: Settings, made: Frame) -> Flags:
        """Return (H, W) bool, the pixels that are not those of scan lines, which compare exactly and sort."""
        right = render(self.scene, replace(settings, visibility="scan-line")).color
        wrong: Flags = (np.abs(made.color - right) > HALF_A_BYTE).any(axis=2)
        return wrong

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels of a wrong colour."""
        return judged({WRONG_COLOR.name: float(self._wrong(settings, made).sum())})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours, and those of the exact order."""
        return color_pictures(made.color, render(self.scene, replace(settings, visibility="scan-line")).color)


def make_panes(assignment: Assignment) -> PanesTask:
    """Make so many panes."""
    return PanesTask(panes(int(assignment.dials["count"]), assignment.seed), 1)


LISTS = StudyFamily(
    "lists",
    "One value a pixel, or a list",
    ("visibility",),
    (
        WorkKind(
            "panes",
            "Panes of glass in no order of depth",
            "frame",
            (Axis("count", "Panes", "", (1, 2, 4, 8, 16, 32), default=8, is_cost=True),),
        ),
    ),
    (WRONG_COLOR,),
    make_panes,
    Settings(blend="over", cull="none"),
    only=("z-buffer", "hit-lists"),
)
