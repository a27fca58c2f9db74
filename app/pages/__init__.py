"""The pages of the window, one folder each, and the bar that chooses among them."""
