"""Whole pictures by the samples of a pixel: its centre, several samples, or exact areas."""
