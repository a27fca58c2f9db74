"""Depth and visibility: what a buffer stores, which fragment is nearer, and who is seen."""
