"""OpenCV: convex polygons and lines filled by C++ code without a depth buffer, and a perspective warp."""

import numpy as np

from app.bench import records

LIBRARY = "OpenCV"
DISTRIBUTION = "opencv-python-headless"
SHIFT = 8
"""Bits behind the point of its coordinates: 1/256 pixel."""


def contender(work: records.Work) -> records.Contender | None:
    """Return OpenCV drawing ``work``, or ``None`` where it has no way to."""
    return records.painter(
        LIBRARY, work, (prepare_triangles, prepare_lines, prepare_floor), is_top_down=True, blends=False
    )


def prepare_triangles(work: records.WindowTriangles) -> records.Prepared:
    """Hold polygons in fixed point, from far to near."""
    import cv2

    cv2.setNumThreads(1)
    order = records.back_to_front(work)
    # Pixel centres are whole numbers, rows run downwards.
    corners = np.array([-0.5, work.size[1] - 0.5]) + work.corners[order] * np.array([1, -1])
    polygons = list(np.rint(corners * (1 << SHIFT)).astype(np.int32))
    colors = work.colors[order, 0, :3].tolist()

    def run() -> records.Bytes:
        image = np.zeros((work.size[1], work.size[0], 3), np.uint8)
        for polygon, color in zip(polygons, colors, strict=True):
            cv2.fillConvexPoly(image, polygon, color, cv2.LINE_8, SHIFT)
        return image

    return records.Prepared(run)


def prepare_lines(work: records.Lines) -> records.Prepared:
    """Hold the ends as lists."""
    import cv2

    cv2.setNumThreads(1)
    last_row = work.size[1] - 1
    ends = (np.array([0, last_row, 0, last_row]) + work.ends * np.array([1, -1, 1, -1])).tolist()
    colors = work.colors.tolist()

    def run() -> records.Bytes:
        image = np.zeros((work.size[1], work.size[0], 3), np.uint8)
        for (x0, y0, x1, y1), color in zip(ends, colors, strict=True):
            cv2.line(image, (x0, y0), (x1, y1), color)
        return image

    return records.Prepared(run)


def prepare_floor(work: records.ViewedMesh) -> records.Prepared:
    """Hold the warp from the picture to the texture."""
    import cv2

    cv2.setNumThreads(1)
    texture = work.texture
    assert texture is not None
    homography = records.floor_homography(work, center=0.0)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP

    def run() -> records.Bytes:
        return np.asarray(cv2.warpPerspective(texture, homography, work.size, flags=flags))

    return records.Prepared(run)
