"""simple_message as data: specification, codec and derived texts.

No I/O.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.wire.simple_message.codec import decode, encode, encode_reply
    from rapidgen.wire.simple_message.frames import (
        ContentError,
        Frame,
        FrameSplitter,
        FramingError,
        WireError,
    )

# The generator needs the specification only, and should not load the codec.
_FILES = {
    **dict.fromkeys(("decode", "encode", "encode_reply"), "codec"),
    **dict.fromkeys(
        ("ContentError", "Frame", "FrameSplitter", "FramingError", "WireError"), "frames"
    ),
}

__all__ = [
    "ContentError",
    "Frame",
    "FrameSplitter",
    "FramingError",
    "WireError",
    "decode",
    "encode",
    "encode_reply",
]


def __getattr__(name: str) -> object:
    if name not in _FILES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_FILES[name]}"), name)
