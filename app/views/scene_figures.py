"""The sizes that the 3D view draws at, and what drawing one frame took, as numbers and as a line of text."""

from collections.abc import Mapping
from dataclasses import dataclass

from core.fast_path import Route
from core.fast_path.record import Coloring, Visibility
from core.fast_path.workers import Sharing
from core.records.frame import StageCount
from core.records.nouns import TRIANGLES, Nouns
from core.records.words import counted
from core.stages.declared import stage_of
from widgets.space.frame_corner import SizeChoice

VISIBILITIES: dict[Visibility, str] = {
    "layer": "no depth, since no pixel belongs to two triangles",
    "packed-depth": "depth and triangle number packed in one word; the smallest is visible",
    "stacks": "every fragment in drawing order, blended",
    "frame": "through all buffers",
    "supersampled": "a picture of all samples, drawn like any other, then averaged",
    "multisampled": "one word for each of four samples, averaged where they differ",
}
COLORS: dict[Coloring, str] = {
    "palette": "one for each triangle",
    "corners": "corner colours interpolated as bytes, or as linear light where they differ much",
    "lit": "light once per visible pixel, in single precision",
    "texture": "packed texels",
    "deferred": "attributes and light once per visible pixel",
}
"""Ways of ``core.fast_path.Route``, in words."""


MOST_STAGES = 4
"""Stages whose time is shown."""


@dataclass(frozen=True, eq=False)
class FrameFigures:
    """What drawing one frame took."""

    size: tuple[int, int]
    """Width and height in pixels."""
    triangle_count: int
    """T, what went into the pipeline."""
    seconds: float
    """From the camera to the last pixel; more than the stages together: there are lines, and calls in between."""
    stages: dict[str, StageCount]
    """Of every name of ``core.STAGES``; seconds are those of this process."""
    route: Route
    sharing: Sharing
    are_backs_hidden: bool
    """Back faces were left out: none can be seen."""


def figures_text(figures: FrameFigures, per_second: float | None, drawn: Nouns = TRIANGLES) -> str:
    """Return the figures as one line; a rate that is not known is left out."""
    parts = [] if per_second is None else [f"{per_second:.{0 if per_second >= 9.95 else 1}f} frames/s"]
    milliseconds = figures.seconds * 1000
    parts.append(f"{milliseconds:,.{0 if milliseconds >= 99.95 else 1}f} ms")
    parts.append(f"{figures.size[0]} × {figures.size[1]}")
    parts.append(counted(figures.triangle_count, drawn.one, drawn.many))
    return " · ".join(parts)


def drawing_text(figures: FrameFigures) -> str:
    """Return by how many processes and in what way a frame was drawn: a few lines."""
    backs = ["Back faces are left out: the meshes are closed and seen from outside."]
    lines = [*_sharing_lines(figures.sharing), *_route_lines(figures.route), *_stage_lines(figures.stages)]
    return "\n".join(lines + backs if figures.are_backs_hidden else lines)


def _sharing_lines(sharing: Sharing) -> list[str]:
    if not sharing.bands:
        return [f"Drawn by one process: {sharing.reason.splitlines()[-1]}."]
    bands = (
        f"rows {band.first:,} to {band.end - 1:,} in {band.seconds * 1000:,.1f} ms" for band in sharing.bands
    )
    return [f"Drawn by {sharing.process_count} processes: {', '.join(bands)}."]


def _stage_lines(stages: Mapping[str, StageCount]) -> list[str]:
    """Return where the time went: the stages that took most of it."""
    longest = sorted(stages, key=lambda stage: -stages[stage].seconds)[:MOST_STAGES]
    times = [f"{stage_of(stage).short_title} {stages[stage].seconds * 1000:.1f} ms" for stage in longest]
    return [f"Longest stages: {', '.join(times)}."] if times else []


def _route_lines(route: Route) -> list[str]:
    lines = [f"Seen: {VISIBILITIES[route.visibility]}.", f"Colours: {COLORS[route.color]}."]
    if route.split is not None:
        split = route.split
        lines += [
            f"Triangles: {split.lanes:,} along spans, {split.big:,} in bands, {split.one_by_one:,} one by one.",
            f"Fragments: {split.fragments:,} for {route.visible:,} pixels, "
            f"depth complexity {route.depth_complexity:.2f}.",
        ]
    return lines


OWN_SIZE = "view"
SCENE_SIZE = "scene"
FIXED_SIZES = ((512, 512), (1024, 1024), (1280, 720), (1920, 1080))


def size_choices(scene_size: tuple[int, int]) -> tuple[SizeChoice, ...]:
    """Return what can be chosen for a scene whose picture is (width, height)."""
    return (
        SizeChoice(OWN_SIZE, "Draw at the size of the view"),
        SizeChoice(SCENE_SIZE, f"Size of the scene: {scene_size[0]} × {scene_size[1]}"),
        *(SizeChoice(f"{width}x{height}", f"{width} × {height}") for width, height in FIXED_SIZES),
    )


def fixed_size(name: str, scene_size: tuple[int, int]) -> tuple[int, int] | None:
    """Return width and height that a choice stands for, None: those of the view.

    Raises ValueError if there is no such choice.
    """
    named = {f"{width}x{height}": (width, height) for width, height in FIXED_SIZES}
    named[SCENE_SIZE] = scene_size
    if name != OWN_SIZE and name not in named:
        raise ValueError(f"size must be one of {', '.join((OWN_SIZE, *named))}, got {name}")
    return named.get(name)
