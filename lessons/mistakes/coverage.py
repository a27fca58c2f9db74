"""Mistakes of coverage, of the window and of culling."""

from dataclasses import replace
from functools import partial

import numpy as np

from core import Settings
from core.coverage.snapping import snap
from core.records.arrays import Flags, Floats
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from lessons.mistakes.twin import Case, Twin, in_window
from lessons.small_scenes import rectangle_corners, triangle_scene

SQUARE = triangle_scene(rectangle_corners(0.5, 0.5, 4.5, 4.5), (6, 6))
"""Its sides and its diagonal run through pixel centres."""
FREE = triangle_scene([[(1.1, 1.2), (6.3, 2.1), (3.2, 6.4)]], (8, 8))
"""No pixel centre lies on its edges."""
WHOLE = triangle_scene([[(1, 1), (6, 2), (3, 6)]], (8, 8))
"""Its corners are whole numbers."""
EVERYWHERE = triangle_scene([[(-20, -20), (40, -20), (-20, 40)]], (6, 6))
LEVEL = triangle_scene([*rectangle_corners(1, 1, 4, 2.5), *rectangle_corners(1, 2.5, 4, 4)], (6, 6))
"""A level edge runs through the centres of row 2."""
THIN = triangle_scene([[(1.4, 1.4), (2.4, 1.4), (1.9, 8)]], (5, 9))
LOW = triangle_scene([[(1, 1.6), (6, 1.6), (3, 6.4)]], (8, 8))


def with_places(scene: ClipScene, places: Floats) -> ClipScene:
    """Return a scene whose corners lie at other places (T, 3, 2) in the window; depth and w are unchanged."""
    clip = scene.clip.copy()
    clip[..., :2] = (2 * places / scene.size - 1) * clip[..., 3:]
    return replace(scene, clip=clip)


def snapped(scene: ClipScene) -> Floats:
    """Return the corners as `in_window`, on the 1/256-pixel grid: 6.5 where the divide has left 6.499999999999998."""
    return snap(in_window(scene), np.inf)[0]


def rounded(scene: ClipScene) -> ClipScene:
    """Round all corners to whole pixels, half up."""
    return with_places(scene, np.floor(snapped(scene) + 0.5))


def rounded_to_even(scene: ClipScene) -> ClipScene:
    """Round all corners to whole pixels, half to even."""
    return with_places(scene, np.rint(snapped(scene)))


def rounded_rows(scene: ClipScene) -> ClipScene:
    """Round the y of all corners, half up."""
    places = in_window(scene)
    places[..., 1] = np.floor(snapped(scene)[..., 1] + 0.5)
    return with_places(scene, places)


def rounded_rows_to_even(scene: ClipScene) -> ClipScene:
    """Round the y of all corners, half to even."""
    places = in_window(scene)
    places[..., 1] = np.rint(snapped(scene)[..., 1])
    return with_places(scene, places)


def one_less(scene: ClipScene) -> ClipScene:
    """Scale NDC to a window that is one pixel narrower and lower."""
    return with_places(scene, in_window(scene) * (np.array(scene.size) - 1) / np.array(scene.size))


def y_down(scene: ClipScene) -> ClipScene:
    """Count y from the top; triangles keep their facing, as in a program that also exchanges it."""
    clip = scene.clip.copy()
    clip[..., 1] *= -1
    return replace(scene, clip=clip)


CLEARED = {"color": 0, "depth": 1, "primitive": -1, "attributes": 0, "cover_count": 0}
"""What the buffers of a frame hold where nothing is drawn; colours: those of the background."""


def transposed(frame: Frame, scene: AnyScene) -> Frame:
    """Exchange rows and columns; what falls out of the window is lost, what is missing is cleared."""
    buffers = {}
    for name, cleared in CLEARED.items():
        buffer = getattr(frame, name)
        turned = np.full_like(buffer, cleared)
        if name == "color":
            turned[:] = scene.background
        side = min(buffer.shape[:2])
        turned[:side, :side] = buffer[:side, :side].swapaxes(0, 1)
        buffers[name] = turned
    return replace(frame, **buffers)


