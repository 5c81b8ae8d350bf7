"""Messages with boundary values, generated from the wire declarations.

Every field of every message, including the header, takes every boundary value of its type, on every
port of the driver, in every state, from the existing client or from a second one. After a message
no task may have ended, the driver serves a well-behaved client on every port, and STOP stops a
motion.

To do all this after each of some million messages would take weeks. Most of them are rejected, and
leave the driver as it was: the same client, or one that has connected again, is answered, and all
RAPID data that are constant in the state (`driver_data.py`) have the same values. A copy of the
prepared controller gets many such messages, and the complete check follows the last one: it proves
the same for each of them. Others only end the state, as a client does that disconnects: then the
data are compared with those after such an end, for which the complete check was done. A message
that changes anything else is followed by the complete check.
"""

import random
import struct
import zlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby, product
from typing import Literal, TypeAlias

from rapidgen.config.model import RobotConfig
from rapidgen.runtime.values import Value
from rapidgen.system.model import System
from rapidgen.verification import messages
from rapidgen.verification.batches import checksum
from rapidgen.verification.driver_data import Datum, DriverData, driver_data
from rapidgen.verification.messages import POINT_BYTES, RawComm
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
PING = messages.framed(messages.PING, b"")
_UNKNOWN = 999
UNKNOWN = messages.framed(_UNKNOWN, b"")
"""Request of a message type that no driver knows."""
BURST = 900
"""Bytes of messages that are sent in one go: less than the driver reads in one go."""
SAMPLE = 20_000_000
"""ns between two samples of the robot's position."""
SLOW = 6.0
"""s between the points of the motion in a state, so that many messages arrive in it."""
TAKEN_OVER = 1.3
"""s after which the motion server reads what a second client sends to an idle robot."""
STATES = (
    *("idle", "receiving", "moving", "streaming", "program", "paused"),
    *("stopped", "e-stop", "before-start"),
)
ACTIVE = ("receiving", "moving", "streaming", "program", "paused")
"""States that end with the connection to the motion server."""
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


Effect: TypeAlias = Literal["none", "ended", "changed"]
"""Effect of messages: none; the end of the state as by a lost client; anything else."""
Burst: TypeAlias = list[Trial]
"""Messages with different values of one field, to one port."""


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

    state: str
    bench: Bench
    links: dict[Port, RawLink]
    data: DriverData
    """RAPID data that are constant in this state."""
    ends: tuple[DriverData, ...] = ()
    """The same after the connection to the motion server has ended, in each way."""


def prepare(config: RobotConfig, system: System, setting: Setting, state: str) -> Prepared:
    """Boot, connect a client on every port, and bring the driver into a state."""
    bench = Bench(config, system, setting)
    bench.sample = SAMPLE
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
    data = driver_data(bench.controller.rapid_tasks.values())
    prepared = Prepared(state, bench, links, data)
    prepared = replace(prepared, data=data.without(run_in_fork(lambda: _varying(prepared))))
    ways = _ENDS if state in ACTIVE else ()
    return replace(prepared, ends=tuple(_after(prepared, way) for way in ways))


def _after(prepared: Prepared, end: Callable[[Prepared], None]) -> DriverData:
    """Return the data after an end of the state, for which the complete check is done here.

    Data that depend on the moment of the end are left out.
    """

    def ended(moment: float) -> tuple[Value, ...]:
        prepared.bench.run(moment)
        end(prepared)
        _settled(prepared)
        values = prepared.data.now().values
        served(prepared)
        return values

    first, *others = [run_in_fork(partial(ended, moment)) for moment in (0.0, 0.13, 0.47)]
    places = zip(prepared.data.places, first, *others, strict=True)
    varying = [place.datum for place, *values in places if any(v != values[0] for v in values)]
    return replace(prepared.data, values=first).without(varying)


