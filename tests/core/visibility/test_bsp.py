"""Laws of the painter's algorithm with a BSP tree: against rational arithmetic, and against exact rays."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings

from core import Camera, ClipScene, Mesh, Scene, Settings, render
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.stages.fragment_color import vertex_stage
from core.visibility.bsp import BACK, CUT, FRONT, LARGEST_TREE, ON, BspTree, build_tree, plane_of
from tests.core.exact_reference import determinant
from tests.core.strategies import ANY_TRIANGLES
from tests.covering import every_nth

SNAPPING = 2**0.5 / 256
SIZE = (48, 36)


def crossing(count: int, seed: int, behind: float = 0.0) -> np.ndarray:
    """Return triangles (count, 3, 4) of one perspective that pass through each other, some partly behind the eye."""
    source = np.random.default_rng(seed)
    w = source.uniform(1, 4, (count, 3))
    w[source.random((count, 3)) < behind] *= -0.5
    place = source.uniform(-1, 1, (count, 1, 2)) + source.normal(0, 0.5, (count, 3, 2))
    return np.concatenate([place * w[..., None], (5 * w[..., None] - 8) / 3, w[..., None]], axis=2)


def seen(clip: np.ndarray, visibility: str, **choices: str) -> np.ndarray:
    scene = ClipScene(clip, size=SIZE)
    return render(scene, Settings(visibility=visibility, cull="none", **choices)).primitive


def in_window(clip: np.ndarray) -> np.ndarray:
    """Return lines a x + b y + c of pixels through the sides of triangles (Q, 3, 4): (Q, 3, 3), a and b of length 1."""
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    place = np.stack([(x + w) * SIZE[0] / 2, (y + w) * SIZE[1] / 2, w], axis=2)
    line = np.cross(place, np.roll(place, -1, axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        return line / np.hypot(line[..., 0], line[..., 1])[..., None]


def nearest_side(clip: np.ndarray, column: int, row: int) -> float:
    """Return how many pixels a centre lies from the nearest line through a side of any piece."""
    return float(np.nanmin(np.abs(in_window(clip) @ [column + 0.5, row + 0.5, 1.0])))


@pytest.mark.parametrize(("count", "behind"), every_nth([(6, 0.0), (14, 0.0), (14, 0.3), (40, 0.0)], 2))
def test_it_shows_what_exact_rays_meet_as_far_from_sides_as_corners_are_snapped(
    count: int, behind: float
) -> None:
    compared = wrong = 0
    for seed in range(4):
        clip = crossing(count, seed, behind)
        tree = build_tree(clip)
        rays, painted = seen(clip, "ray-casting"), seen(clip, "bsp")
        assert (painted >= 0).sum() > 0
        compared, wrong = compared + painted.size, wrong + int((seen(clip, "painters") != rays).sum())
        for row, column in np.argwhere(painted != rays):
            assert nearest_side(tree.clip[tree.drawn], column, row) <= SNAPPING
    assert wrong > compared / 500, "these scenes must be ones that the painter's algorithm fails on"


@settings(max_examples=30)
@given(ANY_TRIANGLES)
def test_any_triangles_are_drawn_as_rays_see_them_or_by_a_side(case) -> None:
    clip = np.asarray(case[0] if isinstance(case, tuple) else case, float)
    tree, rays, painted = build_tree(clip), seen(clip, "ray-casting"), seen(clip, "bsp")
    for row, column in np.argwhere(painted != rays):
        assert nearest_side(np.concatenate([clip, tree.clip]), column, row) <= 2 * SNAPPING


def as_fractions(numbers) -> list[Fraction]:
    return [Fraction(float(number)) for number in numbers]


def area(shares: list[list[Fraction]]) -> Fraction:
    """Return the area of a piece as a part of its triangle's, in affine coordinates of clip space."""
    return abs(determinant(*(tuple(corner) for corner in shares)))


def exact_cuts(tree: BspTree) -> None:
    """Cut by rational planes again: sides are the same, and the parts of every cut add up to what was cut."""
    corners = [[as_fractions(corner) for corner in piece] for piece in tree.clip.tolist()]
    for row, (node, piece) in enumerate(zip(tree.tested_at.tolist(), tree.tested.tolist(), strict=True)):
        plane = plane_of(*(as_fractions(corner) for corner in tree.clip[tree.triangle[tree.root[node]]]))
        d = [sum(p * q for p, q in zip(plane, corner, strict=True)) for corner in corners[piece]]
        size = [sum(abs(p * q) for p, q in zip(plane, corner, strict=True)) for corner in corners[piece]]
        d = [0 if abs(x) <= Fraction(1, 10**11) * s else x for x, s in zip(d, size, strict=True)]
        side = ON if not any(d) else FRONT if min(d) >= 0 else BACK if max(d) <= 0 else CUT
        assert side == tree.side[row]
        if side != CUT:
            continue
        first, (before, behind) = int(tree.first_made[row]), tree.made[row].tolist()
        made = range(first, first + before + behind)
        parts = [area([as_fractions(corner) for corner in tree.shares[k]]) for k in made]
        whole = area([as_fractions(corner) for corner in tree.shares[piece]])
        assert abs(sum(parts) - whole) <= Fraction(1, 2**48), "nothing is lost and nothing is twice there"
        for k in made:
            assert tree.triangle[k] == tree.triangle[piece]
            value = tree.clip[k] @ tree.plane[node]
            assert (value if k < first + before else -value).min() >= -1e-9


