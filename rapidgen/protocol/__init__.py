"""simple_message as data, and what is derived from it. No I/O."""

from rapidgen.protocol.codec import decode, encode, encode_reply
from rapidgen.protocol.frames import ContentError, Frame, FrameSplitter, FramingError, WireError

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
