"""Mistakes of interpolation, depth and blending."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from core import Settings, Texture
from core.depth.depth import DepthFormat
from core.framebuffer.blending import over
from core.framebuffer.display import linear_light, srgb
from core.methods import table
from core.records.arrays import Floats, Singles
from core.records.frame import Frame
from core.scene import AnyScene, ClipScene
from lessons.mistakes.twin import Case, Twin, edited, frame_colors
from lessons.small_scenes import triangle_scene

WINDOW = [(-20, -20), (40, -20), (-20, 40)]
"""A triangle over the whole of a small window."""
CORNERS = [(1, 1), (7, 1), (1, 7)]
RAMP = [[(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)]]
TILTED = triangle_scene([CORNERS], (8, 8), w=[[1, 4, 2]], attributes=RAMP)
UPRIGHT = triangle_scene([CORNERS], (8, 8), attributes=RAMP)
GREY = triangle_scene([CORNERS], (8, 8), attributes=np.full((1, 3, 4), 0.5))
NEAR_FIRST = triangle_scene([WINDOW, WINDOW], (4, 4), depth=[[0.25] * 3, [0.75] * 3])
FAR_FIRST = triangle_scene([WINDOW, WINDOW], (4, 4), depth=[[0.75] * 3, [0.25] * 3])
ONE_CARD = triangle_scene([WINDOW], (4, 4))


def layers(*colors: tuple[float, float, float, float]) -> Case:
    """Return cards over the whole window, blended in drawing order over black."""
    attributes = [[color] * 3 for color in colors]
    scene = triangle_scene([WINDOW] * len(colors), (4, 4), attributes=attributes)
    black = np.array([0.0, 0.0, 0.0, 1.0])
    return Case(replace(scene, background=black), Settings(blend="over", visibility="last-drawn"))


RED_AND_BLUE = layers((1, 0, 0, 0.5), (0, 0, 1, 0.5))
CLEAR_RED = layers((1, 0, 0, 0.25))
OPAQUE = layers((1, 0, 0, 1))


def divided_by_w(scene: ClipScene) -> ClipScene:
    """Divide the attributes by w."""
    assert scene.attributes is not None
    return replace(scene, attributes=scene.attributes / scene.clip[..., 3:])


def turned_attributes(scene: ClipScene) -> ClipScene:
    """Give each corner the attributes of the next one."""
    assert scene.attributes is not None
    return replace(scene, attributes=np.roll(scene.attributes, 1, axis=1))


def turned_back(scene: ClipScene) -> ClipScene:
    """Give each corner the attributes of the one before."""
    return turned_attributes(turned_attributes(scene))


def not_divided(scene: ClipScene) -> ClipScene:
    """Take x, y and z of the clip position for those after the divide."""
    clip = scene.clip.copy()
    clip[..., 3] = 1
    return replace(scene, clip=clip)


def only_places_sorted(scene: ClipScene) -> ClipScene:
    """Sort the corners of each triangle by y, and leave their attributes in the order given."""
    order = np.argsort(scene.clip[..., 1] / scene.clip[..., 3], axis=1, kind="stable")
    return replace(scene, clip=np.take_along_axis(scene.clip, order[..., None], axis=1))


def v_flipped(scene: ClipScene) -> ClipScene:
    """Take 1 - v for v; without a texture there is none."""
    assert scene.attributes is not None
    if scene.texture is None:
        return scene
    attributes = scene.attributes.copy()
    attributes[..., 1] = 1 - attributes[..., 1]
    return replace(scene, attributes=attributes)


def textured(texels: list[list[float]]) -> Case:
    """Return a triangle with a texture of grey values, row 0 at v = 0."""
    grey = np.repeat(np.array(texels)[..., None], 3, axis=2)
    scene = triangle_scene([CORNERS], (8, 8), attributes=[[(0, 0), (1, 0), (0, 1)]])
    return Case(replace(scene, texture=Texture(grey)), Settings(texture_filter="nearest"), frame_colors)


def affine(settings: Settings) -> Settings:
    """Interpolate without w."""
    return replace(settings, interpolation="affine")


def farther_wins(settings: Settings) -> Settings:
    """Compare depths the wrong way, and clear to the nearest."""
    right: DepthFormat = table.get("depth", settings.depth).function()
    wrong = replace(right, cleared=1.0 - right.cleared, larger_is_nearer=not right.larger_is_nearer)
    return settings.replaced(depth=lambda: wrong)


def red_and_blue_exchanged(frame: Frame, scene: AnyScene) -> Frame:
    """Store blue, green, red; the background keeps its colour."""
    is_background = (frame.color == scene.background.astype(np.float32)).all(axis=2, keepdims=True)
    return replace(frame, color=np.where(is_background, frame.color, frame.color[..., [2, 1, 0, 3]]))


def reversed_order(scene: ClipScene) -> ClipScene:
    """Draw the triangles in the other order."""
    assert scene.attributes is not None
    return replace(scene, clip=scene.clip[::-1], attributes=scene.attributes[::-1])


def original_numbers(frame: Frame, scene: ClipScene) -> Frame:
    """Number the triangles as they were given before their order was turned round."""
    primitive = np.where(frame.primitive < 0, -1, len(scene.clip) - 1 - frame.primitive)
    return replace(frame, primitive=primitive.astype(np.int32))


def blended_in_srgb(source: Floats, destination: Singles) -> Singles:
    """Blend encoded colours as if they were linear."""
    encoded = np.concatenate([srgb(source[:, :3]), source[:, 3:]], axis=1)
    there = np.concatenate([srgb(destination[:, :3].astype(float)), destination[:, 3:]], axis=1)
    mixed = over(encoded, there.astype(np.float32))
    mixed[:, :3] = linear_light(mixed[:, :3].astype(float))
    return mixed


COLOR = "color[k] * alpha + destination[k] * (1 - alpha)"
ALPHA = "result.append(alpha + destination[3] * (1 - alpha))"


def in_over(old: str, new: str) -> Callable[[Settings], Settings]:
    """Return what runs the listing of ``over`` with a changed line, if settings blend at all."""
    change = edited("blend", "over", (old, new))
    return lambda settings: settings if settings.blend == "opaque" else change(settings)


TWINS = (
    Twin(
        "affine-for-perspective",
        "The attribute was interpolated without w. With perspective, u/w and 1/w are linear in the window, u is not.",
        Case(TILTED),
        Case(UPRIGHT),
        change_settings=affine,
    ),
    Twin(
        "w-overwritten",
        "w was 1 when it was used. The w of the clip position must be kept after the divide.",
        Case(TILTED),
        Case(UPRIGHT),
        change_scene=lambda scene: replace(scene, clip=scene.clip / scene.clip[..., 3:]),
    ),
    Twin(
        "not-divided-back",
        "u/w was interpolated but not divided by the interpolated 1/w.",
        Case(TILTED),
        Case(UPRIGHT),
        change_settings=affine,
        change_scene=divided_by_w,
    ),
    Twin(
        "multiplied-by-w",
        "The attribute was multiplied by w where it is divided by w.",
        Case(TILTED),
        Case(UPRIGHT),
        change_scene=lambda scene: replace(scene, clip=scene.clip / scene.clip[..., 3:] ** 2),
    ),
    Twin(
        "not-divided",
        "x, y and z were not divided by w. The divide follows the projection.",
        Case(TILTED),
        Case(UPRIGHT),
        change_scene=not_divided,
    ),
    Twin(
        "attributes-not-sorted",
        "The vertices were sorted by y, their attributes were not. Sort them together.",
        Case(triangle_scene([[(7, 3), (2, 6), (1, 1)]], (8, 8), attributes=RAMP)),
        Case(triangle_scene([[(1, 1), (7, 3), (2, 6)]], (8, 8), attributes=RAMP)),
        change_scene=only_places_sorted,
    ),
    Twin(
        "texture-upside-down",
        "The texture is upside down: v = 0 is its bottom row.",
        textured([[0.0, 0.25], [0.5, 1.0]]),
        textured([[0.0, 0.25], [0.0, 0.25]]),
        change_scene=v_flipped,
    ),
    Twin(
        "weights-permuted",
        "The weights are turned by one vertex: alpha belongs to vertex 0, beta to vertex 1, gamma to vertex 2.",
        Case(UPRIGHT),
        Case(GREY),
        change_scene=turned_attributes,
        other_scenes=(turned_back,),
    ),
    Twin(
        "farther-wins",
        "The depth test went the wrong way: the smaller window depth is nearer.",
        Case(NEAR_FIRST),
        Case(ONE_CARD),
        change_settings=farther_wins,
    ),
    Twin(
        "no-depth-test",
        "Depths were stored without a test, so the last one drawn won.",
        Case(NEAR_FIRST),
        Case(FAR_FIRST),
        change_settings=lambda settings: replace(settings, visibility="last-drawn"),
    ),
    Twin(
        "red-and-blue-exchanged",
        "Red and blue are exchanged. The bytes of a pixel are red, green, blue; some formats store blue first.",
        Case(UPRIGHT),
        Case(GREY),
        change_frame=red_and_blue_exchanged,
        change_picture=red_and_blue_exchanged,
    ),
    Twin(
        "order-reversed",
        "The layers were blended in the other order. The one drawn last lies on top.",
        RED_AND_BLUE,
        CLEAR_RED,
        change_scene=reversed_order,
        change_frame=original_numbers,
    ),
    Twin(
        "multiplied-twice",
        "The colour was multiplied by its alpha twice.",
        CLEAR_RED,
        OPAQUE,
        change_settings=in_over(COLOR, COLOR.replace("alpha +", "alpha * alpha +")),
    ),
    Twin(
        "factors-exchanged",
        "The factors are exchanged: the source counts alpha, what is there counts 1 - alpha.",
        CLEAR_RED,
        RED_AND_BLUE,
        change_settings=in_over(COLOR, "color[k] * (1 - alpha) + destination[k] * alpha"),
    ),
    Twin(
        "blended-in-srgb",
        "sRGB values were mixed as if they were linear. Decode them, mix, encode the result.",
        CLEAR_RED,
        OPAQUE,
        change_settings=lambda settings: (
            settings if settings.blend == "opaque" else settings.replaced(blend=blended_in_srgb)
        ),
    ),
    Twin(
        "alpha-of-source",
        "The result got the alpha of the source. It is a + (1 - a) times the alpha that was there.",
        CLEAR_RED,
        OPAQUE,
        change_settings=in_over(ALPHA, "result.append(alpha)"),
    ),
)
