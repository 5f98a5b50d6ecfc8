"""Experiments: many runs of many methods, their figures and tables."""
