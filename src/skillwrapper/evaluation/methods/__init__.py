"""The methods that are compared: ours and the baselines."""
