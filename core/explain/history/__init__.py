"""The history of a pixel in sentences."""
