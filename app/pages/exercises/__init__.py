"""The Exercises page: asked on the picture, checked by the core, with the name of the mistake."""
