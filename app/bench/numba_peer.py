"""numba: the plain scalar z-buffer loop of every tutorial, compiled; every pixel of the bounding box is tested."""

from typing import Any

import numpy as np

from app.bench import records

LIBRARY = "numba"
DISTRIBUTION = "numba"


def contender(work: records.Work) -> records.Contender | None:
    """Return the compiled loop drawing ``work``, or ``None`` where it has no way to."""
    if isinstance(work, records.WindowTriangles):
        return records.Contender(LIBRARY, "compiled", lambda _: prepare(work))
    if isinstance(work, records.ViewedMesh) and work.texture is None:
        less = "raster only: transformed, culled and lit beforehand"
        return records.Contender(
            LIBRARY, "compiled", lambda _: prepare(records.as_window_triangles(work)), less
        )
    return None


def prepare(work: records.WindowTriangles) -> records.Prepared:
    """Compile the loop for these triangles, by drawing them once."""
    import numba

    width, height = work.size
    corners, depth, blends = work.corners, work.depth, work.is_blended
    colors = work.colors.astype(np.float64)
    loop: Any = numba.njit(draw_triangles)

    def run() -> records.Bytes:
        nearest = np.full((height, width), np.inf)
        image = np.zeros((height, width, 3), np.float64 if blends else np.uint8)
        loop(corners, depth, colors, blends, nearest, image)
        return (image + 0.5).astype(np.uint8) if blends else image

    run()
    return records.Prepared(run)


def draw_triangles(corners: Any, depth: Any, colors: Any, blends: bool, nearest: Any, image: Any) -> None:
    """Draw counter-clockwise triangles into ``nearest`` (H, W) and ``image`` (H, W, 3)."""
    height, width = nearest.shape
    for t in range(corners.shape[0]):
        x0, x1, x2 = corners[t, 0, 0], corners[t, 1, 0], corners[t, 2, 0]
        y0, y1, y2 = corners[t, 0, 1], corners[t, 1, 1], corners[t, 2, 1]
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        left, right = max(int(min(x0, x1, x2)), 0), min(int(max(x0, x1, x2)) + 1, width)
        bottom, top = max(int(min(y0, y1, y2)), 0), min(int(max(y0, y1, y2)) + 1, height)
        owns0 = y1 > y2 or (y1 == y2 and x2 > x1)
        owns1 = y2 > y0 or (y2 == y0 and x0 > x2)
        owns2 = y0 > y1 or (y0 == y1 and x1 > x0)
        alpha = colors[t, 0, 3] / 255
        for row in range(bottom, top):
            y = row + 0.5
            for column in range(left, right):
                # Three edge functions, positive inside.
                x = column + 0.5
                a = (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1)
                b = (x0 - x2) * (y - y2) - (y0 - y2) * (x - x2)
                c = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
                if a < 0 or b < 0 or c < 0:
                    continue
                if (a == 0 and not owns0) or (b == 0 and not owns1) or (c == 0 and not owns2):
                    continue

                # Blend, or keep the nearest with its interpolated colour.
                if blends:
                    for k in range(3):
                        image[row, column, k] += alpha * (colors[t, 0, k] - image[row, column, k])
                    continue
                a, b, c = a / area, b / area, c / area
                z = a * depth[t, 0] + b * depth[t, 1] + c * depth[t, 2]
                if z < nearest[row, column]:
                    nearest[row, column] = z
                    for k in range(3):
                        value = a * colors[t, 0, k] + b * colors[t, 1, k] + c * colors[t, 2, k]
                        image[row, column, k] = int(value + 0.5)
