"""An experiment: scenes made from a place on its axes, every method's picture of them, and the kinds of its cases.

Corners that lie in the same place stay together, so that shared edges stay shared.

Where it is known what is right for any scene of the kind, that is worked out anew for whatever is left of a scene, so
every failing cell can be made smaller.
"""

from collections.abc import Callable, Iterator
from dataclasses import astuple, dataclass, field, fields, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from core.coverage.snapping import window_position
from core.records.arrays import Flags, Floats
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Material, Mesh, Scene, Texture
from core.settings import Settings
from core.stages.fragment_color import vertex_stage
from core.study.case_text import scene_text, settings_text
from core.study.cases import ExperimentInfo, Field, Kind, Parts
from core.study.family import Work, settings_of, timed_block
from core.study.frame_task import SceneWork
from core.study.record import Load, Opening, Outcome, Verdict
from core.study.workloads import flat_scene, outline_scene
from core.transform.matrices import camera_axes

# Kinds of cases: triangles in clip space, with values or textures; one segment; a lit mesh.


INSIDE = ((0.25, 0.125), (0.75, 0.125), (0.25, 0.875))
"""Places in the picture for the third corner of a segment's triangle, in widths and heights: one is beside it."""
MOST_TEXELS = 16
"""Numbers of a texture that are looked at one by one."""


def halves(parts: Parts) -> Iterator[tuple[int, int, int, tuple[int, int]]]:
    """Yield axis, first column or row, how many, and the size, of every half of the picture."""
    for axis, side in enumerate(parts.size):
        kept = side // 2
        for first in (0, side - kept) if kept else ():
            yield axis, first, kept, (kept, parts.size[1]) if axis == 0 else (parts.size[0], kept)


# Triangles.


def in_clip_space(scene: AnyScene) -> ClipScene:
    """Return the triangles of a scene after projection; one that is in clip space stays as it is."""
    if isinstance(scene, ClipScene):
        return scene
    vertices = vertex_stage(scene)
    return flat_scene(vertices.clip[vertices.corners], scene.size)


def triangles_of(scene: AnyScene) -> Parts:
    """Take triangles apart; their common corners are one vertex."""
    given = in_clip_space(scene)
    vertices, corners = np.unique(given.clip.reshape(-1, 4), axis=0, return_inverse=True)
    assert given.attributes is not None
    numbers = {"vertices": vertices, "values": given.attributes}
    if given.texture is not None:
        numbers["texels"] = given.texture.pixels.astype(np.float64)
    return Parts(corners.reshape(-1, 3).astype(np.int64), numbers, given.size, given)


def scene_of_triangles(parts: Parts) -> ClipScene:
    """Put triangles together."""
    assert isinstance(parts.scene, ClipScene)
    texels = parts.numbers.get("texels")
    return ClipScene(
        parts.numbers["vertices"][parts.elements],
        parts.numbers["values"],
        parts.size,
        None if texels is None else Texture(texels.astype(np.float32)),
        parts.scene.background,
        parts.elements,
    )


def cropped(parts: Parts) -> Iterator[Parts]:
    """Yield triangles with one half of the picture cut off, or at half the scale."""
    for axis, first, kept, size in halves(parts):
        # The place in pixels, (x + w) side / 2, moves by ``first``.
        vertices = parts.numbers["vertices"].copy()
        w = vertices[:, 3]
        vertices[:, axis] = ((vertices[:, axis] + w) * parts.size[axis] - 2 * first * w) / kept - w
        yield replace(parts.changed(vertices=vertices), size=size)
        if first:
            yield replace(parts, size=size)


def with_smaller_texture(parts: Parts) -> Iterator[Parts]:
    """Yield half of the texture, its texels unmoved or twice as wide; one channel; black and white."""
    texels = parts.numbers["texels"]
    for axis in (0, 1):
        kept = texels.shape[axis] // 2
        for first in (0, texels.shape[axis] - kept) if kept else ():
            part = np.take(texels, np.arange(first, first + kept), axis=axis)
            values = parts.numbers["values"].copy()
            # Rows of texels are v, the second coordinate.
            values[..., 1 - axis] *= texels.shape[axis] / kept
            yield parts.changed(texels=part, values=values)
            yield parts.changed(texels=part)
    if texels.shape[2] > 1:
        for channel in range(texels.shape[2]):
            yield parts.changed(texels=texels[..., channel : channel + 1])
    stark = (texels > (texels.min() + texels.max()) / 2).astype(np.float64)
    if (stark != texels).any():
        yield parts.changed(texels=stark)


