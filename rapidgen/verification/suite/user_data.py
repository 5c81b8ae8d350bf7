"""User data that clients may read and write: DATA on the control port."""

import math
import struct
from dataclasses import replace

from rapidgen.config.model import UserDatum
from rapidgen.system.model import ModuleFile, System
from rapidgen.verification import messages
from rapidgen.verification.case import SuiteGroup
from rapidgen.verification.instruction_hooks import fails
from rapidgen.verification.messages import RawComm, RawContent, RawReason
from rapidgen.verification.model import CheckFailed, NotApplicable
from rapidgen.verification.raw_connection import RawLink
from rapidgen.verification.suite.control import not_done
from rapidgen.verification.testbench import Bench

case = SuiteGroup("own data", needs="control")

_BEGIN = {"num": "3", "bool": "FALSE", "string": '"begin"'}
_FIRST = {"num": (3.0, ""), "bool": (0.0, ""), "string": (0.0, "begin")}
_LARGEST = struct.unpack("<f", struct.pack("<f", 3.4e38))[0]
"""Largest value that the driver accepts for a num."""
_SOME = {
    "num": ((-2.5, ""), (_LARGEST, ""), (-_LARGEST, ""), (2.0**101, "")),
    "bool": ((1.0, ""), (0.0, "")),
    "string": ((0.0, "x" * 80), (0.0, ""), (0.0, "caf\xe9")),
}
_NEVER = {
    "num": ((math.nan, RawReason.NOT_FINITE), (math.inf, RawReason.NOT_FINITE)),
    "bool": ((2.0, RawReason.BAD_VALUE), (math.nan, RawReason.BAD_VALUE)),
    "string": (),
}


@case("own-data", "data of the robot's program that the configuration lists")
def _data(bench: Bench) -> None:
    """Read, write, reject; reject if the program lacks the data."""
    listed = bench.group.data
    control = bench.control()
    for index in (-1, len(listed), 99, 2**31 - 1, -(2**31)):
        reply = _asks(control, index)
        if listed:
            not_done(reply, RawReason.NO_DATUM, f"datum {index} of {len(listed)}")
        elif not isinstance(reply, messages.RawFailure):
            raise CheckFailed("a driver without data answers DATA")
    for index in range(len(listed)):
        reply = _asks(control, index)
        not_done(reply, RawReason.NO_DATUM, f"datum {index} is not in the robot's program")
    if not listed:
        return
    with bench.second_controller(_with(bench, listed)) as other:
        control = other.control()
        if not bench.setting.dialect.data_of_tasks:
            for index in range(len(listed)):
                reply = _asks(control, index)
                not_done(reply, RawReason.NO_DATUM, f"datum {index} of a task that is not reached")
            return
        for index, datum in enumerate(listed):
            _one(control, index, datum)
        other.assert_at_rest(0.5, "data were read and written")
    for missing, datum in enumerate(listed):
        others = tuple(d for d in listed if d != datum)
        with bench.second_controller(_with(bench, others)) as other:
            control = other.control()
            not_done(_asks(control, missing), RawReason.NO_DATUM, f"datum {missing} is missing")
            for index in range(len(listed)):
                if index != missing:
                    _says(
                        _asks(control, index),
                        messages.RawDatumReply(index, *_FIRST[listed[index].type]),
                    )
    elsewhere = tuple(replace(d, name=f"other{d.name}") for d in listed)
    with bench.second_controller(_with(bench, elsewhere)) as other:
        control = other.control()
        for index in range(len(listed)):
            reply = _asks(control, index)
            not_done(reply, RawReason.NO_DATUM, f"datum {index} is in another module")


@case("data-reading-fails", "a request for a datum that cannot be read changes nothing", once=True)
def _reading_fails(bench: Bench) -> None:
    """Fail while reading DATA: the client is dropped, the next is served."""
    listed = bench.group.data
    texts = [n for n, d in enumerate(listed) if (d.type, d.access) == ("string", "write")]
    if not texts:
        raise NotApplicable("no text of the program may be written")
    with bench.second_controller(_with(bench, listed)) as other:
        # Three of the head, three of the request, and two characters with their end.
        for name, count in (("UnpackRawBytes", 9), ("ByteToStr", 2)):
            for after in range(count):
                control = other.control()
                first = _FIRST["string"]
                _says(_asks(control, texts[0]), messages.RawDatumReply(texts[0], *first))
                ends = fails(other, "ROS_control", name, "ERR_ARGVALERR", after=after)
                requested = messages.RawDatum(texts[0], 1, 0.0, "ab")
                control.send(messages.encode(requested, RawComm.REQUEST))
                other.run(1)
                ends()
                control.close(then=1)
                control = other.control()
                _says(_asks(control, texts[0]), messages.RawDatumReply(texts[0], *first))
                other.assert_healthy()


def _one(control: RawLink, index: int, datum: UserDatum) -> None:
    kind, reply = datum.type, messages.RawDatumReply
    _says(_asks(control, index), reply(index, *_FIRST[kind]))
    if datum.access == "read":
        answer = _asks(control, index, 1, 1.0, "other")
        not_done(answer, RawReason.READ_ONLY, f"datum {index} may not be written")
        _says(_asks(control, index), reply(index, *_FIRST[kind]))
        return
    for number, text in _SOME[kind]:
        _says(_asks(control, index, 1, number, text), reply(index, number, text))
        _says(_asks(control, index), reply(index, number, text))
    for number, reason in _NEVER[kind]:
        not_done(_asks(control, index, 1, number), reason, f"{number} to a {kind}")
    for write in (2, -1):
        answer = _asks(control, index, write)
        not_done(answer, RawReason.BAD_VALUE, "neither read nor write")
    _says(_asks(control, index), reply(index, *_SOME[kind][-1]))


def _asks(
    control: RawLink, index: int, write: int = 0, value: float = 7.0, text: str = "7"
) -> RawContent:
    """Send DATA and return the reply, which may be a rejection."""
    requested = messages.RawDatum(index, write, value, text)
    control.send(messages.encode(requested, RawComm.REQUEST))
    return control.reply(messages.DATA)


def _says(reply: RawContent, expected: messages.RawDatumReply) -> None:
    if reply != expected:
        raise CheckFailed(f"DATA is answered by {reply}, not {expected}")


def _with(bench: Bench, listed: tuple[UserDatum, ...]) -> System:
    """Return the system with modules that declare these data."""
    texts: dict[str, list[str]] = {}
    for datum in listed:
        module, _, name = datum.name.partition(":")
        texts.setdefault(module, []).append(f"PERS {datum.type} {name} := {_BEGIN[datum.type]};")
    own = [
        ModuleFile(
            name, f"{name}.mod", "\n".join((f"MODULE {name}", *lines, "ENDMODULE", "")).encode()
        )
        for name, lines in texts.items()
    ]
    tasks = tuple(
        replace(task, modules=(*task.modules, *own)) if task.name == bench.group.task else task
        for task in bench.system.tasks
    )
    return replace(bench.system, tasks=tasks)
