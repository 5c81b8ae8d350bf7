"""Answers to an editor's questions about RAPID, cfg and YAML, without a protocol."""
