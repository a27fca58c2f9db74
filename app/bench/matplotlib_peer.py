"""matplotlib: collections of polygons drawn by Agg, without a depth buffer; in 3D sorted by their mean depth."""

from typing import Any

import numpy as np

from app.bench import records

LIBRARY = "matplotlib"
DISTRIBUTION = "matplotlib"
DOTS_PER_INCH = 100


def contender(work: records.Work) -> records.Contender | None:
    """Return matplotlib drawing ``work``, or ``None`` where it has no way to."""
    if isinstance(work, records.WindowTriangles) and work.is_flat:
        return records.Contender(
            LIBRARY, "painter", lambda _: prepare_triangles(work), records.not_sorted(work), True
        )
    if isinstance(work, records.ViewedMesh) and work.texture is None and work.lighting is not None:
        less = "no depth, one colour a face"
        return records.Contender(LIBRARY, "painter", lambda _: prepare_mesh(work), less, True)
    return None


def prepare_triangles(work: records.WindowTriangles) -> records.Prepared:
    """Hold the polygons as a collection, from far to near."""
    from matplotlib.collections import PolyCollection

    figure, canvas = empty_figure(work.size)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, work.size[0])
    axes.set_ylim(0, work.size[1])
    order = records.back_to_front(work)
    colors = work.colors[order, 0] / 255
    axes.add_collection(
        PolyCollection(work.corners[order], facecolors=colors, edgecolors="none", antialiased=False)
    )
    return records.Prepared(lambda: drawn(canvas))


def prepare_mesh(work: records.ViewedMesh) -> records.Prepared:
    """Hold the faces as a 3D collection that is seen through the workload's own matrices."""
    from mpl_toolkits.mplot3d import Axes3D
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    figure, canvas = empty_figure(work.size)
    axes: Any = Axes3D(figure, rect=(0, 0, 1, 1), facecolor="black")
    figure.add_axes(axes)
    axes.set_axis_off()
    colors = records.lit_colors(work)[work.triangles].mean(axis=1) / 255
    axes.add_collection3d(
        Poly3DCollection(
            work.positions[work.triangles], facecolors=colors, edgecolors="none", antialiased=False
        ),
        autolim=False,
    )
    # The axes of a 3D figure show a part of its own projection's plane: ours is shown from -1 to 1.
    matrix = work.projection @ work.view
    axes.get_proj = lambda: matrix
    axes.viewLim.intervalx = axes.viewLim.intervaly = (-1, 1)
    return records.Prepared(lambda: drawn(canvas))


def empty_figure(size: tuple[int, int]) -> tuple[Any, Any]:
    """Return a black figure of ``size`` pixels and its Agg canvas."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    inches = (size[0] / DOTS_PER_INCH, size[1] / DOTS_PER_INCH)
    figure = Figure(figsize=inches, dpi=DOTS_PER_INCH, facecolor="black")
    return figure, FigureCanvasAgg(figure)


def drawn(canvas: Any) -> records.Bytes:
    """Draw the figure and return its pixels."""
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())
