"""Framebuffer: fragments meet the pixels that are there, and the frame becomes display bytes."""
