"""Every generated routine on the way of a recoverable error has a handler.

An error in a routine without one goes to the system error handler and ends the task; only RAISE
takes it to the caller (facts of controllers: rapidgen/rapid/switches.py, `unhandled_error`).
"""

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build
from rapidgen.rapid import parse
from rapidgen.rapid.syntax import nodes
from rapidgen.rapid.syntax.walk import walk

RAISING = {
    # Bytes of clients, and connections that break (rapid.md: raw bytes, sockets).
    *("unpackrawbytes", "packrawbytes"),
    *("socketcreate", "socketbind", "socketlisten", "socketaccept", "socketreceive"),
    *("socketsend", "socketpeek"),
    # A robot that is stopped, away from its path or out of its limits.
    *("stopmove", "startmove", "clearpath", "waitrob", "moveabsj", "speedrefresh"),
    # Signals whose unit is gone, names that the controller does not have.
    *("doutput", "dinput", "goutput", "ginput", "aoutput", "ainput", "setdo", "setgo", "setao"),
    *("aliasio", "readcfgdata"),
    # Data that the robot's program does not have.
    *("getdataval", "setdataval"),
    # Events that cannot be read any more.
    *("gettrapdata", "readerrdata"),
}
"""Built-ins that raise an error for what is outside the driver, or was brought from there."""


def calls(routine):
    for node in walk(routine):
        if isinstance(node, nodes.ProcedureCall | nodes.FunctionCall):
            yield node.name.casefold()


def hands_on(routine):
    return routine.error is not None and any(
        isinstance(node, nodes.Raise) for node in walk(routine.error)
    )


def test_no_task_writes_on_the_pendant():
    """A burst of TPWrite blocks its task for more than 75 s (41617, RobotWare 6.15)."""
    for file in build(load_config("irb120")).files:
        if file.kind == "module":
            assert b"TPWrite" not in file.data, file.path


def test_no_bytes_are_read_eight_at_a_time():
    """What a controller makes of a ULINT above 2^52 is in no manual."""
    for file in build(load_config("irb120")).files:
        if file.kind == "module":
            assert b"LINT" not in file.data, file.path


def test_text_is_packed_in_a_way_that_robotware_7_has_for_sure():
    """\\ASCII of UnpackRawBytes went with it: two drivers of RoboDK differ in that."""
    seven = ["controller.robotware=7.10", "controller.type=omnicore"]
    for overrides, wanted in ([], True), (seven, False):
        files = build(load_config("irb120", overrides=overrides)).files
        assert any(b"\\ASCII" in f.data for f in files if f.kind == "module") == wanted


CELL = [
    "signals.valve={kind: DO, access: write}",
    "data.cell:count={type: num, access: write}",
    "data.cell:ready={type: bool}",
    "data.cell:recipe={type: string}",
    "routines.weld={call: weld, parameters: [{name: a, type: num}, {name: b, type: string}]}",
]


@pytest.mark.parametrize("overrides", [[], CELL])
def test_no_error_ends_a_task(overrides):
    modules = [
        parse(file.data, path=file.path)
        for file in build(load_config("irb120", overrides=overrides)).files
        if file.kind == "module"
    ]
    raising = RAISING | {r.name.casefold() for m in modules for r in m.routines if hands_on(r)}
    bare = [
        f"{module.name}: {routine.name}"
        for module in modules
        for routine in module.routines
        if routine.error is None and raising.intersection(calls(routine))
    ]
    assert not bare, "\n".join(bare)
