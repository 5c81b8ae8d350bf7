"""Program instructions besides moves: signals, waits, settings."""

import math
import random
from collections.abc import Sequence
from dataclasses import replace

from rapidgen.config.model import ExposedSignal
from rapidgen.motion.moves import Singularities
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.position_checks import Position
from rapidgen.verification.raw_programs import (
    ALL,
    Programmer,
    RawMove,
    computes,
    kinds_with_marks,
    orders,
    reached,
)
from rapidgen.verification.suite.programs import corners_made
from rapidgen.verification.testbench import Bench

case = SuiteGroup("programs", needs="stream")

SET, WAIT_SIGNAL, SETTINGS = RawInstruction.SET, RawInstruction.WAIT_SIGNAL, RawInstruction.SETTINGS
MOVES = (RawInstruction.MOVE_L, RawInstruction.MOVE_J)
START, END, TIME = 0.0, 1.0, 2.0
"""Where a signal is set: m after the start, m before the end, s before it."""
_AWAY = 0.003
"""m and s by which a signal may be late or early."""


@case("program-signals", "signals are set on the way of a move, at its distances and times")
def _signals(bench: Bench) -> None:
    """Set each writable signal on a line and a joint move; reject others."""
    exposed = bench.config.signals
    client = Programmer(bench)
    first, *_, last = orders(bench, 4, random.Random(21))
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    written = [n for n, s in enumerate(exposed) if s.access == "write" and s.kind[1] == "O"]
    if not written or not computes(bench):
        reply = client.send([replace(first, marks=((0.0, 1.0, START, 0.01),))])
        if not isinstance(reply, messages.RawPointsRefused):
            raise CheckFailed(f"no signal is set on the way here, the reply is {reply}")
        return
    target = replace(last, kind=MOVES[0], pose=reached(bench, last.joints), speed=0.1)
    back = replace(target, joints=first.joints, pose=reached(bench, first.joints))
    middle = [(a + b) / 2 for a, b in zip(first.joints, last.joints, strict=True)]
    (x, y, z), turned = reached(bench, tuple(middle))
    # A circle that is not level turns the tool out of a SCARA's reach.
    level = bench.motion_group.map.two_sided
    kinds = [k for k in kinds_with_marks(bench) if k is not RawInstruction.MOVE_C or not level]
    for kind in kinds:
        for number in written:
            for go, from_there in ((target, first), (back, target)):
                own = replace(
                    go,
                    kind=kind,
                    pose=None if kind is RawInstruction.MOVE_ABSJ else go.pose,
                    via=((x, y, z + 0.01), turned) if kind is RawInstruction.MOVE_C else None,
                )
                _one_way(bench, client, own, from_there.joints, number)
    path = ((x, y, z + 0.01), turned)
    for kind in kinds:
        if kind is RawInstruction.MOVE_ABSJ:
            continue
        client.takes("a program", [replace(first, kind=RawInstruction.MOVE_ABSJ, pose=None)])
        bench.wait_until_at(first.joints, 60)
        bench.run(0.5)
        via = path if kind is RawInstruction.MOVE_C else None
        _eight(bench, client, replace(target, kind=kind, via=via), written[0])
    _wrong_marks(bench, client, replace(back, kind=MOVES[0]), written[0])
    marks = ((float(written[0]), 1.0, START, 0.01),)
    for order in (replace(target, kind=MOVES[1]), first):
        if order.kind not in kinds:
            reply = client.send([replace(order, marks=marks)])
            client.refused(reply, RawReason.NO_INSTRUCTION, 0, "signals on the way of a joint move")


def _one_way(
    bench: Bench, client: Programmer, order: RawMove, start: Position, number: int
) -> None:
    """Set one signal at three places of a move from `start`."""
    signal = bench.controller.io[bench.config.signals[number].name]
    bench.controller.io.set(signal, 0)
    seen: list[tuple[float, float, Position]] = []

    def note() -> None:
        seen.append((signal.value, bench.now, tuple(bench.motion_group.commanded())))

    signal.changed.add(note)
    own = ((START, 0.01), (END, 0.015), (TIME, 0.05))
    marks = [(float(number), float(v), *at) for v, at in zip((1, 0, 1), own, strict=True)]
    client.takes("signals on the way", [replace(order, marks=tuple(marks))])
    bench.wait_until_at(order.joints, 60)
    finished = bench.track[-1][0]
    signal.changed.remove(note)
    if [value for value, _, _ in seen] != [1, 0, 1]:
        raise CheckFailed(f"{signal.name} was to be 1, 0, 1 on the way, and was {seen}")
    begin, end = bench.tcp(start), bench.tcp(order.joints)
    (_, _, on), (_, _, off), (_, when, _) = seen
    straight = order.kind is RawInstruction.MOVE_L
    far = (math.dist(begin, bench.tcp(on)), math.dist(end, bench.tcp(off)))
    if straight and max(abs(far[0] - 0.01), abs(far[1] - 0.015)) > _AWAY:
        raise CheckFailed(f"{signal.name} was set {far} m from the ends, not 0.01 and 0.015")
    if not 0 < finished - when < 0.3:
        raise CheckFailed(f"{signal.name} was set {finished - when:.3f} s before the end, not 0.05")


