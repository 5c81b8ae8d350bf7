"""User routines called by programs: arguments, results, errors, ends."""

import math
import random
import struct
from collections.abc import Sequence
from dataclasses import replace

from rapidgen.axes.frames import IDENTITY
from rapidgen.config.model import UserRoutine
from rapidgen.runtime.builtins.motion.targets import data_of
from rapidgen.runtime.motion_interface import NO_OFFSETS
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification import messages
from rapidgen.verification.batches import millionths
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.messages import RawInstruction, RawReason, RawTrajectoryState
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.raw_programs import ALL, Programmer, computes, orders, reached
from rapidgen.verification.suite.control import not_done, stop
from rapidgen.verification.testbench import Bench

case = SuiteGroup("own routines", needs="stream")

_CALL = RawInstruction.CALL
_MODULE = b"""MODULE cell
    PERS num calls := 0;
    PERS bool undone := FALSE;
    VAR errnum weld_failed := -1;

    PROC weld(INOUT num seam, bool dry, INOUT bool good, INOUT string note)
        calls := calls + 1;
        IF weld_failed = -1 BookErrNo weld_failed;
        IF seam < 0 RAISE weld_failed;
        seam := 2 * seam;
        good := (good = dry);
        note := note + note;
    ERROR
        RAISE;
    ENDPROC

    PROC teach(INOUT robtarget there, INOUT jointtarget place, INOUT jointtarget back)
        VAR jointtarget other;

        there.trans.x := there.trans.x + 250;
        there.robconf := [-1,2,-3,4];
        other := place;
        place := back;
        back := other;
    ENDPROC

    PROC wait_long()
        undone := FALSE;
        WaitTime 8;
        calls := calls + 1;
    UNDO
        undone := TRUE;
    ENDPROC
ENDMODULE
"""
WELD, LONG, ABSENT, TEACH = range(4)
"""Numbers of the routines in the configuration for these cases (tools/cell.yaml)."""
_THESE = {
    "cell:weld": ("num", "bool", "bool", "string"),
    "cell:wait_long": (),
    "nocell:weld": (),
    "cell:teach": ("robtarget", "jointtarget", "jointtarget"),
}
_HALF = math.sqrt(0.5)
_DISPLACEMENTS = (
    ((0.05, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)),
    ((0.0, 0.0, 0.0), (_HALF, 0.0, 0.0, _HALF)),
)
"""Of a user program: position (m) and orientation of a robtarget's zero."""
_HOLDERS = ("cell", "nocell")


def knows_these(bench: Bench) -> bool:
    """True if the configuration's routines are those of this module."""
    own = {r.call: tuple(p.type for p in r.parameters) for r in bench.group.routines}
    return own == _THESE and list(own) == list(_THESE)


def _has_these(bench: Bench) -> bool:
    """True if it is so, and the motion task has the module."""
    return knows_these(bench) and bench.setting.dialect.installed_modules_exist


