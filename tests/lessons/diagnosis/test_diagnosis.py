"""Pictures of plain rasterizers with one planted mistake each: named where it is on the shelf, unknown where not."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import lessons.diagnosis
from core import Settings, render
from core.framebuffer.display import to_display
from core.scene import ClipScene
from core.setting_texts import settings_from_texts
from core.settings import DEFAULTS
from core.transform.vertex_stage import transform_vertices
from lessons.diagnosis import PIXEL_LIMIT, RIGHT, Diagnosis, Drawn, compared_text, diagnose
from lessons.lectures.scenes import ALL_SCENES
from lessons.mistakes.coverage import rounded
from lessons.scenes import BuiltInScene, make_scene
from lessons.small_scenes import pixel_segments, triangle_scene
from tests.covering import every_nth
from tests.lessons.diagnosis.plain_rasterizer import Homework, bresenham, over, perspective, shown

SIZE = (16, 12)
RED, GREEN, BLUE = (1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)
WHITE = (1.0, 1.0, 1.0, 1.0)


def corners(places, colors, depth=(0.5, 0.5, 0.5), w=(1, 1, 1)):
    return tuple((*place, z, k, color) for place, z, k, color in zip(places, depth, w, colors, strict=True))


FLAT = [
    corners([(0.5, 0.5), (8.5, 0.5), (8.5, 8.5)], (RED, GREEN, BLUE)),
    corners([(0.5, 0.5), (8.5, 8.5), (0.5, 8.5)], (RED, BLUE, WHITE)),
    corners([(9.25, 2.25), (14.75, 3.5), (11.5, 9.25)], (BLUE, RED, GREEN)),
    corners([(12, 8), (22, 7.5), (13, 11.5)], (GREEN, WHITE, RED)),
]
DEEP = [
    corners([(1, 1), (14, 2), (4, 11)], (RED, GREEN, BLUE), (0.2, 0.7, 0.4), (1, 3, 2)),
    corners([(2, 9), (3, 1), (15, 8)], (WHITE, BLUE, GREEN), (0.6, 0.1, 0.5), (2, 1, 4)),
    corners([(6, 0.5), (15, 1), (9, 7)], (RED, WHITE, GREEN), (0.9, 0.8, 0.95), (1, 2, 1)),
]
CLEAR = [(*color[:3], alpha) for color, alpha in zip((RED, GREEN, BLUE), (0.5, 0.25, 0.75), strict=True)]
GLASS = [
    corners([(1, 1), (14, 2), (4, 11)], (CLEAR[0],) * 3),
    corners([(2, 9), (3, 1), (15, 8)], (CLEAR[1],) * 3),
    corners([(6, 0.5), (15, 1), (9, 7)], (CLEAR[2],) * 3),
]
BLENDED = Settings(blend="over", visibility="last-drawn")
LINES = [(1, 1, 9, 4), (2, 11, 4, 2), (15, 9, 6, 5), (0, 6, 7, 10)]
LECTURE = Settings(line="bresenham-lecture")


@pytest.fixture(autouse=True, scope="module")
def drawn_once() -> Iterator[None]:
    """Draw the candidates of a scene for the first picture of it only."""

    made = lessons.diagnosis.candidates

    @cache
    def candidates(scene, settings):
        return [replace(each, draw=cache(each.draw)) for each in made(scene, settings)]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lessons.diagnosis, "candidates", candidates)
        yield


def scene_of(triangles) -> ClipScene:
    return _scene_of(tuple(triangles))


@cache
def _scene_of(triangles) -> ClipScene:
    places = [[corner[:2] for corner in triangle] for triangle in triangles]
    depth, w, colors = ([[corner[k] for corner in triangle] for triangle in triangles] for k in (2, 3, 4))
    scene = triangle_scene(places, SIZE, depth, w, colors)
    return replace(scene, background=np.array([0.0, 0.0, 0.0, 1.0]))


def diagnosed(triangles, picture, settings: Settings = DEFAULTS) -> Diagnosis:
    return diagnose(scene_of(triangles), settings, Drawn(colors=np.array(shown(picture), np.uint8)))


def lines_diagnosed(**planted) -> Diagnosis:
    covered = np.zeros(SIZE[::-1], bool)
    for line in LINES:
        for column, row in bresenham(*line, **planted):
            if 0 <= column < SIZE[0] and 0 <= row < SIZE[1]:
                covered[row, column] = True
    scene = pixel_segments([((x0, y0), (x1, y1)) for x0, y0, x1, y1 in LINES], SIZE)
    return diagnose(scene, LECTURE, Drawn(covered=covered))


def flat(**planted) -> Diagnosis:
    return diagnosed(FLAT, Homework(**planted).draw(FLAT, *SIZE))


def deep(**planted) -> Diagnosis:
    return diagnosed(DEEP, Homework(**planted).draw(DEEP, *SIZE))


def glass(**planted) -> Diagnosis:
    picture = Homework(blend=over, passes=lambda new, old: True, **planted).draw(GLASS, *SIZE)
    return diagnosed(GLASS, picture, BLENDED)


def moved(change: Callable, triangles=FLAT) -> Diagnosis:
    """Draw other triangles than were given."""
    other = [tuple(change(corner) for corner in triangle) for triangle in triangles]
    return diagnosed(triangles, Homework().draw(other, *SIZE))


def on_picture(change: Callable) -> Diagnosis:
    """Store pixels wrongly that were drawn well."""
    return diagnosed(FLAT, change(Homework().draw(FLAT, *SIZE)))


def blended(blend: Callable) -> Diagnosis:
    picture = Homework(blend=blend, passes=lambda new, old: True).draw(GLASS, *SIZE)
    return diagnosed(GLASS, picture, BLENDED)


def in_srgb(source, there):
    def encoded(value):
        return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055

    def decoded(value):
        return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4

    mixed = over((*map(encoded, source[:3]), source[3]), (*map(encoded, there[:3]), there[3]))
    return (*map(decoded, mixed[:3]), mixed[3])


def turned(picture):
    return [
        [picture[i][j] if i < SIZE[1] and j < SIZE[0] else BLACK for i in range(SIZE[0])]
        for j in range(SIZE[1])
    ]


BLACK = (0.0, 0.0, 0.0, 1.0)
PLANTED = {
    "corner-for-center": lambda: flat(center=(0, 0)),
    "all-edges-inclusive": lambda: flat(covers=lambda e, owner: e >= 0),
    "all-edges-exclusive": lambda: flat(covers=lambda e, owner: e > 0),
    "level-edges-never": lambda: flat(owns=lambda ax, ay, bx, by: by < ay),
    "vertices-rounded": lambda: moved(lambda c: (int(c[0] + 0.5), int(c[1] + 0.5), *c[2:])),
    "y-down": lambda: moved(lambda c: (c[0], SIZE[1] - c[1], *c[2:])),
    "rows-and-columns": lambda: on_picture(turned),
    "box-truncated": lambda: flat(
        last=lambda i, j, abc: i >= int(max(c[0] for c in abc)) or j >= int(max(c[1] for c in abc))
    ),
    "dropped-at-border": lambda: diagnosed(FLAT, Homework().draw(FLAT[:3], *SIZE)),
    "weights-permuted": lambda: moved_colors(),
    "affine-for-perspective": lambda: deep(interpolate=lambda k, w, v: sum(map(float.__mul__, k, v))),
    "not-divided-back": lambda: deep(
        interpolate=lambda k, w, v: sum(a * u / b for a, b, u in zip(k, w, v, strict=True))
    ),
    "multiplied-by-w": lambda: deep(interpolate=lambda k, w, v: perspective(k, [1 / one for one in w], v)),
    "farther-wins": lambda: deep(passes=lambda new, old: new > old, cleared=0.0),
    "no-depth-test": lambda: deep(passes=lambda new, old: True),
    "order-reversed": lambda: diagnosed(
        GLASS, Homework(blend=over, passes=lambda new, old: True).draw(GLASS[::-1], *SIZE), BLENDED
    ),
    "multiplied-twice": lambda: blended(lambda s, t: over((*(s[3] * v for v in s[:3]), s[3]), t)),
    "blended-in-srgb": lambda: blended(in_srgb),
    "ties-step": lambda: lines_diagnosed(ties=True),
    "not-corrected": lambda: lines_diagnosed(corrected=False),
    "slope-always-up": lambda: lines_diagnosed(down=1),
    "last-pixel-lost": lambda: lines_diagnosed(last=0),
}


def on_coverage(change: Callable) -> Diagnosis:
    """Cover other pixels than were covered well."""
    covered = (np.array(shown(Homework().draw(FLAT, *SIZE))) > 0).any(axis=2)
    return diagnose(scene_of(FLAT), DEFAULTS, Drawn(covered=change(covered)))


def each_pixel(change: Callable) -> Diagnosis:
    """Change every colour (red, green, blue), at its column and row."""
    return on_picture(
        lambda rows: [[(*change(c[:3], i, j), 1.0) for i, c in enumerate(r)] for j, r in enumerate(rows)]
    )


def shifted(columns: int, rows: int) -> Diagnosis:
    def change(picture):
        places = [[(i - columns, j - rows) for i in range(SIZE[0])] for j in range(SIZE[1])]
        return [
            [picture[j][i] if 0 <= i < SIZE[0] and 0 <= j < SIZE[1] else BLACK for i, j in row]
            for row in places
        ]

    return on_picture(change)


NOISE = np.random.default_rng(1).random(SIZE[::-1])
PLANTED |= {
    "shifted-right": lambda: shifted(1, 0),
    "shifted-up": lambda: moved(lambda c: (c[0], c[1] + 1, *c[2:])),
    "shifted-down-and-left": lambda: shifted(-1, -1),
    "red-and-blue-exchanged": lambda: each_pixel(lambda c, i, j: c[::-1]),
    "inclusive-without-depth": lambda: flat(
        covers=lambda e, owner: e >= 0, passes=lambda new, old: True, cleared=1.0
    ),
    "first-drawn-wins": lambda: deep(passes=lambda new, old: old == 1.0),
}
OFF_THE_SHELF = {
    "a quarter for the centre": lambda: flat(center=(0.25, 0.25)),
    "the upper right corner for the centre": lambda: flat(center=(1, 1)),
    "right edges own": lambda: flat(owns=lambda ax, ay, bx, by: by > ay or (by == ay and bx < ax)),
    "a wide tolerance": lambda: flat(covers=lambda e, owner: e > -3),
    "two columns to the right": lambda: shifted(2, 0),
    "two rows up": lambda: shifted(0, 2),
    "half a pixel to the right": lambda: moved(lambda c: (c[0] + 0.5, *c[1:])),
    "half as large": lambda: moved(lambda c: (c[0] / 2, c[1] / 2, *c[2:])),
    "twice as large": lambda: moved(lambda c: (c[0] * 2, c[1] * 2, *c[2:])),
    "stretched": lambda: moved(lambda c: (c[0] * 1.1, *c[1:])),
    "mirrored": lambda: on_picture(lambda rows: [row[::-1] for row in rows]),
    "rows turned round in a ring": lambda: on_picture(lambda rows: rows[4:] + rows[:4]),
    "every second row": lambda: each_pixel(lambda c, i, j: c if j % 2 else (0, 0, 0)),
    "every second column": lambda: each_pixel(lambda c, i, j: c if i % 2 else (0, 0, 0)),
    "the lower half": lambda: each_pixel(lambda c, i, j: c if j < 6 else (0, 0, 0)),
    "only the first triangle": lambda: diagnosed(FLAT, Homework().draw(FLAT[:1], *SIZE)),
    "the second triangle missing": lambda: diagnosed(FLAT, Homework().draw(FLAT[:1] + FLAT[2:], *SIZE)),
    "weights squared": lambda: deep(weights=lambda k: [one * one for one in k]),
    "two weights exchanged": lambda: deep(weights=lambda k: [k[0], k[2], k[1]]),
    "depth not cleared": lambda: deep(cleared=0.45),
    "depths in four steps": lambda: deep(passes=lambda new, old: int(new * 4) < int(old * 4)),
    "always half": lambda: blended(lambda s, t: over((*s[:3], 0.5), t)),
    "D begins at 2 dy": lambda: lines_diagnosed(start=lambda dx, dy: 2 * dy),
    "D begins at 0": lambda: lines_diagnosed(start=lambda dx, dy: 0),
    "gamma twice": lambda: each_pixel(lambda c, i, j: tuple(v ** (1 / 2.2) for v in c)),
    "inverted colours": lambda: each_pixel(lambda c, i, j: tuple(1 - v for v in c)),
    "red and green exchanged": lambda: each_pixel(lambda c, i, j: (c[1], c[0], c[2])),
    "a square in the corner": lambda: on_coverage(lambda c: (np.indices(c.shape) < 4).all(axis=0)),
    "a few wrong pixels": lambda: on_coverage(lambda c: c ^ (NOISE < 0.03)),
    "many wrong pixels": lambda: on_coverage(lambda c: c ^ (NOISE < 0.2)),
    "all is covered": lambda: on_coverage(np.ones_like),
    "dilated": lambda: on_coverage(lambda c: c | np.roll(c, 1, 0) | np.roll(c, -1, 0) | np.roll(c, 1, 1)),
}


def moved_colors() -> Diagnosis:
    """Give each corner the colour of the one before."""
    other = [tuple((*triangle[k][:4], triangle[k - 1][4]) for k in range(3)) for triangle in FLAT]
    return diagnosed(FLAT, Homework().draw(other, *SIZE))


@pytest.mark.slow
@pytest.mark.parametrize("draw", [flat, deep, glass, lines_diagnosed])
def test_homework_without_a_mistake_is_right(draw) -> None:
    assert draw().is_right


@pytest.mark.parametrize("name", every_nth(["multiplied-by-w", "ties-step"], 2))
def test_a_planted_mistake_is_named(name: str) -> None:
    assert name in [each.name for each in PLANTED[name]().found if each.is_mistake]


@pytest.mark.slow
def test_planted_mistakes_are_named() -> None:
    found = {name: [each.name for each in draw().found if each.is_mistake] for name, draw in PLANTED.items()}
    missed = {name: names for name, names in found.items() if name not in names}
    assert len(PLANTED) >= 20
    assert missed == {}


@pytest.mark.slow
def test_mistakes_off_the_shelf_are_unknown_and_no_innocent_one_is_named() -> None:
    assert len(OFF_THE_SHELF) >= 30
    for name in OFF_THE_SHELF:
        test_an_unknown_mistake_has_no_name(name)


@pytest.mark.parametrize("name", ["two columns to the right"])
def test_an_unknown_mistake_has_no_name(name: str) -> None:
    diagnosis = OFF_THE_SHELF[name]()
    assert not diagnosis.is_right, name
    assert ([each.name for each in diagnosis.found], diagnosis.nearest.name) == ([], RIGHT), name
    assert (diagnosis.differing == diagnosis.from_right).all()


def test_the_nearest_is_a_mistake_that_explains_most_of_what_differs() -> None:
    diagnosis = flat(covers=lambda e, owner: e > 1)
    assert (diagnosis.found, diagnosis.nearest.name) == ((), "all-edges-exclusive")
    assert diagnosis.differing.sum() * 4 <= diagnosis.from_right.sum()


def test_corners_are_rounded_as_they_are_given_half_up_or_to_even() -> None:
    """The divide leaves 6.499999999999998 of a corner at 6.5."""
    triangles = [corners([(6.5, 2.5), (14.5, 3.5), (9.5, 10.5)], (RED, GREEN, BLUE), w=(3, 7, 5))]
    for change in (round, lambda x: int(x + 0.5)):
        found = moved(lambda c, change=change: (change(c[0]), change(c[1]), *c[2:]), triangles).found
        assert "vertices-rounded" in [each.name for each in found]


def test_what_was_compared_goes_with_a_right_picture() -> None:
    """A picture in one colour shows which pixels are covered, and nothing of the colours of its scene."""
    colors = np.array(shown(Homework().draw(FLAT, *SIZE)), np.uint8)
    ink = np.where((colors > 0).any(axis=2, keepdims=True), 255, 0).astype(np.uint8).repeat(3, axis=2)
    scene = scene_of(FLAT)
    for drawn, wanted in (
        (Drawn(colors=colors), "the colours of all pixels. Not compared: depths and numbers of triangles"),
        (Drawn(colors=ink), "which pixels are covered. Not compared: colours, depths and numbers"),
        (
            Drawn(primitive=render(scene).primitive),
            "which triangle is seen at each pixel. Not compared: colours",
        ),
    ):
        diagnosis = diagnose(scene, DEFAULTS, drawn)
        assert diagnosis.is_right
        assert wanted in compared_text(diagnosis.drawn)
    other = np.where((colors == 0).all(axis=2, keepdims=True), np.uint8((9, 8, 7)), colors)
    assert "The colour (9, 8, 7) counts as the background" in compared_text(
        diagnose(scene, DEFAULTS, Drawn(other)).drawn
    )


@pytest.mark.parametrize("turn", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_weights_are_permuted_either_way(turn: int) -> None:
    other = [
        tuple((*triangle[k][:4], triangle[(k + turn) % 3][4]) for k in range(3)) for triangle in FLAT[2:3]
    ]
    found = diagnosed(FLAT[2:3], Homework().draw(other, *SIZE)).found
    assert [each.name for each in found] == ["weights-permuted"]


@pytest.mark.parametrize(
    ("name", "planted"),
    every_nth([("last-pixel-lost", {"last": 0}), ("not-corrected", {"corrected": False})], 2),
)
def test_a_line_is_known_by_the_rule_of_its_scene(name: str, planted: dict) -> None:
    covered = np.zeros((12, 16), bool)
    for column, row in bresenham(1, 1, 9, 4, ties=True, **planted):
        covered[row, column] = True
    found = diagnose(make_scene("segment"), DEFAULTS, Drawn(covered=covered)).found
    assert name in [each.name for each in found]


@pytest.mark.slow
def test_a_mistake_of_points_is_none_of_triangles() -> None:
    scene = ALL_SCENES["zwicker-4x3"].make()
    drawn = render(scene, Settings(pixel_center="integer"))
    found = diagnose(scene, DEFAULTS, Drawn(primitive=drawn.primitive)).found
    assert [each.name for each in found if each.is_mistake] == ["corner-for-center"]


def test_a_mistake_of_blending_is_none_where_nothing_is_blended() -> None:
    black = Drawn(colors=np.zeros((12, 16, 3), np.uint8))
    found = diagnose(scene_of(FLAT), DEFAULTS, black).found
    assert [each.name for each in found if each.is_mistake] == ["cleared-to-near"]


def test_how_near_the_nearest_is() -> None:
    picture = Homework().draw(FLAT, *SIZE)
    picture[4][3] = picture[0][15] = WHITE
    diagnosis = diagnosed(FLAT, picture)
    assert not diagnosis.is_right
    assert (diagnosis.found, diagnosis.nearest.name) == ((), "the right picture")
    assert np.argwhere(diagnosis.differing).tolist() == [[0, 15], [4, 3]]


def test_colours_a_byte_apart_and_any_background_are_equal() -> None:
    colors = np.array(shown(Homework().draw(FLAT, *SIZE)), np.int64)
    near = np.clip(colors + np.indices(colors.shape).sum(axis=0) % 3 - 1, 0, 255)
    near[(colors == 0).all(axis=2)] = (250, 251, 252)
    assert diagnose(scene_of(FLAT), Settings(), Drawn(colors=near.astype(np.uint8))).is_right
    near[2, 3] += 2
    assert not diagnose(scene_of(FLAT), Settings(), Drawn(colors=near.astype(np.uint8))).is_right


def test_two_colours_show_what_is_covered() -> None:
    frame = render(scene_of(FLAT), Settings(fill_rule="inclusive"))
    colors = np.where((frame.primitive >= 0)[..., None], (0, 0, 0), (255, 255, 255)).astype(np.uint8)
    found = diagnose(scene_of(FLAT), Settings(), Drawn(colors=colors)).found
    assert next(each.name for each in found if each.is_mistake) == "all-edges-inclusive"
    assert "fill_rule=inclusive" in [each.name for each in found if not each.is_mistake]


def test_a_grey_picture_of_a_coloured_scene_is_named_with_its_mistake() -> None:
    colors = np.array(shown(Homework(center=(0, 0)).draw(FLAT, *SIZE)), float)
    grey = np.repeat((colors @ (0.2126, 0.7152, 0.0722)).round()[..., None], 3, axis=2).astype(np.uint8)
    diagnosis = diagnose(scene_of(FLAT), DEFAULTS, Drawn(colors=grey))
    assert not diagnosis.is_right
    assert [each.name for each in diagnosis.found if each.is_mistake] == ["grey", "corner-for-center"]
    assert "0.2126 R" in diagnosis.found[0].sentence
    grey[0, 15] = 255
    other = diagnose(scene_of(FLAT), DEFAULTS, Drawn(colors=grey))
    assert (other.found, other.nearest.name.endswith(" in grey")) == ((), True)
    assert np.argwhere(other.differing).tolist() == [[0, 15]]


def test_one_colour_in_place_of_another_is_named() -> None:
    full = triangle_scene([[(-30, -30), (40, -30), (4, 60)]], (12, 8), attributes=[[RED] * 3])
    green = np.full((8, 12, 3), (0, 255, 0), np.uint8)
    named = diagnose(full, DEFAULTS, Drawn(colors=green)).found[0]
    assert named.name == "another-colour"
    assert named.sentence == "Every pixel has the colour (0, 255, 0) instead of (255, 0, 0)."
    # A scene without colours is drawn in black: another colour is none of its texture.
    bare = replace(triangle_scene([[(1.5, 1.5), (9.5, 1.5), (4, 6)]], (12, 8)), attributes=None)
    ink = green * (render(bare).primitive >= 0)[..., None]
    assert diagnose(bare, DEFAULTS, Drawn(colors=ink)).is_right


def test_a_picture_with_nothing_in_it_is_not_right_where_something_is_drawn() -> None:
    """A scene without colours is drawn in black: an all-black picture would equal it."""
    scene = replace(triangle_scene([[(1.5, 1.5), (9.5, 1.5), (4, 6)]], (12, 8)), attributes=None)
    primitive = render(scene, DEFAULTS).primitive
    for ink in (0, 255):
        nothing = diagnose(scene, DEFAULTS, Drawn(colors=np.full((8, 12, 3), ink, np.uint8)))
        assert not nothing.is_right
        assert (nothing.from_right == (primitive >= 0)).all()
    full = triangle_scene([[(-30, -30), (40, -30), (4, 60)]], (12, 8))
    assert diagnose(full, DEFAULTS, Drawn(colors=np.zeros((8, 12, 3), np.uint8))).is_right


@pytest.mark.slow
def test_a_picture_saved_from_the_wrong_end_is_known_whatever_the_scene() -> None:
    for scene in (scene_of(FLAT), replace(make_scene("cube"), size=(24, 16))):
        pixels = to_display(render(scene).color).pixels[::-1, :, :3]
        names = [each.name for each in diagnose(scene, Settings(), Drawn(colors=pixels)).found]
        assert names.count("y-down") == 1


@pytest.mark.slow
def test_a_mesh_is_diagnosed_by_its_coverage_and_by_its_colours() -> None:
    scene = replace(make_scene("cube"), size=(24, 16))
    unlit = Settings(shading="unlit")
    for settings, drawn in (
        (unlit, lambda frame: Drawn(colors=to_display(frame.color).pixels[..., :3])),
        (DEFAULTS, lambda frame: Drawn(primitive=frame.primitive)),
    ):
        assert diagnose(scene, settings, drawn(render(scene, settings))).is_right
        stage = transform_vertices(scene)
        colors = np.concatenate([mesh.colors for mesh in scene.meshes])[stage.corners]
        corners = ClipScene(stage.clip[stage.corners], colors, scene.size)
        found = diagnose(scene, settings, drawn(render(rounded(corners), settings))).found
        assert "vertices-rounded" in [each.name for each in found]


@pytest.mark.parametrize("size", [(15, 12), (1000, 1000)])
def test_another_size_or_too_many_pixels_are_refused(size) -> None:
    covered = np.zeros(size[::-1], bool)
    scene = replace(scene_of(FLAT), size=size if size[0] * size[1] > PIXEL_LIMIT else SIZE)
    with pytest.raises(ValueError, match=r"expected a picture of (16 x 12|up to 262144) pixels, got "):
        diagnose(scene, Settings(), Drawn(covered=covered))


@pytest.mark.slow
@pytest.mark.parametrize("built_in", ALL_SCENES.values(), ids=ALL_SCENES)
def test_every_scene_is_right_as_it_is_drawn(built_in: BuiltInScene) -> None:
    scene, settings = built_in.make(), settings_from_texts(dict(built_in.settings))
    if scene.size[0] > 100:
        scene = replace(scene, size=(24, 16))
    frame = render(scene, settings)
    for drawn in (Drawn(colors=to_display(frame.color).pixels[..., :3]), Drawn(primitive=frame.primitive)):
        assert diagnose(scene, settings, drawn).is_right
