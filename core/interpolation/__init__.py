"""Values between the corners of primitives: weights, perspective, what goes without it."""
