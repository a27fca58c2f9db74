"""Work that is a scene: methods draw it with `render`, and what they drew is compared with a reference."""

from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import fill_traits
from core.methods import table
from core.pipeline import render
from core.records.arrays import Flags, Floats, Integers, Singles, cached_property, read_only
from core.records.frame import Frame
from core.scene import AnyScene
from core.settings import Settings
from core.study.family import Task, Work
from core.study.record import ErrorMeasure, Judgement, Opening, Outcome, Pictures, Verdict, judged
from core.study.workloads import COLORS
from core.trace import scene_triangle_count

MILLION = 1_000_000
MOST_TESTS = 200_000_000
"""Pixel tests of a brute-force drawing that is measured; it takes some seconds."""

ONE_BYTE = 1.0
"""Mean colour error, in 1/255, that a map takes as right."""
WRONG_VISIBLE = ErrorMeasure("wrong-visible", "Pixels that show the wrong triangle", "per million")
MEAN_COLOR = ErrorMeasure("mean-color", "Mean colour error", "1/255")
LARGEST_COLOR = ErrorMeasure("largest-color", "Largest colour error", "1/255")


class SceneWork(Work):
    """A scene that every method draws."""

    scene: Any
    stage = "raster"
    """Where the stepper opens, a name of ``core.records.frame.STAGES``."""
    turned: Mapping[str, int] = MappingProxyType({})
    """The settings that dials of the work turn, with their numbers."""

    def __init__(self, scene: Any) -> None:
        self.scene = scene

    def start(self, settings: Settings) -> Callable[[], Any]:
        """Prepare the drawing of a scene that is new to the pipeline, so that nothing is known from the run before."""
        check_pixel_tests(self.scene, settings)
        return partial(render, copy(self.scene), self.with_dials(settings))

    def with_dials(self, settings: Settings) -> Settings:
        """Return a method's settings with the numbers of this work."""
        return replace(settings, **self.turned) if self.turned else settings  # type: ignore[arg-type]

    def wrong_pixel(self, settings: Settings, made: Any) -> tuple[int, int] | None:
        """Return column and row of the first pixel that is wrong, if it is about pixels."""
        return first_pixel(self.judge(settings, made).wrong)

    def opening(self, settings: Settings, made: Any) -> Opening | None:
        """Return the scene at the first pixel that is wrong; ``None``: there is nothing to see."""
        return Opening(self.scene, self.with_dials(settings), self.stage, self.wrong_pixel(settings, made))


class FrameTask(SceneWork, Task):
    """A scene that a study draws.

    Parameters
    ----------
    stages : tuple of str
        Only the time of these stages counts; none: the whole drawing.
    """

    def __init__(self, scene: AnyScene, unit_count: int, stages: tuple[str, ...] = ()) -> None:
        super().__init__(scene)
        self.unit_count = unit_count
        self._stages = stages

    def seconds(self, made: Frame, elapsed: float) -> float:
        """Return the time of the stages that the methods differ in."""
        if not self._stages:
            return elapsed
        return sum(made.statistics[stage].seconds for stage in self._stages)

    def counts(self, settings: Settings, made: Any) -> dict[str, int]:
        """Return triangles, pixels and bytes."""
        return frame_counts(made)

    def wrong_pixel(self, settings: Settings, made: Frame) -> tuple[int, int] | None:
        """Return column and row of the first pixel that differs from the reference, from the bottom left."""
        return first_pixel(self.pictures(settings, made).difference != 0)


class SeenTask(FrameTask):
    """A scene of which it is known what is to be seen at every pixel.

    Parameters
    ----------
    reference : callable
        Returns (H, W) int64: the number of what is to be seen, -1: nothing.
    shown : callable
        Returns the numbers (H, W) of what triangles (H, W) show; themselves by default.
    """

    def __init__(
        self,
        scene: AnyScene,
        unit_count: int,
        stage: str,
        reference: Callable[[], Integers],
        stages: tuple[str, ...] = (),
        shown: Callable[[Integers], Integers] = lambda triangles: triangles,
    ) -> None:
        super().__init__(scene, unit_count, stages)
        self.stage, self._make, self._shown = stage, reference, shown

    @cached_property
    def reference(self) -> Integers:
        """(H, W) int64, what is to be seen."""
        return self._make()

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count the pixels that show something else."""
        wrong = self._shown(made.primitive.astype(np.int64)) != self.reference
        return judge_order(np.asarray(wrong), "what should be hidden")

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return a colour for each number."""
        return color_pictures(
            colors_of(self._shown(made.primitive.astype(np.int64))), colors_of(self.reference)
        )


class ColorTask(FrameTask):
    """A scene whose colours are known.

    Parameters
    ----------
    reference : callable
        Returns colours (H, W, 4) float64 times alpha, and (H, W) bool where they count together with triangles that
        are seen; ``None``: everywhere.
    """

    def __init__(
        self,
        scene: AnyScene,
        unit_count: int,
        stage: str,
        reference: Callable[[], tuple[Floats, Flags | None]],
        stages: tuple[str, ...] = (),
    ) -> None:
        super().__init__(scene, unit_count, stages)
        self.stage, self._make = stage, reference

    @cached_property
    def reference(self) -> tuple[Floats, Flags | None]:
        """Colours (H, W, 4), and where they count."""
        return self._make()

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return the differences of the colours."""
        color, seen = self.reference
        where = None if seen is None else seen & (made.primitive >= 0)
        shown = premultiplied(made.color, settings)
        return judge_colors(shown[..., :3], color[..., :3], ONE_BYTE, where, of_mean=True)

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the colours times alpha."""
        return color_pictures(premultiplied(made.color, settings), self.reference[0])


