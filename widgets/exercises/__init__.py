"""The Exercises page in parts: catalogue, question, one small form for each type of answer, marks."""
