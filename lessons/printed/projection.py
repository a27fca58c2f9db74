"""LMU's perspective projection: w is negative in front of the eye, and near lies at +1."""

from functools import partial
from math import pi, tan

import numpy as np

from core.geometry.matrices import projection
from core.records.arrays import Floats
from core.scene import Camera
from lessons.printed.records import PrintedListing, SlideNumber

SLIDE = "Task 1 d) Z-fighting: Case 2 - Close to far plane"
ANGLE, ASPECT, NEAR, FAR = pi / 3, 4 / 3, -1.0, -10.0
"""Opening angle, width over height, and the planes as z, negative as on the slide."""


def printed_projection(theta: float, aspect: float, n: float, f: float) -> Floats:
    """Return the (4, 4) matrix of the slide, 0 > n > f; ``theta`` in radians, ``aspect`` is its lambda."""
    return np.array(
        [
            [-1 / (aspect * tan(theta / 2)), 0, 0, 0],
            [0, -1 / tan(theta / 2), 0, 0],
            [0, 0, (n + f) / (n - f), 2 * n * f / (f - n)],
            [0, 0, 1, 0],
        ]
    )


def divided(matrix: Floats, point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return x/w, y/w and z/w of a transformed point."""
    x, y, z, w = (matrix @ np.array([*point, 1.0])).tolist()
    return x / w, y / w, z / w


def as_printed(point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return a point of camera space by the slide's matrix, divided."""
    return divided(printed_projection(ANGLE, ASPECT, NEAR, FAR), point)


def ours(point: tuple[float, float, float]) -> tuple[float, float, float]:
    """Return the same point by the program's matrix, divided."""
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), field_of_view=ANGLE, near=-NEAR, far=-FAR)
    return divided(projection(camera, ASPECT), point)


def printed_w(z: float) -> float:
    """Return the w of a point at z by the slide's matrix."""
    return float((printed_projection(ANGLE, ASPECT, NEAR, FAR) @ [0.0, 0.0, z, 1.0])[3])


def depth_of(z: float) -> float:
    """Return the program's z/w of a point at z."""
    return ours((0.0, 0.0, z))[2]


def printed_depth_of(z: float) -> float:
    """Return the slide's z_perp of a point at z."""
    return as_printed((0.0, 0.0, z))[2]


def places_differ() -> float:
    """Return by how much x/w and y/w of the two matrices differ at most, at three points."""
    points = ((0.3, -0.2, -1.5), (1.0, 2.0, -4.0), (-3.0, 0.5, -9.0))
    return max(float(np.abs(np.subtract(as_printed(p)[:2], ours(p)[:2])).max()) for p in points)


def _row(what: str, number: float, compute: partial[float], right: float | None = None) -> SlideNumber:
    return SlideNumber("LMU", SLIDE, what, number, compute, right)


PROJECTION = PrintedListing(
    "lmu-projection",
    "Perspective projection matrix",
    "LMU",
    SLIDE,
    """\
T_persp = [ -1/(lambda tan(theta/2))          0            0           0
                     0               -1/tan(theta/2)       0           0
                     0                        0       (n+f)/(n-f)  2nf/(f-n)
                     0                        0            1           0 ]
z_perp = 2nf/(f-n) 1/z + (n+f)/(n-f) in [-1, 1], 0 > n >= z >= f""",
    "",
    "",
    {"as printed": printed_projection},
    "The step before last has (n+f)/(n-f) z + 2nf/(f-n) 1/z; the z is too much, as the last line shows.",
    numbers=(
        _row("z_perp at the near plane, n = -1, f = -10", 1.0, partial(printed_depth_of, NEAR)),
        _row("z_perp at the far plane", -1.0, partial(printed_depth_of, FAR)),
        _row("near at +1; ours has it at", 1.0, partial(depth_of, NEAR), -1.0),
        _row("far at -1; ours has it at", -1.0, partial(depth_of, FAR), 1.0),
        _row("w of a point in front of the eye, z = -4", -4.0, partial(printed_w, -4.0)),
        _row("x/w and y/w: largest difference from ours", 0.0, partial(places_differ)),
    ),
)
