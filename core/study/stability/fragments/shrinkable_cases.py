"""Experiments on what covered pixels show: what is right is worked out anew for whatever is left of a scene.

So all of their cells can be made smaller (`core.study.stability.shrink`).
"""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.scene import AnyScene, ClipScene
from core.settings import Settings
from core.study.accuracy.family import settings_of
from core.study.accuracy.frame_task import first_pixel
from core.study.stability.case_text import settings_text
from core.study.stability.experiment import Verdict
from core.study.stability.fragments.cases import Case, CaseExperiment
from core.study.stability.minimization.kind import Kind
from core.study.stability.minimization.triangles import TRIANGLES
from core.study.stability.scene_text import scene_text


class AnyCase(Case):
    """Any scene of one kind, and what is right for it."""

    @abstractmethod
    def assertions(self, settings: Settings, wrong: Flags) -> str:
        """Return the statements of a test of ``frame``, the picture, which fail where ``wrong`` (H, W) bool is set."""


@dataclass(frozen=True, eq=False)
class ShrinkableCases(CaseExperiment):
    """Scenes that every method draws, of which triangles, pixels and digits can be left out."""

    case_of: Callable[[Any], AnyCase] = field(kw_only=True)
    """What is right for any scene of the kind; a ``ValueError`` where that is not known."""
    kind: Kind[Any] = field(default=TRIANGLES, kw_only=True)
    """What the scenes are made of."""

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[AnyScene, Settings]:
        """Return what is made smaller of the scene of one place, and how one method draws it."""
        return self.kind.as_case(self.make(place, seed).scene), settings_of(self.base, method)

    def judge(self, scene: AnyScene, settings: Settings) -> Verdict:
        """Draw any such scene, and compare with what is right for it."""
        return self.case_of(scene).judge(settings).verdict

    def test_body(self, scene: AnyScene, settings: Settings) -> str:
        """Return the statements of a test: what the wrong pixels should show."""
        case = self.case_of(scene)
        assertions = case.assertions(settings, case.judge(settings).wrong)
        return f"{scene_text(scene)}\nframe = render(scene, {settings_text(settings)})\n{assertions}"

    def wrong_pixel(self, scene: AnyScene, settings: Settings) -> tuple[int, int] | None:
        """Return the first pixel that is wrong."""
        return first_pixel(self.case_of(scene).judge(settings).wrong)


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
    return f"{listed_pixels(wrong, wanted)}\nfor column, row, wanted in pixels:\n    assert {check}"


def listed_pixels(which: Flags, wanted: Floats | Integers) -> str:
    """Return a statement that lists pixels, ``which`` (H, W) bool, with what is ``wanted``, (H, W) or (H, W, C)."""
    rows, columns = np.nonzero(which)
    values = [
        f"    ({column}, {row}, {wanted[row, column].tolist()}),"
        for column, row in zip(columns.tolist(), rows.tolist(), strict=True)
    ]
    listed = "\n".join(values)
    return f"pixels = [\n{listed}\n]"
