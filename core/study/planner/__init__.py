"""No more than a scene needs: the cheapest methods whose errors stay within a tolerance.

A plan counts what the scene contains (``findings``), tries cheaper methods in parts of the picture (``trials``),
chooses family by family (``planning``), says why (``reasons``), and is measured (``measuring``).
"""
