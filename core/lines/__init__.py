"""Lines: the methods of the families ``line`` and ``line_clipping``, wireframes, traces, and what is said of them."""
