"""The benchmark: the core against other rasterizers, on the same triangles, checked before they are timed.

A workload is plain arrays (`records`); a module for each library turns it into calls of that library; `harness`
runs them in turn, `report`, `results_file` and `chart` report the results.
"""