def _varying(prepared: Prepared) -> list[Datum]:
    """Return the data that vary though clients do nothing but what every driver allows.

    These are results of time, of connections, and of a request that is rejected.
    """
    bench, links = prepared.bench, prepared.links
    varied: dict[Datum, None] = {}

    def wait(seconds: float) -> None:
        for _ in range(round(seconds / 0.05)):
            bench.run(0.05)
            varied.update(dict.fromkeys(prepared.data.changed()))

    ports: tuple[Port, ...] = ("control", "state")
    for data in (PING, UNKNOWN):
        for port in ("motion", "control"):
            links[port].send(data)
            wait(0.3)
    links["motion"].send(messages.framed(_UNKNOWN, b"", RawComm.TOPIC))
    bench.send_hello(links["state"], subscribe=0)
    for port in ports if prepared.state in ACTIVE else (*ports, "motion"):
        for _ in range(3):
            second = _connect(bench, port)
            wait(0.3)
            second.close()
            wait(0.3)
            if links[port].lost or port != "motion":
                links[port].close()
                wait(0.2)
                links[port] = _connect(bench, port)
                wait(0.3)
    return list(varied)


def _long(bench: Bench, duration: float = 0.6) -> bytes:
    return bench.download(bench.wave(12, duration=duration))


def _receiving(bench: Bench, motion: RawLink, control: RawLink) -> None:
    motion.send(_long(bench, SLOW)[: 4 * POINT_BYTES])
    bench.run(0.1)


def _moving(bench: Bench, motion: RawLink, control: RawLink) -> None:
    motion.send(_long(bench, SLOW))
    bench.wait_until_moving()
    bench.run(0.3)


def _streaming(bench: Bench, motion: RawLink, control: RawLink) -> None:
    Streamer(bench, motion).put(bench.wave(12, duration=SLOW), BEGIN)
    bench.wait_until_moving()


def _program(bench: Bench, motion: RawLink, control: RawLink) -> None:
    paths = [place for place, _ in bench.wave(8, duration=1.0)]
    kind = messages.RawInstruction.MOVE_ABSJ
    orders = [RawMove(kind, place, None, speed=0.002, turn=0.01) for place in paths[1:]]
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


def _client_disconnects(prepared: Prepared) -> None:
    prepared.links["motion"].close(then=0.1)


def _framing_breaks(prepared: Prepared) -> None:
    prepared.links["motion"].send(bytes(16))
    prepared.bench.until(lambda: prepared.links["motion"].lost, 1, "the client is disconnected")


def _client_waits(prepared: Prepared) -> None:
    """Let a second client be served after the first one, if it may."""
    second = prepared.bench.motion()
    prepared.bench.run(TAKEN_OVER)
    second.close(then=0.15 * prepared.bench.setting.slowness)


_ENDS = (_client_disconnects, _framing_breaks, _client_waits)


# -- messages and the invariants -----------------------------------------------------------------


def failing(prepared: Prepared, trials: Sequence[Trial]) -> list[tuple[Trial, str]]:
    """Return the trials of one state that fail, with the reasons.

    Messages with different values of one field are sent in one go, and singly if something changes
    or the connection breaks. Those of one field in ten are always sent singly, since the next
    message may undo what one has changed. If the complete check fails after several messages, they
    are repeated in halves. A failure that needs several together is reported for the first.
    """
    bursts: list[Burst] = []
    for field, own in groupby(trials, key=field_of):
        bursts += _bursts(list(own), singly=zlib.crc32(str(field).encode()) % 10 == 0)
    return _failing(prepared, bursts)


def _failing(prepared: Prepared, bursts: Sequence[Burst]) -> list[tuple[Trial, str]]:
    result: list[tuple[Trial, str]] = []
    remaining = list(bursts)
    while remaining:
        outcome = run_in_fork(lambda: _outcome(prepared, remaining))  # noqa: B023
        done, remaining = remaining[: outcome.done], remaining[outcome.done :]
        if outcome.singly:
            # The next burst may be the cause, so the check is repeated without it.
            result += _failing(prepared, done) if outcome.fault else []
            remaining[:1] = _singly(remaining[0])
        elif outcome.fault:
            result += _blamed(prepared, done, outcome.fault)
    return result


