"""What is seen, measured: hidden surfaces, culling, formats, clipping; triangles that overlap in a circle.

References
----------
M. Newell, R. Newell, T. Sancha, *A solution to the hidden surface problem*, 1972 (cycles have to be split).
"""

import numpy as np

from core.coverage.measured import MISCLASSIFIED
from core.coverage.measured_exactly import count_pixels, facing, whole_corner
from core.interpolation.measured import exact_fragments, exact_nearest
from core.methods import table
from core.records.arrays import Floats, Integers, cached_property
from core.records.frame import Frame
from core.scene import Camera, ClipScene, DirectionalLight, Mesh, Scene
from core.settings import Settings
from core.stages.fragment_color import vertex_stage
from core.study.experiment import Experiment
from core.study.family import Assignment, StudyFamily
from core.study.fragment_cases import NearestCase
from core.study.frame_task import WRONG_VISIBLE, SeenTask, depth_bits, per_million, scalar_pictures
from core.study.record import Axis, Judgement, Pictures, WorkKind, judged
from core.study.workloads import (
    bars_in_a_circle,
    clip_of_window,
    cyclic_triangles,
    flat_scene,
    on_grid,
    overlapping_triangles,
    random_source,
    random_triangles,
    sphere_mesh,
    wall_scene,
)
from core.trace.source import TraceSource

# Studies of what is seen: hidden surfaces, culling, depth formats and polygon clipping, against exact
# comparison.


SIZE = (128, 128)
COUNTS = Axis("count", "Triangles", "", (2, 4, 8, 16, 32, 64, 128), default=16, is_cost=True)
SIDE = 96
"""Pixels on a side of the sphere's picture."""
RINGS = Axis("rings", "Rings of the sphere", "", (4, 6, 8, 12, 16, 24, 32), default=12, is_cost=True)
SIDES = Axis("side", "Side of the picture", "pixels", (32, 64, 128, 256, 512), default=128, is_cost=True)


class VisibilityTask(SeenTask):
    """Triangles (T, 3, 4) in clip space, of which the nearest is to be seen."""

    def __init__(self, clip: Floats) -> None:
        super().__init__(flat_scene(clip, SIZE), 1, "depth", lambda: exact_nearest(clip, SIZE))
        self._clip = clip

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and what each method does in place of another's depth tests.

        Notes
        -----
        Ray casting as the lectures have it (for each pixel, for each object) tests every ray against every triangle.
        This program finds the same hits by filling triangles, which are the pixels tested and covered, and compares
        them. A depth buffer and ray casting compute a depth for each fragment; scan lines compute those at the ends of
        segments where several triangles are live.
        """
        counts, drawing = super().counts(settings, made), table.get("visibility", settings.visibility)
        order = drawing.function(self._clip)
        compared = counts.pop("depth tests")
        exact = TraceSource(self.scene, settings).exact_tests if order.decides else None
        work = exact.work if exact is not None else {}
        asks_all = exact is not None and not work
        computed = work.get("depths computed", compared if order.uses_depth_test else 0)
        return counts | {
            "depth tests": compared if order.uses_depth_test and exact is None else 0,
            "depths computed": computed,
            "span ends sorted": work.get("span ends sorted", 0),
            "depths and span ends": computed + work.get("span ends sorted", 0),
            "hits compared": compared if asks_all else 0,
            "rays times triangles": SIZE[0] * SIZE[1] * len(self._clip) if asks_all else 0,
            "triangles sorted": len(self._clip) if settings.visibility == "painters" else 0,
            **self._counts_of_tree(settings),
        }

    def _counts_of_tree(self, settings: Settings) -> dict[str, int]:
        """Return how often a BSP tree tests a piece against a plane, and the pieces that it cuts."""
        if settings.visibility != "bsp":
            return {"plane tests": 0, "pieces": 0}
        from core.visibility.bsp import build_tree

        tree = build_tree(self._clip)
        return {"plane tests": len(tree.side), "pieces": len(tree.drawn)}


def make_visibility(assignment: Assignment) -> VisibilityTask:
    """Make triangles that hide each other."""
    if assignment.work == "cycle":
        return VisibilityTask(cyclic_triangles(SIZE))
    count = int(assignment.dials["count"])
    if assignment.work == "layers":
        window = random_triangles(SIZE, count, 0.6 * min(SIZE), assignment.seed)
        depth = random_source(assignment.seed + 1).permutation(count) / max(count, 1) * 0.8 + 0.1
        clip = clip_of_window(window, SIZE, np.repeat(depth[:, None], 3, axis=1), np.ones((count, 3)))
        return VisibilityTask(clip)
    return VisibilityTask(overlapping_triangles(SIZE, count, assignment.seed))


VISIBILITY = StudyFamily(
    "visibility",
    "Hidden surfaces",
    ("visibility",),
    (
        WorkKind("crossing", "Random triangles that pass through each other", "frame", (COUNTS,)),
        WorkKind("layers", "Random triangles, each at one depth", "frame", (COUNTS,)),
        WorkKind("cycle", "Three bars that overlap in a circle", "frame"),
    ),
    (WRONG_VISIBLE,),
    make_visibility,
)


def make_culling(assignment: Assignment) -> SeenTask:
    """Make a sphere, whole or without its upper part; of a closed surface the reference sees the front."""
    mesh = sphere_mesh(int(assignment.dials["rings"]))
    if assignment.work == "open":
        lower = mesh.positions[mesh.triangles][..., 1].mean(axis=1) < 0.4
        mesh = Mesh(mesh.positions, mesh.triangles[lower], mesh.normals, name="open sphere")
    camera = Camera(np.array([0.0, 2.0, 2.6]), np.zeros(3), near=1.0, far=6.0)
    scene = Scene((mesh,), camera, (DirectionalLight(np.array([0.4, -0.8, -0.7])),), (SIDE, SIDE))

    def reference() -> Integers:
        vertices = vertex_stage(scene)
        clip = vertices.clip[vertices.corners]
        seen = np.arange(len(clip))
        if assignment.work == "closed":
            turns = [facing([whole_corner(corner, scene.size, True) for corner in each]) for each in clip]
            seen = np.flatnonzero(np.array(turns) > 0)
        return np.append(seen, -1)[exact_nearest(clip[seen], scene.size)]

    return SeenTask(scene, len(mesh.triangles), "cull", reference)


CULL = StudyFamily(
    "cull",
    "Culling",
    ("cull",),
    (
        WorkKind("closed", "A closed surface", "triangle", (RINGS,)),
        WorkKind("open", "A surface that is open on one side", "triangle", (RINGS,)),
    ),
    (WRONG_VISIBLE,),
    make_culling,
    Settings(shading="unlit"),
)


class WallTask(SeenTask):
    """Two walls, one a little nearer than the other: 0, the nearer one, has to be seen everywhere."""

    def __init__(self, scene: Scene) -> None:
        first = len(scene.meshes[0].triangles)
        end = first + len(scene.meshes[1].triangles)
        super().__init__(
            *(scene, 1, "depth", lambda: np.zeros(scene.size[::-1], np.int64), ("depth",)),
            shown=lambda triangles: np.where((triangles < first) | (triangles >= end), 1, 0),
        )

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and the bits of one depth."""
        return super().counts(settings, made) | {"bits of a depth": depth_bits(settings)}


