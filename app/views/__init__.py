"""The stages' own views: the 3D scene, clip space, the (x, y, w) double pyramid, texture space."""