def _singly(burst: Burst) -> list[Burst]:
    return [[trial] for trial in burst]


def _blamed(prepared: Prepared, bursts: Sequence[Burst], fault: str) -> list[tuple[Trial, str]]:
    if len(bursts) == 1:
        if len(bursts[0]) == 1:
            return [(bursts[0][0], fault)]
        bursts = _singly(bursts[0])
    middle = len(bursts) // 2
    result = [*_failing(prepared, bursts[:middle]), *_failing(prepared, bursts[middle:])]
    others = sum(map(len, bursts)) - 1
    return result or [(bursts[0][0], f"with the {others} after it: {fault}")]


@dataclass(frozen=True, slots=True)
class _Outcome:
    """Result of one copy of a prepared controller."""

    done: int
    """Bursts that need not be repeated."""
    fault: str = ""
    singly: bool = False
    """True: the next burst has changed something, so its messages are sent singly."""


def _outcome(prepared: Prepared, bursts: Sequence[Burst]) -> _Outcome:
    """Send bursts until one changes something, and do the complete check."""
    done, singly = 0, False
    try:
        for burst in bursts:
            # True until the burst has turned out to change nothing.
            singly = len(burst) > 1
            done += not singly
            effect = _sent(prepared, burst)
            if singly and effect != "changed":
                singly = False
                done += 1
            if effect != "none":
                break
        # The check was done for the same end of the state. One end of sixteen is checked again.
        if done and (effect != "ended" or sum(bursts[done - 1][0].data) % 16 == 0):
            served(prepared)
    except FAILURES as error:
        return _Outcome(done, str(error), singly)
    return _Outcome(done, "", singly)


def field_of(trial: Trial) -> tuple[Port, bool, str]:
    """Return what is the same for messages with different values of one field."""
    return trial.port, trial.second, trial.what.partition("=")[0]


def _bursts(group: Sequence[Trial], *, singly: bool) -> Iterator[Burst]:
    """Divide messages of one field into bursts that the driver reads in one go.

    The state server reads one message of a client, and only HELLO.
    """
    burst: Burst = []
    for trial in group:
        alone = singly or trial.port == "state" or _is_misframed(trial)
        size = len(trial.data) + sum(len(other.data) for other in burst)
        if burst and (alone or size > BURST):
            yield burst
            burst = []
        if alone:
            yield [trial]
        else:
            burst.append(trial)
    if burst:
        yield burst


def _sent(prepared: Prepared, burst: Burst) -> Effect:
    """Send messages, check that all ports serve, and return what they have changed."""
    bench, links, port = prepared.bench, prepared.links, burst[0].port
    at_rest, second = bench.standing, burst[0].second
    link = _connect(bench, port) if second else links[port]
    intact = _SEND[port](prepared, link, burst)
    bench.assert_healthy()
    if second or not intact:
        # What comes next on this connection may count as the rest of an incomplete message.
        link.close(then=0.15 * bench.setting.slowness)
    ended = bool(prepared.ends) and links["motion"].lost
    if port == "state" and not links[port].lost:
        links[port].read()
        links[port].expect(messages.RawStatus, 2, "a STATUS arrives")
    _settled(prepared)
    if not intact and len(burst) > 1:
        return "changed"
    if ended:
        known = any(not end.changed() for end in prepared.ends)
        return "ended" if known and bench.standing else "changed"
    return "none" if bench.standing == at_rest and not prepared.data.changed() else "changed"


def _settled(prepared: Prepared) -> None:
    """Connect again where a connection is lost; check that every port serves its client."""
    bench, links = prepared.bench, prepared.links
    ended = links["motion"].lost and prepared.state in ACTIVE
    for own, existing in links.items():
        if existing.lost:
            links[own] = _connect(bench, own)
            if own != "state":
                _asked(bench, links[own])
            else:
                links[own].expect(messages.RawStatus, 2, "a STATUS arrives")
    _asked(bench, links["control"])
    if ended:
        bench.wait_until_standing(1)
        bench.run(0.1)


