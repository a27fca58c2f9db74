"""Help: the guide, the glossary and the reference pages of the methods, beside the window's pages."""
