"""What methods are measured on: triangles, meshes and lines made from a seed, on a grid that is exact in float64."""

import numpy as np

from core.records.arrays import Flags, Floats, Integers
from core.scene import Camera, ClipScene, DirectionalLight, Material, Mesh, Scene, Texture

GRID_STEPS = 1024
"""Positions are whole multiples of 1/1024 pixel: between the places that snapping knows."""
COLORS = np.array(
    [
        [0.0, 0.168, 0.445, 1.0],
        [0.791, 0.347, 0.0, 1.0],
        [0.0, 0.342, 0.172, 1.0],
        [0.665, 0.112, 0.0, 1.0],
        [0.604, 0.191, 0.386, 1.0],
        [0.871, 0.777, 0.054, 1.0],
    ]
)
"""(6, 4) linear colours that colour-blind people tell apart (M. Okabe, K. Ito, 2008)."""


def random_source(seed: int) -> np.random.Generator:
    """Return random numbers that are the same for the same seed."""
    return np.random.default_rng(seed)


def on_grid(positions: Floats, steps: int = GRID_STEPS) -> Floats:
    """Return positions, of any shape, moved to whole multiples of 1/steps pixel."""
    return np.asarray(np.rint(positions * steps) / steps)


def clip_of_window(window: Floats, size: tuple[int, int], depth: Floats, w: Floats) -> Floats:
    """Return clip positions (T, 3, 4) of corners at ``window`` (T, 3, 2) pixels, with window depth and w (T, 3)."""
    ndc = np.empty((*window.shape[:2], 4))
    ndc[..., 0] = 2 * window[..., 0] / size[0] - 1
    ndc[..., 1] = 2 * window[..., 1] / size[1] - 1
    ndc[..., 2] = 2 * depth - 1
    ndc[..., 3] = 1
    return np.asarray(ndc * w[..., None])


def flat_scene(clip: Floats, size: tuple[int, int]) -> ClipScene:
    """Return triangles (T, 3, 4), each of one colour."""
    colors = np.repeat(COLORS[np.arange(len(clip)) % len(COLORS)][:, None], 3, axis=1)
    return ClipScene(clip, colors, size)


def random_triangles(size: tuple[int, int], count: int, reach: float, seed: int) -> Floats:
    """Return window corners (count, 3, 2) of triangles whose boxes are ``reach`` pixels wide and high."""
    source = random_source(seed)
    reach = min(reach, float(min(size)))
    place = source.uniform(0, 1, (count, 1, 2)) * (np.array(size) - reach)
    corners = source.uniform(0, 1, (count, 3, 2))
    # Two corners of each lie on opposite sides of its box, so that the box is as large as was asked for.
    corners[:, 0, 0], corners[:, 1, 0], corners[:, 2, 1] = 0, 1, 1
    corners[:, 0, 1] = 0
    return on_grid(place + reach * corners)


def sliver_triangles(size: tuple[int, int], count: int, angle: float, seed: int) -> Floats:
    """Return window corners (count, 3, 2) of long triangles in all directions with a tip of ``angle`` degrees."""
    source = random_source(seed)
    length = 0.45 * min(size)
    direction = source.uniform(0, 2 * np.pi, count)
    middle = np.array(size) / 2 + source.uniform(-0.05, 0.05, (count, 2)) * np.array(size)
    spread = np.radians(angle)
    ends = [
        middle + length * np.stack([np.cos(direction + turn), np.sin(direction + turn)], axis=1)
        for turn in (0.0, spread)
    ]
    return on_grid(np.stack([middle, *ends], axis=1))


def window_mesh(size: tuple[int, int], cells: int, seed: int, steps: int = GRID_STEPS) -> Floats:
    """Return window corners (T, 3, 2) of a mesh of ``cells`` x ``cells`` uneven cells that reaches beyond the window.

    Every pixel belongs to exactly one triangle. Corners are multiples of 1/steps pixel: with 2 steps many lie on pixel
    centres. They are moved by less than a quarter of a cell, the rounding included: by more, a triangle may turn over.
    """
    source = random_source(seed)
    grid = np.stack(
        np.meshgrid(np.linspace(-0.1, 1.1, cells + 1), np.linspace(-0.1, 1.1, cells + 1)), axis=-1
    )
    cell = 1.2 / cells
    reach = max(0.24 - 0.5 / (steps * cell * min(size)), 0.0)
    jitter = source.uniform(-reach, reach, grid.shape) * cell
    points = on_grid((grid + jitter) * np.array(size), steps)
    return grid_triangles(points)


