"""Pictures on several cores: bands of rows, one drawn here and the others in processes of their own.

Python runs one thread at a time, and the call that keeps the nearest fragment never lets another one run: threads gain
nothing. Processes do. Each knows the meshes (sent once), gets camera, lights and size for every picture (a few hundred
bytes), draws its rows as `draw_picture` does with a region, and writes the bytes into memory that both processes see.
What a pixel shows does not depend on the band it is drawn in, so the picture is the same to the byte.

Not imported by ``core`` itself: whoever wants more than one core asks for it.
"""
