"""From triangles to the pixels that they cover: snapping, edge functions, binning, fills and lines."""
