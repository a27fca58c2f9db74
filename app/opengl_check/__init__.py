"""The comparison of the core with the OpenGL of this machine."""
