"""RAPID's own routines, types and data, as headers in its own syntax."""
