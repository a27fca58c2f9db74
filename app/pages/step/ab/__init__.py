"""A | B: the page's run beside another one, stepped together."""
