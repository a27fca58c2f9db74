"""What settings cost on a scene: small pictures of it are drawn and timed, and so the time of the whole is predicted.

Which of two methods is faster depends on the scene (how many triangles, which of the fast ways can draw it) and on the
machine, so it is asked, not assumed. A picture of few pixels is drawn at two sizes: the triangles cost the same in
both, the pixels what the larger one takes longer, and a picture of any size is on the line through the two. The least
of some times is taken, as whatever disturbs a measurement makes it longer.
"""

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import replace
from math import inf, sqrt
from sys import platform
from time import perf_counter, thread_time

from core.fast_path import draw_picture
from core.scene import AnyScene
from core.settings import Settings
from core.study.accuracy.timing import collector_off

ROUNDS = 3
"""Timed drawings of each, in turn, after one that does not count; fewer once it is plain."""
PIXELS = 64 * 64
"""Pixels of the larger of the two pictures."""
CLOCK = perf_counter if platform == "win32" else thread_time
"""Seconds of this thread alone, so that other work of the machine does not count; Windows counts them in 1/64 s."""
BAND = 0.1
"""Part by which times must differ to count as different."""


class Costs:
    """Nothing is timed: the methods that the lectures call cheaper are, on every scene and machine alike."""

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Return whether ``settings`` are known to take longer than ``others``."""
        return False

    def seconds(self, options: Sequence[Settings]) -> tuple[float, ...] | None:
        """Return how long pictures with some settings take, if that is known."""
        return None


class TriedCosts(Costs):
    """Times of small pictures of a scene, each of a scene that nothing is known of."""

    def __init__(self, scene: AnyScene, before_each: Callable[[], None] = lambda: None) -> None:
        self._before_each = before_each
        """Called before every drawing; whatever it raises ends the trial."""
        width, height = scene.size
        self._pixels = width * height
        self._scenes = [scene]
        if self._pixels > PIXELS:
            share = sqrt(PIXELS / self._pixels)
            self._scenes = [
                replace(scene, size=(max(round(width * part), 1), max(round(height * part), 1)))
                for part in (share, share / 2)
            ]
        self._least: dict[Settings, list[float]] = {}

    def is_slower(self, settings: Settings, others: Settings) -> bool:
        """Return whether ``settings`` took longer than ``others`` in most rounds, and by more than `BAND` in all."""
        faster = 0
        for _ in range(ROUNDS):
            faster += self._draw(settings) <= self._draw(others)
            if 2 * faster > ROUNDS:
                return False
        return self._predicted(settings) > (1 + BAND) * self._predicted(others)

    def seconds(self, options: Sequence[Settings]) -> tuple[float, ...]:
        """Return the predicted times of pictures, taken in turn: what disturbs one disturbs the others."""
        for _ in range(ROUNDS):
            for settings in options:
                self._draw(settings)
        return tuple(self._predicted(settings) for settings in options)

    def _draw(self, settings: Settings) -> float:
        """Draw the small pictures once more, and return the time of the larger in seconds."""
        if settings not in self._least:
            self._time(self._scenes[-1], settings)
            self._least[settings] = [inf] * len(self._scenes)
        times = [self._time(scene, settings) for scene in self._scenes]
        self._least[settings] = [min(pair) for pair in zip(self._least[settings], times, strict=True)]
        return times[0]

    def _time(self, scene: AnyScene, settings: Settings) -> float:
        self._before_each()
        fresh = copy(scene)
        with collector_off():
            start = CLOCK()
            draw_picture(fresh, settings)
            return CLOCK() - start

    def _predicted(self, settings: Settings) -> float:
        times = self._least[settings]
        if len(times) == 1:
            return times[0]
        larger, smaller = (scene.size[0] * scene.size[1] for scene in self._scenes)
        of_pixel = max(times[0] - times[1], 0.0) / max(larger - smaller, 1)
        return times[0] + of_pixel * (self._pixels - larger)
