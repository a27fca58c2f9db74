"""Views, studies and atlases as files: PNG, SVG, PDF, CSV, JSON and text."""