def make_depth(assignment: Assignment) -> WallTask:
    """Make the two walls, at all distances at once."""
    dials = assignment.dials
    return WallTask(wall_scene(dials["far"], dials["gap"], int(dials["side"])))


DEPTH = StudyFamily(
    "depth",
    "Depth formats",
    ("depth",),
    (
        WorkKind(
            "walls",
            "Two walls, one just before the other",
            "frame",
            (
                Axis("far", "Far plane over near plane", "", (10, 100, 1e3, 1e4, 1e5, 1e6), default=1e4),
                Axis(
                    "gap",
                    "Gap, as a part of the distance",
                    "",
                    (1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2),
                    default=1e-5,
                ),
                SIDES,
            ),
        ),
    ),
    (WRONG_VISIBLE,),
    make_depth,
    Settings(shading="unlit", fill="bounding-box"),
)


class ClippingTask(SeenTask):
    """Triangles that cross planes of the view volume; the reference keeps what is covered and in depth range."""

    def __init__(self, clip: Floats) -> None:
        super().__init__(flat_scene(clip, SIZE), len(clip), "clip", lambda: exact_nearest(clip, SIZE))
        self._clip = clip

    @cached_property
    def cover_reference(self) -> Integers:
        """(H, W) int64, how many triangles cover each pixel in depth range."""
        fragments = exact_fragments(self._clip, SIZE)
        return count_pixels(fragments.column, fragments.row, SIZE)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count pixels that are covered too often or too seldom."""
        wrong = int(np.abs(made.cover_count - self.cover_reference).sum())
        looked_at = len(self._clip) * made.primitive.size
        errors = super().judge(settings, made).errors
        return judged({MISCLASSIFIED.name: per_million(wrong, looked_at), **errors})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return how often each pixel is covered."""
        return scalar_pictures(made.cover_count, self.cover_reference)


def crossing_clip(work: str, count: int, seed: int) -> Floats:
    """Return clip corners (count, 3, 4): across the borders of the window, the near plane, or the eye."""
    source = random_source(seed)
    reach = np.array(SIZE)
    if work == "window":
        window = source.uniform(-1.0, 2.0, (count, 3, 2)) * reach
        return clip_of_window(
            window, SIZE, source.uniform(0.1, 0.9, (count, 3)), source.uniform(1, 3, (count, 3))
        )
    clip = np.empty((count, 3, 4))
    clip[..., :2] = source.uniform(-2.5, 2.5, (count, 3, 2))
    w = source.uniform(1.0, 4.0, (count, 3))
    low = 0.4 if work == "near" else -1.5
    w[:, 0] = source.uniform(low, 0.9, count) if work == "near" else source.uniform(low, -0.3, count)
    # A perspective with near 1 and far 20: z = (21 w - 40) / 19.
    clip[..., 2], clip[..., 3] = (21 * w - 40) / 19, w
    return clip