def upside_down(frame: Frame, scene: AnyScene) -> Frame:
    """Exchange the upper and the lower rows."""
    return replace(frame, **{name: getattr(frame, name)[::-1] for name in CLEARED})


def moved_scene(shift: tuple[int, int], scene: ClipScene) -> ClipScene:
    """Move all corners by whole pixels in the window."""
    clip = scene.clip.copy()
    clip[..., :2] += 2 * np.array(shift) / scene.size * clip[..., 3:]
    return replace(scene, clip=clip)


def moved_picture(shift: tuple[int, int], frame: Frame, scene: AnyScene) -> Frame:
    """Store every pixel some columns to the right and rows up; what is missing is cleared."""
    buffers = {}
    (into_columns, from_columns), (into_rows, from_rows) = (
        (slice(max(step, 0), size + min(step, 0)), slice(max(-step, 0), size - max(step, 0)))
        for step, size in zip(shift, scene.size, strict=True)
    )
    for name, cleared in CLEARED.items():
        buffer = getattr(frame, name)
        moved = np.full_like(buffer, cleared)
        if name == "color":
            moved[:] = scene.background
        moved[into_rows, into_columns] = buffer[from_rows, from_columns]
        buffers[name] = moved
    return replace(frame, **buffers)


def short_box(frame: Frame, scene: ClipScene) -> Frame:
    """Leave out what lies in the column and the row of the truncated right and upper end of a triangle's box."""
    is_lost = np.zeros(frame.primitive.shape, bool)
    for triangle, (column, row) in enumerate(snapped(scene).max(axis=1).astype(int)):
        is_kept = np.zeros(is_lost.shape, bool)
        is_kept[: max(row, 0), : max(column, 0)] = True
        is_lost |= (frame.primitive == triangle) & ~is_kept
    buffers = {name: getattr(frame, name).copy() for name in CLEARED}
    for name, cleared in CLEARED.items():
        buffers[name][is_lost] = scene.background if name == "color" else cleared
    return replace(frame, **buffers)


def dropped_at_border(scene: ClipScene) -> ClipScene:
    """Drop triangles of which any corner lies outside of the view volume; the others keep their numbers."""
    is_outside = (np.abs(scene.clip[..., :3]) > scene.clip[..., 3:]).any(axis=(1, 2))
    clip = scene.clip.copy()
    clip[is_outside] = clip[is_outside][:, :1]
    return replace(scene, clip=clip)


def owns_slanted(a: Floats, b: Floats) -> Flags:
    """Own left edges, and never a level one."""
    return np.asarray(a > 0)


def owns_level(a: Floats, b: Floats) -> Flags:
    """Own left edges, and every level one."""
    return np.asarray(a >= 0)


def facing_exchanged(settings: Settings) -> Settings:
    """Drop front faces where back faces should go, and the other way round."""
    return replace(settings, cull={"back": "front", "front": "back"}.get(settings.cull, settings.cull))


DIRECTIONS = {
    "right": (1, 0),
    "left": (-1, 0),
    "up": (0, 1),
    "down": (0, -1),
    "up-and-right": (1, 1),
    "down-and-right": (1, -1),
    "up-and-left": (-1, 1),
    "down-and-left": (-1, -1),
}
SHIFTED = tuple(
    Twin(
        f"shifted-{name}",
        f"The picture lies one pixel too far {name.replace('-', ' ')}. Columns and rows are counted from 0.",
        Case(FREE),
        Case(EVERYWHERE),
        change_scene=partial(moved_scene, shift),
        change_picture=partial(moved_picture, shift),
    )
    for name, shift in DIRECTIONS.items()
)
"""Columns and rows that are counted from 1, or from the other side."""

