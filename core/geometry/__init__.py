"""Vertex processing and clipping: matrices, vertex stage, culling, polygon clipping."""
