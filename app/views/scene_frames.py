"""Frames of the 3D view: drawn off the GUI thread, at sizes that keep up; how often they come, what they took.

So the newest camera wins: what was asked for in between is never drawn, and no picture waits behind another.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from threading import Lock
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, QTimer, Signal, Slot

from app.background import leave, seconds_to_end
from core.fast_path.draw_context import Coloring, Route, Visibility
from core.fast_path.workers.sharing import Sharing
from core.records.frame import StageCount
from core.records.words import TRIANGLES, Nouns, counted, nouns
from core.stages.declared import stage_of
from widgets.space.frame_corner import FrameRate, SizeChoice
from widgets.space.scene_view import SceneView

if TYPE_CHECKING:
    from app.views.scene_picture import DrawnScene


# The sizes that the 3D view draws at, and what drawing one frame took, as numbers and as a line of text.


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


# Drawing off the GUI thread: one picture at a time, and of those that wait only the last.


Work = Callable[[], object]


class SceneWorker(QObject):
    """Runs the last work it was given; the signals reach the GUI thread through its event loop."""

    done = Signal(object)
    """What the work returned."""
    failed = Signal(str)
    """Why there is no result."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._lock = Lock()
        self._waiting: tuple[int, Work] | None = None
        self._is_running = False
        self._is_stopped = False
        self._number = 0
        self._told = 0
        """Number of the last work whose result was reported or dropped."""
        self._running: Future[None] | None = None
        self._executor = ThreadPoolExecutor(max_workers=1, thread_name_prefix="scene picture")
        self._relay = _Relay()
        self._relay.done.connect(self._take_result)
        self._relay.failed.connect(self._take_failure)

    def start(self, work: Work) -> None:
        """Run it as soon as what is running now is done, unless something newer comes before that.

        After `stop` nothing is run any more: a window that closes may still change its theme.
        """
        if self._is_stopped:
            return
        with self._lock:
            self._number += 1
            self._waiting = (self._number, work)
            if not self._is_running:
                self._is_running = True
                self._running = self._executor.submit(_run, self._relay, self._next)

    def forget(self) -> None:
        """Drop what waits, and what comes of what is running now."""
        with self._lock:
            self._waiting = None
            self._told = self._number

    def stop(self) -> None:
        """Drop what waits, and wait for what is running; see `app.background.ending_within`."""
        self._is_stopped = True
        self.forget()
        if self._running is not None and wait([self._running], seconds_to_end()).not_done:
            leave(self._executor)
        self._executor.shutdown(wait=False)

    @property
    def is_busy(self) -> bool:
        """Whether a result is still to come."""
        return self._told < self._number

    def _next(self) -> tuple[int, Work] | None:
        with self._lock:
            work, self._waiting = self._waiting, None
            self._is_running = work is not None
            return work

    @Slot(int, object)
    def _take_result(self, number: int, result: object) -> None:
        if number > self._told:
            self._told = number
            self.done.emit(result)

    @Slot(int, str)
    def _take_failure(self, number: int, reason: str) -> None:
        if number > self._told:
            self._told = number
            self.failed.emit(reason)


class _Relay(QObject):
    """Outlives the worker while the thread still draws."""

    done = Signal(int, object)
    failed = Signal(int, str)


def _run(relay: _Relay, take: Callable[[], tuple[int, Work] | None]) -> None:
    while (taken := take()) is not None:
        number, work = taken
        try:
            relay.done.emit(number, work())
        except Exception as problem:
            # Told to the user by whoever asked; the thread goes on with the next one.
            relay.failed.emit(number, f"the picture could not be drawn: {problem}")


# What the corner of the 3D view says of its pictures: how often they come, and what the last one took.


FIGURES_MS = 200
"""Figures change at most this often: faster, nobody could read them."""


class FrameReport(QObject):
    """Counts the pictures that are painted, and shows the figures of the newest."""

    def __init__(self, view: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._view = view
        self._timer = QTimer(self, singleShot=True, interval=FIGURES_MS)
        self._timer.timeout.connect(self._tell)
        self.begin_anew()
        # Queued: what the figures change is not to be laid out while the view is painted.
        view.picture_painted.connect(self._count, Qt.ConnectionType.QueuedConnection)

    def begin_anew(self) -> None:
        """Forget the pictures of another scene."""
        self._rate = FrameRate()
        self._has_new = False
        self._drawn: DrawnScene | None = None
        self._view.show_figures("")

    def take(self, drawn: "DrawnScene") -> None:
        """Report of this picture from now on."""
        self._drawn = drawn

    def stop(self) -> None:
        """Report no more."""
        self._timer.stop()

    @Slot(float)
    def _count(self, seconds: float) -> None:
        """Take a picture that was painted, and report its figures unless others were reported just now."""
        self._rate.add(seconds)
        self._has_new = True
        if not self._timer.isActive():
            self._tell()

    @Slot()
    def _tell(self) -> None:
        if self._has_new and self._drawn is not None:
            self._has_new = False
            self._timer.start()
            drawn = nouns(self._drawn.shot.scene.corner_count)
            self._view.show_figures(figures_text(self._drawn.figures, self._rate.per_second(), drawn))
            self._view.corner().show_details(drawing_text(self._drawn.figures))