@case("routine-absent", "a routine of a module that is not there refuses its program")
def _absent(bench: Bench) -> None:
    """Reject absent routines at once with index; without routines, no CALL."""
    client = Programmer(bench)
    if not bench.group.routines:
        reply = _calls(client, LONG)
        client.refused(reply, RawReason.NO_INSTRUCTION, 0, "a driver without routines")
        return
    for number, routine in enumerate(bench.group.routines):
        poses = any(p.type == "robtarget" for p in routine.parameters)
        if ":" in routine.call and not routine.returns and (computes(bench) or not poses):
            reply = _calls(client, number, _zeros(bench, routine))
            client.refused(reply, RawReason.NO_ROUTINE, 0, f"{routine.call} is not there")
    if knows_these(bench) and not bench.setting.dialect.installed_modules_exist:
        with bench.second_controller(_with_module(bench)) as other:
            reply = _calls(Programmer(other), WELD, weld_words(1.0))
            client.refused(
                reply, RawReason.NO_ROUTINE, 0, "a module that the configuration does not list"
            )
    if not _has_these(bench):
        return
    with bench.second_controller(_with_module(bench)) as other:
        client = Programmer(other)
        for number in (ABSENT, 4, -1):
            client.refused(_calls(client, number), RawReason.NO_ROUTINE, 0, f"routine {number}")
        for seconds in (-1.0, 2001.0):
            reply = _calls(client, LONG, seconds=seconds)
            client.refused(reply, RawReason.BAD_VALUE, 0, f"a routine that may take {seconds} s")
        reply = _calls(client, WELD, weld_words(1.0, dry=2))
        client.refused(reply, RawReason.BAD_VALUE, 0, "a bool that is 2")
        reply = _calls(client, WELD, [2143289344, *weld_words(1.0)[1:]])
        client.refused(reply, RawReason.NOT_FINITE, 0, "a num that is none")
        for length in (-1.0, 2.5, 81.0):
            values = [*weld_words(1.0)[:3], *millionths([length]), *[0] * 21]
            reply = _calls(client, WELD, values)
            client.refused(reply, RawReason.BAD_VALUE, 0, f"a text of {length} characters")
        other.assert_at_rest(0.5, "no routine was called")


@case("routine-missing", "a procedure that its module does not have ends the program in its turn")
def _missing(bench: Bench) -> None:
    """Load no module: earlier instructions run, no other routine is called."""
    if not _has_these(bench):
        raise NotApplicable("the routines that are tried are not in the configuration")
    system = _with_module(bench, ModuleFile("nocell", "nocell.mod", b"MODULE nocell\nENDMODULE\n"))
    with bench.second_controller(system) as other:
        client, watcher = Programmer(other), other.watcher()
        client.number += 1
        wait = [RawInstruction.WAIT, *millionths([0.1])]
        words = [*millionths(other.position), *wait, _CALL, *millionths([ABSENT, 0.0]), *wait]
        _taken(client.say(words, 3, ALL))
        other.assert_at_rest(1, "there is no such procedure")
        seen = other.progress(watcher)
        expected = (RawTrajectoryState.FAILED, RawReason.NO_ROUTINE, 1)
        if (seen.state, seen.reason, seen.reached) != expected:
            raise CheckFailed(f"a procedure is missing, PROGRESS says {seen}")
        _taken(_calls(client, WELD, weld_words(1.0)))
        if _ended(other, client, 4).values[0] != 2:
            raise CheckFailed("a routine after one that is missing has not run")
    empty = tuple(ModuleFile(n, f"{n}.mod", f"MODULE {n}\nENDMODULE\n".encode()) for n in _HOLDERS)
    with bench.second_controller(_with_modules(bench, *empty)) as other:
        client, watcher = Programmer(other), other.watcher()
        for number, routine in enumerate(other.group.routines):
            if number == TEACH and not computes(other):
                continue
            _taken(_calls(client, number, _zeros(other, routine)))
            other.assert_at_rest(0.5, f"there is no {routine.call}")
            seen = other.progress(watcher)
            if (seen.reason, seen.reached) != (RawReason.NO_ROUTINE, 0):
                raise CheckFailed(f"{routine.call} is missing, PROGRESS says {seen}")


