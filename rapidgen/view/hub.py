"""One look at what is watched, for all who view it: encoded once, given to everybody."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count

from pydantic import BaseModel, ValidationError

from rapidgen.view.aspect import Aspect, Declined, Handler, Viewed
from rapidgen.view.messages import FromPage, Positions, Replied


@dataclass(frozen=True, slots=True)
class Parcel:
    """An encoded message. `passing`: the next of its kind makes it worthless."""

    data: bytes
    passing: bool = False


Deliver = Callable[[Parcel], None]
"""Takes a message for one viewer; called on the thread of what is watched."""


@dataclass(eq=False)
class Hub:
    """Who views, and what they are told. Everything but `post`ing belongs to the watched thread."""

    watched: Viewed
    _viewers: dict[int, Deliver] = field(default_factory=dict)
    _numbers: "count[int]" = field(default_factory=lambda: count(1))
    _aspects: tuple[Aspect, ...] = ()
    _handlers: dict[type, Handler] = field(default_factory=dict)

    @property
    def viewers(self) -> int:
        """How many view."""
        return len(self._viewers)

    def renew(self) -> None:
        """Something else is watched from now on: everybody is told all of it."""
        self._aspects = self.watched.aspects()
        self._handlers = {}
        for aspect in self._aspects:
            self._handlers |= aspect.handlers()
        for parcel in self._whole():
            self._tell(parcel)

    def join(self, deliver: Deliver) -> int:
        """A viewer comes; the number is for `leave`."""
        # What it is told whole shall not come as news again.
        self.look()
        number = next(self._numbers)
        self._viewers[number] = deliver
        for parcel in self._whole():
            deliver(parcel)
        return number

    def leave(self, number: int) -> None:
        """A viewer goes; harmless when it has gone."""
        self._viewers.pop(number, None)

    def look(self) -> None:
        """Tell everybody what is new."""
        for aspect in self._aspects:
            for message in aspect.changes():
                self._tell(_parcel(message))

    def ask(self, data: str | bytes, deliver: Deliver) -> None:
        """Carry a request out, and answer it."""
        try:
            asked = FromPage.model_validate_json(data)
        except ValidationError as error:
            fault = error.errors(include_url=False, include_input=False)[0]
            where = ".".join(str(part) for part in fault["loc"])
            deliver(_parcel(Replied(id=0, error=f"not understood: {where} {fault['msg']}")))
            return
        handler = self._handlers.get(type(asked.request))
        text = refused = ""
        if handler is None:
            refused = "what is viewed here is not commanded from here"
        else:
            try:
                text = handler(asked.request)
            except Declined as why:
                refused = str(why)
        deliver(_parcel(Replied(id=asked.id, error=refused, text=text)))

    def _whole(self) -> list[Parcel]:
        return [_parcel(message) for aspect in self._aspects for message in aspect.whole()]

    def _tell(self, parcel: Parcel) -> None:
        for deliver in tuple(self._viewers.values()):
            deliver(parcel)


def _parcel(message: BaseModel) -> Parcel:
    return Parcel(message.model_dump_json().encode(), isinstance(message, Positions))
