"""Flushing measured on this machine, and what buffers show of a second of pictures by the model.

The times of the study of flushing are real: those of copying the bytes of one picture. The times of the study of
presentations are those of computing the model; what it finds is in its errors and counts.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from core.framebuffer.display import encode_linear, encode_srgb
from core.framebuffer.flushing import BYTES, Flush
from core.framebuffer.presentation import Buffering, Schedule, available, pictures_read, schedule, torn
from core.methods import table
from core.pipeline import render
from core.records.arrays import Integers
from core.scene import AnyScene
from core.settings import Settings
from core.study.family import Assignment, StudyFamily, Task
from core.study.frame_task import MILLION, color_pictures, colors_of
from core.study.record import Axis, ErrorMeasure, Judgement, Opening, Pictures, WorkKind, judged
from core.study.workloads import clip_of_window, flat_scene

WRONG_BYTES = ErrorMeasure("wrong-bytes", "Wrong bytes", "per million")
TORN = ErrorMeasure("torn", "Torn refreshes", "per million")
HEIGHT = 48
"""Rows of the screen of the model."""
SECOND = 1000
"""Milliseconds of the model that are computed."""


def screen_scene(width: int, height: int) -> AnyScene:
    """Return one triangle over half of a picture."""
    window = np.array([[[0.0, 0.0], [width, 0.0], [0.0, height]]])
    clip = clip_of_window(window, (width, height), np.full((1, 3), 0.5), np.ones((1, 3)))
    return flat_scene(clip, (width, height))


class FlushTask(Task):
    """The bytes of one picture, copied into the memory of a screen."""

    def __init__(self, width: int, height: int) -> None:
        self.scene, self.unit_count = screen_scene(width, height), width * height
        color = render(self.scene, Settings()).color
        pixels = np.concatenate([encode_srgb(color[..., :3]), encode_linear(color[..., 3:])], axis=2)
        self._picture, self._shape = pixels.tobytes(), (height, width, BYTES)

    def start(self, settings: Settings) -> Callable[[], tuple[bytearray, int]]:
        """Prepare an empty memory."""
        copy = table.get("flush", settings.flush).listing
        assert copy is not None
        return partial(self._copied, copy, bytearray(len(self._picture)))

    def _copied(self, copy: Callable[..., int], memory: bytearray) -> tuple[bytearray, int]:
        return memory, copy(memory, self._picture, self._shape[1])

    def _pixels(self, made: bytes | bytearray) -> Any:
        return np.frombuffer(bytes(made), np.uint8).reshape(self._shape)

    def judge(self, settings: Settings, made: tuple[bytearray, int]) -> Judgement:
        """Count the bytes that differ."""
        wrong = self._pixels(made[0]) != self._pixels(self._picture)
        return judged({WRONG_BYTES.name: MILLION * int(wrong.sum()) / wrong.size})

    def counts(self, settings: Settings, made: tuple[bytearray, int]) -> dict[str, int]:
        """Return transfers and bytes."""
        return {"transfers": made[1], "bytes": len(self._picture)}

    def pictures(self, settings: Settings, made: tuple[bytearray, int]) -> Pictures:
        """Return memory and picture."""
        return color_pictures(self._pixels(made[0]) / 255, self._pixels(self._picture) / 255)

    def opening(self, settings: Settings, made: tuple[bytearray, int]) -> Opening:
        """Return the picture, presented with two buffers."""
        height, width, _ = self._shape
        small = screen_scene(max(width // 16, 1), max(height // 16, 1))
        return Opening(small, replace(settings, presentation="double"), "resolve", None)


class PresentationTask(Task):
    """A second of pictures on a screen, by the model."""

    unit_count = 1

    def __init__(self, drawing_time: int, refresh_time: int) -> None:
        self._drawing, self._refresh = drawing_time, refresh_time
        self.count = -(-SECOND // refresh_time)

    def start(self, settings: Settings) -> Callable[[], tuple[Schedule, Integers]]:
        """Prepare the model."""
        buffering = table.get("presentation", settings.presentation).function()
        return partial(self._shown, buffering, table.get("flush", settings.flush).function())

    def _shown(self, buffering: Buffering, flush: Flush) -> tuple[Schedule, Integers]:
        times = schedule(buffering, self._drawing, self._refresh, SECOND)
        since = available(buffering, flush, times, HEIGHT, self._drawing)
        return times, pictures_read(since, self.count, self._refresh)

    def judge(self, settings: Settings, made: tuple[Schedule, Integers]) -> Judgement:
        """Count the refreshes, of pictures (F, H), that show rows of several."""
        return judged({TORN.name: MILLION * int(torn(made[1]).sum()) / self.count})

    def counts(self, settings: Settings, made: tuple[Schedule, Integers]) -> dict[str, int]:
        """Return what is shown in the second, of (F, H), and how long the renderer waits for a buffer."""
        times, _ = made
        idle = np.minimum(times.begun[1:], SECOND) - np.minimum(times.ready[:-1], SECOND)
        return {
            "pictures shown in a second": int((times.shown[1:] <= SECOND).sum()),
            "torn refreshes": int(torn(made[1]).sum()),
            "milliseconds that the renderer waits": int(idle.sum()),
        }

    def pictures(self, settings: Settings, made: tuple[Schedule, Integers]) -> Pictures:
        """Return the first refreshes as columns of (H, F, 4), a colour a picture, and the same untorn."""
        seen = made[1][:HEIGHT, ::-1].T
        whole = np.broadcast_to(seen[-1:], seen.shape)
        return color_pictures(colors_of(seen), colors_of(whole))

    def opening(self, settings: Settings, made: tuple[Schedule, Integers]) -> Opening:
        """Return a small picture, presented so; what was ``made``, of (F, H), is not looked at."""
        shown = replace(settings, drawing_time=self._drawing, refresh_time=self._refresh)
        return Opening(screen_scene(24, 16), shown, "resolve", None)


def make_flush(assignment: Assignment) -> FlushTask:
    """Make a picture of so many rows, of 4 to 3 pixels."""
    height = int(assignment.dials["height"])
    return FlushTask(height * 4 // 3, height)


def make_presentation(assignment: Assignment) -> PresentationTask:
    """Make the model of a renderer and a screen."""
    return PresentationTask(int(assignment.dials["drawing"]), int(assignment.dials["refresh"]))


FLUSHING = StudyFamily(
    "flush",
    "Flushing",
    ("flush",),
    (
        WorkKind(
            "picture",
            "One picture, 4:3",
            "pixel",
            (
                Axis(
                    "height",
                    "Rows of the picture",
                    "pixels",
                    (12, 24, 48, 96, 192, 384, 768),
                    True,
                    default=384,
                    is_cost=True,
                ),
            ),
        ),
    ),
    (WRONG_BYTES,),
    make_flush,
)
PRESENTATION = StudyFamily(
    "presentation",
    "Presentation",
    ("presentation",),
    (
        WorkKind(
            "second",
            "One second by the model",
            "run",
            (
                Axis(
                    "drawing",
                    "Time to draw a picture",
                    "ms",
                    (4, 8, 12, 16, 20, 24, 28, 32, 40, 48),
                    default=20,
                    is_cost=True,
                ),
                Axis("refresh", "Time of a refresh", "ms", (4, 7, 8, 10, 16, 20), default=16),
            ),
        ),
    ),
    (TORN,),
    make_presentation,
    only=("single", "double-at-once", "double", "triple"),
)
