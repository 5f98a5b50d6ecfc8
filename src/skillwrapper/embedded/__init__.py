"""The embedded model: a stand-in for a vision-language model that sees only pixels and text."""

from skillwrapper.embedded.model import EmbeddedModel
from skillwrapper.embedded.noise import NoiseProfile, noise_profile
from skillwrapper.embedded.scene_graph import Box, SceneGraph, Thing
from skillwrapper.embedded.sight import SceneReader
from skillwrapper.embedded.words import Words, read_words

__all__ = [
    "Box",
    "EmbeddedModel",
    "NoiseProfile",
    "SceneGraph",
    "SceneReader",
    "Thing",
    "Words",
    "noise_profile",
    "read_words",
]
