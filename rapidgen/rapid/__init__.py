"""RAPID: text, tokens, tree, checked program, formatted text."""
