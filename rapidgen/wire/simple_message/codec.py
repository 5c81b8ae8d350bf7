"""Messages to bytes and back, derived from the specification. No sockets."""

from typing import cast

from rapidgen.wire.simple_message import messages, spec
from rapidgen.wire.simple_message.frames import ContentError, Frame
from rapidgen.wire.simple_message.layout import Layout, OpenLayout, Value
from rapidgen.wire.simple_message.messages import Content
from rapidgen.wire.simple_message.spec import Comm, ReplyCode

_LAYOUTS = {m.number: Layout(m.fields) for m in spec.MESSAGES if m.is_fixed}
_OPEN = {m.number: OpenLayout(m.fields) for m in spec.MESSAGES if not m.is_fixed}
_BY_CLASS = {
    kind: (number, _LAYOUTS.get(number) or _OPEN[number])
    for number, kind in messages.CONTENTS.items()
}
_DECODERS = {
    number: (layout.size, layout, messages.CONTENTS[number]) for number, layout in _LAYOUTS.items()
}

# The path of every message: no enum is asked there.
_REPLY = int(Comm.REPLY)
_ASKING = (int(Comm.TOPIC), int(Comm.REQUEST))
_NO_REPLY = int(ReplyCode.NONE)


def _reply_layouts() -> dict[tuple[int, int, int], tuple[Layout, type[Content]]]:
    found = {}
    for message in spec.MESSAGES:
        for reply in message.replies:
            if reply.fields:
                layout = Layout(reply.fields)
                kind = messages.REPLIES[message.number, reply.code, len(reply.fields)]
                found[message.number, int(reply.code), layout.size] = (layout, kind)
    return found


_REPLIES = _reply_layouts()
_REPLY_BY_CLASS = {
    (number, kind): (code, layout) for (number, code, _), (layout, kind) in _REPLIES.items()
}
_HELLO_VERSION = Layout(spec.HELLO.replies[0].fields[:1])


def number_of(content: Content) -> int:
    """The message number of a topic or request."""
    return _BY_CLASS[type(content)][0]


def encode(content: Content, comm: Comm = Comm.TOPIC) -> bytes:
    """A topic or request as one frame. Raises ContentError for a value its field cannot hold."""
    number, layout = _BY_CLASS[type(content)]
    return Frame(number, comm, ReplyCode.NONE, layout.pack(_values(content))).to_bytes()


def encode_reply(number: int, content: Content) -> bytes:
    """The reply to a request of type `number` as one frame."""
    if isinstance(content, messages.Acknowledged):
        return Frame(number, Comm.REPLY, ReplyCode.SUCCESS, b"").to_bytes()
    if isinstance(content, messages.Failure):
        return Frame(number, Comm.REPLY, ReplyCode.FAILURE, b"").to_bytes()
    known = _REPLY_BY_CLASS.get((number, type(content)))
    if known is None:
        raise ContentError(f"{type(content).__name__} does not answer message {number}")
    code, layout = known
    return Frame(number, Comm.REPLY, code, layout.pack(_values(content))).to_bytes()


def decode(frame: Frame) -> Content:
    """The content of a frame.

    Raises ContentError for an unknown number, comm_type or reply_code, and for data whose
    length does not fit; values are not judged (a float may be NaN).
    """
    number, comm, reply, data = frame
    if comm == _REPLY:
        return _decode_reply(frame)
    known = _DECODERS.get(number)
    if known is None and number not in _OPEN:
        raise ContentError(f"message type {number} is not known")
    if comm not in _ASKING:
        raise ContentError(f"comm_type is {comm}, must be 1, 2 or 3")
    if reply != _NO_REPLY:
        raise ContentError(f"reply_code of a topic or request is {reply}, must be 0")
    if known is None:
        return _decode_open(frame)
    size, layout, kind = known
    if len(data) != size:
        name = spec.BY_NUMBER[number].name
        raise ContentError(f"{name} has {len(data)} bytes of data, must have {size}")
    return _make(kind, layout.unpack(data))


def _decode_open(frame: Frame) -> Content:
    number, _, _, data = frame
    layout = _OPEN[number]
    if not layout.fits(len(data)):
        raise ContentError(f"{spec.BY_NUMBER[number].name} has {len(data)} bytes of data")
    return _make(messages.CONTENTS[number], layout.unpack(data))


def _decode_reply(frame: Frame) -> Content:
    number, _, reply, data = frame
    message = spec.BY_NUMBER.get(number)
    if message is None:
        raise ContentError(f"reply to message type {number}, which is not known")
    if reply not in (ReplyCode.SUCCESS, ReplyCode.FAILURE):
        raise ContentError(f"reply_code of a reply is {reply}, must be 1 or 2")
    if not data:
        return messages.Acknowledged() if reply == ReplyCode.SUCCESS else messages.Failure()
    known = _REPLIES.get((number, reply, len(data)))
    if known is None and message is spec.HELLO and len(data) >= _HELLO_VERSION.size:
        # Of another version, which its first field still tells.
        return _make(messages.HelloRefusal, _HELLO_VERSION.unpack(data))
    if known is None:
        raise ContentError(f"reply to {message.name} has {len(data)} bytes of data")
    layout, kind = known
    return _make(kind, layout.unpack(data))


def _values(content: Content) -> tuple[Value, ...]:
    return cast("tuple[Value, ...]", tuple(content))


def _make(kind: type[Content], values: tuple[Value, ...]) -> Content:
    # The classes' fields are the specification's, which no type checker can know.
    return tuple.__new__(kind, values)
