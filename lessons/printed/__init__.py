"""Listings as the lectures print them, slips included, each beside the method that is right.

They stand in no table of methods and in no menu: `lessons.printed.catalogue` lists them.
"""
