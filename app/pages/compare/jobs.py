"""What the Compare page does off the GUI thread: draws points, finds where two diverge, measures what a plan chose."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from app.background import Progress
from app.pages.compare.charts import title_of
from app.pages.experiment_page import DrawnPictures
from app.pages.page_bar import StepRequest
from app.pages.result_page import Result
from app.session.document import TEACHING_LIMIT, TRACED_TOGETHER, part_around
from core.scene import AnyScene
from core.settings import Settings
from core.study.divergence import first_divergence
from core.study.family import Candidate, settings_of
from core.study.planner.records import Plan
from core.study.record import Opening, Pictures, Point, Study
from core.study.speed_accuracy import opening, pictures
from core.trace import scene_triangle_count
from widgets.experiments.case_pictures import PicturesRecord
from widgets.grid.layers import BufferKind, GridBuffer, number_text
from widgets.grid.linked_grids import Pixel


def measured(
    measure: Callable[..., Study],
    scene: AnyScene | None,
    progress: Progress,
    is_cancelled: Callable[[], bool],
    point_done: Callable[[Point], None],
) -> Result[Study]:
    """Measure on a scene, or on work that the family makes itself; points come as they are measured."""
    return Result(measure(progress=progress, is_cancelled=is_cancelled, point_done=point_done), scene)


def drawn_points(result: Result[Study], points: tuple[Point, ...]) -> DrawnPictures:
    """Return what one method drew beside the reference, or what two drew, A and B, and where they differ."""
    study, scene = result.content, result.scene
    titles = [title_of(point, [each.method for each in study.points]) for point in points]
    drawn = [pictures(study, point, scene) for point in points]
    openings = [opening(study, point, scene) for point in points]
    request = partial(_request, titles[-1], openings[-1], drawn[-1])
    can_step = openings[-1] is not None
    if len(points) == 1:
        only, heads = drawn[0], (titles[0], "Reference", "Difference")
        shown, names = (only.result, only.reference), ("picture", "reference")
        return DrawnPictures(_record(titles[0], heads, names, shown, only.difference, can_step), request)
    shown = drawn[0].result, drawn[1].result
    if shown[0].shape != shown[1].shape:
        raise ValueError("two methods of one study must draw pictures of one size")
    heads = f"A: {titles[0]}", f"B: {titles[1]}", "Difference, B − A"
    record = _record("A and B", heads, ("A", "B"), shown, difference_of(*shown), can_step)
    both = " and ".join(point.title for point in points)
    record = replace(record, can_diverge=None not in openings)
    return DrawnPictures(record, request, partial(divergence_of, both, drawn, openings))


def _request(title: str, opened: Opening | None, drawn: Pictures, pin: Pixel | None) -> StepRequest | str:
    """Return what opens a run at the pinned pixel, where the pixels of the picture are those of the scene."""
    if opened is None:
        return f"{title} cannot be stepped: it is not a stage of the pipeline."
    width, height = opened.scene.size
    is_of_scene = drawn.result.shape[:2] == (height, width)
    return StepRequest(opened if pin is None or not is_of_scene else replace(opened, pixel=pin), title)


def _record(
    title: str,
    heads: tuple[str, str, str],
    names: tuple[str, str],
    shown: tuple[NDArray[np.float32], NDArray[np.float32]],
    difference: NDArray[np.float32],
    can_step: bool,
) -> PicturesRecord:
    """Return two pictures in one range of values, and how much they differ."""
    scale = _scale(*shown)
    first, second = (_buffer(name, values, scale) for name, values in zip(names, shown, strict=True))
    buffers = first, second, GridBuffer("difference", difference, "signed")
    return PicturesRecord(f"{title}: {_amount(difference)}", buffers, heads, can_step)


def difference_of(first: NDArray[np.float32], second: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (H, W) second minus first, of (H, W, C) colours the channel that differs most."""
    amount = second - first
    if amount.ndim == 2:
        return amount
    largest = np.abs(amount).argmax(axis=2)
    return np.take_along_axis(amount, largest[..., None], axis=2)[..., 0]


def _buffer(name: str, values: NDArray[np.float32], scale: tuple[float, float] | None) -> GridBuffer:
    kind: BufferKind = "color" if values.ndim == 3 else "scalar"
    return GridBuffer(name, values, kind, range=None if kind == "color" else scale)


def _scale(first: NDArray[np.float32], second: NDArray[np.float32]) -> tuple[float, float] | None:
    """Return one range for two pictures, so that equal values look alike."""
    finite = np.concatenate([values[np.isfinite(values)] for values in (first, second)])
    return (float(finite.min()), float(finite.max())) if len(finite) else None


def _amount(difference: NDArray[np.float32]) -> str:
    """Return in words how much of a picture differs."""
    differs = difference != 0
    count = int(np.count_nonzero(differs))
    if not count:
        return f"none of {differs.size:,} pixels differs."
    largest = number_text(float(np.nanmax(np.abs(difference))))
    return f"{count:,} of {differs.size:,} pixels differ; largest difference {largest}."


def divergence_of(names: str, drawn: list[Pictures], openings: list[Opening | None]) -> StepRequest | str:
    """Return what opens where two points part ways, or a sentence: they do not.

    A picture that is too large to be traced as a whole is traced around one pixel: the first that differs, or else
    those at which the two runs are wrong first (what opens may be a part of the work, as one line of many).
    """
    first, second = openings
    if first is None or second is None:
        return "These methods cannot be stepped."
    differing = first_difference(*drawn)
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
