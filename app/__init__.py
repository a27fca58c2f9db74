"""Rasterscope, the application: session, window, pages, files and command line."""

__version__ = "0.1.0"
