"""A faulty twin: a run with an edited line, another function, a changed input or output; or a wrong formula."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from core import Settings, clip_lines, draw_lines, render
from core.coverage.snapping import window_position
from core.edits.edit import Edit, apply_edit, original
from core.records.arrays import Floats
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from core.settings import DEFAULTS

Wrong = TypeVar("Wrong", bound=Callable[..., Any])
Reading = Callable[[ClipScene, Settings], object]
"""What is compared of a run that draws no frame; two readings are the same run where they compare equal."""


def same_settings(settings: Settings) -> Settings:
    """Return the settings themselves: the mistake is not in them."""
    return settings


def same_scene(scene: ClipScene) -> ClipScene:
    """Return the scene itself: the mistake is not in it."""
    return scene


Change = tuple[str, str]
"""What a listing has once, and what stands there instead."""


def edited(part: str, of: str, *changes: Change) -> Callable[[Settings], Settings]:
    """Return what runs an edited listing of a method: the mistake is a line of it.

    Settings that would pass the edit over are returned unchanged.
    """

    def change_settings(settings: Settings) -> Settings:
        text = original(part, of).source
        for old, new in changes:
            if text.count(old) != 1:
                raise ValueError(f"the listing of {of} must have {old!r} once, got {text.count(old)}")
            text = text.replace(old, new)
        edit = Edit(part, of, text)
        return settings if edit.passed_over(settings, None) else apply_edit(settings, edit)

    return change_settings


def _same_frame(frame: Frame, scene: AnyScene) -> Frame:
    return frame


@dataclass(frozen=True)
class Case:
    """A scene in which a mistake shows, or hides."""

    scene: ClipScene
    settings: Settings = DEFAULTS
    reading: Reading | None = None
    """What is compared; ``None``: all buffers of the frame."""


@dataclass(frozen=True)
class Twin:
    """One mistake."""

    name: str
    """The spelling of files, as ``corner-for-center``."""
    sentence: str
    """What was done, and what is right, in a sentence or two that a learner reads."""
    shows: Case
    hides: Case
    change_settings: Callable[[Settings], Settings] = same_settings
    """Chooses another method, or replaces its function."""
    change_scene: Callable[[ClipScene], ClipScene] = same_scene
    change_frame: Callable[[Frame, ClipScene], Frame] = _same_frame
    """Changes what was drawn, of the scene as it was given: this can be shown, not stepped."""
    other_scenes: tuple[Callable[[ClipScene], ClipScene], ...] = ()
    """Other ways to make the same mistake, which a picture is compared with, too."""
    change_picture: Callable[[Frame, AnyScene], Frame] | None = None
    """What makes it in the picture of any scene, also of a mesh; ``None``: it needs the corners of a scene."""

    @property
    def is_run(self) -> bool:
        """Whether it is a run that can be stepped; else only its picture can be shown."""
        return self.change_frame is _same_frame

    @property
    def takes_any_scene(self) -> bool:
        """Whether it changes settings only: a mesh has no corners in the window that could be changed."""
        return self.change_scene is same_scene and self.change_frame is _same_frame

    def draw(self, scene: ClipScene, settings: Settings) -> Frame:
        """Draw a scene with this mistake."""
        return self.change_frame(render(self.change_scene(scene), self.change_settings(settings)), scene)

    def read(self, case: Case) -> object:
        """Return what this mistake makes of a case."""
        if case.reading is None:
            return frame_bytes(self.draw(case.scene, case.settings))
        return case.reading(self.change_scene(case.scene), self.change_settings(case.settings))


@dataclass(frozen=True)
class WrongRule:
    """A mistake in a formula that is worked out by hand: it has numbers, and no run that can be shown."""

    name: str
    """The spelling of files, as ``factors-reversed``."""
    sentence: str
    """What was done, and what is right, in a sentence or two that a learner reads."""
    right: Callable[..., Any]
    wrong: Callable[..., Any]
    """Takes what ``right`` takes, and gives what it gives."""
    shows: tuple[Any, ...]
    """Arguments for which the two differ."""
    hides: tuple[Any, ...]
    """Arguments for which they are the same."""


ENTERED: dict[str, list[WrongRule]] = {}
"""Wrong formulas by the module that they stand in, in its order."""


def wrong_rule(
    right: Callable[..., Any], shows: tuple[Any, ...], hides: tuple[Any, ...], twin: Twin | None = None
) -> Callable[[Wrong], Wrong]:
    """Enter the function below as a wrong formula: its name is the mistake's name, its docstring the sentence.

    Parameters
    ----------
    right, shows, hides
        See `WrongRule`.
    twin : Twin, optional
        A run that makes the same mistake: its name and its sentence are taken.
    """

    def enter(wrong: Wrong) -> Wrong:
        name, sentence = wrong.__name__.replace("_", "-"), " ".join((wrong.__doc__ or "").split())
        if twin is not None:
            name, sentence = twin.name, twin.sentence
        rule = WrongRule(name, sentence, right, wrong, shows, hides)
        ENTERED.setdefault(wrong.__module__, []).append(rule)
        return wrong

    return enter


def right_reading(case: Case) -> object:
    """Return what a case gives without a mistake."""
    if case.reading is None:
        return frame_bytes(render(case.scene, case.settings))
    return case.reading(case.scene, case.settings)


def frame_bytes(frame: Frame) -> tuple[bytes, ...]:
    """Return the bytes of all buffers of a frame."""
    buffers = (frame.color, frame.depth, frame.primitive, frame.attributes, frame.cover_count)
    return tuple(buffer.tobytes() for buffer in buffers)


def frame_colors(scene: ClipScene, settings: Settings) -> bytes:
    """Return the bytes of the colours alone, where other buffers always differ."""
    return render(scene, settings).color.tobytes()


def in_window(scene: ClipScene) -> Floats:
    """Return the corners of a scene in pixels, (T, 3, 2), or the ends of its segments, (L, 2, 2)."""
    return np.asarray(window_position(scene.clip, scene.size))


def line_pixels(scene: ClipScene, settings: Settings) -> frozenset[tuple[int, int]]:
    """Return the pixels of the segments of a scene."""
    pixels = draw_lines(in_window(scene), *scene.size, settings.line).pixels
    return frozenset((column, row) for column, row in pixels.tolist())


def clipped_ends(scene: ClipScene, settings: Settings) -> list[list[list[float]]]:
    """Return what is left of the segments of a scene in its window."""
    clipped = clip_lines(in_window(scene), (0, 0, *scene.size), settings.line_clipping)
    left: list[list[list[float]]] = clipped.segments[clipped.is_kept].tolist()
    return left
