"""The executable."""

from rapidgen.ros.__main__ import main

__all__ = ["main"]
