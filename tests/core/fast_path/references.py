"""What a picture should be, from all buffers of ``render``."""

import numpy as np

from core import STAGES, Settings, render
from core.fast_path.depth_free import THIN
from core.framebuffer.display import to_display
from core.records.frame import StageCount
from core.scene import AnyScene
from core.stages.vertices import process_geometry


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
