"""Study of the orientation of three points: a published map of wrong signs, for every float format and pivot.

One point moves over a grid of the smallest steps u at 1/2, p = (0.5 + x u, 0.5 + y u); q = (12, 12), r = (24, 24). The
sign of (q - p) x (r - p) says on which side of the line through q and r it lies; multiplied out it is 12 (b - a) for
p = (a, b), the sign of y - x. Any of the points may be the pivot, which is taken from the two others.

References
----------
L. Kettner, K. Mehlhorn, S. Pion, S. Schirra, C. Yap, *Classroom examples of robustness problems in geometric
computations*, Computational Geometry 40 (2008): figure 2 and the choice of a pivot point.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from core.records.arrays import Integers
from core.settings import Settings
from core.study.accuracy.family import Assignment, Candidate, StudyFamily, Task
from core.study.accuracy.frame_task import scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged

FORMATS: Mapping[str, Any] = {
    "float16": np.float16,
    "float32": np.float32,
    "float64": np.float64,
    "exact": np.float64,
}
"""Number formats by what holds the points; ``exact`` computes with whole numbers of 2^-53."""
PIVOTS = ("pivot-p", "pivot-q", "pivot-r")

WRONG = ErrorMeasure("wrong-signs", "Wrong signs", "points")
TURNED = ErrorMeasure("turned-signs", "Signs turned round", "points")
SIDES = Axis("side", "Side of the map", "points", (16, 32, 64, 128, 256), default=256, is_cost=True)


class OrientationTask(Task):
    """The signs of a map of points, with one pivot."""

    def __init__(self, assignment: Assignment) -> None:
        steps = np.arange(int(assignment.dials["side"]))
        self.unit_count = len(steps) ** 2
        self._pivot = PIVOTS.index(assignment.work)
        self.reference: Integers = np.sign(steps[:, None] - steps)
        """(H, W) int64, the exact signs."""

    def start(self, settings: Settings) -> Callable[[], Integers]:
        """Prepare one map."""
        number = FORMATS[settings.coverage]
        moved = number(0.5) + np.arange(len(self.reference)).astype(number) * np.spacing(number(0.5))
        x, y = ([moving, number(12), number(24)] for moving in (moved, moved[:, None]))
        if settings.coverage == "exact":
            x, y = ([_whole(each) for each in places] for places in (x, y))
        order = [(self._pivot + k) % 3 for k in range(3)]
        return partial(orientation, [x[k] for k in order], [y[k] for k in order])

    def counts(self, settings: Settings, made: Integers) -> dict[str, int]:
        """Return how many signs (H, W) are positive, and 0."""
        return {"points to the left": int((made > 0).sum()), "points on the line": int((made == 0).sum())}

    def judge(self, settings: Settings, made: Integers) -> Judgement:
        """Count the wrong signs of a map (H, W), and those of them that are not 0."""
        is_wrong = made != self.reference
        wrong, turned = (float(np.count_nonzero(each)) for each in (is_wrong, is_wrong & (made != 0)))
        return judged({WRONG.name: wrong, TURNED.name: turned})

    def pictures(self, settings: Settings, made: Integers) -> Pictures:
        """Return the maps of signs (H, W)."""
        return scalar_pictures(made, self.reference)


def orientation(x: list[Any], y: list[Any]) -> Integers:
    """Return the signs (H, W) int64 of (q - p) x (r - p) as numbers round; the first of the three is the pivot."""
    value = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])
    return np.asarray((value > 0).astype(np.int64) - (value < 0))


def _whole(places: Any) -> Any:
    """Return coordinates, any shape, as Python's whole numbers of 2^-53."""
    return np.frompyfunc(lambda place: int(float(place) * 2**53), 1, 1)(places)


class _Orientation(StudyFamily):
    """The study of the formats that round as the published code does."""

    def candidates(self, base: Settings) -> tuple[Candidate, ...]:
        """Return one point for each format."""
        return tuple(Candidate(f"coverage={name}", name) for name in FORMATS)


ORIENTATION = _Orientation(
    "orientation",
    "Orientation of three points",
    ("coverage",),
    (
        WorkKind("pivot-p", "Pivot p, moving (Kettner et al. 2008)", "point", (SIDES,)),
        WorkKind("pivot-q", "Pivot q, in the middle (Kettner et al. 2008)", "point", (SIDES,)),
        WorkKind("pivot-r", "Pivot r, far off (Kettner et al. 2008)", "point", (SIDES,)),
    ),
    (WRONG, TURNED),
    OrientationTask,
)
