"""Sans-IO reader of a state connection: bytes in, newest state out.

A State is created on request only: one process monitors a hundred robots.
"""

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, TypedDict

from rapidgen.client.core.clock_rate import ClockRateEstimator
from rapidgen.client.core.group import Group
from rapidgen.client.core.state import (
    Driver,
    Event,
    Feedback,
    State,
    Status,
    status_of,
    trajectory_state,
)
from rapidgen.client.errors import RobotTimeout
from rapidgen.wire.simple_message import ContentError, FrameSplitter, decode, messages
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.frames import Frame
from rapidgen.wire.simple_message.spec import FEEDBACK_WRAP, EventType, Feature

_LOG = logging.getLogger("rapidgen.client")
KEPT_EVENTS = 64
KEPT_MESSAGES = 32
KEPT_STATES = 16
_RATE_WINDOW = 16
_MISSED_STATES = 5
"""Joint messages, and ..."""
_MISSED_SECONDS = 0.5
"""... s without PROGRESS, which accompanies states, until it is lost."""
_NOISE = 1e-4
"""rad or m."""
_NAMES = {message.number: message.name for message in messages.MESSAGES}


@dataclass(slots=True)
class Sample:
    """One joint message: its time and the ten axis values of the wire."""

    time: float
    joints: tuple[float, ...]
    stamp: float | None = None
    """The controller's own time of a feedback, s."""


class Listener(Protocol):
    """Receiver of joint messages and events."""

    def add(self, sample: Sample) -> None:
        """Add a joint message, or a feedback."""

    def accepted(self, time: float) -> None:
        """Record the client's time at which the controller accepted a motion."""


class ErrorContext(TypedDict):
    """Context that every RobotError carries."""

    messages: tuple[tuple[float, str], ...]
    states: tuple[State, ...]


