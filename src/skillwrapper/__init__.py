"""skillwrapper: symbolic planning models of black-box robot skills, learned from pictures."""

__version__ = "0.1.0"
