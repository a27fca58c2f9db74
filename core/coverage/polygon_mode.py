"""The family ``polygon_mode``: triangles filled, or drawn as their edges (`core.lines.wireframe`)."""

from core.methods import method


@method(
    "polygon_mode",
    "fill",
    "Filled",
    source="OpenGL 4.6, 14.6.4",
    exact_for="every triangle",
    takes=("fill", "fill_rule"),
)
def filled() -> bool:
    """Return whether only the edges are drawn."""
    return False


@method(
    "polygon_mode",
    "wireframe",
    "Wireframe",
    source="OpenGL 4.6, 14.6.4 (POLYGON_MODE LINE); Pellacini, line rasterization",
    exact_for="outlines of triangles in front of the eye, as exact as the line method",
    breaks_where="edges seen end-on and triangles seen edge-on: they vanish. Shared edges: they are drawn twice",
    needs=("projected",),
    takes=("line", "line_clipping"),
)
def outlined() -> bool:
    """Return whether only the edges are drawn."""
    return True
