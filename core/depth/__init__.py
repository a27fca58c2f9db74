"""Depth: what a buffer stores, and which fragment is nearer."""
