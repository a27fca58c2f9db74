"""Orders of drawing: bars in a circle, layers with swaps, and blending."""

from itertools import permutations

import numpy as np
import pytest

from core.depth.measured_order import shuffled_layers
from core.framebuffer.measured import ORDERS, LayersCase, layered_glass
from core.study.record import Outcome
from core.study.stability import experiments
from tests.covering import every_nth

CIRCLE = experiments.get("painters-cycle")
LAYERS = experiments.get("drawing-order")
BLENDING = experiments.get("blending-order")
SOURCE = np.random.default_rng(3)
IN_A_CIRCLE = [(float(a), float(b)) for a, b in SOURCE.uniform((0.05, 0.05), (0.5, 0.5), (4, 2))]
LIFTED = [(float(a), float(b)) for a, b in SOURCE.uniform((0.05, 1.05), (0.5, 2.0), (4, 2))]
ROBUST = ("visibility=z-buffer", "visibility=ray-casting")


@pytest.mark.parametrize("place", IN_A_CIRCLE)
def test_no_order_is_right_for_a_circle(place: tuple[float, float]) -> None:
    for method in ("visibility=last-drawn", "visibility=painters"):
        assert CIRCLE.run(method, place, 0).outcome == Outcome.WRONG_ORDER
    for method in ROBUST:
        assert CIRCLE.run(method, place, 0).outcome == Outcome.RIGHT


@pytest.mark.parametrize("place", LIFTED)
def test_bars_lifted_off_each_other_can_be_sorted(place: tuple[float, float]) -> None:
    for method in ("visibility=painters", *ROBUST):
        assert CIRCLE.run(method, place, 0).outcome == Outcome.RIGHT
    assert CIRCLE.run("visibility=last-drawn", place, 0).outcome == Outcome.WRONG_ORDER


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("count", "swaps"), [(2, 1), (3, 1), (3, 3), (5, 7), (9, 20)])
def test_swapped_layers(count: int, swaps: int, seed: int) -> None:
    place = (float(count), float(swaps))
    for method in ("visibility=painters", *ROBUST):
        assert LAYERS.run(method, place, seed).outcome == Outcome.RIGHT
    assert LAYERS.run("visibility=last-drawn", (float(count), 0.0), seed).outcome == Outcome.RIGHT
    if count <= 3 or swaps > 2 * count:
        # Among few layers all are seen; many swaps reach those in front.
        assert LAYERS.run("visibility=last-drawn", place, seed).outcome == Outcome.WRONG_ORDER


@pytest.mark.parametrize("seed", range(5))
def test_swaps_are_as_many_as_asked_for(seed: int) -> None:
    depth = shuffled_layers(6, 7, seed)[:, 0, 2]
    inversions = sum(depth[i] < depth[j] for i in range(6) for j in range(i + 1, 6))
    assert inversions == 7


@pytest.mark.parametrize("alpha", every_nth([0.05, 0.3, 0.5, 0.9], 2))
def test_over_needs_the_order_from_back_to_front(alpha: float) -> None:
    for number in range(8):
        place = (float(number), alpha)
        is_in_order = number in (0, 2)
        for method in ("visibility=last-drawn blend=over", "visibility=z-buffer blend=over"):
            wanted = Outcome.RIGHT if is_in_order else Outcome.WRONG_PICTURE
            assert BLENDING.run(method, place, 0).outcome == wanted
        for method in ("visibility=painters blend=over", "visibility=last-drawn blend=additive"):
            assert BLENDING.run(method, place, 0).outcome == Outcome.RIGHT
        assert BLENDING.run("visibility=last-drawn blend=opaque", place, 0).outcome == Outcome.WRONG_PICTURE


def test_opaque_is_right_for_opaque_layers_in_order() -> None:
    for number in range(8):
        wanted = Outcome.RIGHT if number in (0, 2, 4) else Outcome.WRONG_PICTURE
        assert BLENDING.run("visibility=last-drawn blend=opaque", (float(number), 1.0), 0).outcome == wanted
    # Layers 4 are in the order 1, 0, 2: the nearest is the last, and hides the wrong ones.
    assert ORDERS[3][2] == (1, 0, 2)


def test_the_first_orders_are_from_back_to_front() -> None:
    assert ORDERS[2][0] == (0, 1)
    assert ORDERS[3] == tuple(permutations(range(3)))


def test_glass_of_alpha_a_half_lets_half_through() -> None:
    first, second = (LayersCase(layered_glass(order, 0.5)) for order in ((0,), (0, 1)))
    color = np.array([0.0, 0.168, 0.445]), np.array([0.791, 0.347, 0.0])
    assert first.wanted(False)[1, 2] == pytest.approx(0.5 * color[0] + 0.125)
    assert second.wanted(False)[1, 2] == pytest.approx(0.5 * color[1] + 0.25 * color[0] + 0.0625)
    assert second.wanted(True)[1, 2] == pytest.approx(0.5 * color[1] + 0.5 * color[0] + 0.25)
