"""State clients: several, slow ones, feedback, events, limits."""

import struct
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

from rapidgen.generate.context import WRAP
from rapidgen.machine.event_log import EventType
from rapidgen.machine.network.interface import BUFFER, NetworkFault
from rapidgen.machine.network.memory import MemoryEndpoint
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawComm, RawFeature, RawReason
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.suite.refusals import refused
from rapidgen.verification.suite.state_port import PLAIN, on_turn, rounds, subscribe
from rapidgen.verification.testbench import Bench

case = SuiteGroup("watching")

_CLIENTS = 3
"""Clients that the state port serves at a time, as docs/reference/driver.md says."""
_WAITING = 16
"""Maximum number of queued events."""


@case("several-watch", "three clients at once, and which one a fourth replaces")
def _several_watch(bench: Bench) -> None:
    """Serve three clients; a fourth replaces the latest, or takes a free place."""
    links: list[RawLink] = []
    for number in range(_CLIENTS + 3):
        lost = [link.lost for link in links]
        came = bench.now
        links.append(bench.state())
        soon = 0.2 + 2 * bench.config.state_period
        bench.until(lambda: bool(links[-1].frames), soon, f"client {number + 1} gets a round")
        bench.run(3 * bench.config.state_period)
        if number >= _CLIENTS:
            lost[-1] = True
        if [link.lost for link in links[:-1]] != lost:
            raise CheckFailed(f"client {number + 1} came, lost are {[link.lost for link in links]}")
        on_turn(bench, rounds(links[0], came - 1), f"client {number + 1} came")
    for leaves, abort in ((1, False), (0, True)):
        served = [link for link in links if not link.lost]
        subscribe(bench, RawFeature.PROGRESS | RawFeature.FEEDBACK, served[leaves])
        since = bench.now
        served[leaves].close(abort=abort, then=1)
        links.append(bench.state())
        bench.run(1)
        served = [link for link in links if not link.lost]
        if len(served) != _CLIENTS:
            raise CheckFailed(
                f"one of {_CLIENTS} clients left, another came, {len(served)} are served"
            )
        on_turn(bench, rounds(served[0], since), "one left, another came")
        if any(one.numbers != PLAIN for one in rounds(links[-1], since)):
            raise CheckFailed(
                "a replacing client gets messages that the replaced one had requested"
            )
    since = bench.now
    bench.run(1)
    tails = [[f for _, f in link.frames[-10:]] for link in links if not link.lost]
    if tails[1:] != tails[:-1]:
        raise CheckFailed("clients get different messages at one time")


def _fill(bench: Bench, link: RawLink, free: int = 0) -> None:
    """Fill a client's buffers, as after minutes without reading.

    `free` bytes stay free.
    """
    end = link.endpoint
    assert isinstance(end, MemoryEndpoint)
    assert end.incoming is not None
    network, pipe = bench.controller.network, end.incoming
    left = 2 * BUFFER - len(pipe.arrived) - pipe.flying - len(pipe.waiting) - free
    while left:
        size = left if left <= 1024 else min(1024, left - 16)
        # An unrequested reply: it is part of no round.
        frame = struct.pack("<4i", size - 4, messages.PING, RawComm.REPLY, 0)
        while len(pipe.waiting) + size > BUFFER:
            bench.run(0.001)
        try:
            left -= network.send(pipe.sender, frame + bytes(size - 16))
        except NetworkFault as fault:
            raise CheckFailed(f"a client was not served any more: {fault}") from fault


def _held(bench: Bench) -> bool:
    return bench.waits_in("ROS_stateServer", "SocketSend")


def _until_held(bench: Bench) -> float:
    """Let time pass until a send blocks; return when it started."""
    since = [bench.now]

    def stuck() -> bool:
        if not _held(bench):
            since[0] = bench.now
        return bench.now - since[0] > 0.01

    bench.until(stuck, 1, "a send waits for a client that does not read")
    return since[0]


