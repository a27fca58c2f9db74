"""Pillow: polygons and lines filled by C code without a depth buffer, and a perspective warp of an image."""

import numpy as np

from app.bench import records

LIBRARY = "Pillow"
DISTRIBUTION = "pillow"


def contender(work: records.Work) -> records.Contender | None:
    """Return Pillow drawing ``work``, or ``None`` where it has no way to."""
    return records.painter(LIBRARY, work, (prepare_triangles, prepare_lines, prepare_floor), is_top_down=True)


def prepare_triangles(work: records.WindowTriangles) -> records.Prepared:
    """Hold polygons as flat lists, from far to near; blended ones in drawing order."""
    from PIL import Image, ImageDraw

    order = records.back_to_front(work)
    # Pillow's pixel centres are whole numbers, its rows run downwards.
    corners = np.array([-0.5, work.size[1] - 0.5]) + work.corners[order] * np.array([1, -1])
    polygons = corners.reshape(-1, 6).tolist()
    colors = [tuple(color) for color in work.colors[order, 0].tolist()]

    def run() -> records.Bytes:
        image = Image.new("RGB", work.size)
        draw = ImageDraw.Draw(image, "RGBA" if work.is_blended else "RGB").polygon
        for polygon, color in zip(polygons, colors, strict=True):
            draw(polygon, fill=color)
        return np.asarray(image)

    return records.Prepared(run)


def prepare_lines(work: records.Lines) -> records.Prepared:
    """Hold the ends as lists."""
    from PIL import Image, ImageDraw

    last_row = work.size[1] - 1
    ends = (np.array([0, last_row, 0, last_row]) + work.ends * np.array([1, -1, 1, -1])).tolist()
    colors = [tuple(color) for color in work.colors.tolist()]

    def run() -> records.Bytes:
        image = Image.new("RGB", work.size)
        draw = ImageDraw.Draw(image).line
        for line, color in zip(ends, colors, strict=True):
            draw(line, fill=color)
        return np.asarray(image)

    return records.Prepared(run)


def prepare_floor(work: records.ViewedMesh) -> records.Prepared:
    """Hold the texture as an image."""
    from PIL import Image

    assert work.texture is not None
    homography = records.floor_homography(work)
    coefficients = (homography / homography[2, 2]).ravel()[:8].tolist()
    texture = Image.fromarray(work.texture)

    def run() -> records.Bytes:
        return np.asarray(
            texture.transform(work.size, Image.Transform.PERSPECTIVE, coefficients, Image.Resampling.BILINEAR)
        )

    return records.Prepared(run)
