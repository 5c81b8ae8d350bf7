"""A virtual controller that executes RAPID."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.controller.controller import Deadlock, VirtualController

__all__ = ["Deadlock", "VirtualController"]


def __getattr__(name: str) -> object:
    """Import the controller on demand: every test run loads the plugin."""
    if name in __all__:
        return getattr(import_module("rapidgen.controller.controller"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
