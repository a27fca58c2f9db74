"""The page that a first start shows."""