def grid_triangles(points: Floats) -> Floats:
    """Return the corners (T, 3, C) of two triangles for each cell between rows of points (R, Q, C)."""
    first, second, third, fourth = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    pairs = np.stack([first, second, third, first, third, fourth], axis=2)
    return pairs.reshape(-1, 3, points.shape[2])


def random_lines(size: tuple[int, int], count: int, length: float, seed: int, is_on_centers: bool) -> Floats:
    """Return segments (count, 2, 2) in all directions whose longer side is ``length`` pixels, inside the raster."""
    source = random_source(seed)
    slope = source.uniform(-1, 1, count)
    step = np.stack([np.full(count, length), slope * length], axis=1)
    step *= source.choice([-1.0, 1.0], (count, 1))
    step = np.where((source.random(count) < 0.5)[:, None], step[:, ::-1], step)
    low, high = np.maximum(-step, 0) + 1, np.array(size) - np.maximum(step, 0) - 1
    start = low + source.uniform(0, 1, (count, 2)) * np.maximum(high - low, 0)
    ends = np.stack([start, start + step], axis=1)
    return np.floor(ends) + 0.5 if is_on_centers else on_grid(ends)


def outline_scene(ends: Floats, size: tuple[int, int], third: Floats | None = None) -> ClipScene:
    """Return a triangle whose first edge is a segment (2, 2) in pixels.

    Its ``third`` corner (2,) lies to the left of the segment by default.
    """
    if third is None:
        along = ends[1] - ends[0]
        third = ends.mean(axis=0) + np.array([-along[1], along[0]]) / 2 + np.array([0.25, 0.25])
        third = on_grid(third, 4)
    window = np.concatenate([ends, third[None]])[None]
    level = np.ones((1, 3))
    clip = clip_of_window(window, size, 0.5 * level, level)
    return ClipScene(clip, np.repeat(COLORS[:1, None], 3, axis=1), size)


def overlapping_triangles(size: tuple[int, int], count: int, seed: int) -> Floats:
    """Return clip corners (count, 3, 4) of large triangles at all depths, which pass through each other.

    Notes
    -----
    Corners are on the 1/256-pixel grid. Halfway between two of its places the rounding of x / w would decide where a
    corner is snapped to, and a picture and its exact reference would cover other pixels.
    """
    source = random_source(seed)
    window = on_grid(source.uniform(0.02, 0.98, (count, 3, 2)) * np.array(size), 256)
    return clip_of_window(
        window, size, source.uniform(0.1, 0.9, (count, 3)), source.uniform(1, 4, (count, 3))
    )


def bars_in_a_circle(size: tuple[int, int], length: float, half: float, depth: Floats) -> Floats:
    """Return clip corners (3, 3, 4) of three bars, each from its foot to a tip of two corners, turned by 120 degrees.

    Parameters
    ----------
    length, half : float
        From the middle of a bar to its ends, and half its width at the tip, in 0.45 of the shorter side of the picture.
    depth : (3, 3) float64
        Window depth of every corner.
    """
    turn = 2 * np.pi / 3 * np.arange(3)
    middle, reach = np.array(size) / 2, 0.45 * min(size)
    along = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    start, tip = (middle + way * length * reach * along - 0.35 * reach * across for way in (-1, 1))
    side = half * reach * across
    window = on_grid(np.stack([start, tip - side, tip + side], axis=1))
    return clip_of_window(window, size, depth, np.ones((3, 3)))


def cyclic_triangles(size: tuple[int, int]) -> Floats:
    """Return clip corners (3, 3, 4) of three bars that overlap in a circle: no order of drawing is right."""
    return bars_in_a_circle(size, 1.0, 0.12, np.tile([0.2, 0.8, 0.8], (3, 1)))


def sphere_mesh(rows: int, radius: float = 1.0) -> Mesh:
    """Return a white sphere of ``rows`` rings of longitude and latitude with its exact normals at the vertices."""
    columns = 2 * rows
    j, i = np.mgrid[0 : rows + 1, 0 : columns + 1]
    angle, around = np.pi * j.ravel() / rows, 2 * np.pi * (i.ravel() % columns) / columns
    ring = np.where((j.ravel() == 0) | (j.ravel() == rows), 0.0, np.sin(angle))
    normals = np.stack([ring * np.sin(around), -np.cos(angle), ring * np.cos(around)], axis=1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    second, third, fourth = first + 1, first + columns + 2, first + columns + 1
    triangles = np.stack([first, second, third, first, third, fourth], axis=1).reshape(-1, 3)
    corners = normals[triangles]
    has_area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).any(axis=1)
    material = Material(ambient=0.12, diffuse=0.7, specular=0.5, shininess=40.0)
    return Mesh(radius * normals, triangles[has_area], normals, material=material, name="sphere")


