"""Culling: triangles that need not be drawn, by area, by N . V, as backs of solids."""
