"""Robots that are reached in other ways than by a class of one's own."""
