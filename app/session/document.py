"""What is open: a scene, its settings, what is traced and on which raster. A frozen value."""

import re
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from app.session.memory import check_free
from core import Settings, Trace, trace
from core.coverage.pixel_runs import fill_traits
from core.records.arrays import Floats, cached_property
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.stages.before_matrices import before_matrices
from core.trace import scene_triangle_count
from core.trace.source import LONGEST_RUN, TraceSource, most_tests

if TYPE_CHECKING:
    from core.edits.edit import Edit
    from core.study.record import Opening


# What is open: a scene, its settings, what is traced and on which raster. A frozen value; an edit makes a
# new one.


TEACHING_LIMIT = (96, 72)
"""Largest teaching raster in pixels; every pixel can be pointed at, and all buffers are traced at once."""
TEACHING_SIZES = ((8, 6), (16, 12), (24, 16), (32, 24), (48, 36), (64, 48), (96, 72))
VIEWS = ("pixels", "scene", "clip", "pyramid", "texture", "flow", "compare")
"""Names of the main views."""
TRACED_TOGETHER = 400
"""A scene of more triangles is traced one triangle at a time."""
MOST_TRIANGLES = 100_000
"""Triangles, or vertices, that a trace may have."""
TRACED_TRIANGLE, TRACED_TEST = 11_000, 2_000
"""Bytes that a triangle, and a pixel test, takes once all stages have been stepped (measured)."""
UNASKED = 2**26
"""Bytes that are taken without asking: an edit of a small scene reads no files of the system."""
DRAWN_TRIANGLE, DRAWN_VERTEX = 1_200, 1_000
"""Bytes that a triangle, and a vertex, takes once it is drawn on the grid and in the 3D view (measured)."""
TESTS_PER_SECOND = 2_000_000
EXACT_TESTS_PER_SECOND = 250_000
CUT_PER_SECOND = 10_000
"""Pairs of triangles that a BSP tree is built of in a second, where all cross."""
LONGEST_TREE = 3.0
"""Seconds that a BSP tree takes before it is refused."""
TRIANGLES_PER_SECOND = 600_000
STATEMENTS_PER_SECOND = 400_000
"""How fast pixels are traced, triangles transformed and shaders stepped, roughly: the slow runs off the GUI thread."""


@dataclass(frozen=True)
class TeachingRaster:
    """Which pixels are traced; it does not depend on the picture's size."""

    columns: int
    rows: int
    origin: tuple[int, int] | None = None
    """Column and row in the picture of the lower left pixel; ``None``: the whole view at this size, same camera."""

    def __post_init__(self) -> None:
        if not (1 <= self.columns <= TEACHING_LIMIT[0] and 1 <= self.rows <= TEACHING_LIMIT[1]):
            limit = f"{TEACHING_LIMIT[0]}x{TEACHING_LIMIT[1]}"
            raise ValueError(f"teaching raster must be 1x1 to {limit} pixels, got {self.columns}x{self.rows}")

    @property
    def label(self) -> str:
        """What a person reads."""
        if self.origin is None:
            return f"Whole view at {self.columns}×{self.rows}"
        return f"{self.columns}×{self.rows} pixels at ({self.origin[0]}, {self.origin[1]})"


