"""Hidden surfaces: by drawing order, by exact rays, by a tree of planes, line by line."""