@case("routine-results", "a routine's parameters and its error come back")
def _results(bench: Bench) -> None:
    """Return numbers, texts and errors; the program continues or ends."""
    if not _has_these(bench):
        raise NotApplicable("the routines that are tried are not in the configuration")
    with bench.second_controller(_with_module(bench)) as other:
        client, watcher = Programmer(other), other.watcher()
        for seam, dry, good in ((1.5, 0, 0), (2.0**100, 1, 1), (-0.0, 0, 1), (1.5, 1, 0)):
            _taken(_calls(client, WELD, weld_words(seam, dry=dry, good=good)))
            reply = _ended(other, client, 4)
            same = float(dry == good)
            if (reply.error, reply.values[:3], reply.text) != (0, (2 * seam, dry, same), "abab"):
                raise CheckFailed(f"weld({seam}, {dry}) is reported as {reply}")
            if _asks(client, 1).text or _asks(client, 9).text or _asks(client, -1).text:
                raise CheckFailed("a parameter that is no string has a text")
        for text in ("", "x" * 40, "12345"):
            _taken(_calls(client, WELD, weld_words(1.0, text=text)))
            reply = _ended(other, client, 4)
            if (reply.values[0], reply.text) != (2.0, 2 * text):
                raise CheckFailed(f"a text is to come back twice: {reply}")
        _taken(_calls(client, WELD, weld_words(-1.0)))
        reply = _ended(other, client, 0)
        if reply.error == 0 or reply.text != "weld_failed":
            raise CheckFailed(f"weld has raised weld_failed, RESULT says {reply}")
        other.run(0.5)
        seen = other.progress(watcher)
        if (seen.state, seen.reason) != (RawTrajectoryState.FAILED, RawReason.ROUTINE):
            raise CheckFailed(f"a routine has raised an error, PROGRESS says {seen}")
        if other.controller.task(other.group.task)["cell:calls"] != 8:
            raise CheckFailed("weld was not called eight times")


@case("routine-alone", "nothing else begins while a routine runs", needs="control")
def _alone(bench: Bench) -> None:
    """Do not interrupt a routine by clients; STOP and time-outs end it.

    UNDO runs.
    """
    if not _has_these(bench):
        raise NotApplicable("the routines that are tried are not in the configuration")
    with bench.second_controller(_with_module(bench)) as other:
        client, watcher = Programmer(other), other.watcher()
        own = other.controller.task(other.group.task)
        trajectory = _taken(_calls(client, LONG))
        other.run(0.5)
        reply = _calls(client, LONG)
        client.refused(reply, RawReason.MOVING, -1, "a program into a routine")
        reply = other.control().ask(messages.RawSpeed(50.0))
        not_done(reply, RawReason.IN_ROUTINE, "SPEED of a routine")
        points = other.wave(4)
        client.link.send(other.download(points))
        newer = RawLink(other, other.group.ports.motion)
        newer.send(other.download(points))
        newer.wait_disconnected(3, "a newer client's motion into a routine")
        seen = other.progress(watcher)
        if (seen.trajectory, seen.state) != (trajectory, RawTrajectoryState.MOVING):
            raise CheckFailed(f"a routine runs, PROGRESS says {seen}")
        other.until(lambda: own["cell:calls"] == 1, 10, "the routine comes to its end")
        other.run(0.5)
        if own["cell:undone"] or other.progress(watcher).state != RawTrajectoryState.DONE:
            raise CheckFailed("the routine did not end by itself")
        other.assert_at_rest(1, "a trajectory was turned away")
        for reason, seconds in ((RawReason.OVERTIME, 1.0), (RawReason.STOPPED, 0.0)):
            _taken(_calls(client, LONG, seconds=seconds))
            other.run(2)
            if reason is RawReason.STOPPED:
                stop(other.control())
            other.run(1)
            seen = other.progress(watcher)
            if (seen.reason, own["cell:undone"], own["cell:calls"]) != (reason, True, 1):
                raise CheckFailed(f"{reason.name} of a routine: PROGRESS says {seen}")
        # The rejected path is accepted now. At its second corner the state and the control server
        # look for clients at the same time: with random task order it may be a stop.
        other.assert_moves_through(client.link, points)
        program = orders(other, 2, random.Random(28))
        client.takes("a program after a routine", program)
        other.wait_until_at(program[-1].joints, 60)


