"""Study of the whole pipeline on one scene, where each point changes one setting; and of families without a study.

What is timed is `draw_picture`, the bytes that a screen shows; what it drew is compared with the full buffers of
`render`: for the whole pipeline with the first method of every family, except for those that choose what is to be seen.
"""

from collections.abc import Callable
from copy import copy
from dataclasses import replace
from functools import partial
from math import ceil

import numpy as np

from core.antialiasing.measured import can_be_sampled, sampled_rows, spread_rows
from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Picture
from core.framebuffer.display import encode_linear
from core.methods import table
from core.pipeline import render
from core.records.arrays import Floats, cached_property
from core.records.frame import Frame
from core.scene import AnyScene, DirectionalLight, Mesh, Scene
from core.settings import FAMILIES, Settings, families, no_effect
from core.study.family import Assignment, Candidate, StudyFamily, settings_of
from core.study.frame_task import (
    LARGEST_COLOR,
    MEAN_COLOR,
    ONE_BYTE,
    WRONG_VISIBLE,
    FrameTask,
    check_pixel_tests,
    color_pictures,
    frame_counts,
    judge_colors,
    per_million,
    premultiplied,
)
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind
from core.study.workloads import checkerboard, sphere_mesh, sphere_scene

SAMPLED_COLOR = ErrorMeasure("sampled-color", "Mean difference from 256 samples in a pixel", "1/255")
MEASURES = (MEAN_COLOR, LARGEST_COLOR, WRONG_VISIBLE, SAMPLED_COLOR)

SCALES = Axis("scale", "Scale of the picture", "", (0.125, 0.25, 0.5, 1, 2), default=1, is_cost=True)


class PictureTask(FrameTask):
    """A scene that is drawn with many settings.

    Parameters
    ----------
    reference_settings : Settings
        Of the picture that the others are compared with.
    """

    stage = "resolve"

    def __init__(self, scene: AnyScene, reference_settings: Settings) -> None:
        super().__init__(scene, 1)
        self.reference_settings = reference_settings
        self._last: tuple[Settings, Frame] | None = None

    def start(self, settings: Settings) -> Callable[[], Picture]:
        """Prepare one picture of a scene that is new to the pipeline."""
        check_pixel_tests(self.scene, settings)
        return partial(draw_picture, copy(self.scene), self.with_dials(settings), encoding="linear")

    @cached_property
    def reference(self) -> Frame:
        """All buffers with the reference's settings."""
        return render(self.scene, self.reference_settings)

    @cached_property
    def _reference_color(self) -> Floats:
        """(H, W, 4) float64, bytes over 255 as a picture has them."""
        color = self.reference.color
        return encode_linear(color).astype(np.float64) / 255

    @cached_property
    def _samples(self) -> tuple[np.ndarray, Floats]:
        rows = spread_rows(self.scene.size[1])
        return rows, sampled_rows(self.scene, self.reference_settings, rows)

    def counts(self, settings: Settings, made: Picture) -> dict[str, int]:
        """Return the counts of all buffers, drawn with these settings."""
        return frame_counts(self._frame(settings)) | {"bytes": made.pixels.nbytes}

    def _frame(self, settings: Settings) -> Frame:
        """Return all buffers with these settings; those of the last settings are kept."""
        if self._last is None or self._last[0] != settings:
            self._last = (settings, render(self.scene, settings))
        return self._last[1]

    def judge(self, settings: Settings, made: Picture) -> Judgement:
        """Compare the bytes with the reference's, the triangles seen, and the colours with 256 samples."""
        wrong = int(np.count_nonzero(self._frame(settings).primitive != self.reference.primitive))
        found = judge_colors(_color(made)[..., :3], self._reference_color[..., :3], ONE_BYTE, of_mean=True)
        others = {
            WRONG_VISIBLE.name: per_million(wrong, self.reference.primitive.size),
            SAMPLED_COLOR.name: self._sampled_error(settings, made),
        }
        return replace(found, errors={**found.errors, **others})

    def _sampled_error(self, settings: Settings, made: Picture) -> float | str:
        if table.get("polygon_mode", self.reference_settings.polygon_mode).function():
            return "Outlines are one pixel wide at every size: there is no picture of them with 256 samples."
        if not can_be_sampled(self.scene.size):
            return "The picture is too large to be drawn at 16 times its size."
        rows, samples = self._samples
        difference = np.abs(premultiplied(_color(made)[rows], settings) - samples)[..., :3].max(axis=2)
        return 255 * float(difference.mean())

    def pictures(self, settings: Settings, made: Picture) -> Pictures:
        """Return the bytes over 255."""
        return color_pictures(_color(made), self._reference_color)


