"""What can be said of a model beyond the data: the paper's bound, and one that is not vacuous."""
