"""Configuration options, and controllers with other timing."""

from dataclasses import replace
from functools import cache

import pytest

from rapidgen.config import load_config
from rapidgen.controller.cell import in_its_cell
from rapidgen.generate import build, make_system
from rapidgen.machine.cost_model import Costs
from rapidgen.motion.settings import MotionSettings
from rapidgen.rapid.switches import parse_switches
from rapidgen.verification.settings import NEEDED, Setting
from rapidgen.verification.suite import CASES
from rapidgen.verification.suite_runner import Starter
from rapidgen.verification.testbench import Bench
from tools.other_accelerations import with_accelerations

BY_NAME = {case.name: case for case in CASES}
SIGNALS = [
    "signals.valve={kind: DO, access: write}",
    "signals.lamp={kind: DO}",
    "signals.part={kind: DI}",
    "signals.code={kind: GO, access: write}",
    "signals.line={kind: GI}",
    "signals.flow={kind: AO, access: write}",
    "signals.weight={kind: AI}",
]
DATA = [
    "data.cell:count={type: num, access: write}",
    "data.cell:limit={type: num}",
    "data.cell:ready={type: bool, access: write}",
    "data.cell:recipe={type: string, access: write}",
    "data.cell:title={type: string}",
]
ROUTINES = [
    "routines.weld={call: 'cell:weld', parameters: [{name: seam, type: num, mode: inout}, "
    "{name: dry, type: bool}, {name: good, type: bool, mode: inout}, "
    "{name: note, type: string, mode: inout}]}",
    "routines.long={call: 'cell:wait_long'}",
    "routines.absent={call: 'nocell:weld'}",
    "routines.teach={call: 'cell:teach', parameters: [{name: there, type: robtarget, mode: inout}, "
    "{name: place, type: jointtarget, mode: inout}, "
    "{name: back, type: jointtarget, mode: inout}]}",
]
OTHER_ROUTINES = [
    "routines.home={call: 'mine:home', parameters: [{name: there, type: robtarget}, "
    "{name: note, type: string}, {name: place, type: jointtarget, mode: inout}]}",
    "routines.away={call: away}",
]
TOOLS = [
    "tools=[{name: grip, frame: {position: [0, 0, 100]}, load: {mass: 1, centre: [0, 0, 50]}}]",
    "work_objects=[{name: table, user_frame: {position: [300, 0, 100]}}]",
]
VARIANTS = {
    "no control port": (["ports.control=0"], "hello starves progress-ended again-after-stop"),
    "slowed down": (["trajectory.too_fast=slow_down"], "slowed-down each-value each-duration"),
    "slow TCP": (["tcp_speed_limit=250"], "tcp-too-fast whole-trajectory"),
    "slow TCP, zone": (["tcp_speed_limit=500", "trajectory.corners=zone"], "tcp-turns"),
    "slow TCP, fine": (["tcp_speed_limit=250", "trajectory.zone=fine"], "tcp-turns"),
    "zone": (["trajectory.corners=zone"], "corners"),
    "z0": (["trajectory.zone=z0"], "corners"),
    "fine": (["trajectory.zone=fine"], "corners"),
    "100 Hz": (["state.rate=100"], "braking state-stream"),
    "1 Hz": (["state.rate=1"], "short-movements first-of-all"),
    "0.5 Hz": (["state.rate=0.5"], "there-and-back hello-in-pieces"),
    "signals": (SIGNALS, "signals hello control-stop"),
    "data": (DATA, "own-data hello control-stop"),
    "routines": (
        ROUTINES,
        "routine-absent routine-missing routine-results routine-targets routine-alone "
        "program-waits",
    ),
    "other routines": (OTHER_ROUTINES, "routine-absent"),
    "signals on the way": (SIGNALS, "program-signals program-sets program-without-signals"),
    "tools": (TOOLS, "program-tools program-own-frames program-waits"),
    "some clients": (["network.allowed_clients=[10.0.0.9]"], "strangers single-point"),
    "impatient": (["network.receive_timeout=3"], "stalls half-header"),
    "small ring": (
        ["trajectory.ring=64", "trajectory.preload=10"],
        "room overrun batch-full-ring",
    ),
    "RobotWare 5": (["controller.robotware=5.61"], "starves stream-control move-fails"),
    "RobotWare 7": (
        ["controller.robotware=7.10", "controller.type=omnicore"],
        "hello events starves stream-control move-fails",
    ),
}
CONTROLLERS = {
    "quick": Setting(costs=Costs().scaled(0.25)),
    "slow": Setting(costs=Costs().scaled(4.0)),
    "plans early": Setting(motion=MotionSettings(planning_lead=0.3)),
}
STRICT = (
    "unpack_ulint=error",
    "unpack_ulint=error,argument_error=fatal",
    "unpack_ulint=error,negative_mod=error",
    "unpack_ulint=single,argument_error=fatal",
    "argument_error=fatal,pack_beyond=error",
    "argument_error=fatal,unpack_beyond=zero",
)
"""Beside the default, under which an error that no routine handles ends its task."""
ACCELERATIONS = {
    "in time": ([], "takes-its-time step-by-step stream one-place"),
    "speed and stops": ([], "speed-kept program-speed stop-on-path e-stop-at-speed program-prefix"),
    "ceiling": (
        ["tcp_speed_limit=500", "trajectory.corners=zone"],
        "tcp-turns tcp-too-fast tcp-recorded",
    ),
}
"""What the driver guarantees on any robot that it is built for: cases, by configuration."""
SENT = ("foreign-openings", "hostile-openings", "batch-shapes", "batch-no-number")
ON_ANY = (
    "whole-trajectory",
    "stop-on-path",
    "program-stop",
    "e-stop",
    "starves",
    "stream-control",
    "stream-ended",
    "ring-is-empty",
)


