"""Pictures as fast as NumPy draws them: a scene becomes the bytes of a screen.

``render`` keeps every buffer; a picture keeps none that it does not need, and chooses how it is drawn by what the scene
holds: see `Route`. Which triangle is seen at which pixel is decided by the same rules for both, bit for bit.

What there is (``Route.visibility``)        how it is drawn
------------------------------------        ---------------
one triangle, or one side of a convex solid ``layer``: no pixel belongs to two, colours go straight to the picture
opaque triangles                            ``words``: the nearest fragment of every pixel, then its colour, once
transparent ones                            ``stacks``: fragments sorted by pixel, blended layer by layer
four samples of opaque triangles           ``multisampled``: ``words`` of each sample, averaged where they differ
outlines; other fills than ``spans``; rays  ``frame``: all buffers of ``render``

Small triangles walk along spans, those of more than 32,768 pixels go in bands, and what cannot be packed (a corner that
cannot be projected, triangles cut by the near or far plane, 1/w or its logarithm) is
looked at fragment by fragment.

Memory: at most 24 bytes a pixel (40 with four samples), 900 bytes a triangle and 24 MB (26 where some are looked at
fragment by fragment), of which the words (8 bytes a pixel) and the spans of 16,384 triangles stay in `ScratchBuffers`
from picture to picture (tested).
"""