def _is_dropped(bench: Bench, link: RawLink, reader: RawLink) -> None:
    """Check that a client with full buffers is dropped, and the other works."""
    since = _until_held(bench)
    bench.until(lambda: not _held(bench), 70, "a send ends")
    held = bench.now - since
    # If no trap interrupts a send, it lasts until its own time-out. The trap of the pulse may come
    # between the alarm and the send.
    least = 0.1 - 0.005 * bench.setting.slowness
    if bench.setting.dialect.send_attends and not least <= held < 0.35:
        raise CheckFailed(f"a client that does not read has held up others for {held:.3f} s")
    bench.run(1)
    result = rounds(reader, since)
    gaps = [b.time - a.time for a, b in pairwise(result)]
    if any(a + b < 0.8 * bench.config.state_period for a, b in pairwise(gaps)):
        raise CheckFailed("what could not be sent in time comes in a burst")
    on_turn(bench, result[1:], "after a client that did not read")
    link.read_on()
    link.wait_disconnected(5, "a client that does not read is dropped")


@case(
    "does-not-read",
    "a state client that does not read delays the others only briefly",
    "R13",
    needs="events",
)
def _does_not_read(bench: Bench) -> None:
    """Stop reading: others miss one round, and the client is dropped.

    A slow client is not dropped.
    """
    silent, reader = bench.state(reading=False), bench.state()
    bench.run(1)
    _fill(bench, silent)
    _is_dropped(bench, silent, reader)
    for _ in range(2):
        slow = bench.state(reading=False)
        bench.run(0.5)
        _fill(bench, slow)
        bench.run(_until_held(bench) + 0.15 - bench.now)
        slow.read_on()
        since = bench.now + bench.config.state_period
        bench.run(0.8)
        if slow.lost:
            raise CheckFailed("a client that was slow for 0.15 s is dropped")
        on_turn(bench, rounds(slow, since), "a client that was slow")
    # It has space for all rounds until the next event, but not for later events.
    slow.close(then=0.5)
    silent = subscribe(bench, RawFeature.EVENTS)
    silent.stop_reading()
    subscribe(bench, RawFeature.EVENTS, reader)
    since = bench.now
    _write(bench, 1, "First")
    bench.until(
        lambda: bool(reader.messages_of(messages.RawEvent, since)), 1, "an event is reported"
    )
    bench.run(0.01)
    times = max(1, round(0.1 / bench.config.state_period))
    size = messages.STATE_BYTES
    _fill(bench, silent, free=times * size + 50)
    _write(bench, 2, "Second")
    _is_dropped(bench, silent, reader)
    _fails_to_send(bench, reader)


def _fails_to_send(bench: Bench, reader: RawLink) -> None:
    """Fail a send: its client is dropped, as the sent part is unknown."""
    recovers = fails(bench, "ROS_stateServer", "SocketSend", "ERR_SOCK_CLOSED", _CLIENTS)
    reader.wait_disconnected(0.3, "a client is dropped when a send to it fails")
    recovers()
    bench.status(bench.state(), 1)


@case("breaks-in-send", "a state client that is reset while the server sends", "R13")
def _breaks_in_a_send(bench: Bench) -> None:
    """Reset a client that does not read while the server sends to it."""
    silent, reader = bench.state(reading=False), bench.state()
    bench.run(1)
    _fill(bench, silent)
    _until_held(bench)
    silent.close(abort=True, then=0.2)
    since = bench.now
    bench.run(2)
    on_turn(bench, rounds(reader, since), "another client was reset")
    _fails_to_send(bench, reader)


@case("feedback", "JOINT_FEEDBACK: time, positions and velocities", needs="feedback")
def _feedback(bench: Bench) -> None:
    first = subscribe(bench, RawFeature.FEEDBACK)
    link = subscribe(bench, RawFeature.FEEDBACK | RawFeature.PROGRESS)
    motion = bench.motion()
    points: list[Point] = bench.wave(8)
    motion.send(bench.download(points))
    bench.wait_until_at(points[-1][0])
    bench.run(1)
    for one in (first, link):
        reply = one.messages_of(messages.RawJointFeedback)
        if len(reply) < 20:
            raise CheckFailed(f"{len(reply)} JOINT_FEEDBACK came")
        _is_motion(bench, reply[2:])
    seen = {reply.joints for _, reply in link.messages_of(messages.RawJointPosition)}
    if any(reply.positions not in seen for _, reply in link.messages_of(messages.RawJointFeedback)):
        raise CheckFailed("JOINT_FEEDBACK tells other joints than JOINT")
    if bench.state().messages_of(messages.RawJointFeedback):
        raise CheckFailed("JOINT_FEEDBACK comes to a client that did not ask for it")