@pytest.mark.parametrize("behind", [0.0, 0.3])
def test_sides_are_those_of_rational_planes_and_areas_add_up(behind: float) -> None:
    clip = crossing(10, 3, behind)
    tree = build_tree(clip)
    exact_cuts(tree)
    shares = np.array(
        [float(area([as_fractions(c) for c in piece])) for piece in tree.shares[tree.drawn].tolist()]
    )
    sums = np.bincount(tree.triangle[tree.drawn], shares)
    assert np.allclose(sums, 1, atol=1e-12, rtol=0)


def test_cuts_at_halves_add_up_exactly() -> None:
    across = np.array([[-1.0, -1, -0.5, 1], [1, -1, -0.5, 1], [0, 1, 0.5, 1]])
    level = np.array([[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]])
    tree = build_tree(np.stack([level, across]))
    assert sorted(tree.made[0].tolist()) == [1, 2]
    parts = [area([as_fractions(corner) for corner in tree.shares[k]]) for k in tree.drawn if tree.number[k]]
    assert sum(parts) == 1


def test_the_tree_does_not_know_the_camera() -> None:
    positions = np.random.default_rng(5).uniform(-1, 1, (24, 3))
    mesh = Mesh(positions, np.arange(24).reshape(8, 3))
    trees = []
    for position in ([0.0, 0.5, 4], [3, 1, -2], [-2, -2, 2]):
        for projection in ("perspective", "orthographic"):
            camera = Camera(np.array(position), np.zeros(3), projection=projection)
            vertices = vertex_stage(Scene((mesh,), camera, size=SIZE))
            trees.append(build_tree(vertices.clip[vertices.corners]))
    first, *others = trees
    for other in others:
        for name in ("triangle", "number", "node", "parent", "halves", "side"):
            assert np.array_equal(getattr(first, name), getattr(other, name)), name
    assert len({tuple(tree.walk.tolist()) for tree in trees}) > 1, "only the walk changes"


def test_nothing_is_cut_where_nothing_crosses_a_plane() -> None:
    layers = np.repeat(crossing(1, 0), 7, axis=0)
    layers[..., 2] = np.arange(7)[:, None] / 20 * layers[..., 3]
    tree = build_tree(layers)
    assert len(tree.clip) == 7
    assert (tree.side != CUT).all()
    assert tree.drawn.tolist() == list(range(7))[::-1]


def test_flat_coplanar_single_and_no_triangles() -> None:
    whole = crossing(1, 2)
    flat = np.tile(whole[:, :1], (1, 3, 1))
    needle = np.stack([whole[0, 0], (whole[0, 0] + whole[0, 1]) / 2, whole[0, 1]])[None]
    assert build_tree(np.empty((0, 3, 4))).drawn.tolist() == []
    assert build_tree(whole).drawn.tolist() == [0]
    assert build_tree(np.zeros((2, 3, 4))).drawn.tolist() == [0, 1]
    tree = build_tree(np.concatenate([flat, whole, needle, whole, -0.5 * whole + 1.5 * whole]))
    assert tree.flat.tolist() == [0, 2]
    assert tree.drawn.tolist() == [0, 2, 4, 3, 1], (
        "of one plane the first is drawn last, and is seen as rays see it"
    )
    assert (seen(np.concatenate([whole, whole]), "bsp") <= 0).all()
    assert render(ClipScene(np.empty((0, 3, 4)), size=SIZE), Settings(visibility="bsp")).primitive.max() == -1


def test_the_eye_may_lie_in_a_plane() -> None:
    edge_on = np.array([[0.2, -1.0, -0.9, 1], [0.2, 1, 0.0, 1], [0.2, -1, 0.9, 1]])
    clip = np.concatenate([edge_on[None], crossing(6, 1)])
    tree = build_tree(clip)
    assert tree.plane[0, 2] == 0
    for row, column in np.argwhere(seen(clip, "bsp") != seen(clip, "ray-casting")):
        assert nearest_side(tree.clip[tree.drawn], column, row) <= SNAPPING


def test_too_many_pieces_are_refused_with_a_sentence() -> None:
    for count in (LARGEST_TREE + 1, 260):
        with pytest.raises(ValueError, match=f"bsp draws at most {LARGEST_TREE:,} pieces"):
            build_tree(crossing(count, 0))
    polygon = ClipScene(np.ones((1, 4, 4)), size=SIZE, kind="polygons")
    with pytest.raises(ValueError, match=r"visibility bsp needs triangles to cut: this scene has polygons"):
        render(polygon, Settings(visibility="bsp"))


@pytest.mark.parametrize(
    "choices", [{}, {"antialiasing": "msaa-4"}, {"blend": "over"}, {"shading": "gouraud"}]
)
def test_the_picture_of_the_window_is_that_of_render(choices: dict[str, str]) -> None:
    positions = np.random.default_rng(7).uniform(-1, 1, (30, 3))
    normals = positions / np.linalg.norm(positions, axis=1, keepdims=True)
    mesh = Mesh(positions, np.arange(30).reshape(10, 3), normals)
    scene = Scene((mesh,), Camera(np.array([0.0, 0.5, 3]), np.zeros(3)), size=SIZE)
    chosen = Settings(visibility="bsp", cull="none", **choices)
    wanted, drawn = to_display(render(scene, chosen).color).pixels, draw_picture(scene, chosen).pixels
    assert np.abs(wanted.astype(int) - drawn.astype(int)).max() <= 1


def test_a_wireframe_has_the_edges_of_triangles_and_no_cuts() -> None:
    scene = ClipScene(crossing(8, 4), size=SIZE)
    whole, cut = (
        render(scene, Settings(visibility=name, cull="none", polygon_mode="wireframe")).primitive >= 0
        for name in ("last-drawn", "bsp")
    )
    for lines, others in ((whole, cut), (cut, whole)):
        around = np.pad(others, 1)
        near = np.any([np.roll(around, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)
        assert near[1:-1, 1:-1][lines].all(), "only the rounding at new corners differs"
