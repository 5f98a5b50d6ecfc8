"""How far a model's eyes and ideas can be relied on (the paper's appendix on its VLM)."""
