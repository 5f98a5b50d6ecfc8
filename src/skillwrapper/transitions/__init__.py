"""Labelled transitions: what the learner learns from, as arrays."""
