"""The course: text, scenes, exercises, checking and progress, without Qt.

``scenes`` is the catalogue of built-in scenes, ``shapes`` makes the meshes that some of them show.
"""
