"""The span engine: all triangles at once, by rows and then by pixels of rows, on whole arrays.

Phase by phase::

    lanes   triangles side by side, tallest first; of every edge, where it crosses a row, as an exact fraction
    rows    all lanes step up one row at a time; each row gives the span [start, stop) of inside columns
    walk    spans sorted by length; the k-th pixel of every span longer than k in one array operation
    packed  depth and triangle number in one 64-bit word, linear over the window, so that one addition moves both

Python runs once for a row level and once for a pixel level, never for a triangle; nothing outside a triangle is ever
looked at.

References
----------
C. Wylie, G. Romney, D. Evans, A. Erdahl, *Halftone perspective drawings by computer*, 1967 (scan conversion by spans).
H. Fuchs et al., *Pixel-Planes*, 1985 (linear expressions over the whole window at once).
"""
