"""Exploration: which skill sequence to try next."""
