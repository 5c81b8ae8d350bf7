"""Those who watch: several at once, some that do not read, feedback, events, read limits."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from rapidgen.protocol import decode, encode, messages, spec
from rapidgen.protocol.spec import Feature
from rapidgen.proving.bench import HELLO, Bench
from rapidgen.proving.link import Link, Point
from rapidgen.proving.model import Broken, Case
from rapidgen.proving.suite.refusals import refused

_CLIENTS = 3
"""Clients that the state port serves at a time, as docs/driver.md promises."""
_BUFFERS = 262_144
"""Bytes that lie on the way to a client that does not read, at most."""


def _stamps(link: Link, since: float = 0.0) -> list[float]:
    return [when for when, f in link.frames if f.number == spec.STATUS.number and when >= since]


def _on_schedule(bench: Bench, link: Link, since: float, what: str) -> None:
    """Broken unless STATUS came at the set rate, each within a period of its turn."""
    stamps, period = _stamps(link, since), bench.config.state_period
    wanted = (bench.now - since) / period
    if abs(len(stamps) - wanted) > 3:
        raise Broken(f"{what}: {len(stamps)} STATUS in {bench.now - since:.0f} s, not {wanted:.0f}")
    for i, when in enumerate(stamps):
        if abs(when - (stamps[0] + i * period)) > period:
            raise Broken(f"{what}: STATUS at {when:.3f} s is more than a period off")


def _several_watch(bench: Bench) -> None:
    links: list[Link] = []
    for _ in range(_CLIENTS):
        links.append(bench.state())
        bench.run(1)
    since = bench.now
    bench.run(5)
    for number, link in enumerate(links, 1):
        _on_schedule(bench, link, since, f"client {number} of {_CLIENTS}")
    tails = [[f for _, f in link.frames[-20:]] for link in links]
    if tails[1:] != tails[:-1]:
        raise Broken("clients at one time are told different things")
    links.append(bench.state())
    bench.run(2)
    if [link.lost for link in links] != [False] * (_CLIENTS - 1) + [True, False]:
        raise Broken(f"client {_CLIENTS + 1} came: {[link.lost for link in links]} are dropped")
    links[1].close()
    bench.run(1)
    links.append(bench.state())
    bench.run(1)
    since = bench.now
    bench.run(5)
    for link in (links[0], links[3], links[4]):
        _on_schedule(bench, link, since, "after others came and went")


def _does_not_read(bench: Bench) -> None:
    """Others keep their rate, and it is dropped when nothing more fits on the way to it."""
    silent, reader = bench.state(reading=False), bench.state()
    bench.run(1)
    since = bench.now
    link = bench.motion()
    bench.run(_BUFFERS * bench.config.state_period / 72 + 10)
    period = bench.config.state_period
    stamps = _stamps(reader, since)
    gaps = [b - a for a, b in pairwise(stamps)]
    # Where no trap comes into a send it lasts until that gives up by itself.
    longest = period + (1 if bench.setting.dialect.send_attends else 62)
    if max(gaps) > longest or sum(gap > 1.6 * period for gap in gaps) > 3:
        raise Broken(f"beside a client that does not read another one waited {max(gaps):.2f} s")
    if any(a + b < 0.8 * period for a, b in pairwise(gaps)):
        raise Broken("what could not be sent in time comes in a burst")
    bench.moves_through(link, bench.wave(5))
    silent.read_on()
    bench.until(lambda: silent.lost, 5, "a client that does not read is dropped")
    fresh = bench.state()
    bench.status(fresh, 3)


def _breaks_in_a_send(bench: Bench) -> None:
    """A client that does not read is reset while the server has bytes for it."""
    silent, reader = bench.state(reading=False), bench.state()
    bench.run(_BUFFERS * bench.config.state_period / 144)
    silent.close(abort=True)
    bench.run(1)
    since = bench.now
    bench.run(5)
    _on_schedule(bench, reader, since, "after another client was reset")


def _hello(bench: Bench, features: Feature) -> Link:
    link = bench.state()
    link.send(encode(HELLO._replace(subscribe=int(features)), spec.Comm.REQUEST))
    link.expect(messages.HelloReply, 2, "HELLO is answered")
    return link


def _feedback_of(link: Link) -> list[tuple[float, messages.JointFeedback]]:
    found = [(when, decode(frame)) for when, frame in link.frames]
    return [(when, told) for when, told in found if isinstance(told, messages.JointFeedback)]


def _feedback(bench: Bench) -> None:
    first = _hello(bench, Feature.FEEDBACK)
    link = _hello(bench, Feature.FEEDBACK | Feature.PROGRESS)
    motion = bench.motion()
    points: list[Point] = bench.wave(8)
    motion.send(bench.download(points))
    bench.wait_until_at(points[-1][0])
    bench.run(1)
    for one in (first, link):
        told = _feedback_of(one)
        if len(told) < 20:
            raise Broken(f"{len(told)} JOINT_FEEDBACK came")
        _is_motion(bench, told[2:])
    joints = [decode(f) for _, f in link.frames if f.number == spec.JOINT_POSITION.number]
    seen = {j.joints for j in joints if isinstance(j, messages.JointPosition)}
    if any(told.positions not in seen for _, told in _feedback_of(link)):
        raise Broken("JOINT_FEEDBACK tells other joints than JOINT")
    if _feedback_of(bench.state()):
        raise Broken("JOINT_FEEDBACK comes to a client that did not ask for it")


def _is_motion(bench: Bench, told: Sequence[tuple[float, messages.JointFeedback]]) -> None:
    """Positions, times and velocities belong together."""
    count = len(bench.position)
    moved = False
    for (_, before), (when, now) in pairwise(told):
        seconds = now.time - before.time
        if abs(seconds - bench.config.state_period) > 0.5 * bench.config.state_period:
            raise Broken(f"time stamps of JOINT_FEEDBACK are {seconds:.3f} s apart at {when:.2f} s")
        if now.valid_fields != 0b111:
            raise Broken(f"JOINT_FEEDBACK holds fields {now.valid_fields:#b}")
        for joint in range(count):
            gone = (now.positions[joint] - before.positions[joint]) / seconds
            if abs(gone - now.velocities[joint]) > 1e-3 + 0.01 * abs(gone):
                raise Broken(
                    f"joint {joint + 1} moved with {gone:.4f}/s, JOINT_FEEDBACK says "
                    f"{now.velocities[joint]:.4f}"
                )
            moved = moved or abs(gone) > 0.01
        if any(now.positions[count:]) or any(now.velocities[count:]) or any(now.accelerations):
            raise Broken(f"JOINT_FEEDBACK tells what the robot does not have: {now}")
    if not moved:
        raise Broken("no JOINT_FEEDBACK shows the motion")


def _events(bench: Bench) -> None:
    link, plain = _hello(bench, Feature.EVENTS), bench.state()
    bench.run(0.5)
    write = bench.controller.log.warning
    for number in range(3):
        write(80_100 + number, f"Trial {number}")
        bench.run(0.5)
    told = [
        content for _, frame in link.frames if isinstance(content := decode(frame), messages.Event)
    ]
    wanted = [(8, 100 + n, 2, f"Trial {n}") for n in range(3)]
    if [(e.domain, e.number, e.type, e.title.rstrip("\0 ")) for e in told] != wanted:
        raise Broken(f"three events were written, EVENT told {told}")
    if any(f.number == spec.EVENT.number for _, f in plain.frames):
        raise Broken("EVENT comes to a client that did not ask for it")
    for number in range(25):
        write(80_150 + number, "Flood")
    bench.run(6)
    bench.healthy()
    floods = [
        content
        for _, frame in link.frames
        if isinstance(content := decode(frame), messages.Event) and content.title.startswith("F")
    ]
    if not 8 <= len(floods) <= 25:
        raise Broken(f"of 25 events at once {len(floods)} are told")
    link.close()
    bench.run(1)
    for number in range(100):
        write(80_200 + number, "Nobody listens")
    bench.run(1)
    bench.healthy()
    link = _hello(bench, Feature.EVENTS)
    bench.run(1)
    if any(f.number == spec.EVENT.number for _, f in link.frames):
        raise Broken("events from before HELLO are told")


def _limits_of_the_controller(bench: Bench) -> None:
    """A joint that the controller lets move less has those limits."""
    if not bench.setting.dialect.axis_limits_told:
        return
    group = bench.group
    joint = group.joints[0]
    middle, half = (joint.lower + joint.upper) / 2, (joint.upper - joint.lower) / 2
    narrow = replace(joint, lower=middle - 0.7 * half, upper=middle + 0.7 * half)
    robots = tuple(
        replace(g, joints=(narrow, *g.joints[1:])) if g.name == group.name else g
        for g in bench.config.groups
    )
    other = bench.beside(bench.system, robots)
    try:
        link = other.state()
        link.send(encode(HELLO, spec.Comm.REQUEST))
        told = link.expect(messages.HelloReply, 2, "HELLO is answered")
        if abs(told.lower[0] - narrow.lower) + abs(told.upper[0] - narrow.upper) > 1e-4:
            raise Broken(
                f"joint 1 may move from {narrow.lower:.4f} to {narrow.upper:.4f}, HELLO says "
                f"{told.lower[0]:.4f} to {told.upper[0]:.4f}"
            )
        said = [e for e in other.controller.log if "joint 1 are narrower" in str(e)]
        if len(said) != 1:
            raise Broken(f"limits differ from the controller's, the event log says {len(said)}")
        for value in (narrow.lower - 0.05 * half, narrow.upper + 0.05 * half):
            points = [(p, 60.0) for p, _ in other.wave(4)]
            points[2] = ((value, *points[2][0][1:]), 60.0)
            refused(other, other.download(points), [spec.Reason.JOINT_LIMIT], 1, 2)
        for value in (narrow.lower, narrow.upper):
            here = other.position
            target = (value, *here[1:])
            seconds = max(0.5, 2 * abs(value - here[0]) / joint.speed)
            motion = other.motion()
            motion.send(other.download([(here, 10.0), (target, seconds), (target, 0.5)]))
            other.wait_until_at(target, 20 + 4 * seconds)
            motion.close()
            other.run(1.5)
    finally:
        other.close()


CASES = (
    Case("several-watch", "three clients at once, a fourth takes the third one's place", "watching",
         _several_watch),
    Case("does-not-read", "a state client that does not read holds nobody up", "watching",
         _does_not_read, "R13"),
    Case("breaks-in-send", "a state client that is reset while the server sends", "watching",
         _breaks_in_a_send, "R13"),
    Case("feedback", "JOINT_FEEDBACK: time, positions and velocities", "watching", _feedback),
    Case("events", "EVENT tells the controller's events to those who ask", "watching", _events),
    Case("read-limits", "limits read from the controller count where they are narrower",
         "watching", _limits_of_the_controller),
)  # fmt: skip