@dataclass(frozen=True, eq=False)
class Document:
    """Everything that undo brings back."""

    scene: AnyScene
    raster: TeachingRaster
    settings: Settings = field(default_factory=Settings)
    triangle: int | None = None
    """The triangle in focus, ``None``: all of them are stepped."""
    before: str = "earlier"
    """Buffers at the start: as ``"earlier"`` triangles left them, or ``"cleared"``."""
    lanes: str = "one"
    """Order of a shader's steps: ``"one"`` lane after another, or those of a triangle ``"together"``."""
    title: str = ""
    path: str = ""
    """File that the scene came from; empty: built in or typed."""
    edits: tuple["Edit", ...] = ()
    """Listings as the user has edited them: side B of A | B runs them, beside the methods of the settings."""

    def has_run_of(self, other: "Document") -> bool:
        """Return whether it is the same run: of the same scene, under the same settings."""
        mine, theirs = (
            (each.raster, each.triangle, each.before, each.lanes, each.settings) for each in (self, other)
        )
        return self.scene is other.scene and mine == theirs

    @property
    def file_stem(self) -> str:
        """What a file made of it is called: as the file that it came from, else by its title."""
        name = Path(self.path).name.split(".")[0] if self.path else self.title
        return "-".join(re.findall(r"\w+", name)) or "scene"

    @property
    def triangle_count(self) -> int:
        """T, of the curves or patches as they are cut."""
        if not self.scene.makes_positions:
            return scene_triangle_count(self.scene)
        return scene_triangle_count(before_matrices(self.traced_scene, self.settings))

    @cached_property
    def traced_scene(self) -> AnyScene:
        """The scene at the size that is traced."""
        has_table = isinstance(self.scene, ClipScene) and self.scene.table is not None
        if self.raster.origin is not None or has_table:
            return self.scene
        return replace(self.scene, size=(self.raster.columns, self.raster.rows))

    @property
    def region(self) -> tuple[int, int, int, int] | None:
        """Pixels of ``traced_scene`` that are traced."""
        if self.raster.origin is None:
            return None
        return (*self.raster.origin, self.raster.columns, self.raster.rows)

    @property
    def most_tests(self) -> int:
        """Pixel tests of a trace at most where every pixel is tested, else a guess."""
        triangles = self.triangle_count if self.triangle is None else 1
        return most_tests(self.scene, self.settings, triangles, self.raster.columns * self.raster.rows)

    @property
    def estimated_seconds(self) -> float:
        """How long tracing takes, roughly."""
        drawn = self.triangle_count
        if fill_traits(self.settings.fill).looks_everywhere:
            # The buffers that earlier triangles left are drawn as well, without being kept.
            drawn += self.triangle_count * self.raster.columns * self.raster.rows // 20
        is_exact = self.settings.coverage == "exact"
        tests_per_second = EXACT_TESTS_PER_SECOND if is_exact else TESTS_PER_SECOND
        program = self.scene.program
        statements = 0 if program is None else self.most_tests * program.shaders[1].weight
        # A tree of triangles that cross has nearly as many pieces as the square of their number, up to its limit.
        tree = min(self.triangle_count**2 / CUT_PER_SECOND, LONGEST_TREE) * (
            self.settings.visibility == "bsp"
        )
        if self.settings.hierarchy != "none":
            from core.stages.object_tree import expected_tree  # Only trees wait for it.

            boxes = expected_tree(self.scene, self.triangle_count, self.settings)
            tree += 0.0 if boxes is None else boxes.seconds
        return (
            tree
            + drawn * self._picture_count / TRIANGLES_PER_SECOND
            + self.most_tests / tests_per_second
            + statements / STATEMENTS_PER_SECOND
        )

    @property
    def _picture_count(self) -> int:
        """How many pictures are drawn."""
        return self.settings.pictures if resolve(self.settings).sampling.is_temporal else 1

    def check_length(self) -> None:
        """Refuse a run that has too many steps to be kept; ValueError with what to do about it."""
        triangles, tests = self.triangle_count if self.triangle is None else 1, self.most_tests
        if tests > LONGEST_RUN:
            raise ValueError(
                f"Testing every pixel for all {self.triangle_count:,} triangles makes {tests:,} steps, "
                f"and {LONGEST_RUN:,} can be kept: bring one triangle into focus, or choose another fill."
            )
        if triangles > MOST_TRIANGLES:
            raise ValueError(
                f"All {triangles:,} triangles are too many to be stepped together, at most {MOST_TRIANGLES:,} are "
                "kept: bring one triangle into focus."
            )
        check_room(
            triangles * TRACED_TRIANGLE + tests * TRACED_TEST,
            f"stepping {triangles:,} triangles together" if triangles > 1 else "stepping one triangle",
        )

    def make_trace(self, settings: Settings | None = None) -> Trace:
        """Prepare the trace, under other settings if they are given."""
        run = self.traced_scene, settings or self.settings, self.triangle, self.region, self.before
        return trace(*run, lanes=self.lanes)


