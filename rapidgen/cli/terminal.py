"""What the verbs need to know of the terminal they talk to."""

import os
import sys


def use_colour(stream: object = None) -> bool:
    """Whether a stream (default: stderr) may be coloured: a terminal, and NO_COLOR not set."""
    is_terminal = getattr(stream or sys.stderr, "isatty", lambda: False)
    return bool(is_terminal()) and not os.environ.get("NO_COLOR")