@case("program-displaced", "a displacement of the customer's own program moves no program of ours")
def _displaced(bench: Bench) -> None:
    """Displace in a routine: the program ends before the next pose.

    PDispOn and EOffsOn would lead it to an unchecked position.
    """
    if not computes(bench):
        raise NotApplicable("the driver computes no poses")
    _displaced_before(bench)
    if not _has_these(bench):
        return
    with bench.second_controller(_with_module(bench)) as other:
        client, watcher, modal = Programmer(other), other.watcher(), other.motion_group.modal
        data = data_of(other.rapid_task("ROS_motion"), other.motion_group)
        line = replace(orders(other, 4, random.Random(33))[-1], kind=RawInstruction.MOVE_L)
        line = replace(line, pose=reached(other, line.joints))
        joints = replace(line, kind=RawInstruction.MOVE_ABSJ, pose=None)
        for move, displacement in (
            *((line, displacement) for displacement in (*_DISPLACEMENTS, None)),
            (joints, _DISPLACEMENTS[0]),
        ):
            modal.displacement, data.external_offset = IDENTITY, NO_OFFSETS
            client.number += 1
            call = [_CALL, *millionths([LONG, 0.0])]
            _taken(client.say([*millionths(other.position), *call, *move.words], 2, ALL))
            # As the routine may do.
            other.run(4)
            if displacement is None:
                data.external_offset = (0.0, 5.0, 0.0, 0.0, 0.0, 0.0)
            else:
                modal.displacement = displacement
            if move is joints:
                other.wait_until_at(move.joints, 60)
                return
            other.assert_at_rest(7, "a routine has displaced the poses after it")
            seen = other.progress(watcher)
            if (seen.reason, seen.reached) != (RawReason.POSE_MISMATCH, 1):
                raise CheckFailed(f"poses are displaced, PROGRESS says {seen}")


def _displaced_before(bench: Bench) -> None:
    """Displace before the program: rejected, or ended without motion.

    Without the displacement it moves.
    """
    first, *_, last = orders(bench, 3, random.Random(33))
    last = replace(last, kind=RawInstruction.MOVE_ABSJ, pose=None)
    client, modal = Programmer(bench), bench.motion_group.modal
    client.takes("a program", [first])
    bench.wait_until_at(first.joints, 60)
    move = replace(last, kind=RawInstruction.MOVE_J, pose=reached(bench, last.joints), zone=None)
    for displacement in _DISPLACEMENTS:
        modal.displacement = displacement
        reply = client.send([move])
        if isinstance(reply, messages.RawPointsRefused):
            client.refused(reply, RawReason.POSE_MISMATCH, 0, "poses that are displaced")
        bench.assert_at_rest(1, "the customer's program has displaced the poses")
    client.takes("joints, which no displacement takes elsewhere", [last])
    bench.wait_until_at(last.joints, 60)
    client.takes("the way back", [first])
    bench.wait_until_at(first.joints, 60)
    modal.displacement = IDENTITY
    client.takes("a program without a displacement", [move])
    bench.wait_until_at(move.joints, 60)


@case("routine-targets", "targets that a routine leaves come back")
def _targets(bench: Bench) -> None:
    """Report targets with their numbers, in m and rad; none if absent."""
    if not _has_these(bench) or not computes(bench):
        raise NotApplicable("the routines that are tried are not there, or no poses are computed")
    with bench.second_controller(_with_module(bench)) as other:
        client = Programmer(other)
        first, second = (order.joints for order in orders(other, 3, random.Random(29))[1:])
        (x, y, z), turn = reached(other, first)
        away = millionths([x + 0.1, y, z, *turn, *first, *first, *second])
        reply = _calls(client, TEACH, away)
        client.refused(reply, RawReason.POSE_MISMATCH, 0, "joints that reach another pose")
        values = millionths([x, y, z, *turn, *first, *first, *second])
        _taken(_calls(client, TEACH, values))
        _ended(other, client, 0)
        reply = _asks_target(client, 0, 1)
        _near("robtarget", (*reply.position, *reply.orientation), (x + 0.25, y, z, *turn))
        _near("configuration", reply.configuration, (-1, 2, -3, 4))
        for number, joints in ((1, second), (2, first)):
            reply = _asks_target(client, 1, number)
            _near(f"jointtarget {number}", reply.joints[: len(joints)], joints)
            if any(reply.joints[len(joints) :]) or any(reply.position) or any(reply.orientation):
                raise CheckFailed(f"TARGET of a jointtarget is answered by {reply}")
        for kind, number in ((0, 0), (0, 2), (1, 0), (1, 3), (2, 1), (-1, 1), (1, -1)):
            requested = messages.RawTarget(kind, number)
            if not isinstance(client.link.ask(requested), messages.RawFailure):
                raise CheckFailed(f"a routine has no target {requested}")


