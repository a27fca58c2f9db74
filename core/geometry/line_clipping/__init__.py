"""Line clipping: the methods of the family ``line_clipping``, one file each."""