class StatePort:
    """The state side of one robot.

    Not thread-safe: its owner holds a lock or a loop.
    """

    def __init__(self, clock: Callable[[], float], where: str = "") -> None:
        """`where`: name of the robot in the log."""
        self.clock = clock
        self.where = where
        self.driver = Driver()
        self.progress: messages.ProgressReport | None = None
        self.hello: messages.HelloReply | messages.HelloRefusal | None = None
        self.samples = 0
        self.progresses = 0
        self._progress_at = (0.0, 0)
        """Time of the last PROGRESS, and the joint messages until then."""
        self._clock_rate = ClockRateEstimator()
        self.events: deque[Event] = deque(maxlen=KEPT_EVENTS)
        """The last entries of the controller's log, oldest first."""
        self.event_count = 0
        self.feedbacks = 0
        self._feedback: messages.JointFeedback | None = None
        self._fed_at = 0.0
        self._laps = 0
        self.last_message = clock()
        """Time of the last message."""
        self.listening = self.last_message
        """Start of the current silence.

        Data that arrived while this process was delayed is still unread.
        """
        self.listeners: list[Listener] = []
        self._group: Group | None = None
        self._splitter = FrameSplitter()
        self._recent: deque[Sample] = deque(maxlen=KEPT_STATES)
        self._arrivals: deque[tuple[Sample, int]] = deque(maxlen=_RATE_WINDOW)
        """Newest joints of each read with their number.

        Delayed messages arrive together.
        """
        self._status: messages.StatusReport | None = None
        self._decoded_status: tuple[messages.StatusReport | None, Driver, Status]
        self._decoded_status = None, self.driver, Status()
        self._log: deque[tuple[float, Frame | str]] = deque(maxlen=KEPT_MESSAGES)
        self._state: State | None = None

    def restart(self) -> None:
        """Start a new connection: drop a partial frame, keep the last values."""
        self._splitter = FrameSplitter()
        self.hello = None
        self.progress = None
        self.driver = Driver()
        self._arrivals.clear()
        self._clock_rate = ClockRateEstimator()
        self._status = None
        self.samples = 0
        self.event_count = 0
        self.feedbacks = 0
        self._feedback = None
        self._laps = 0
        self.last_message = self.clock()
        self._state = None

    def use(self, group: Group) -> None:
        """Use this group's names and units for later states."""
        self._group = group
        self._state = None

    def feed(self, data: bytes) -> None:
        """Process received bytes; note and skip unknown messages.

        Raises FramingError.
        """
        splitter, log = self._splitter, self._log
        splitter.feed(data)
        now = self.clock()
        while (frame := splitter.next()) is not None:
            log.append((now, frame))
            try:
                content = decode(frame)
            except ContentError as error:
                log.append((now, str(error)))
                continue
            self._take(content, now)

    def _take(self, content: Content, now: float) -> None:
        self.last_message = now
        self._state = None
        match content:
            case messages.JointPosition():
                sample = Sample(now, content.joints)
                self.samples += 1
                self._clock_rate.add_sample(now, self.samples)
                self._recent.append(sample)
                if self._arrivals and self._arrivals[-1][0].time == now:
                    self._arrivals.pop()
                self._arrivals.append((sample, self.samples))
                for listener in self.listeners:
                    listener.add(sample)
            case messages.StatusReport():
                self._status = content
            case messages.ProgressReport():
                self.progress = content
                self.progresses += 1
                self._progress_at = now, self.samples
            case messages.JointFeedback():
                self._fed(content, now)
            case messages.EventReport():
                self.event_count += 1
                self.events.append(_event(content, now, self.event_count))
            case messages.HelloReply():
                if self.hello is None:
                    self._progress_at = now, self.samples
                self.hello = content
                self.driver = replace(self.driver, hello=content)
            case messages.HelloRefusal():
                self.hello = content

    def _fed(self, content: messages.JointFeedback, now: float) -> None:
        if self._feedback is not None and content.time < self._feedback.time - FEEDBACK_WRAP / 2:
            self._laps += 1
        self._feedback = content
        self._fed_at = now
        self.feedbacks += 1
        for listener in self.listeners:
            listener.add(Sample(now, content.positions, self._stamp(content)))

    def _stamp(self, content: messages.JointFeedback) -> float:
        """Return s of a clock that continues when the wire's wraps around."""
        return content.time + self._laps * FEEDBACK_WRAP

    def motion_accepted(self) -> None:
        """Record that the controller accepted a motion."""
        for listener in self.listeners:
            listener.accepted(self.clock())

    @property
    def feedback(self) -> Feedback | None:
        """Newest feedback; None before the first."""
        report, group = self._feedback, self._group
        if report is None or group is None:
            return None
        return Feedback(
            names=group.names,
            joints=group.from_wire(report.positions),
            velocity=group.rates_from_wire(report.velocities),
            time=self._stamp(report),
            received=self._fed_at,
            number=self.feedbacks,
        )

    @property
    def is_complete(self) -> bool:
        """True if joints and status have both arrived on this connection."""
        return self.samples > 0 and self._status is not None

    @property
    def status(self) -> Status:
        """The newest status; all unknown before the first."""
        raw, driver, status = self._decoded_status
        if raw is not self._status or driver is not self.driver:
            status = status_of(self._status, self.driver) if self._status else Status()
            self._decoded_status = self._status, self.driver, status
        return status

    @property
    def wire_joints(self) -> tuple[float, ...] | None:
        """Newest joints in wire order; None before the first."""
        return self._recent[-1].joints if self._recent else None

    @property
    def is_progress_lost(self) -> bool:
        """True if the requested PROGRESS stopped accompanying the states."""
        if Feature.PROGRESS not in self.driver.features:
            return False
        came, number = self._progress_at
        return (
            self.samples - number >= _MISSED_STATES and self.last_message - came > _MISSED_SECONDS
        )

    def samples_since(self, number: int) -> list[Sample]:
        """Return the kept joint messages after the `number`th, oldest first."""
        return list(self._recent)[-(self.samples - number) :] if self.samples > number else []

    def is_still(self, count: int) -> bool:
        """True if the last `count` joint messages differ only by sensor noise."""
        last = list(self._recent)[-count:]
        columns = zip(*(sample.joints for sample in last), strict=True)
        return len(last) == count and all(max(c) - min(c) < _NOISE for c in columns)

    @property
    def rate(self) -> float:
        """Joint messages per second over the last reads; 0 before the second."""
        if len(self._arrivals) < 2:
            return 0.0
        (first, before), (last, number) = self._arrivals[0], self._arrivals[-1]
        return (number - before) / (last.time - first.time)

    @property
    def clock_rate(self) -> float | None:
        """Rate of the driver's clock relative to this one, by its states.

        None before enough states have arrived; 1 if the rate cannot be measured. A simulation may
        run faster, a controller does not.
        """
        period = self.driver.hello.state_period if self.driver.hello is not None else 0.0
        if period <= 0:
            return 1.0
        rate = self._clock_rate.rate
        return None if rate is None else rate * period

    @property
    def state(self) -> State | None:
        """Newest state; None before the first joints."""
        if self._state is None and self._recent and self._group is not None:
            self._state = self._make(self._recent[-1], self._velocity(), self.samples)
        return self._state

    @property
    def states(self) -> tuple[State, ...]:
        """The last states, oldest first, with the newest status (for exceptions)."""
        if self._group is None:
            return ()
        zero = (0.0,) * len(self._group.names)
        first = self.samples - len(self._recent) + 1
        older = [self._make(s, zero, first + i) for i, s in enumerate(self._recent)][:-1]
        return (*older, self.state) if self.state else ()

    @property
    def messages(self) -> tuple[tuple[float, str], ...]:
        """The last messages as (time, text), oldest first."""
        return tuple((time, _text(entry)) for time, entry in self._log)

    def evidence(self) -> ErrorContext:
        """The last messages and states, for an exception."""
        return {"messages": self.messages, "states": self.states}

    def late(self, message: str, help: str = "") -> RobotTimeout:
        """Return a RobotTimeout with the last messages and states."""
        return RobotTimeout.because("RG603", message, help, **self.evidence())

    def note(self, text: str, level: int = logging.DEBUG) -> None:
        """Store a line with the messages, and log it.

        An error that is also raised is no warning.
        """
        self._log.append((self.clock(), text))
        _LOG.log(level, "%s: %s", self.where, text)

    def keep(self, frame: Frame) -> None:
        """Store a frame of another connection with the messages."""
        self._log.append((self.clock(), frame))

    def _make(self, sample: Sample, velocity: tuple[float, ...], number: int) -> State:
        assert self._group is not None
        return State(
            names=self._group.names,
            joints=self._group.from_wire(sample.joints),
            velocity=velocity,
            status=self.status,
            time=sample.time,
            rate=self.rate,
            number=number,
            clock=self.clock,
            trajectory=trajectory_state(self.progress.state) if self.progress else None,
        )

    def _velocity(self) -> tuple[float, ...]:
        """Over up to three reads: single ones jitter with the network."""
        assert self._group is not None
        window = [sample for sample, _ in self._arrivals][-4:]
        if len(window) < 2:
            return (0.0,) * len(self._group.names)
        first, last = window[0], window[-1]
        span = last.time - first.time
        now, then = self._group.from_wire(last.joints), self._group.from_wire(first.joints)
        return tuple((a - b) / span for a, b in zip(now, then, strict=True))


def _event(content: messages.EventReport, now: float, number: int) -> Event:
    if content.domain == 0:
        title = f"{content.number} events were dropped"
        return Event(now, 0, EventType.WARNING, title, number)
    # An unknown event type is reported as the most severe one.
    known = content.type in list(EventType)
    return Event(
        time=now,
        code=10_000 * content.domain + content.number,
        type=EventType(content.type) if known else EventType.ERROR,
        title=content.title,
        number=number,
        texts=tuple(text for text in (content.first, content.second) if text),
    )


def _text(entry: Frame | str) -> str:
    if isinstance(entry, str):
        return entry
    try:
        return str(decode(entry))
    except ContentError:
        name = _NAMES.get(entry.number, str(entry.number))
        return f"{name} comm_type {entry.comm} reply_code {entry.reply}: {entry.data.hex()}"
