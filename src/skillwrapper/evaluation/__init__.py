"""Evaluation: exact verification, experiments, tables."""