NEAR_THE_MIDDLE = 64
"""Triangles among which the one is chosen that is stepped first."""
LEAST_AREA = 8.0
"""Pixels that it has at least, if one of them has."""
STEPPED = Settings(fill="bounding-box")
"""How a scene is first stepped: every pixel of a box tested, one after another, is the plainest fill to follow."""


def check_room(wanted: int, what: str) -> None:
    """Raise MemoryBoundError if ``what`` takes ``wanted`` bytes and that is more than is free; little is not asked."""
    if wanted > UNASKED:
        check_free(wanted, what)


def check_drawing(scene: AnyScene) -> None:
    """Raise MemoryBoundError where drawing a scene may take more memory than is free."""
    count = scene_triangle_count(scene)
    vertices = 3 * count if isinstance(scene, ClipScene) else sum(len(m.positions) for m in scene.meshes)
    check_room(count * DRAWN_TRIANGLE + vertices * DRAWN_VERTEX, f"drawing its {count:,} triangles")


def shortened(document: Document) -> tuple[Document, str]:
    """Return the document, with one triangle in focus where all are too many to be stepped, and then why."""
    try:
        document.check_length()
    except ValueError as problem:
        if document.triangle is not None:
            raise
        return focus_on(document, central_triangle(document)), str(problem)
    return document, ""


def open_document(scene: AnyScene, title: str, path: str = "", settings: Settings | None = None) -> Document:
    """Return a scene as it is first shown: a small one as a whole, a large one at one triangle."""
    width, height = scene.size
    fits = width <= TEACHING_LIMIT[0] and height <= TEACHING_LIMIT[1]
    raster = TeachingRaster(width, height) if fits else same_view(scene, 64, 48)
    document = Document(scene, raster, settings or STEPPED, title=title, path=path)
    if document.triangle_count <= TRACED_TOGETHER:
        return document
    return focus_on(document, central_triangle(document))


def same_view(scene: AnyScene, columns: int, rows: int) -> TeachingRaster:
    """Return the raster of about ``columns`` x ``rows`` pixels that has the picture's aspect; of a table its cells."""
    if scene.corner_count == 0:
        return TeachingRaster(*scene.size)
    width, height = scene.size
    scale = min(columns / width, rows / height)
    return TeachingRaster(max(round(width * scale), 1), max(round(height * scale), 1))


def central_triangle(document: Document) -> int:
    """Return the triangle nearest to the middle of the view that has pixels to look at, as far as one has, or 0."""
    whole = replace(document, raster=same_view(document.scene, *TEACHING_LIMIT), triangle=None)
    # How curves are cut depends on the size: that of the picture, which the triangle in focus is part of.
    drawn = document.scene if document.scene.makes_positions else whole.traced_scene
    source = TraceSource(drawn, document.settings, None)
    primitive = source.picture.primitive
    rows, columns = np.nonzero(primitive >= 0)
    if len(rows) == 0:
        return 0
    middle = np.array(primitive.shape) / 2
    by_distance = np.argsort((rows - middle[0]) ** 2 + (columns - middle[1]) ** 2, kind="stable")
    seen = primitive[rows, columns][by_distance]
    triangles = seen[np.sort(np.unique(seen, return_index=True)[1])][:NEAR_THE_MIDDLE]
    vertices = source.geometry.vertices
    enlarged = np.array(document.scene.size) / drawn.size
    first, second, third = vertices.window[vertices.corners[triangles].T, :2] * enlarged
    with np.errstate(invalid="ignore"):
        area = np.nan_to_num(np.abs(np.linalg.det(np.stack([second - first, third - first], axis=1))) / 2)
    enough = min(LEAST_AREA, float(area.max()))
    return int(triangles[np.argmax(area >= enough)])


def window_corners_of(document: Document, triangle: int) -> Floats:
    """Return (3, 2) window positions of a triangle in the picture, (C, 2) of a polygon, NaN where w <= 0."""
    source = TraceSource(document.scene, document.settings, triangle)
    vertices = source.geometry.vertices
    corners = vertices.corners_of(triangle)
    return np.where(vertices.clip[corners, 3:] > 0, vertices.window[corners, :2], np.nan)


