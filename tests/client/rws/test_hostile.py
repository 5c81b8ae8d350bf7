"""Whatever answers: a flow returns or raises a RobotError, and no password goes where it must not.

Flows without a network: what they ask for is answered by whatever hypothesis draws.
"""

import random
from itertools import count
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rapidgen.client.errors import RobotError
from rapidgen.client.rws import flows, topics
from rapidgen.client.rws.address import parse_address
from rapidgen.client.rws.core import Login, RwsCore
from rapidgen.client.rws.effects import Exchange, FetchCertificate, LogIn, Response, resume
from rapidgen.wire.rws import json_bodies, xhtml
from rapidgen.wire.rws.bodies import Body, Fault, Generation, Item

FLOWS = {
    "identity": lambda c: flows.panel.identity(c),
    "panel": lambda c: flows.panel.panel(c),
    "start": lambda c: flows.panel.start(c),
    "motors": lambda c: flows.panel.motors(c, True),
    "set_speed": lambda c: flows.panel.set_speed(c, 50),
    "tasks": lambda c: flows.rapid.tasks(c),
    "pointer": lambda c: flows.rapid.pointer(c, "T_ROB1"),
    "symbol": lambda c: flows.rapid.symbol(c, "T/M/x"),
    "set_symbol": lambda c: flows.rapid.set_symbol(c, "T/M/x", (1, 2.5, True, "a")),
    "symbols": lambda c: flows.rapid.symbols(c, "T"),
    "build_errors": lambda c: flows.rapid.build_errors(c, "T"),
    "module_text": lambda c: flows.rapid.module_text(c, "T", "M"),
    "signals": lambda c: flows.equipment.signals(c),
    "set_signal": lambda c: flows.equipment.set_signal(c, "s", 1),
    "files": lambda c: flows.files.list_files(c),
    "instances": lambda c: flows.cfg.cfg_instances(c, "SYS", "CAB_TASKS"),
    "cfg_load": lambda c: flows.cfg.cfg_load(c, "HOME/a.cfg"),
    "log": lambda c: flows.equipment.log(c),
    "holder": lambda c: flows.mastership.holder(c),
    "backup": lambda c: flows.jobs.backup(c, "b"),
    "restore": lambda c: flows.jobs.restore(c, "BACKUP/b", wait=3),
    "dialog": lambda c: flows.dialogs.dialog(c),
    "answer_dialog": lambda c: flows.dialogs.answer_dialog(c, 1),
    "queues": lambda c: flows.queues.queues(c),
    "make_queue": lambda c: flows.queues.make_queue(c, "q"),
    "send_message": lambda c: flows.queues.send_message(c, "RMQ_T", "num;1"),
    "receive_message": lambda c: flows.queues.receive_message(c, "q", wait=3),
    "restart": lambda c: flows.jobs.restart(c, wait=3),
    "subscribe": lambda c: flows.subscriptions.subscribe(c, [topics.symbol("T/x"), topics.log()]),
    "select_task": lambda c: flows.rapid.select_task(c, "T", True),
    "joint_target": lambda c: flows.equipment.joint_target(c),
    "rob_target": lambda c: flows.equipment.rob_target(c),
    "grants": lambda c: flows.users.grants(c),
    "ask_rmmp": lambda c: flows.users.ask_rmmp(c, wait=3),
    "cancel_rmmp": lambda c: flows.users.cancel_rmmp(c),
    "close": lambda c: flows.connect.close(c),
}
KINDS = (
    "pnl-ctrlstate", "pnl-opmode", "pnl-speedratio", "rap-execution", "rap-task-li", "rap-data",
    "ctrl-identity-info", "pcp-info", "ios-signal-li", "ios-signal", "fs-file", "progress",
    "cfg-dt-instance-li", "elog-message-li", "msh-resource", "rap-sympropvar-li", "rap-builderrs",
    "user-grant", "user-rmmp-poll", "ms-jointtarget", "ms-robtargets", "rap-uiactive-li",
    "rap-uiparams-li", "dipc-read-li", "dipc-queue-li",
)  # fmt: skip
FIELDS = (
    "ctrlstate", "opmode", "speedratio", "ctrlexecstate", "name", "lvalue", "value", "fs-size",
    "state", "code", "beginposition", "mastership", "dim", "row", "msgtype", "location",
    "excstate", "active", "status", "rax_1", "eax_a", "x", "q1", "stack", "instr", "dipc-userdef",
)  # fmt: skip
WORDS = (
    "",
    "motoron",
    "running",
    "1",
    "-1",
    "nan",
    "[1,",
    "9" * 40,
    "ready",
    "TRUE",
    "PENDING",
    "\u00b2",
    "a",
)
STATUSES = (*[200] * 20, 201, 202, 204, 301, 400, 401, 403, 404, 406, 500, 503)
WRITERS = (xhtml.write, json_bodies.write_hal, json_bodies.write_json)
HEADERS = {
    "content-type": ("", "application/xhtml+xml", "application/hal+json"),
    "location": ("/progress/1", "ws://other/poll/1", "https://evil/"),
    "www-authenticate": ("Basic realm=x", "Digest realm=x", "Bearer"),
}
STEPS = 300
NOWHERE = Path("/nonexistent/known")


def hostile(rng):
    """An answer: half of the right shape, with anything in it."""
    # Every class at once: any request finds its class.
    items = tuple(
        Item(
            kind, rng.choice(WORDS), {field: rng.choice(WORDS) for field in rng.sample(FIELDS, 12)}
        )
        for kind in KINDS
    )
    fault = rng.choice((*[None] * 8, Fault(-1073445862, "held"), Fault(-1, "")))
    following = rng.choice(("", "signals?start=100&limit=100", "x?start=x"))
    body = Body(items, next=following, fault=fault, collection=rng.random() < 0.5)
    data = rng.choice(WRITERS)(body)
    if rng.random() < 0.2:
        data = data[: rng.randrange(len(data))]
    return Response(rng.choice(STATUSES), {k: rng.choice(v) for k, v in HEADERS.items()}, data)


def run(core, flow, seed):
    """Carry out a flow with hostile answers; after STEPS of them nothing is there any more."""
    rng = random.Random(seed)
    outcome = None
    for step in range(10 * STEPS):
        try:
            effect = resume(flow, outcome, None)
        except (StopIteration, RobotError):
            return
        outcome = Response(0)
        if isinstance(effect, Exchange | FetchCertificate):
            outcome = hostile(rng) if step < STEPS else Response(404)
        assert not (isinstance(effect, LogIn) and effect.way == "basic") or core.certificate
        assert "SECRET" not in repr(effect)
    raise AssertionError("it does not end")


@pytest.mark.parametrize("name", FLOWS)
@settings(max_examples=60)
@given(st.sampled_from(list(Generation)), st.integers(0, 2**32))
def test_hostile_answers_end_in_a_result_or_an_error(name, generation, seed):
    core = RwsCore(
        parse_address("rws://h"), Login(password="SECRET"), pins=NOWHERE, generation=generation,
        connected=True, clock=count(0.0, 0.5).__next__,
    )  # fmt: skip
    run(core, FLOWS[name](core), seed)


@given(st.integers(0, 2**32))
def test_hostile_greetings_get_no_password(seed):
    core = RwsCore(parse_address("rws://h"), Login(password="SECRET"), pins=NOWHERE)
    run(core, flows.connect.connect(core), seed)
    assert not core.certificate or not core.connected
