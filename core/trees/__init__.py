"""Trees of boxes: built over objects, walked by the planes of the view volume and by rays."""
