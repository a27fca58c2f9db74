"""scikit-image: polygons and lines as index arrays, without a depth buffer, and a perspective warp."""

import numpy as np

from app.bench import records

LIBRARY = "scikit-image"
DISTRIBUTION = "scikit-image"


def contender(work: records.Work) -> records.Contender | None:
    """Return scikit-image drawing ``work``, or ``None`` where it has no way to."""
    return records.painter(
        LIBRARY, work, (prepare_triangles, prepare_lines, prepare_floor), is_top_down=False
    )


def prepare_triangles(work: records.WindowTriangles) -> records.Prepared:
    """Hold rows and columns of the corners, from far to near; pixel centres are whole numbers."""
    from skimage.draw import polygon, set_color

    order = records.back_to_front(work)
    rows, columns = work.corners[order, :, 1] - 0.5, work.corners[order, :, 0] - 0.5
    colors, alphas = work.colors[order, 0, :3], (work.colors[order, 0, 3] / 255).tolist()
    shape = (work.size[1], work.size[0], 3)

    def paint() -> records.Bytes:
        image = np.zeros(shape, np.uint8)
        for row, column, color in zip(rows, columns, colors, strict=True):
            image[polygon(row, column, shape)] = color
        return image

    def blend() -> records.Bytes:
        image = np.zeros(shape, np.float32)
        for row, column, color, alpha in zip(rows, columns, colors, alphas, strict=True):
            set_color(image, polygon(row, column, shape), color, alpha)
        return (image + 0.5).astype(np.uint8)

    return records.Prepared(blend if work.is_blended else paint)


def prepare_lines(work: records.Lines) -> records.Prepared:
    """Hold the ends as lists."""
    from skimage.draw import line

    ends = work.ends.tolist()
    shape = (work.size[1], work.size[0], 3)

    def run() -> records.Bytes:
        image = np.zeros(shape, np.uint8)
        for (x0, y0, x1, y1), color in zip(ends, work.colors, strict=True):
            image[line(y0, x0, y1, x1)] = color
        return image

    return records.Prepared(run)


def prepare_floor(work: records.ViewedMesh) -> records.Prepared:
    """Hold the warp from the picture to the texture."""
    from skimage.transform import ProjectiveTransform, warp

    texture = work.texture
    assert texture is not None
    transform = ProjectiveTransform(records.floor_homography(work, center=0.0))
    shape = (work.size[1], work.size[0])

    def run() -> records.Bytes:
        warped = warp(texture, transform, output_shape=shape, order=1, preserve_range=True)
        return np.asarray((warped + 0.5).astype(np.uint8))

    return records.Prepared(run)
