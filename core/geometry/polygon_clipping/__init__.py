"""Polygon clipping: Sutherland-Hodgman in clip space, and the methods of the family ``clipping``."""
