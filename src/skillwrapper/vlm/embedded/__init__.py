"""The embedded model: a stand-in for a vision-language model that sees only pixels and text."""