TWINS = (
    Twin(
        "corner-for-center",
        "The pixel was tested at its lower left corner (i, j). Its centre (i + 1/2, j + 1/2) decides.",
        Case(WHOLE),
        Case(EVERYWHERE),
        change_settings=lambda settings: replace(settings, pixel_center="integer"),
    ),
    Twin(
        "all-edges-inclusive",
        "Every centre on an edge was counted (E >= 0). Of two triangles that share the edge only one owns it.",
        Case(SQUARE),
        Case(FREE),
        change_settings=lambda settings: replace(settings, fill_rule="inclusive"),
    ),
    Twin(
        "all-edges-exclusive",
        "No centre on an edge was counted (E > 0). Left edges, and level bottom edges, own theirs.",
        Case(SQUARE),
        Case(FREE),
        change_settings=lambda settings: replace(settings, fill_rule="exclusive"),
    ),
    Twin(
        "level-edges-never",
        "Centres on level edges were never counted. A level edge owns them where it is the bottom edge.",
        Case(LEVEL),
        Case(FREE),
        change_settings=lambda settings: settings.replaced(fill_rule=owns_slanted),
    ),
    Twin(
        "level-edges-always",
        "Centres on level edges were always counted. A level edge owns them only where it is the bottom edge.",
        Case(LEVEL),
        Case(FREE),
        change_settings=lambda settings: settings.replaced(fill_rule=owns_level),
    ),
    Twin(
        "vertices-rounded",
        "The vertices were rounded to whole pixels. They keep their fractions (to 1/256 pixel).",
        Case(THIN),
        Case(WHOLE),
        change_scene=rounded,
        other_scenes=(rounded_to_even,),
    ),
    Twin(
        "rows-rounded",
        "The y of the vertices was rounded to whole pixels. It keeps its fraction (to 1/256 pixel).",
        Case(LOW),
        Case(WHOLE),
        change_scene=rounded_rows,
        other_scenes=(rounded_rows_to_even,),
    ),
    Twin(
        "box-truncated",
        "The box ran from int(min) to int(max) - 1. It holds all pixels whose centres lie between min and max.",
        Case(triangle_scene([[(1, 1), (6.9, 1), (6.9, 6)]], (8, 8))),
        Case(WHOLE),
        change_frame=short_box,
    ),
    Twin(
        "dropped-at-border",
        "The triangle was dropped because a vertex lies outside. What is inside of the window is drawn.",
        Case(triangle_scene([[(1, 1), (12, 2), (3, 6)]], (8, 8))),
        Case(WHOLE),
        change_scene=dropped_at_border,
    ),
    Twin(
        "y-down",
        "The picture is upside down: y was counted from the top. Row 0 is the bottom row.",
        Case(FREE),
        Case(triangle_scene([[(1.1, 3), (5.3, 1.3), (5.3, 4.7)]], (6, 6))),
        change_scene=y_down,
        change_picture=upside_down,
    ),
    Twin(
        "window-one-less",
        "The window was taken for one pixel narrower and lower. NDC from -1 to 1 covers all W pixels, not W - 1.",
        Case(FREE),
        Case(triangle_scene([[(4.5, 0.5), (4, 5.5), (0.5, 0.5)]], (8, 8))),
        change_scene=one_less,
    ),
    Twin(
        "rows-and-columns",
        "Rows and columns are exchanged. A pixel is (column, row): x first.",
        Case(FREE),
        Case(triangle_scene([[(1.1, 1.1), (5.3, 1.3), (1.3, 5.3)]], (6, 6))),
        change_frame=transposed,
        change_picture=transposed,
    ),
    Twin(
        "facing-exchanged",
        "The facing is exchanged: counter-clockwise triangles are the front.",
        Case(FREE, Settings(cull="back")),
        Case(FREE),
        change_settings=facing_exchanged,
    ),
    *SHIFTED,
)
