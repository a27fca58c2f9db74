"""Fills: the methods of the family ``fill`` that test pixels or walk scanlines."""
