"""Which of any triangles in clip space is seen at every pixel, by fractions: hidden surfaces that can be shrunk."""

import numpy as np

from core.methods import table
from core.pipeline import render
from core.records.arrays import Flags, Floats, Integers
from core.records.cached import cached_property
from core.scene import ClipScene
from core.settings import Settings
from core.study.exact.values import exact_fragments, exact_visible
from core.study.stability.fragments.cases import Judgement, judge_order
from core.study.stability.fragments.shrinkable_cases import AnyCase, pixels_text


class NearestCase(AnyCase):
    """Triangles given in clip space; right is the nearest one at every pixel. Of two as near, either is right."""

    scene: ClipScene

    def __init__(self, scene: ClipScene) -> None:
        self.scene = scene

    @cached_property
    def nearest(self) -> Integers:
        """(H, W) int64, the triangle that is seen; of those as near, the first."""
        return exact_visible(exact_fragments(self.scene.clip, self.scene.size), self.scene.size)

    @cached_property
    def is_decided(self) -> Flags:
        """(H, W) bool, False where several triangles are exactly as near: the last of them is not the first."""
        return np.asarray(self._last(self.scene.clip) == self.nearest)

    @cached_property
    def is_decided_by_w(self) -> Flags:
        """(H, W) bool, where the same triangle is the nearest by w as by z, for formats that store w.

        Notes
        -----
        After projection z and w tell the same; with digits left out they need not any more.
        """
        clip = self.scene.clip.copy()
        # The depth -c/w grows with w, and with c so small it is between the planes.
        clip[..., 2] = -np.abs(clip[..., 3]).min() / 2
        first = exact_visible(exact_fragments(clip, self.scene.size), self.scene.size)
        return np.asarray((first == self.nearest) & (self._last(clip) == self.nearest))

    def _last(self, clip: Floats) -> Integers:
        """Return the nearest triangle, (H, W) int64; of those as near, the last."""
        backwards = exact_visible(exact_fragments(clip[::-1], self.scene.size), self.scene.size)
        return np.where(backwards < 0, -1, len(clip) - 1 - backwards)

    def judge(self, settings: Settings) -> Judgement:
        """Count the pixels that show a triangle which is hidden."""
        wrong = np.asarray(render(self.scene, settings).primitive != self.nearest)
        if wrong.any():
            wrong = wrong & self.is_decided
        if wrong.any() and "perspective" in table.get("depth", settings.depth).needs:
            wrong = wrong & self.is_decided_by_w
        return judge_order(wrong, "a triangle that should be hidden")

    def assertions(self, settings: Settings, wrong: Flags) -> str:
        """Return statements that ``wrong`` pixels, (H, W) bool, show the nearest triangle."""
        return pixels_text(wrong, self.nearest, "frame.primitive[row, column] == wanted")
