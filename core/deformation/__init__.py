"""Deformation of meshes before the matrices: blending of shapes, and bones."""
