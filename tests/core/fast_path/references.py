"""What a picture should be, from all buffers of ``render``."""

import numpy as np

from core import STAGES, Scene, Settings, Texture, draw_picture, render
from core.fast_path.depth_free import THIN
from core.fast_path.draw_context import Picture
from core.framebuffer.display import to_display
from core.records.frame import StageCount
from core.scene import AnyScene
from core.stages.vertices import process_geometry

PHONG = Settings(depth="fixed-38")


def noise(rows: int = 16, columns: int = 32, channels: int = 3, seed: int = 0) -> Texture:
    """Return a texture of all that a bound has to bear: black beside white, dark beside darker."""
    generator = np.random.default_rng(seed)
    pixels = generator.random((rows, columns, channels)) ** generator.choice([0.1, 1, 9], (rows, columns, 1))
    pixels[generator.random((rows, columns)) < 0.2] = 0
    if channels == 4:
        pixels[:, :, 3] = 1
    return Texture(pixels.astype(np.float32))


def exact_bytes(scene: AnyScene, settings: Settings, encoding: str) -> np.ndarray:
    """Return the bytes (H, W, 4) of the colours of `render`: sRGB, or 255 times the linear value, rounded."""
    color = render(scene, settings).color
    if encoding == "srgb":
        return to_display(color).pixels
    return np.floor(255 * np.clip(color.astype(np.float64), 0, 1) + 0.5).astype(np.uint8)


def shows_thin_triangle(scene: AnyScene, settings: Settings) -> np.ndarray:
    """Return (H, W) bool: the triangle seen there is so thin that snapping moves it by a good part of its width.

    Attributes belong to the unsnapped corners: there they are extrapolated, farther than any bound.
    """
    geometry = process_geometry(scene, settings, {stage: StageCount() for stage in STAGES})
    length = np.maximum(np.ptp(geometry.window_x, axis=0), np.ptp(geometry.window_y, axis=0))
    is_thin = np.zeros(len(geometry.assembled) + 1, bool)
    is_thin[geometry.primitives.triangle[~(np.abs(geometry.doubled_area) > THIN * length)]] = True
    return is_thin[render(scene, settings).primitive]


def assert_lit(scene: Scene, encoding: str = "srgb", chosen: Settings = PHONG) -> Picture:
    """Draw a lit picture: within a byte of the buffers, and few pixels differ."""
    picture = draw_picture(scene, chosen, encoding=encoding)
    assert picture.route.color == "lit"
    away = np.abs(picture.pixels.astype(int) - exact_bytes(scene, chosen, encoding)).max(axis=2)
    assert away.max() <= 1
    assert (away > 0).mean() < 0.05
    return picture


def assert_deferred(scene: Scene, chosen: Settings = PHONG) -> None:
    """Draw a picture whose attributes and light come from every pixel: the very bytes of the buffers."""
    picture = draw_picture(scene, chosen)
    assert picture.route.color == "deferred"
    assert np.array_equal(picture.pixels, exact_bytes(scene, chosen, "srgb"))