def _is_motion(bench: Bench, reply: Sequence[tuple[float, messages.RawJointFeedback]]) -> None:
    """Check that positions, times and velocities agree."""
    count = len(bench.position)
    moved = False
    for (_, before), (when, now) in pairwise(reply):
        seconds = now.time - before.time
        if abs(seconds - bench.config.state_period) > 0.5 * bench.config.state_period:
            raise CheckFailed(
                f"time stamps of JOINT_FEEDBACK are {seconds:.3f} s apart at {when:.2f} s"
            )
        if now.valid_fields != 0b111:
            raise CheckFailed(f"JOINT_FEEDBACK holds fields {now.valid_fields:#b}")
        for joint in range(count):
            gone = (now.positions[joint] - before.positions[joint]) / seconds
            if abs(gone - now.velocities[joint]) > 1e-3 + 0.01 * abs(gone):
                raise CheckFailed(
                    f"joint {joint + 1} moved with {gone:.4f}/s, JOINT_FEEDBACK says "
                    f"{now.velocities[joint]:.4f}"
                )
            moved = moved or abs(gone) > 0.01
        if any(now.positions[count:]) or any(now.velocities[count:]) or any(now.accelerations):
            raise CheckFailed(f"JOINT_FEEDBACK tells what the robot does not have: {now}")
    if not moved:
        raise CheckFailed("no JOINT_FEEDBACK shows the motion")


_Event: TypeAlias = tuple[int, int, int, str, str, str]
"""Domain, number, type, title and the texts below it."""


def _write(
    bench: Bench, number: int, title: str, kind: EventType = EventType.WARNING, *texts: str
) -> None:
    """Write an event of the state server's task.

    Some controllers do not report events of other tasks.
    """
    task = bench.task("ROS_stateServer")
    code = 10_000 * (number % 9 + 1) + number
    bench.controller.log.write(code, kind, title, *texts, task=task)


def _expect_events(link: RawLink, since: float, expected: Sequence[_Event]) -> None:
    """Check that exactly these events arrived in order, ten a second at most."""
    result = link.messages_of(messages.RawEvent, since)
    reply = [(e.domain, e.number, e.type, e.title.rstrip(), e.first, e.second) for _, e in result]
    if reply != list(expected):
        raise CheckFailed(f"wanted are events {expected}, EVENT reported {reply}")
    # One event is late, and the next one in time: closer than they were sent, but ten still take a
    # second.
    times = [when for when, _ in result]
    near = any(b - a < 0.05 for a, b in pairwise(times))
    if near or any(b - a < 0.95 for a, b in zip(times, times[10:], strict=False)):
        raise CheckFailed(f"events come at {times}")


def _burst(bench: Bench, link: RawLink, count: int) -> tuple[float, list[_Event]]:
    """Write an event and `count` others at its report; return the expected.

    The result is a time and the list of events.
    """
    since, kinds = bench.now, tuple(EventType)
    before = len(link.messages_of(messages.RawEvent))
    _write(bench, 100, "First")
    bench.until(
        lambda: len(link.messages_of(messages.RawEvent)) > before, 1, "an event is reported"
    )
    expected: list[_Event] = [(2, 100, 2, "First", "", "")]
    for number in range(count):
        # A title holds 80 characters; one may be empty.
        title = "" if number == 7 else f"Größe {number} " + number % 5 * "of a long row "
        below = ("", f"cell/weld/{number}", "x" * 80)[number % 3], "y" * 80 * (number % 2)
        _write(bench, number, title * (1 + 9 * (number == 9)), kinds[number % 3], *below)
        text = (title * (1 + 9 * (number == 9)))[:80].rstrip()
        expected.append((number % 9 + 1, number, number % 3 + 1, text, *below))
    if count > _WAITING:
        expected[_WAITING + 1 :] = [(0, count - _WAITING, 2, "Events that were not sent", "", "")]
    return since, expected


