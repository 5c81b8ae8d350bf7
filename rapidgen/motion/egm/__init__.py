"""Externally guided motion: law, messages in each cycle, sessions and their loops."""
