"""The timeline: the run as chapters, and the steps of the present one."""
