"""Broadcast of one subject to all viewers, encoded once."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from pydantic import BaseModel, ValidationError

from rapidgen.viewer.messages import PageReply, PageRequest, Positions
from rapidgen.viewer.provider import Handler, RequestRejected, StateProvider, Subject


@dataclass(frozen=True, slots=True)
class MessageBatch:
    """Messages in order, encoded as one array.

    `passing`: the next one makes it worthless.
    """

    data: bytes
    passing: bool = False


@dataclass(eq=False)
class Broadcaster:
    """Broadcaster of one subject. All of it belongs to that one's thread."""

    watched: Subject
    tell: Callable[[MessageBatch], None]
    """Receives messages for all viewers."""
    _aspects: tuple[StateProvider, ...] = ()
    _handlers: dict[type, Handler] = field(default_factory=dict)

    def renew(self) -> None:
        """Replace the subject: every viewer receives all of it."""
        self._aspects = self.watched.aspects()
        self._handlers = {}
        for aspect in self._aspects:
            self._handlers |= aspect.handlers()
        self.tell(self._whole())

    def join(self) -> MessageBatch:
        """Return all messages for a new viewer."""
        # The complete state must not be sent again as a change.
        self.look()
        return self._whole()

    def look(self) -> None:
        """Send the changes to every viewer."""
        new = [message for aspect in self._aspects for message in aspect.changes()]
        if new:
            self.tell(_batch(new))

    def ask(self, data: str | bytes) -> MessageBatch:
        """Execute a request; return the answer."""
        try:
            requested = PageRequest.model_validate_json(data)
        except ValidationError as error:
            fault = error.errors(include_url=False, include_input=False)[0]
            where = ".".join(str(part) for part in fault["loc"])
            return _batch([PageReply(id=0, error=f"not understood: {where} {fault['msg']}")])
        handler = self._handlers.get(type(requested.request))
        text = refused = ""
        if handler is None:
            refused = "this subject accepts no such request"
        else:
            try:
                text = handler(requested.request)
            except RequestRejected as why:
                refused = str(why)
        return _batch([PageReply(id=requested.id, error=refused, text=text)])

    def _whole(self) -> MessageBatch:
        return _batch([message for aspect in self._aspects for message in aspect.whole()])


def _batch(messages: Iterable[BaseModel]) -> MessageBatch:
    text = [*messages]
    data = b",".join(message.model_dump_json().encode() for message in text)
    return MessageBatch(b"[" + data + b"]", all(isinstance(message, Positions) for message in text))