CORNERS = Field("vertices", "vertex", (0.0, 0.0, 0.0, 1.0))
VALUES = Field("values", "element", is_tied=True)
FIXED_VALUES = replace(VALUES, most=0)
TRIANGLES = Kind("triangle", (CORNERS, FIXED_VALUES), triangles_of, scene_of_triangles, (cropped,))
"""Triangles of which only the shape matters; their colours stay."""
VALUED_TRIANGLES = replace(TRIANGLES, fields=(CORNERS, VALUES))
"""Triangles of which the values at the corners matter too."""
TEXTURED_TRIANGLES = replace(
    VALUED_TRIANGLES,
    fields=(CORNERS, VALUES, Field("texels", most=MOST_TEXELS)),
    crops=(cropped, with_smaller_texture),
)
"""Triangles with a texture."""


# One segment, the first edge of an outlined triangle.


def first_edge(scene: ClipScene) -> Floats:
    """Return the first edge (2, 2) of the first triangle in pixels; ValueError where it lies behind the eye."""
    ends = window_position(scene.clip[0, :2], scene.size)
    if not np.isfinite(ends).all():
        raise ValueError("the first edge must lie in front of the eye")
    return ends


def segment_of(scene: AnyScene) -> Parts:
    """Return the first edge of the first triangle of a scene in clip space, in pixels."""
    if not isinstance(scene, ClipScene):
        raise ValueError("a segment must be given as a triangle in clip space, got a scene of meshes")
    return Parts(np.array([[0, 1]]), {"ends": first_edge(scene)}, scene.size, scene)


def scene_of_segment(ends: Floats, size: tuple[int, int]) -> ClipScene:
    """Return a triangle whose first edge is the segment (2, 2), and whose third corner is in the picture.

    Raises ValueError if the ends are no numbers that clip space holds without rounding: what opens has to be what was
    judged.
    """
    (x0, y0), (x1, y1) = ([Fraction(value) for value in end] for end in ends.tolist())
    corners = [np.array(place) * size for place in INSIDE]
    third = corners[0]
    for corner in corners:
        x, y = (Fraction(value) for value in corner.tolist())
        if (x1 - x0) * (y - y0) != (x - x0) * (y1 - y0):
            third = corner
            break
    scene = outline_scene(ends, size, third)
    if not np.array_equal(first_edge(scene), ends):
        raise ValueError(f"the ends must be exact in clip space, got {ends.tolist()}")
    return scene


def shorter(parts: Parts) -> Iterator[Parts]:
    """Yield the segment without its first or last half, quarter, eighth ..., in whole pixels, but no point."""
    ends = parts.numbers["ends"]
    way, part = ends[1] - ends[0], 2.0
    while np.abs(way).max() >= part:
        step = np.rint(way / part)
        for turn in (np.array([step, 0 * step]), np.array([0 * step, -step])):
            if (ends[0] + turn[0] != ends[1] + turn[1]).any():
                yield parts.changed(ends=ends + turn)
        part *= 2


def cropped_around_segment(parts: Parts) -> Iterator[Parts]:
    """Yield the same with one half of the picture cut off, the segment staying where it is or moving along."""
    for axis, first, _, size in halves(parts):
        ends = parts.numbers["ends"].copy()
        ends[:, axis] -= first
        yield replace(parts.changed(ends=ends), size=size)


SEGMENTS = Kind(
    "segment",
    (Field("ends", simplest=(0.5,), offsets=(0.0, 0.5)),),
    segment_of,
    lambda parts: scene_of_segment(parts.numbers["ends"], parts.size),
    (shorter, cropped_around_segment),
)
"""One segment; what opens in the stepper and is saved is a triangle in outlines."""


# One mesh with normals under one distant light.


def lit_mesh_of(scene: AnyScene) -> Parts:
    """Take a scene of one mesh under one distant light apart; normals that are the positions stay so."""
    if not isinstance(scene, Scene) or len(scene.meshes) != 1 or len(scene.lights) != 1:
        raise ValueError("expected one mesh under one light, got another scene")
    (mesh,), (light,), camera = scene.meshes, scene.lights, scene.camera
    if mesh.normals is None or not isinstance(light, DirectionalLight):
        raise ValueError("expected a mesh with normals under a distant light, got another one")
    is_placed = not np.array_equal(mesh.transform, np.eye(4))
    if is_placed or mesh.colors is not None or mesh.texture is not None:
        raise ValueError("expected a mesh in its own place and of one material, got another one")
    is_perspective = camera.projection == "perspective"
    numbers = {
        "positions": mesh.positions,
        "eye": camera.eye,
        "target": camera.target,
        "opening": np.array([camera.field_of_view if is_perspective else camera.view_height]),
        "light": light.direction,
        "material": np.array(astuple(mesh.material)),
    }
    if not np.array_equal(mesh.normals, mesh.positions):
        numbers["normals"] = mesh.normals
    return Parts(mesh.triangles, numbers, scene.size, scene)


