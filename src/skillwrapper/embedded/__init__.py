"""The embedded model: a stand-in for a vision-language model that sees only pixels and text."""

from skillwrapper.embedded.model import EmbeddedModel
from skillwrapper.embedded.noise import PROFILES, NoiseProfile, noise_profile

__all__ = ["PROFILES", "EmbeddedModel", "NoiseProfile", "noise_profile"]
