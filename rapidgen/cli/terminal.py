"""What the verbs need to know of the terminal they talk to."""

import os
import sys


def letters(text: str) -> str:
    """A RAPID string as people read it: its characters are bytes, of UTF-8 where the file is."""
    try:
        return text.encode("latin-1").decode("utf-8")
    except UnicodeError:
        return text


def use_colour(stream: object = None) -> bool:
    """Whether a stream (default: stderr) may be coloured: a terminal, and NO_COLOR not set."""
    is_terminal = getattr(stream or sys.stderr, "isatty", lambda: False)
    return bool(is_terminal()) and not os.environ.get("NO_COLOR")
