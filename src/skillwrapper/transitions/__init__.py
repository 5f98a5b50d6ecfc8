"""Transitions: recorded with pictures, labelled as arrays (what learners learn from), lifted."""