@cache
def configured(*overrides):
    config = load_config("irb120", overrides=overrides)
    return config, in_its_cell(make_system(config, build(config), open_words=True), config)


def broken(config, system, names, setting=None):
    starter = Starter(config, system, setting or Setting())
    verdicts = [starter.attempt(BY_NAME[name]) for name in names]
    starter.close()
    return {v.case: v.detail or v.untried for v in verdicts if v.untried or not v.passed}


@pytest.mark.parametrize("name", VARIANTS)
def test_configuration_options_take_effect(name):
    overrides, names = VARIANTS[name]
    assert broken(*configured(*overrides), names.split()) == {}


def test_missing_signal_is_refused_and_others_work():
    config, system = configured(*SIGNALS)
    target = tuple(s for s in system.signals if s.name not in ("valve", "weight"))
    assert broken(config, replace(system, signals=target), ["signals", "stop-on-path"]) == {}


@pytest.mark.parametrize("name", CONTROLLERS)
def test_quicker_and_slower_controllers(name):
    assert broken(*configured(), ON_ANY, CONTROLLERS[name]) == {}


@pytest.mark.parametrize("factor", [0.5, 2.0])
@pytest.mark.parametrize("name", ACCELERATIONS)
def test_guarantees_on_a_robot_with_other_accelerations(name, factor):
    """A driver does not know the accelerations of its robot (ABB publishes none)."""
    overrides, names = ACCELERATIONS[name]
    config, system = configured(*overrides)
    assert broken(with_accelerations(config, factor), system, names.split()) == {}


@pytest.mark.parametrize("switch", ["alias_by_name=false"])
def test_unsupported_controller_moves_nothing(switch):
    """A task ends at its start."""
    assert switch.partition("=")[0] in NEEDED
    with Bench(*configured(), Setting(dialect=parse_switches(switch))) as bench:
        bench.run(0.5)
        assert any(task.state == "error" for task in bench.controller.tasks.values())


@pytest.mark.parametrize("pair", STRICT)
def test_messages_under_strict_readings_end_no_task(pair):
    setting = Setting(dialect=parse_switches(pair))
    assert broken(*configured(), SENT, setting) == {}
