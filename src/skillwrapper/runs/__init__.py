"""A run: configuration, Algorithm 1, and the folder in which it is kept."""