def focus_on(document: Document, triangle: int | None) -> Document:
    """Return the document with ``triangle`` in focus, on a raster where it can be seen."""
    document = replace(document, triangle=triangle)
    if triangle is None or max(document.scene.size) <= max(TEACHING_LIMIT):
        return document
    return fit_region(document)


def with_settings(document: Document, settings: Settings) -> Document:
    """Return the document with other settings; where they cut its curves otherwise, one in the middle is in focus."""
    changed = replace(document, settings=settings)
    if document.triangle is None or changed.triangle_count == document.triangle_count:
        return changed
    return focus_on(changed, central_triangle(changed))


def fit_region(document: Document) -> Document:
    """Return the document with the smallest raster around the triangle in focus.

    A triangle that is larger than the largest raster, or reaches behind the eye, is shown in the whole view.
    """
    if document.triangle is None or document.scene.corner_count == 0:
        return replace(document, raster=same_view(document.scene, *TEACHING_LIMIT))
    corners = window_corners_of(document, document.triangle)
    width, height = document.scene.size
    if not np.isfinite(corners).all():
        return replace(document, raster=same_view(document.scene, 64, 48))
    low = np.maximum(np.floor(corners.min(axis=0)) - 2, 0)
    high = np.minimum(np.ceil(corners.max(axis=0)) + 2, (width, height))
    needed = high - low
    for columns, rows in TEACHING_SIZES:
        if columns >= needed[0] and rows >= needed[1]:
            break
    else:
        return replace(document, raster=same_view(document.scene, *TEACHING_LIMIT))
    columns, rows = min(columns, width), min(rows, height)
    middle = (low + high) / 2
    origin = (
        int(np.clip(middle[0] - columns // 2, 0, width - columns)),
        int(np.clip(middle[1] - rows // 2, 0, height - rows)),
    )
    return replace(document, raster=TeachingRaster(columns, rows, origin))


def edits_beside(document: Document) -> Document:
    """Return a document whose edited listings run in side B: what is open itself runs the methods as they are."""
    settings = document.settings
    if not any(method.edits for method in settings.replacements.values()):
        return document
    from core.edits.edit import edits_of, without_edits

    return replace(document, settings=without_edits(settings), edits=(*document.edits, *edits_of(settings)))


def is_typed(scene: AnyScene) -> bool:
    """Return whether corners can be typed in window coordinates."""
    return isinstance(scene, ClipScene)


# The document in which one method's run can be stepped, at the place that matters: all of a picture, or a
# part.


PART = (48, 36)
"""Columns and rows that are stepped around a pixel of a picture that is too large to be stepped as a whole."""


def document_at(opening: "Opening", title: str, triangle: int | None = None) -> Document:
    """Return a document in which the opening's pixel can be stepped.

    A picture that is too large to be stepped as a whole is stepped around the pixel, and of many triangles only one:
    ``triangle``, or else the one that is seen there.
    """
    document = open_document(opening.scene, title, settings=opening.settings)
    if opening.pixel is None:
        return document
    if document.raster.origin is not None or document.traced_scene.size != opening.scene.size:
        document = replace(document, raster=part_around(opening.scene.size, opening.pixel))
    if document.triangle_count > TRACED_TOGETHER:
        seen = _triangle_at(document, opening.pixel) if triangle is None else triangle
        document = replace(document, triangle=document.triangle if seen < 0 else seen)
    return document


def part_around(size: tuple[int, int], pixel: tuple[int, int]) -> TeachingRaster:
    """Return a raster around a pixel, inside of the picture."""
    columns, rows = min(PART[0], size[0]), min(PART[1], size[1])
    column = min(max(pixel[0] - columns // 2, 0), size[0] - columns)
    row = min(max(pixel[1] - rows // 2, 0), size[1] - rows)
    return TeachingRaster(columns, rows, (column, row))


def _triangle_at(document: Document, pixel: tuple[int, int]) -> int:
    """Return the triangle that is seen at a pixel, -1: none."""
    source = TraceSource(document.traced_scene, document.settings, None, document.region)
    first_column, first_row, end_column, end_row = source.raster.bounds
    if not (first_column <= pixel[0] < end_column and first_row <= pixel[1] < end_row):
        return -1
    return int(source.picture.primitive[pixel[1] - first_row, pixel[0] - first_column])
