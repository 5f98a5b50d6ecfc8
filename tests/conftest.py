"""Settings of all tests."""

from __future__ import annotations

from hypothesis import settings

# The same examples every time: a failure in one run is a failure in all.
settings.register_profile("fixed", derandomize=True, deadline=None)
settings.load_profile("fixed")
