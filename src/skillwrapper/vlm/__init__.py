"""Vision-language models: the protocol, the models behind it, prompts, parsers, call store."""
