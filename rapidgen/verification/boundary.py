"""Messages with boundary values, generated from the wire declarations.

Every field of every message, including the header, takes every boundary value of its type, on every
port of the driver, in every state. A copy of a prepared controller gets one message. Then no task
may have ended, the driver serves a well-behaved client on every port, and STOP stops a motion.
"""

import random
import struct
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Literal, TypeAlias

from rapidgen.config.model import RobotConfig
from rapidgen.system.model import System
from rapidgen.verification import messages
from rapidgen.verification.batches import checksum
from rapidgen.verification.messages import POINT_BYTES, RawAcknowledged, RawComm
from rapidgen.verification.model import CheckFailed
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import Programmer, RawMove
from rapidgen.verification.settings import Setting
from rapidgen.verification.stream import BEGIN, Streamer
from rapidgen.verification.testbench import FAILURES, Bench
from rapidgen.verification.worker_pool import run_in_fork
from rapidgen.wire.simple_message.declaration import MessageType, Wire
from rapidgen.wire.simple_message.messages import MESSAGES

Port: TypeAlias = Literal["motion", "control", "state"]

INT32 = (
    *(-(2**31), -(2**31) + 1, -(2**24) - 1, -(2**24), -(2**23) - 1, -4, -3, -2, -1, 0, 1, 2, 3),
    *(2**22 - 1, 2**22, 2**23 - 1, 2**23, 2**23 + 1, 2**24 - 1, 2**24, 2**24 + 1),
    *(2**31 - 129, 2**31 - 128, *range(2**31 - 65, 2**31 - 62), 2**31 - 2, 2**31 - 1),
)
"""Values where a num loses integer precision, where it rounds up to 2^31, and the type's ends."""
FLOAT32_BITS = (
    *(0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007FFFFF, 0x00800000, 0x80800000),
    *(0x7F7FFFFF, 0xFF7FFFFF, 0x7F800000, 0xFF800000, 0x7FC00000, 0xFFC00001, 0x7F800001),
)
"""Zeros, smallest and largest subnormal and normal numbers, infinities, both kinds of NaN."""
LENGTHS = (0, 1, 4, 8, 11, 12, 13, 16, 1019, 1020, 1021, 1024, 65_536)
"""Values of the length field, besides those next to the right one."""
HEADER = ("length", "msg_type", "comm_type", "reply_code")
STATES = (
    *("idle", "receiving", "moving", "streaming", "program", "paused"),
    *("stopped", "e-stop", "before-start"),
)
_PLAIN = {Wire.INT32: 1, Wire.FIXED: 1, Wire.FLOAT32: 0, Wire.CHAR: 0}


@dataclass(frozen=True, slots=True)
class Trial:
    """One message to a port in a state; `second`: from a second client."""

    state: str
    port: Port
    second: bool
    what: str
    """Message and fields, for a report."""
    data: bytes

    def __str__(self) -> str:
        whose = "a second client" if self.second else "one client"
        return f"{self.state}, {self.port} port, {whose}, {self.what}: {self.data.hex()}"


def floats(config: RobotConfig) -> tuple[int, ...]:
    """Return the bits of every boundary value of a float32.

    These are the values of the type and the configured limits.
    """
    limits = [0.0, 1.0, 100.0, 3600.0, config.trajectory.min_segment]
    for joint in config.groups[0].joints:
        limits += [joint.lower, joint.upper, joint.speed]
    result = dict.fromkeys(FLOAT32_BITS)
    for limit in limits:
        bits = int.from_bytes(struct.pack("<f", limit), "little")
        for near in (bits, bits + 1, bits - 1):
            result[near & 0xFFFFFFFF] = None
    return tuple(result)


def messages_of(config: RobotConfig) -> Iterator[tuple[str, bytes]]:
    """Yield messages with one field at each boundary value: label and bytes."""
    numbers = floats(config)
    for kind in MESSAGES:
        base, places = _plain(kind)
        for number, name in enumerate(HEADER):
            values: tuple[int, ...] = INT32
            if name == "length":
                values += (*LENGTHS, len(base) - 5, len(base) - 3)
            for value in values:
                yield f"{kind.name}.{name}={value}", _with(base, 4 * number, value)
        for name, offset, wire in places:
            values = numbers if wire is Wire.FLOAT32 else INT32
            for value in dict.fromkeys(values):
                reply = f"{value:#010x}" if wire is Wire.FLOAT32 else str(value)
                yield f"{kind.name}.{name}={reply}", _with(base, offset, value)


