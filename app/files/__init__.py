"""Files: meshes, states, studies and atlases, read with clear errors and written whole or not at all."""
