"""What several processes gain: a picture in bands of rows, one for each process, against Amdahl's limit.

Every process transforms and culls all triangles, and draws its own rows. A picture is finished when its slowest band
is. The bands are drawn here one after the other in this process, so that the chart is that of a machine with a free
core for each; starting processes and putting rows together is not counted.

With the whole picture's seconds s for vertices and culling, and r for all else, p processes take at least s + r / p:
the limit of G. Amdahl.

References
----------
G. Amdahl, *Validity of the single processor approach to achieving large scale computing capabilities*, AFIPS 1967.
M. Zwicker, *Computergrafik*, Bern 2016, "Rasterization: optimizations" (threads).
"""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass
from functools import partial
from time import perf_counter

import numpy as np

from core.fast_path.draw import draw_picture
from core.fast_path.draw_context import Picture
from core.fast_path.workers.sharing import even_cuts, rows_of
from core.records.arrays import cached_property
from core.scene import AnyScene
from core.settings import Settings
from core.stages.declared import GEOMETRY_STAGES
from core.study.family import Assignment, StudyFamily, Task
from core.study.frame_task import MILLION, color_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Opening, Outcome, Pictures, Verdict, WorkKind
from core.study.workloads import sphere_scene

BEYOND = ErrorMeasure("beyond-limit", "Time beyond Amdahl's limit", "%")
WRONG = ErrorMeasure("wrong-pixels", "Pixels that differ from the whole picture", "per million")
SIDE = 384


@dataclass(frozen=True, eq=False)
class Bands:
    """A picture in bands."""

    pictures: tuple[Picture, ...]
    """From the lowest rows to the highest."""
    seconds: tuple[float, ...]
    """That each took."""


def amdahl_limit(shared: float, divided: float, processes: int) -> float:
    """Return the least seconds of so many processes: what each of them does, and a part of what is divided."""
    return shared + divided / processes


class BandsTask(Task):
    """A lit sphere, drawn in bands of as many rows each."""

    unit_count = 1

    def __init__(self, scene: AnyScene, processes: int) -> None:
        self.scene, self.processes = scene, processes

    def start(self, settings: Settings) -> Callable[[], Bands]:
        """Prepare the bands of a scene that is new to the pipeline, as it is to every process."""
        width, height = self.scene.size
        rows = rows_of(even_cuts(self.processes), height)
        regions = [(0, first, width, end - first) for first, end in rows]
        return partial(self._drawn, settings, regions)

    def _drawn(self, settings: Settings, regions: list[tuple[int, int, int, int]]) -> Bands:
        pictures, seconds = [], []
        for region in regions:
            scene, begun = copy(self.scene), perf_counter()
            pictures.append(draw_picture(scene, settings, region=region))
            seconds.append(perf_counter() - begun)
        return Bands(tuple(pictures), tuple(seconds))

    def seconds(self, made: Bands, elapsed: float) -> float:
        """Return the seconds of the slowest band."""
        return max(made.seconds)

    @cached_property
    def _wholes(self) -> dict[Settings, tuple[Picture, float]]:
        return {}

    def _whole(self, settings: Settings) -> tuple[Picture, float]:
        """Return the whole picture and the seconds that it took, the least of three."""
        if settings not in self._wholes:
            taken = []
            for _ in range(3):
                begun = perf_counter()
                picture = draw_picture(copy(self.scene), settings)
                taken.append((perf_counter() - begun, picture))
            least, picture = min(taken, key=lambda each: each[0])
            self._wholes[settings] = picture, least
        return self._wholes[settings]

    def judge(self, settings: Settings, made: Bands) -> Judgement:
        """Compare the pixels with those of the whole picture, and the time with the limit."""
        whole, seconds = self._whole(settings)
        shared = min(sum(whole.statistics[stage].seconds for stage in GEOMETRY_STAGES), seconds)
        limit = amdahl_limit(shared, seconds - shared, self.processes)
        pixels = np.concatenate([picture.pixels for picture in made.pictures])
        wrong = (pixels != whole.pixels).any(axis=2)
        # The first run fills caches, and a busy machine only ever adds: of each band the least of three.
        runs = [made.seconds, *(self.start(settings)().seconds for _ in range(2))]
        slowest = max(min(each) for each in zip(*runs, strict=True))
        beyond = max(100 * (slowest / limit - 1), 0.0)
        outcome = Outcome.WRONG_PICTURE if wrong.any() else Outcome.RIGHT
        remark = f"{100 * shared / seconds:.0f} % of the picture is work of every process"
        errors = {BEYOND.name: beyond, WRONG.name: MILLION * int(wrong.sum()) / wrong.size}
        return Judgement(Verdict(outcome, float(wrong.sum()), remark), wrong, errors)

    def counts(self, settings: Settings, made: Bands) -> dict[str, int]:
        """Return the work of all processes together."""
        counts = [picture.statistics for picture in made.pictures]
        return {
            "triangles transformed by all": sum(each["transform"].incoming for each in counts),
            "pixels covered by all": sum(each["raster"].outgoing for each in counts),
            "pixels covered in the fullest band": max(each["raster"].outgoing for each in counts),
        }

    def pictures(self, settings: Settings, made: Bands) -> Pictures:
        """Return the bands put together, and the whole picture."""
        pixels = np.concatenate([picture.pixels for picture in made.pictures])
        return color_pictures(pixels / 255, self._whole(settings)[0].pixels / 255)

    def opening(self, settings: Settings, made: Bands) -> Opening:
        """Return the sphere."""
        return Opening(self.scene, settings, "raster", None)


def make_bands(assignment: Assignment) -> BandsTask:
    """Make a sphere of so many rings, drawn by so many processes."""
    return BandsTask(sphere_scene(int(assignment.dials["rings"]), SIDE), int(assignment.dials["processes"]))


BANDS = StudyFamily(
    "bands",
    "Processes, in bands of rows",
    ("shading",),
    (
        WorkKind(
            "sphere",
            "A lit sphere on 384 x 384 pixels",
            "frame",
            (
                Axis("processes", "Processes", "", (1, 2, 3, 4, 6, 8, 12, 16), default=2, is_cost=True),
                Axis(
                    "rings",
                    "Rings n of the sphere, 4 n (n − 1) triangles",
                    "",
                    (4, 8, 16, 32, 64, 96),
                    default=32,
                ),
            ),
        ),
    ),
    (BEYOND, WRONG),
    make_bands,
    only=("unlit", "gouraud", "phong"),
)