def pairs_of(config: RobotConfig, chance: random.Random, count: int) -> Iterator[tuple[str, bytes]]:
    """Yield random messages with two fields at boundary values."""
    numbers = floats(config)
    for _ in range(count):
        kind = chance.choice(MESSAGES)
        base, places = _plain(kind)
        fields = [(name, 4 * n, Wire.INT32) for n, name in enumerate(HEADER[1:], 1)] + places
        reply, data = [], base
        for name, offset, wire in chance.sample(fields, 2):
            value = chance.choice(numbers if wire is Wire.FLOAT32 else INT32)
            reply.append(f"{name}={value}")
            data = _with(data, offset, value)
        yield f"{kind.name}.{' '.join(reply)}", data


def drawn(config: RobotConfig, chance: random.Random) -> bytes:
    """Return a random message; half of its fields have boundary values."""
    base, places = _plain(chance.choice(MESSAGES))
    numbers, data = floats(config), base
    for offset, wire in [(4 * n, Wire.INT32) for n in range(4)] + [(o, w) for _, o, w in places]:
        boundary = chance.random() < 0.5
        if boundary:
            value = chance.choice(numbers if wire is Wire.FLOAT32 else INT32)
        elif offset >= len(messages.framed(0, b"")):
            value = chance.randrange(2**32)
        else:
            # With a random header, the driver would drop nearly every message at its first word.
            continue
        if offset == 0 and chance.random() < 0.9:
            continue
        data = _with(data, offset, value)
    return data


