"""Experiments on what covered pixels show whose truth can be worked out for any triangles in clip space.

Such cells can be made smaller (`core.study.stability.shrink`): what is right is found anew for what is left.
"""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from core.arrays import Flags, Floats, Integers
from core.geometry.vertex_stage import transform_vertices
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study.family import settings_of
from core.study.frame_task import first_pixel
from core.study.stability.case_text import clip_text, settings_text
from core.study.stability.experiment import Verdict
from core.study.stability.fragments.cases import Case, CaseExperiment
from core.study.workloads import flat_scene


class AnyTriangles(Case):
    """Any triangles in clip space, and what is right for them."""

    scene: ClipScene

    @abstractmethod
    def assertions(self, settings: Settings, wrong: Flags) -> str:
        """Return the statements of a test of ``frame``, the picture, which fail where ``wrong`` (H, W) bool is set."""


@dataclass(frozen=True, eq=False)
class ShrinkableCases(CaseExperiment):
    """Scenes that every method draws, of which triangles, pixels and digits can be left out."""

    case_of: Callable[[ClipScene], AnyTriangles] = field(kw_only=True)
    """What is right for any triangles; a ``ValueError`` where that is not known."""

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[ClipScene, Settings]:
        """Return the triangles of one place in clip space, and how one method draws them."""
        return in_clip_space(self.make(place, seed).scene), settings_of(self.base, method)

    def judge(self, scene: ClipScene, settings: Settings) -> Verdict:
        """Draw any triangles, and compare with what is right for them."""
        return self.case_of(scene).judge(settings).verdict

    def test_body(self, scene: ClipScene, settings: Settings) -> str:
        """Return the statements of a test: what the wrong pixels should show."""
        case = self.case_of(scene)
        assertions = case.assertions(settings, case.judge(settings).wrong)
        return f"{scene_text(scene)}\nframe = render(scene, {settings_text(settings)})\n{assertions}"

    def wrong_pixel(self, scene: ClipScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong."""
        return first_pixel(self.case_of(scene).judge(settings).wrong)


def in_clip_space(scene: AnyScene) -> ClipScene:
    """Return the triangles of a scene after projection; one that is in clip space stays as it is."""
    if isinstance(scene, ClipScene):
        return scene
    vertices = transform_vertices(scene)
    return flat_scene(vertices.clip[vertices.corners], scene.size)


def check_in_view_volume(scene: ClipScene) -> None:
    """Refuse triangles that are cut at the near or the far plane, or reach behind the eye.

    Raises
    ------
    ValueError
        If there is one.
    """
    z, w = scene.clip[..., 2], scene.clip[..., 3]
    bad = ((w <= 0) | (np.abs(z) > w)).any(axis=1)
    if bad.any():
        raise ValueError(
            f"every corner must be between the near and the far plane, triangle {int(np.argmax(bad))} is not"
        )


def scene_text(scene: ClipScene) -> str:
    """Return statements that make ``scene``, with all that matters to a picture without a texture."""
    background = f", background=np.array({scene.background.tolist()})" if scene.background.any() else ""
    assert scene.attributes is not None
    return (
        f"clip = {clip_text(scene.clip)}\n"
        f"values = {clip_text(scene.attributes)}\n"
        f"scene = ClipScene(np.array(clip, float), np.array(values, float), {scene.size}{background})"
    )


def pixels_text(wrong: Flags, wanted: Floats | Integers, check: str) -> str:
    """Return statements that check every wrong pixel against what it should show.

    Parameters
    ----------
    wrong : (H, W) bool
    wanted : (H, W) or (H, W, C)
        What is right: whole numbers or float64.
    check : str
        What holds of ``column``, ``row`` and ``wanted``.
    """
    rows, columns = np.nonzero(wrong)
    values = [
        f"    ({column}, {row}, {wanted[row, column].tolist()}),"
        for column, row in zip(columns.tolist(), rows.tolist(), strict=True)
    ]
    listed = "\n".join(values)
    return f"pixels = [\n{listed}\n]\nfor column, row, wanted in pixels:\n    assert {check}"
