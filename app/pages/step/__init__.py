"""The Step page: one presenter for each part of the page."""
