"""Scenes that need one expensive thing each: all the others can be left out within 2/255.

What cannot be needed without something else is told in ``test_needs``.
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import AnyScene, Camera, ClipScene, Material, Mesh, PointLight, Scene, Texture
from core.study.workloads import COLORS

SIDE = 40
QUAD = np.array([[0, 1, 2], [0, 2, 3]])
CORNERS = np.array([[-1.0, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]])
GREY = np.array([0.4, 0.4, 0.4, 1.0])


def quad(
    colors: Floats | None = None, w: Floats | None = None, z: Floats | None = None, is_turned: bool = False
) -> tuple[Floats, Floats]:
    """Return clip positions (2, 3, 4) and colours (2, 3, 4) of a square that fills the picture."""
    corners = CORNERS.copy()
    corners[:, 2] = 0 if z is None else z
    corners *= (np.ones(4) if w is None else w)[:, None]
    values = np.tile(GREY, (4, 1)) if colors is None else colors
    index = (QUAD + 1) % 4 if is_turned else QUAD
    return corners[index], values[index]


def scene_of(*parts: tuple[Floats, Floats]) -> ClipScene:
    """Return squares one after another."""
    return ClipScene(
        np.concatenate([clip for clip, _ in parts]),
        np.concatenate([color for _, color in parts]),
        (SIDE, SIDE),
    )


def shades(*lights: float) -> Floats:
    """Return greys (4, 4) at the corners of a square."""
    return np.stack([np.array([light, light, light, 1.0]) for light in lights])


def near_plane() -> AnyScene:
    """A bright triangle with a corner behind the eye, on nothing: its outline is cut at the view volume."""
    clip = np.array([[[-0.9, -0.8, 0.5, 1.0], [-0.75, -0.47, -1.2, -0.2], [0.9, -0.8, 0.5, 1.0]]])
    return ClipScene(clip, np.tile(COLORS[5], (1, 3, 1)), (SIDE, SIDE))


def steep() -> AnyScene:
    """A slow change of colour over a square whose right corners are three times as far."""
    return scene_of(quad(shades(0.4, 0.52, 0.52, 0.4), w=np.array([1.0, 3, 3, 1])))


def crossing() -> AnyScene:
    """Two squares that pass through each other where their colours are the same."""
    first = quad(shades(0.46, 0.46, 0.46, 0.46), z=np.array([-0.5, 0.5, 0.5, -0.5]))
    second = quad(shades(0.5, 0.42, 0.42, 0.5), z=np.array([0.5, -0.5, -0.5, 0.5]), is_turned=True)
    return scene_of(first, second)


def tight_gap() -> AnyScene:
    """A slanted square 1/100,000 of the depth before others of another colour, which are drawn before and after it."""
    slant = np.array([-0.9, 0.9, 0.9, -0.9])
    farther = quad(shades(0.9, 0.9, 0.9, 0.9), z=slant + 2e-5, is_turned=True)
    return scene_of(farther, quad(z=slant), farther)


def minified() -> AnyScene:
    """A texture of light and dark texels, sixteen of them to a pixel."""
    row, column = np.mgrid[0:64, 0:64]
    pixels = np.where(((row + column) % 2 == 0)[..., None], 0.8, 0.2) * np.ones(3)
    return textured(Texture(pixels.astype(np.float32)), 9.7)


def magnified() -> AnyScene:
    """A texture of four texels of different light across the picture."""
    wave = 0.4 + 0.03 * np.array([0.0, 1.0, 2.0, 1.0])
    pixels = (wave[:, None] + wave[None])[..., None] / 2 * np.ones(3)
    return textured(Texture(pixels.astype(np.float32)), 0.5)


def textured(texture: Texture, repeats: float) -> ClipScene:
    """Return a square with a texture."""
    uv = np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]]) * repeats
    return ClipScene(CORNERS[QUAD], uv[QUAD], (SIDE, SIDE), texture)


def highlight() -> AnyScene:
    """A broad highlight in the middle of two large triangles, seen straight on."""
    positions = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    material = Material(ambient=0.5, diffuse=0.0, specular=0.06, shininess=12.0)
    mesh = Mesh(positions, QUAD, np.tile([0.0, 0, 1], (4, 1)), material=material)
    camera = Camera(
        np.array([0.0, 0, 2]), np.zeros(3), near=1.0, far=4.0, projection="orthographic", view_height=2.0
    )
    return Scene((mesh,), camera, (PointLight(np.array([0.0, 0, 2])),), (SIDE, SIDE))


def edge() -> AnyScene:
    """One bright triangle on nothing."""
    clip = np.array([[[-0.8, -0.7, 0, 1], [0.9, -0.3, 0, 1], [-0.1, 0.8, 0, 1]]])
    return ClipScene(clip, np.tile(COLORS[5], (1, 3, 1)), (SIDE, SIDE))


def transparent() -> AnyScene:
    """A square that lets another one shine through."""
    front = shades(0.2, 0.2, 0.2, 0.2)
    front[:, 3] = 0.5
    return scene_of(quad(shades(0.8, 0.8, 0.8, 0.8), z=np.full(4, 0.5)), quad(front))


def inside() -> AnyScene:
    """An open square that fills the picture and faces away."""
    clip, colors = quad()
    return ClipScene(clip[:, ::-1], colors[:, ::-1], (SIDE, SIDE))