def _plain(kind: MessageType) -> tuple[bytes, list[tuple[str, int, Wire]]]:
    """Return a request with plain values, and its fields.

    A field is the name, offset and type of each word.
    """
    places, data = [], b""
    for field in kind.fields:
        count = field.count or 7
        for number in range(count if field.type is not Wire.CHAR else field.size // 4):
            name = f"{field.name}[{number}]" if count > 1 else field.name
            places.append((name, 16 + len(data), field.type))
            data += struct.pack("<i", _PLAIN[field.type])
    if kind.fields and kind.fields[-1].name == "checksum":
        data = _checked(data)
    return messages.framed(kind.number, data), places


def _checked(data: bytes) -> bytes:
    values = struct.unpack(f"<{len(data) // 4 - 1}i", data[:-4])
    return data[:-4] + struct.pack("<i", checksum(values))


def _with(data: bytes, offset: int, value: int) -> bytes:
    """Return the message with one word replaced and the checksum updated."""
    changed = data[:offset] + struct.pack("<I", value & 0xFFFFFFFF) + data[offset + 4 :]
    number = int.from_bytes(changed[4:8], "little", signed=True)
    last = offset + 4 == len(data)
    if number in (messages.POINTS, messages.PROGRAM) and len(data) > 16 and not last:
        changed = changed[:16] + _checked(changed[16:])
    return changed


def trials(
    config: RobotConfig, states: Sequence[str] = STATES, pairs: int = 300, seed: int = 0
) -> Iterator[Trial]:
    """Yield all trials: states, ports, one client or two, and messages."""
    own = [*messages_of(config), *pairs_of(config, random.Random(f"{seed} pairs"), pairs)]
    ports: tuple[Port, ...] = ("motion", "control", "state")
    for state, port, second in product(states, ports, (False, True)):
        for what, data in own:
            yield Trial(state, port, second, what, data)


# -- prepared controllers -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Prepared:
    """A controller in a state, with a client on every port."""

    bench: Bench
    links: dict[Port, RawLink]


def prepare(config: RobotConfig, system: System, setting: Setting, state: str) -> Prepared:
    """Boot, connect a client on every port, and bring the driver into a state."""
    bench = Bench(config, system, setting)
    bench.compile()
    if state == "before-start":
        bench.controller.perform("stop")
        bench.controller.perform("pp-to-main")
    bench.run(0.5)
    links: dict[Port, RawLink] = {
        "motion": bench.motion(),
        "control": bench.control(),
        "state": bench.state(),
    }
    bench.run(0.3)
    _INTO[state](bench, links["motion"], links["control"])
    bench.forget()
    return Prepared(bench, links)


def _long(bench: Bench) -> bytes:
    return bench.download(bench.wave(12, duration=0.6))


def _receiving(bench: Bench, motion: RawLink, control: RawLink) -> None:
    motion.send(_long(bench)[: 4 * POINT_BYTES + 10])
    bench.run(0.1)


def _moving(bench: Bench, motion: RawLink, control: RawLink) -> None:
    motion.send(_long(bench))
    bench.wait_until_moving()
    bench.run(0.3)


def _streaming(bench: Bench, motion: RawLink, control: RawLink) -> None:
    Streamer(bench, motion).put(bench.wave(12, duration=0.6), BEGIN)
    bench.wait_until_moving()


def _program(bench: Bench, motion: RawLink, control: RawLink) -> None:
    paths = [place for place, _ in bench.wave(8, duration=1.0)]
    orders = [RawMove(messages.RawInstruction.MOVE_ABSJ, place, None) for place in paths[1:]]
    reply = Programmer(bench, motion).send(orders)
    if not isinstance(reply, messages.RawPointsAccepted):
        raise CheckFailed(f"a program is answered with {reply}")
    bench.wait_until_moving()


def _paused(bench: Bench, motion: RawLink, control: RawLink) -> None:
    _moving(bench, motion, control)
    control.ask(messages.RawPause(1))
    bench.wait_until_standing()


def _stopped(bench: Bench, motion: RawLink, control: RawLink) -> None:
    _moving(bench, motion, control)
    motion.stop()
    bench.wait_until_standing()


def _e_stop(bench: Bench, motion: RawLink, control: RawLink) -> None:
    _moving(bench, motion, control)
    bench.controller.perform("e-stop")
    bench.wait_until_standing()


def _nothing(bench: Bench, motion: RawLink, control: RawLink) -> None:
    """Do nothing: the driver is in this state already."""


_INTO: dict[str, Callable[[Bench, RawLink, RawLink], None]] = {
    "idle": _nothing,
    "receiving": _receiving,
    "moving": _moving,
    "streaming": _streaming,
    "program": _program,
    "paused": _paused,
    "stopped": _stopped,
    "e-stop": _e_stop,
    "before-start": _nothing,
}


# -- one message and the invariants --------------------------------------------------------------


def failing(prepared: Prepared, trials: Sequence[Trial]) -> list[tuple[Trial, str]]:
    """Return the trials of one state that fail, with the reasons.

    Trials share a copy of the controller as long as each finds it in its state. If the driver does
    not serve a client after several trials, the batch is split in halves. A failure that needs
    several trials together is reported for the first one.
    """
    result, remaining = [], list(trials)
    while remaining:
        fault, done = run_in_fork(lambda: _outcome(prepared, remaining))  # noqa: B023
        if fault:
            result += _blamed(prepared, remaining[:done], fault)
        remaining = remaining[done:]
    return result


def _blamed(prepared: Prepared, batch: Sequence[Trial], fault: str) -> list[tuple[Trial, str]]:
    if len(batch) == 1:
        return [(batch[0], fault)]
    middle = len(batch) // 2
    result = [*failing(prepared, batch[:middle]), *failing(prepared, batch[middle:])]
    return result or [(batch[0], f"with the {len(batch) - 1} after it: {fault}")]


def _outcome(prepared: Prepared, batch: Sequence[Trial]) -> tuple[str, int]:
    """Return the failure, and how many messages arrived in the state."""
    bench, at_rest, done = prepared.bench, prepared.bench.standing, 0
    try:
        for trial in batch:
            done += 1
            _sent(prepared, trial)
            bench.assert_healthy()
            lost = any(link.lost for link in prepared.links.values())
            if trial.state != "idle" and (lost or bench.standing != at_rest):
                break
        served(prepared)
    except FAILURES as error:
        return str(error), done
    return "", done


def _sent(prepared: Prepared, trial: Trial) -> None:
    """Send the message over the existing client or over a new one."""
    bench, link = prepared.bench, prepared.links[trial.port]
    if trial.second or link.lost:
        link = _connect(bench, trial.port)
    link.send(trial.data)
    # The effect shows soon: servers look for clients five times a second.
    bench.run(0.25)
    if link is not prepared.links[trial.port]:
        if trial.second:
            link.close(then=0.05)
        else:
            prepared.links[trial.port] = link


def _connect(bench: Bench, port: Port) -> RawLink:
    if port == "motion":
        return bench.motion()
    return bench.control() if port == "control" else bench.state()


def served(prepared: Prepared) -> None:
    """Check that every port serves a client and STOP stops a motion."""
    bench = prepared.bench
    for link in prepared.links.values():
        if not link.lost:
            link.close()
    bench.run(1.5)
    bench.wait_until_standing()
    bench.start_again()
    bench.run(2.5)
    control = bench.control()
    if not isinstance(control.ask(messages.RawPing()), RawAcknowledged):
        raise CheckFailed("PING on the control port is not confirmed")
    watcher = bench.watcher()
    bench.progress(watcher)
    motion = bench.motion()
    bench.assert_moves_through(motion, bench.wave(3, duration=0.2))
    for link in (motion, control):
        motion.send(_long(bench))
        bench.wait_until_moving()
        bench.run(0.2)
        link.stop(what="STOP on the motion port" if link is motion else "STOP on the control port")
        bench.wait_until_at_rest(1, 0.5, "it was stopped")
    status = bench.status(watcher)
    if not status.motion_possible:
        raise CheckFailed(f"in the end no motion is possible: {status}")
    for link in (motion, control, watcher):
        link.close()
    bench.assert_healthy()


def ended(port: Port) -> Trial:
    """Return a message that ends a task of a faulty driver.

    The faulty driver packs an unknown message type into its reply.
    """
    data = struct.pack("<iiii", 12, 2**31 - 1, RawComm.REQUEST, 0)
    return Trial("idle", port, False, "PING.msg_type=2147483647", data)
