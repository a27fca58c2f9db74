"""Ring clipping: the methods of the family ``polygon_clipping``, which cut rings at the rings of a region."""