def _eight(bench: Bench, client: Programmer, order: RawMove, number: int) -> None:
    """Set as many signals as one move allows, on four moves in sequence."""
    signal = bench.controller.io[bench.config.signals[number].name]
    bench.controller.io.set(signal, 0)
    seen: list[float] = []

    def note() -> None:
        seen.append(signal.value)

    signal.changed.add(note)
    marks = tuple((float(number), float((n + 1) % 2), START, 0.001 + 0.002 * n) for n in range(8))
    start = bench.position
    back = replace(order, joints=start, pose=reached(bench, start))
    # One message holds three circles.
    moves = (order, back) * (1 if order.via is not None else 2)
    client.takes("eight signals", [replace(o, marks=marks) for o in moves])
    watcher = bench.watcher()
    for _ in range(600):
        if bench.progress(watcher).state == RawTrajectoryState.DONE:
            break
    signal.changed.remove(note)
    if seen != [1, 0] * 4 * len(moves):
        raise CheckFailed(f"{signal.name} was to change 8 times on each move, and was {seen}")


def _wrong_marks(bench: Bench, client: Programmer, order: RawMove, number: int) -> None:
    """Reject invalid signals and places; execute nothing."""
    exposed, n = bench.config.signals, float(number)
    wrong: list[tuple[Sequence[tuple[float, ...]], RawReason]] = [
        (((len(exposed), 1.0, START, 0.01),), RawReason.NO_SIGNAL),
        (((-1.0, 1.0, START, 0.01),), RawReason.NO_SIGNAL),
        (((n, 1.0, START, -0.001),), RawReason.BAD_VALUE),
        (((n, 1.0, START, 10.001),), RawReason.BAD_VALUE),
        (((n, 1.0, 3.0, 0.01),), RawReason.BAD_VALUE),
        (((n, 1.0, 0.5, 0.01),), RawReason.BAD_VALUE),
        (((n, 1.0, START, 0.01),) * 9, RawReason.BAD_VALUE),
    ]
    for index, signal in enumerate(exposed):
        if signal.access != "write" or signal.kind[1] != "O":
            wrong.append((((float(index), 1.0, START, 0.01),), RawReason.READ_ONLY))
        else:
            wrong += [
                (((float(index), value, START, 0.01),), RawReason.BAD_VALUE)
                for value in _impossible(signal)
            ]
    for marks, reason in wrong:
        reply = client.send([replace(order, marks=tuple(marks))])
        client.refused(reply, reason, 0, f"signals {marks}")
    far = ((n, 1.0, START, 10.0), (n, 1.0, END, 0.0))
    reply = client.send([replace(order, marks=far), replace(order, speed=0.0)])
    client.refused(reply, RawReason.BAD_SPEED, 1, f"signals {far} are right")
    values = [*millionths(bench.position), 2048 + RawInstruction.WAIT]
    client.number += 1
    reply = client.say([*values, *millionths([1.0, n, 1.0, START, 0.01, 0.5])], 1, ALL)
    client.refused(reply, RawReason.NO_INSTRUCTION, 0, "a signal on the way of a wait")
    bench.assert_at_rest(0.5, "no signal was right")


def _impossible(signal: ExposedSignal) -> tuple[float, ...]:
    return {"DO": (2.0, 0.5, -1.0), "GO": (-1.0, 0.5)}.get(signal.kind, ())


