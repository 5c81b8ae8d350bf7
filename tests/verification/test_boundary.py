"""Boundary values in every message field; a driver that ends is detected."""

import random
import struct
from functools import cache
from itertools import groupby

import pytest

from rapidgen.verification.boundary import (
    INT32,
    LENGTHS,
    STATES,
    Trial,
    drawn,
    failing,
    field_of,
    floats,
    messages_of,
    prepare,
    trials,
)
from rapidgen.verification.settings import assumed
from rapidgen.verification.testbench import with_module
from rapidgen.wire.simple_message.declaration import Wire
from rapidgen.wire.simple_message.messages import MESSAGES
from tests.verification.made_up import CONFIG, SYSTEM

STRICT = assumed(("argument_error=fatal", "pack_beyond=error", "negative_mod=error"))


@cache
def prepared(state):
    return prepare(CONFIG, SYSTEM, STRICT, state)


def sample(state, count):
    """A seeded sample of a state's fields, and every header field of PING in idle."""
    own = list(trials(CONFIG, (state,)))
    headers = [t for t in own if state == "idle" and t.what.startswith("PING.") and not t.second]
    fields = [list(group) for _, group in groupby(own, key=field_of)]
    chosen = random.Random(f"{state} sample").sample(fields, count)
    return [*headers, *(trial for field in chosen for trial in field[:12])]


def test_every_field_takes_every_boundary_value():
    made = dict(messages_of(CONFIG))
    for kind in MESSAGES:
        for name in ("msg_type", "comm_type", "reply_code"):
            assert {f"{kind.name}.{name}={value}" for value in INT32} <= made.keys()
        assert {f"{kind.name}.length={value}" for value in (*INT32, *LENGTHS)} <= made.keys()
        for field in kind.fields:
            values = [f"{n:#010x}" for n in floats(CONFIG)] if field.type is Wire.FLOAT32 else INT32
            single = field.count == 1
            name = f"{kind.name}.{field.name}" + ("" if single else "[0]")
            assert {f"{name}={value}" for value in values} <= made.keys()


def test_boundary_value_changes_only_its_field():
    made = dict(messages_of(CONFIG))
    data = made["JOINT_TRAJ_PT.duration=0x7f800000"]
    assert struct.unpack("<4i i 10f f f", data) == (
        *(64, 11, 2, 0, 1),
        *[0.0] * 11,
        float("inf"),
    )


@pytest.mark.parametrize("state", STATES)
def test_boundary_values_do_no_harm(state):
    assert failing(prepared(state), sample(state, 14 if state == "idle" else 6)) == []


@pytest.mark.parametrize(
    ("state", "datum"),
    [
        *((state, ("", "ros_common", "ros_control_asked")) for state in STATES),
        *((state, ("T_ROS_CONTROL", "ros_common", "ros_supervisor_missing")) for state in STATES),
        *((state, ("T_ROS_CONTROL", "ros_control", "heartbeat_timeout")) for state in STATES),
        *((state, ("T_ROS_SUP", "", "interrupts")) for state in STATES),
        ("receiving", ("T_ROS_RECV", "ros_download", "ros_receiving")),
        *((s, ("", "ros_common", "ros_active_trajectory")) for s in ("moving", "streaming")),
        ("paused", ("", "ros_common", "ros_paused_trajectory")),
    ],
    ids=str,
)
def test_data_that_tell_the_state_are_compared(state, datum):
    assert datum in {place.datum for place in prepared(state).data.places}


def broken(module_name, *changes):
    """The driver with parts of a module replaced."""
    module = next(m for t in SYSTEM.tasks for m in t.modules if m.name == module_name)
    text = module.data.replace(b"\r\n", b"\n")
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return with_module(SYSTEM, module.path, text)


def control(state, what, number, *values):
    body = struct.pack(f"<{len(values)}i", *values)
    return Trial(
        state, "control", False, what, struct.pack("<4i", 12 + len(body), number, 2, 0) + body
    )


def test_a_driver_that_a_message_harms_is_found():
    """Among harmless messages the one is named."""
    case = b"CASE ROS_MSG_PAUSE:\n"
    system = broken("ROS_control", (case, case + b"WHILE TRUE DO\nWaitTime 1;\nENDWHILE\n"))
    harmful = control("idle", "PAUSE", 1304, 0)
    harmless = Trial("idle", "state", True, "length=0", bytes(4))
    result = failing(prepare(CONFIG, system, STRICT, "idle"), [harmless, harmful, harmless])
    assert [trial for trial, _ in result] == [harmful]


@pytest.mark.parametrize("state", ["idle", "moving"])
def test_a_value_that_disables_stop_is_found_in_a_burst(state):
    """Every message is answered, and the one is named."""
    datum, stop = b"LOCAL VAR num reported_end := 0;\n", b"request_stop ROS_REASON_STOPPED;\n"
    check = b"IF paused <> 0 AND paused <> 1 THEN\n"
    system = broken(
        "ROS_control",
        (datum, datum + b"LOCAL VAR bool ignores_stop := FALSE;\n"),
        (stop, b"IF NOT ignores_stop " + stop),
        (check, b"IF paused = 4194304 ignores_stop := TRUE;\n" + check),
    )
    values = [value for value in INT32 if value not in (0, 1)]
    burst = [control(state, f"PAUSE.paused={value}", 1304, value) for value in values]
    result = failing(prepare(CONFIG, system, STRICT, state), burst)
    assert [trial.what for trial, _ in result] == ["PAUSE.paused=4194304"]


def test_drawn_messages_have_half_boundary_values():
    chance = random.Random(1)
    made = [drawn(CONFIG, chance) for _ in range(400)]
    values = [w for data in made for w in struct.unpack(f"<{len(data) // 4 - 4}I", data[16:])]
    known = {value & 0xFFFFFFFF for value in INT32} | set(floats(CONFIG))
    assert 0.4 < sum(word in known for word in values) / len(values) < 0.65
