"""Built-in routines by theme; every module here is loaded by registry.py."""
