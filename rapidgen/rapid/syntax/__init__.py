"""RAPID text: tokens, tree, formatted text."""
