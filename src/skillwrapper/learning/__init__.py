"""Learning: lifting, operators, inconsistencies, invention, pruning, certification, the loop."""
