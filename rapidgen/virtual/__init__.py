"""A virtual controller that executes RAPID."""

from rapidgen.virtual.controller import Deadlock, VirtualController

__all__ = ["Deadlock", "VirtualController"]
