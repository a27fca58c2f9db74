"""The Stability page: where methods fail."""
