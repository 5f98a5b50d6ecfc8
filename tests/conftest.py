"""Settings of all tests."""

from __future__ import annotations

import signal

from hypothesis import settings

# A shell that runs us in the background ignores Ctrl-C for us, and so for all that tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples every time: a failure in one run is a failure in all.
settings.register_profile("fixed", derandomize=True, deadline=None)
settings.load_profile("fixed")