def make_clipping(assignment: Assignment) -> ClippingTask:
    """Make triangles that have to be clipped, or drawn without."""
    return ClippingTask(crossing_clip(assignment.work, int(assignment.dials["count"]), assignment.seed))


CLIPPING = StudyFamily(
    "clipping",
    "Clipping of triangles",
    ("clipping",),
    (
        WorkKind("near", "Triangles across the near plane", "triangle", (COUNTS,)),
        WorkKind("eye", "Triangles with a corner behind the eye", "triangle", (COUNTS,)),
        WorkKind("window", "Triangles across the borders of the window", "triangle", (COUNTS,)),
    ),
    (MISCLASSIFIED, WRONG_VISIBLE),
    make_clipping,
)


# Hidden surfaces by the order of drawing: triangles that overlap in a circle, and layers in a wrong order.


SIDE_OF_LAYERS = 64
"""Pixels on a side of the picture: a power of two, so that places on the grid are exact in clip space."""
CROSSING = 0.35 * np.sqrt(3)
"""Where a bar's axis meets those of the others, from its middle, in half sides of the picture times 0.9."""


def circle_of_bars(overlap: float, lift: float) -> Floats:
    """Return clip corners (3, 3, 4) of three bars, each slanting from the front down to behind.

    Parameters
    ----------
    overlap : float
        How far a bar's axis reaches beyond those of the others, in half lengths; far below 0 they do not meet.
    lift : float
        Each bar is farther by this part of a bar's own depth than the one before: lifted enough, one lies wholly
        before the next, and there is no circle.
    """
    slant = 0.12
    depth = 0.3 + slant * (np.array([0.0, 1.0, 1.0]) + lift * np.arange(3)[:, None])
    return bars_in_a_circle((SIDE_OF_LAYERS, SIDE_OF_LAYERS), CROSSING + overlap, 0.2, depth)


def shuffled_layers(count: int, swaps: int, seed: int) -> Floats:
    """Return clip corners (count, 3, 4) of triangles one behind the other, drawn from back to front but for swaps.

    Notes
    -----
    A swap exchanges two neighbours in the order of drawing; the seed chooses which, and no swap undoes another.
    """
    source = random_source(seed)
    turn = source.uniform(0, 2 * np.pi, count)
    corners = turn[:, None] + 2 * np.pi / 3 * np.arange(3)
    window = SIDE_OF_LAYERS * (0.5 + 0.45 * np.stack([np.cos(corners), np.sin(corners)], axis=2))
    order = np.arange(count)
    for _ in range(swaps):
        # Only neighbours that are still in order.
        first = int(source.choice(np.flatnonzero(np.diff(order) > 0)))
        order[[first, first + 1]] = order[[first + 1, first]]
    depth = 0.9 - 0.8 * (order + 0.5) / count
    return clip_of_window(
        on_grid(window),
        (SIDE_OF_LAYERS, SIDE_OF_LAYERS),
        np.repeat(depth[:, None], 3, axis=1),
        np.ones((count, 3)),
    )


def layers_at(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return the layers of one place; there are no more swaps than pairs."""
    count = int(place[0])
    clip = shuffled_layers(count, min(int(place[1]), count * (count - 1) // 2), seed)
    return flat_scene(clip, (SIDE_OF_LAYERS, SIDE_OF_LAYERS))


CIRCLE = Experiment(
    "painters-cycle",
    "Painter's algorithm on three bars in a circle",
    "Each of three bars lies in front of the next one at one end. What happens if they overlap more, and if "
    "one is lifted off the next?",
    (
        Axis(
            "overlap",
            "Reach beyond the crossings, in half lengths",
            "",
            (-0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5),
        ),
        Axis("lift", "Lift, in depths of a bar", "", (0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.1, 1.5)),
    ),
    (
        "visibility=last-drawn",
        "visibility=painters",
        "visibility=bsp",
        "visibility=z-buffer",
        "visibility=ray-casting",
    ),
    "Where the bars overlap and none is lifted by half its depth, no order is right: sorting fails, and so "
    "does drawing without a depth test. Lifted by a whole depth, sorting is right. A z-buffer is always "
    "right. A BSP tree cuts the bars and is right, except in a few pixels with a centre beside an edge of a piece.",
    lambda place, _: flat_scene(circle_of_bars(place[0], place[1]), (SIDE_OF_LAYERS, SIDE_OF_LAYERS)),
    NearestCase,
)
LAYERS = Experiment(
    "drawing-order",
    "Layers drawn in a wrong order",
    "Triangles one behind the other are drawn from back to front, except for some swaps of neighbours. Is the"
    " nearest one visible?",
    (
        Axis("layers", "Layers", "", (2, 3, 4, 6, 8, 12, 16)),
        Axis("swaps", "Swaps of neighbours", "", (0, 1, 2, 3, 4, 6, 8, 12)),
    ),
    ("visibility=last-drawn", "visibility=painters", "visibility=z-buffer", "visibility=ray-casting"),
    "Without a depth test every swap of two visible layers is wrong. Sorted layers and a z-buffer are right "
    "in any order.",
    layers_at,
    NearestCase,
)
