"""Boundary values in every message field; a driver that ends is detected."""

import random
import struct
from functools import cache

import pytest

from rapidgen.verification.boundary import (
    INT32,
    LENGTHS,
    STATES,
    Trial,
    drawn,
    failing,
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
    """A seeded sample of a state's trials, and every header field of PING in idle."""
    own = list(trials(CONFIG, (state,)))
    headers = [t for t in own if state == "idle" and t.what.startswith("PING.") and not t.second]
    return [*headers, *random.Random(f"{state} sample").sample(own, count)]


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
    assert failing(prepared(state), sample(state, 60 if state == "idle" else 12)) == []


def test_a_driver_that_a_message_harms_is_found():
    """Among harmless messages the one is named."""
    module = next(m for t in SYSTEM.tasks for m in t.modules if m.name == "ROS_control")
    harmful = Trial("idle", "control", False, "PAUSE", struct.pack("<5i", 16, 1304, 2, 0, 0))
    harmless = Trial("idle", "state", True, "length=0", bytes(4))
    lines = module.data.splitlines(keepends=True)
    at = next(n for n, line in enumerate(lines) if line.strip() == b"CASE ROS_MSG_PAUSE:")
    waits = b"WHILE TRUE DO\nWaitTime 1;\nENDWHILE\n"
    broken = b"".join([*lines[: at + 1], waits, *lines[at + 1 :]])
    system = with_module(SYSTEM, module.path, broken)
    result = failing(prepare(CONFIG, system, STRICT, "idle"), [harmless, harmful, harmless])
    assert [trial for trial, _ in result] == [harmful]


def test_drawn_messages_have_half_boundary_values():
    chance = random.Random(1)
    made = [drawn(CONFIG, chance) for _ in range(400)]
    values = [w for data in made for w in struct.unpack(f"<{len(data) // 4 - 4}I", data[16:])]
    known = {value & 0xFFFFFFFF for value in INT32} | set(floats(CONFIG))
    assert 0.4 < sum(word in known for word in values) / len(values) < 0.65