def _asks_target(client: Programmer, joints: int, parameter: int) -> messages.RawTargetReply:
    reply = client.link.ask(messages.RawTarget(joints, parameter))
    if not isinstance(reply, messages.RawTargetReply):
        raise CheckFailed(f"TARGET is answered by {reply}")
    return reply


def _near(what: str, reply: Sequence[float], expected: Sequence[float]) -> None:
    """Check that numbers equal the sent ones within the wire's precision."""
    if not all(abs(a - b) < 1e-5 for a, b in zip(reply, expected, strict=True)):
        raise CheckFailed(f"the {what} has come back as {reply}, not {expected}")


def _zeros(bench: Bench, routine: UserRoutine) -> list[int]:
    """Return argument words for any routine: zeros and the robot's position."""
    current = bench.position
    values: dict[str, list[float]] = {
        "num": [0.0],
        "bool": [0.0],
        "string": [0.0],
        "jointtarget": list(current),
    }
    if any(p.type == "robtarget" for p in routine.parameters):
        (x, y, z), turn = reached(bench, current)
        values["robtarget"] = [x, y, z, *turn, *current]
    return [w for p in routine.parameters for w in millionths(values[p.type])]


def weld_words(seam: float, *, dry: int = 0, good: int = 0, text: str = "ab") -> list[int]:
    """Return words of weld's arguments: a num as float32, two bools, a text."""
    number = struct.unpack("<i", struct.pack("<f", seam))[0]
    letters = text.encode() + bytes(-len(text) % 4)
    return [
        number,
        *millionths([float(dry), float(good), float(len(text))]),
        *struct.unpack(f"<{len(letters) // 4}i", letters),
    ]


def _calls(
    client: Programmer, number: int, arguments: Sequence[int] = (), *, seconds: float = 0.0
) -> messages.RawContent:
    """Send a program of one call and return its reply."""
    client.number += 1
    values = [*millionths(client.bench.position), int(_CALL), *millionths([number, seconds])]
    return client.say([*values, *arguments], 1, ALL)


def _taken(reply: messages.RawContent) -> int:
    if not isinstance(reply, messages.RawPointsAccepted):
        raise CheckFailed(f"a call is right, the reply is {reply}")
    return reply.trajectory


def _asks(client: Programmer, parameter: int) -> messages.RawResultReply:
    reply = client.link.ask(messages.RawResult(parameter))
    if not isinstance(reply, messages.RawResultReply):
        raise CheckFailed(f"RESULT is answered by {reply}")
    return reply


def _ended(bench: Bench, client: Programmer, parameter: int) -> messages.RawResultReply:
    """Return RESULT when the newest call has ended."""
    newest = bench.progress(bench.watcher()).trajectory
    for _ in range(100):
        reply = _asks(client, parameter)
        if reply.trajectory == newest:
            return reply
        bench.run(0.02)
    raise CheckFailed("RESULT does not tell the newest call")


def _with_module(bench: Bench, *more: ModuleFile) -> System:
    return _with_modules(bench, ModuleFile("cell", "cell.mod", _MODULE), *more)


def _with_modules(bench: Bench, *more: ModuleFile) -> System:
    """Return the system with these additional modules in the motion task."""
    tasks = tuple(
        replace(task, modules=(*task.modules, *more)) if task.name == bench.group.task else task
        for task in bench.system.tasks
    )
    return replace(bench.system, tasks=tasks)
