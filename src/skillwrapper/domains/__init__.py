"""Bundled domains: simulators, their pictures, problems and expert models."""
