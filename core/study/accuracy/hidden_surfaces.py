"""The exact reference of hidden surfaces: which triangle is seen at every pixel, and where a picture is wrong.

The pixels that a triangle covers are those of the picture itself, so that only visibility is judged: see
``core.visibility.ray_casting`` for how it is decided.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.pipeline import render
from core.records.arrays import Flags
from core.scene import AnyScene
from core.settings import Settings


def visible_triangles(scene: AnyScene, settings: Settings | None = None) -> NDArray[np.int32]:
    """Return the number of the nearest triangle at every pixel, (H, W) int32, -1: none.

    Notes
    -----
    ``settings`` say what is covered and culled; shading, blending and the depth format play no part. Of triangles that
    are exactly as near, it is the first.
    """
    chosen = replace(settings or Settings(), visibility="ray-casting", depth="z-float32", blend="opaque")
    return render(scene, replace(chosen, shading="unlit", interpolation="flat")).primitive


def wrong_visible(triangles: ArrayLike, scene: AnyScene, settings: Settings | None = None) -> Flags:
    """Return where a picture shows another triangle than the nearest one, (H, W) bool.

    Parameters
    ----------
    triangles : (H, W) array_like of int
        The triangle seen at every pixel, -1: none (``Frame.primitive``).
    scene : Scene or ClipScene
    settings : Settings, optional
        Those of the picture.

    Raises
    ------
    ValueError
        If ``triangles`` is not of the scene's size.
    """
    shown = np.asarray(triangles)
    wanted = visible_triangles(scene, settings)
    if shown.shape != wanted.shape:
        raise ValueError(f"triangles must be {wanted.shape}, got {shown.shape}")
    return np.asarray(shown != wanted)