def check_pixel_tests(scene: AnyScene, settings: Settings) -> None:
    """Refuse, with a sentence, a drawing that tests every pixel for every triangle where that would take minutes."""
    tests = scene_triangle_count(scene) * scene.size[0] * scene.size[1]
    if fill_traits(settings.fill).looks_everywhere and tests > MOST_TESTS:
        raise ValueError(
            f"brute force would test {tests:,} pixels, and at most {MOST_TESTS:,} are measured: choose fewer triangles "
            "or a smaller picture"
        )


def frame_counts(frame: Frame) -> dict[str, int]:
    """Return the counts of a frame that do not depend on the machine."""
    stages = frame.statistics
    buffers = (frame.color, frame.depth, frame.primitive, frame.attributes, frame.cover_count)
    return {
        "triangles drawn": stages["edges"].outgoing,
        "pixels tested": stages["raster"].incoming,
        "pixels covered": stages["raster"].outgoing,
        "depth tests": stages["depth"].incoming,
        "pixels shaded": stages["shade"].incoming,
        "bytes": int(sum(buffer.nbytes for buffer in buffers)),
    }


def first_pixel(flags: NDArray[np.bool_]) -> tuple[int, int] | None:
    """Return column and row of the first pixel of ``flags`` (H, W) that holds, row by row from the bottom."""
    places = np.flatnonzero(flags)
    if not len(places):
        return None
    row, column = divmod(int(places[0]), flags.shape[1])
    return column, row


def scalar_pictures(result: NDArray[Any], reference: NDArray[Any]) -> Pictures:
    """Return two (H, W) pictures of numbers with their signed difference."""
    shown, right = result.astype(np.float32), reference.astype(np.float32)
    return Pictures(read_only(shown), read_only(right), read_only(shown - right))


def color_pictures(result: NDArray[Any], reference: NDArray[Any]) -> Pictures:
    """Return two (H, W, 4) pictures of colours with the difference of the largest channel."""
    shown, right = result.astype(np.float32), reference.astype(np.float32)
    return Pictures(read_only(shown), read_only(right), read_only(np.abs(shown - right).max(axis=2)))


def premultiplied(color: Singles | Floats, settings: Settings) -> Floats:
    """Return colours (..., 4) float64 times their alpha, whatever the blend method keeps.

    Notes
    -----
    The mean of samples with alpha 1 and of a background that is transparent black is times its mean alpha already:
    times alpha once more, outlines would be too dark. Opaque pictures of translucent fragments with samples stay as
    they are, for the same reason: what their samples were is not known any more.
    """
    values = color.astype(np.float64)
    if settings.blend == "opaque" and settings.antialiasing == "none":
        values[..., :3] *= values[..., 3:]
    return values


def colors_of(triangle: Integers) -> Floats:
    """Return a colour (H, W, 4) for each triangle (H, W), nothing for -1."""
    colors = COLORS[triangle % len(COLORS)].copy()
    colors[triangle < 0] = 0
    return np.asarray(colors)


def judge_colors(
    shown: Floats, wanted: Floats, tolerance: float, where: Flags | None = None, of_mean: bool = False
) -> Judgement:
    """Compare colours, and say how far they are off, in 1/255 of linear light.

    Parameters
    ----------
    shown, wanted : (H, W, C) float64
        Linear colours.
    tolerance : float
        In 1/255: so much is taken as right.
    where : (H, W) bool, optional
        The pixels that count; all by default.
    of_mean : bool
        Whether the mean over the pixels decides, rather than the largest difference.
    """
    difference = np.abs(shown - wanted).max(axis=2)
    counts = np.ones(difference.shape, bool) if where is None else where
    counted = difference[counts]
    if not counted.size:
        reason = "No pixel is drawn both by the method and in the reference."
        return judged({MEAN_COLOR.name: reason, LARGEST_COLOR.name: reason})
    mean, largest = 255 * float(counted.mean()), 255 * float(counted.max())
    errors = {MEAN_COLOR.name: mean, LARGEST_COLOR.name: largest}
    if np.isnan(largest):
        unknown = counts & np.isnan(difference)
        remark = f"{int(unknown.sum())} pixels of {counted.size} are not a number"
        return Judgement(Verdict(Outcome.NOT_A_NUMBER, np.nan, remark), unknown, errors)
    severity = float((255 * counted).mean()) if of_mean else largest  # To the last bit as in saved maps.
    remark = f"colours are off by {mean:.3g}/255 in the mean and {largest:.3g}/255 at most"
    if severity <= tolerance:
        verdict = Verdict(Outcome.RIGHT, severity, f"{remark}: within {tolerance:g}/255")
        return Judgement(verdict, np.zeros(counts.shape, bool), errors)
    verdict = Verdict(Outcome.WRONG_PICTURE, severity, remark)
    return Judgement(verdict, counts & (255 * difference > tolerance), errors)


def judge_order(wrong: Flags, what: str) -> Judgement:
    """Say how many pixels are ``wrong``, (H, W) bool, and what they show."""
    count = int(np.count_nonzero(wrong))
    verdict = Verdict(Outcome.RIGHT, 0.0, f"all {wrong.size} pixels show what is nearest")
    if count:
        verdict = Verdict(Outcome.WRONG_ORDER, float(count), f"{count} pixels of {wrong.size} show {what}")
    return Judgement(verdict, wrong, {WRONG_VISIBLE.name: per_million(count, wrong.size)})


def per_million(wrong: int, count: int) -> float:
    """Return how many of a million are wrong."""
    return MILLION * wrong / max(count, 1)


def depth_bits(settings: Settings) -> int:
    """Return the bits that a depth is kept in: of its whole numbers, or of a float32."""
    scale = table.get("depth", settings.depth).function().scale
    return 32 if scale == 1 else int(np.ceil(np.log2(scale)))
