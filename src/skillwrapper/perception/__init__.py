"""From pictures to labels: what to ask, the truth table, labelled transitions."""
