"""Runs: Algorithm 1 from start to end, on disk so that it can be read, resumed and replayed."""
