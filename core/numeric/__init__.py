"""Arithmetic on whole arrays that several rooms share: sorting, integer planes, packed words, buffers."""
