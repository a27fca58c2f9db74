"""When depth is tested: after a fragment is shaded, or before, so that what is hidden already is not shaded; or twice.

A depth test does not read the fragment's colour, so it decides alike at both times, and the picture is the same. Early
shades a fragment only where it passes: at a pixel as often as its nearest depth so far falls. Of n layers in random
order that is 1 + 1/2 + ... + 1/n times on average: n from far to near, once from near to far. A prepass draws all
depths first, and then all triangles again: a fragment is shaded if it has the depth that is left, once at every pixel.

References
----------
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline", culling: early z-culling.
N. Greene, M. Kass, G. Miller, *Hierarchical Z-buffer visibility*, SIGGRAPH 1993 (for whole triangles).
"""

from collections.abc import Callable
from fractions import Fraction
from typing import TypeVar

from core.methods import method

Color = TypeVar("Color")
ALL, PASSING, LEFT = "all", "passing", "left"
"""Which fragments are shaded: all, those that pass the depth test, those whose depth is left in the end."""


def shade_then_test(passes: Callable[[], bool], shade: Callable[[], Color]) -> Color | None:
    """Listing of one fragment whose depth is tested late; ``None``: its colour is thrown away."""
    color = shade()
    if not passes():
        return None
    return color


def shade_if_passed(passes: Callable[[], bool], shade: Callable[[], Color]) -> Color | None:
    """Listing of one fragment whose depth is tested early; ``None``: it is not shaded."""
    if not passes():  #: test
        return None
    return shade()


def shade_if_left(
    depth: float, left: float, is_shaded: Callable[[], bool], shade: Callable[[], Color]
) -> Color | None:
    """Listing of one fragment after a prepass, which has left a depth; ``None``: it is not shaded.

    Of fragments with equal depths the first is shaded, as the late test has it: "equal" alone would let all pass.
    """
    if depth != left or is_shaded():  #: test
        return None
    return shade()


def mean_shaded(layers: int) -> Fraction:
    """Return how many of n layers an early test has shaded on average over all orders: 1 + 1/2 + ... + 1/n."""
    return sum((Fraction(1, k) for k in range(1, layers + 1)), Fraction(0))


@method(
    "depth_test_time",
    "late",
    "After shading",
    source="Pellacini, Framebuffer processing; the order of the stages",
    exact_for="every scene: shaders may discard fragments before the test",
    breaks_where="nowhere, but hidden fragments are shaded for nothing",
    listing=shade_then_test,
)
def late() -> str:
    """Shade every fragment: return which are shaded."""
    return ALL


@method(
    "depth_test_time",
    "early",
    "Before shading (early z)",
    source="Pellacini, culling: early z-culling; OpenGL 4.6, early fragment tests",
    exact_for="fragments that shading only colours: the picture is that of the late test",
    breaks_where="shaders that discard fragments, so scenes with shaders keep the late test; drawn from far to near "
    "it saves nothing",
    listing=shade_if_passed,
)
def early() -> str:
    """Shade what passes: return which are shaded."""
    return PASSING


@method(
    "depth_test_time",
    "prepass",
    "Prepass: depth alone first",
    source="OpenGL 4.6, depth test with EQUAL after a pass that writes depth alone",
    exact_for="opaque fragments: each covered pixel is shaded once, whatever the order; the picture is the late test's",
    breaks_where="transforms, coverage and depth test are done twice; blending needs hidden fragments, and is tested "
    'early; followed by "less" instead of "equal" nothing would be drawn',
    listing=shade_if_left,
)
def prepass() -> str:
    """Shade what the depth buffer is left with: return which are shaded."""
    return LEFT
