"""The drawn parts of the burger kitchen."""
