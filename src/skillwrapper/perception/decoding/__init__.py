"""Decoding: the likeliest states behind readings that may be wrong (D24)."""
