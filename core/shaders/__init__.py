"""Programs that a student writes: a vertex and a fragment shader in GLSL ES 3.00, run on the lanes of `core.lanes`.

Tokens and parser give the nodes of `core.lanes.nodes`; the dialect gives typed values of float32 and int32. `stages`
runs them on the vertices and fragments of a scene that has a `core.shaders.record.ShaderProgram`.
"""
