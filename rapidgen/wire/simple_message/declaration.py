"""Declaration of messages: NamedTuples with annotated fields.

`name: Annotated[int, int32("description")]` is a field to Python's type checkers and to the wire
alike. The codec, the RAPID constants and docs/develop/protocol.md read these declarations.
"""

from dataclasses import dataclass, replace
from functools import cached_property

from rapidgen._compat import StrEnum
from rapidgen.wire.simple_message.spec import HEADER_BYTES, Port, ReplyCode

Value = int | float | str | tuple[int, ...] | tuple[float, ...]
"""One field's value: a scalar, a text, or a tuple of `count` numbers."""
Content = tuple[Value, ...]
"""Content of a frame: one of the classes that `messages` declares."""


class Wire(StrEnum):
    """Types on the wire, little endian."""

    INT32 = "int32"
    FLOAT32 = "float32"
    FIXED = "fixed"
    """A fixed-point number: an int32 of steps of 1 / FIXED_SCALE.

    Eight bytes at a time would need fewer reads, but no manual says how a controller reads a ULINT
    above 2^52.
    """
    CHAR = "char"
    """One byte of ASCII; a text is filled up with zero bytes."""

    @property
    def size(self) -> int:
        """Return the bytes of one value."""
        return 1 if self is Wire.CHAR else 4


ANY = 0
"""Count of a field whose number of values follows from the message's length."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `count` values of `type`; a CHAR field of any count is one text.

    At most one field of a message has the count ANY. The name is that of the annotation.
    """

    type: Wire
    count: int = 1
    unit: str = ""
    text: str = ""
    name: str = ""

    @property
    def size(self) -> int:
        """Return the bytes on the wire; with the count ANY, those of no value."""
        return self.type.size * self.count


def int32(text: str = "", count: int = 1) -> Field:
    """Declare whole numbers."""
    return Field(Wire.INT32, count, "", text)


def float32(unit: str, text: str = "", count: int = 1) -> Field:
    """Declare numbers with a unit ("1": none)."""
    return Field(Wire.FLOAT32, count, unit, text)


def chars(count: int, text: str) -> Field:
    """Declare a text of at most so many bytes."""
    return Field(Wire.CHAR, count, "", text)


def fields_of(kind: type[Content]) -> tuple[Field, ...]:
    """Return the fields that a class declares, in wire order."""
    return tuple(
        replace(hint.__metadata__[0], name=name) for name, hint in kind.__annotations__.items()
    )


class _Data:
    """Data with the fields of the class `kind`."""

    kind: type[Content]

    @cached_property
    def fields(self) -> tuple[Field, ...]:
        """Return the fields of its data."""
        return fields_of(self.kind)

    @cached_property
    def size(self) -> int:
        """Return the bytes of the data; the minimum for a variable field."""
        return sum(field.size for field in self.fields)

    @property
    def length(self) -> int:
        """Return the value of the length field; the minimum if variable."""
        return HEADER_BYTES + self.size


@dataclass(frozen=True)
class Reply(_Data):
    """One reply to a request: its content, and `when` it is sent."""

    code: ReplyCode
    kind: type[Content]
    when: str = ""


@dataclass(frozen=True)
class MessageType(_Data):
    """One type of messages.

    `name` is that of simple_message, `kind` the class that declares the fields, whose docstring is
    the text of the page; `sender` is `client` or `controller`; `ports` are those on which it
    travels; `since` is the first protocol version with it (0: standard simple_message).
    """

    name: str
    number: int
    kind: type[Content]
    sender: str
    ports: tuple[Port, ...]
    since: int = 0
    replies: tuple[Reply, ...] = ()

    @property
    def text(self) -> str:
        """Return its description."""
        return " ".join((self.kind.__doc__ or "").split())

    @property
    def is_fixed(self) -> bool:
        """True if the length is always the same."""
        return all(field.count != ANY for field in self.fields)

    def reply(self, code: ReplyCode) -> Reply:
        """Return the reply with this code, of which there is one."""
        (result,) = (reply for reply in self.replies if reply.code is code)
        return result
