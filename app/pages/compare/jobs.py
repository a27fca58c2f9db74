"""Runs studies off the GUI thread: measures, draws the pictures of points, finds where two of them diverge."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, Slot

from app import __version__
from app.background.turns import turns
from app.background.workers import JobGroup, Progress
from app.pages.page_bar import StepRequest
from app.session.document import TEACHING_LIMIT, TRACED_TOGETHER
from app.session.opening_document import part_around
from core.scene import AnyScene
from core.settings import Settings
from core.study import Opening, Pictures, Plan, Point, Study, machine, measure, opening, pictures
from core.study.accuracy.divergence import first_divergence
from core.study.accuracy.family import Candidate, settings_of
from core.trace import scene_triangle_count


@dataclass(frozen=True, eq=False)
class StudyOrder:
    """What is to be measured."""

    family: str
    work: str
    dials: dict[str, float]
    rounds: int
    seed: int
    scene: AnyScene | None = None
    """For the family that takes a scene, with ``settings`` and ``scene_title``."""
    settings: Settings | None = None
    scene_title: str = ""
    extra: tuple[Candidate, ...] = ()
    """Settings that are measured along with the family's own."""
    grow: bool = True
    """Whether to measure how cost grows with the size of the work too."""


@dataclass(frozen=True, eq=False)
class StudyResult:
    """A study, and what it takes to run one of its methods once more."""

    study: Study
    scene: AnyScene | None = None
    """What was measured on, where the family takes a scene."""
    path: str = ""
    """The file it was opened from; empty: it was measured here."""
    is_kept: bool = False
    """Whether it is of an earlier start of the window."""
    is_example: bool = False
    """Whether it came with the program."""

    @property
    def name(self) -> str:
        """Family of the study."""
        return self.study.family

    @property
    def machine(self) -> Mapping[str, str]:
        """Where it was measured."""
        return self.study.machine

    @property
    def can_run_again(self) -> bool:
        """Whether the work is still there: a saved study keeps the name of its scene only."""
        return not self.study.scene or self.scene is not None


@dataclass(frozen=True, eq=False)
class PointsShown:
    """The pictures of one chosen point, or of two."""

    points: tuple[Point, ...]
    pictures: tuple[Pictures, ...]
    openings: tuple[Opening | None, ...]


class StudyJobs(JobGroup):
    """At most one measurement, one drawing of pictures and one search at a time."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.measuring = self.add_job()
        """Gives every ``Point`` as it is measured anew, and in the end a `StudyResult`."""
        self.drawing = self.add_job()
        """Gives a `PointsShown`."""
        self.searching = self.add_job()
        """Gives a ``StepRequest``, or a text: they never part ways."""

    def measure(self, order: StudyOrder) -> None:
        """Measure; points come as they are measured."""

        def work(
            progress: Progress, is_cancelled: Callable[[], bool], point_done: Callable[[Point], None]
        ) -> StudyResult:
            with turns.take("Compare", progress, is_cancelled):
                study = measure(
                    order.family,
                    order.work,
                    order.dials,
                    scene=order.scene,
                    settings=order.settings,
                    scene_title=order.scene_title,
                    extra=order.extra,
                    rounds=order.rounds,
                    grow=order.grow,
                    seed=order.seed,
                    machine=machine(__version__),
                    progress=progress,
                    is_cancelled=is_cancelled,
                    point_done=point_done,
                )
            return StudyResult(study, order.scene)

        self.measuring.start_in_parts(work)

    def draw(self, result: StudyResult, points: tuple[Point, ...]) -> None:
        """Draw the pictures of one or two points."""

        def work() -> PointsShown:
            study, scene = result.study, result.scene
            drawn = tuple(pictures(study, point, scene) for point in points)
            return PointsShown(points, drawn, tuple(opening(study, point, scene) for point in points))

        self.drawing.call(work)

    @Slot()
    def stop_drawing(self) -> None:
        """Wait for no picture any more."""
        self.drawing.cancel()
        self.searching.cancel()

    def find_divergence(self, shown: PointsShown) -> None:
        """Find the first place at which two points part ways."""
        self.searching.call(partial(divergence_of, shown))


def divergence_of(shown: PointsShown) -> StepRequest | str:
    """Return what opens where two points part ways, or a sentence: they do not.

    A picture that is too large to be traced as a whole is traced around one pixel: the first that differs, or else
    those at which the two runs are wrong first (what opens may be a part of the work, as one line of many).
    """
    first, second = shown.openings
    if first is None or second is None:
        return "These methods cannot be stepped."
    names = " and ".join(point.title for point in shown.points)
    differing = first_difference(shown.pictures[0], shown.pictures[1])
    for scene, pixel in ((first.scene, differing), (first.scene, first.pixel), (second.scene, second.pixel)):
        region = _region(scene.size, pixel)
        if region is None and _is_too_large(scene.size):
            continue
        found = first_divergence(scene, first.settings, second.settings, region=region)
        if found is not None:
            there = Opening(scene, first.settings, found.stage, found.pixel or pixel)
            is_many = scene_triangle_count(scene) > TRACED_TOGETHER and found.triangle >= 0
            triangle = found.triangle if is_many else None
            return StepRequest(there, f"{names}, first divergence", second.settings, triangle)
    return f"{names} do not diverge on this work: all compared steps have the same numbers."


def _is_too_large(size: tuple[int, int]) -> bool:
    """Return whether a picture cannot be traced as a whole."""
    return size[0] > TEACHING_LIMIT[0] or size[1] > TEACHING_LIMIT[1]


def _region(size: tuple[int, int], pixel: tuple[int, int] | None) -> tuple[int, int, int, int] | None:
    """Return the part of a large picture around a pixel; ``None``: all of it."""
    if pixel is None or not _is_too_large(size):
        return None
    raster = part_around(size, pixel)
    assert raster.origin is not None
    return (*raster.origin, raster.columns, raster.rows)


def first_difference(first: Pictures, second: Pictures) -> tuple[int, int] | None:
    """Return column and row of the lowest pixel, of those the leftmost, that differs; ``None``: there is none."""
    differs = ~((first.result == second.result) | (np.isnan(first.result) & np.isnan(second.result)))
    if differs.ndim == 3:
        differs = differs.any(axis=2)
    places = np.argwhere(differs)
    return (int(places[0][1]), int(places[0][0])) if len(places) else None


CHOICE, EVERYTHING = "What the scene needs", "Reference settings"


def plan_candidates(plan: Plan, base: Settings, others: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
    """Return a plan's settings and the reference settings as points of a study, unless ``others`` has them already.

    The other points change ``base`` in one setting, or not at all: once a plan is applied it is the scene as it is.
    """
    taken = {other.method for other in others}
    found = []
    for settings, title in ((plan.settings, CHOICE), (plan.everything, EVERYTHING)):
        method = _method(settings, base)
        if method not in taken:
            taken.add(method)
            found.append(Candidate(method, title))
    return tuple(found)


def _method(settings: Settings, base: Settings) -> str:
    """Return settings as the method of a point: what differs from ``base``, or one setting as it is."""
    changed = [name for name in vars(settings) if getattr(settings, name) != getattr(base, name)]
    return " ".join(f"{name}={getattr(settings, name)}" for name in changed or ["fill"])


def chosen_points(study: Study, plan: Plan | None) -> tuple[str, ...]:
    """Return the methods of a study that draw with exactly the planned settings."""
    if plan is None:
        return ()
    return tuple(
        point.method
        for point in study.points
        if point.is_measured and settings_of(study.settings, point.method) == plan.settings
    )
