"""Layers of glass, or of light, in every order of drawing.

References
----------
T. Porter, T. Duff, *Compositing digital images*, 1984.
"""

from fractions import Fraction
from itertools import permutations

import numpy as np

from core.interpolation.measured import exact_fragments
from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import ClipScene
from core.settings import Settings
from core.study.case_text import pixels_text
from core.study.experiment import VALUED_TRIANGLES, Case, Experiment
from core.study.frame_task import judge_colors
from core.study.record import Axis, Judgement
from core.study.workloads import COLORS

SIDE = 4
"""Pixels on a side of the picture: all of them are alike."""
BACKGROUND = (0.25, 0.25, 0.25, 1.0)
TOLERANCE = 1e-3
"""1/255 of linear light: far above the rounding of float32, far below what can be seen."""
ORDERS = {2: tuple(permutations(range(2))), 3: tuple(permutations(range(3)))}
"""Every order of two and of three layers; 0 is the farthest layer, and the first order is from back to front."""


class LayersCase(Case):
    """Triangles of one colour each; right is the colour from back to front, whatever the order of drawing.

    Raises ValueError if a triangle has several colours.
    """

    scene: ClipScene
    stage = "blend"

    def __init__(self, scene: ClipScene) -> None:
        assert scene.attributes is not None
        if (scene.attributes != scene.attributes[:, :1]).any():
            raise ValueError("every triangle must have one colour, got several")
        super().__init__(scene)
        self._fragments = exact_fragments(scene.clip, scene.size)

    def wanted(self, adds: bool) -> Floats:
        """Return the colours (H, W, 3) by fractions: what the layers let through, or the sum of light.

        Notes
        -----
        NaN where two layers are as deep: neither is before the other, and nothing is right.
        """
        width, height = self.scene.size
        fragments, colors = self._fragments, np.empty((height, width, 3))
        for row, column in np.ndindex(height, width):
            here = np.flatnonzero((fragments.row == row) & (fragments.column == column))
            here = here[np.argsort(-fragments.depth[here], kind="stable")]
            is_tie = bool((np.diff(fragments.depth[here]) == 0).any())
            layers = fragments.triangle[here].tolist()
            colors[row, column] = np.nan if is_tie else self._through(tuple(layers), adds)
        return colors

    def _through(self, layers: tuple[int, ...], adds: bool) -> tuple[float, ...]:
        """Return the colour (3) of triangles from back to front before the background."""
        assert self.scene.attributes is not None
        color = [Fraction(float(value)) for value in self.scene.background[:3]]
        for layer in layers:
            *light, alpha = (Fraction(float(value)) for value in self.scene.attributes[layer, 0])
            through = Fraction(1) if adds else 1 - alpha
            color = [alpha * own + through * behind for own, behind in zip(light, color, strict=True)]
        return tuple(float(value) for value in color)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Compare the colour with that of glass, or of light where light is added."""
        shown = made.color[..., :3].astype(np.float64)
        wanted = self.wanted(settings.blend == "additive")
        return judge_colors(shown, np.where(np.isnan(wanted), shown, wanted), TOLERANCE)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that ``wrong`` pixels, (H, W) bool, have the colour of the layers from back to front."""
        check = f"255 * np.abs(frame.color[row, column, :3] - wanted).max() <= {TOLERANCE}"
        return pixels_text(wrong, self.wanted(settings.blend == "additive"), check)


def layered_glass(order: tuple[int, ...], alpha: float) -> ClipScene:
    """Return layers that fill the picture, drawn in a given order: 0 is the farthest."""
    x, y = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
    index = np.array([[0, 1, 2], [0, 2, 3]])
    layers = [np.stack([x, y, np.full(4, 0.5 - 0.4 * layer), np.ones(4)], axis=1)[index] for layer in order]
    shades = [np.broadcast_to([*COLORS[layer, :3], alpha], (2, 3, 4)) for layer in order]
    return ClipScene(
        np.concatenate(layers), np.concatenate(shades), (SIDE, SIDE), background=np.array(BACKGROUND)
    )


def glass_at(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return the layers of one place; nothing in them is random."""
    number = int(place[0])
    order = ORDERS[2][number] if number < 2 else ORDERS[3][number - 2]
    return layered_glass(order, place[1])


BLENDING = Experiment(
    "blending-order",
    "Blending by the order of drawing",
    "Layers of glass (for additive blending, of light) are drawn in every order. The first order of two and "
    "of three is from back to front. Is the picture the same?",
    (
        Axis(
            "order",
            "Order of drawing (two layers: 0 and 1, three: 2 to 7)",
            "",
            tuple(float(k) for k in range(len(ORDERS[2]) + len(ORDERS[3]))),
        ),
        Axis("alpha", "Alpha of the layers", "", (0.0, 0.125, 0.25, 0.5, 0.75, 0.875, 1.0)),
    ),
    (
        "visibility=last-drawn blend=opaque",
        "visibility=z-buffer blend=over",
        "visibility=last-drawn blend=over",
        "visibility=painters blend=over",
        "visibility=last-drawn blend=additive",
    ),
    "Over is wrong in every order except from back to front, with a z-buffer too, unless alpha is 0 or 1. "
    "Sorted, it is always right. Additive light is the same in any order. Opaque is wrong for any alpha below"
    " 1.",
    glass_at,
    LayersCase,
    kind=VALUED_TRIANGLES,
)