def _asked(bench: Bench, link: RawLink) -> None:
    """Check that PING is answered."""
    link.read()
    link.send(PING)
    link.reply(messages.PING, 2, "PING is answered")


def _sent_to_server(prepared: Prepared, link: RawLink, burst: Burst) -> bool:
    """Send messages and PING; return if the driver has answered PING."""
    bench = prepared.bench
    pings = 1 + sum(trial.data[:12] == PING[:12] for trial in burst)
    seen = len(link.frames)
    link.send(b"".join(trial.data for trial in burst) + PING)

    def answered() -> bool:
        numbers = [frame.number for _, frame in link.frames[seen:]]
        return link.lost or numbers.count(messages.PING) >= pings

    wait = 0.25 if len(burst) == 1 else 0.25 + 0.02 * len(burst)
    bench.controller.run_until(answered, timeout=wait * bench.setting.slowness)
    # After a wrong length, the end of PING may count as the beginning of the next message.
    return not link.lost and answered() and not _is_misframed(burst[0])


def _is_misframed(trial: Trial) -> bool:
    return int.from_bytes(trial.data[:4], "little") + 4 != len(trial.data)


def _sent_to_motion_server(prepared: Prepared, link: RawLink, burst: Burst) -> bool:
    """Send messages to the motion server.

    It reads those of a second client when the first one has been silent, or during a trajectory.
    """
    if not burst[0].second:
        return _sent_to_server(prepared, link, burst)
    bench = prepared.bench
    if prepared.state in ACTIVE and prepared.state != "receiving":
        link.send(b"".join(trial.data for trial in burst))
        bench.controller.run_until(lambda: link.lost, timeout=0.3 * bench.setting.slowness)
        return not link.lost
    bench.run(TAKEN_OVER)
    return _sent_to_server(prepared, link, burst)


def _sent_to_state_server(prepared: Prepared, link: RawLink, burst: Burst) -> bool:
    """Send a message to the state server: it answers HELLO, or disconnects."""
    bench, seen = prepared.bench, len(link.frames)
    link.send(burst[0].data)

    def answered() -> bool:
        return link.lost or any(frame.number == messages.HELLO for _, frame in link.frames[seen:])

    bench.controller.run_until(answered, timeout=0.4 * bench.setting.slowness)
    return not link.lost and answered()


_SEND: dict[Port, Callable[[Prepared, RawLink, Burst], bool]] = {
    "motion": _sent_to_motion_server,
    "control": _sent_to_server,
    "state": _sent_to_state_server,
}


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
    bench.run(0.3 * bench.setting.slowness)
    bench.wait_until_standing()
    if not _runs(bench):
        bench.run(1.2)
        bench.start_again()
        bench.run(2.5)
    control = bench.control()
    _asked(bench, control)
    watcher = bench.watcher()
    bench.progress(watcher)
    motion = bench.motion()
    bench.assert_moves_through(motion, bench.wave(3, duration=0.2))
    for link in (motion, control):
        motion.send(_long(bench))
        bench.wait_until_moving()
        bench.run(0.2)
        link.stop(what="STOP on the motion port" if link is motion else "STOP on the control port")
        bench.wait_until_at_rest(1, 0.2, "it was stopped")
    status = bench.status(watcher)
    if not status.motion_possible:
        raise CheckFailed(f"in the end no motion is possible: {status}")
    for link in (motion, control, watcher):
        link.close()
    bench.assert_healthy()


def _runs(bench: Bench) -> bool:
    """True if the program runs, so that an operator need not start it."""
    controller = bench.controller
    return controller.motors_on and controller.task(bench.group.task).state == "running"


def ended(port: Port) -> Trial:
    """Return a message that ends a task of a faulty driver.

    The faulty driver packs an unknown message type into its reply.
    """
    data = struct.pack("<iiii", 12, 2**31 - 1, RawComm.REQUEST, 0)
    return Trial("idle", port, False, "PING.msg_type=2147483647", data)
