"""The shrinker: a failing scene is made as small as it can be and still fail, in triangles, pixels and digits.

Delta debugging: leave something out, or make it simpler; keep what still fails in the same way. First triangles go,
half of them at a time, then single ones; then the picture is halved; then every coordinate gets as few digits as it
can. Corners that lie in the same place stay together, so that shared edges stay shared. The same scene always shrinks
alike.

References
----------
A. Zeller, R. Hildebrandt, *Simplifying and isolating failure-inducing input*, 2002.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np

from core.arrays import Floats, Integers
from core.scene import ClipScene
from core.settings import Settings
from core.study.stability.case_text import case_text
from core.study.stability.experiment import Experiment, Verdict, experiments
from core.study.stability.record import Outcome
from core.study.stability.stress import StressCancelledError

MOST_RUNS = 3000
"""Runs after which shrinking stops with what it has."""
DIGITS = 17
"""Significant digits of a float64."""


@runtime_checkable
class Shrinkable(Protocol):
    """An experiment whose cells are triangles in clip space that can be run by themselves."""

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[ClipScene, Settings]:
        """Return the scene of one cell and its settings."""

    def judge(self, scene: ClipScene, settings: Settings) -> Verdict:
        """Run any such scene."""

    def test_body(self, scene: ClipScene, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""

    def wrong_pixel(self, scene: ClipScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong, if it is about pixels."""


@runtime_checkable
class Bound(Protocol):
    """An experiment whose truth belongs to its own scenes."""

    bound_to: str
    """What it belongs to, in words."""


def why_not_shrinkable(experiment: Experiment) -> str:
    """Return in a sentence why cells of an experiment that is not `Shrinkable` stay as large as they are."""
    name = experiment.info.name
    if isinstance(experiment, Bound) and experiment.bound_to:
        return f"cells of {name} cannot be made smaller: what is right belongs to {experiment.bound_to}"
    return f"cells of {name} are no triangles that can be made smaller"


@dataclass(frozen=True, eq=False)
class Shrunk:
    """What is left of a failing scene."""

    scene: ClipScene
    settings: Settings
    verdict: Verdict
    sentence: str
    """What the method does to it."""
    pixel: tuple[int, int] | None
    """Column and row of the first pixel that is wrong; ``None``: it is about no pixel."""
    run_count: int
    """Runs that it took."""
    test: str
    """The text of a Python file with one test, which fails as long as the method does."""


def shrink_cell(
    experiment: str | Experiment,
    method: str,
    place: tuple[float, ...],
    seed: int = 0,
    *,
    most_runs: int = MOST_RUNS,
    is_cancelled: Callable[[], bool] | None = None,
) -> Shrunk:
    """Make the scene of one failing cell as small as it can be and still fail in the same way.

    Parameters
    ----------
    experiment : str or Experiment
        One of `core.study.stability.experiment.experiments`, or another one.
    method : str
        One of its methods.
    place : tuple of float
        A value of every axis.
    seed : int
    most_runs : int
    is_cancelled : callable, optional
        Asked before every run.

    Raises
    ------
    ValueError
        If the cell is right, or the experiment has no triangles to be made smaller.
    StressCancelledError
        As soon as ``is_cancelled()``.
    """
    if isinstance(experiment, str):
        experiment = experiments.get(experiment)
    name = experiment.info.name
    if method not in experiment.info.methods:
        raise ValueError(
            f"method of {name} must be one of {', '.join(experiment.info.methods)}, got {method}"
        )
    if not isinstance(experiment, Shrinkable):
        raise ValueError(why_not_shrinkable(experiment))
    scene, settings = experiment.case(method, place, seed)
    small, verdict, run_count = shrink(scene, settings, experiment.judge, most_runs, is_cancelled)
    sentence = f"{method} at {_shown_count(small)}: {verdict.remark}."
    title = "_".join([name, *(part.partition("=")[2] for part in method.split())])
    test = case_text(title, sentence, experiment.test_body(small, settings))
    pixel = experiment.wrong_pixel(small, settings)
    return Shrunk(small, settings, verdict, sentence, pixel, run_count, test)


def shrink(
    scene: ClipScene,
    settings: Settings,
    judge: Callable[[ClipScene, Settings], Verdict],
    most_runs: int = MOST_RUNS,
    is_cancelled: Callable[[], bool] | None = None,
) -> tuple[ClipScene, Verdict, int]:
    """Make a failing scene smaller.

    Returns
    -------
    scene : ClipScene
        No triangle of it can be left out, and no coordinate written with fewer digits.
    verdict : Verdict
        Of the same outcome as that of the scene given.
    run_count : int

    Raises
    ------
    ValueError
        If the scene does not fail.
    """
    search = _Search(settings, judge, most_runs, is_cancelled)
    triangles = _Triangles.of(scene)
    verdict = search.verdict(triangles)
    if verdict is None or verdict.outcome in (Outcome.RIGHT, Outcome.REFUSED):
        raise ValueError("a scene that fails is wanted, got one that is right or refused")
    search.outcome = verdict.outcome
    changed = True
    while changed and not search.is_spent():
        changed = False
        for simpler in (_with_fewer_triangles, _with_smaller_picture, _with_simpler_corners):
            triangles, has_changed = search.simplify(triangles, simpler)
            changed |= has_changed
    found = search.verdict(triangles)
    assert found is not None
    return triangles.scene(), found, search.run_count


