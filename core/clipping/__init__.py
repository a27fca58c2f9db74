"""Clipping: triangles in clip space, polygons in the window."""
