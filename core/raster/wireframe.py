"""Polygon mode: triangles filled, or drawn as their edges."""

from core.methods import method


@method("polygon_mode", "fill", "Filled", source="OpenGL 4.6, 14.6.4", exact_for="every triangle")
def filled() -> bool:
    """Return whether only the edges are drawn."""
    return False
