"""Planning under doubt: several hypotheses of where to start and what to reach (D24)."""
