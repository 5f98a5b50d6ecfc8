"""Exact figures where all states can be listed."""