@case("program-sets", "a program sets signals and waits for them at rest")
def _sets(bench: Bench) -> None:
    """Set a signal after a stop point; wait; time-out; STOP ends the wait."""
    exposed, client, watcher = bench.config.signals, Programmer(bench), bench.watcher()
    target, *_ = orders(bench, 2, random.Random(22))
    target = replace(target, zone=0.01)
    for index, signal in enumerate(exposed):
        if signal.access != "write" or signal.kind[1] != "O":
            reply = _sends(client, SET, [float(index), 1.0])
            client.refused(reply, RawReason.READ_ONLY, 0, f"SET of {signal.name}")
            continue
        for value in _impossible(signal):
            reply = _sends(client, SET, [float(index), value])
            client.refused(reply, RawReason.BAD_VALUE, 0, f"SET of {signal.name} to {value}")
        bench.controller.signals[signal.name] = 0
        _accepted(_sends(client, SET, [float(index), 1.0], before=target))
        bench.wait_until_at(target.joints, 60)
        bench.run(0.5)
        if bench.controller.signals[signal.name] != 1:
            raise CheckFailed(f"{signal.name} was to be set")
    for index, signal in enumerate(exposed):
        if signal.kind[0] == "A":
            reply = _sends(client, WAIT_SIGNAL, [float(index), 1.0, 1.0])
            client.refused(reply, RawReason.BAD_VALUE, 0, f"a wait for {signal.name}")
            continue
        if signal.name in bench.controller.signals:
            now = float(bench.controller.signals[signal.name])
            _accepted(_sends(client, WAIT_SIGNAL, [float(index), now, 0.0], before=target))
            bench.wait_until_at(target.joints, 60)
        if signal.kind[1] == "I":
            _waits(bench, client, index, signal.name)
            seen = bench.progress(watcher)
            if seen.reason != RawReason.STOPPED:
                raise CheckFailed(f"STOP has ended a wait for {signal.name}, PROGRESS says {seen}")
        for value in (*_impossible(signal), -1.0):
            reply = _sends(client, WAIT_SIGNAL, [float(index), value, 1.0])
            client.refused(reply, RawReason.BAD_VALUE, 0, f"a wait for {signal.name} to be {value}")
        for seconds in (-1.0, 2001.0):
            reply = _sends(client, WAIT_SIGNAL, [float(index), 1.0, seconds])
            client.refused(reply, RawReason.BAD_VALUE, 0, f"a wait of {seconds} s")
    if exposed:
        for kind, more in ((SET, [1.0]), (WAIT_SIGNAL, [1.0, 1.0])):
            reply = _sends(client, kind, [float(len(exposed)), *more])
            client.refused(reply, RawReason.NO_SIGNAL, 0, f"{kind.name} of no signal")
        corners_made(bench)


@case("program-without-signals", "a signal that the controller does not have ends its program")
def _without(bench: Bench) -> None:
    """Use signals that do not exist: failures; the others work."""
    exposed = bench.config.signals
    if not exposed:
        raise NotApplicable("no signal is exposed")
    for index, signal in enumerate(exposed):
        target = tuple(s for s in bench.system.signals if s.name != signal.name)
        with bench.second_controller(replace(bench.system, signals=target)) as other:
            _one_without(other, index, signal)


def _one_without(bench: Bench, index: int, signal: ExposedSignal) -> None:
    client, watcher = Programmer(bench), bench.watcher()
    first, second, *_ = orders(bench, 4, random.Random(26))
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    writes = signal.access == "write" and signal.kind[1] == "O"
    sent = [_sends(client, SET, [float(index), 1.0])] if writes else []
    if writes and computes(bench):
        bench.run(0.5)
        pose = reached(bench, second.joints)
        line = replace(second, kind=MOVES[0], pose=pose, marks=((float(index), 1.0, START, 0.01),))
        sent.append(client.send([line]))
    for reply in sent:
        _accepted(reply)
        bench.assert_at_rest(1, "the signal is not there")
        _no_signal(bench.progress(watcher), signal)
    if signal.kind[0] != "A":
        _accepted(_sends(client, WAIT_SIGNAL, [float(index), 1.0, 5.0], after=second))
        bench.assert_at_rest(1, "the signal is not there")
        _no_signal(bench.progress(watcher), signal)
    for number, other in enumerate(bench.config.signals):
        if number != index and other.kind[0] != "A":
            now = float(bench.controller.signals[other.name])
            _accepted(_sends(client, WAIT_SIGNAL, [float(number), now, 0.5]))
            bench.run(0.5)
            seen = bench.progress(watcher)
            if seen.state != RawTrajectoryState.DONE:
                raise CheckFailed(
                    f"{signal.name} is not there; a wait for {other.name} ends so: {seen}"
                )
        if number != index and other.access == "write":
            _accepted(_sends(client, SET, [float(number), 1.0]))
            bench.run(0.5)
            if bench.controller.signals[other.name] != 1:
                raise CheckFailed(f"{signal.name} is not there, and {other.name} is not set")


