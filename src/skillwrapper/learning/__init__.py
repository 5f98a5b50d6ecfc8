"""Operators from labelled transitions: learners, predictions, certificate, untested conditions."""
