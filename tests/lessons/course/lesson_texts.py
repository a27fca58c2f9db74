"""A lesson of four steps with all kinds of tasks, to be broken one by one."""

GOOD = """\
version = 1
title = "Whose pixel?"
question = "Who draws the pixels of a diagonal?"
minutes = 5
exercises = ["shared-edge"]

[state]
stage = "raster"
settings = { fill = "bounding-box" }

[state.scene]
size = [6, 6]
triangles = [[[0.5, 0.5], [4.5, 0.5], [4.5, 4.5]], [[0.5, 0.5], [4.5, 4.5], [0.5, 4.5]]]

[[step]]
kind = "look"
text = "Sixteen triangles meet in one pixel."
state = { scene = "fan", settings = { fill_rule = "inclusive" }, at = "end", buffer = "overdraw", pixel = [32, 24] }
check = ["drawn(32, 24) == 16", "twice == 185", "count(covered) > drawn"]

[[step]]
kind = "predict"
text = "How many pixels are drawn here?"
answer = { type = "numbers", values = [16] }
after = "Sixteen, and none of them twice. Under the other rule five are."
reveal = { at = "2: E1 == 0 and covered" }
check = ["drawn == 16", "twice(fill_rule=inclusive) == 5", 'value("E1", "tie") == 0']
check_after = ["E1 == 0 and covered", "weights[0] == 0.75"]

[[step.wrong]]
given = 25
says = "That would be right if each edge counted."
mistake = "all-edges-inclusive"
at = "tie"

[[step]]
kind = "predict"
text = "Mark the pixels of triangle 0."
answer = { type = "pixels", triangle = 0 }
mistakes = ["all-edges-inclusive", "all-edges-exclusive"]

[[step]]
kind = "break"
text = "Move the shared corner until E = 0 counts twice."
state = { at = "end", shared = true, scene = { size = [6, 6], triangles = [
    [[0.25, 0.25], [4.25, 0.25], [4.25, 4]], [[0.25, 0.25], [4.25, 4], [0.25, 4.25]]] } }
solution = { corners = [[0, 2, 4.25, 4.25]] }
check_after = ["twice == 0", "twice(fill_rule=inclusive) == 4"]

[step.until]
fails = { weak = { fill_rule = "inclusive" }, robust = { fill_rule = "shared-edge" }, by = "twice" }
keeps = ["window", "settings"]
"""