def _no_signal(reply: messages.RawProgress, signal: ExposedSignal) -> None:
    if (reply.reason, reply.reached) != (RawReason.NO_SIGNAL, 0):
        raise CheckFailed(f"{signal.name} is not there, PROGRESS says {reply}")


def _waits(bench: Bench, client: Programmer, index: int, name: str) -> None:
    target = orders(bench, 2, random.Random(23))[1]
    target = replace(target, kind=RawInstruction.MOVE_ABSJ, pose=None, zone=None)
    signals, watcher = bench.controller.signals, bench.watcher()
    signals[name] = 0
    _accepted(_sends(client, WAIT_SIGNAL, [float(index), 1.0, 100.0], after=target))
    bench.assert_at_rest(1, f"the program waits for {name}")
    signals[name] = 1
    bench.wait_until_at(target.joints, 60)
    signals[name] = 0
    _accepted(_sends(client, WAIT_SIGNAL, [float(index), 1.0, 0.5], after=target))
    bench.assert_at_rest(2, f"{name} does not come")
    seen = bench.progress(watcher)
    if (seen.reason, seen.reached) != (RawReason.WAITED, 0):
        raise CheckFailed(f"{name} did not come, PROGRESS says {seen}")
    away = replace(target, joints=orders(bench, 1, random.Random(0))[0].joints)
    _accepted(_sends(client, WAIT_SIGNAL, [float(index), 1.0, 100.0], after=away))
    bench.run(0.5)
    client.link.stop()
    signals[name] = 1
    bench.assert_at_rest(2, "STOP has ended a wait")


def _sends(
    client: Programmer,
    kind: RawInstruction,
    operands: list[float],
    *,
    before: RawMove | None = None,
    after: RawMove | None = None,
) -> messages.RawContent:
    """Send one instruction with moves before and after; return the reply."""
    client.number += 1
    values = [*millionths(client.bench.position), *(before.words if before else ())]
    values += [int(kind), *millionths(operands), *(after.words if after else ())]
    return client.say(values, 1 + (before is not None) + (after is not None), ALL)


def _accepted(reply: messages.RawContent) -> None:
    if not isinstance(reply, messages.RawPointsAccepted):
        raise CheckFailed(f"a right program is answered by {reply}")


@case("program-settings", "singularities and configurations are allowed on request alone")
def _settings(bench: Bench) -> None:
    """Apply settings from the instruction to the program's end.

    The program ends normally, or by a stop.
    """
    client, modal = Programmer(bench), bench.motion_group.modal
    if bench.motion_group.kinematics is None:
        client.refused(_sends(client, SETTINGS, [0.0]), RawReason.NO_INSTRUCTION, 0, "settings")
        return
    target = replace(
        orders(bench, 2, random.Random(27))[1], kind=RawInstruction.MOVE_ABSJ, pose=None
    )
    for value in (4.0, -1.0, 0.5):
        reply = _sends(client, SETTINGS, [value])
        client.refused(reply, RawReason.BAD_VALUE, 0, f"settings {value}")
    for asks, bits in ((False, 0), *((True, bits) for bits in range(4))):
        start = replace(target, joints=bench.position)
        # As a user routine may have left them.
        modal.check_joint = modal.check_linear = False
        modal.singularities = Singularities.WRIST
        if asks:
            _accepted(_sends(client, SETTINGS, [float(bits)], after=target))
        else:
            client.takes("a program without settings", [target])
        bench.wait_until_moving()
        if not modal.check_joint:
            raise CheckFailed("ConfJ is off in a program that did not ask for it")
        now = (modal.singularities is Singularities.WRIST, not modal.check_linear)
        if now != (bool(bits & 1), bool(bits & 2)):
            raise CheckFailed(f"settings {bits}: SingArea Wrist and ConfL Off are {now}")
        if bits == 3:
            client.link.stop()
        else:
            bench.wait_until_at(target.joints, 60)
        bench.wait_until_standing(10)
        bench.run(0.5)
        if modal.singularities is not Singularities.OFF or not modal.check_linear:
            raise CheckFailed(f"a program with settings {bits} is over, and they are not")
        target = start
