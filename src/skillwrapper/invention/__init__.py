"""Predicates from inconsistencies: inventor, vocabulary, pruning, batch invention, convergence."""