def _color(made: Picture) -> Floats:
    """Return the linear colours (H, W, 4) of a picture of linear bytes."""
    return made.pixels.astype(np.float64) / 255


def scaled(scene: AnyScene, scale: float) -> AnyScene:
    """Return the scene with a picture of another size."""
    width, height = (max(ceil(side * scale), 1) for side in scene.size)
    return replace(scene, size=(width, height))


def make_pipeline(assignment: Assignment) -> PictureTask:
    """Make the picture of the scene that is given, or of a textured sphere."""
    scene = standard_scene() if assignment.scene is None else assignment.scene
    return PictureTask(scaled(scene, assignment.dials["scale"]), same_look(assignment.settings))


def same_look(base: Settings) -> Settings:
    """Return the first method of every family, but for those that choose what is to be seen."""
    return Settings(**{name: getattr(base, name) for name, family in FAMILIES.items() if family.is_look})


class _Pipeline(StudyFamily):
    """The family whose points change one setting of any family."""

    def candidates(self, base: Settings) -> tuple[Candidate, ...]:
        """Return the settings as they are, then every change of one of them."""
        found = [Candidate(f"fill={base.fill}", "Unchanged")]
        for family in families():
            for name in table.names(family):
                if name != getattr(base, family) and not no_effect(base, family):
                    found.append(Candidate(f"{family}={name}", table.get(family, name).title))
        return tuple(found)


PICTURE = WorkKind("scene", "Current view", "frame", (SCALES,))
PIPELINE = _Pipeline("pipeline", "Whole pipeline", (), (PICTURE,), MEASURES, make_pipeline, takes_scene=True)


def standard_scene(side: int = 128) -> Scene:
    """Return a textured sphere in front of a larger one, lit."""
    scene = sphere_scene(24, side)
    front = sphere_mesh(12, 0.5)
    uvs = np.stack([front.positions[:, 0] * 2 + 0.5, front.positions[:, 1] * 2 + 0.5], axis=1)
    move = np.eye(4)
    move[:3, 3] = 0.55, 0.35, 0.8
    small = Mesh(
        front.positions,
        front.triangles,
        front.normals,
        uvs,
        texture=checkerboard(64, 0),
        transform=move,
        name="front",
    )
    light = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    return Scene((*scene.meshes, small), scene.camera, light, (side, side))


class ChoiceTask(PictureTask):
    """A scene that is drawn with one setting varied.

    Notes
    -----
    Of a family that chooses what is to be seen no method is wrong: the picture is compared with all buffers of that
    same choice. In other families the first method is the reference.
    """

    def __init__(self, scene: AnyScene, family: str, base: Settings) -> None:
        super().__init__(scene, base)
        self._family = family
        self._judges: dict[Settings, PictureTask] = {}

    def _judge(self, settings: Settings) -> PictureTask:
        name = self._family
        first = f"{name}={table.names(name)[0]}"
        kept = settings if FAMILIES[name].is_look else settings_of(settings, first)
        return self._judges.setdefault(kept, PictureTask(self.scene, kept))

    def judge(self, settings: Settings, made: Picture) -> Judgement:
        """Compare with the reference of these settings."""
        return self._judge(settings).judge(settings, made)

    def pictures(self, settings: Settings, made: Picture) -> Pictures:
        """Return the bytes over 255, and those of the reference of these settings."""
        return self._judge(settings).pictures(settings, made)


SHOWS_IN = {"provoking": Settings(interpolation="flat"), "resolve_filter": Settings(antialiasing="ssaa-4")}
"""Settings that a family's choice shows in, where the defaults hide it."""


def standing_in(family: str) -> StudyFamily:
    """Return the study of a family of settings that has none of its own: a standard scene with that setting varied."""

    def make(assignment: Assignment) -> ChoiceTask:
        scene = scaled(standard_scene(), assignment.dials["scale"])
        return ChoiceTask(scene, family, assignment.settings)

    base = SHOWS_IN.get(family, Settings())
    return StudyFamily(family, FAMILIES[family].title, (family,), (PICTURE,), MEASURES, make, base)
