"""Listings that are repaired or written: what each must do, and the hidden inputs on which it is checked."""