def sphere_scene(rows: int, size: int) -> Scene:
    """Return a lit sphere in the middle of a square picture."""
    camera = Camera(np.array([0.6, 0.8, 3.0]), np.zeros(3), near=1.0, far=6.0)
    lights = (DirectionalLight(np.array([0.4, -0.8, -0.7])),)
    return Scene((sphere_mesh(rows),), camera, lights, (size, size))


def layered_walls(farther: Floats, nearer: Floats, triangles: Integers, is_early: Flags) -> tuple[Mesh, ...]:
    """Return a wall (N, 3) before another one (N, 3), drawn after some triangles (T, 3) of that and before the others.

    Parameters
    ----------
    is_early : (T,) bool
        Which triangles of the farther wall are drawn first.
    """

    def wall(positions: Floats, part: Integers, color: int, name: str) -> Mesh:
        return Mesh(positions, part, colors=np.tile(COLORS[color], (len(positions), 1)), name=name)

    return (
        wall(farther, triangles[is_early], 1, "farther wall, drawn before"),
        wall(nearer, triangles, 0, "nearer wall"),
        wall(farther, triangles[~is_early], 1, "farther wall, drawn after"),
    )


def strip_triangles(count: int) -> Integers:
    """Return the triangles (2 count, 3) of a strip of ``count`` parts, whose vertices are pairs: lower, upper."""
    first = 2 * np.arange(count)
    return np.stack([first, first + 2, first + 3, first, first + 3, first + 1], axis=1).reshape(-1, 3)


def wall_scene(far_ratio: float, gap: float, size: int) -> Scene:
    """Return two slanted walls that fill the picture, the first mesh a part ``gap`` of the distance before the others.

    Notes
    -----
    The nearer wall is the farther one made smaller about the eye, so it is nearer along every ray, by the same part.
    The farther wall is drawn half before and half after it, so that ties are not always decided the right way.
    """
    near, far = 1.0, far_ratio
    start, end = 2 * near, 0.8 * far
    steps = np.geomspace(start, end, 13)
    # A wall along the line of sight: at distance d it stands d/3 to the side, so it narrows from left to right.
    side = np.linspace(-0.6, 0.6, len(steps)) * steps
    positions = np.array([[x, y * d, -d] for x, d in zip(side, steps, strict=True) for y in (-0.6, 0.6)])
    triangles = strip_triangles(len(steps) - 1)
    # Every second part of the farther wall, of two triangles each, is drawn before the nearer wall.
    is_early = np.arange(len(triangles)) // 2 % 2 == 0
    meshes = layered_walls(positions, (1.0 - gap) * positions, triangles, is_early)
    camera = Camera(np.zeros(3), np.array([0.0, 0.0, -1.0]), near=near, far=far)
    return Scene(meshes, camera, (), (size, size))


def checkerboard(side: int, seed: int) -> Texture:
    """Return a (side, side, 3) texture of squares of different colours with a few single bright texels."""
    source = random_source(seed)
    row, column = np.mgrid[0:side, 0:side]
    is_light = ((row // 4 + column // 4) % 2 == 0)[..., None]
    pixels = np.where(is_light, COLORS[5, :3], COLORS[0, :3]).astype(np.float32)
    places = source.integers(0, side, (side // 2, 2))
    pixels[places[:, 0], places[:, 1]] = 1.0
    return Texture(pixels, "checkerboard")


def textured_quad(size: int, w_ratio: float, repeats: float, texture: Texture | None) -> ClipScene:
    """Return a square that fills the picture, its upper corners ``w_ratio`` times as far as the lower ones.

    Notes
    -----
    The texture is repeated ``repeats`` times each way; without one, the coordinates are attributes.
    """
    return receding_quad((size, size), np.array([1.0, 1.0, w_ratio, w_ratio]), repeats, texture)


def receding_quad(
    size: tuple[int, int], w: Floats, repeats: float = 1.0, texture: Texture | None = None
) -> ClipScene:
    """Return a rectangle that fills the picture, with ``w`` (4,) at its corners, counter-clockwise from below left."""
    x, y = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([-1.0, -1.0, 1.0, 1.0])
    corners = np.stack([x * w, y * w, np.zeros(4), w], axis=1)
    uv = np.array([[0.0, 0.0], [repeats, 0.0], [repeats, repeats], [0.0, repeats]])
    index = np.array([[0, 1, 2], [0, 2, 3]])
    return ClipScene(corners[index], uv[index], size, texture, shared=index)
