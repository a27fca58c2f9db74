"""How half a tube is lit, from its angle alone: a second derivation of what normals that turn evenly give."""

import numpy as np

from core.shading.measured import LIGHT, MATERIAL, SIZE, turned_normals


def evenly_lit(angle: float) -> np.ndarray:
    """Return the colours (H, W, 3) of normals that turn evenly by ``angle`` degrees from left to right."""
    width, height = SIZE
    normal = turned_normals((np.arange(width) + 0.5) / width, angle)
    to_light = -LIGHT.direction / np.linalg.norm(LIGHT.direction)
    light = MATERIAL.ambient + MATERIAL.diffuse * np.maximum(normal @ to_light, 0)
    return np.broadcast_to(light[:, None], (height, width, 3))
