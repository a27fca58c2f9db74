"""The course: lessons as files, their states, conditions and quoted numbers; nothing of them runs as code."""
