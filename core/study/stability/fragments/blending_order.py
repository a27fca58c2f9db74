"""Layers of glass, or of light, in every order of drawing.

References
----------
T. Porter, T. Duff, *Compositing digital images*, 1984.
"""

from fractions import Fraction
from itertools import permutations

import numpy as np

from core.scene import ClipScene
from core.settings import Settings
from core.study.stability.fragments.cases import (
    Case,
    CaseExperiment,
    Judgement,
    drawn_colors,
    judge_colors,
)
from core.study.stability.record import Axis, ExperimentInfo
from core.study.workloads import COLORS

SIDE = 4
"""Pixels on a side of the picture: all of them are alike."""
BACKGROUND = (0.25, 0.25, 0.25, 1.0)
TOLERANCE = 1e-3
"""1/255 of linear light: far above the rounding of float32, far below what can be seen."""
ORDERS = {
    2: tuple(permutations(range(2))),
    3: tuple(permutations(range(3))),
}
"""Every order of two and of three layers; 0 is the farthest layer, and the first order is from back to front."""


class LayersCase(Case):
    """Layers that fill the picture, drawn in a given order."""

    def __init__(self, order: tuple[int, ...], alpha: float) -> None:
        count = len(order)
        self._alpha = Fraction(alpha)
        self._colors = [tuple(Fraction(float(value)) for value in color[:3]) for color in COLORS[:count]]
        x, y = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
        index = np.array([[0, 1, 2], [0, 2, 3]])
        layers = [
            np.stack([x, y, np.full(4, 0.5 - 0.4 * layer), np.ones(4)], axis=1)[index] for layer in order
        ]
        shades = [np.broadcast_to([*COLORS[layer, :3], alpha], (2, 3, 4)) for layer in order]
        self.scene = ClipScene(
            np.concatenate(layers), np.concatenate(shades), (SIDE, SIDE), background=np.array(BACKGROUND)
        )

    def wanted(self, adds: bool) -> tuple[float, ...]:
        """Return the colour (3) by fractions: what the layers let through, from back to front; or the sum of light."""
        color = [Fraction(value) for value in BACKGROUND[:3]]
        for layer in self._colors:
            through = Fraction(1) if adds else 1 - self._alpha
            color = [self._alpha * own + through * behind for own, behind in zip(layer, color, strict=True)]
        return tuple(float(value) for value in color)

    def judge(self, settings: Settings) -> Judgement:
        """Compare the colour with that of glass, or of light where light is added."""
        shown = drawn_colors(self.scene, settings)[..., :3]
        wanted = np.broadcast_to(self.wanted(settings.blend == "additive"), shown.shape)
        return judge_colors(shown, wanted, TOLERANCE)


def make_layers(place: tuple[float, ...], seed: int) -> LayersCase:
    """Make the layers; nothing in them is random."""
    del seed
    number = int(place[0])
    order = ORDERS[2][number] if number < 2 else ORDERS[3][number - 2]
    return LayersCase(order, place[1])


BLENDING = CaseExperiment(
    ExperimentInfo(
        "blending-order",
        "Blending by the order of drawing",
        "Layers of glass (for additive: of light) are drawn in every order; the first order of two and of three is "
        "from back to front. Is the picture the same?",
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
        "Over is wrong in every order but from back to front, with a z-buffer too, unless alpha is 0 or 1; sorted "
        "it is always right. Light that is added is the same in any order. Opaque is wrong for any alpha below 1.",
    ),
    make_layers,
    "blend",
)