def camera_of(parts: Parts) -> Camera:
    """Return who looks at a lit mesh; the opening is the field of view in radians, or the height of the view."""
    assert isinstance(parts.scene, Scene)
    camera = replace(parts.scene.camera, eye=parts.numbers["eye"], target=parts.numbers["target"])
    opening = float(parts.numbers["opening"][0])
    if camera.projection == "perspective":
        return replace(camera, field_of_view=opening)
    return replace(camera, view_height=opening)


def scene_of_lit_mesh(parts: Parts) -> Scene:
    """Put the scene together."""
    assert isinstance(parts.scene, Scene)
    (mesh,), (light,) = parts.scene.meshes, parts.scene.lights
    assert isinstance(light, DirectionalLight)
    positions, material = parts.numbers["positions"], Material(*parts.numbers["material"].tolist())
    normals = parts.numbers.get("normals", positions)
    shape = replace(Mesh(positions, parts.elements, normals, name=mesh.name), material=material)
    lit_by = (replace(light, direction=parts.numbers["light"]),)
    return Scene((shape,), camera_of(parts), lit_by, parts.size, parts.scene.background)


def nearer_looks(parts: Parts) -> Iterator[Parts]:
    """Yield the same at half the scale, then its left, middle and right, lower, middle and upper half.

    Notes
    -----
    Of a perspective camera a part is seen by turning it there: not the same pixels, but as good.
    """
    width, height = parts.size
    if parts.size != (1, 1):
        yield replace(parts, size=(max(width // 2, 1), max(height // 2, 1)))
    for axis, side in enumerate(parts.size):
        kept = side // 2
        for first in sorted({0, (side - kept) // 2, side - kept}) if kept else ():
            yield _look_at_part(parts, axis, first, kept)


def _look_at_part(parts: Parts, axis: int, first: int, kept: int) -> Parts:
    """Return columns (axis 0) or rows (1) ``first`` to ``first + kept`` of the picture."""
    width, height = parts.size
    size = (kept, height) if axis == 0 else (width, kept)
    # The middle of what is kept, from the middle of the picture, in half heights.
    away = (2 * first + kept - parts.size[axis]) / height
    camera, opening = camera_of(parts), float(parts.numbers["opening"][0])
    way = camera_axes(camera)[axis] * away
    part = kept / height if axis == 1 else 1.0
    if camera.projection == "orthographic":
        shift, view = way * opening / 2, np.array([opening * part])
        parts = parts.changed(eye=parts.numbers["eye"] + shift)
    else:
        reach = np.tan(opening / 2)
        distance = float(np.linalg.norm(camera.target - camera.eye))
        shift, view = way * reach * distance, np.array([2 * np.arctan(reach * part)])
    return replace(parts.changed(target=parts.numbers["target"] + shift, opening=view), size=size)


LIT_MESHES = Kind(
    "triangle",
    (
        Field("positions", "vertex"),
        Field("normals", "vertex"),
        Field("eye"),
        Field("target"),
        Field("opening", simplest=(1.0,)),
        Field("light"),
        Field("material", simplest=(0.0, 0.0, 0.0, 1.0, 0.0)),
    ),
    lit_mesh_of,
    scene_of_lit_mesh,
    (nearer_looks,),
)
"""One mesh with normals under one distant light."""


# An experiment: scenes made from a place on its axes, every method's picture of them, and what is right for
# each.


class Case(SceneWork):
    """A scene of one kind, and what is right for it: the same for all methods."""

    def assertions(self, settings: Settings, made: Any, wrong: Flags) -> str:
        """Return the statements of a test of ``frame``, the picture, which fail where ``wrong`` (H, W) bool is set."""
        raise NotImplementedError

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test that holds once the method is right for the scene."""
        made = self.start(settings)()
        assertions = self.assertions(settings, made, self.judge(settings, made).wrong)
        return f"{scene_text(self.scene)}\nframe = render(scene, {settings_text(settings)})\n{assertions}"


@dataclass(frozen=True, eq=False)
class Experiment(ExperimentInfo):
    """Work that is made at any place of some axes, and judged; of scenes parts, pixels and digits can be left out."""

    make: Callable[[tuple[float, ...], int], Any]
    """The work at a place of the axes, for a seed; or a scene, of which `case_of` knows what is right."""
    case_of: Callable[..., Case] = Case
    """What is right for any scene of the kind; a ``ValueError`` where that is not known."""
    base: Settings = field(default_factory=Settings)
    """What the methods share."""
    kind: Kind = TRIANGLES
    """What the scenes are made of, and how they get smaller."""

    __hash__ = object.__hash__
    """An experiment is itself alone: others may ask the same of another scene."""

    def __eq__(self, other: object) -> bool:
        return self is other

    @property
    def can_shrink(self) -> bool:
        """Whether it is known what is right for any scene of the kind, so that a failing cell can be made smaller."""
        return self.case_of is not Case

    @property
    def info(self) -> ExperimentInfo:
        """What it asks."""
        return ExperimentInfo(**{each.name: getattr(self, each.name) for each in fields(ExperimentInfo)})

    def work(self, place: tuple[float, ...], seed: int) -> Work:
        """Return the work at a place, made anew."""
        made = self.make(place, seed)
        return made if isinstance(made, Work) else self.part(made)

    def part(self, scene: Any) -> Case:
        """Return any scene of the kind with what is right for it: ValueError where nobody knows."""
        return self.case_of(scene)

    def run(self, method: str, place: tuple[float, ...], seed: int) -> Verdict:
        """Run a method of ``methods`` at one value of every axis; nothing is assumed, all is run."""
        try:
            return _work(self, place, seed).run(settings_of(self.base, method)).verdict
        except ValueError as problem:
            return Verdict(Outcome.REFUSED, np.nan, str(problem))

    def time(self, method: str, place: tuple[float, ...], seed: int) -> float:
        """Return the seconds of that run, the least of a block; NaN where the method does not take the work."""
        try:
            return timed_block(_work(self, place, seed), settings_of(self.base, method), Load())[1]
        except ValueError:
            return np.nan

    def opening(self, method: str, place: tuple[float, ...], seed: int) -> Opening | None:
        """Return what opens in the stepper to look at that very run; ``None``: it is refused there too."""
        settings = settings_of(self.base, method)
        try:
            work = _work(self, place, seed)
            return work.opening(settings, work.start(settings)())
        except ValueError:
            return None

    def case(self, method: str, place: tuple[float, ...], seed: int) -> tuple[AnyScene, Settings]:
        """Return what is made smaller of the scene of one cell, and how the method draws it."""
        work = _work(self, place, seed)
        if not isinstance(work, Case):
            raise ValueError(f"nothing of {self.name} can be made smaller")
        return self.kind.as_case(work.scene), settings_of(self.base, method)

    def judge(self, scene: AnyScene, settings: Settings) -> Verdict:
        """Run any scene of the kind; ValueError where nobody knows what is right."""
        return self.part(scene).run(settings).verdict


@lru_cache(maxsize=1024)
def _work(experiment: Experiment, place: tuple[float, ...], seed: int) -> Work:
    """Return the work of one place: its reference is worked out once for all methods."""
    return experiment.work(place, seed)


class ExperimentTable:
    """Experiments by name, in the order of registration."""

    def __init__(self) -> None:
        self._experiments: dict[str, Experiment] = {}

    def __iter__(self) -> Iterator[Experiment]:
        return iter(self._experiments.values())

    def add(self, experiment: Experiment) -> None:
        """Register ``experiment``; a name that is taken is refused with ValueError."""
        name = experiment.name
        if name in self._experiments:
            raise ValueError(f"there is an experiment {name} already")
        self._experiments[name] = experiment

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the experiments."""
        return tuple(self._experiments)

    def get(self, name: str) -> Experiment:
        """Return one experiment, or raise ValueError with the names that there are."""
        if name not in self._experiments:
            raise ValueError(f"experiment must be one of {', '.join(self._experiments)}, got {name}")
        return self._experiments[name]


experiments = ExperimentTable()
"""All experiments of the program."""


def check_in_view_volume(scene: ClipScene) -> None:
    """Refuse triangles that are cut at the near or the far plane, or reach behind the eye.

    Raises ValueError if there is one.
    """
    z, w = scene.clip[..., 2], scene.clip[..., 3]
    bad = ((w <= 0) | (np.abs(z) > w)).any(axis=1)
    if bad.any():
        raise ValueError(
            f"every corner must be between the near and the far plane, triangle {int(np.argmax(bad))} is not"
        )
