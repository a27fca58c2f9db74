"""Lines: the methods of the family ``line``, one file each, and the wireframe of triangles."""
