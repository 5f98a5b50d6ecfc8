"""Perception: from pictures to a truth table of ground atoms."""
