"""The magnified pixel grid: buffers, overlays, triangles, marks, and several grids linked."""
