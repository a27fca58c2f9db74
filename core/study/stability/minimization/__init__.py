"""What a failing case is made of, and in which ways it can be made smaller: triangles, segments, lit meshes."""
