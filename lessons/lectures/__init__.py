"""The lectures: their scenes, the numbers on their slides, and their listings as printed, slips included."""