@dataclass(frozen=True, eq=False)
class _Triangles:
    """Triangles whose common corners are one vertex."""

    vertices: Floats
    """(N, 4) float64, clip space."""
    corners: Integers
    """(T, 3) int64."""
    size: tuple[int, int]
    colors: Floats
    """(T, 3, K) float64."""
    background: Floats
    """(4,) float64, what the picture is cleared to."""

    @classmethod
    def of(cls, scene: ClipScene) -> "_Triangles":
        """Take a scene apart."""
        vertices, corners = np.unique(scene.clip.reshape(-1, 4), axis=0, return_inverse=True)
        assert scene.attributes is not None
        return cls(
            vertices, corners.reshape(-1, 3).astype(np.int64), scene.size, scene.attributes, scene.background
        )

    def scene(self) -> ClipScene:
        """Put the scene together."""
        clip = self.vertices[self.corners]
        return ClipScene(clip, self.colors, self.size, background=self.background, shared=self.corners)

    def keep(self, index: Integers) -> "_Triangles":
        """Return the triangles ``index`` (Q,) alone, with the vertices that they have."""
        used, corners = np.unique(self.corners[index], return_inverse=True)
        corners = corners.reshape(-1, 3).astype(np.int64)
        return replace(self, vertices=self.vertices[used], corners=corners, colors=self.colors[index])

    def moved(self, vertex: int, axis: int, value: float) -> "_Triangles":
        """Return the same with one coordinate changed."""
        vertices = self.vertices.copy()
        vertices[vertex, axis] = value
        return replace(self, vertices=vertices)


Simplify = Callable[[_Triangles], Iterator[_Triangles]]


@dataclass
class _Search:
    """Runs candidates, counts the runs, and stops where there are too many."""

    settings: Settings
    judge: Callable[[ClipScene, Settings], Verdict]
    most_runs: int
    is_cancelled: Callable[[], bool] | None
    outcome: Outcome | None = None
    """What a candidate has to end in."""
    run_count: int = 0

    def is_spent(self) -> bool:
        """Whether no more runs are left."""
        return self.run_count >= self.most_runs

    def verdict(self, triangles: _Triangles) -> Verdict | None:
        """Run a candidate; ``None``: it is no scene."""
        if self.is_cancelled is not None and self.is_cancelled():
            raise StressCancelledError("shrinking was cancelled")
        self.run_count += 1
        try:
            return self.judge(triangles.scene(), self.settings)
        except ValueError:
            return None

    def simplify(self, triangles: _Triangles, simpler: Simplify) -> tuple[_Triangles, bool]:
        """Take candidates that still fail, each in the place of what it was made from, until there are no more."""
        has_changed = True
        has_ever_changed = False
        while has_changed and not self.is_spent():
            has_changed = False
            for candidate in simpler(triangles):
                if self.is_spent():
                    break
                found = self.verdict(candidate)
                if found is not None and found.outcome == self.outcome:
                    triangles, has_changed, has_ever_changed = candidate, True, True
                    break
        return triangles, has_ever_changed


def _with_fewer_triangles(triangles: _Triangles) -> Iterator[_Triangles]:
    """Yield the triangles without a half, a quarter, an eighth ... of them."""
    count = len(triangles.corners)
    every = np.arange(count)
    part = count // 2
    while part:
        for start in range(0, count, part):
            left = every[(every < start) | (every >= start + part)]
            if len(left):
                yield triangles.keep(left)
        part //= 2


def _with_smaller_picture(triangles: _Triangles) -> Iterator[_Triangles]:
    """Yield the same with one half of the picture cut off, or at half the scale."""
    width, height = triangles.size
    for axis, side in enumerate(triangles.size):
        if side < 2:
            continue
        kept = side // 2
        size = (kept, height) if axis == 0 else (width, kept)
        for first in (0, side - kept):
            # The place in pixels, (x + w) side / 2, moves by ``first``.
            vertices = triangles.vertices.copy()
            w = vertices[:, 3]
            vertices[:, axis] = ((vertices[:, axis] + w) * side - 2 * first * w) / kept - w
            yield replace(triangles, vertices=vertices, size=size)
        yield replace(triangles, size=size)


def _with_simpler_corners(triangles: _Triangles) -> Iterator[_Triangles]:
    """Yield the same with one coordinate written in fewer digits, those with the most digits first."""
    counts = [(-digit_count(value), k) for k, value in enumerate(triangles.vertices.ravel().tolist())]
    for negative, place in sorted(counts):
        vertex, axis = divmod(place, 4)
        value = float(triangles.vertices[vertex, axis])
        for simpler in simpler_numbers(value, 1.0 if axis == 3 else 0.0, -negative):
            yield triangles.moved(vertex, axis, simpler)


def simpler_numbers(value: float, simplest: float, digits: int) -> Iterator[float]:
    """Yield numbers near ``value`` that are written with fewer than ``digits`` digits, the simplest first."""
    seen = {value}
    for candidate in (simplest, *(float(f"{value:.{count}g}") for count in range(1, DIGITS))):
        if candidate not in seen and (digit_count(candidate) < digits or candidate == simplest != value):
            seen.add(candidate)
            yield candidate


def digit_count(value: float) -> int:
    """Return how many characters a number takes but for its sign; 0 for 0."""
    return 0 if value == 0 else len(f"{abs(value):g}" if float(f"{value:g}") == value else repr(abs(value)))


def _shown_count(scene: ClipScene) -> str:
    count = len(scene.clip)
    return f"{count} triangle{'s' if count > 1 else ''} in {scene.size[0]}x{scene.size[1]} pixels"