@case("events", "EVENT tells the controller's events to those who ask", needs="events")
def _events(bench: Bench) -> None:
    links = [subscribe(bench, RawFeature.EVENTS), bench.state()]
    links.append(subscribe(bench, RawFeature.EVENTS | RawFeature.PROGRESS))
    server = bench.controller.task(bench.task("ROS_stateServer"))
    for name in ("events_written", "events_read"):
        # The last values of counters come after years.
        server[f"ROS_stateServer:{name}"] = WRAP - 12
    for count in (12, 16, 17, 21):
        since, expected = _burst(bench, links[0], count)
        bench.run(0.12 * (len(expected) + 2))
        for link in (links[0], links[2]):
            _expect_events(link, since, expected)
        if links[1].messages_of(messages.RawEvent):
            raise CheckFailed("EVENT comes to a client that did not ask for it")
    # No client needs the waiting events, nor the number of the others.
    since, expected = _burst(bench, links[0], 20)
    subscribe(bench, RawFeature.PROGRESS, links[2])
    subscribe(bench, RawFeature.PROGRESS, links[0])
    bench.run(0.3)
    seen, started = len(links[0].messages_of(messages.RawEvent, since)), since
    for number in range(100):
        _write(bench, number, "No client listens")
    bench.run(0.5)
    bench.assert_healthy()
    since = bench.now
    subscribe(bench, RawFeature.EVENTS, links[2])
    bench.run(0.5)
    if (
        seen > 8
        or len(links[0].messages_of(messages.RawEvent, started)) > seen
        or links[2].messages_of(messages.RawEvent, since)
    ):
        raise CheckFailed("events from before HELLO are reported")
    since, expected = _burst(bench, links[2], 2)
    bench.run(0.5)
    _expect_events(links[2], since, expected)
    links[2].close(then=0.5)
    for number in range(100):
        _write(bench, number, "Who listened has left")
    bench.run(0.5)


@case("read-limits", "limits read from the controller count where they are narrower")
def _limits_of_the_controller(bench: Bench) -> None:
    """Narrow a joint's limits on the controller: they apply."""
    if not bench.setting.dialect.axis_limits_readable:
        raise NotApplicable("the controller does not tell limits of axes")
    group = bench.group
    joint = group.joints[0]
    middle, half = (joint.lower + joint.upper) / 2, (joint.upper - joint.lower) / 2
    narrow = replace(joint, lower=middle - 0.7 * half, upper=middle + 0.7 * half)
    robots = tuple(
        replace(g, joints=(narrow, *g.joints[1:])) if g.name == group.name else g
        for g in bench.config.groups
    )
    with bench.second_controller(bench.system, robots) as other:
        link = other.state()
        reply = other.send_hello(link)
        if abs(reply.lower[0] - narrow.lower) + abs(reply.upper[0] - narrow.upper) > 1e-4:
            raise CheckFailed(
                f"joint 1 may move from {narrow.lower:.4f} to {narrow.upper:.4f}, HELLO says "
                f"{reply.lower[0]:.4f} to {reply.upper[0]:.4f}"
            )
        log_entries = [e for e in other.controller.log if "joint 1 are narrower" in str(e)]
        if len(log_entries) != 1:
            raise CheckFailed(
                f"limits differ from the controller's, the event log says {len(log_entries)}"
            )
        for value in (narrow.lower - 0.05 * half, narrow.upper + 0.05 * half):
            points = [(p, 60.0) for p, _ in other.wave(4)]
            points[2] = ((value, *points[2][0][1:]), 60.0)
            refused(other, other.download(points), [RawReason.JOINT_LIMIT], 1, 2)
        for value in (narrow.lower, narrow.upper):
            current = other.position
            target = (value, *current[1:])
            seconds = other.seconds_to(target)
            motion = other.motion()
            motion.send(other.download([(current, 10.0), (target, seconds), (target, 0.5)]))
            other.wait_until_at(target, 20 + 4 * seconds)
            motion.close(then=1.5)
