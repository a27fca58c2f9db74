"""What a library that draws 2D shapes is given: an order instead of a depth test, a warp instead of a floor."""

from collections.abc import Callable

import numpy as np

from app.bench.contender import Contender, Prepared
from app.bench.records import Floats, Integers, Lines, ViewedMesh, WindowTriangles, Work


def painter(
    library: str,
    work: Work,
    prepare: tuple[
        Callable[[WindowTriangles], Prepared], Callable[[Lines], Prepared], Callable[[ViewedMesh], Prepared]
    ],
    *,
    is_top_down: bool,
    blends: bool = True,
) -> Contender | None:
    """Return a library drawing flat triangles, lines or a textured floor; ``None`` for other work."""
    triangles, lines, floor = prepare
    if isinstance(work, WindowTriangles) and work.is_flat and (blends or not work.is_blended):
        less = not_sorted(work)
        return Contender(library, "painter", lambda _: triangles(work), less, is_top_down)
    if isinstance(work, Lines):
        return Contender(library, "painter", lambda _: lines(work), "", is_top_down)
    if isinstance(work, ViewedMesh) and work.texture is not None and work.lighting is None:
        return Contender(library, "painter", lambda _: floor(work), "warps one image, no geometry", True)
    return None


def not_sorted(work: WindowTriangles) -> str:
    """Return what a painter of triangles does less than ours."""
    return "" if work.is_blended or len(work.corners) == 1 else "no depth, sorting not timed"


def back_to_front(work: WindowTriangles) -> Integers:
    """Return the order (T,) in which a painter draws: far ones first, or as given where they are blended."""
    if work.is_blended:
        return np.arange(len(work.corners))
    return np.argsort(-work.depth.mean(axis=1), kind="stable")


def floor_homography(work: ViewedMesh, center: float = 0.5) -> Floats:
    """Return (3, 3): from pixels of the picture, rows downwards, to texels of a plane's texture.

    Parameters
    ----------
    work : ViewedMesh
        Its first three vertices span the plane.
    center : float
        Where a library has the centre of pixel and texel 0.

    Notes
    -----
    A point of the plane is ``origin + u across + v along``, so that clip x, y and w are a (3, 3) matrix times
    (u, v, 1): the warp is that matrix, turned round.
    """
    assert work.uvs is not None
    assert work.texture is not None
    points = np.concatenate([work.positions[:3], np.ones((3, 1))], axis=1)
    coordinates = np.concatenate([work.uvs[:3], np.ones((3, 1))], axis=1)
    plane = np.linalg.solve(coordinates, points).T  # (4, 3): (u, v, 1) to world space
    clip = (work.projection @ work.view @ plane)[[0, 1, 3]]
    (width, height), (texels_up, texels_across) = work.size, work.texture.shape[:2]
    to_window = np.array([[width / 2, 0, width / 2], [0, -height / 2, height / 2], [0, 0, 1]])
    to_texels = np.diag([texels_across, texels_up, 1.0])
    shift = np.array([[1, 0, 0.5 - center], [0, 1, 0.5 - center], [0, 0, 1]])
    back = np.array([[1, 0, center - 0.5], [0, 1, center - 0.5], [0, 0, 1]])
    homography: Floats = back @ to_texels @ np.linalg.inv(to_window @ clip) @ shift
    return homography
