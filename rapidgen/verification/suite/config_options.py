"""Configuration options: scaling, slow TCP, allowed clients."""

from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Point, changed, distance
from rapidgen.verification.raw_connection import STOP, raw_point
from rapidgen.verification.stream import BEGIN, END, Streamer
from rapidgen.verification.testbench import Bench

case = SuiteGroup("edges")
links = SuiteGroup("links")
reading = SuiteGroup("reading")


def _quick(bench: Bench) -> list[Point]:
    """Return a motion to a place and back, too fast for the first axis."""
    joint, current = bench.group.joints[0], bench.position
    step = min(1.0, 0.5 * max(joint.upper - current[0], current[0] - joint.lower))
    if joint.upper - current[0] < current[0] - joint.lower:
        step = -step
    seconds = 0.3 * abs(step) / joint.speed
    target = changed(current, 0, current[0] + step)
    return [(current, 1.0), (target, seconds), (changed(current, 0, current[0] + 0.9 * step), 1.0)]


@case("slowed-down", "what is too fast is slowed down if so configured", "R10")
def _slowed_down(bench: Bench) -> None:
    if bench.config.trajectory.too_fast != "slow_down":
        raise NotApplicable("`too_fast` refuses")
    for streaming in (False, True) if bench.streams else (False,):
        points, last, since = _quick(bench), bench.last_event, bench.now
        if streaming:
            stream = Streamer(bench)
            stream.takes("a stream that is too fast", points, BEGIN | END)
        else:
            bench.motion().send(bench.download(points))
        bench.arrives(points, since, 20)
        if not any("slowed down" in str(e) for e in bench.controller.log.since(last)):
            raise CheckFailed("a trajectory was slowed down, the event log does not say so")
        bench.run(1.5)


@links("strangers", "addresses that the configuration does not name are not served")
def _unlisted_clients(bench: Bench) -> None:
    """Connect from other addresses, which must not replace clients either."""
    if not bench.config.allowed_clients:
        raise NotApplicable("`allowed_clients` names none")
    ports, known = bench.group.ports, [bench.state() for _ in range(3)]
    bench.run(0.5)
    for port in (ports.motion, ports.state, ports.control):
        unlisted = bench.connect_unlisted(port) if port else None
        if unlisted is None:
            continue
        unlisted.send(bench.download(bench.wave(4)))
        bench.assert_at_rest(1, "a client that is not listed sent it")
        if not unlisted.lost or unlisted.read():
            raise CheckFailed(f"a client that is not listed is served on port {port}")
    if any(link.lost for link in known):
        raise CheckFailed("clients that are not listed replace others")
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@links("stalls", "a client that stalls inside of a message is dropped if so configured", "R12")
def _stalls(bench: Bench) -> None:
    seconds = bench.config.receive_timeout
    link = bench.motion()
    link.send(raw_point(-1, bench.position, 1.0)[:40])
    bench.run(seconds - 0.5 if seconds else 60)
    if link.lost:
        raise CheckFailed("a client that takes its time is dropped")
    if seconds:
        link.wait_disconnected(2, "a client that stalls inside of a message is dropped")
    else:
        link.close()
    bench.assert_moves_through(bench.motion(), bench.wave(3))


@links(
    "control-silent",
    "a control client that does not read harms no other client",
    "R13",
    needs="control",
)
def _control_silent(bench: Bench) -> None:
    silent, link = bench.control(), bench.motion()
    bench.run(0.2)
    silent.stop_reading()
    for _ in range(3):
        bench.start_motion(link, bench.wave(12), 0.3)
        link.send(STOP)
        if link.reply(messages.JOINT_TRAJ_PT) != messages.RawAcknowledged():
            raise CheckFailed("STOP is not confirmed while a control client does not read")
        bench.wait_until_standing(3)
        bench.run(0.5)
        bench.assert_moves_through(link, bench.wave(3))


@reading("braking", "a robot that brakes is in motion, one that has stopped is not", "R16")
def _braking(bench: Bench) -> None:
    state, link = bench.state(), bench.motion()
    period = bench.config.state_period
    for _ in range(3):
        bench.start_motion(link, bench.wave(12, size=0.3), 0.6)
        link.send(STOP)
        since = bench.now
        bench.wait_until_standing(3)
        stood = bench.now - 0.1
        bench.run(4 * period + bench.setting.motion.settle)
        for when, status in state.messages_of(messages.RawStatus, since):
            if when < stood - 0.005 and not status.in_motion:
                raise CheckFailed(f"at {when:.3f} s the robot brakes, STATUS says {status}")
        if state.messages_of(messages.RawStatus, since)[-1][1].in_motion:
            raise CheckFailed("the robot is at rest, STATUS reports motion")


@reading("there-and-back", "a movement back and forth between two STATUS is in one of them", "R16")
def _there_and_back(bench: Bench) -> None:
    """Move out and back between two messages: no axis has moved since the last."""
    state, link = bench.state(), bench.motion()
    bench.run(2 * bench.config.state_period)
    for _ in range(3):
        bench.status(state)
        current, since = bench.position, bench.now
        away = bench.wave(2, duration=0.15, size=0.002)[1][0]
        link.send(bench.download([(current, 1.0), (away, 0.15), (current, 0.15)]))
        bench.run(0.6 + 2 * bench.config.state_period + 2 * bench.setting.motion.settle)
        if distance(bench.position, current) > 1e-4:
            raise CheckFailed("a movement there and back does not end where it began")
        moved = [status.in_motion for _, status in state.messages_of(messages.RawStatus, since)]
        if 1 not in moved or moved[-1]:
            raise CheckFailed(f"a movement there and back: STATUS says {moved}")
