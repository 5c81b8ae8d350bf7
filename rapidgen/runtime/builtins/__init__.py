"""Built-in routines by theme.

registry.py imports every module of this package.
"""
