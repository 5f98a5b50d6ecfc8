"""How many threads small matrices get: one, as several only wait for each other."""

from __future__ import annotations

import os


def use_one_thread() -> None:
    """Have NumPy multiply matrices in one thread, unless the environment says otherwise.

    To be called before NumPy is imported, in a process of our own: ours are so small that more
    threads take twice the processor time, and no less of the user's. Processes that are started
    inherit it.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
