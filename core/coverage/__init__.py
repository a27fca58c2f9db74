"""Which pixels triangles and polygons cover: snapping, edge functions, number formats, binning, fills."""
