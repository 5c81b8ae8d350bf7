"""Messages to bytes and back, derived from their declarations. No sockets."""

from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.frames import ContentError, Frame
from rapidgen.wire.simple_message.messages import MESSAGES
from rapidgen.wire.simple_message.packing import OpenPacking, Packing
from rapidgen.wire.simple_message.spec import Comm, ReplyCode

_NAMES = {m.number: m.name for m in MESSAGES}
_FIXED = {m.number: (m.size, Packing(m.fields), m.kind) for m in MESSAGES if m.is_fixed}
_OPEN = {m.number: (OpenPacking(m.fields), m.kind) for m in MESSAGES if not m.is_fixed}
_BY_CLASS: dict[type[Content], tuple[int, Packing | OpenPacking]] = {
    **{kind: (number, packing) for number, (_, packing, kind) in _FIXED.items()},
    **{kind: (number, packing) for number, (packing, kind) in _OPEN.items()},
}
_REPLIES = {
    (message.number, int(reply.code), reply.size): (Packing(reply.fields), reply.kind)
    for message in MESSAGES
    for reply in message.replies
    if reply.fields
}
"""Replies with data: those of one message differ in code or length."""
_REPLY_BY_CLASS = {
    (number, kind): (code, packing) for (number, code, _), (packing, kind) in _REPLIES.items()
}
_HELLO = messages.HELLO.number
_HELLO_VERSION = Packing(messages.HELLO.reply(ReplyCode.FAILURE).fields)

# Every message passes here: no enum look-up.
_REPLY = int(Comm.REPLY)
_ASKING = (int(Comm.TOPIC), int(Comm.REQUEST))
_NO_REPLY = int(ReplyCode.NONE)
_make = tuple.__new__


def number_of(content: Content) -> int:
    """Return the message number of a topic or request."""
    return _BY_CLASS[type(content)][0]


def encode(content: Content, comm: Comm = Comm.TOPIC) -> bytes:
    """Return a topic or request as one frame.

    Raises ContentError for a value its field cannot hold.
    """
    number, packing = _BY_CLASS[type(content)]
    return Frame(number, comm, ReplyCode.NONE, packing.pack(content)).to_bytes()


def encode_reply(number: int, content: Content) -> bytes:
    """Return the reply to a request of type `number` as one frame."""
    if isinstance(content, messages.Acknowledged):
        return Frame(number, Comm.REPLY, ReplyCode.SUCCESS, b"").to_bytes()
    if isinstance(content, messages.Failure):
        return Frame(number, Comm.REPLY, ReplyCode.FAILURE, b"").to_bytes()
    known = _REPLY_BY_CLASS.get((number, type(content)))
    if known is None:
        raise ContentError(f"{type(content).__name__} does not answer message {number}")
    code, packing = known
    return Frame(number, Comm.REPLY, code, packing.pack(content)).to_bytes()


def decode(frame: Frame) -> Content:
    """Return the content of a frame, one of the classes of `messages`.

    Raises ContentError for an unknown number, comm_type or reply_code, and for data of a wrong
    length; values are not checked (a float may be NaN).
    """
    number, comm, reply, data = frame
    if comm == _REPLY:
        return _decode_reply(frame)
    known = _FIXED.get(number)
    if known is None and number not in _OPEN:
        raise ContentError(f"message type {number} is not known")
    if comm not in _ASKING:
        raise ContentError(f"comm_type is {comm}, must be 1, 2 or 3")
    if reply != _NO_REPLY:
        raise ContentError(f"reply_code of a topic or request is {reply}, must be 0")
    if known is None:
        return _decode_open(frame)
    size, packing, kind = known
    if len(data) != size:
        raise ContentError(f"{_NAMES[number]} has {len(data)} bytes of data, must have {size}")
    return _make(kind, packing.unpack(data))


def _decode_open(frame: Frame) -> Content:
    packing, kind = _OPEN[frame.number]
    if not packing.fits(len(frame.data)):
        raise ContentError(f"{_NAMES[frame.number]} has {len(frame.data)} bytes of data")
    return _make(kind, packing.unpack(frame.data))


def _decode_reply(frame: Frame) -> Content:
    number, _, reply, data = frame
    if number not in _NAMES:
        raise ContentError(f"reply to message type {number}, which is not known")
    if reply not in (ReplyCode.SUCCESS, ReplyCode.FAILURE):
        raise ContentError(f"reply_code of a reply is {reply}, must be 1 or 2")
    if not data:
        return messages.Acknowledged() if reply == ReplyCode.SUCCESS else messages.Failure()
    known = _REPLIES.get((number, reply, len(data)))
    if known is None and number == _HELLO and len(data) >= _HELLO_VERSION.size:
        # Of another version, which its first field still contains.
        return _make(messages.HelloRefusal, _HELLO_VERSION.unpack(data))
    if known is None:
        raise ContentError(f"reply to {_NAMES[number]} has {len(data)} bytes of data")
    packing, kind = known
    return _make(kind, packing.unpack(data))
