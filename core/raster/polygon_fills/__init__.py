"""Polygon fills: the methods of the family ``polygon_fill``, which fill rings of edges row by row."""
