"""Mistakes that people make in the rasterization pipeline, as faulty twins: runs that make them.

They stand beside the table of methods, not in it, and appear in no menu: exercises compare answers with them.
"""
