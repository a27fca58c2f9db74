"""Which side of a triangle is seen, written plainly."""

from core.shading.shading import centroids, outward_normals


def is_seen_from_behind(position, normal, corners, eye):
    """Return (T,) bool: an eye (3,) or (T, 3) is on the side of triangles that their vertex normals point away from."""
    outward = outward_normals(position, normal, corners)
    return ((outward * (eye - centroids(position, corners))).sum(axis=1) < 0).astype(bool)
