"""Edge functions in every number format: floats, integers, fractions, and the inverse matrix."""
