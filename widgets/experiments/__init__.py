"""Experiments: charts of speed against accuracy, maps of where methods fail, and plans."""
