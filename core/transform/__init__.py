"""The vertex stage: matrices, spaces, and primitives assembled from vertices."""
