"""The course: text, scenes, exercises, checking and progress, without Qt.

``exercises`` asks questions and checks answers, ``mistakes`` has the faulty runs that explain wrong ones. ``scenes`` is
the catalogue of built-in scenes, ``shapes`` makes the meshes that some of them show.
"""
