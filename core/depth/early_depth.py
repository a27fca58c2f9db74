"""When depth is tested: after a fragment is shaded, or before, so that what is hidden already is not shaded.

A depth test does not read the fragment's colour, so it decides alike at both times, and the picture is the same. Early
shades a fragment only where it passes: at a pixel as often as its nearest depth so far falls. Of n layers in random
order that is 1 + 1/2 + ... + 1/n times on average: n from far to near, once from near to far.

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
def late() -> bool:
    """Shade every fragment: return whether depth is tested before."""
    return False


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
def early() -> bool:
    """Shade what passes: return whether depth is tested before."""
    return True
